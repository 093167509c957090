"""Forces of joints from the motion alone, on mechanisms whose forces are known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Body, LinearActuator, Linkage, PinPlace, Slide
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.joint_forces import PinForce, open_joint_forces
from support_exudyn.model.linkage import GROUND, Crank, pinned

Triple = tuple[float, float, float]
angles, rates, masses = st.floats(-3.0, 3.0), st.floats(-5.0, 5.0), st.floats(0.1, 10.0)
motions = st.tuples(angles, rates, rates)
GRAVITY = (1.5, -9.0)


def bar(name: str, x: float, length: float, mass: float) -> dict[str, Body]:
    """A body along +x from x on, its centre of mass at a third."""
    return {name: Body(mass=mass, inertia=mass * length**2 / 10.0, centre=(x + length / 3.0, 0.0))}


def along(length: float, motion: Triple) -> tuple[np.ndarray, np.ndarray]:
    """A vector that turns, and its second derivative."""
    turn, spin, turning = motion
    c, s = math.cos(turn), math.sin(turn)
    return length * np.array([c, s]), length * (turning * np.array([-s, c]) - spin**2 * np.array([c, s]))


def motion_of(linkage: Linkage, *states: tuple[np.ndarray, np.ndarray, Triple]) -> BodyMotion:
    """One instant; states: of each body where its centre is, its acceleration, and how it turns."""
    centres = [body.centre for body in linkage.bodies.values()]
    position = [[*(at - centre), turn[0]] for (at, _, turn), centre in zip(states, centres, strict=True)]
    acceleration = [[*second, turn[2]] for _, second, turn in states]
    still = np.zeros((1, 3 * len(states)))
    return BodyMotion(linkage, np.reshape(position, (1, -1)), still, np.reshape(acceleration, (1, -1)))


def double_pendulum(pins: dict[str, PinPlace], one: Triple, two: Triple, m1: float, m2: float) -> BodyMotion:
    """Bars of 2 m and 3 m from the origin on, in any motion."""
    linkage = Linkage(bodies=bar("one", 0.0, 2.0, m1) | bar("two", 2.0, 3.0, m2), pins=pins)
    tip, tip_acceleration = along(2.0, one)
    at1, a1 = along(2.0 / 3.0, one)
    at2, a2 = along(1.0, two)
    return motion_of(linkage, (at1, a1, one), (tip + at2, tip_acceleration + a2, two))


@given(one=motions, two=motions, m1=masses, m2=masses)
def test_a_chain_carries_what_hangs_on_it(one: Triple, two: Triple, m1: float, m2: float) -> None:
    pins = {
        "top": pinned(GROUND, "one", (0.0, 0.0)),
        "middle": pinned("two", "one", (2.0, 0.0)),  # the lower one first: its force on the upper
    }
    motion = double_pendulum(pins, one, two, m1, m2)
    forces = open_joint_forces(motion, GRAVITY, {}, {}).pins
    lower = m2 * (motion.acceleration[0, 3:5] - GRAVITY)
    upper = m1 * (motion.acceleration[0, 0:2] - GRAVITY)
    # rounding of some hundred N
    np.testing.assert_allclose(forces["middle"][0], -lower, atol=1e-10)
    np.testing.assert_allclose(forces["top"][0], upper + lower, atol=1e-10)


@given(turn=angles, spin=rates, turning=rates, mass=masses, load=rates)
def test_the_moment_of_a_crank(turn: float, spin: float, turning: float, mass: float, load: float) -> None:
    linkage = Linkage(
        bodies=bar("crank", 0.0, 2.0, mass),
        pins={"pivot": pinned(GROUND, "crank", (0.0, 0.0)), "tip": pinned("crank", GROUND, (2.0, 0.0))},
        cranks={"drive": Crank(body="crank")},
    )
    state = turn, spin, turning
    motion = motion_of(linkage, (*along(2.0 / 3.0, state), state))
    tip = along(2.0, state)[0]
    pushed = np.array([load, 3.0])  # on the ground, at the tip
    known = {"tip": PinForce(pushed[None], tip[None])}
    found = open_joint_forces(motion, GRAVITY, {}, known)
    arm = along(2.0 / 3.0, state)[0]
    inertia = mass * (4.0 / 10.0 + 4.0 / 9.0)  # about the pivot
    weight = mass * (arm[0] * GRAVITY[1] - arm[1] * GRAVITY[0])
    reaction = -(tip[0] * pushed[1] - tip[1] * pushed[0])
    # rounding of some hundred N m
    assert found.cranks["drive"][0] == pytest.approx(inertia * turning - weight - reaction, abs=1e-10)
    total = mass * (motion.acceleration[0, :2] - GRAVITY) + pushed
    np.testing.assert_allclose(found.pins["pivot"][0], total, atol=1e-10)
    np.testing.assert_array_equal(found.pins["tip"][0], pushed)


@given(way=rates, acceleration=rates, direction=angles, push=rates, turn=angles)
def test_a_guide_takes_what_is_across_it_and_what_turns(
    way: float, acceleration: float, direction: float, push: float, turn: float
) -> None:
    linkage = Linkage(
        bodies={"block": Body(mass=2.0, inertia=0.1, centre=(0.0, 0.0))},
        pins={"pin": pinned("block", GROUND, (0.3, 0.4))},
        slides={"guide": Slide(body="block", point=(0.5, -0.2), direction=direction)},
    )
    unit = np.array([math.cos(direction), math.sin(direction)])
    motion = motion_of(linkage, (way * unit, acceleration * unit, (0.0, 0.0, 0.0)))
    force = push * np.array([math.cos(turn), math.sin(turn)])  # of the block on the ground
    where = np.array([0.3, 0.4]) + way * unit
    found = open_joint_forces(motion, GRAVITY, {}, {"pin": PinForce(force[None], where[None])})
    across = np.array([-unit[1], unit[0]])
    needed = across @ (-2.0 * np.array(GRAVITY) + force)
    moment = (0.3 * force[1] - 0.4 * force[0]) - needed * (0.5 * across[1] + 0.2 * across[0])
    np.testing.assert_allclose(found.slides["guide"][0], np.abs([needed, moment]), atol=1e-12)


@given(beam=motions, way=rates, speeding=rates, direction=angles)
def test_a_guide_on_a_moving_body_pushes_that_back(
    beam: Triple, way: float, speeding: float, direction: float
) -> None:
    # a beam on a pivot and a driven crank; on it slides a block, pushed along by a known force in a pin
    linkage = Linkage(
        bodies={
            "beam": Body(mass=3.0, inertia=0.5, centre=(1.0, 0.0)),
            "block": Body(mass=2.0, inertia=0.1, centre=(0.0, 0.0)),
        },
        pins={"pivot": pinned(GROUND, "beam", (0.0, 0.0)), "push": pinned("block", GROUND, (0.3, 0.4))},
        cranks={"drive": Crank(body="beam")},
        slides={"guide": Slide(body="block", point=(0.0, 0.0), direction=direction, against="beam")},
    )
    turn, _, turning = beam
    unit = np.array([math.cos(turn + direction), math.sin(turn + direction)])
    across = np.array([-unit[1], unit[0]])
    block, block_acceleration = way * unit, speeding * unit + 1.3 * way * across
    beam_at, beam_acceleration = along(1.0, beam)
    states = (beam_at, beam_acceleration, beam), (block, block_acceleration, beam)
    motion = motion_of(linkage, *states)
    needed = 2.0 * (block_acceleration - np.array(GRAVITY))
    push = (needed @ unit) * unit  # on the block: all that is along the guide
    c, s = math.cos(turn), math.sin(turn)
    arm = np.array([0.3 * c - 0.4 * s, 0.3 * s + 0.4 * c])
    found = open_joint_forces(motion, GRAVITY, {}, {"push": PinForce(-push[None], (block + arm)[None])})
    moment = 0.1 * turning - (arm[0] * push[1] - arm[1] * push[0])
    # rounding of some hundred N
    np.testing.assert_allclose(found.slides["guide"][0], np.abs([needed @ across, moment]), atol=1e-10)
    # of both together: momentum and angular momentum about the pivot
    beam_needed = 3.0 * (beam_acceleration - np.array(GRAVITY))
    np.testing.assert_allclose(found.pins["pivot"][0], beam_needed + needed - push, atol=1e-10)
    total = 0.6 * turning + beam_at[0] * beam_needed[1] - beam_at[1] * beam_needed[0]
    total += block[0] * needed[1] - block[1] * needed[0]
    total -= (block + arm)[0] * push[1] - (block + arm)[1] * push[0]
    assert found.cranks["drive"][0] == pytest.approx(total, abs=1e-10)


def test_an_actuator_pushes_both_of_its_ends() -> None:
    # a beam of 10 kg held level by a pin at its left end and an actuator under its right end
    linkage = Linkage(
        bodies={"beam": Body(mass=10.0, inertia=1.0, centre=(1.0, 0.0))},
        pins={"left": pinned(GROUND, "beam", (0.0, 0.0))},
        actuators={
            "mesh_item": LinearActuator(foot=GROUND, head="beam", foot_point=(3.0, -1.0), head_point=(2.0, 0.0))
        },
    )
    motion = motion_of(linkage, (np.array([1.0, 0.0]), np.zeros(2), (0.0, 0.0, 0.0)))
    push = 50.0 * math.sqrt(2.0)  # its vertical part at 2 m holds 100 N at 1 m
    found = open_joint_forces(motion, (0.0, -10.0), {"mesh_item": np.array([push])}, {})
    np.testing.assert_allclose(found.pins["left"][0], [50.0, 50.0], rtol=1e-14)


def test_a_hanging_chain_of_many_links() -> None:
    count, mass = 6, 2.0
    bodies: dict[str, Body] = {}
    pins: dict[str, PinPlace] = {}
    for n in range(count):
        name = f"link{n}"
        bodies |= bar(name, float(n), 1.0, mass)
        pins[name] = pinned(f"link{n - 1}" if n else GROUND, name, (float(n), 0.0))
    linkage = Linkage(bodies=bodies, pins=pins)
    down = (-0.5 * math.pi, 0.0, 0.0)
    states = [(np.array([0.0, -n - 1.0 / 3.0]), np.zeros(2), down) for n in range(count)]
    forces = open_joint_forces(motion_of(linkage, *states), (0.0, -9.81), {}, {}).pins
    for n in range(count):
        # of the upper on the lower: it carries all that is below
        np.testing.assert_allclose(forces[f"link{n}"][0], [0.0, (count - n) * mass * 9.81], atol=1e-12)


def four_bar() -> BodyMotion:
    """At rest: two posts of 2 m that a beam joins."""
    bodies = {
        "left": Body(mass=1.0, inertia=1.0, centre=(0.0, 1.0)),
        "beam": Body(mass=4.0, inertia=1.0, centre=(1.0, 2.0)),
        "right": Body(mass=1.0, inertia=1.0, centre=(2.0, 1.0)),
    }
    pins = {
        "a": pinned(GROUND, "left", (0.0, 0.0)),
        "b": pinned("left", "beam", (0.0, 2.0)),
        "c": pinned("beam", "right", (2.0, 2.0)),
        "d": pinned("right", GROUND, (2.0, 0.0)),
    }
    still = (0.0, 0.0, 0.0)
    linkage = Linkage(bodies=bodies, pins=pins)
    states = [(np.array(body.centre), np.zeros(2), still) for body in bodies.values()]
    return motion_of(linkage, *states)


def test_a_closed_loop_is_refused() -> None:
    with pytest.raises(ValueError, match="pins a, b, c, d: the linkage has a closed loop"):
        open_joint_forces(four_bar(), (0.0, -10.0), {}, {})


def test_a_loop_that_one_known_force_opens() -> None:
    # half of the beam's weight goes down on either side
    known = {"c": PinForce(np.array([[0.0, -20.0]]), np.array([[2.0, 2.0]]))}
    forces = open_joint_forces(four_bar(), (0.0, -10.0), {}, known).pins
    np.testing.assert_allclose(forces["b"][0], [0.0, 20.0], atol=1e-13)  # of the post on the beam
    np.testing.assert_allclose(forces["a"][0], [0.0, 30.0], atol=1e-13)
    np.testing.assert_allclose(forces["d"][0], [0.0, -30.0], atol=1e-13)  # of the post on the ground
