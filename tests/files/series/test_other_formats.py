"""Files of Exudyn, MATLAB and Parquet, and how a format is told."""

from __future__ import annotations

import io
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


def structure_with_time_of_73() -> bytes:
    """Simulink's structure with two signals, and a timeseries, as version 7.3 keeps them."""
    with h5py.File("made", "w", driver="core", backing_store=False, userblock_size=512) as file:
        file["simout/time"] = TIME.reshape(1, -1)
        for key in ("values", "label"):
            kept = []
            for n in (1, 2):
                data = (
                    n * TIME.reshape(1, -1)
                    if key == "values"
                    else np.array([[ord(c)] for c in f"s{n}_kN"], "u2")
                )
                kept.append(file.create_dataset(f"#refs#/{key}{n}", data=data))
                kept[-1].attrs["MATLAB_class"] = np.bytes_("double" if key == "values" else "char")
            refs = [[one.ref] for one in kept]
            file.create_dataset(f"simout/signals/{key}", data=refs, dtype=h5py.ref_dtype)
        stamped = file.create_dataset("ts", data=np.zeros((1, 6), "u4"))
        stamped.attrs["MATLAB_class"], stamped.attrs["MATLAB_object_decode"] = np.bytes_("timeseries"), 3
        file.flush()
        image = file.id.get_file_image()
    return b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM" + bytes(384) + image


def at_rate(**extra: float) -> bytes:
    """A vector of MATLAB without times."""
    file = io.BytesIO()
    scipy.io.savemat(file, {"x_mm": TIME, **extra})
    return file.getvalue()


def of_arrow(write: Any) -> bytes:
    """A table of Arrow with stamps."""
    sink = pa.BufferOutputStream()
    stamps = np.array(["2023-05-04T06:00:00", "2023-05-04T06:00:00.25"], "M8[ns]")
    write(pa.table({"when": stamps, "x_mm": [1.0, 2.0], "day": ["a", "b"]}), sink)
    return bytes(sink.getvalue())


SHORT = np.array([0.0, 1e-3])
LATER = np.array([0.0, 1e-3, 2.0, 2.001])
LABVIEW = {"Untitled": ("volts", SHORT, [0.5, 0.6]), "Force": ("kN", SHORT, [1.5, 1.6])}
SEGMENTS = {"Untitled": ("volts", LATER, [0.5, 0.6] * 2), "Force": ("kN", LATER, [1.5, 1.6] * 2)}
COMMA = "LabVIEW Measurement\nSeparator,Comma\nX_Columns,One\n***End_of_Header***\n\nX_Value,Untitled,Comment\n"
MODELICA = {
    "m": ("kg", [0, 1], [7, 7]), "J.phi": ("rad", TIME, TIME**2), "back": (None, TIME, -(TIME**2)),
    "J.w": ("rad/s", TIME, 3 * TIME),
}  # fmt: skip
SIMULINK = {
    "yout.1": (None, TIME, TIME), "yout.2": (None, TIME, TIME**2), "scope.Force": ("kN", TIME, TIME),
    "scope.signal2.1": (None, TIME, TIME), "scope.signal2.2": (None, TIME, 2 * TIME),
    "simout.x": ("mm", TIME, 3 * TIME),
}  # fmt: skip
X = {"x": ("mm", [0.0, 1.0], [1.0, np.nan])}
STAMPED = {"x": ("mm", [0.0, 0.25], [1.0, 2.0])}
LEFT = "Columns that are no numbers are left out: 'day'."


@pytest.mark.parametrize(
    ("data", "asked", "expected", "note"),
    [
        (cases.simulink(), {}, SIMULINK, ""),
        (structure_with_time_of_73(), {}, {f"simout.s{n}": ("kN", TIME, n * TIME) for n in (1, 2)},
         "Objects of MATLAB, which only MATLAB reads, are left out: ts (timeseries)."),
        (cases.modelica("binTrans"), {}, MODELICA, ""),
        (cases.modelica("binNormal"), {}, MODELICA, ""),
        (at_rate(Fs=10.0), {}, {"x": ("mm", TIME, TIME)}, ""),
        (at_rate(dt=0.1), {}, {"x": ("mm", TIME, TIME)}, ""),
        (at_rate(), {"rate": 10.0}, {"x": ("mm", TIME, TIME)}, ""),
        (cases.labview(), {}, LABVIEW, ""),
        (cases.labview("No"), {}, LABVIEW, ""),
        (cases.labview("Multi"), {}, LABVIEW | {"Force": ("kN", 2 * SHORT, [1.5, 1.6])}, ""),
        (cases.labview("One", segments=2), {}, SEGMENTS, "The file has 2 segments, which follow each other."),
        (cases.labview("No", segments=2), {}, SEGMENTS, ""),
        (f"{COMMA}0,5,\n0.5,6,\n0,7,\n0.5,8,\n", {}, {"Untitled": (None, [0, 0.5, 1, 1.5], [5, 6, 7, 8])},
         "Times of Untitled begin again 1 times; each time they go on after one interval."),
        ('[{"time_s": 0, "x_mm": 1}, {"time_s": 1, "x_mm": null}]', {}, X, ""),
        ('{"Time": ["2023-05-04T06:00:00Z", "2023-05-04T06:00:01Z"], "x [mm]": [1, null]}', {}, X, ""),
        ('{"data": [{"t": 1683180000, "x_mm": 1.0}, {"t": 1683180001}]}', {}, X, ""),
        (of_arrow(feather.write_feather), {}, STAMPED, LEFT),
        (of_arrow(parquet.write_table), {}, STAMPED, LEFT),
        (cases.parquet_bytes(), {}, {"pin.force": ("kN", TIME, FORCE)},
         "Columns that are no numbers are left out: 'said'."),
    ],
)  # fmt: skip
def test_names_units_times_and_values_are_read(
    tmp_path: Path, data: str | bytes, asked: dict[str, Any], expected: dict[str, Any], note: str
) -> None:
    found = read(tmp_path, data if isinstance(data, bytes) else data.encode(), **asked)
    assert {name: one.unit for name, one in found.series.items()} == {
        name: one[0] for name, one in expected.items()
    }
    for name, (_, time, values) in expected.items():
        np.testing.assert_allclose(found.series[name].time, time, rtol=1e-12, atol=1e-9)
        np.testing.assert_array_equal(found.series[name].values, values)
    assert not note or note in found.notes


# --- workbooks ---


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
