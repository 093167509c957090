"""All channels as CSV and HDF5, and the command that exports."""

from __future__ import annotations

import csv
import dataclasses
import json
from pathlib import Path

import h5py
import numpy as np
import pytest

from support_exudyn import simulate
from support_exudyn.__main__ import main
from support_exudyn.postprocessing.export.sampling import Sampling
from support_exudyn.postprocessing.export.tables import to_csv, to_hdf5
from tests.cases.export_cases import by_vtk, run
from user_forces import Value

KINDS = ("plane", "space", "slider-crank", "ideal")


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


def test_hdf5_can_hold_some_of_the_records(tmp_path: Path) -> None:
    (path,) = to_hdf5(run("plane"), tmp_path / "run.h5", Sampling(every=7, after=0.05))
    with h5py.File(path, "r") as file:
        np.testing.assert_array_equal(file["channels/time"][:], run("plane").time[50::7])


# --- the command ---


@pytest.fixture
def saved(tmp_path: Path) -> Path:
    return run("plane").save(tmp_path / "rise.h5")


def test_the_command_writes_everything_beside_the_run(saved: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(saved), "--from", "0.02", "--until", "0.06"]) == 0
    out = saved.parent / "rise_export"
    names = {"rise.xdmf", "rise_pins.xdmf", "rise_mesh.h5", "rise_names.csv", "rise_vtu", "rise.csv"}
    assert {path.name for path in out.iterdir()} == names | {"rise_channels.h5"}
    said = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0] for line in said] == ["xdmf", "vtu", "csv", "hdf5"]
    assert str(out / "rise.xdmf") in said[0]
    # meshes 25 a second, tables all records
    times = [step.time for step in by_vtk(out / "rise.xdmf")]
    assert times == pytest.approx([0.02, 0.06], abs=1e-12)  # rounding of times of records
    with h5py.File(out / "rise_channels.h5", "r") as file:
        assert file["channels/time"].size == 41


def test_what_a_run_has_not_recorded_enough_for_is_left_out_in_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    few = dataclasses.replace(run("ideal").scenario, channels=("tip.*",), duration=0.01)
    path = simulate(few).save(tmp_path / "few.h5")
    assert main(["export", str(path)]) == 0
    assert {item.name for item in (tmp_path / "few_export").iterdir()} == {"few.csv", "few_channels.h5"}
    said = capsys.readouterr()
    assert [line.split(":")[0] for line in said.out.splitlines()] == ["csv", "hdf5"]
    assert "xdmf: left out: channel" in said.err
    assert main(["export", str(path), "--to", "csv,vtu"]) == 1  # asked for, it is not left out


def test_the_command_takes_a_rate_or_a_count_for_all_it_writes(saved: Path, tmp_path: Path) -> None:
    for words, count in ((["--every", "25"], 5), (["--frames-per-second", "50"], 6)):
        out = tmp_path / words[0]
        assert main(["export", str(saved), "--to", "hdf5,vtu", "--out", str(out), *words]) == 0
        assert {path.name for path in out.iterdir()} == {"rise_vtu", "rise_channels.h5"}
        assert len(by_vtk(out / "rise_vtu" / "pins.pvd")) == count
        with h5py.File(out / "rise_channels.h5", "r") as file:
            assert file["channels/time"].size == count


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--to", "xls"], "'xls': no such format; "),
        (["--every", "0"], "allowed: from 1 on"),
        (["--frames-per-second", "0"], "'0': allowed: a number from 1e-09"),
        (["--from", "-1"], "'-1': allowed: a number from 0"),
        (["--every", "2", "--frames-per-second", "25"], "not allowed with argument"),
    ],
)
def test_a_wrong_word_is_refused(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["export", "run.h5", *words])
    assert caught.value.code == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--from", "0.2", "--until", "0.1"], "--after 0.2 --until 0.1: allowed: --until not before --after"),
        (["--from", "7"], "no record lies there"),
    ],
)
def test_a_wrong_time_is_refused(
    saved: Path, words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", str(saved), *words]) == 1
    assert said in capsys.readouterr().err
    assert list(saved.parent.iterdir()) == [saved]
