"""A pin in a slot, and bodies that turn in proportion, against closed forms."""

import math
from typing import Any

import numpy as np
import pytest

from support_exudyn import (
    Body,
    Crank,
    Gear,
    Held,
    Linkage,
    Machine,
    PinPlace,
    Result,
    Scenario,
    Slide,
    Steady,
    simulate,
)
from support_exudyn.machines.check.statics import mobility, statics
from support_exudyn.model.linkage import pinned
from user_forces import InputError, value

RADIUS, SPEED = 0.1, 20.0  # of the crank [m], [rad/s]
CRANK, YOKE, G = 1.5, 4.0, 9.81  # [kg]
RATIO = -2.5


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


@pytest.fixture(scope="module")
def yoke() -> Result:
    scenario = Scenario(machine=ScotchYoke(), drive=Steady(rate=SPEED), duration=0.3, step=1e-4)
    return simulate(scenario)


@pytest.fixture(scope="module")
def gears() -> Result:
    return simulate(Scenario(machine=GearPair(), drive=Steady(rate=SPEED), duration=0.3, step=1e-4))


def test_a_scotch_yoke_moves_as_the_cosine(yoke: Result) -> None:
    x = RADIUS * np.cos(0.4 + SPEED * yoke.time)
    np.testing.assert_allclose(yoke["yoke.x"] - 0.2, x, atol=1e-9)
    np.testing.assert_allclose(yoke["yoke.y"], 0.0, atol=1e-12)


def test_the_slot_accelerates_the_yoke_and_carries_no_moment(yoke: Result) -> None:
    x = RADIUS * np.cos(0.4 + SPEED * yoke.time)
    np.testing.assert_allclose(yoke["slot.force"], YOKE * SPEED**2 * np.abs(x), atol=1e-4)
    assert not yoke["slot.moment"].any()
    arm = RADIUS * np.sin(0.4 + SPEED * yoke.time)
    np.testing.assert_allclose(yoke["crank.moment"], YOKE * SPEED**2 * x * arm, atol=1e-5)
    np.testing.assert_allclose(yoke["guide.force"], YOKE * G, atol=1e-6)
    assert abs(yoke["energy.balance"]).max() < 1e-3 * yoke["energy.kinetic"].max()


def test_geared_bodies_turn_in_proportion(gears: Result) -> None:
    np.testing.assert_allclose(gears["pinion.angle"], 0.3 + RATIO * SPEED * gears.time, atol=1e-9)
    # its weight beside the axis
    moment = 1.0 * G * 0.05 * np.cos(RATIO * SPEED * gears.time)
    np.testing.assert_allclose(gears["mesh.moment"], moment, atol=1e-6)
    np.testing.assert_allclose(gears["wheel.moment"], RATIO * moment, atol=1e-6)


def test_slots_and_gears_count_one_condition_each() -> None:
    of_yoke, of_gears = mobility(ScotchYoke().linkage()), mobility(GearPair().linkage())
    assert (of_yoke.counted, of_yoke.free, of_yoke.left) == (1, 1, 0)
    assert (of_gears.counted, of_gears.free, of_gears.left) == (1, 1, 0)
    assert of_yoke.said().startswith(
        "degrees of freedom: 3 x 2 bodies - 2 x 1 pins - 2 x 1 guides - 1 slots = 1"
    )
    held = statics(GearPair().linkage(), np.zeros(6))
    assert held.gears["mesh"] == pytest.approx(G * 0.05)
    assert held.cranks["wheel"] == pytest.approx(RATIO * G * 0.05)


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
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


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
def test_a_planet_adds_inertia_to_its_arm(formulation: Any) -> None:
    """A free arm falls as a pendulum whose planet turns three times as fast: energy as the angle says."""
    machine = Planetary(driven=("sun",), beside=0.0)
    run = simulate(Scenario(machine=machine, drive=Held(), duration=0.3, formulation=formulation))
    inertia = 0.015 + 2.0 * 0.15**2 + 3.0 * 0.3**2 + 9.0 * 0.02
    fallen = -(2.0 * 0.15 + 3.0 * 0.3) * G * np.sin(run["arm.angle"])
    np.testing.assert_allclose(0.5 * inertia * run["arm.angular_velocity"] ** 2, fallen, atol=1e-4)
    assert run["arm.angle"][-1] < -0.5


@pytest.mark.parametrize(
    ("gear", "said"),
    [
        ({"first": "wheel", "second": "wheel"}, "two different bodies"),
        ({"first": "wheel", "second": "ground"}, "no such moving body"),
        ({"first": "wheel", "second": "pinion", "ratio": 0.0}, "any other number"),
    ],
)
def test_gears_of_no_use_are_refused(gear: dict[str, object], said: str) -> None:
    bodies = GearPair().linkage().bodies
    with pytest.raises(InputError, match=said):
        Linkage(bodies=bodies, gears={"mesh": Gear(**gear)})
