"""Parts of the compiled formulation as they are written: joints, factors, effective courses."""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import copy
from functools import cache
from itertools import pairwise
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
import pytest

from support_exudyn import (
    Body,
    CubicStep,
    Drive,
    Held,
    LinearActuator,
    Linkage,
    Machine,
    Scenario,
    SolverSettings,
    Steady,
    TableDrive,
    UniformSpeed,
)
from support_exudyn.files.machines.read import read_machine
from support_exudyn.formulations.compilation import plain
from support_exudyn.formulations.compiled import motion
from support_exudyn.formulations.compiled.arrays import SceneArrays
from support_exudyn.formulations.compiled.courses import courses, segment_edges
from support_exudyn.formulations.compiled.run import _Run
from support_exudyn.formulations.compiled.setup import Model, model_of
from support_exudyn.formulations.contract import silent
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.model.linkage import GROUND, pinned
from tests.cases.guide_cases import FreePair, slider_crank
from tests.cases.run_cases import loose_slider_crank, support
from tests.formulations import test_guide_clearance as guides
from tests.formulations import test_slots_and_gears as slots
from tests.formulations.test_compiled_agrees import PINS, loose
from tests.linkage_cases import CrankRocker
from user_forces import value
from user_forces.lawful import LawError

RISE = CubicStep(stroke=0.2, start=0.0, end=1.0)
TURNING = Steady(rate=3.0)
SCENES: dict[str, Callable[[], Scenario]] = {
    "support": lambda: support(drive=RISE),
    "support, two loose pins": lambda: support(drive=RISE, pins=loose("rear_base", "shield_canopy")),
    "support, all pins loose": lambda: support(drive=RISE, pins=loose(*PINS)),
    "two-leg shield": lambda: Scenario(
        machine=read_machine("two_leg_shield").machine, drive=RISE, duration=1.0
    ),
    "slider-crank": lambda: loose_slider_crank(1e-3),
    "slider between walls": lambda: slider_crank(1e9, 0.01),
    "a pin in a slot": lambda: guides.pair(FreePair(turns=True), guides.AS_PIN, 0.01),
    "a slot between bodies": lambda: Scenario(machine=slots.ScotchYoke(), drive=TURNING, duration=1.0),
    "gears": lambda: Scenario(machine=slots.GearPair(), drive=TURNING, duration=1.0),
    "crank-rocker": lambda: Scenario(machine=CrankRocker(driven=True), drive=TURNING, duration=1.0),
}
EVERY_SCENE = pytest.mark.parametrize("name", SCENES)
TIME = 0.3  # share of the duration, at which drives are somewhere


class Instant(NamedTuple):
    """A scene at places and velocities that no run has: far from closed, so that everything shows."""

    model: Model
    scene: SceneArrays
    kinetics: Kinetics
    y: np.ndarray
    position: np.ndarray
    velocity: np.ndarray


@cache
def _model(name: str) -> Model:
    return model_of(SCENES[name]())


def readable(scene: SceneArrays) -> SceneArrays:
    """The same with records that plain Python reads by the names of their fields."""
    return SceneArrays(
        *(
            one.view(np.recarray) if isinstance(one, np.ndarray) and one.dtype.names else one
            for one in map(copy, scene)
        )
    )


def instant(name: str, seed: int = 1, apart: float = 0.05) -> Instant:
    model = _model(name)
    rng, count = np.random.default_rng(seed), 3 * len(model.scenario.linkage.bodies)
    y = np.zeros(model.states)
    y[:count], y[count : 2 * count] = apart * rng.normal(size=count), rng.normal(size=count)
    scenario, scene = model.scenario, readable(model.scene)
    rigid = [one for one in scenario.linkage.actuators if one not in scenario.compliant_actuators]
    plain(motion.follow_courses)(scene, TIME * scenario.duration)
    _look(scene, y)
    return Instant(
        model,
        scene,
        kinetics_of(scenario.guided_linkage, scenario.held_pins, rigid),
        y,
        y[:count],
        y[count : 2 * count],
    )


def _look(scene: SceneArrays, y: np.ndarray) -> None:
    plain(motion.place)(scene, y)
    plain(motion.hold)(scene, y)


def matrix(scene: SceneArrays, count: int) -> np.ndarray:
    """The rows as a matrix over all velocities."""
    found = np.zeros((scene.rows.size, count))
    for row, one in zip(found, scene.rows, strict=True):
        if one.body >= 0:
            row[3 * one.body : 3 * one.body + 3] += one.x, one.y, one.t
        if one.other >= 0:
            row[3 * one.other : 3 * one.other + 3] += one.ox, one.oy, one.ot
    return found


# --- joints ---


@EVERY_SCENE
def test_rows_are_those_of_mechanics(name: str) -> None:
    at = instant(name)
    rows = matrix(at.scene, at.position.size)[at.model.order]
    np.testing.assert_allclose(rows, at.kinetics.rows(at.position), atol=1e-13)


@EVERY_SCENE
def test_rows_are_the_slopes_of_what_joints_leave_open(name: str) -> None:
    at, h = instant(name), 1e-6
    rows = matrix(at.scene, at.position.size)
    for i in range(at.position.size):
        off = []
        for shift in (h, -h):
            y = at.y.copy()
            y[i] += shift
            _look(at.scene, y)
            off.append(at.scene.rows.off.copy())
        # central differences: h^2, and rounding by h
        np.testing.assert_allclose((off[0] - off[1]) / (2.0 * h), rows[:, i], atol=1e-8)


@EVERY_SCENE
def test_what_rows_ask_of_accelerations_is_what_their_turning_leaves(name: str) -> None:
    at, h = instant(name), 1e-6
    before, after = (at.kinetics.rows(at.position + shift * at.velocity) for shift in (-h, h))
    wanted = -(after - before) @ at.velocity / (2.0 * h)
    for driven, row in at.model.driven_rows.items():
        if driven in at.model.drives:
            wanted[list(at.model.order).index(row)] += at.scene.courses[at.model.drives.index(driven)].bend
    found = at.scene.rows.wanted[at.model.order]
    np.testing.assert_allclose(found, wanted, atol=1e-8 * max(1.0, np.abs(wanted).max(initial=0.0)))


@EVERY_SCENE
def test_factors_within_the_envelope_solve_as_numpy_does(name: str) -> None:
    at = instant(name)
    rows = matrix(at.scene, at.position.size)
    square = rows @ (rows / at.kinetics.mass()).T
    least = plain(motion.factor)(at.scene)
    right = np.random.default_rng(2).normal(size=len(rows))
    known = np.linalg.solve(square, right) if right.size else right.copy()
    plain(motion.divide)(at.scene, right)
    np.testing.assert_allclose(right, known, rtol=1e-9, atol=1e-11 * np.abs(known).max(initial=0.0))
    assert 0.0 < least <= 1.0
    # nothing outside of it was needed
    assert all(square[i, : one.first] == pytest.approx(0.0, abs=1e-15) for i, one in enumerate(at.scene.rows))


@value
class Stretched(Machine):
    """A bar on a pivot, and an actuator that comes to lie in line with it as its head sinks to height 0."""

    height: float

    def linkage(self) -> Linkage:
        head = (1.0, self.height)
        jack = LinearActuator(foot=GROUND, head="bar", foot_point=(2.0, 0.0), head_point=head)
        return Linkage(
            bodies={"bar": Body(mass=3.0, inertia=0.5, centre=(0.5, 0.0))},
            pins={"pivot": pinned(GROUND, "bar", (0.0, 0.0))},
            actuators={"jack": jack},
        )


@pytest.mark.parametrize(("height", "dead"), [(0.1, False), (1e-3, False), (1e-7, True)])
def test_the_share_that_is_left_of_rows_tells_a_dead_centre(height: float, dead: bool) -> None:
    model = model_of(Scenario(machine=Stretched(height=height), duration=1.0))
    scene = readable(model.scene)
    _look(scene, np.zeros(model.states))
    assert (plain(motion.factor)(scene) < motion.SINGULAR) == dead


@EVERY_SCENE
def test_accelerations_solve_the_equations_of_motion(name: str) -> None:
    at, rng = instant(name), np.random.default_rng(3)
    for body in at.scene.bodies:
        body.fx, body.fy, body.m = 1e3 * rng.normal(size=3)
    acting = np.array([part for body in at.scene.bodies for part in (body.fx, body.fy, body.m)])
    plain(motion.factor)(at.scene)
    plain(motion.solve)(at.scene, np.zeros(at.scene.rows.size))
    found = np.array([part for body in at.scene.bodies for part in (body.ax, body.ay, body.a)])
    rows, held = matrix(at.scene, found.size), at.scene.rows.held
    scale = np.abs(acting).max() + np.abs(rows.T @ held).max(initial=0.0)
    np.testing.assert_allclose(at.kinetics.mass() * found + rows.T @ held, acting, atol=1e-9 * scale)
    np.testing.assert_allclose(
        rows @ found, at.scene.rows.wanted, atol=1e-9 * max(1.0, np.abs(rows @ found).max(initial=0.0))
    )


def test_every_step_ends_with_its_joints_closed() -> None:
    solver = SolverSettings(tolerance=1e-9)
    scene = Scenario(
        machine=CrankRocker(angle=0.3, speed=10.0), duration=2.0, formulation="compiled", solver=solver
    )
    run = _Run(model_of(scene))
    run.go(silent)
    left = readable(run.model.scene)
    _look(left, run.y)
    # within rounding; steps of this tolerance that nothing closes add up to some 1e-8 m
    assert np.abs(left.rows.off).max() < 3e-13
    assert np.abs(matrix(left, 9) @ run.y[9:18]).max() < 1e-12


# --- what follows time ---


def followed(function: Callable[[float], float], edges: list[float], t: float) -> tuple[float, float, float]:
    """Value, rate and second derivative of a function at a time, as a run has them."""
    found = courses([function], edges)
    segment = max(n for n, edge in enumerate(edges[:-1]) if edge <= t)
    scene: Any = SimpleNamespace(
        courses=found.segments[segment].view(np.recarray),
        pieces=found.pieces.view(np.recarray),
        coefficients=found.coefficients,
    )
    plain(motion.follow_courses)(scene, t)
    one = scene.courses[0]
    return float(one.value), float(one.rate), float(one.bend)


@pytest.mark.parametrize("rate", [1.0, 40.0])
def test_smooth_functions_are_met_to_rounding(rate: float) -> None:
    for t in np.linspace(0.0, 1.0, 37).tolist():
        value, speed, bend = followed(lambda t: math.sin(rate * t + 0.3), [0.0, 1.0], t)
        # sixteen roundings, and what they are by length of the pieces
        assert value == pytest.approx(math.sin(rate * t + 0.3), abs=1e-14)
        assert speed == pytest.approx(rate * math.cos(rate * t + 0.3), abs=1e-11 * rate)
        assert bend == pytest.approx(-(rate**2) * math.sin(rate * t + 0.3), abs=1e-8 * rate**2)


@pytest.mark.parametrize(
    "drive",
    [
        Held(),
        Steady(rate=-0.3),
        CubicStep(stroke=0.3, start=0.25, end=0.8),
        UniformSpeed(stroke=0.3, start=0.25, end=0.8),
        TableDrive(times=(0.1, 0.35, 0.7), extensions=(0.0, 0.01, 0.002)),
    ],
    ids=lambda drive: type(drive).__name__,
)
def test_drives_are_followed_between_their_breaks(drive: Drive) -> None:
    edges = segment_edges(drive.breaks, 1.0)
    found = courses([drive.extension], edges)
    assert len(found.pieces) == len(found.segments) == len(edges) - 1  # cubics at most: a piece each
    for begin, end in pairwise(edges):
        for x in (0.1, 0.5, 0.9):
            t = begin + x * (end - begin)
            value, rate, _ = followed(drive.extension, edges, t)
            assert value == pytest.approx(drive.extension(t), abs=1e-15)
            assert rate == pytest.approx(drive.speed(t), abs=1e-12)


def test_a_kink_that_nobody_told_is_met_by_short_pieces() -> None:
    for t in (0.1, 0.299999, 0.300001, 0.7):
        value, rate, _ = followed(lambda t: abs(t - 0.3), [0.0, 1.0], t)
        assert value == pytest.approx(abs(t - 0.3), abs=1e-9)
        assert rate == pytest.approx(math.copysign(1.0, t - 0.3), abs=1e-9)


def test_a_jump_that_nobody_told_is_refused() -> None:
    with pytest.raises(LawError, match=r"jumps by .* near 0\.(3|29999)"):
        courses([lambda t: float(t > 0.3)], [0.0, 1.0])
    # where it is told it is none
    courses([lambda t: float(t > 0.3)], [0.0, 0.3 + 1e-12, 1.0])


def test_what_is_no_number_is_refused() -> None:
    with pytest.raises(LawError, match="not finite"):
        courses([lambda t: math.nan], [0.0, 1.0])


def test_nothing_to_follow_is_nothing() -> None:
    found = courses([], [0.0, 0.5, 1.0])
    assert [segment.size for segment in found.segments] == [0, 0]
