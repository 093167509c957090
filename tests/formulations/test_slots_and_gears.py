"""Blocks on guides, pins in slots and bodies that turn in proportion, against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    Body,
    Crank,
    Gear,
    Linkage,
    Machine,
    PinPlace,
    Result,
    Scenario,
    Slide,
    SolverSettings,
    Steady,
    TracePoint,
    simulate,
)
from support_exudyn.model.linkage import pinned
from user_forces import value

RADIUS, SPEED = 0.1, 20.0  # of the crank [m], [rad/s]
CRANK, YOKE, G = 1.5, 4.0, 9.81  # [kg]
RATIO = -2.5
BELOW, LEVER = 0.3, 0.15  # [m], [kg m^2]


@value
class ScotchYoke(Machine):
    """A crank's pin in the upright slot of a yoke, which slides level: x = r cos(a)."""

    start: float = 0.4

    def linkage(self) -> Linkage:
        pin = RADIUS * math.cos(self.start), RADIUS * math.sin(self.start)
        return Linkage(
            bodies={
                "crank": Body(mass=CRANK, inertia=0.01, centre=(0.0, 0.0), angle=self.start),
                "yoke": Body(mass=YOKE, inertia=0.1, centre=(pin[0] + 0.2, 0.0)),
            },
            pins={"main": PinPlace(first="ground", second="crank", first_point=(0, 0), second_point=(0, 0))},
            cranks={"crank": Crank(body="crank")},
            slides={
                "slot": Slide(body="crank", point=pin, direction=0.5 * math.pi, against="yoke", turns=True),
                "guide": Slide(body="yoke", point=(0.3, 0.0)),
            },
        )


@value
class SlottedLever(Machine):
    """A crank's pin in the slot of a lever, whose pivot and centre of mass lie `BELOW` the crank's pivot."""

    def linkage(self) -> Linkage:
        pin, pivot = (RADIUS, 0.0), (0.0, -BELOW)
        slot = Slide(body="crank", point=pin, direction=math.atan2(BELOW, RADIUS), against="lever", turns=True)
        return Linkage(
            bodies={
                "crank": Body(mass=CRANK, inertia=0.01, centre=(0.0, 0.0)),
                "lever": Body(mass=YOKE, inertia=LEVER, centre=pivot),
            },
            pins={"main": pinned("ground", "crank", (0.0, 0.0)), "pivot": pinned("ground", "lever", pivot)},
            cranks={"crank": Crank(body="crank")},
            slides={"slot": slot},
        )


@value
class GearPair(Machine):
    """A driven wheel and one that meshes with it, whose centre of mass is not on its axis."""

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={
                "wheel": Body(mass=2.0, inertia=0.02, centre=(0.0, 0.0)),
                "pinion": Body(mass=1.0, inertia=0.003, centre=(0.35, 0.0), angle=0.3),
            },
            pins={
                "wheel": PinPlace(first="ground", second="wheel", first_point=(0, 0), second_point=(0, 0)),
                "pinion": PinPlace(
                    first="ground", second="pinion", first_point=(0.3, 0), second_point=(0.3, 0)
                ),
            },
            cranks={"wheel": Crank(body="wheel")},
            gears={"mesh": Gear(first="wheel", second="pinion", ratio=RATIO)},
        )


@value
class Planetary(Machine):
    """A sun at rest or driven, an arm, and a planet on the arm, whose centre of mass may be beside its axis."""

    driven: tuple[str, ...] = ("sun", "arm")
    beside: float = 0.02

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={
                "sun": Body(mass=1.0, inertia=0.01, centre=(0.0, 0.0), angle=0.3),
                "arm": Body(mass=2.0, inertia=0.015, centre=(0.15, 0.0)),
                "planet": Body(mass=3.0, inertia=0.02, centre=(0.3 + self.beside, 0.0), angle=0.7),
            },
            pins={
                "sun": pinned("ground", "sun", (0.0, 0.0)),
                "arm": pinned("ground", "arm", (0.0, 0.0)),
                "planet": pinned("arm", "planet", (0.3, 0.0)),
            },
            cranks={name: Crank(body=name) for name in self.driven},
            gears={"mesh": Gear(first="sun", second="planet", ratio=-2.0)},
        )


# of places and forces, in second place that of the engine's steps of 0.1 ms
FORMULATIONS = {"compiled": (1e-11, 1e-8), "exudyn": (1e-9, 1e-4)}
EVERY_FORMULATION = pytest.mark.parametrize("formulation", FORMULATIONS)


def turned(machine: Machine, formulation: str) -> Result:
    """A run at a steady speed of the crank."""
    solver = SolverSettings(tolerance=1e-9)
    return simulate(
        Scenario(
            machine=machine,
            drive=Steady(rate=SPEED),
            duration=0.3,
            step=1e-4,
            formulation=formulation,
            solver=solver,
        )
    )


@EVERY_FORMULATION
def test_a_scotch_yoke_moves_as_the_cosine(formulation: str) -> None:
    place, force = FORMULATIONS[formulation]
    yoke = turned(ScotchYoke(), formulation)
    x = RADIUS * np.cos(0.4 + SPEED * yoke.time)
    np.testing.assert_allclose(yoke["yoke.x"] - 0.2, x, atol=place)
    np.testing.assert_allclose(yoke["yoke.y"], 0.0, atol=1e-12)
    # the slot accelerates the yoke, and carries no moment
    np.testing.assert_allclose(yoke["slot.force"], YOKE * SPEED**2 * np.abs(x), atol=force)
    assert not yoke["slot.moment"].any()
    arm = RADIUS * np.sin(0.4 + SPEED * yoke.time)
    np.testing.assert_allclose(yoke["crank.moment"], YOKE * SPEED**2 * x * arm, atol=0.1 * force)
    np.testing.assert_allclose(yoke["guide.force"], YOKE * G, atol=0.01 * force)
    assert abs(yoke["energy.balance"]).max() < 1e-3 * yoke["energy.kinetic"].max()


@EVERY_FORMULATION
def test_a_slotted_lever_swings_as_its_closed_form(formulation: str) -> None:
    place, force = FORMULATIONS[formulation]
    lever = turned(SlottedLever(), formulation)
    a = SPEED * lever.time
    x, y = RADIUS * np.cos(a), RADIUS * np.sin(a) + BELOW  # of the crank's pin from the lever's pivot
    square = x**2 + y**2
    angle = np.arctan2(y, x)
    np.testing.assert_allclose(lever["lever.angle"] - lever["lever.angle"][0], angle - angle[0], atol=place)
    rate = SPEED * RADIUS * (RADIUS + BELOW * np.sin(a)) / square
    np.testing.assert_allclose(lever["lever.angular_velocity"], rate, atol=0.5 * force)
    # the slot turns while the pin moves along it: without Coriolis' share this is wrong
    bend = SPEED**2 * RADIUS * BELOW * np.cos(a) * (BELOW**2 - RADIUS**2) / square**2
    np.testing.assert_allclose(lever["slot.force"], LEVER * np.abs(bend) / np.sqrt(square), atol=10.0 * force)


@EVERY_FORMULATION
def test_geared_bodies_turn_in_proportion(formulation: str) -> None:
    place, force = FORMULATIONS[formulation]
    gears = turned(GearPair(), formulation)
    np.testing.assert_allclose(gears["pinion.angle"], 0.3 + RATIO * SPEED * gears.time, atol=place)
    # its weight beside the axis
    moment = 1.0 * G * 0.05 * np.cos(RATIO * SPEED * gears.time)
    np.testing.assert_allclose(gears["mesh.moment"], moment, atol=0.01 * force)
    np.testing.assert_allclose(gears["wheel.moment"], RATIO * moment, atol=0.01 * force)


@EVERY_FORMULATION
def test_a_planet_turns_by_willis_equation(formulation: Any) -> None:
    """A planet turns at 9 rad/s for an arm at 3 rad/s on a sun at rest; the moment holds its weight."""
    drives = {"sun": Steady(rate=0.0), "arm": Steady(rate=3.0)}
    run = simulate(Scenario(machine=Planetary(), drives=drives, duration=0.4, formulation=formulation))
    np.testing.assert_allclose(run["planet.angular_velocity"], 9.0, atol=1e-8)
    a, b = 3.0 * run.time, 9.0 * run.time  # angles of the arm and of the planet
    pull = -0.3 * 9.0 * np.array([np.cos(a), np.sin(a)]) + [[0.0], [G]]
    moment = 3.0 * 0.02 * (np.cos(b) * pull[1] - np.sin(b) * pull[0])
    np.testing.assert_allclose(run["mesh.moment"], moment, atol=1e-6)
    np.testing.assert_allclose(run["sun.moment"], -2.0 * moment, atol=1e-6)


# --- guides ---

MASS = 2.0  # of the block [kg]
POINT = (0.3, 0.4)  # on the guide [m]
ASIDE = 0.1  # of the centre of mass from it, along x [m]


@value
class Block(Machine):
    """A block that slides on a line through a point of it, its centre of mass beside."""

    direction: float
    angle: float

    def linkage(self) -> Linkage:
        centre = (POINT[0] + ASIDE, POINT[1])
        return Linkage(
            bodies={"block": Body(mass=MASS, inertia=0.05, centre=centre, angle=self.angle)},
            points={"edge": TracePoint(body="block", point=POINT)},
            slides={"guide": Slide(body="block", point=POINT, direction=self.direction)},
        )


@pytest.mark.parametrize(("direction", "angle"), [(0.0, 0.0), (0.4, 0.7), (-1.2, 0.0), (2.5, 0.7)])
def test_a_block_slides_down_an_incline_that_carries_it(direction: float, angle: float) -> None:
    slid = simulate(Scenario(machine=Block(direction=direction, angle=angle), duration=0.2))
    path = -0.5 * G * math.sin(direction) * slid.time**2
    expected = np.array(POINT) + path[:, None] * np.array([math.cos(direction), math.sin(direction)])
    # constant acceleration, which the integrator takes exactly; Newton's tolerance of 1e-8
    np.testing.assert_allclose(slid["edge.x"], expected[:, 0], atol=1e-9)
    np.testing.assert_allclose(slid["edge.y"], expected[:, 1], atol=1e-9)
    np.testing.assert_allclose(slid["block.angle"], angle, atol=1e-12)
    assert slid.energy_error < 1e-9
    # across the guide acts the weight's part, at the centre of mass: its moment is about the point on the guide
    force = MASS * G * abs(math.cos(direction))
    np.testing.assert_allclose(slid["guide.force"][1:], force, rtol=1e-7)
    np.testing.assert_allclose(slid["guide.moment"][1:], force * abs(ASIDE * math.cos(direction)), rtol=1e-7)
