"""Joint forces and accelerations of Exudyn runs from their motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import (
    CubicStep,
    Drive,
    Held,
    Reciprocating,
    Scenario,
    SolverSettings,
    cylinders_and_rods,
    simulate,
)
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.constraints import constraints_of, turning
from support_exudyn.mechanics.kinetics import kinetics_of
from tests.cases.run_cases import loose_support, support

STROKE = CubicStep(stroke=0.05, start=0.02, end=0.2)


def heavy() -> Scenario:
    """With guides between bodies that turn."""
    return support(actuators=cylinders_and_rods(), duration=0.1)


def test_rows_turn_as_their_bodies_move() -> None:
    linkage = heavy().linkage
    random = np.random.default_rng(1)
    position, velocity = random.normal(scale=0.3, size=(2, 4, 3 * len(linkage.bodies)))
    motion = BodyMotion(linkage, position, velocity)
    kinetics, h = kinetics_of(linkage), 1e-6
    later, earlier = (
        np.array([kinetics.rows(q + s * h * v) for q, v in zip(position, velocity, strict=True)])
        for s in (1, -1)
    )
    changed = np.einsum("nrk,nk->nr", later - earlier, velocity) / (2.0 * h)
    np.testing.assert_allclose(turning(motion, constraints_of(linkage)), changed, atol=1e-7)


@pytest.mark.parametrize("drive", [STROKE, Reciprocating(stroke=0.02, period=0.1)])
def test_forces_are_those_of_free_coordinates_also_after_a_break(drive: Drive) -> None:
    scene = support(duration=0.1, drive=drive, step=1e-3)
    mine, other = simulate(scene), simulate(replace(scene, formulation="compiled"))
    for name in mine.channels:
        if name.endswith(".force"):
            # measured: 3e-6. Multipliers overshoot in the first steps after a jump of the drive's acceleration
            np.testing.assert_allclose(
                mine[name], other[name], atol=1e-5 * np.abs(other[name]).max(), rtol=0.0, err_msg=name
            )


@pytest.mark.parametrize("actuators", [{}, oil_columns(), cylinders_and_rods()])
def test_short_steps_show_no_rounding_in_forces(actuators: dict) -> None:  # type: ignore[type-arg]
    # the journal falls freely: nothing shakes. Multipliers scatter by 1e5 N at this step
    scene = loose_support(duration=1e-3, drive=Held(), step=5e-7, record_period=1e-4, actuators=actuators)
    result = simulate(replace(scene, solver=SolverSettings(impact_steps=64)))
    for name in ("pin.front_base.force", "pin.shield_canopy.force", "canopy.angular_acceleration"):
        values = result[name]
        smooth = np.polyval(np.polyfit(result.time, values, 4), result.time)
        assert np.abs(values - smooth).max() < 1e-5 * np.abs(values).max(), name
