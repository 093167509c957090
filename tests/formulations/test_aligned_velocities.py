"""Long steps before tiny ones: velocities are aligned with the constraints between them."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from support_exudyn import Reciprocating, Result, Scenario, SolverSettings, simulate
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.formulations.redundant.solver.solver import MUCH_SHORTER, SolverRun
from support_exudyn.formulations.redundant.space.scene import rates, velocities
from support_exudyn.formulations.redundant.space.scene_builder import build as build_in_space
from support_exudyn.mechanics.space.constraints import matrix
from support_exudyn.simulation.result_checks import turned_over
from tests.cases.run_cases import FORCE, PIN, SLIDER_PIN, loose_slider_crank, loose_support, slider_crank

LONG = 1e-3  # [s]
SOLVER = SolverSettings(impact_steps=64, spectral_radius=0.287)
TIGHT = SolverSettings(tolerance=1e-9)
WEIGHTLESS, HEAVY = (0.0, 0.0), (0.0, -9.81)
# Energy that is open, of what was turned over, at steps of 1 ms: they are of second order. Measured: up to
# 1.2e-3 at 1 ms, 4 times that at 2 ms. (With velocities as steps leave them, five of the runs below could not
# be finished.)
OPEN = 2.5e-3


def shaken(clearance_mm: float, step: float, **changes: object) -> Scenario:
    """The support goes up and down ten times a second; the journal flies from side to side of its bore."""
    fields: dict[str, object] = {
        "drive": Reciprocating(stroke=0.01, period=0.1),
        "duration": 0.12,
        "gravity": WEIGHTLESS,
        "step": step,
        "record_period": step,
        "solver": SOLVER,
    }
    return loose_support(clearance_mm, **(fields | changes))


CASES = [(1.5, 2.0 * LONG), (1.65, 2.0 * LONG), (1.7, LONG), (1.75, LONG), (2.0, LONG)]


@pytest.mark.parametrize("gravity", [WEIGHTLESS, HEAVY])
@pytest.mark.parametrize(("clearance_mm", "step"), CASES)
def test_a_shaken_support_is_as_the_compiled_one(
    clearance_mm: float, step: float, gravity: tuple[float, float]
) -> None:
    scene = shaken(clearance_mm, step, gravity=gravity)
    result, exact = simulate(scene), simulate(replace(scene, formulation="compiled", solver=TIGHT))
    assert len(result.onsets[PIN]) >= 3
    assert result.energy_error < OPEN * (step / LONG) ** 2 * turned_over(result.channels)
    # second order; measured: 1.1e-3 of a step, 1.3e-4 of the speed
    for impact, true in zip(result.onsets[PIN][:2], exact.onsets[PIN][:2], strict=True):
        assert impact.time == pytest.approx(true.time, abs=2e-3 * step)
        assert impact.speed == pytest.approx(true.speed, rel=1e-3 * (step / LONG) ** 2)
    # forces that make up for wrong velocities would be thousands of times as large as these
    assert result.largest_force[PIN] == pytest.approx(exact.largest_force[PIN], rel=0.01)
    for name in result.channels:
        if name.endswith(".force"):
            assert result[name].max() == pytest.approx(exact[name].max(), rel=0.03), name


def test_in_space_it_is_as_in_the_plane() -> None:
    plane = simulate(shaken(1.75, LONG, duration=0.06))
    space = simulate(shaken(1.75, LONG, duration=0.06, dimensions=3))
    assert len(space.onsets[PIN]) == 1
    # Newton's method leaves 1e-8 of a step's forces
    for name in ("tip.x", "tip.y", FORCE, "energy.kinetic"):
        scale = float(np.abs(plane[name]).max())
        np.testing.assert_allclose(space[name], plane[name], atol=1e-4 * scale)
    assert space.energy_error == pytest.approx(plane.energy_error, rel=1e-3)


def rattling(step: float) -> Scenario:
    """The slider-crank at 5000 rpm until its journal has struck three times."""
    return loose_slider_crank(0.0008, step=step, record_period=1e-4, solver=SOLVER)


def test_a_slider_crank_is_as_the_compiled_one() -> None:
    step = 2e-5
    result = simulate(rattling(step))
    exact = simulate(replace(rattling(step), formulation="compiled", solver=TIGHT))
    assert len(result.onsets[SLIDER_PIN]) == len(exact.onsets[SLIDER_PIN]) == 3
    for impact, true in zip(result.onsets[SLIDER_PIN], exact.onsets[SLIDER_PIN], strict=True):
        # a crank turns by 0.01 rad in a step; measured: 0.2 %, 4e-7 s
        assert impact.speed == pytest.approx(true.speed, rel=5e-3)
        assert impact.time == pytest.approx(true.time, abs=1e-6)
    # measured: 8e-5; 6e-3 with velocities as steps leave them
    assert result.energy_error < 5e-4 * turned_over(result.channels)


def test_a_crank_that_turns_far_in_a_step_is_finished_all_the_same() -> None:
    # 0.05 rad in a step: Newton's method gave up at the first impact
    result = simulate(rattling(1e-4))
    assert len(result.onsets[SLIDER_PIN]) == 3
    assert result.energy_error < 5e-3 * turned_over(result.channels)  # measured: 1.1e-3


# --- what aligning does ---


def at(scene: Any, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A made-up state: small displacements, and velocities that no constraint would have."""
    random = np.random.default_rng(seed)
    data = scene.mbs.systemData
    size = data.ODE2Size()
    position, velocity = 0.01 * random.normal(size=size), random.normal(size=size)
    data.SetODE2Coordinates(position)
    data.SetODE2Coordinates_t(velocity)
    return position, velocity


PLANAR = {
    "support": shaken(1.7, LONG),
    "slider-crank": loose_slider_crank(1e-3),
    "ideal slider-crank": slider_crank(1e-3),
}


@pytest.mark.parametrize("name", PLANAR)
@pytest.mark.parametrize("time", [0.0, 0.037])
def test_after_it_constraints_have_their_rates(name: str, time: float) -> None:
    scene = build(PLANAR[name])
    position, before = at(scene, 7)
    wanted = scene.kinetics.rates(lambda part: scene.scenario.drive_of(part).speed(time))
    rows, mass = scene.kinetics.rows(position), scene.kinetics.mass()
    missing = float(np.abs(rows @ before - wanted).max())
    assert missing > 0.1
    work = scene.align(time)
    after = scene.mbs.systemData.GetODE2Coordinates_t()
    # rounding of the solution of equations with masses of 10 t, or arms of centimetres
    assert np.abs(rows @ after - wanted).max() < 1e-10 * max(1.0, float(np.abs(wanted).max()))
    np.testing.assert_array_equal(scene.mbs.systemData.GetODE2Coordinates(), position)
    # by impulses of the constraints alone: what they leave free goes on as it was
    change = after - before
    free = np.linalg.svd(rows)[2][np.linalg.matrix_rank(rows) :]
    assert free.shape[0] >= (0 if name == "ideal slider-crank" else 1)
    assert np.abs(free @ (mass * change)).max(initial=0.0) < 1e-10 * np.abs(mass * change).max()
    # the drives' work, less what an inelastic impact loses, which is of second order in the change
    gained = 0.5 * (mass * after) @ after - 0.5 * (mass * before) @ before
    lost = 0.5 * (mass * change) @ change
    assert gained == pytest.approx(work - lost, rel=1e-9, abs=1e-9 * lost)
    # once more changes nothing
    assert scene.align(time) == pytest.approx(0.0, abs=1e-9 * max(abs(work), lost))
    np.testing.assert_allclose(scene.mbs.systemData.GetODE2Coordinates_t(), after, rtol=1e-9, atol=1e-9)


def test_in_space_too() -> None:
    scene = build_in_space(shaken(1.7, LONG, dimensions=3))
    random = np.random.default_rng(7)
    scene.set_velocities(random.normal(size=6 * len(scene.bodies)))
    time = 0.037
    kinetics = scene.kinetics()
    speeds = {name: scene.scenario.drive_of(name).speed(time) for name in scene.rigid_actuators}
    assert all(abs(speed) > 0.1 for speed in speeds.values())
    wanted = rates(kinetics.rows, speeds)
    rows, mass = matrix(kinetics.motion, kinetics.rows)[0], kinetics.mass()
    before = velocities(kinetics.motion)
    assert np.abs(rows @ before - wanted).max() > 0.1
    work = scene.align(time)
    after = velocities(scene.motion())
    assert np.abs(rows @ after - wanted).max() < 1e-10  # as above
    change = after - before
    gained = 0.5 * (mass @ after) @ after - 0.5 * (mass @ before) @ before
    assert gained == pytest.approx(work - 0.5 * (mass @ change) @ change, rel=1e-9)


# --- when it is done ---


def pin(depth: float, rate: float, step: float = math.inf) -> SimpleNamespace:
    """A clearance pin with a depth and its rate at the end of a step; step: of an impact that goes on."""
    return SimpleNamespace(
        impact_steps=SimpleNamespace(step=step), reached=SimpleNamespace(depth=depth, rate=rate)
    )


@pytest.mark.parametrize(
    ("pins", "following", "cut"),
    [
        ((pin(-1e-3, 0.1),), LONG, False),  # 0.1 mm of 1 mm
        ((pin(-1e-4, 0.1),), LONG, True),  # impacts within the step, or soon after
        ((pin(-1e-4, -0.1),), LONG, False),  # flies away
        ((pin(1e-4, 0.1),), LONG, False),  # goes deeper
        ((pin(1e-4, -0.1),), LONG, True),  # parts
        ((pin(1e-4, -0.1, step=1e-6),), LONG, False),  # within an impact, whose steps are short anyway
        ((pin(-1e-3, 0.1),), 0.99 * LONG / MUCH_SHORTER, True),
        ((pin(-1e-3, 0.1),), 1.01 * LONG / MUCH_SHORTER, False),
        ((pin(-1e-3, 0.1), pin(-1e-4, 0.1)), LONG, True),  # one of two
        ((), 1e-6, False),
    ],
)
def test_steps_that_will_be_cut_are_known(
    pins: tuple[SimpleNamespace, ...], following: float, cut: bool
) -> None:
    for locates in (True, False):  # where impacts are not located nothing is cut
        run: Any = SimpleNamespace(pins=pins, legs=SimpleNamespace(names=()), locates=locates)
        assert SolverRun._is_to_be_cut(run, LONG, following) == (cut and locates)


def test_it_is_done_at_touches_and_seldom_else(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    plain = SolverRun._is_to_be_cut

    def watched(self: SolverRun, taken: float, following: float) -> bool:
        asked.append(plain(self, taken, following))
        return asked[-1]

    monkeypatch.setattr(SolverRun, "_is_to_be_cut", watched)
    result: Result = simulate(shaken(1.75, LONG))
    impacts = len(result.onsets[PIN])
    # before and after every contact, and some of the steps of the vibration between
    assert 2 * impacts <= sum(asked) < 0.25 * len(asked)
