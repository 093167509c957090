"""Friction that sticks, at the default step: steps follow the swings of what it holds."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    Scenario,
    SolverSettings,
    simulate,
)
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from tests.cases.run_cases import FORCE, PIN, paper_contact, support
from user_forces import FrictionLaw, LuGre

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
