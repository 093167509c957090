"""Inclinometers feel gravity and acceleration, in the plane and in space."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn import CubicStep, Result, Scenario, machine, reference_support, simulate
from support_exudyn.postprocessing.instruments.sensors import Inclinometer, specific_force
from support_exudyn.postprocessing.instruments.station import MeasuringStation, measure
from tests import synthetic

G = 9.81
PERIOD = 1e-3
TIME = np.arange(401) * PERIOD
PLANE = Scenario(machine=reference_support(), duration=1.0, record_period=PERIOD)
SPACE = Scenario(machine=machine("reference"), duration=1.0, dimensions=3)
ANGLES = st.floats(-3.0, 3.0)


def tilt(result: Result, **chosen: object) -> np.ndarray:
    station = MeasuringStation(instruments={"t": Inclinometer(rate=1.0 / PERIOD, **chosen)})
    return measure(result, station)["t"].values


def turning(angle: np.ndarray, spin: np.ndarray, pivot: tuple[float, float]) -> Result:
    """A run in which the rear link turns about a point that stands still, given from its centre of mass."""
    x, y = pivot
    turn = angle - PLANE.linkage.bodies["rear_link"].angle
    arm = np.array([np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y])
    channels = {"angle": (angle, "rad"), "angular_velocity": (spin, "rad/s")}
    channels |= {"velocity_x": (spin * arm[1], "m/s"), "velocity_y": (-spin * arm[0], "m/s")}
    channels |= {axis: (np.zeros(TIME.size), "m") for axis in "xy"}  # which an inclinometer does not feel
    return synthetic.result(PLANE, TIME, {f"rear_link.{name}": one for name, one in channels.items()})


@given(angle=ANGLES)
def test_at_rest_the_tilt_is_the_angle(angle: float) -> None:
    still = np.zeros(TIME.size)
    found = tilt(turning(still + angle, still, (0.3, 0.2)), body="rear_link", at="rear_shield")
    np.testing.assert_allclose(found, angle, rtol=0.0, atol=1e-15 * (1.0 + 8.0 * abs(angle)))


@given(start=ANGLES, rate=st.floats(-20.0, 20.0), x=st.floats(-2.0, 2.0), y=st.floats(-2.0, 2.0))
def test_at_a_constant_rate_gravity_and_the_centripetal_acceleration_are_felt(
    start: float, rate: float, x: float, y: float
) -> None:
    angle = start + rate * TIME
    run = turning(angle, np.full(TIME.size, rate), (x, y))
    found = specific_force(run, "rear_link", "rear_shield")
    # in the body's axes: the place is carried round its pivot, towards which it is accelerated
    body = PLANE.linkage.bodies["rear_link"]
    arm = np.subtract(PLANE.linkage.pins["rear_shield"].first_point, body.centre) - (x, y)
    c, s = math.cos(body.angle), math.sin(body.angle)
    away = np.array([c * arm[0] + s * arm[1], c * arm[1] - s * arm[0]])
    # differences over two records make a wave smaller, by just so much
    smaller = np.sinc(rate * PERIOD / math.pi)
    exact = np.stack([-G * np.sin(angle), -G * np.cos(angle)], axis=-1) + smaller * rate**2 * away
    np.testing.assert_allclose(found[1:-1, :2], exact[1:-1], atol=1e-9 * (1.0 + rate**2))
    assert abs(smaller - 1.0) <= (rate * PERIOD) ** 2 / 6.0 + 1e-15  # the error that the module states
    np.testing.assert_array_equal(found[:, 2], 0.0)


def test_an_acceleration_that_grows_evenly_is_felt_exactly_to_both_ends() -> None:
    still = np.zeros(TIME.size)
    channels = {"angle": still, "angular_velocity": still, "velocity_x": 4.0 * TIME**2, "velocity_y": still}
    channels |= {"x": still, "y": still}
    run = synthetic.result(PLANE, TIME, {f"canopy.{name}": (one, "") for name, one in channels.items()})
    np.testing.assert_allclose(specific_force(run, "canopy")[:, 0], -8.0 * TIME, atol=1e-11)


def test_a_run_at_rest_reads_as_its_angles_and_a_base_as_none() -> None:
    result = simulate(replace(PLANE, duration=0.05, drive=CubicStep(start=1.0, end=2.0)))
    for body in PLANE.linkage.bodies:
        np.testing.assert_allclose(tilt(result, body=body), result[f"{body}.angle"], atol=1e-7)
    np.testing.assert_array_equal(tilt(result, body="ground"), 0.0)


def test_an_inclinometer_errs_in_motion_as_far_as_its_place_is_accelerated() -> None:
    rise = CubicStep(stroke=0.2, start=0.0, end=0.5)
    result = simulate(replace(PLANE, drive=rise, duration=0.5, step=5e-4))
    x, y = (np.gradient(np.gradient(result[f"tip.{axis}"], PERIOD), PERIOD) for axis in "xy")
    level = result["canopy.angle"]
    # the same by another way: places differenced twice
    exact = np.arctan2(x * np.cos(level) + (G + y) * np.sin(level), (G + y) * np.cos(level) - x * np.sin(level))
    inner = slice(3, -3)
    np.testing.assert_allclose(tilt(result, body="canopy", at="tip")[inner], exact[inner], atol=2e-5)
    assert np.abs(exact - level)[inner].max() > 0.02


# --- in space ---


def spatial(turn: Rotation, spin: np.ndarray, pivot: np.ndarray) -> Result:
    """A run in space in which the canopy turns about a point that stands still, given from its centre."""
    matrix = turn.as_matrix()
    start = SPACE.space.bodies["canopy"].angle
    channels = {
        "angle": (start + np.unwrap(np.arctan2(matrix[:, 1, 0], matrix[:, 0, 0])), "rad"),
        "roll": (np.unwrap(np.arctan2(matrix[:, 2, 1], matrix[:, 1, 1])), "rad"),
        "yaw": (np.unwrap(np.arctan2(matrix[:, 0, 2], matrix[:, 2, 2])), "rad"),
        "angular_velocity_x": (spin[:, 0], "rad/s"),
        "angular_velocity_y": (spin[:, 1], "rad/s"),
        "angular_velocity": (spin[:, 2], "rad/s"),
    }
    velocity = -np.cross(spin, matrix @ pivot)
    channels |= {f"velocity_{axis}": (velocity[:, n], "m/s") for n, axis in enumerate("xyz")}
    channels |= {axis: (np.zeros(TIME.size), "m") for axis in "xyz"}
    return synthetic.result(SPACE, TIME, {f"canopy.{name}": one for name, one in channels.items()})


@given(roll=st.floats(-0.6, 0.6), angle=st.floats(-0.6, 0.6))
def test_at_rest_in_space_both_tilts_are_those_of_the_body(roll: float, angle: float) -> None:
    turn = Rotation.from_euler("ZX", np.tile([angle, roll], (TIME.size, 1)))
    run = spatial(turn, np.zeros((TIME.size, 3)), np.zeros(3))
    axes = turn.as_matrix()[0]
    found = tilt(run, body="canopy", direction="sideways")
    np.testing.assert_allclose(found, math.asin(axes[1, 2] * -1.0), atol=1e-10)  # how far its z axis dips
    if roll == 0.0:
        np.testing.assert_allclose(tilt(run, body="canopy"), angle, atol=1e-10)


def test_in_space_a_constant_rate_is_felt_as_its_closed_form() -> None:
    rate, pivot = np.array([0.4, -0.3, 0.8]), np.array([0.5, -0.2, 0.6])
    turn = Rotation.from_rotvec(rate * TIME[:, None])
    run = spatial(turn, np.tile(rate, (TIME.size, 1)), pivot)
    place = np.subtract(SPACE.space.points["tip"].point, SPACE.space.bodies["canopy"].centre)
    arm = turn.apply(place - pivot)
    exact = turn.inv().apply([0.0, -G, 0.0] - np.cross(rate, np.cross(rate, arm)))
    start = SPACE.space.bodies["canopy"].angle
    assert start == 0.0  # its axes are those of the start
    np.testing.assert_allclose(specific_force(run, "canopy", "tip")[1:-1], exact[1:-1], atol=1e-6)
