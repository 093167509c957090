"""The support in space: moved alike on both sides as in its plane, and driven apart."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from studies.common.paper_machine import CLEARANCE_PIN, JACK, clearance_rise, oil_columns
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    OwnBody,
    Result,
    Scenario,
    SolverSettings,
    UniformSpeed,
    simulate,
)
from tests.cases.run_cases import loose_support, paper_contact, support

RISE = CubicStep(start=0.02, end=0.2, stroke=0.03)
PLACES = (".z", ".roll", ".yaw")
RATES = (".velocity_z", ".angular_velocity_x", ".angular_velocity_y")


def with_clearance(friction: float, **pins: float) -> dict[str, ClearancePin]:
    return {name: ClearancePin(contact=paper_contact(c, friction)) for name, c in pins.items()}


CASES: dict[str, Scenario] = {
    "ideal": support(drive=RISE, duration=0.25),
    "friction": loose_support(1.5, 0.25, drive=Held(), duration=0.1),
    "oil": loose_support(drive=RISE, duration=0.1, actuators=oil_columns()),
    "tail": support(drive=RISE, duration=0.1, actuators=oil_columns(), parts={"tail_beam": OwnBody(jack=JACK)}),
    "uniform": support(drive=UniformSpeed(start=0.02, end=0.1, stroke=0.01), duration=0.15),
    "uniform, loose": loose_support(drive=UniformSpeed(start=0.02, end=0.1, stroke=0.01), duration=0.05),
    "settled": loose_support(drive=RISE, duration=0.05, start="settled"),
    "both of a pair": support(
        drive=Held(), duration=0.03, pins=with_clearance(0.1, front_base=1.0, front_shield=1.5)
    ),
}


@cache
def both(case: str) -> tuple[Result, Result]:
    """A case in the plane and in space."""
    return simulate(CASES[case]), simulate(replace(CASES[case], dimensions=3))


def in_space(result: Result, planar: str) -> list[str]:
    """Names in space of what a channel of the plane shows."""
    head, _, tail = planar.partition(".")
    names = [planar, f"{head}_left.{tail}", f"{head}_right.{tail}"]
    return [name for name in names if name in result.channels]


@pytest.mark.parametrize("case", CASES)
def test_what_moves_alike_on_both_sides_moves_as_in_the_plane(case: str) -> None:
    plane, space = both(case)
    where = [f"{body}.angle" for body in plane.scenario.linkage.bodies]
    where += [f"{name}.{axis}" for name in ("tip", *plane.scenario.linkage.bodies) for axis in ("x", "y")]
    for name in where:
        found = in_space(space, name)
        assert found, name
        for one in found:
            # asked for; measured 7e-11, with clearance pins of a pair 3e-9: each impact multiplies rounding
            np.testing.assert_allclose(space[one], plane[name], rtol=0.0, atol=1e-6, err_msg=one)
    for name in space.channels:
        still = space[name][0] if name.endswith(".z") else 0.0
        if name.endswith(PLACES):  # Newton's tolerance; measured 2e-12 on oil, 1e-15 else
            np.testing.assert_allclose(space[name], still, rtol=0.0, atol=1e-9, err_msg=name)
        if name.endswith(RATES):  # as above; measured 1e-7
            np.testing.assert_allclose(space[name], 0.0, atol=2e-6, err_msg=name)
    for pin in plane.scenario.linkage.pins:
        for part in ("force_x", "force_y"):
            name = f"pin.{pin}.{part}"
            largest = np.abs(plane[f"pin.{pin}.force"]).max()
            off = np.abs(space[name] - plane[name])
            # multipliers of the plane overshoot in steps after a kink of the drive, reactions in space follow
            # from accelerations: measured 4e-3 of the largest at worst, with both pins of a pair loose, else
            # 3e-4; 6e-6 in the median, else 3e-7
            assert off.max() < 2e-2 * largest, name
            assert np.median(off) < 5e-5 * largest, name
            sides = [f"pin.{pin}_{side}.{part}" for side in ("left", "right")]
            if sides[0] in space.channels:  # half each; measured 3e-4 in an impact
                for side in sides:
                    np.testing.assert_allclose(
                        space[side], 0.5 * space[name], atol=3e-3 * largest, err_msg=side
                    )
    for pin, onsets in plane.onsets.items():
        for name in (pin, f"{pin}_left", f"{pin}_right"):
            if name in space.onsets:
                assert len(space.onsets[name]) == len(onsets)
                for one, other in zip(space.onsets[name], onsets, strict=True):
                    assert one.time == pytest.approx(other.time, abs=1e-7)  # measured 5e-9
                    assert one.speed == pytest.approx(other.speed, abs=1e-6)  # measured 2e-8


@pytest.mark.parametrize("case", ["uniform", "uniform, loose"])
def test_impulses_of_both_actuators_add_up(case: str) -> None:
    plane, space = both(case)
    assert len(plane.impulses) == len(space.impulses) > 0
    for one, other in zip(space.impulses, plane.impulses, strict=True):
        assert one.time == other.time
        # same matrices, other elimination; loose: after an impact or two
        assert one.energy == pytest.approx(other.energy, rel=1e-6)
        for name, impulse in other.actuators.items():
            sides = one.actuators[f"{name}_left"], one.actuators[f"{name}_right"]
            assert sum(sides) == pytest.approx(impulse, rel=1e-6)
            assert sides[0] == pytest.approx(sides[1], rel=1e-5)  # solved with a small lift; 2e-7


# --- front columns driven apart ---


LENGTH = 0.7  # of the rear pin, reference support [m]


@pytest.fixture(scope="module")
def tilted() -> Result:
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


def test_the_right_side_goes_up(tilted: Result) -> None:
    assert (tilted["tip_left.z"][0], tilted["tip_right.z"][0]) == pytest.approx((-0.57, 0.57), abs=1e-14)
    assert tilted["tip_right.y"][-1] - tilted["tip_left.y"][-1] > 1e-4
    assert tilted["canopy.roll"][-1] < 0.0
    # both points are 1.14 m apart across: their difference in height is that times the sine of the roll
    apart = tilted["tip_right.y"] - tilted["tip_left.y"]
    roll, yaw = tilted["canopy.roll"], tilted["canopy.yaw"]
    turns = np.abs(yaw).max() + np.abs(tilted["canopy.angle"] - tilted["canopy.angle"][0]).max()
    # of second order: products of the turns
    np.testing.assert_allclose(apart, -1.14 * np.sin(roll), atol=1.14 * np.abs(roll).max() * turns)
    assert turns < 0.01
    assert tilted["front_column_right.force"][-1] > tilted["front_column_left.force"][-1] + 1e3
    assert tilted["front_column_right.length"][-1] > tilted["front_column_left.length"][-1] + 1e-5
    # with 64 steps an impact, as in the plane
    assert tilted.energy_error < 1e-3 * tilted.dissipated


def test_edges_of_the_pin_are_on_their_sides(tilted: Result) -> None:
    left, right = (
        np.array([tilted[f"pin.{CLEARANCE_PIN}.{side}_eccentricity_{axis}"] for axis in ("x", "y")])
        for side in ("left", "right")
    )
    # theta x r at both edges, z = -L/2 and L/2
    turned = LENGTH * np.array([-tilted["rear_link.yaw"], tilted["rear_link.roll"]])
    largest = np.abs(turned).max()
    assert largest > 1e-4
    # of second order: products of the turns
    in_plane = np.abs(tilted["rear_link.angle"] - tilted["rear_link.angle"][0]).max()
    turns = in_plane + largest / LENGTH
    np.testing.assert_allclose(left - right, turned, atol=turns * largest)
    assert turns < 0.01
    clearance = 1.5e-3
    for side, place in (("left", left), ("right", right)):
        depth = tilted[f"pin.{CLEARANCE_PIN}.{side}_depth"]
        np.testing.assert_allclose(depth, np.hypot(*place) - clearance, atol=1e-15)
    # the deepest edge is one of both, or between them
    deepest = np.maximum(tilted[f"pin.{CLEARANCE_PIN}.left_depth"], tilted[f"pin.{CLEARANCE_PIN}.right_depth"])
    assert (tilted[f"pin.{CLEARANCE_PIN}.depth"] >= deepest).all()
