from __future__ import annotations

import itertools
import math

import pytest

from tests.analytic import contact_time, greatest_depth
from user_forces import Exact, KelvinVoigt
from user_forces.impact_steps import (
    DURATIONS,
    HALVINGS,
    LIVELY,
    QUIET,
    SMALL_SWINGS,
    STEPS_APART,
    ImpactSteps,
)

LAW = Exact(stiffness=1e8, restitution=0.5)
NUMBER, MASS, SPEED = 100, 3.0, 0.2
DEEPEST = greatest_depth(1e8, 1.5, MASS, SPEED)


def struck() -> ImpactSteps:
    steps = ImpactSteps(LAW, NUMBER)
    steps.impact(0.0, SPEED, MASS)
    return steps


def swing(steps: ImpactSteps, middle: float, amplitude: float, times: int = 1, points: int = 40) -> None:
    """The depth swings about a middle [m], deep and back."""
    for n in range(1, times * points + 1):
        phase = 2.0 * math.pi * n / points
        depth, rate = middle - amplitude * math.cos(phase), amplitude * math.sin(phase)
        steps.follow(depth, rate if abs(rate) > 1e-12 * amplitude else 0.0, MASS)


def test_there_is_no_impact_at_first() -> None:
    assert ImpactSteps(LAW, NUMBER).step == math.inf


def test_a_touch_divides_the_duration_of_the_undamped_impact() -> None:
    # 2.94 is a rounded constant
    assert struck().step == pytest.approx(contact_time(DEEPEST, 1.5, SPEED) / NUMBER, rel=2e-3)


def test_short_steps_go_on_for_a_little_after_the_parting() -> None:
    steps = struck()
    for _ in range(STEPS_APART):
        steps.follow(-1e-6, -0.1, MASS)
        assert steps.step < math.inf
    steps.follow(-1e-6, -0.1, MASS)
    assert steps.step == math.inf


def test_small_swings_end_an_impact_and_large_ones_do_not() -> None:
    steps = struck()
    swing(steps, DEEPEST, 0.6 * LIVELY * DEEPEST, SMALL_SWINGS - 1)
    assert steps.step < math.inf
    swing(steps, DEEPEST, 0.9 * DEEPEST, 2)  # large: counted from the beginning again
    swing(steps, DEEPEST, 0.3 * LIVELY * DEEPEST, SMALL_SWINGS - 2)
    assert steps.step < math.inf
    swing(steps, DEEPEST, 0.3 * LIVELY * DEEPEST, 3)
    assert steps.step == math.inf


def test_a_creeping_contact_is_no_impact_for_ever() -> None:
    steps = struck()
    for _ in range(DURATIONS * NUMBER):
        steps.follow(DEEPEST, 0.0, MASS)
        assert steps.step < math.inf
    steps.follow(DEEPEST, 0.0, MASS)
    assert steps.step == math.inf


def test_a_resting_contact_that_moves_is_in_an_impact_again() -> None:
    steps = struck()
    swing(steps, DEEPEST, 1e-3 * DEEPEST, 2 * SMALL_SWINGS)
    assert steps.step == math.inf
    last = DEEPEST * (1.0 - 1e-3)
    steps.follow(last * (1.0 + 0.9 * QUIET), 0.01, MASS)
    assert steps.step == math.inf
    steps.follow(last * (1.0 + 3.0 * QUIET), 0.01, MASS)
    assert steps.step < math.inf


def test_a_load_that_presses_deeper_shortens_the_steps() -> None:
    steps = struck()
    first = steps.step
    steps.follow(0.5 * DEEPEST, 0.5 * SPEED, MASS)  # less than the impact brought
    assert steps.step == first
    steps.follow(2.0 * DEEPEST, SPEED, MASS)
    assert steps.step < first


def test_a_force_that_jumps_at_the_touch_is_met_with_growing_steps() -> None:
    steps = ImpactSteps(KelvinVoigt(stiffness=1e6, damping=500.0), NUMBER)
    steps.impact(0.0, SPEED, MASS)
    lengths = [steps.step]
    for _ in range(HALVINGS + 1):
        steps.follow(1e-6, SPEED, MASS)
        lengths.append(steps.step)
    for short, long in itertools.pairwise(lengths[: HALVINGS + 1]):
        assert long == pytest.approx(2.0 * short, rel=1e-12)
    assert lengths[-1] == lengths[-2]


def test_a_swing_of_what_friction_holds_takes_a_part_of_an_impacts_steps() -> None:
    steps = ImpactSteps(LAW, 512)
    for time in (1e-5, 2.7e-4, 3.3e-2):
        found = steps.swing_step(time)
        # half a period is pi times one over the angular frequency: 16 of 512 steps, or up to twice as many
        assert math.pi * time / 32.0 < found <= math.pi * time / 16.0
        assert math.log2(found) == round(math.log2(found))
    assert ImpactSteps(LAW, 1024).swing_step(2.7e-4) == 0.5 * steps.swing_step(2.7e-4)
    assert steps.swing_step(math.inf) == math.inf


def test_a_mass_that_is_asked_for_in_need_gives_the_same_steps() -> None:
    told, asked = struck(), struck()
    questions = 0

    def mass() -> float:
        nonlocal questions
        questions += 1
        return MASS

    depth = 0.5 * DEEPEST
    for n in range(400):
        swung, rate = 0.4 * depth * math.sin(0.3 * n), 0.4 * SPEED * math.cos(0.3 * n)
        depth *= 1.02 if n == 200 else 1.0
        told.follow(depth + swung, rate, MASS)
        asked.follow(depth + swung, rate, 0.8 * MASS, mass)
        assert asked.step == told.step
    told.follow(3.0 * DEEPEST, SPEED, MASS)
    before = questions
    asked.follow(3.0 * DEEPEST, SPEED, 0.8 * MASS, mass)
    assert asked.step == told.step
    assert questions == before + 1  # the energy may be that of a larger speed
