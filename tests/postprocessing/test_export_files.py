"""Which records an export writes, all channels as CSV and HDF5, and files all or none."""

from __future__ import annotations

import csv
import dataclasses
import json
import math
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.__main__ import main
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.export.tables import to_csv, to_hdf5
from support_exudyn.postprocessing.export.whole_set import whole_set
from tests.cases.export_cases import by_vtk, run
from user_forces import InputError, Value

TIME = np.arange(101) * 0.01  # 100 records a second


times = st.lists(st.floats(0.0, 10.0, width=32), min_size=1, max_size=50, unique=True).map(sorted)


@given(times, st.floats(0.01, 100.0))
def test_no_record_lies_nearer_to_a_frame_than_the_one_that_is_written(times: list[float], rate: float) -> None:
    time = np.array(times)
    records = Sampling(frames_per_second=rate).records(time)
    assert records == sorted(set(records))
    for frame in np.arange(time[0], time[-1], 1.0 / rate):
        # the grids of this test and of the program differ by rounding of sums: 1000 steps of 1e-15
        assert np.abs(time[records] - frame).min() <= np.abs(time - frame).min() + 1e-11


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"every": 0}, "every"),
        ({"frames_per_second": math.nan}, "frames_per_second"),
        ({"every": 2, "frames_per_second": 25.0}, "one of them"),
        ({"after": -1.0}, "after"),
        ({"after": 0.5, "until": 0.4}, "until >= after"),
    ],
)
def test_what_cannot_be_is_refused(fields: dict[str, float], words: str) -> None:
    with pytest.raises(InputError, match=words):
        Sampling(**fields)  # type: ignore[arg-type]


KINDS = ("plane", "ideal")


@pytest.mark.parametrize("kind", KINDS)
def test_csv_reads_back_as_the_same_bits(kind: str, tmp_path: Path) -> None:
    result = run(kind)
    (path,) = to_csv(result, tmp_path / "run.csv")
    with path.open(newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    assert names == [f"{name} [{channel.unit}]" for name, channel in result.channels.items()]
    assert names[0] == "time [s]"
    columns = np.array(rows, dtype=float).T
    for column, channel in zip(columns, result.channels.values(), strict=True):
        assert column.tobytes() == channel.values.astype(float).tobytes()


@pytest.mark.parametrize("kind", KINDS)
def test_hdf5_has_all_channels_with_units(kind: str, tmp_path: Path) -> None:
    result = run(kind)
    (path,) = to_hdf5(result, tmp_path / "run.h5")
    with h5py.File(path, "r") as file:
        assert set(file["channels"]) == set(result.channels)
        for name, channel in result.channels.items():
            data = file[f"channels/{name}"]
            assert data.dtype == np.float64
            assert data[:].tobytes() == channel.values.tobytes()
            for attribute in ("unit", "meaning"):
                kind_of = data.attrs.get_id(attribute).get_type()
                assert not kind_of.is_variable_str()  # which MATLAB reads in some versions only
                assert data.attrs[attribute].decode() == getattr(channel, attribute)
        assert set(file.get("onsets", ())) == set(result.onsets)
        for pin, onsets in result.onsets.items():
            group = file[f"onsets/{pin}"]
            columns = [group[name][:] for name in ("time", "speed", "separation_time", "separation_velocity")]
            np.testing.assert_array_equal(np.array(columns).T, np.array(onsets).reshape(-1, 4))
            units = [
                group[name].attrs["unit"]
                for name in ("time", "speed", "separation_time", "separation_velocity")
            ]
            assert units == [b"s", b"m/s", b"s", b"m/s"]
            assert group.attrs["largest_force_N"] == result.largest_force[pin]
        assert Value.from_data(json.loads(file["json/scenario"][()])) == result.scenario
        assert json.loads(file["json/provenance"][()]) == result.provenance
        assert json.loads(file["json/counts"][()]) == dataclasses.asdict(result.counts)
        impulses = [dataclasses.asdict(impulse) for impulse in result.impulses]
        assert json.loads(file["json/impulses"][()]) == impulses


# --- the command ---


@pytest.fixture
def saved(tmp_path: Path) -> Path:
    return run("plane").save(tmp_path / "rise.h5")


def test_the_command_writes_everything_beside_the_run(saved: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(saved), "--after", "0.02", "--until", "0.06"]) == 0
    out = saved.parent / "rise_export"
    assert {path.name for path in out.iterdir()} == {"rise_vtu", "rise.csv", "rise_channels.h5"}
    said = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0] for line in said] == ["vtu", "csv", "hdf5"]
    # meshes 25 a second, tables all records
    times = [step.time for step in by_vtk(out / "rise_vtu" / "machine.pvd")]
    assert times == pytest.approx([0.02, 0.06], abs=1e-12)  # rounding of times of records
    with h5py.File(out / "rise_channels.h5", "r") as file:
        assert file["channels/time"].size == 41


def test_files_that_belong_together_are_written_all_or_none(tmp_path: Path) -> None:
    def write(text: str, folder: Path, error: type[BaseException] | None = None) -> None:
        with whole_set(folder, ["a.bin", "all.index"]) as temporary:
            (temporary / "a.bin").write_text(text, encoding="utf-8")
            if error:
                raise error
            (temporary / "all.index").write_text(text, encoding="utf-8")

    there, missing = tmp_path / "deep" / "there", tmp_path / "missing"
    write("old", there)
    for folder in (there, missing):
        with pytest.raises(KeyboardInterrupt):
            write("new", folder, KeyboardInterrupt)
    assert {path.name: path.read_text(encoding="utf-8") for path in there.iterdir()} == {
        "a.bin": "old", "all.index": "old",
    }  # fmt: skip
    assert not missing.exists()
