from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn import CubicStep, Reciprocating, Steady, UniformSpeed
from tests.analytic import adams_step
from tests.ranges import from_zero
from user_forces import InputError

Stroke = CubicStep | UniformSpeed

kinds = st.sampled_from([CubicStep, UniformSpeed])
strokes = st.floats(-2.0, 2.0)
starts = from_zero(5.0)
lengths = st.floats(0.1, 5.0)
times = st.floats(-1.0, 12.0)
rates = st.floats(-1e3, 1e3)


def drive(kind: type[Stroke], stroke: float, start: float, length: float) -> Stroke:
    return kind(stroke=stroke, start=start, end=start + length)


@given(kind=kinds, stroke=strokes, start=starts, length=lengths, t=times)
def test_speed_is_the_derivative_of_the_extension(
    kind: type[Stroke], stroke: float, start: float, length: float, t: float
) -> None:
    chosen, h = drive(kind, stroke, start, length), 1e-5
    assume(all(abs(t - b) > 2.0 * h for b in chosen.breaks))
    slope = (chosen.extension(t + h) - chosen.extension(t - h)) / (2.0 * h)
    # central difference: third derivative 12 stroke/length^3 times h^2/6, and rounding of 2 m over h
    assert chosen.speed(t) == pytest.approx(slope, abs=12.0 * 2.0 / length**3 * h**2 / 6.0 + 1e-10)


@given(kind=kinds, stroke=strokes, start=starts, length=lengths, beyond=st.floats(1e-6, 5.0))
def test_actuators_rest_before_the_start_and_at_their_stroke_after_the_end(
    kind: type[Stroke], stroke: float, start: float, length: float, beyond: float
) -> None:
    chosen = drive(kind, stroke, start, length)
    assert (chosen.extension(start - beyond), chosen.speed(start - beyond)) == (0.0, 0.0)
    assert (chosen.extension(chosen.end + beyond), chosen.speed(chosen.end + beyond)) == (stroke, 0.0)


@given(stroke=strokes, start=starts, length=lengths, t=times)
def test_cubic_step_is_the_step_function(stroke: float, start: float, length: float, t: float) -> None:
    chosen = drive(CubicStep, stroke, start, length)
    # the same polynomial in another order: rounding of 2 m
    assert chosen.extension(t) == pytest.approx(adams_step(t, start, 0.0, start + length, stroke), abs=2e-15)


@pytest.mark.parametrize("t", [0.0, 2.9, 3.0, 3.2, 4.0, 4.7, 5.0, 9.0])
def test_default_is_the_sum_of_steps_that_the_paper_writes(t: float) -> None:
    # STEP(TIME,0,0,3,0)+STEP(TIME,3,0,5,500) [mm]
    paper = adams_step(t, 0.0, 0.0, 3.0, 0.0) + adams_step(t, 3.0, 0.0, 5.0, 500.0)
    # rounding of 0.5 m
    assert CubicStep().extension(t) == pytest.approx(paper / 1e3, abs=2e-16)


def test_uniform_speed_at_its_jumps_is_the_speed_before() -> None:
    assert UniformSpeed().speed(3.0) == 0.0
    assert UniformSpeed().speed(5.0) == 0.25


@given(kind=kinds, stroke=strokes, start=starts, length=lengths)
def test_speed_jumps_at_the_breaks_as_told(
    kind: type[Stroke], stroke: float, start: float, length: float
) -> None:
    chosen, h = drive(kind, stroke, start, length), 1e-9
    for t in chosen.breaks:
        # the cubic step's acceleration, at most 6 stroke/length^2 = 1200 m/s^2, over 1 ns
        assert chosen.speed_jump(t) == pytest.approx(chosen.speed(t + h) - chosen.speed(t), abs=2e-6)


@given(
    kind=kinds,
    stroke=strokes,
    start=starts,
    length=lengths,
    duration=st.floats(0.1, 12.0),
    share=st.floats(0.0, 1.0),
)
def test_extension_stays_within_the_span(
    kind: type[Stroke], stroke: float, start: float, length: float, duration: float, share: float
) -> None:
    chosen = drive(kind, stroke, start, length)
    lowest, highest = chosen.span(duration)
    # rounding of 2 m
    assert lowest - 5e-16 <= chosen.extension(share * duration) <= highest + 5e-16
    # the whole stroke, also where the run ends before
    assert {lowest, highest} == {0.0, stroke}


# --- a crank that has been turning for long ---


@given(rate=rates, t=st.floats(0.0, 12.0))
def test_steady_speed_is_the_derivative_of_the_angle(rate: float, t: float) -> None:
    crank, h = Steady(rate=rate), 1e-3
    slope = (crank.extension(t + h) - crank.extension(t - h)) / (2.0 * h)
    # a straight line: rounding of 12 s times the rate, over 2 ms
    assert crank.speed(t) == pytest.approx(slope, rel=2e-12, abs=1e-12)


@given(rate=rates)
def test_a_steady_crank_begins_at_its_start_angle_and_at_speed(rate: float) -> None:
    crank = Steady(rate=rate)
    assert crank.extension(0.0) == 0.0
    # it has its speed from the start on: nothing jumps
    assert crank.initial_speed == crank.speed(0.0) == rate
    assert crank.speed_jump(0.0) == 0.0


# --- raised and lowered over and over ---

periods = st.floats(0.1, 10.0)


@given(stroke=strokes, period=periods, t=times)
def test_speed_of_reciprocating_is_the_derivative(stroke: float, period: float, t: float) -> None:
    chosen, h = Reciprocating(stroke=stroke, period=period), 1e-5
    slope = (chosen.extension(t + h) - chosen.extension(t - h)) / (2.0 * h)
    # central difference: third derivative stroke/2 w^3 times h^2/6; rounding of 2 m, and of phases up to
    # 750 rad at 1e-13 rad, over h
    assert chosen.speed(t) == pytest.approx(slope, abs=chosen.frequency**3 * h**2 / 6.0 + 4e-8)


def test_reciprocating_by_hand() -> None:
    chosen = Reciprocating(stroke=0.4, period=2.0)
    # a quarter of a period: half of the stroke, at the largest speed, pi stroke / period; rounding
    assert chosen.extension(0.5) == pytest.approx(0.2, rel=1e-15)
    assert chosen.speed(0.5) == pytest.approx(math.pi * 0.2, rel=1e-15)
    # before the start nothing moved: the acceleration jumps there
    assert chosen.breaks == (0.0,)
    assert Reciprocating(period=1.0).stroke == 0.5


@given(stroke=strokes, period=periods, duration=st.floats(0.01, 12.0), share=st.floats(0.0, 1.0))
def test_reciprocating_stays_within_the_span_and_reaches_it(
    stroke: float, period: float, duration: float, share: float
) -> None:
    chosen = Reciprocating(stroke=stroke, period=period)
    lowest, highest = chosen.span(duration)
    # rounding of 2 m
    assert lowest - 5e-16 <= chosen.extension(share * duration) <= highest + 5e-16
    farthest = chosen.extension(min(duration, 0.5 * period))
    assert lowest + highest == pytest.approx(farthest, abs=5e-16)


@pytest.mark.parametrize("period", [0.0, -1.0, float("nan")])
def test_a_period_that_makes_no_sense_is_refused(period: float) -> None:
    with pytest.raises(InputError, match=rf"Reciprocating\.period = {period}: "):
        Reciprocating(period=period)


# --- bad input, and back from data ---


@pytest.mark.parametrize("kind", [CubicStep, UniformSpeed])
@pytest.mark.parametrize("end", [3.0, 2.0])
def test_end_before_the_start_is_refused(kind: type[Stroke], end: float) -> None:
    with pytest.raises(InputError, match=rf"{kind.__name__}: end = {end} s: allowed: > start = 3\.0 s"):
        kind(start=3.0, end=end)


@given(periods=st.integers(1, 10**6), t=st.integers(0, 4096))
def test_a_reciprocating_drive_is_where_it_was_periods_ago(periods: int, t: int) -> None:
    drive = Reciprocating(stroke=0.1, period=4.0)
    early, late = t / 1024.0, t / 1024.0 + 4.0 * periods
    # times are exact, and whole periods are left out without rounding: to the last bit
    assert drive.extension(late) == drive.extension(early)
    assert drive.speed(late) == drive.speed(early)
