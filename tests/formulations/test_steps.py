from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from support_exudyn.scene.time_grid import StepPlan, shortest_step

Times = list[float]


def walk(plan: StepPlan, largest: float = math.inf) -> Times:
    """The times a solver lands on that adds each step to its time, up to the end or rounding before it."""
    times = [0.0]
    while times[-1] < plan.duration * (1.0 - 1e-12):
        t = times[-1]
        times.append(t + (plan.next_time(t, largest) - t))
        assert times[-1] > t
        assert len(times) < 20000
    return times


def expected_stops(duration: float, period: float, breaks: Times) -> Times:
    """Records, breaks and the end, sorted, those that differ by rounding only taken as one."""
    wanted = [n * period for n in range(int(duration / period) + 2)] + breaks + [duration]
    stops: Times = []
    for t in sorted(t for t in wanted if 0.0 <= t <= duration):
        if not stops or t - stops[-1] > 1e-12:
            stops.append(t)
    return stops


@st.composite
def plans(draw: st.DrawFn) -> tuple[StepPlan, Times]:
    """A plan and its stops; decimal numbers as people write them, or any."""
    period = draw(st.sampled_from([1e-3, 7e-3, 9e-3, 0.01, 0.1]) | st.floats(1e-3, 1.0))
    duration = period * draw(st.integers(1, 15) | st.floats(1.0, 15.0))
    if draw(st.booleans()):
        duration = float(f"{duration:.6g}")
    assume(duration >= period)
    step = period * draw(st.sampled_from([0.1, 0.25, 0.5, 1.0]) | st.floats(0.08, 2.0))
    breaks = [n / 100 * duration for n in draw(st.lists(st.integers(-20, 120), max_size=3))]
    breaks += [n * period for n in draw(st.lists(st.integers(0, 15), max_size=2))]
    stops = expected_stops(duration, period, breaks)
    # times that are nearly but not quite the same have a test of their own
    assume(all(b - a > 1e-6 * min(step, period) for a, b in pairwise(stops)))
    return StepPlan(duration, period, step, breaks), stops


# the largest step, as a share of the plan's own: whole parts of it, any, longer ones, or as it is
shares = st.sampled_from([0.5, 0.25, 0.1, 1.0, math.inf]) | st.floats(0.1, 2.0)


@given(planned=plans(), share=shares)
def test_every_record_and_break_is_hit_exactly(planned: tuple[StepPlan, Times], share: float) -> None:
    plan, stops = planned
    times = {0.0}
    t = 0.0
    while t < plan.duration:
        t = plan.next_time(t, share * plan.step)
        times.add(t)
    asked_for = {n * plan.record_period for n in range(17)} | {*plan.breaks, plan.duration}
    for stop in stops:
        # of those that differ by rounding only, any one
        assert any(abs(t - stop) < 1e-12 and t in times for t in asked_for)


@given(planned=plans(), share=shares)
def test_steps_between_two_stops_are_equal_and_as_few_as_possible(
    planned: tuple[StepPlan, Times], share: float
) -> None:
    plan, stops = planned
    largest = share * plan.step
    times = walk(plan, largest)
    for before, after in pairwise(stops):
        inside = [t for t in times if before - 1e-12 < t < after + 1e-12]
        parts = len(inside) - 1
        # a share of 1e-9 is not worth another step
        assert parts == max(1, math.ceil((after - before) / min(plan.step, largest) - 1e-9))
        for a, b in pairwise(inside):
            # rounding of times up to 15 s
            assert b - a == pytest.approx((after - before) / parts, abs=1e-14)


@given(planned=plans())
def test_every_record_is_recorded_once_and_nothing_else(planned: tuple[StepPlan, Times]) -> None:
    plan, _ = planned
    recorded = [t for t in walk(plan) if plan.record_at(t) is not None]
    # rounding of times up to 15 s
    assert recorded == pytest.approx(expected_stops(plan.duration, plan.record_period, []), abs=4e-15)


def test_steps_by_hand() -> None:
    plan = StepPlan(duration=0.5, record_period=0.2, step=0.1, breaks=[0.25])
    # 0.2 to the break in one step, from there to 0.4 in two of 0.075; rounding
    assert walk(plan) == pytest.approx([0.0, 0.1, 0.2, 0.25, 0.325, 0.4, 0.5], abs=1e-15)


def test_a_break_within_rounding_of_a_record_takes_no_step_of_its_own() -> None:
    assert 3 * 0.1 != 0.3
    sizes = [b - a for a, b in pairwise(walk(StepPlan(1.0, 0.1, 0.05, [0.3, 0.6, 0.7])))]
    # rounding
    assert sizes == pytest.approx([0.05] * 20, abs=1e-15)


def test_the_last_record_is_the_end_and_comes_once() -> None:
    plan = StepPlan(0.027, 0.009, 0.009, ())  # 3 * 0.009 is a rounding below 0.027
    assert plan.next_time(0.018) == 0.027


# --- steps that pass over records ---


@given(planned=plans(), factor=st.floats(1.0, 20.0))
def test_far_times_lie_on_records_and_breaks_or_the_grid_and_within_the_step(
    planned: tuple[StepPlan, Times], factor: float
) -> None:
    plan, _ = planned
    size = factor * min(plan.step, plan.record_period)
    t, times = 0.0, [0.0]
    while t < plan.duration:
        t = plan.far_time(t, size)
        assert t > times[-1]
        times.append(t)
    # a share of 1e-9 is not worth another step
    assert max(b - a for a, b in pairwise(times)) <= size * (1.0 + 2e-9) + 1e-12
    for b in [*plan.breaks, plan.duration]:
        # breaks that differ from a record by rounding only are the same time
        assert any(abs(t - b) < 1e-12 for t in times)
    passed = [r for a, b in pairwise(times) for r in plan.records_between(a, b)]
    found = sorted(passed + [t for t in times if plan.record_at(t) is not None])
    # every record once; rounding of times up to 15 s
    assert found == pytest.approx(expected_stops(plan.duration, plan.record_period, []), abs=4e-15)


# --- rests that are not worth a step ---

ROUNDING = 1e-15  # [m], of a machine of some metres


def test_the_shortest_step_of_the_support() -> None:
    # by hand: the cube root of 1e-15 times 5e-4 over 10; of an impact's steps
    assert shortest_step(ROUNDING, 5e-4) == pytest.approx(3.684e-7, rel=1e-3)
    assert shortest_step(ROUNDING, 1e-6) == pytest.approx(4.642e-8, rel=1e-3)
    assert shortest_step(ROUNDING, 1e-8) == 1e-9


@pytest.mark.parametrize("beside", [1e-10, 1e-9, 1e-7])
def test_a_stop_close_behind_another_is_a_rest(beside: float) -> None:
    plan = StepPlan(1.0, 0.1, 0.01, [0.3 + beside], ROUNDING)
    assert plan.rest(0.1) is None
    assert plan.rest(3 * 0.1) == 0.3 + beside
    assert plan.rest(0.3 + beside) is None
    # behind a record, before one, and before the end
    assert StepPlan(1.0, 0.1, 0.01, [0.3 - beside], ROUNDING).rest(0.3 - beside) == 3 * 0.1
    assert StepPlan(0.5 + beside, 0.1, 0.01, [], ROUNDING).rest(0.5) == 0.5 + beside
    # where steps are that short themselves there is none
    assert plan.rest(3 * 0.1, beside) is None
    # without rounding every stop is worth a step
    assert StepPlan(1.0, 0.1, 0.01, [0.3 + beside]).rest(3 * 0.1) is None


def test_an_event_just_before_a_time_of_the_grid_takes_no_tiny_step() -> None:
    plan = StepPlan(1.0, 0.1, 0.01, [], ROUNDING)
    t = 0.13 - 1e-9
    times = [t]
    while times[-1] < 0.2:
        times.append(plan.next_time(times[-1]))
    sizes = np.diff(times)
    assert sizes.min() > 0.4 * 0.01
    assert sizes.max() < 0.01 * (1.0 + 1e-9)
    assert times[-1] == 0.2


def test_steps_after_a_break_are_refined_beyond_a_record_just_behind_it() -> None:
    plan = StepPlan(1.0, 0.1, 0.01, [0.3 - 1e-6], ROUNDING)
    following = [t for t in (0.299, 0.3 - 1e-6, 0.3, 0.305, 0.3099, 0.31, 0.35) if plan.follows_break(t)]
    assert following == [0.3 - 1e-6, 0.3, 0.305, 0.3099]


def test_several_breaks_at_one_time_are_all_told() -> None:
    near = [0.3, math.nextafter(0.3, 1.0), 0.5]
    assert StepPlan(1.0, 0.1, 0.01, near).breaks_at(3 * 0.1) == near[:2]


def test_a_record_is_told_as_it_was_asked_for() -> None:
    plan = StepPlan(1.0, 0.1, 0.01, [0.3])
    assert plan.record_at(0.3) == 3 * 0.1 != 0.3
    assert plan.record_at(0.301) is None
    assert plan.record_at(math.nextafter(1.0, 0.0)) == 1.0
