"""Files of Exudyn, MATLAB and Parquet, and how a format is told."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import exudyn
import h5py
import numpy as np
import pyarrow as pa
import pytest
import scipy.io
from exudyn.itemInterface import Force, MarkerNodePosition, MassPoint, NodePoint, SensorNode
from pyarrow import feather, parquet

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


# --- MATLAB ---


@pytest.mark.parametrize("name", list(cases.matlab_files()))
def test_every_version_of_matlab_is_read(tmp_path: Path, name: str) -> None:
    found = read(tmp_path, cases.matlab_files()[name], name, units=UNITS)
    force = found.series["pin_force"]
    assert (force.unit, force.time.tolist(), force.values.tolist()) == ("kN", TIME.tolist(), FORCE.tolist())
    if name == "v73.mat":
        assert found.series["both.2"].values.tolist() == (2.0 * TIME).tolist()
    if name != "v4.mat":  # its structure has times of its own, in milliseconds where it says so
        assert found.series["run.x"].time == pytest.approx(TIME)


def test_what_simulink_saves_is_read(tmp_path: Path) -> None:
    found = read(tmp_path, cases.simulink(), "a.mat")
    expected = {
        "yout.1": TIME, "yout.2": TIME**2, "scope.Force": TIME, "scope.signal2.1": TIME,
        "scope.signal2.2": 2 * TIME, "simout.x": 3 * TIME,
    }  # fmt: skip
    assert {name: one.values.tolist() for name, one in found.series.items()} == {
        name: one.tolist() for name, one in expected.items()
    }
    assert (found.series["scope.Force"].unit, found.series["simout.x"].unit) == ("kN", "mm")
    assert all(one.time.tolist() == TIME.tolist() for one in found.series.values())


def test_a_structure_with_time_of_version_73_is_read(tmp_path: Path) -> None:
    with h5py.File("made", "w", driver="core", backing_store=False, userblock_size=512) as file:
        file["simout/time"] = TIME.reshape(1, -1)
        kept = [file.create_dataset(f"#refs#/{n}", data=n * TIME.reshape(1, -1)) for n in (1, 2)]
        texts = [
            file.create_dataset(f"#refs#/t{n}", data=np.array([[ord(c)] for c in f"s{n}_kN"], "u2"))
            for n in (1, 2)
        ]
        for one in texts:
            one.attrs["MATLAB_class"] = np.bytes_("char")
        for key, items in (("values", kept), ("label", texts)):
            refs = [[one.ref] for one in items]
            file.create_dataset(f"simout/signals/{key}", data=refs, dtype=h5py.ref_dtype)
        stamped = file.create_dataset("ts", data=np.zeros((1, 6), "u4"))
        stamped.attrs["MATLAB_class"], stamped.attrs["MATLAB_object_decode"] = np.bytes_("timeseries"), 3
        file.flush()
        image = file.id.get_file_image()
    whole = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM" + bytes(384) + image
    found = read(tmp_path, whole, "a.mat")
    assert {name: (one.unit, one.values[-1]) for name, one in found.series.items()} == {
        "simout.s1": ("kN", 1.0), "simout.s2": ("kN", 2.0),
    }  # fmt: skip
    assert found.notes == ("Objects of MATLAB, which only MATLAB reads, are left out: ts (timeseries).",)


@pytest.mark.parametrize("form", ["binTrans", "binNormal"])
def test_what_dymola_and_openmodelica_write_is_read(tmp_path: Path, form: str) -> None:
    found = read(tmp_path, cases.modelica(form), "a.mat").series
    assert {name: (one.unit, one.time.size) for name, one in found.items()} == {
        "m": ("kg", 2), "J.phi": ("rad", 11), "back": (None, 11), "J.w": ("rad/s", 11),
    }  # fmt: skip
    assert found["m"].values.tolist() == [7.0, 7.0]
    assert found["back"].values.tolist() == (-(TIME**2)).tolist()
    assert found["J.w"].time.tolist() == TIME.tolist()


def test_vectors_of_matlab_at_a_rate_are_read(tmp_path: Path) -> None:
    for extra, asked in (({"Fs": 100.0}, {}), ({"dt": 0.01}, {}), ({}, {"rate": 100.0})):
        scipy.io.savemat(tmp_path / "a.mat", {"x_mm": FORCE, **extra})
        found = read_series(tmp_path / "a.mat", **asked)
        assert found.series["x"].time == pytest.approx(0.01 * np.arange(11), abs=1e-15)


# --- LabVIEW ---


def test_every_kind_of_labviews_files_is_read(tmp_path: Path) -> None:
    expected = {"Untitled": ("volts", [0.0, 1e-3], [0.5, 0.6]), "Force": ("kN", [0.0, 1e-3], [1.5, 1.6])}
    later = {name: (unit, [*t, 2.0, 2.001], 2 * v) for name, (unit, t, v) in expected.items()}
    multi = expected | {"Force": ("kN", [0.0, 2e-3], [1.5, 1.6])}
    comma = (
        "LabVIEW Measurement\nSeparator,Comma\nX_Columns,One\n***End_of_Header***\n\nX_Value,Untitled,Comment\n"
    )
    for text, wanted in (
        (cases.labview(), expected),
        (cases.labview("No"), expected),
        (cases.labview("Multi"), multi),
        (cases.labview("One", segments=2), later),
        (cases.labview("No", segments=2), later),
        (f"{comma}0,5,\n0.5,6,\n0,7,\n0.5,8,\n", {"Untitled": (None, [0, 0.5, 1.0, 1.5], [5, 6, 7, 8])}),
    ):
        found = read(tmp_path, text.encode(), "a.lvm")
        assert {name: one.unit for name, one in found.series.items()} == {
            name: one[0] for name, one in wanted.items()
        }
        for name, (_, time, values) in wanted.items():
            assert found.series[name].time == pytest.approx(time, abs=1e-9)
            assert found.series[name].values.tolist() == values
    assert found.notes == ("Times of Untitled begin again 1 times; each time they go on after one interval.",)


# --- workbooks, Feather, JSON ---


def test_a_sheet_of_a_workbook_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = read(tmp_path, cases.workbook(), "named.csv")
    assert found.series["Force"].unit == "kN"
    assert found.series["x"].time.tolist() == [0.0, 0.5]
    np.testing.assert_array_equal(found.series["Force"].values, [1.5, np.nan])
    assert found.notes[0] == "Of 3 sheets 'Data' is read; others are 'Sheet', 'More'."
    assert read_series(tmp_path / "named.csv", sheet="More").series["F"].values.tolist() == [1.0, 2.0]
    with pytest.raises(InputError, match="has no sheet 'Mor'; allowed: 'Sheet', 'Data', 'More'"):
        read_series(tmp_path / "named.csv", sheet="Mor")
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    with pytest.raises(
        InputError, match=r"which openpyxl reads, .*allowed: pip install 'support-exudyn\[files\]'"
    ):
        read_series(tmp_path / "named.csv")


@pytest.mark.parametrize(
    "data",
    [
        b'[{"time_s": 0, "x_mm": 1}, {"time_s": 1, "x_mm": null}]',
        b'{"Time": ["2023-05-04T06:00:00Z", "2023-05-04T06:00:01Z"], "x [mm]": [1, null]}',
        b'{"data": [{"t": 1683180000, "x_mm": 1.0}, {"t": 1683180001}]}',
    ],
)
def test_rows_and_columns_of_json_are_read(tmp_path: Path, data: bytes) -> None:
    found = read(tmp_path, data).series["x"]
    assert (found.unit, found.time.tolist()) == ("mm", [0.0, 1.0])
    np.testing.assert_array_equal(found.values, [1.0, np.nan])


def test_feather_and_parquet_have_times_as_stamps(tmp_path: Path) -> None:
    stamps = np.array(["2023-05-04T06:00:00", "2023-05-04T06:00:00.25"], "M8[ns]")
    table = pa.table({"when": stamps, "x_mm": [1.0, 2.0], "day": ["a", "b"]})
    for write, name in ((feather.write_feather, "a.feather"), (parquet.write_table, "a.parquet")):
        write(table, tmp_path / name)
        found = read_series(tmp_path / name)
        assert found.series["x"].time.tolist() == [0.0, 0.25]
        assert found.notes[-1] == "Columns that are no numbers are left out: 'day'."


# --- Parquet ---


def test_parquet_has_units_in_titles_and_in_metadata(tmp_path: Path) -> None:
    found = read(tmp_path, cases.parquet_bytes())
    force = found.series["pin.force"]
    assert (force.unit, force.values.tolist()) == ("kN", FORCE.tolist())
    assert found.notes == ("Columns that are no numbers are left out: 'said'.",)


# --- all formats ---


@pytest.mark.parametrize("name", [*cases.files(), *cases.matlab_files()])
def test_a_format_is_determined_by_content_and_damage_is_refused(tmp_path: Path, name: str) -> None:
    whole = (cases.files() | cases.matlab_files())[name]
    assert read(tmp_path, whole, "nothing.dat", units=UNITS).series
    if not name.endswith(("csv", "txt", "lvm")):  # part of a text is a text
        with pytest.raises(InputError, match=r"nothing.dat: .*; allowed: "):
            read(tmp_path, whole[: int(0.6 * len(whole))], "nothing.dat", units=UNITS)


NO_TIMES = pa.BufferOutputStream()
parquet.write_table(pa.table({"x": pa.array(FORCE)}), NO_TIMES)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (cases.SENSOR.replace("values = 3", "values = 4"), "line 9: has 4 items; allowed: 5"),
        (cases.SENSOR.partition("\n0,0")[0], "has no rows"),
        (cases.SOLUTION.replace("[1,1,0,0", "[1,1,1,0"), "line 9: has 3 items; allowed: 4"),
        (cases.exudyn_binary()[:-9], "row 11 is not of 3 numbers; allowed: rows that are"),
        (cases.exudyn_binary()[:60], "the file ends; allowed: the whole of a binary solution"),
        (
            cases.labview().replace("0,6", "O,6"),
            "line 22, column 'Untitled': 'O,6'; allowed: a number such as 12,5",
        ),
        (cases.labview().replace("Separator\t,", "Separator\tx"), "Decimal_Separator 'x'; allowed: a point or"),
        (cases.labview().replace("X\t0,001", "X\tx"), "X0 or Delta_X of 'Untitled' above it is no number"),
        (cases.labview().replace("***End_of_Header***", ""), r"has no line \*\*\*End_of_Header"),
        (bytes(NO_TIMES.getvalue()), r"has no times; allowed: a column time_s, .*; its numbers are 'x'"),
        (cases.matlab("5").replace(b"t", b"u"), "is no MATLAB file|has no vector of times"),
    ],
)
def test_what_is_damaged_is_refused_with_its_place(tmp_path: Path, data: str | bytes, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(tmp_path, data if isinstance(data, bytes) else data.encode(), units=UNITS)
