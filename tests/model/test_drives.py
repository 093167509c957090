"""Drives as they are contracted: a speed that is the derivative, jumps at breaks, a span that is kept."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn import CubicStep, Reciprocating, Steady, UniformSpeed
from support_exudyn.model.drives.drive import Drive, Stroke
from support_exudyn.model.hydraulics.inlets import Inlet
from support_exudyn.model.loads.applied import LoadCourse
from tests.analytic import adams_step
from tests.ranges import from_zero
from user_forces import InputError

LONGEST = 12.0  # [s]


def stroke_of(kind: type[Stroke], stroke: float, start: float, length: float) -> Stroke:
    return kind(stroke=stroke, start=start, end=start + length)


sizes, starts, lengths = st.floats(-2.0, 2.0), from_zero(5.0), st.floats(0.1, 5.0)
strokes = st.builds(stroke_of, st.sampled_from([CubicStep, UniformSpeed]), sizes, starts, lengths)
reciprocating = st.builds(Reciprocating, stroke=sizes, period=st.floats(0.1, 10.0))
drives = st.one_of(strokes, reciprocating, st.builds(Steady, rate=st.floats(-1e3, 1e3)))
times, durations, shares = st.floats(-1.0, LONGEST), st.floats(0.01, LONGEST), st.floats(0.0, 1.0)


@given(drive=drives, t=times)
def test_speed_is_the_derivative_of_the_extension(drive: Drive, t: float) -> None:
    h = 1e-3 if isinstance(drive, Steady) else 1e-5
    assume(all(abs(t - b) > 2.0 * h for b in drive.breaks))
    slope = (drive.extension(t + h) - drive.extension(t - h)) / (2.0 * h)
    # central difference: third derivative times h^2/6; rounding of 2 m, of 12 s times the rate, and of phases
    # up to 750 rad at 1e-13 rad, over h
    third, rounding = 0.0, 1e-10
    if isinstance(drive, Stroke):
        third = 12.0 * 2.0 / (drive.end - drive.start) ** 3
    elif isinstance(drive, Reciprocating):
        third, rounding = drive.frequency**3, 4e-8
    elif isinstance(drive, Steady):
        rounding = 2e-12 * abs(drive.rate) + 1e-12
    assert drive.speed(t) == pytest.approx(slope, abs=third * h**2 / 6.0 + rounding)


@given(drive=drives)
def test_speed_jumps_at_the_breaks_and_at_no_start_of_what_moves_already(drive: Drive) -> None:
    h = 1e-9
    # acceleration of at most 6 stroke/length^2 = 1200 m/s^2, or stroke/2 w^2 = 4000 m/s^2, over 1 ns
    change = 2e-6 if isinstance(drive, Stroke) else 5e-6
    for t in drive.breaks:
        assert drive.speed_jump(t) == pytest.approx(drive.speed(t + h) - drive.speed(t), abs=change)
    if isinstance(drive, Steady):
        assert drive.initial_speed == drive.speed(0.0) == drive.rate
        assert drive.speed_jump(0.0) == drive.extension(0.0) == 0.0


@given(drive=drives, duration=durations, share=shares)
def test_extension_stays_within_the_span_and_reaches_it(drive: Drive, duration: float, share: float) -> None:
    lowest, highest = drive.span(duration)
    rounding = 5e-16 * (max(1.0, abs(lowest), highest) if isinstance(drive, Steady) else 1.0)  # of 2 m
    assert lowest - rounding <= drive.extension(share * duration) <= highest + rounding
    farthest = drive.extension(duration)
    if isinstance(drive, Stroke):
        farthest = drive.stroke  # the whole stroke, also where the run ends before
    if isinstance(drive, Reciprocating):
        farthest = drive.extension(min(duration, 0.5 * drive.period))
    assert lowest + highest == pytest.approx(farthest, abs=rounding)


@given(drive=strokes, beyond=st.floats(1e-6, 5.0))
def test_actuators_rest_before_the_start_and_at_their_stroke_after_the_end(
    drive: Stroke, beyond: float
) -> None:
    assert (drive.extension(drive.start - beyond), drive.speed(drive.start - beyond)) == (0.0, 0.0)
    assert (drive.extension(drive.end + beyond), drive.speed(drive.end + beyond)) == (drive.stroke, 0.0)


# --- strokes ---


@given(stroke=sizes, start=starts, length=lengths, t=times)
def test_cubic_step_is_the_step_function(stroke: float, start: float, length: float, t: float) -> None:
    chosen = stroke_of(CubicStep, stroke, start, length)
    # the same polynomial in another order: rounding of 2 m
    assert chosen.extension(t) == pytest.approx(adams_step(t, start, 0.0, start + length, stroke), abs=2e-15)


@pytest.mark.parametrize("kind", [CubicStep, UniformSpeed])
@pytest.mark.parametrize("end", [3.0, 2.0])
def test_end_before_the_start_is_refused(kind: type[Stroke], end: float) -> None:
    with pytest.raises(InputError, match=rf"{kind.__name__}: end = {end} s: allowed: > start = 3\.0 s"):
        kind(start=3.0, end=end)


# --- raised and lowered over and over ---


def test_reciprocating_by_hand() -> None:
    chosen = Reciprocating(stroke=0.4, period=2.0)
    # a quarter of a period: half of the stroke, at the largest speed, pi stroke / period; rounding
    assert chosen.extension(0.5) == pytest.approx(0.2, rel=1e-15)
    assert chosen.speed(0.5) == pytest.approx(math.pi * 0.2, rel=1e-15)
    # before the start nothing moved: the acceleration jumps there
    assert chosen.breaks == (0.0,)
    assert Reciprocating(period=1.0).stroke == 0.5


@pytest.mark.parametrize("kind", [Drive, Inlet, LoadCourse])
def test_functions_of_time_of_ones_own_state_where_they_break(kind: type) -> None:
    """Without its breaks a step would pass a jump in silence."""
    assert "breaks" in kind.__abstractmethods__  # type: ignore[attr-defined]
