"""Exudyn's own solution file of a run, and its model with the look of the machine, of every formulation."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import exudyn
import numpy as np
import pytest
from exudyn.utilities import LoadSolutionFile, SetSolutionState
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from support_exudyn import (
    CubicStep,
    OilColumn,
    Result,
    Scenario,
    bore_area,
    save_solution,
    simulate,
)
from support_exudyn.__main__ import main
from support_exudyn.files import save_scenario
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.formulations.exudyn.solver import solver
from support_exudyn.mechanics.body_motion import rotation
from support_exudyn.postprocessing.export.solution_file import euler_parameters, rows
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.postprocessing.viewer.view import POSITION, SHOWN, ViewerModel
from tests.cases.run_cases import loose_slider_crank, loose_support, support

STROKE, TIME = 0.02, 0.05  # [m], [s]
RISE: dict[str, Any] = {"drive": CubicStep(stroke=STROKE, start=0.0, end=TIME), "duration": TIME}


def load(path: Path) -> Any:
    return LoadSolutionFile(str(path), verbose=False)


@pytest.fixture(scope="module")
def run() -> Result:
    return simulate(loose_support(1.5, 0.25, **RISE))


# --- against what the engine writes while it integrates ---


@pytest.mark.parametrize(
    "scenario", [support(**RISE), loose_support(1.5, 0.25, **RISE)], ids=["ideal", "with_clearance"]
)
def test_it_is_what_the_engine_writes_of_its_own_run(
    scenario: Scenario, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    chosen = solver.engine_settings

    def writing(*arguments: Any) -> Any:
        settings = chosen(*arguments)
        settings.solution.precision = 17
        file = settings.solution.file
        file.write, file.name, file.writePeriod = True, str(tmp_path / "engine.txt"), scenario.record_period
        file.export.accelerations = file.export.algebraicCoordinates = file.export.dataCoordinates = False
        return settings

    monkeypatch.setattr(solver, "engine_settings", writing)
    save_solution(simulate(scenario), tmp_path / "ours.txt")
    engine, ours = load(tmp_path / "engine.txt"), load(tmp_path / "ours.txt")
    assert ours["columnsExported"] == engine["columnsExported"]
    size = ours["columnsExported"][0]
    assert np.array_equal(ours["data"][:, 0], engine["data"][:, 0])
    moved = np.s_[:, 1 : 1 + size]
    assert np.abs(engine["data"][moved]).max() > 1e-3  # it moves
    # rounding: displacements are the channels' places, some metres, less those of the start
    assert ours["data"][moved] == pytest.approx(engine["data"][moved], rel=0.0, abs=4e-15)
    # before much shorter steps velocities are aligned with the constraints, after the record and before the
    # engine writes; that moves them by what the steps had left them off
    off = np.abs(ours["data"] - engine["data"])[:, 1 + size :].max(axis=1)
    assert np.median(off) == 0.0
    speed = np.abs(ours["data"][:, 1 + size :]).max()
    assert off.max() < (1e-3 * speed if scenario.pins else 1e-15)


# --- of every formulation ---


def places(scenario: Scenario, solution: Any, body: str, point: tuple[float, ...], row: int) -> np.ndarray:
    """Where the engine has a point of the start posture in a row of a solution file."""
    scene = build(scenario)
    try:
        SetSolutionState(scene.mbs, solution, row)
        item = scene.bodies[body]
        centre = item.body.centre
        arm = np.zeros(3)
        arm[: len(point)] = np.array(point) - centre
        return np.array(scene.mbs.GetObjectOutputBody(item.object, exudyn.OutputVariableType.Position, arm))
    finally:
        scene.release()


OIL = OilColumn(bore_area=bore_area(0.25, number=2), oil_length=0.5, bulk_modulus=1.5e9)
COLUMNS = ("front_column", "rear_column")
RISES = {
    "exudyn": loose_support(1.5, 0.25, **RISE),
    "compiled": loose_support(1.5, 0.25, formulation="compiled", actuators=dict.fromkeys(COLUMNS, OIL), **RISE),
    "crank": loose_slider_crank(2e-3, formulation="compiled"),
    "space": loose_support(1.5, 0.25, dimensions=3, **RISE),
}


@cache
def risen(name: str) -> Result:
    return simulate(RISES[name])


@pytest.mark.parametrize("name", RISES)
def test_the_engines_model_is_where_the_run_was(name: str, tmp_path: Path) -> None:
    result = risen(name)
    save_solution(result, tmp_path / "run.txt")
    solution = load(tmp_path / "run.txt")
    assert np.array_equal(solution["data"][:, 0], result.time)
    scenario = result.scenario
    points = scenario.space.points if scenario.dimensions == 3 else scenario.linkage.points
    assert points
    for row in (1, solution["nRows"] - 1):
        for point, traced in points.items():
            there = places(scenario, solution, traced.body, traced.point, row)
            # rounding of places of some metres; in space also of the rotation found from angles, 1e-14
            assert there[0] == pytest.approx(result[f"{point}.x"][row], rel=0.0, abs=1e-13)
            assert there[1] == pytest.approx(result[f"{point}.y"][row], rel=0.0, abs=1e-13)


# --- the command ---


def run_command(scenario: Scenario, folder: Path, solution: Path) -> int:
    """What `run` ends with for a scenario of which a solution file is to be kept."""
    save_scenario(scenario, folder / "a.toml")
    return main(["run", str(folder / "a.toml"), "--solution", str(solution)])


def test_channels_that_it_needs_are_asked_for_before_the_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scenario = loose_support(1.5, 0.25, duration=1e5, channels=("tip.*", "canopy.*"))
    assert run_command(scenario, tmp_path, tmp_path / "run.txt") == 1  # at once, not after a day
    assert "'rear_link.x'" in capsys.readouterr().err
    assert [one.name for one in tmp_path.iterdir()] == ["a.toml"]


# --- what is drawn is where the run was ---


@pytest.mark.parametrize("name", ["exudyn", "space", "crank"])
def test_surfaces_and_columns_are_where_the_run_was(name: str) -> None:
    result = risen(name)
    shown, poses = ViewerModel.of(result.scenario), Poses(result)
    record = result.time.size - 1
    try:
        SetSolutionState(shown.scene.mbs, rows(result, shown.scene), record, SHOWN)
        for body, item in shown.scene.bodies.items():
            for shape, drawn in zip(shown.look.of(body), shown.fixed(body), strict=True):
                points = np.reshape(drawn["points"], (-1, 3))
                ends = np.array([np.argmin(points, axis=0), np.argmax(points, axis=0)]).ravel()
                there = [
                    shown.scene.mbs.GetObjectOutputBody(item.object, POSITION, points[k], SHOWN) for k in ends
                ]
                where = poses.frame(shape, record).points(np.asarray(shape.mesh.vertices))
                # each is a corner of the shape, where its body was; rounding of places of some metres
                apart = np.linalg.norm(np.array(there)[:, None] - where[None], axis=-1).min(axis=1)
                assert apart.max() < 1e-12, shape.name
        parts = [shape for shape in shown.look.shapes if shape.strut]
        for shape, part in zip(parts, shown.moving(), strict=True):
            points = np.reshape(part()["points"], (-1, 3))
            where = poses.frame(shape, record).points(np.asarray(shape.mesh.vertices))
            for end in (np.min, np.max):
                assert end(points, axis=0) == pytest.approx(end(where, axis=0), abs=1e-12)
    finally:
        shown.scene.release()


small = st.floats(-1.0, 1.0)


# rounding: a few units of the last place of numbers about 1
@given(st.lists(st.tuples(small, small, small), min_size=1, max_size=9))
def test_euler_parameters_are_of_the_rotation_and_do_not_jump(
    vectors: list[tuple[float, float, float]],
) -> None:
    turns = Rotation.from_rotvec(np.cumsum(vectors, axis=0)).as_matrix()  # several turns in all
    found = euler_parameters(turns)
    assert rotation(found) == pytest.approx(turns, abs=1e-14)
    assert found[0, 0] >= 0.0
    assert np.all(np.sum(found[1:] * found[:-1], axis=1) >= -1e-14)
