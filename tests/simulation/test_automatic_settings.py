"""From an accuracy to formulation and settings, and steps with which a loaded contact rings on."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import ClearancePin, Held, Scenario, SolverSettings, simulate
from support_exudyn.scenario.scenario_data import LARGEST_GOAL, LARGEST_STEP, SMALLEST_GOAL
from support_exudyn.scenario.solver_settings import MOST_IMPACT_STEPS, SMALLEST_TOLERANCE
from support_exudyn.scenario.timescales import loaded_contacts, timescales
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
from support_exudyn.simulation.contact_ringing import (
    FASTEST,
    GONE,
    KEPT,
    numerical_damping,
    ringing_step,
    vibrations,
)
from tests.cases.run_cases import loose_slider_crank, loose_support, paper_contact, support
from tests.formulations.test_formulations import COVERED, SCENES
from user_forces import Ambrosio, Frictionless, KelvinVoigt, LankaraniNikravesh, NormalLaw
from user_forces.normal.hysteresis import REST_VELOCITY

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


# --- steps with which a loaded contact rings on ---


RINGING = "rear_base"
GAP = 1e-6  # [m]: across the load a journal then swings ten times as fast as along it


def narrow(normal: NormalLaw | None = None, duration: float = 3.0, clearance: float = GAP) -> Scenario:
    """The support held, its rear pin with clearance by next to nothing, without friction."""
    contact = paper_contact(1.5, 0.0)
    law = LankaraniNikravesh(restitution=0.9, stiffness=2.7e10, exponent=1.5) if normal is None else normal
    bearing = replace(contact.bearing, clearance=clearance)
    contact = replace(contact, bearing=bearing, normal=law, friction=Frictionless())
    return support(
        pins={RINGING: ClearancePin(contact=contact)}, drive=Held(), duration=duration, record_period=1e-3
    )


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("phase", [0.05, 0.5, 2.0])
def test_numerical_damping_is_that_of_the_recursion(radius: float, phase: float) -> None:
    # generalised alpha of x'' = -x, in the form of its authors
    m, f = (2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0)
    gamma, beta = 0.5 - m + f, 0.25 * (1.0 - m + f) ** 2
    x, v, a = 1.0, 0.0, -1.0
    sizes = []
    for _ in range(4000):
        known_x = x + phase * v + phase**2 * (0.5 - beta) * a
        known_v = v + phase * (1.0 - gamma) * a
        new = -(m * a + f * x + (1.0 - f) * known_x) / (1.0 - m + (1.0 - f) * beta * phase**2)
        x, v, a = known_x + beta * phase**2 * new, known_v + gamma * phase * new, new
        sizes.append(math.hypot(x, v))
        if sizes[-1] < 1e-200:
            break
    half = len(sizes) // 2
    turn = max(10, len(sizes) // 10)
    before, after = max(sizes[half - turn : half]), max(sizes[-turn:])
    measured = math.log(before / after) / (phase * (len(sizes) - half))
    assert numerical_damping(phase, radius) == pytest.approx(measured, rel=0.05)


def test_along_the_load_a_contact_vibrates_as_its_law_is_stiff_and_across_it_like_a_pendulum() -> None:
    stiffness, damping = 1e9, 1e5
    (contact,) = loaded_contacts(narrow(KelvinVoigt(stiffness=stiffness, damping=damping)))[:1]
    free = contact._replace(inverse_mass=np.eye(2) / 300.0, mass=300.0)  # the same in all directions
    across, along = sorted(vibrations(free), key=lambda found: found.fall)
    fall = 0.5 * damping / 300.0
    assert along.fall == pytest.approx(fall, rel=1e-3)
    assert along.time == pytest.approx(1.0 / math.sqrt(stiffness / 300.0 - fall**2), rel=1e-3)
    assert across.fall == pytest.approx(0.0, abs=1e-6)
    assert across.time == pytest.approx(math.sqrt(300.0 * (GAP + free.load / stiffness) / free.load), rel=1e-3)


def test_the_last_of_three_runs_leaves_what_rings() -> None:
    scene = narrow()
    contacts = [found for contact in loaded_contacts(scene) for found in vibrations(contact)]
    step = 0.25 * ringing_step(scene)
    lost = [
        min(scene.duration, GONE / found.fall)
        / found.time
        * numerical_damping(step / found.time, scene.solver.spectral_radius)
        for found in contacts
    ]
    assert max(lost) == pytest.approx(KEPT, rel=1e-3)
    # what the steps damp less may have longer ones, and what has longer to last has shorter ones
    less = replace(scene, solver=SolverSettings(spectral_radius=0.9))
    assert ringing_step(less) > 3.0 * ringing_step(scene)
    assert ringing_step(replace(scene, duration=0.1)) > 2.0 * ringing_step(scene)


@pytest.mark.slow
def test_what_is_left_of_a_fall_rings_as_told() -> None:
    scene = replace(narrow(duration=2.4), formulation="compiled")
    found = max(vibrations(loaded_contacts(scene)[0]), key=lambda one: 1.0 / one.time)
    result = simulate(scene)
    time, force = result.time, result[f"pin.{RINGING}.force"]
    sizes = [float(np.ptp(force[(time > t - 0.05) & (time <= t)])) for t in (1.6, 2.4)]
    # steps are for the least damping that the law may have; it falls as one over the impact velocity
    expected = found.fall * FASTEST / REST_VELOCITY
    assert math.log(sizes[0] / sizes[1]) / 0.8 == pytest.approx(expected, rel=0.1)
    kept = simulate(replace(scene, formulation="exudyn", step=0.25 * ringing_step(scene)))[
        f"pin.{RINGING}.force"
    ]
    size = float(np.ptp(kept[(time > 2.35) & (time <= 2.4)]))
    assert 0.5 * math.exp(-KEPT) * sizes[1] < size < 1.1 * sizes[1]
