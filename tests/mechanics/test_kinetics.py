"""Masses that impacts feel, and velocities after jumps, against rigid-body formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn import (
    Body,
    ClearancePin,
    Crank,
    Gear,
    LinearActuator,
    Linkage,
    PinPlace,
    Scenario,
    Slide,
    SliderCrank,
)
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.model.linkage import GROUND, pinned
from tests.cases.run_cases import Pair, slider_crank_contact
from tests.often import often
from user_forces.contact_state import HEAVIEST, InverseMass
from user_forces.values.value import Vector2

sometimes = settings(deadline=None, max_examples=often(40))

coordinates = st.floats(-1.0, 1.0)
points = st.tuples(coordinates, coordinates)
masses = st.floats(0.1, 1e3)
inertias = st.floats(0.01, 1e3)
angles = st.floats(-math.pi, math.pi)


def unit(angle: float) -> np.ndarray:
    return np.array([math.cos(angle), math.sin(angle)])


def cross(a: np.ndarray, b: np.ndarray) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def kinetics(linkage: Linkage, *with_clearance: str) -> Kinetics:
    """Of a linkage in which these pins have clearance, without the engine."""
    return kinetics_of(linkage, [name for name in linkage.pins if name not in with_clearance])


def inverse_mass(system: Kinetics, position: np.ndarray, name: str) -> np.ndarray:
    """Answer of a pin's eccentricity to impulses in it [1/kg]."""
    return system.inverse_mass(position, system.relative(position, system.linkage.pins[name])[1])


def pin_mass(system: Kinetics, position: np.ndarray, name: str, angle: float) -> float:
    """Mass [kg] that an impact in a pin feels along a direction of space."""
    matrix = inverse_mass(system, position, name)
    # how the eccentricity answers an impulse is the same either way (Maxwell); rounding of the larger entries
    assert matrix[0, 1] == pytest.approx(matrix[1, 0], abs=1e-9 * np.abs(matrix).max())
    return InverseMass.of(matrix).mass(1e-3 * math.cos(angle), 1e-3 * math.sin(angle))


def free_pair(one: Body, two: Body, one_point: Vector2, two_point: Vector2) -> Kinetics:
    machine = Pair(one=one, two=two, one_point=one_point, two_point=two_point)
    return kinetics(machine.linkage(), "pin")


# --- two free bodies ---


@sometimes
@given(
    mass=st.tuples(masses, masses),
    inertia=st.tuples(inertias, inertias),
    centres=st.tuples(points, points),
    pins=st.tuples(points, points),
    start_angles=st.tuples(angles, angles),
    moved=st.tuples(points, points),
    turned=st.tuples(angles, angles),
    direction=angles,
)
def test_any_contact_of_two_free_bodies_feels_the_mass_of_the_rigid_body_formula(
    mass: tuple[float, float],
    inertia: tuple[float, float],
    centres: tuple[Vector2, Vector2],
    pins: tuple[Vector2, Vector2],
    start_angles: tuple[float, float],
    moved: tuple[Vector2, Vector2],
    turned: tuple[float, float],
    direction: float,
) -> None:
    bodies = [
        Body(mass=m, inertia=i, centre=c, angle=a)
        for m, i, c, a in zip(mass, inertia, centres, start_angles, strict=True)
    ]
    position = np.array([*moved[0], turned[0], *moved[1], turned[1]])
    n = unit(direction)
    inverse_mass = 0.0
    for m, i, centre, pin, turn in zip(mass, inertia, centres, pins, turned, strict=True):
        x, y = np.subtract(pin, centre)
        arm = np.array(
            [x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)]
        )  # turned with its body; where the body has moved to does not matter
        inverse_mass += 1.0 / m + cross(arm, n) ** 2 / i
    got = pin_mass(free_pair(*bodies, *pins), position, "pin", direction)
    # rounding; inverse effective masses in other directions are up to 800/kg, this one is 0.002/kg or more
    assert got == pytest.approx(1.0 / inverse_mass, rel=1e-10)


# --- the slider-crank ---


def slider_crank(crank: float, rod: float, angle: float) -> SliderCrank:
    return SliderCrank(
        crank_length=crank,
        rod_length=crank * rod,
        crank_mass=0.3,
        rod_mass=0.21,
        slider_mass=0.14,
        crank_inertia=1e-4,
        rod_inertia=2.5e-4,
        start_angle=angle,
    )


cranks = st.builds(slider_crank, crank=st.floats(0.02, 0.2), rod=st.floats(1.05, 5.0), angle=angles)


@sometimes
@given(machine=cranks, direction=angles)
def test_slider_pin_feels_the_rod_about_the_crank_pin_and_the_slider(
    machine: SliderCrank, direction: float
) -> None:
    # the crank cannot give way, as it is driven. Free are the angle of the rod about the crank pin, with
    # m l^2/4 + I, and the slider along x: M = diag(m l^2/4 + I, m_s); the pin's eccentricity, rod minus slider,
    # answers with J = ((-l sin b, -1), (l cos b, 0)) to (angle, x)
    length = machine.rod_length
    fall = -math.asin(machine.crank_length * math.sin(machine.start_angle) / length)  # angle of the rod
    inertia = machine.rod_mass * length**2 / 4.0 + machine.rod_inertia
    rate = np.array([[-length * math.sin(fall), -1.0], [length * math.cos(fall), 0.0]])
    expected = rate @ np.diag([1.0 / inertia, 1.0 / machine.slider_mass]) @ rate.T
    system = kinetics(machine.linkage(), "slider_pin")
    n = unit(direction)
    assert inverse_mass(system, np.zeros(9), "slider_pin") == pytest.approx(expected, abs=1e-11)
    # rounding of inverse effective masses up to 12/kg; this one is 0.7/kg or more at rods of 1.05 cranks or
    # longer
    got = pin_mass(system, np.zeros(9), "slider_pin", direction)
    assert got == pytest.approx(1.0 / float(n @ expected @ n), rel=1e-9)


# --- what cannot move ---


@sometimes
@given(mass=masses, direction=angles, turned=angles)
def test_a_body_on_a_slide_cannot_be_pushed_across_it(mass: float, direction: float, turned: float) -> None:
    body = Body(mass=mass, inertia=1.0, centre=(0.1, 0.2), angle=turned)
    linkage = Linkage(
        bodies={"a": body},
        pins={"pin": pinned(GROUND, "a", (0.3, -0.4))},
        slides={"s": Slide(body="a", point=(0.1, 0.2), direction=direction)},
    )
    system = kinetics(linkage, "pin")
    # along it, its own mass: it does not turn; rounding
    assert pin_mass(system, np.zeros(3), "pin", direction) == pytest.approx(mass, rel=1e-12)
    # across it, a mass beyond all others; rounding of a mobility of 10/kg or less
    assert 1e13 < pin_mass(system, np.zeros(3), "pin", direction + math.pi / 2) <= HEAVIEST * (1.0 + 1e-9)


# --- Jacobians ---


@sometimes
@given(
    position=st.tuples(*[coordinates] * 6),
    speeds=st.tuples(*[coordinates] * 6),
    angle=angles,
    centre=points,
    ends=st.tuples(points, points),
    direction=angles,
)
def test_rows_are_the_rates_of_what_the_joints_hold(
    position: tuple[float, ...],
    speeds: tuple[float, ...],
    angle: float,
    centre: Vector2,
    ends: tuple[Vector2, Vector2],
    direction: float,
) -> None:
    # an actuator from far away, so that it always has a direction
    far = (ends[0][0] - 20.0, ends[0][1])
    linkage = Linkage(
        bodies={
            "a": Body(mass=1.0, inertia=1.0, centre=centre, angle=angle),
            "b": Body(mass=1.0, inertia=1.0, centre=(0.5, -0.5), angle=-0.7),
        },
        pins={"p": PinPlace(first="a", second="b", first_point=ends[0], second_point=ends[1])},
        actuators={"k": LinearActuator(foot="b", head="a", foot_point=far, head_point=ends[1])},
        cranks={"c": Crank(body="b")},
        slides={
            "s": Slide(body="a", point=ends[0], direction=direction),
            "t": Slide(body="a", point=ends[1], direction=direction, against="b"),
        },
        gears={"g": Gear(first="a", second="b", ratio=-0.4, carrier=GROUND)},
    )
    system = kinetics(linkage)
    assert system.driven() == slice(2, 4)
    along = unit(direction)

    def held(q: np.ndarray) -> np.ndarray:
        """What the joints hold, written out anew from angles and points."""

        def at(body: str, first: int, point: Vector2) -> np.ndarray:
            start = np.array(linkage.bodies[body].centre)
            x, y = np.subtract(point, start)
            c, s = math.cos(q[first + 2]), math.sin(q[first + 2])
            return start + q[first : first + 2] + np.array([c * x - s * y, s * x + c * y])

        pin = at("b", 3, ends[1]) - at("a", 0, ends[0])
        length = math.dist(at("a", 0, ends[1]), at("b", 3, far))
        on_ground = cross(along, at("a", 0, ends[0])), q[2]
        moving = cross(unit(direction + q[5]), at("a", 0, ends[1]) - at("b", 3, ends[1])), q[2] - q[5]
        return np.array([*pin, length, q[5], *on_ground, *moving, q[5] + 0.4 * q[2]])

    q, v, h = np.array(position), np.array(speeds), 1e-5
    slope = (held(q + h * v) - held(q - h * v)) / (2.0 * h)
    # central difference: h^2/6 of third derivatives up to 1e3, and rounding of 20 m over 2e-5
    np.testing.assert_allclose(system.rows(q) @ v, slope, atol=1e-7)


@sometimes
@given(position=st.tuples(*[coordinates] * 6), impulse=st.tuples(*[coordinates] * 6), jump=coordinates)
def test_response_obeys_momentum_and_constraints(
    position: tuple[float, ...], impulse: tuple[float, ...], jump: float
) -> None:
    linkage = Linkage(
        bodies={
            "a": Body(mass=2.0, inertia=0.5, centre=(0.0, 0.0)),
            "b": Body(mass=3.0, inertia=0.7, centre=(1.0, 0.0)),
        },
        pins={"p": pinned("a", "b", (0.5, 0.0))},
        actuators={"k": LinearActuator(foot=GROUND, head="a", foot_point=(0.0, -20.0), head_point=(0.2, 0.0))},
    )
    system = kinetics(linkage)
    q, b, c = np.array(position), np.array(impulse), np.array([0.0, 0.0, jump])
    change, multipliers = system.respond(q, b, c)
    rows = system.rows(q)
    # rounding
    np.testing.assert_allclose(system.mass() * change + rows.T @ multipliers, b, atol=1e-12)
    np.testing.assert_allclose(rows @ change, c, atol=1e-12)


# --- as the pins of a scene are told ---


@pytest.mark.parametrize("bore", ["first", "second"])
@pytest.mark.parametrize("start_angle", [0.0, 0.7, -2.0])
def test_a_scene_gives_the_mobility_in_the_axes_of_the_bore(bore: str, start_angle: float) -> None:
    machine = slider_crank(0.05, 2.4, start_angle)
    pin = ClearancePin(contact=slider_crank_contact(), bore=bore)
    scene = build(Scenario(machine=machine, duration=0.01, pins={"slider_pin": pin}))
    got = scene.inverse_mass("slider_pin")
    fall = -math.asin(machine.crank_length * math.sin(start_angle) / machine.rod_length)
    bore_angle = 0.0 if bore == "first" else fall  # the slider does not turn, the rod does
    inertia = machine.rod_mass * machine.rod_length**2 / 4.0 + machine.rod_inertia
    for direction in (0.0, 0.4, 1.5, 3.0):
        n = unit(direction + bore_angle)
        across_rod = machine.rod_length * cross(unit(fall), n)
        expected = across_rod**2 / inertia + n[0] ** 2 / machine.slider_mass
        # rounding
        assert got.mass(*(1e-3 * unit(direction)).tolist()) == pytest.approx(1.0 / expected, rel=1e-9)


def test_other_loose_pins_transmit_no_impulse() -> None:
    linkage = Linkage(
        bodies={
            "a": Body(mass=2.0, inertia=0.25, centre=(0.0, 0.0)),
            "b": Body(mass=3.0, inertia=0.7, centre=(1.0, 0.0)),
        },
        pins={"base": pinned(GROUND, "a", (-0.5, 0.0)), "pin": pinned("a", "b", (0.5, 0.0))},
    )
    # across the line of both centres: 1/2 + 0.5^2/0.25 and 1/3 + 0.5^2/0.7; rounding
    free = pin_mass(kinetics(linkage, "base", "pin"), np.zeros(6), "pin", math.pi / 2)
    assert 1.0 / free == pytest.approx(0.5 + 1.0 + 1.0 / 3.0 + 0.25 / 0.7, rel=1e-12)
    # on a closed base the first body turns about it: 1^2/(0.25 + 2 0.5^2) in place of 3/2
    held = pin_mass(kinetics(linkage, "pin"), np.zeros(6), "pin", math.pi / 2)
    assert 1.0 / held == pytest.approx(1.0 / 0.75 + 1.0 / 3.0 + 0.25 / 0.7, rel=1e-12)
