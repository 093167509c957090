"""Loads as functions of numbers: energy, virtual work, closed forms and courses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn import (
    AppliedForce,
    AppliedTorque,
    BeddedRoof,
    BushingPin,
    CubicStep,
    GroundReaction,
    HarmonicCourse,
    Held,
    LoadedPoint,
    LoadedStretch,
    PinPlace,
    Reciprocating,
    Roof,
    Scenario,
    SpringDamper,
    Steady,
    TableCourse,
    TorsionSpring,
    UniformSpeed,
)
from support_exudyn.mechanics.acting_loads import MANY, add_load, largest_forces, load_series
from support_exudyn.mechanics.body_motion import UNTURNED, BodyMotion, Motion, SpatialMotion, parameter_rates
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.loads.load import ActingLoad, Load, LoadChannel, MomentLoad, StretchLoad
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage
from tests.linkage_cases import CrankRocker
from tests.roof_cases import (
    STIFFNESS,
    TOP,
    Ram,
    over_the_ram,
)
from user_forces import value
from user_forces.kernel import kernel
from user_forces.values.value import Vector2, kinds_of

TABLE = TableCourse(times=(0.1, 0.2, 0.4), shares=(2.0, 1.0, -0.5))
SINE = HarmonicCourse(period=0.25, phase=0.2, mean=0.5)
FORCE = AppliedForce(body="crank", point=(0.1, 0.0), full_force=(2e3, -5e4), course=TABLE)
COMES_ON = AppliedForce(body="ram", point=TOP, full_force=(2e3, -5e4), start=0.1, end=0.3)
ALWAYS = replace(COMES_ON, start=0.0, end=0.0)
TORQUE = AppliedTorque(body="crank", full_torque=40.0, course=SINE)
SPRING = SpringDamper(
    body="rocker", point=(0.3, 0.1), other_point=(0.0, 0.0), stiffness=3e3, free_length=0.2, damping=40.0
)
COIL = TorsionSpring(body="rocker", other="crank", stiffness=30.0, free_turn=0.3, damping=0.4)
DESCENT = CubicStep(stroke=0.3, start=0.0, end=0.6)
ROOF = Roof(body="rocker", point=(0.3, 0.1), descent=DESCENT, stiffness=2e4, damping=0.2, gap=0.02)
BED = BeddedRoof(
    body="rocker", points=((0.3, 0.1), (0.5, 0.2)), descent=DESCENT, bedding=1e5, damping=0.2, gaps=(0.0, 0.1)
)
CURVE = GroundReaction(
    body="rocker", point=(0.3, 0.1), convergences=(0.0, 0.2, 0.5), forces=(3e4, 1e4, 2e4), between="smooth"
)
BUSHING = BushingPin(
    stiffness=(2e4, 5e4), damping=(40.0, 25.0), rotational_stiffness=300.0, rotational_damping=0.8
).loads(PinPlace(first="crank", second="rocker", first_point=(0.1, 0.0), second_point=(0.1, 0.05)))
LOADS: dict[str, ActingLoad] = {
    "force with a table": FORCE,
    "force that comes on": replace(COMES_ON, body="crank"),
    "torque with a sine": TORQUE,
    "spring": SPRING,
    "damper": replace(SPRING, stiffness=0.0),
    "torsion spring": COIL,
    "roof": ROOF,
    "stiff roof without damping": replace(ROOF, damping=0.0, descent=Steady(rate=0.3), stiffness=2e6),
    "falling roof": replace(ROOF, damping=3.0, descent=Reciprocating(stroke=0.2, period=0.11)),
    "bed": BED,
    "bed without damping": replace(BED, damping=0.0),
    "reaction curve": CURVE,
    "reaction curve of lines": replace(CURVE, between="linear"),
    "bushing": BUSHING["force"],
    "bushing's moment": BUSHING["moment"],
}


class Action(NamedTuple):
    """What a load does at an instant: its forces, energy, powers, and the values of its channels by name."""

    forces: tuple[float, ...]
    stored: float
    work: float
    loss: float
    channels: dict[str, float]


def acting(load: ActingLoad, at: object) -> Action:
    found, count = load.numbers(at), load.FORCES
    observed = dict(zip(load.channels, found[count + 3 :], strict=True))
    return Action(found[:count], *found[count : count + 3], observed)


SMALL = 1e-7  # [s]
every_load = pytest.mark.parametrize("name", LOADS)


def moved(
    load: ActingLoad, t: float, strains: np.ndarray, rates: np.ndarray, by: float = 0.0
) -> tuple[float, ...]:
    """The motion that a load follows, a time after t [s]: its strains with their rates."""
    now, count = strains + by * rates, min(2, load.FORCES)  # a point's third component comes behind the rates
    plane = (t + by, *now[:count], *rates[:count])
    motion: tuple[float, ...] = load.MOTION(*plane, *([now[2], rates[2]] if load.FORCES == 3 else ()))
    return motion


def test_every_kind_of_load_is_in_the_table() -> None:
    kinds = {kind for kind in kinds_of(ActingLoad).values() if kind.__module__.startswith("support_exudyn")}
    assert kinds <= {type(load) for load in LOADS.values()}


@every_load
@given(
    t=st.floats(0.0, 0.55),
    strains=st.lists(st.floats(-0.3, 0.3), min_size=3, max_size=3),
    rates=st.lists(st.floats(-3.0, 3.0), min_size=3, max_size=3),
)
def test_stored_energy_changes_by_work_loss_and_what_the_bodies_get(
    name: str, t: float, strains: list[float], rates: list[float]
) -> None:
    load = LOADS[name]
    q, w = np.array(strains), np.array(rates)
    if isinstance(load, SpringDamper):
        q[0] += 0.4  # else it may have no length
    now = acting(load, moved(load, t, q, w))
    earlier, later = (acting(load, moved(load, t, q, w, by)) for by in (-SMALL, SMALL))
    given_away = float(np.dot(now.forces, w[: load.FORCES]))
    rate = (later.stored - earlier.stored) / (2.0 * SMALL)
    # rounding of the energies, and of the second order at kinks of the force
    scale = max(now.stored, 1.0) * 1e-15 / SMALL + max(load.steepness) * SMALL * (np.abs(w).max() + 1.0) ** 2
    assert rate == pytest.approx(
        now.work - now.loss - given_away, rel=1e-6, abs=1e-6 * abs(now.work) + 4.0 * scale
    )
    assert now.loss >= 0.0
    assert len(now.channels) == len(load.channels)


# --- strain kinds ---


@value
class PointProbe(Load):
    """A constant force between points of two bodies, which records its strains and then their rates."""

    other: str

    def against(self, name: str) -> str:
        return self.other

    @property
    def origin(self) -> Vector2:
        return (0.05, -0.1)

    @staticmethod
    @kernel
    def action(t: float, x: float, y: float, vx: float, vy: float, z: float, vz: float) -> tuple[float, ...]:
        return 3.0, -2.0, 5.0, 0.0, 0.0, 0.0, x, y, z, vx, vy, vz

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        return {name: LoadChannel("", "") for name in ("x", "y", "z", "vx", "vy", "vz")}


@value
class TurnProbe(MomentLoad):
    """A constant moment between two bodies, which records turn and rate."""

    @staticmethod
    @kernel
    def action(t: float, turn: float, spin: float) -> tuple[float, ...]:
        return 3.0, 0.0, 0.0, 0.0, turn, spin

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        return {name: LoadChannel("", "") for name in ("turn", "spin")}


@value
class StretchProbe(StretchLoad):
    """Constant forces at both ends of a stretch, which records their ways and then their rates."""

    @staticmethod
    @kernel
    def action(
        t: float, first: float, second: float, first_rate: float, second_rate: float
    ) -> tuple[float, ...]:
        return 3.0, -2.0, 0.0, 0.0, 0.0, first, second, first_rate, second_rate

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        return {name: LoadChannel("", "") for name in ("first", "second", "first_rate", "second_rate")}


PROBES: list[ActingLoad] = [
    PointProbe(body="rocker", point=(0.3, 0.1), lateral=0.2, other="crank"),
    PointProbe(body="rocker", point=(0.3, 0.1), lateral=0.2, other="ground"),
    TurnProbe(body="rocker", other="crank"),
    TurnProbe(body="rocker"),
    StretchProbe(body="rocker", points=((0.3, 0.1), (0.5, 0.2)), lateral=0.2),
]


def motions(by: float) -> tuple[Motion, Motion]:
    """Drawn motions of the crank-rocker's bodies in the plane and in space after a time [s]."""
    random, count, linkage = np.random.default_rng(5), 7, CrankRocker().linkage()
    position, velocity = random.uniform(-0.5, 0.5, (2, count, 3 * len(linkage.bodies)))
    plane = BodyMotion(linkage, position + by * velocity, velocity)
    bodies = {
        name: SpatialBody(mass=1.0, inertia=(1.0, 1.0, 1.0, 0.0, 0.0, 0.0), centre=(*body.centre, 0.0))
        for name, body in linkage.bodies.items()
    }
    shape = (count, len(bodies), 3)
    shift, speed, spin, turned = random.uniform(-0.5, 0.5, (4, *shape))
    turn = Rotation.from_rotvec((by * spin).reshape(-1, 3)) * Rotation.from_rotvec(turned.reshape(-1, 3))
    parameters = np.roll(turn.as_quat(), 1, axis=1).reshape(*shape[:2], 4)
    places = np.concatenate([shift + by * speed, parameters - UNTURNED], axis=2).reshape(count, -1)
    rates = np.concatenate([speed, parameter_rates(parameters, spin)], axis=2).reshape(count, -1)
    return plane, SpatialMotion(SpatialLinkage(bodies=bodies), places, rates)


@pytest.mark.parametrize("load", PROBES, ids=lambda load: f"{type(load).__name__}-{load.against('')}")
@pytest.mark.parametrize("space", [False, True], ids=["plane", "space"])
def test_rates_are_those_of_the_strains_and_forces_do_their_work(load: ActingLoad, space: bool) -> None:
    motion, before, after = (motions(by)[space] for by in (0.0, -1e-6, 1e-6))
    velocity = motion.velocities
    time, count = np.zeros(len(velocity)), load.FORCES
    now, earlier, later = (load_series(load, "", one, time) for one in (motion, before, after))
    measured = [np.array(list(one.observed.values())).T for one in (now, earlier, later)]
    rates = measured[0][:, count:]
    np.testing.assert_allclose(rates, (measured[2] - measured[1])[:, :count] / 2e-6, atol=1e-8)
    total = np.zeros_like(velocity)
    add_load(total, motion, "", load, now)
    power = (total * velocity).sum(axis=1)
    np.testing.assert_allclose(power, (now.forces * rates).sum(axis=1), rtol=1e-12, atol=1e-12)


@every_load
def test_compiled_actions_are_those_of_python(name: str) -> None:
    load, random = LOADS[name], np.random.default_rng(3)
    linkage = CrankRocker().linkage()
    position, velocity = random.uniform(-0.3, 0.3, (2, MANY, 3 * len(linkage.bodies)))
    time = np.linspace(0.0, 0.5, MANY)

    def series(part: slice) -> np.ndarray:
        motion = BodyMotion(linkage, position[part], velocity[part])
        found = load_series(load, name, motion, time[part])
        return np.column_stack([found.forces, found.stored, *found.observed.values()])

    in_python = np.concatenate([series(slice(None, MANY // 2)), series(slice(MANY // 2, None))])
    # the same operations; a hypotenuse may be rounded otherwise
    np.testing.assert_allclose(series(slice(None)), in_python, rtol=1e-13, atol=1e-12)


# --- closed forms ---


def at(y: float = 0.0, vy: float = 0.0) -> LoadedPoint:
    return LoadedPoint(0.0, 0.0, y, 0.0, vy)


def test_a_roof_by_hand() -> None:
    held = Roof(body="ram", point=TOP, gap=0.25, stiffness=1000.0, descent=Held())
    # all of it exact in binary: 0.25 m deep after 0.5 m up through a gap of 0.25 m
    deep = acting(held, at(y=0.5))
    assert (deep.forces, deep.stored) == ((0.0, -250.0, 0.0), 31.25)
    assert deep.channels == {"force": 250.0, "gap": -0.25}
    free = acting(held, at(y=0.125))
    assert (free.channels, free.stored) == ({"force": 0.0, "gap": 0.125}, 0.0)
    # damped with 2 s/m: doubled at 0.5 m/s, nothing from -0.5 m/s on
    damped = replace(held, damping=2.0)
    pushes = [acting(damped, at(y=0.5, vy=speed)).channels["force"] for speed in (0.5, 0.0, -0.25, -0.5, -1.0)]
    assert pushes == [500.0, 250.0, 125.0, 0.0, 0.0]


def test_place_and_pressed_length_of_a_bedding_on_what_stands_still() -> None:
    # a wedge: pressed from where the gap is closed to the second point, resultant at its third
    roof = BeddedRoof(
        body="ram",
        points=((-1.0, 1.0), (2.0, 1.0)),
        bedding=2e6,
        gaps=(0.02, 0.005),
        descent=UniformSpeed(stroke=0.015, start=0.0, end=1e-3),
    )
    found = acting(roof, LoadedStretch(0.02, 0.0, 0.0, 0.0, 0.0))
    pressed = 3.0 * 0.01 / 0.015
    force = 0.5 * 2e6 * 0.01 * pressed
    expected = {"pressed": pressed, "force": force, "place": 3.0 - pressed / 3.0}
    assert found.channels == pytest.approx(expected | {"gap_first": 0.005, "gap_second": -0.01}, rel=1e-12)
    assert sum(found.forces) == pytest.approx(-force, rel=1e-12)
    apart = acting(roof, LoadedStretch(0.0, 0.0, 0.0, 0.0, 0.0)).channels
    assert (apart["force"], apart["place"], apart["pressed"]) == (0.0, 0.0, 0.0)


def test_a_table_is_constant_outside_and_meets_its_points() -> None:
    assert [TABLE.share(t) for t in (0.0, 0.1, 0.2, 0.4, 1.0)] == [2.0, 2.0, 1.0, -0.5, -0.5]
    assert 1.0 < TABLE.share(0.15) < 2.0
    assert TABLE.breaks == FORCE.breaks == (0.1, 0.2, 0.4)
    assert replace(TABLE, between="linear").share(0.3) == pytest.approx(0.25, rel=1e-12)


def test_a_force_comes_on_between_its_times() -> None:
    assert COMES_ON.breaks == (0.1, 0.3)
    found = acting(COMES_ON, LoadedPoint(0.2, 0.0, 0.0, 0.0, 0.0)).channels
    assert found == pytest.approx({"force_x": 1e3, "force_y": -2.5e4})
    assert ALWAYS.breaks == ()


@pytest.mark.parametrize(
    ("load", "duration", "largest"),
    [
        (COMES_ON, 0.2, (1e3, -2.5e4)),
        (COMES_ON, 9.0, (2e3, -5e4)),
        (ALWAYS, 1e-3, (2e3, -5e4)),
        (replace(ALWAYS, course=TABLE), 1.0, (4e3, -1e5)),
        (replace(ALWAYS, course=replace(TABLE, shares=(0.0, 1.0, -3.0))), 1.0, (-6e3, 1.5e5)),
        (replace(ALWAYS, course=replace(SINE, mean=-2.0)), 50.0, (-6e3, 1.5e5)),
        (over_the_ram(descent=Reciprocating(stroke=0.02, period=0.3)), 1.0, (0.0, -0.01 * STIFFNESS)),
    ],
)
def test_the_largest_force_of_a_run(load: ActingLoad, duration: float, largest: Vector2) -> None:
    system = kinetics_of(Scenario(machine=Ram(), duration=1.0).linkage)
    found = largest_forces(system, {"load": load}, duration)
    assert found[:2] == pytest.approx(largest, rel=1e-2)  # what lies between two of the times
