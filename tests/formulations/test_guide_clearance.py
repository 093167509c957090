"""Blocks and pins with clearance in guides, against equations of their own and what has to be conserved."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from support_exudyn import (
    Body,
    Linkage,
    Machine,
    Result,
    Scenario,
    Slide,
    SolverSettings,
    simulate,
)
from support_exudyn.model.guides import ClearanceGuide
from tests.cases.guide_cases import (
    BLOCK,
    FreePair,
    Touch,
    pair_by_scipy,
    slider_crank,
    slider_crank_by_scipy,
    start_of,
)
from user_forces import (
    Ambrosio,
    Exact,
    Frictionless,
    HuntCrossley,
    InputError,
    LankaraniNikravesh,
    NormalLaw,
    delivered_restitution,
    value,
)

RUBBING = Ambrosio(sliding_coefficient=0.2, dynamic_speed=0.05)
KEPT = Exact(stiffness=1e8, restitution=0.6, rest_velocity=1e-9)
IN_BLOCK = ClearanceGuide(gaps=(1e-3, 5e-4), normal=KEPT, friction=RUBBING, block=BLOCK)
AS_PIN = ClearanceGuide(gaps=(1e-3, 5e-4), normal=KEPT, friction=RUBBING, pin_radius=0.02)
GRAVITY = (0.0, -9.81)


def pair(machine: FreePair, guide: ClearanceGuide, duration: float, **others: object) -> Scenario:
    """A block or a pin and its carrier."""
    known = {
        "gravity": GRAVITY, "step": 2e-5, "solver": SolverSettings(impact_steps=128), "record_period": 1e-3,
        "formulation": "exudyn",
    }  # fmt: skip
    return Scenario(machine=machine, guides={"guide": guide}, duration=duration, **(known | others))


def end(result: Result) -> np.ndarray:
    """x, y, angle of every body from the start on, then their rates, at the end."""
    bodies = result.scenario.linkage.bodies
    ways = [
        float(result[f"{name}.{way}"][-1]) - (body.angle if way == "angle" else 0.0)
        for name, body in bodies.items()
        for way in ("x", "y", "angle")
    ]
    rates = ("velocity_x", "velocity_y", "angular_velocity")
    return np.array(ways + [float(result[f"{name}.{rate}"][-1]) for name in bodies for rate in rates])


# --- against equations of their own ---


@pytest.mark.parametrize(
    ("sliding", "formulation"),
    [(0.0, "compiled"), (0.01, "compiled"), pytest.param(0.01, "exudyn", marks=pytest.mark.slow)],
)
def test_a_slider_between_walls_moves_as_by_scipy(sliding: float, formulation: str) -> None:
    friction = Ambrosio(sliding_coefficient=sliding) if sliding else Frictionless()
    other = slider_crank_by_scipy(1e9, friction if isinstance(friction, Ambrosio) else None)
    state = other.run((0.0, 0.0, 0.0), (150.0, -75.0, 0.0), 0.007)
    scene = slider_crank(1e9, 0.007, friction, step=2e-6, impact_steps=512)
    # the block's tilt hangs on how corners hit one after the other
    solver = replace(scene.solver, tolerance=1e-11)
    result = simulate(replace(scene, formulation=formulation, solver=solver))
    onsets, share, rest = (1e-9, 1e-7, 1e-7) if formulation == "compiled" else (5e-8, 1e-6, 2e-6)
    check_onsets(result, other.touches, onsets)
    bodies = ("crank", "rod", "slider")
    found = [result[f"{n}.{what}"][-1] for what in ("angle", "angular_velocity") for n in bodies]
    np.testing.assert_allclose(found, state, rtol=share, atol=rest)


def check_onsets(result: Result, touches: list[tuple[str, float, float]], within: float) -> None:
    """The impacts are those found otherwise, to a time [s]."""
    for name, onsets in result.onsets.items():
        wanted = [(time, speed) for corner, time, speed in touches if name == f"guide.{corner}"]
        assert len(onsets) == len(wanted), name
        for one, right in zip(onsets, wanted, strict=True):
            np.testing.assert_allclose((one.time, one.speed), right, rtol=2e-4, atol=within)


@cache
def by_scipy(machine: FreePair, guide: ClearanceGuide) -> tuple[np.ndarray, list[Touch]]:
    """The state after 4.5 ms of a block or a pin and its carrier, and the impacts until then."""
    other = pair_by_scipy(machine, guide, GRAVITY)
    return other.run(*start_of(machine.linkage()), 0.0045, rtol=1e-9), other.touches


@pytest.mark.parametrize("formulation", ["exudyn", "compiled"])
@pytest.mark.parametrize(
    ("machine", "guide"),
    [
        (FreePair(), IN_BLOCK),
        (FreePair(turns=True), AS_PIN),
        (FreePair(grounded=True), IN_BLOCK),
    ],
    ids=["block", "pin", "on the ground"],
)
def test_a_slot_that_moves_and_turns_with_friction(
    machine: FreePair, guide: ClearanceGuide, formulation: str
) -> None:
    solver = SolverSettings(impact_steps=128, tolerance=1e-10)
    result = simulate(pair(machine, guide, 0.0045, formulation=formulation, solver=solver))
    state, touches = by_scipy(machine, guide)
    assert sum(map(len, result.onsets.values())) >= 2
    onsets, share, rest = (1e-8, 1e-6, 1e-7) if formulation == "compiled" else (3e-7, 1e-3, 1e-4)
    check_onsets(result, touches, onsets)
    np.testing.assert_allclose(end(result), state, rtol=share, atol=rest)


# --- what is conserved ---


@pytest.mark.parametrize("guide", [IN_BLOCK, AS_PIN], ids=["block", "pin"])
def test_momentum_is_conserved_in_a_long_slot_that_turns(guide: ClearanceGuide) -> None:
    machine = FreePair(along=2.0, carrier_spin=8.0, velocity=(-3.0, 15.0), turns=guide.pin_radius is not None)
    solver = SolverSettings(impact_steps=64)
    result = simulate(pair(machine, guide, 0.02, gravity=(0.0, 0.0), solver=solver))
    bodies = machine.linkage().bodies
    px, py, turning = 0.0, 0.0, 0.0
    for name, body in bodies.items():
        x, y, vx, vy = (result[f"{name}.{what}"] for what in ("x", "y", "velocity_x", "velocity_y"))
        px, py = px + body.mass * vx, py + body.mass * vy
        turning = turning + body.mass * (x * vy - y * vx) + body.inertia * result[f"{name}.angular_velocity"]
    assert sum(map(len, result.onsets.values())) >= 3
    assert np.ptp(result["carrier.angle"]) > 0.1
    for series, size in ((px, 10.0), (py, 10.0), (turning, 20.0)):
        assert np.ptp(series) < 1e-9 * size
    kinetic = float(result["energy.kinetic"][0])
    assert np.abs(result["energy.balance"]).max() < 5e-6 * kinetic
    assert result["energy.friction_loss"][-1] > 1e-3 * kinetic


@value
class Block(Machine):
    """A free block in a level guide on the ground, in whose middle its centre is."""

    velocity: tuple[float, float] = (0.3, 0.5)
    spin: float = 0.0
    inertia: float = 0.003
    turns: bool = False

    def linkage(self) -> Linkage:
        return Linkage(
            bodies={
                "block": Body(
                    mass=2.0, inertia=self.inertia, centre=(0.0, 0.0), velocity=self.velocity, spin=self.spin
                )
            },
            slides={"guide": Slide(body="block", point=(0.0, 0.0), turns=self.turns)},
        )


@pytest.mark.parametrize(
    "law",
    [
        Exact(stiffness=1e10, restitution=0.4),
        LankaraniNikravesh(stiffness=1e10, restitution=0.8),
        HuntCrossley(stiffness=1e10, restitution=0.7, rest_velocity=1e-3),
    ],
    ids=lambda law: type(law).__name__,
)
@pytest.mark.parametrize("part", ["face", "corner", "pin"])
def test_an_impact_delivers_the_restitution_of_its_law(law: NormalLaw, part: str) -> None:
    # a block that turns lands with one corner, one that does not with a face, which is both
    # with next to no inertia, both corners of a face are far from the mass that either has by itself
    inertia = 1e-5 if part == "face" else 0.003
    machine = Block(spin=3.0 if part == "corner" else 0.0, inertia=inertia, turns=part == "pin")
    shape = {"pin_radius": 0.03} if part == "pin" else {"block": BLOCK}
    guide = ClearanceGuide(gaps=(1e-3, 1e-3), normal=law, **shape)
    result = simulate(pair(machine, guide, 3.5e-3, gravity=(0.0, 0.0), solver=SolverSettings(impact_steps=256)))
    wanted = delivered_restitution(law.factor(law.restitution))
    name = {"face": "upper_left", "corner": "upper_right", "pin": "pin"}[part]
    (onset, *_) = result.onsets[f"guide.{name}"]
    assert math.isfinite(onset.separation_time)
    if part == "corner":
        (other, *_) = result.onsets["guide.upper_left"]
        assert other.time > onset.separation_time  # it was alone
    # the corner goes on along the wall meanwhile, and its lever changes by a thousandth
    assert onset.separation_velocity / onset.speed == pytest.approx(
        wanted, rel=2e-3 if part == "corner" else 2e-4
    )


# --- what is recorded ---


def test_channels_are_those_of_the_corners() -> None:
    machine = FreePair(along=0.2)
    result = simulate(pair(machine, IN_BLOCK, 0.006, record_period=5e-5))
    c, s = (f(0.4 + result["carrier.angle"] - 0.7) for f in (np.cos, np.sin))
    tilt = result["block.angle"] + 0.2 - (result["carrier.angle"] - 0.7)
    np.testing.assert_allclose(result["guide.guide.tilt"], tilt, atol=1e-12)
    a, b = 0.5 * BLOCK[0], 0.5 * BLOCK[1]
    # the guide's point lies 10 mm forward of the block's centre, which at the start is at the carrier's level
    turned = 0.2 + result["block.angle"]
    point_x = result["block.x"] + 0.01 * np.cos(turned)
    point_y = result["block.y"] + 0.01 * np.sin(turned)
    start = np.array([point_x[0] - 0.2, point_y[0] - 0.1])
    # of the guide's line above the carrier's centre
    height = math.cos(0.4) * start[1] - math.sin(0.4) * start[0]
    across = c * (point_y - result["carrier.y"]) - s * (point_x - result["carrier.x"]) - height
    arms = {"upper_left": (-a, b), "upper_right": (a, b), "lower_left": (-a, -b), "lower_right": (a, -b)}
    gaps = {}
    for name, (x, y) in arms.items():
        above = across + np.sin(tilt) * x + np.cos(tilt) * y
        gaps[name] = b + 1e-3 - above if y > 0 else above + b + 5e-4
        np.testing.assert_allclose(result[f"guide.guide.{name}.gap"], gaps[name], atol=1e-12)
    for wall in ("upper", "lower"):
        least = np.minimum(gaps[f"{wall}_left"], gaps[f"{wall}_right"])
        np.testing.assert_allclose(result[f"guide.guide.gap_{wall}"], least, atol=1e-12)
    # Newton and Euler on the block, whose accelerations follow from all forces together
    inertia = 4e-4
    normal = {name: result[f"guide.guide.{name}.normal_force"] for name in arms}
    force = sum(np.sign(-y) * normal[name] for name, (_, y) in arms.items())
    assert np.abs(force).max() > 10.0
    np.testing.assert_allclose(result["guide.guide.force"], force, atol=1e-9 * np.abs(force).max())
    rubbed = sum(np.sign(-y) * result[f"guide.guide.{name}.friction_force"] for name, (_, y) in arms.items())
    np.testing.assert_allclose(result["guide.guide.friction_force"], rubbed, atol=1e-6)
    along = {n: np.cos(tilt) * x - np.sin(tilt) * y for n, (x, y) in arms.items()}
    pressed = sum(normal.values())
    touching = pressed > 0.0
    place = sum(along[name] * normal[name] for name in arms)
    np.testing.assert_allclose(
        result["guide.guide.place"][touching], (place / np.where(touching, pressed, 1.0))[touching]
    )
    assert not result["guide.guide.place"][~touching].any()
    # moment about the guide's point, and the same about the centre from the angular acceleration
    lever_x, lever_y = -0.01 * np.cos(turned), -0.01 * np.sin(turned)
    on_x = -s * force + c * rubbed
    on_y = c * force + s * rubbed
    about_centre = result["guide.guide.moment"] - (lever_x * on_y - lever_y * on_x)
    np.testing.assert_allclose(
        inertia * result["block.angular_acceleration"], about_centre, atol=1e-7 * np.abs(about_centre).max()
    )


# --- at rest, and what is refused ---


@pytest.mark.parametrize("mu", [0.0, 0.2])
def test_a_block_that_lies_on_its_wall_slides_as_coulomb_says(mu: float) -> None:
    friction = Ambrosio(sliding_coefficient=mu) if mu else Frictionless()
    guide = ClearanceGuide(
        gaps=(1e-3, 0.0), normal=Exact(stiffness=1e9, restitution=0.5), friction=friction, block=BLOCK
    )
    result = simulate(pair(Block(velocity=(0.3, 0.0)), guide, 0.05, step=1e-4))
    weight = 2.0 * -GRAVITY[1]
    assert result["guide.guide.force"][-20:] == pytest.approx(weight * np.ones(20), rel=1e-4)
    assert result["guide.guide.friction_force"][-1] == pytest.approx(-mu * weight, rel=1e-4)
    assert result["block.velocity_x"][-1] == pytest.approx(0.3 + mu * GRAVITY[1] * 0.05, rel=1e-4)
    # without a moment about its centre: the wall presses ahead of it, by as much as friction is below
    assert result["guide.guide.place"][-1] == pytest.approx(mu * 0.5 * BLOCK[1], rel=1e-3, abs=1e-6)
    assert result["guide.guide.moment"][-1] == pytest.approx(0.0, abs=1e-4 * weight)


def test_what_does_not_fit_is_refused() -> None:
    guide = ClearanceGuide.simple(gaps=1e-3, block=BLOCK)
    scene = pair(FreePair(), guide, 0.01)
    with pytest.raises(InputError, match=r"guides\.slot: unknown guide 'slot'; allowed: guide"):
        replace(scene, guides={"slot": guide})
    with pytest.raises(InputError, match=r"guides\.guide: has a pin_radius; allowed: block"):
        replace(scene, guides={"guide": ClearanceGuide.simple(gaps=1e-3, pin_radius=0.01)})
    with pytest.raises(InputError, match=r"guides\.guide: has a block; allowed: pin_radius"):
        pair(FreePair(turns=True), guide, 0.01)
    with pytest.raises(InputError, match=r"gaps = \(0\.0, 0\.0\) m: allowed: at least one > 0"):
        ClearanceGuide.simple(gaps=0.0, block=BLOCK)
