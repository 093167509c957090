from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from tests.analytic import fall_through
from user_forces.contact_events import (
    BEYOND,
    SHARE,
    Action,
    Verdict,
    goes_on,
    judge,
    judge_at_ends,
)
from user_forces.contact_state import HEAVIEST, InverseMass, Onset, PinMemory

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
    depth: Polynomial,
    begin: float = 0.0,
    step: float = H,
    impact_step: float = H,
    speed: float | None = None,
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


# --- apart at the start of the step ---


@given(impact=impacts(1.01 * SHARE, 0.749))
def test_touch_in_mid_step_cuts_the_step_to_end_just_behind_it(impact: Rise) -> None:
    verdict, memory = judged(impact.depth, step=impact.step, impact_step=impact.step)
    assert_cut(verdict, memory, impact.share + BEHIND, 1, impact.step)
    assert_located(verdict, impact)


@given(impact=impacts(0.751, 1.0 - 1.01 * SHARE))
def test_late_touch_is_reached_in_two_steps(impact: Rise) -> None:
    verdict, memory = judged(impact.depth, step=impact.step, impact_step=impact.step)
    assert_cut(verdict, memory, impact.share + BEHIND, 2, impact.step)
    assert_located(verdict, impact)


@given(impact=impacts(1.0 - 0.99 * SHARE, 1.0 - 1e-3 * SHARE))
def test_touch_near_the_end_is_accepted_with_its_exact_speed(impact: Rise) -> None:
    verdict, _ = judged(impact.depth, step=impact.step, impact_step=impact.step)
    assert verdict.action is Action.ACCEPT
    assert_located(verdict, impact)
    end = memory_of(
        True, impact.speed, float(impact.depth(impact.step)), float(impact.depth.deriv()(impact.step))
    )
    # rounding of the speed
    assert verdict.memory == pytest.approx(end, rel=1e-13)


@given(impact=impacts(1e-3 * SHARE, 0.99 * SHARE))
def test_touch_near_the_start_repeats_the_step_in_contact(impact: Rise) -> None:
    verdict, memory = judged(impact.depth, step=impact.step, impact_step=impact.step)
    assert verdict.action is Action.REPEAT
    assert_located(verdict, impact)
    # depth and rate stay those of the start; rounding of the speed
    assert verdict.memory == pytest.approx(memory_of(True, impact.speed, memory.depth, memory.rate), rel=1e-13)


@given(impact=impacts(0.0, 0.99), finer=st.integers(2, 50))
def test_an_impact_does_not_begin_with_a_long_step(impact: Rise, finer: int) -> None:
    early = impact._replace(share=impact.share * SHARE / finer)
    verdict, memory = judged(early.depth, step=impact.step, impact_step=impact.step / finer)
    assert verdict.action is Action.CUT
    assert verdict.memory == memory
    assert verdict.step == impact.step / finer
    assert_located(verdict, early)


def test_touch_exactly_at_the_end_is_found_in_the_next_step() -> None:
    depth = Polynomial([-0.5 * H, 0.5])
    at_end = judge(memory_of(False, 0.0, -0.5 * H, 0.5), 0.0, 0.5, H, H, any_speed(H))
    assert (at_end.action, at_end.onset) == (Action.ACCEPT, None)
    following = judge(at_end.memory, float(depth(2 * H)), 0.5, 2 * H, H, any_speed(H))
    assert following.action is Action.REPEAT
    # rounding
    assert following.onset == pytest.approx(Onset(H, 0.5), rel=1e-14)


def test_a_pin_pressed_in_without_contact_begins_it_at_once() -> None:
    verdict, memory = judged(Polynomial([1e-5, 0.2]))
    assert verdict.action is Action.REPEAT
    assert verdict.onset == Onset(0.0, 0.2)
    assert verdict.memory == memory_of(True, 0.2, memory.depth, memory.rate)


# --- up and down within one step ---


@given(top=st.floats(0.35, 0.65), height=st.floats(0.05, 0.8), bend=st.floats(10.0, 1e3))
def test_a_graze_within_one_step_is_located(top: float, height: float, bend: float) -> None:
    # depth = bend ((r h)^2 - (t - top h)^2): zero at top -+ r, negative at both ends
    r = height * min(top, 1.0 - top)
    t = Polynomial([-top * H, 1.0])
    verdict, _ = judged(bend * ((r * H) ** 2 - t**2))
    assert verdict.onset is not None
    # the roots of a parabola whose top is r h high; rounding over a slope of r >= 0.017
    assert verdict.onset.time == pytest.approx((top - r) * H, abs=1e-13 * H)
    assert verdict.onset.speed == pytest.approx(2.0 * bend * r * H, rel=1e-11)
    assert verdict.action is Action.CUT


@given(top=st.floats(0.1, 0.9), below=st.floats(0.01, 1.0))
def test_a_miss_within_one_step_is_free_flight(top: float, below: float) -> None:
    t = Polynomial([-top * H, 1.0])
    verdict, _ = judged(-100.0 * ((below * H) ** 2 + t**2))
    assert (verdict.action, verdict.onset) == (Action.ACCEPT, None)
    assert not verdict.memory.in_contact


# --- in contact at the start of the step ---


@given(separation=impacts(1.01 * SHARE, 0.749))
def test_parting_in_mid_step_cuts_the_step_to_end_just_behind_it(separation: Rise) -> None:
    verdict, memory = judged(-separation.depth, step=separation.step, speed=0.3)
    assert_cut(verdict, memory, separation.share + BEHIND, 1, separation.step)
    assert verdict.onset is None


@given(
    separation=impacts(1e-3 * SHARE, 0.99 * SHARE) | impacts(1.0 - 0.99 * SHARE, 1.0 - 1e-3 * SHARE),
)
def test_contact_is_released_in_a_step_that_parts_near_an_end_of_it(separation: Rise) -> None:
    depth = -separation.depth
    verdict, _ = judged(depth, step=separation.step, speed=0.3)
    end = memory_of(False, 0.0, float(depth(separation.step)), float(depth.deriv()(separation.step)))
    assert verdict == accepted(end)


@given(
    bottom=st.floats(0.35, 0.65),
    width=st.floats(0.05, 0.9),
    bend=st.floats(10.0, 1e3),
)
def test_parting_and_touching_again_within_a_step_is_a_new_contact(
    bottom: float, width: float, bend: float
) -> None:
    r = width * min(bottom, 1.0 - bottom)
    t = Polynomial([-bottom * H, 1.0])
    depth = bend * (t**2 - (r * H) ** 2)
    verdict, _ = judged(depth, speed=0.3)
    assert verdict.action is Action.ACCEPT
    assert verdict.onset is not None
    # the roots of a parabola whose bottom is r h deep; rounding over a slope of r >= 0.017
    assert verdict.onset.time == pytest.approx((bottom + r) * H, abs=1e-13 * H)
    assert verdict.onset.speed == pytest.approx(2.0 * bend * r * H, rel=1e-11)
    assert verdict.memory.in_contact
    assert verdict.memory.impact_velocity == verdict.onset.speed


@given(bottom=st.floats(0.1, 0.9), above=st.floats(0.01, 1.0))
def test_a_swing_that_stays_in_contact_is_no_new_contact(bottom: float, above: float) -> None:
    t = Polynomial([-bottom * H, 1.0])
    verdict, _ = judged(100.0 * ((above * H) ** 2 + t**2), speed=0.3)
    assert (verdict.action, verdict.onset) == (Action.ACCEPT, None)
    assert verdict.memory[:2] == (True, 0.3)


# --- pressed on again without having separated ---

# so deep that no cubic between two of them gets to the surface: it dips by at most step times 1 m/s / 8
deep = st.floats(5e-4, 1e-3)


# --- nothing has surely happened ---


@given(
    first=st.floats(-0.5, 0.5),
    last=st.floats(-0.5, 0.5),
    mean=st.floats(-0.5, 0.5),
    depth=st.floats(-1e-4, 1e-4) | deep,
    in_contact=st.booleans(),
)
def test_what_surely_goes_on_is_judged_to(
    first: float, last: float, mean: float, depth: float, in_contact: bool
) -> None:
    # whatever the rate does in the midst of the step
    start, end = memory_of(in_contact, 0.3, depth, first), (depth + H * mean, last)
    if goes_on(start, *end, H):
        assert judge(start, *end, H, H, any_speed(H)) == accepted(start.moved(*end))


@pytest.mark.parametrize("back", [1.0, -1.0])
def test_a_dip_within_a_step_does_not_surely_go_on(back: float) -> None:
    # the rate, of one sign at both ends, passes zero at 0.4 and 0.6 of the step
    rate = back * 0.1 * Polynomial.fromroots([0.4 * H, 0.6 * H]) / H**2
    dips, evenly = rate.integ() + 2e-4, Polynomial([2e-4, back * 0.1])
    for depth, surely in ((dips, False), (evenly, True)):
        start = memory_of(True, 0.3, 2e-4, float(depth.deriv()(0.0)))
        assert goes_on(start, float(depth(H)), float(depth.deriv()(H)), H) is surely


# --- memory ---

angles = st.floats(-math.pi, math.pi)


@st.composite
def inverse_masses(draw: st.DrawFn) -> tuple[InverseMass, float, float, float]:
    """An inverse effective mass, the direction of one of its axes [rad], and masses along and across [kg]."""
    angle, along, across = draw(angles), draw(st.floats(0.01, 1e4)), draw(st.floats(0.01, 1e4))
    c, s = math.cos(angle), math.sin(angle)
    xx, yy = c * c / along + s * s / across, s * s / along + c * c / across
    return InverseMass(xx, c * s * (1.0 / along - 1.0 / across), yy), angle, along, across


@given(drawn=inverse_masses(), radius=st.floats(1e-6, 1e-2))
def test_mass_along_the_axes_of_mobility_is_the_reciprocal_of_it(
    drawn: tuple[InverseMass, float, float, float], radius: float
) -> None:
    inverse_mass, angle, along, across = drawn
    x, y = radius * math.cos(angle), radius * math.sin(angle)
    # rounding of the other one, up to 1e6 times larger
    assert inverse_mass.mass(x, y) == pytest.approx(along, rel=1e-9)
    assert inverse_mass.mass(-y, x) == pytest.approx(across, rel=1e-9)


@pytest.mark.parametrize("noise", [0.0, 1e-18, -1e-18])
def test_mass_where_the_joints_leave_no_motion_is_very_large(noise: float) -> None:
    # across the free direction, with rounding of the order of a mobility of 0.01/kg
    mass = InverseMass(0.01, 0.0, noise).mass(0.0, 1e-3)
    # the noise is a thousandth of 1/HEAVIEST
    assert mass == pytest.approx(HEAVIEST, rel=2e-3)


# --- one step after the other ---


class Stop(NamedTuple):
    """The step that settles it."""

    verdict: Verdict
    begin: float
    size: float

    def borders_on(self, time: float) -> bool:
        """Whether the step begins or ends at this time [s], to the share that counts as such."""
        return min(abs(self.begin - time), abs(self.begin + self.size - time)) <= SHARE * self.size


def stepped(depth: Polynomial, step: float, speed: float | None, stop: Callable[[Verdict], bool]) -> Stop:
    """Make steps as the solver does, up to a verdict; tries that are cut are few."""
    begin, size, landing, cuts = 0.0, step, math.inf, 0
    while True:
        verdict, _ = judged(depth, begin, size, impact_step=step, speed=speed)
        if verdict.action is Action.CUT:
            cuts += 1
            assert cuts <= 3
            # the engine cannot shorten a step by less than a quarter
            assert verdict.step <= 0.75 * size
            size, landing = verdict.step, verdict.landing
        elif stop(verdict):
            return Stop(verdict, begin, size)
        else:
            begin += size
            size = landing - begin if begin + SHARE * step < landing < begin + step else step


@given(gap=st.floats(1e-4, 2e-3), speed=st.floats(0.0, 1.0), step=st.floats(1e-5, 1e-2))
def test_cutting_leads_to_the_touch_in_a_few_tries(gap: float, speed: float, step: float) -> None:
    gravity = 9.81
    depth = Polynomial([-gap, speed, 0.5 * gravity])
    last = stepped(depth, step, None, lambda verdict: verdict.onset is not None)
    onset = last.verdict.onset
    assert onset is not None
    time, final = fall_through(gap, speed, gravity)
    # rounding of a difference of depths up to 0.5 mm/step, and of the time
    assert onset.time == pytest.approx(time, abs=1e-13)
    assert onset.speed == pytest.approx(final, rel=1e-10)
    assert last.verdict.memory.in_contact
    assert last.borders_on(time)


@given(depth=st.floats(1e-4, 2e-3), speed=st.floats(0.0, 1.0), step=st.floats(1e-5, 1e-2))
def test_cutting_leads_to_the_parting_in_a_few_tries(depth: float, speed: float, step: float) -> None:
    pull = 9.81
    path = Polynomial([depth, -speed, -0.5 * pull])
    last = stepped(path, step, 0.3, lambda verdict: not verdict.memory.in_contact)
    assert last.verdict.onset is None
    time, _ = fall_through(depth, speed, pull)
    assert last.borders_on(time)


# --- nothing located ---


def at_ends(start: PinMemory, depth: float, rate: float) -> Verdict:
    return judge_at_ends(start, depth, rate, 2.0 * H, H)


def test_a_touch_counts_from_the_end_of_its_step() -> None:
    verdict = at_ends(memory_of(False, 0.0, -3e-4, 0.4), 1e-4, 0.5)
    # the straight line from -0.3 to 0.1 mm passes zero after three quarters of the step; rounding
    assert verdict.onset == pytest.approx(Onset(1.75 * H, 0.5), rel=1e-14)
    assert verdict._replace(onset=None) == accepted(memory_of(True, 0.5, 1e-4, 0.5))


def test_a_parting_counts_from_the_end_of_its_step() -> None:
    assert at_ends(memory_of(True, 0.3, 1e-4, -0.3), -1e-4, -0.3) == accepted(
        memory_of(False, 0.0, -1e-4, -0.3)
    )
