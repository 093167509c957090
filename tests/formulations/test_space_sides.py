"""Left and right, roll and yaw: front columns driven apart, in the channels that tell the sides apart."""

from __future__ import annotations

import numpy as np
import pytest

from studies.common.paper_machine import CLEARANCE_PIN, clearance_rise, oil_columns
from support_exudyn import CubicStep, Held, Result, Scenario, SolverSettings, simulate

LENGTH = 0.7  # of the rear pin, reference support [m]


@pytest.fixture(scope="module")
def run() -> Result:
    """The right front column lifts, the left one stays."""
    case = clearance_rise(1.5, 0.25, 1e-3)
    return simulate(
        Scenario(
            machine=case.machine,
            pins=case.pins,
            actuators=oil_columns(),
            drive=Held(),
            drives={"front_column_right": CubicStep(start=0.01, end=0.2, stroke=4e-3)},
            duration=0.25,
            dimensions=3,
            start="settled",
            step=1e-3,
            solver=SolverSettings(impact_steps=64),
        )
    )


def test_the_right_side_goes_up(run: Result) -> None:
    assert (run["tip_left.z"][0], run["tip_right.z"][0]) == pytest.approx((-0.57, 0.57), abs=1e-14)
    assert run["tip_right.y"][-1] - run["tip_left.y"][-1] > 1e-4
    assert run["canopy.roll"][-1] < 0.0
    # both points are 1.14 m apart across: their difference in height is that times the sine of the roll
    apart = run["tip_right.y"] - run["tip_left.y"]
    roll, yaw = run["canopy.roll"], run["canopy.yaw"]
    turns = np.abs(yaw).max() + np.abs(run["canopy.angle"] - run["canopy.angle"][0]).max()
    # of second order: products of the turns
    np.testing.assert_allclose(apart, -1.14 * np.sin(roll), atol=1.14 * np.abs(roll).max() * turns)
    assert turns < 0.01
    assert run["front_column_right.force"][-1] > run["front_column_left.force"][-1] + 1e3
    assert run["front_column_right.length"][-1] > run["front_column_left.length"][-1] + 1e-5
    # with 64 steps an impact, as in the plane
    assert run.energy_error < 1e-3 * run.dissipated


def test_yaw_to_the_left_takes_the_tip_to_the_left(run: Result) -> None:
    roll, yaw, beside = run["canopy.roll"][-1], run["canopy.yaw"][-1], run["tip.z"][-1] - run["canopy.z"][-1]
    assert abs(yaw) > 1e-5
    # theta x r: the tip is that far in front of the centre of mass, and that much above it, which rolls
    ahead, above = run["tip.x"][-1] - run["canopy.x"][-1], run["tip.y"][-1] - run["canopy.y"][-1]
    second = ahead * yaw**2 + abs(ahead * yaw * (run["canopy.angle"][-1] - run["canopy.angle"][0]))
    assert beside == pytest.approx(roll * above - yaw * ahead, abs=3.0 * second)  # of second order


def test_edges_of_the_pin_are_on_their_sides(run: Result) -> None:
    left, right = (
        np.array([run[f"pin.{CLEARANCE_PIN}.{side}_eccentricity_{axis}"] for axis in ("x", "y")])
        for side in ("left", "right")
    )
    # theta x r at both edges, z = -L/2 and L/2
    turned = LENGTH * np.array([-run["rear_link.yaw"], run["rear_link.roll"]])
    largest = np.abs(turned).max()
    assert largest > 1e-4
    # of second order: products of the turns
    in_plane = np.abs(run["rear_link.angle"] - run["rear_link.angle"][0]).max()
    turns = in_plane + largest / LENGTH
    np.testing.assert_allclose(left - right, turned, atol=turns * largest)
    assert turns < 0.01
    clearance = 1.5e-3
    for side, place in (("left", left), ("right", right)):
        depth = run[f"pin.{CLEARANCE_PIN}.{side}_depth"]
        np.testing.assert_allclose(depth, np.hypot(*place) - clearance, atol=1e-15)
    # the deepest edge is one of both, or between them
    deepest = np.maximum(run[f"pin.{CLEARANCE_PIN}.left_depth"], run[f"pin.{CLEARANCE_PIN}.right_depth"])
    assert (run[f"pin.{CLEARANCE_PIN}.depth"] >= deepest).all()
