"""Friction that sticks or is steep, at the default step: steps follow what it holds, or the run is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Failure,
    Held,
    Result,
    Scenario,
    SolverSettings,
    simulate,
)
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from tests.cases.run_cases import FORCE, PIN, paper_contact, support
from user_forces import Ambrosio, FrictionLaw, LuGre

LUGRE = LuGre(static_coefficient=0.3125, sliding_coefficient=0.25)
SHAKING = ("energy.*", FORCE)


def scene(friction: FrictionLaw = LUGRE, **changes: object) -> Scenario:
    """A support that waits, and begins to rise: its pin sticks and slips."""
    contact = paper_contact(1.5, 0.25)
    normal = replace(contact.normal)
    pin = ClearancePin(contact=replace(contact, normal=normal, friction=friction))
    fields: dict[str, object] = {
        "pins": {PIN: pin},
        "drive": CubicStep(start=0.05, end=0.55, stroke=0.05),
        "duration": 0.42,
        "start": "settled",
        "solver": SolverSettings(impact_steps=128),
        "channels": SHAKING,
    }
    return support(**fields | changes)


def test_losses_at_the_default_step_are_those_of_fine_steps() -> None:
    # of fine steps, which change no number in its fourth digit any more
    plain, fine = (simulate(scene(**step)) for step in ({}, {"step": 4e-5}))
    for what in ("energy.friction_loss", "energy.damping_loss"):
        # measured 2e-3 and 4e-3; 4e-2 and 5e-2 where steps do not follow the bristles
        assert plain[what][-1] == pytest.approx(fine[what][-1], rel=1e-2)
    # of the shaking, measured 4e-3; without, 6e-2
    assert np.std(plain[FORCE]) == pytest.approx(np.std(fine[FORCE]), rel=1e-2)


def test_steps_follow_the_swing_and_halve_with_those_of_impacts() -> None:
    numbers = (64, 128, 256)
    counts = [
        simulate(scene(duration=0.1, solver=SolverSettings(impact_steps=number))).counts.steps
        for number in numbers
    ]
    # the pin rests on its bristles all the time; what does not double is after the break
    assert counts[2] - counts[1] == pytest.approx(2 * (counts[1] - counts[0]), rel=0.05)
    model = build(scene())
    alone = model.clearance_joints[PIN].find_inverse_mass()
    model.release()
    load = 58779.0  # of the ideal pin at rest [N]
    lightest = 2.0 / (alone.xx + alone.yy + math.hypot(alone.xx - alone.yy, 2.0 * alone.xy))
    longest = math.pi * math.sqrt(lightest / (LUGRE.bristle_stiffness * load)) / 4.0  # of 128 steps an impact
    # steps are rounded down to a power of two
    assert 0.3 * longest < 0.1 / (counts[2] - counts[1]) < 1.5 * longest


@pytest.mark.parametrize("name", [PIN, "front_base"])
def test_sections_in_space_are_stepped_like_the_pin_of_the_plane(name: str) -> None:
    held = scene(duration=0.01, drive=Held())
    held = replace(held, pins={name: held.pins[PIN]})
    plane, space = (simulate(replace(held, dimensions=number)).counts.steps for number in (2, 3))
    assert plane > 4 * 0.01 / 5e-4
    # the pin's weight on the sections of a bearing, or of two; one or two steps at the start
    assert space == pytest.approx(plane, rel=0.05)


# --- steeper than steps can follow ---


STEEP = 4e-6  # [m/s], ramp of friction; 40 kN on 1 t cross it in 0.1 us
STEEPER = 1e-8
UNSOLVABLE = 1e-12  # crossed by rounding


def held(ramp: float) -> Scenario:
    """The held support falls through its clearance rear pin, whose friction has a ramp so wide [m/s]."""
    contact = paper_contact(1.5, 0.0)
    friction = Ambrosio(sliding_coefficient=1.2, static_speed=1e-4, dynamic_speed=1e-4 + ramp)
    pin = ClearancePin(contact=replace(contact, friction=friction))
    return support(pins={PIN: pin}, drive=Held(), duration=0.05)


@pytest.fixture(scope="module")
def steep() -> Result:
    return simulate(held(STEEP))


def test_steep_friction_costs_few_failures(steep: Result) -> None:
    assert len(steep.onsets[PIN]) == 2  # one impact and the beginning of rest: there is something to solve
    # measured 4 failures in 1450 steps; where every step tried its whole length again there were 219470
    assert steep.counts.failed_newton < 40
    assert steep.counts.steps < 5000


def test_energy_adds_up_under_steep_friction(steep: Result) -> None:
    assert steep["energy.friction_loss"][-1] > 1.0  # it is rubbed off, too
    # a step may cross the ramp: measured 4e-4 of what is lost
    assert steep.energy_error < 5e-3 * steep.dissipated


def test_the_compiled_formulation_finds_the_same(steep: Result) -> None:
    # a ramp a hundred times as wide, which it needs fewer steps for, loses the same to 1 %
    wide = simulate(replace(held(100.0 * STEEP), formulation="compiled"))
    assert steep.dissipated == pytest.approx(wide.dissipated, rel=0.01)
    first, theirs = steep.onsets[PIN][0], wide.onsets[PIN][0]
    assert first[:2] == pytest.approx(theirs[:2], rel=1e-6)  # the fall before any contact
    assert first.separation_velocity == pytest.approx(theirs.separation_velocity, rel=1e-2)


def test_a_ramp_that_no_step_can_follow_rubs_as_a_wider_one(steep: Result) -> None:
    steeper = simulate(held(STEEPER))
    assert steeper.counts.failed_newton < 40  # measured: 1
    assert steeper.counts.steps < 5000
    assert steeper.energy_error < 5e-3 * steeper.dissipated
    assert steeper.dissipated == pytest.approx(steep.dissipated, rel=1e-3)
    # the pin creeps on the ramp: its friction is that of the law, and no more than holds it
    slip, force = (steeper[f"pin.{PIN}.{name}"] for name in ("slip", "friction_force"))
    creeping = (np.abs(slip) > 1e-4) & (np.abs(slip) < 1e-4 + STEEPER) & (steeper[f"pin.{PIN}.depth"] > 0.0)
    assert creeping.sum() > 5
    normal = steeper[f"pin.{PIN}.normal_force"][creeping]
    wanted = 1.2 * (np.abs(slip[creeping]) - 1e-4) / STEEPER * normal
    np.testing.assert_allclose(np.abs(force[creeping]), wanted, rtol=1e-6)


@pytest.mark.slow  # it tries for long
def test_friction_that_no_step_can_follow_is_refused_with_the_reason() -> None:
    failure = simulate(held(UNSOLVABLE), throw=False)
    assert isinstance(failure, Failure)
    assert "friction" in failure.advice
    assert "Widen the ramp" in failure.advice
    assert 0.0174 < failure.time < 0.05  # from the first impact on
