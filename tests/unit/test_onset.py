from __future__ import annotations

import math
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from support_exudyn.onset import Action, PinMemory, Verdict, judge
from tests.analytic import fall_through

H = 1e-3  # length of a step [s]


def judged(
    depth: Polynomial, begin: float = 0.0, step: float = H, impact_step: float = H, speed: float | None = None
) -> tuple[Verdict, PinMemory]:
    """Verdict on a step from `begin`, and the memory at its start, if the depth [m] is this function of
    time [s]; `speed`: of approach of a contact that is going on, None if there is none.
    """
    rate, end = depth.deriv(), begin + step
    memory = PinMemory(speed is not None, speed or 0.0, float(depth(begin)), float(rate(begin)))
    return judge(memory, float(depth(end)), float(rate(end)), end, step, impact_step), memory


class Touch(NamedTuple):
    """A cubic depth that rises through zero once in a step, at a share of it, at a speed [m/s]."""

    share: float
    speed: float
    step: float
    bend: float
    twist: float

    @property
    def depth(self) -> Polynomial:
        s = Polynomial([-self.share, 1.0 / self.step])  # time from the touch, in steps
        return self.step * self.speed * s * (1.0 + self.bend * s + self.twist * s**2)


def touches(lowest: float, highest: float) -> st.SearchStrategy[Touch]:
    # 1 + bend s + twist s^2 has no root for s from -1 to 1, so the touch is the only one
    return st.builds(
        Touch,
        share=st.floats(lowest, highest),
        speed=st.floats(0.01, 2.0),
        step=st.floats(1e-5, 1e-2),
        bend=st.floats(-0.4, 0.4),
        twist=st.floats(-0.3, 0.3),
    )


def assert_located(verdict: Verdict, touch: Touch) -> None:
    assert verdict.onset is not None
    # rounding: of depths to 1e-16 of themselves, and of a time up to 10 ms
    assert verdict.onset.time == pytest.approx(touch.share * touch.step, abs=1e-13 * touch.step)
    assert verdict.onset.speed == pytest.approx(touch.speed, rel=1e-13)


# --- apart at the start of the step ---


@pytest.mark.parametrize("speed", [0.0, 0.5, -0.5])
def test_free_flight_without_touch_is_accepted(speed: float) -> None:
    verdict, _ = judged(Polynomial([-1e-3, speed]))
    # rounding of the end depth
    assert verdict == (
        Action.ACCEPT,
        PinMemory(False, 0.0, pytest.approx(-1e-3 + speed * H), speed),
        None,
        math.inf,
    )


@given(touch=touches(0.051, 0.749))
def test_touch_in_mid_step_cuts_the_step_to_end_there(touch: Touch) -> None:
    verdict, memory = judged(touch.depth, step=touch.step, impact_step=touch.step)
    assert verdict.action is Action.CUT
    assert verdict.memory == memory
    # rounding of the share
    assert verdict.step == pytest.approx(touch.share * touch.step, rel=1e-12)
    assert_located(verdict, touch)


@given(touch=touches(0.751, 0.949))
def test_late_touch_is_reached_in_two_steps(touch: Touch) -> None:
    verdict, memory = judged(touch.depth, step=touch.step, impact_step=touch.step)
    assert verdict.action is Action.CUT
    assert verdict.memory == memory
    # rounding of the share
    assert verdict.step == pytest.approx(0.5 * touch.share * touch.step, rel=1e-12)
    assert_located(verdict, touch)


@given(touch=touches(0.951, 0.999))
def test_touch_near_the_end_is_accepted_with_its_exact_speed(touch: Touch) -> None:
    verdict, _ = judged(touch.depth, step=touch.step, impact_step=touch.step)
    assert verdict.action is Action.ACCEPT
    assert_located(verdict, touch)
    end = PinMemory(True, touch.speed, float(touch.depth(touch.step)), float(touch.depth.deriv()(touch.step)))
    # rounding of the speed
    assert verdict.memory == pytest.approx(end, rel=1e-13)


@given(touch=touches(0.001, 0.049))
def test_touch_near_the_start_repeats_the_step_in_contact(touch: Touch) -> None:
    verdict, memory = judged(touch.depth, step=touch.step, impact_step=touch.step)
    assert verdict.action is Action.REPEAT
    assert_located(verdict, touch)
    # depth and rate stay those of the start; rounding of the speed
    assert verdict.memory == pytest.approx(PinMemory(True, touch.speed, memory.depth, memory.rate), rel=1e-13)


@given(touch=touches(0.001, 0.049), refinement=st.integers(2, 50))
def test_an_impact_does_not_begin_with_a_long_step(touch: Touch, refinement: int) -> None:
    verdict, memory = judged(touch.depth, step=touch.step, impact_step=touch.step / refinement)
    assert verdict.action is Action.CUT
    assert verdict.memory == memory
    assert verdict.step == touch.step / refinement


@given(touch=touches(0.001, 0.999), begin=st.floats(0.0, 10.0))
def test_onset_is_located_wherever_the_step_lies(touch: Touch, begin: float) -> None:
    memory = PinMemory(False, 0.0, float(touch.depth(0.0)), float(touch.depth.deriv()(0.0)))
    end_depth, end_rate = float(touch.depth(touch.step)), float(touch.depth.deriv()(touch.step))
    verdict = judge(memory, end_depth, end_rate, begin + touch.step, touch.step, touch.step)
    assert verdict.onset is not None
    # rounding of a time of 10 s
    assert verdict.onset.time == pytest.approx(begin + touch.share * touch.step, abs=4e-15)


def test_touch_exactly_at_the_end_is_found_in_the_next_step() -> None:
    depth = Polynomial([-0.5 * H, 0.5])
    at_end = judge(PinMemory(False, 0.0, -0.5 * H, 0.5), 0.0, 0.5, H, H, H)
    assert (at_end.action, at_end.onset) == (Action.ACCEPT, None)
    following = judge(at_end.memory, float(depth(2 * H)), 0.5, 2 * H, H, H)
    assert following.action is Action.REPEAT
    # rounding
    assert following.onset == pytest.approx((H, 0.5), rel=1e-14)


def test_a_pin_pressed_in_without_contact_begins_it_at_once() -> None:
    verdict, memory = judged(Polynomial([1e-5, 0.2]))
    assert verdict.action is Action.REPEAT
    assert verdict.onset == (0.0, 0.2)
    assert verdict.memory == PinMemory(True, 0.2, memory.depth, memory.rate)


def test_approach_speed_is_never_negative() -> None:
    verdict, _ = judged(Polynomial([1e-5, -0.001]))
    assert verdict.onset == (0.0, 0.0)


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


def test_a_graze_that_begins_near_the_start_repeats_the_step() -> None:
    t = Polynomial([-0.5 * H, 1.0])
    verdict, _ = judged(100.0 * ((0.475 * H) ** 2 - t**2))
    assert verdict.action is Action.REPEAT
    # the root of a parabola: rounding
    assert verdict.onset == pytest.approx((0.025 * H, 2.0 * 100.0 * 0.475 * H), rel=1e-11)


@given(top=st.floats(0.1, 0.9), below=st.floats(0.01, 1.0))
def test_a_miss_within_one_step_is_free_flight(top: float, below: float) -> None:
    t = Polynomial([-top * H, 1.0])
    verdict, _ = judged(-100.0 * ((below * H) ** 2 + t**2))
    assert (verdict.action, verdict.onset) == (Action.ACCEPT, None)
    assert not verdict.memory.in_contact


# --- in contact at the start of the step ---


def test_contact_that_goes_on_keeps_its_approach_speed() -> None:
    verdict, _ = judged(Polynomial([1e-4, 0.05]), speed=0.3)
    assert verdict == (Action.ACCEPT, PinMemory(True, 0.3, 1e-4 + 0.05 * H, 0.05), None, math.inf)


@pytest.mark.parametrize("end_depth", [-1e-6, 0.0])
def test_contact_is_released_when_the_surfaces_part(end_depth: float) -> None:
    memory = PinMemory(True, 0.3, 1e-4, -0.1)
    verdict = judge(memory, end_depth, -0.1, H, H, H)
    assert verdict == (Action.ACCEPT, PinMemory(False, 0.0, end_depth, -0.1), None, math.inf)


@given(bottom=st.floats(0.35, 0.65), width=st.floats(0.05, 0.9), bend=st.floats(10.0, 1e3))
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
    assert verdict.memory.approach_speed == verdict.onset.speed


@given(bottom=st.floats(0.1, 0.9), above=st.floats(0.01, 1.0))
def test_a_swing_that_stays_in_contact_is_no_new_contact(bottom: float, above: float) -> None:
    t = Polynomial([-bottom * H, 1.0])
    verdict, _ = judged(100.0 * ((above * H) ** 2 + t**2), speed=0.3)
    assert (verdict.action, verdict.onset) == (Action.ACCEPT, None)
    assert verdict.memory[:2] == (True, 0.3)


def test_a_repeated_step_in_contact_may_begin_before_the_touch() -> None:
    # what REPEAT leaves behind: in contact, depth still a little negative
    verdict = judge(PinMemory(True, 0.2, -1e-6, 0.2), 1e-4, 0.2, H, H, H)
    assert verdict == (Action.ACCEPT, PinMemory(True, 0.2, 1e-4, 0.2), None, math.inf)


# --- one step after the other ---


@given(gap=st.floats(1e-4, 2e-3), speed=st.floats(0.0, 1.0), step=st.floats(1e-5, 1e-2))
def test_cutting_leads_to_the_touch_in_a_few_tries(gap: float, speed: float, step: float) -> None:
    gravity = 9.81
    depth = Polynomial([-gap, speed, 0.5 * gravity])
    begin, size, cuts = 0.0, step, 0
    while True:
        verdict, _ = judged(depth, begin, size, impact_step=step)
        if verdict.action is Action.CUT:
            cuts += 1
            assert cuts <= 3
            # the engine cannot shorten a step by less than a quarter
            assert verdict.step <= 0.75 * size
            size = verdict.step
        elif verdict.onset is not None:
            break
        else:
            begin, size = begin + size, step if cuts == 0 else size
    time, final = fall_through(gap, speed, gravity)
    # rounding of a difference of depths up to 0.5 mm/step, and of the time
    assert verdict.onset.time == pytest.approx(time, abs=1e-13)
    assert verdict.onset.speed == pytest.approx(final, rel=1e-10)
    assert verdict.memory.in_contact
