"""Verdicts on tried steps: touches and partings within them, on depths whose roots are known."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from tests.analytic import fall_through
from user_forces.contact_events import BEYOND, SHARE, Action, Verdict, goes_on, judge, judge_at_ends
from user_forces.contact_state import InverseMass, Onset, PinMemory

H = 1e-3  # length of a step [s]
BEHIND = BEYOND * SHARE  # how far behind an event a cut step is to end, in steps
REST = (0.2, 1e-6)  # slip and deflection: what no verdict changes


def memory_of(in_contact: bool, impact_velocity: float, depth: float, rate: float) -> PinMemory:
    return PinMemory(in_contact, impact_velocity, depth, rate, *REST)


def accepted(memory: PinMemory) -> Verdict:
    """An ordinary step: no impact, nothing to repeat."""
    return Verdict(Action.ACCEPT, memory, None, math.inf, math.inf)


def any_speed(step: float) -> Callable[[float], float]:
    """Steps of this length in impacts of any speed."""
    return lambda speed: step


def judged(
    depth: Polynomial, begin: float = 0.0, step: float = H, impact_step: float = H, speed: float | None = None
) -> tuple[Verdict, PinMemory]:
    """Verdict on a step from `begin`, and the memory at its start, if the depth [m] is this function of
    time [s]; `speed`: of approach of a contact that is going on, None if there is none.
    """
    rate, end = depth.deriv(), begin + step
    memory = memory_of(speed is not None, speed or 0.0, float(depth(begin)), float(rate(begin)))
    verdict = judge(memory, float(depth(end)), float(rate(end)), end, step, any_speed(impact_step))
    return verdict, memory


class Rise(NamedTuple):
    """A cubic depth that rises through zero once in a step, at a share of it, at a speed [m/s]."""

    share: float
    speed: float
    step: float
    bend: float
    twist: float

    @property
    def depth(self) -> Polynomial:
        s = Polynomial([-self.share, 1.0 / self.step])  # time from the impact, in steps
        return self.step * self.speed * s * (1.0 + self.bend * s + self.twist * s**2)


def impacts(lowest: float, highest: float) -> st.SearchStrategy[Rise]:
    # 1 + bend s + twist s^2 has no root for s from -1 to 1, so the impact is the only one
    return st.builds(
        Rise,
        share=st.floats(lowest, highest),
        speed=st.floats(0.01, 2.0),
        step=st.floats(1e-5, 1e-2),
        bend=st.floats(-0.4, 0.4),
        twist=st.floats(-0.3, 0.3),
    )


def assert_located(verdict: Verdict, impact: Rise) -> None:
    assert verdict.onset is not None
    # rounding: of depths to 1e-16 of themselves, and of a time up to 10 ms
    assert verdict.onset.time == pytest.approx(impact.share * impact.step, abs=1e-13 * impact.step)
    assert verdict.onset.speed == pytest.approx(impact.speed, rel=1e-13)


def assert_cut(verdict: Verdict, memory: PinMemory, goal: float, parts: int, step: float) -> None:
    """The step is to be made anew, up to a share of it, in so many parts."""
    assert verdict.action is Action.CUT
    assert verdict.memory == memory
    # rounding of the share, which is not located to better than 1e-15
    assert verdict.step == pytest.approx(goal * step / parts, abs=1e-13 * step)
    assert verdict.landing == pytest.approx(goal * step, abs=1e-13 * step)


# --- a touch or a parting in a step ---

NEAR_START, MID = (1e-3 * SHARE, 0.99 * SHARE), (1.01 * SHARE, 0.749)
LATE, NEAR_END = (0.751, 1.0 - 1.01 * SHARE), (1.0 - 0.99 * SHARE, 1.0 - 1e-3 * SHARE)


@pytest.mark.parametrize(
    ("where", "action", "parts"),
    [(NEAR_START, Action.REPEAT, 0), (MID, Action.CUT, 1), (LATE, Action.CUT, 2), (NEAR_END, Action.ACCEPT, 0)],
    ids=["start", "mid", "late", "end"],
)
@given(data=st.data())
def test_a_touch_is_located_and_the_step_ends_just_behind_it(
    where: tuple[float, float], action: Action, parts: int, data: st.DataObject
) -> None:
    impact = data.draw(impacts(*where))
    verdict, memory = judged(impact.depth, step=impact.step, impact_step=impact.step)
    assert verdict.action is action
    assert_located(verdict, impact)
    if parts:
        assert_cut(verdict, memory, impact.share + BEHIND, parts, impact.step)
        return
    ends = memory.depth, memory.rate
    if action is Action.ACCEPT:
        ends = float(impact.depth(impact.step)), float(impact.depth.deriv()(impact.step))
    assert verdict.memory == pytest.approx(memory_of(True, impact.speed, *ends), rel=1e-13)  # rounding


@given(separation=impacts(*MID))
def test_parting_in_mid_step_cuts_the_step_to_end_just_behind_it(separation: Rise) -> None:
    verdict, memory = judged(-separation.depth, step=separation.step, speed=0.3)
    assert_cut(verdict, memory, separation.share + BEHIND, 1, separation.step)
    assert verdict.onset is None


@given(separation=impacts(*NEAR_START) | impacts(*NEAR_END))
def test_contact_is_released_in_a_step_that_parts_near_an_end_of_it(separation: Rise) -> None:
    depth = -separation.depth
    verdict, _ = judged(depth, step=separation.step, speed=0.3)
    end = memory_of(False, 0.0, float(depth(separation.step)), float(depth.deriv()(separation.step)))
    assert verdict == accepted(end)


@given(impact=impacts(0.0, 0.99), finer=st.integers(2, 50))
def test_an_impact_does_not_begin_with_a_long_step(impact: Rise, finer: int) -> None:
    early = impact._replace(share=impact.share * SHARE / finer)
    verdict, memory = judged(early.depth, step=impact.step, impact_step=impact.step / finer)
    assert (verdict.action, verdict.memory, verdict.step) == (Action.CUT, memory, impact.step / finer)
    assert_located(verdict, early)


# --- up and down, or down and up, within one step ---


@pytest.mark.parametrize("speed", [None, 0.3], ids=["a graze", "parting and touching again"])
@given(top=st.floats(0.35, 0.65), size=st.floats(0.05, 0.8), bend=st.floats(10.0, 1e3))
def test_a_touch_beside_a_parting_is_located(speed: float | None, top: float, size: float, bend: float) -> None:
    # a parabola that is zero at top -+ r, of one sign at both ends
    r = size * min(top, 1.0 - top)
    t = Polynomial([-top * H, 1.0])
    sign = 1.0 if speed is None else -1.0
    verdict, _ = judged(sign * bend * ((r * H) ** 2 - t**2), speed=speed)
    assert verdict.onset is not None
    # its roots; rounding over a slope of r >= 0.017
    assert verdict.onset.time == pytest.approx((top - sign * r) * H, abs=1e-13 * H)
    assert verdict.onset.speed == pytest.approx(2.0 * bend * r * H, rel=1e-11)
    assert verdict.action is (Action.CUT if speed is None else Action.ACCEPT)
    if speed is not None:
        assert verdict.memory[:2] == (True, verdict.onset.speed)


@pytest.mark.parametrize("speed", [None, 0.3], ids=["a miss", "a swing in contact"])
@given(turn=st.floats(0.1, 0.9), away=st.floats(0.01, 1.0))
def test_where_the_depth_does_not_reach_zero_nothing_happens(
    speed: float | None, turn: float, away: float
) -> None:
    t = Polynomial([-turn * H, 1.0])
    verdict, _ = judged((-100.0 if speed is None else 100.0) * ((away * H) ** 2 + t**2), speed=speed)
    assert (verdict.action, verdict.onset) == (Action.ACCEPT, None)
    assert verdict.memory[:2] == (speed is not None, speed or 0.0)


@pytest.mark.parametrize("back", [1.0, -1.0])
def test_a_dip_within_a_step_does_not_surely_go_on(back: float) -> None:
    # the rate, of one sign at both ends, passes zero at 0.4 and 0.6 of the step
    rate = back * 0.1 * Polynomial.fromroots([0.4 * H, 0.6 * H]) / H**2
    dips, evenly = rate.integ() + 2e-4, Polynomial([2e-4, back * 0.1])
    for depth, surely in ((dips, False), (evenly, True)):
        start = memory_of(True, 0.3, 2e-4, float(depth.deriv()(0.0)))
        assert goes_on(start, float(depth(H)), float(depth.deriv()(H)), H) is surely


# --- one step after the other ---


@pytest.mark.parametrize("contact", [None, 0.3], ids=["touch", "parting"])
@given(gap=st.floats(1e-4, 2e-3), speed=st.floats(0.0, 1.0), step=st.floats(1e-5, 1e-2))
def test_cutting_leads_to_the_event_in_a_few_tries(
    contact: float | None, gap: float, speed: float, step: float
) -> None:
    """Steps as the solver makes them, through a free fall towards zero depth or away from it."""
    depth = Polynomial([-gap, speed, 0.5 * 9.81]) * (1.0 if contact is None else -1.0)
    begin, size, landing, cuts = 0.0, step, math.inf, 0
    while True:
        verdict, _ = judged(depth, begin, size, impact_step=step, speed=contact)
        if verdict.action is Action.CUT:
            cuts += 1
            assert cuts <= 3
            assert verdict.step <= 0.75 * size  # the engine cannot shorten a step by less than a quarter
            size, landing = verdict.step, verdict.landing
        elif verdict.onset is not None or verdict.memory.in_contact != (contact is not None):
            break
        else:
            begin += size
            size = landing - begin if begin + SHARE * step < landing < begin + step else step
    time, final = fall_through(gap, speed, 9.81)
    assert min(abs(begin - time), abs(begin + size - time)) <= SHARE * size
    assert verdict.memory.in_contact is (contact is None)
    if contact is None:
        assert verdict.onset is not None
        # rounding of a difference of depths up to 0.5 mm/step, and of the time
        assert (verdict.onset.time, verdict.onset.speed) == (
            pytest.approx(time, abs=1e-13), pytest.approx(final, rel=1e-10)
        )  # fmt: skip


def test_without_location_touch_and_parting_count_from_the_end_of_their_step() -> None:
    verdict = judge_at_ends(memory_of(False, 0.0, -3e-4, 0.4), 1e-4, 0.5, 2.0 * H, H)
    # the straight line from -0.3 to 0.1 mm passes zero after three quarters of the step; rounding
    assert verdict.onset == pytest.approx(Onset(1.75 * H, 0.5), rel=1e-14)
    assert verdict._replace(onset=None) == accepted(memory_of(True, 0.5, 1e-4, 0.5))
    parted = judge_at_ends(memory_of(True, 0.3, 1e-4, -0.3), -1e-4, -0.3, 2.0 * H, H)
    assert parted == accepted(memory_of(False, 0.0, -1e-4, -0.3))


# --- the mass that an impact feels ---


@given(
    angle=st.floats(-math.pi, math.pi),
    along=st.floats(0.01, 1e4),
    across=st.floats(0.01, 1e4),
    radius=st.floats(1e-6, 1e-2),
)
def test_mass_along_the_axes_of_mobility_is_the_reciprocal_of_it(
    angle: float, along: float, across: float, radius: float
) -> None:
    c, s = math.cos(angle), math.sin(angle)
    xx, yy = c * c / along + s * s / across, s * s / along + c * c / across
    inverse_mass = InverseMass(xx, c * s * (1.0 / along - 1.0 / across), yy)
    x, y = radius * c, radius * s
    # rounding of the other one, up to 1e6 times larger
    assert inverse_mass.mass(x, y) == pytest.approx(along, rel=1e-9)
    assert inverse_mass.mass(-y, x) == pytest.approx(across, rel=1e-9)
