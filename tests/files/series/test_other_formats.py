"""Files of Exudyn, MATLAB and Parquet, and how a format is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import exudyn
import numpy as np
import pyarrow as pa
import pytest
from exudyn.itemInterface import Force, MarkerNodePosition, MassPoint, NodePoint, SensorNode
from pyarrow import parquet

from support_exudyn.files.series import parquet as parquet_module
from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.read import read_series
from tests.cases import series_cases as cases
from tests.cases.series_cases import FORCE, TIME, UNITS
from user_forces import InputError


def read(folder: Path, data: bytes, name: str = "a.bin", **asked: Any) -> SeriesFile:
    path = folder / name
    path.write_bytes(data)
    return read_series(path, **asked)


# --- Exudyn ---


@pytest.fixture(scope="module")
def engine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the engine writes of a mass in free fall."""
    folder = tmp_path_factory.mktemp("engine")
    container = exudyn.SystemContainer()
    mbs = container.AddSystem()
    node = mbs.AddNode(NodePoint(referenceCoordinates=[0, 0, 0]))
    mbs.AddObject(MassPoint(mass=1.0, nodeNumber=node))
    marker = mbs.AddMarker(MarkerNodePosition(nodeNumber=node))
    mbs.AddLoad(Force(markerNumber=marker, loadVector=[0, -9.81, 0]))
    for kind in ("Position", "Velocity"):
        variable = getattr(exudyn.OutputVariableType, kind)
        mbs.AddSensor(
            SensorNode(nodeNumber=node, fileName=str(folder / f"{kind}.txt"), outputVariableType=variable)
        )
    mbs.Assemble()
    for name, binary in (("text.txt", False), ("binary.sol", True)):
        settings = exudyn.SimulationSettings()
        settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = 0.1, 10
        settings.timeIntegration.verboseMode = 0
        settings.solution.file.write, settings.solution.file.binary = True, binary
        settings.solution.file.name, settings.solution.file.writePeriod = str(folder / name), 0.01
        settings.solution.precision = 17
        mbs.SolveDynamic(settings)
    return folder


def test_sensors_of_the_engine_are_read(engine: Path) -> None:
    found = read_series(engine / "Position.txt", units={"time": "s", "Position.*": "m"})
    y = found.series["Position.y"]
    assert found.kind == "sensor of Exudyn"
    assert y.unit == "m"
    assert y.values == pytest.approx(-0.5 * 9.81 * y.time**2, abs=1e-9)
    assert "Velocity.z" in read_series(engine / "Velocity.txt", units={"time": "s"}).series


def test_its_solutions_are_read_as_text_and_binary(engine: Path) -> None:
    text, binary = (read_series(engine / name, units={"time": "s"}) for name in ("text.txt", "binary.sol"))
    assert list(text.series) == list(binary.series)
    assert text.series["ODE2.1"].values == pytest.approx(
        -0.5 * 9.81 * text.series["ODE2.1"].time ** 2, abs=1e-12
    )
    for name, one in text.series.items():
        assert np.array_equal(one.values, binary.series[name].values)
    assert text.notes == binary.notes == ()


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (cases.SENSOR.replace("values = 3", "values = 4").encode(), "line 9: has 4 items; allowed: 5"),
        (cases.SENSOR.partition("\n0,0")[0].encode(), "has no rows"),
        (cases.SOLUTION.replace("[1,1,0,0", "[1,1,1,0").encode(), "line 9: has 3 items; allowed: 4"),
        (cases.exudyn_binary()[:-9], "row 11 is not of 3 numbers; allowed: rows that are"),
        (cases.exudyn_binary()[:60], "the file ends; allowed: the whole of a binary solution"),
    ],
)
def test_damaged_files_of_exudyn_end_in_a_sentence(tmp_path: Path, data: bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(tmp_path, data, units=UNITS)


# --- MATLAB ---


@pytest.mark.parametrize("name", list(cases.matlab_files()))
def test_every_version_of_matlab_is_read(tmp_path: Path, name: str) -> None:
    found = read(tmp_path, cases.matlab_files()[name], name, units=UNITS)
    force = found.series["pin_force"]
    assert (force.unit, force.time.tolist(), force.values.tolist()) == ("kN", TIME.tolist(), FORCE.tolist())
    if name == "v73.mat":
        assert found.series["both.2"].values.tolist() == (2.0 * TIME).tolist()
    if name != "v4.mat":
        assert found.series["run.x"].values.tolist() == (TIME**2).tolist()
        assert found.series["run.x"].time == pytest.approx(
            TIME
        )  # of its own times, in milliseconds where it says so


@pytest.mark.parametrize("name", list(cases.matlab_files()))
def test_files_of_matlab_that_are_cut_are_refused(tmp_path: Path, name: str) -> None:
    whole = cases.matlab_files()[name]
    for part in (0.3, 0.6, 0.9):
        with pytest.raises(InputError, match="allowed: "):
            read(tmp_path, whole[: int(part * len(whole))], name, units=UNITS)


# --- Parquet ---


def test_parquet_has_units_in_titles_and_in_metadata(tmp_path: Path) -> None:
    found = read(tmp_path, cases.parquet_bytes())
    force = found.series["pin.force"]
    assert (force.unit, force.values.tolist()) == ("kN", FORCE.tolist())
    assert found.notes == ("Columns that are no numbers are left out: 'said'.",)


def test_parquet_without_times_or_too_large_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sink = pa.BufferOutputStream()
    parquet.write_table(pa.table({"x": pa.array(FORCE)}), sink)
    with pytest.raises(InputError, match=r"has 0 columns of times; allowed: one, time_s .* it has 'x'"):
        read(tmp_path, bytes(sink.getvalue()))
    monkeypatch.setattr(parquet_module, "available", lambda: 1_000_000)

    zeros = pa.table({"time_s": pa.array(np.arange(1e6) * 0.0)})
    sink = pa.BufferOutputStream()
    parquet.write_table(zeros, sink, compression="zstd")
    with pytest.raises(InputError, match="has 1000000 rows of 1 columns; allowed: as many as fit into memory"):
        read(tmp_path, bytes(sink.getvalue()))


# --- formats ---


@pytest.mark.parametrize("name", [*cases.files()])
def test_a_format_is_found_by_content_whatever_the_ending(tmp_path: Path, name: str) -> None:
    found = read(tmp_path, cases.files()[name], "nothing.dat", units=UNITS)
    assert found.series
    assert found.path.name == "nothing.dat"
