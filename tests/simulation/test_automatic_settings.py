"""From an accuracy to formulation and settings."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Held, Scenario, simulate
from support_exudyn.scenario.scenario_data import LARGEST_GOAL, LARGEST_STEP, SMALLEST_GOAL
from support_exudyn.scenario.solver_settings import MOST_IMPACT_STEPS, SMALLEST_TOLERANCE
from support_exudyn.scenario.timescales import timescales
from support_exudyn.simulation.automatic_settings import (
    DRIVE,
    FEWEST_IMPACT_STEPS,
    FLIGHT,
    GOAL_OF_SHARES,
    IMPACT_STEPS,
    LARGEST_TOLERANCE,
    MOST_FRICTION_TIMES,
    RESTING,
    settings_for,
)
from tests.cases.run_cases import loose_slider_crank, loose_support
from tests.formulations.test_formulations import COVERED, SCENES
from user_forces import Ambrosio

goals = st.floats(math.log10(SMALLEST_GOAL), math.log10(LARGEST_GOAL)).map(
    lambda x: min(max(10.0**x, SMALLEST_GOAL), LARGEST_GOAL)
)
DROP = loose_support(drive=Held(), duration=0.02)


# --- the formulation ---


@pytest.mark.parametrize("scene", SCENES)
def test_the_cheapest_that_covers_a_scene_is_taken(scene: str) -> None:
    expected = next(name for name in ("compiled", "exudyn") if scene in COVERED[name])
    assert settings_for(SCENES[scene], 1e-3).formulation == expected


def rubbing(scene: Scenario, ramp: float) -> Scenario:
    """The same with friction in its clearance pins, whose ramp is so wide [m/s]."""
    friction = Ambrosio(sliding_coefficient=0.25, static_speed=1e-4, dynamic_speed=1e-4 + ramp)
    pins = {
        name: replace(pin, contact=replace(pin.contact, friction=friction))
        for name, pin in scene.clearance_pins.items()
    }
    return replace(scene, pins=pins)


@pytest.mark.parametrize("scene", [DROP, SCENES["clearance support on oil"], replace(DROP, duration=2.0)])
def test_friction_too_steep_for_explicit_steps_is_left_to_the_implicit_ones(scene: Scenario) -> None:
    # the time in which friction stops what slides is as long as the ramp is wide
    wide = 1e-2
    steepest = wide * scene.duration / (MOST_FRICTION_TIMES * timescales(rubbing(scene, wide)).rubbing)
    assert 1e-9 < steepest < wide  # there are such friction laws
    assert settings_for(rubbing(scene, 1.05 * steepest), 1e-3).formulation == "compiled"
    steep = rubbing(scene, 0.95 * steepest)
    assert settings_for(steep, 1e-3).formulation == "exudyn"
    # who asks for another has it
    assert settings_for(replace(steep, formulation="compiled"), 1e-3).formulation == "compiled"


def test_a_run_to_an_accuracy_is_made_by_the_formulation_that_can() -> None:
    steep = rubbing(replace(DROP, duration=0.02), 2e-9)  # friction stops in 20 ps what slides
    result = simulate(steep, accuracy=0.1)
    assert result.scenario.formulation == "exudyn"
    assert len(result.onsets["rear_base"]) == 1


# --- the settings ---


@given(goal=goals, name=st.sampled_from(sorted(SCENES)))
def test_settings_are_allowed_ones_and_nothing_else_is_changed(goal: float, name: str) -> None:
    scene = replace(SCENES[name], accuracy=goal)
    chosen = settings_for(scene, goal)
    assert chosen.accuracy is None
    assert 0.0 < chosen.step <= min(LARGEST_STEP, scene.recorded_every)
    assert FEWEST_IMPACT_STEPS <= chosen.solver.impact_steps <= MOST_IMPACT_STEPS
    assert SMALLEST_TOLERANCE <= chosen.solver.tolerance <= LARGEST_TOLERANCE
    kept = {"impact_steps": scene.solver.impact_steps, "tolerance": scene.solver.tolerance}
    assert replace(chosen.solver, **kept) == scene.solver  # type: ignore[arg-type]
    back = replace(chosen, accuracy=goal, step=scene.step, solver=scene.solver, formulation=scene.formulation)
    assert back == scene


def test_steps_are_shares_of_the_scenes_times() -> None:
    scene = replace(loose_slider_crank(1e-3), record_period=1e-3, formulation="exudyn")
    times, chosen = timescales(scene), settings_for(scene, GOAL_OF_SHARES)
    shares = (FLIGHT * times.flight, RESTING * times.resting, DRIVE * times.drive)
    assert chosen.step == min(shares)
    assert chosen.solver.impact_steps == IMPACT_STEPS
    # second order: a goal a hundredth as small takes steps a tenth as long
    finer = settings_for(scene, GOAL_OF_SHARES / 4.0)
    assert finer.step == pytest.approx(0.5 * chosen.step, rel=1e-12)
    assert finer.solver.impact_steps == 2 * IMPACT_STEPS
