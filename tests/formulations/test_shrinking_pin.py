"""A clearance pin that shrinks to a micrometre tends to the ideal pin."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import ClearancePin, CubicStep, Result, SolverSettings, simulate
from tests.cases.run_cases import FORCE, PIN, support
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    Exact,
    JournalBearing,
    JournalContact,
    internal_contact_stiffness,
)

CLEARANCES = np.array([1e-3, 1e-4, 1e-5, 1e-6])  # [m]
RISE = {"drive": CubicStep(start=0.0, end=2.0), "duration": 1.0, "step": 1e-3}


def rise(clearance: float) -> Result:
    """From static equilibrium; little restitution, so that the start of the drive leaves no vibration."""
    bearing = JournalBearing(bore_radius=0.0655, clearance=clearance)
    law = Exact(stiffness=internal_contact_stiffness(bearing, STEEL, STEEL_35CRMO), restitution=0.1)
    pin = ClearancePin(contact=JournalContact(bearing=bearing, normal=law))
    return simulate(support(pins={PIN: pin}, start="settled", solver=SolverSettings(impact_steps=64), **RISE))


@pytest.fixture(scope="module")
def ideal() -> Result:
    return simulate(support(**RISE))


@pytest.fixture(scope="module")
def with_clearance() -> list[Result]:
    return [rise(clearance) for clearance in CLEARANCES]


def eccentricity(with_clearance: list[Result]) -> np.ndarray:
    """Mean distance of the journal's centre from the bore's [m]: clearance and depth of contact."""
    depth = np.array([result[f"pin.{PIN}.depth"].mean() for result in with_clearance])
    return CLEARANCES + depth


def orders(errors: np.ndarray, size: np.ndarray) -> np.ndarray:
    return np.diff(np.log(errors)) / np.diff(np.log(size))


def _rms(result: Result, ideal: Result, inside: np.ndarray) -> float:
    apart = [(result[f"{FORCE}_{axis}"] - ideal[f"{FORCE}_{axis}"])[inside] for axis in "xy"]
    return float(np.sqrt(np.mean(apart[0] ** 2 + apart[1] ** 2)))


def test_the_pin_stays_closed(with_clearance: list[Result]) -> None:
    for result in with_clearance:
        assert result.onsets[PIN] == ()
        assert result.counts.failed_newton == 0
        assert result[f"pin.{PIN}.depth"].min() > 0.0


def test_depth_shrinks_with_the_cube_root_of_the_clearance(with_clearance: list[Result]) -> None:
    # internal contact: K ~ c^-1/2 and depth = (F/K)^(2/3), so depth ~ c^(1/3); R1 = R2 - c bends it by c/R2
    depth = eccentricity(with_clearance) - CLEARANCES
    np.testing.assert_allclose(orders(depth, CLEARANCES), 1.0 / 3.0, atol=0.01)


def test_force_tends_to_that_of_the_ideal_pin_with_first_order(
    ideal: Result, with_clearance: list[Result]
) -> None:
    inside = ideal.time > 0.1  # behind the jump of the drive's acceleration
    errors = np.array([_rms(result, ideal, inside) for result in with_clearance])
    # linear in where the journal stands; the depth is not the same throughout, hence the margin
    np.testing.assert_allclose(orders(errors, eccentricity(with_clearance)), 1.0, atol=0.02)
    assert errors[-1] < 2e-5 * ideal[FORCE].max()  # 1 um


def test_motion_tends_to_that_of_the_ideal_pin_with_first_order(
    ideal: Result, with_clearance: list[Result]
) -> None:
    errors = np.array(
        [
            np.hypot(result["tip.x"] - ideal["tip.x"], result["tip.y"] - ideal["tip.y"]).max()
            for result in with_clearance
        ]
    )
    np.testing.assert_allclose(orders(errors, eccentricity(with_clearance)), 1.0, atol=0.05)
    # the lever of the tip against the pin is 2.6
    assert errors[-1] < 3.0 * (1e-6 + 3.1e-6)
