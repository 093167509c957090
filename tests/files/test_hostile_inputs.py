"""Files of somebody else's: none gives the bytes of another file, is without an end, or steers the terminal."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pyarrow as pa
import pytest

from support_exudyn import Held, Result, simulate
from support_exudyn.__main__ import main
from support_exudyn.files.hdf5 import BLOCK, with_checksum
from support_exudyn.simulation.result import FORMAT
from support_exudyn.sweeps.table import OWN
from tests.cases.run_cases import loose_support
from tests.cases.sweep_cases import speeds, write_sweep
from tests.hostile import posix_only
from user_forces import InputError

SECRET = "root:hunter2:0:0:/root"
NAME = "channels/tip.x"


@pytest.fixture(scope="module")
def result() -> Result:
    return simulate(loose_support(1.5, 0.0, drive=Held(), duration=0.005))


@pytest.fixture
def secret(tmp_path: Path) -> Path:
    path = tmp_path / "secret"
    path.write_bytes(SECRET.encode() * 100)
    return path


# --- results ---


def external(file: h5py.File, secret: Path) -> None:
    shape = file[NAME].shape
    del file[NAME]
    data = file.create_dataset(NAME, shape, "f8", external=[(str(secret), 0, 8 * shape[0])])
    data.attrs.update({"unit": "m", "meaning": ""})


def soft_link(file: h5py.File, secret: Path) -> None:
    file["elsewhere"] = file[NAME]
    del file[NAME]
    file[NAME] = h5py.SoftLink("/elsewhere")


def virtual(file: h5py.File, secret: Path) -> None:
    shape = file[NAME].shape
    del file[NAME]
    layout = h5py.VirtualLayout(shape, "f8")
    layout[:] = h5py.VirtualSource(str(secret), "x", shape)
    file.create_virtual_dataset(NAME, layout).attrs.update({"unit": "m", "meaning": ""})


def sparse(file: h5py.File, secret: Path) -> None:
    del file[NAME]
    file.create_dataset(NAME, (10**15,), "f8").attrs.update({"unit": "m", "meaning": ""})


def bomb(file: h5py.File, secret: Path) -> None:
    del file[NAME]
    data = file.create_dataset(NAME, data=np.zeros(10**6), compression="gzip")
    data.attrs.update({"unit": "m", "meaning": ""})


def circle(file: h5py.File, secret: Path) -> None:
    file["coarser"] = file["/"]


TRICKS = {
    external: "kept in another file",
    soft_link: "a link that leads elsewhere",
    virtual: "kept in another file",
    sparse: "not all are there",
    bomb: "compressed, in pieces",
    circle: "(more than the file has|recursion)",  # of small files the depth is reached first
}


@pytest.mark.parametrize("trick", TRICKS, ids=lambda trick: trick.__name__)
def test_a_result_gives_nothing_but_what_it_has(
    result: Result, tmp_path: Path, secret: Path, trick: Callable[[h5py.File, Path], None]
) -> None:
    path = result.save(tmp_path / "run.h5")
    with h5py.File(path, "r+") as file:
        trick(file, secret)
    path.write_bytes(with_checksum(path.read_bytes()[BLOCK:], FORMAT))
    with pytest.raises(InputError, match=f"damaged .*{TRICKS[trick]}") as caught:
        Result.load(path)
    assert "hunter2" not in str(caught.value)


# --- what is printed ---


def test_errors_print_no_letters_that_steer(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "run.toml"
    path.write_text('machine = "reference"\nduration_s = 1\n"\\u001b[2J\\u202e" = 1\n', encoding="utf-8")
    for words in (["run", str(path)], ["show", f"{tmp_path}/\x1b[2J.h5"], ["show", str(path), "--\x1b[2J"]):
        try:
            assert main(words) == 1
        except SystemExit as stop:
            assert stop.code == 2  # noqa: PT017
        assert all(one.isprintable() or one == "\n" for one in capsys.readouterr().err)


# --- without an end ---


def scenario(folder: Path, drive: str = "", machine: str = "reference") -> Path:
    path = folder / "run.toml"
    path.write_text(f'machine = "{machine}"\nduration_s = 0.01\n{drive}\n', encoding="utf-8")
    return path


def in_sweep(folder: Path, other: str) -> Path:
    path = folder / "sweep.toml"
    path.write_text(f'scenario = "{other}"\n[vary]\nduration_s = [0.01]\n', encoding="utf-8")
    return path


READERS: dict[str, Callable[[Path], Any]] = {
    "run": lambda path: main(["run", str(path)]),
    "check": lambda path: main(["check", str(path)]),
    "sweep": lambda path: main(["sweep", str(path)]),
    "show": lambda path: main(["show", str(path)]),
    "chart": lambda path: main(["chart", str(path), "a", "b"]),
    "a scenario in a sweep": lambda path: main(["sweep", str(in_sweep(path.parent, str(path)))]),
    "a table": lambda path: main(["run", str(scenario(path.parent, f'[drive]\ntable = "{path}"'))]),
    "a machine": lambda path: main(["run", str(scenario(path.parent, machine=str(path)))]),
}


@posix_only
@pytest.mark.parametrize("kind", READERS)
@pytest.mark.parametrize("what", ["pipe", "device", "sparse"])
def test_what_has_no_end_is_refused_wherever_it_is_read(
    tmp_path: Path, kind: str, what: str, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / ("file.h5" if kind == "show" else "file.toml")  # a text is told by its name, unread
    if what == "pipe":
        os.mkfifo(path)
    elif what == "device":
        path.symlink_to("/dev/zero")
    else:
        with path.open("wb") as file:
            file.truncate(10**12)
    codes: list[int] = []
    reading = threading.Thread(target=lambda: codes.append(READERS[kind](path)), daemon=True)
    reading.start()
    reading.join(60.0)
    assert codes == [1]
    error = capsys.readouterr().err
    assert "no regular file" in error or "has more than" in error


# --- tables of sweeps ---


def damaged(table: pa.Table, how: str) -> pa.Table:
    about = dict(table.schema.metadata)
    names = table.column_names
    match how:
        case "no json":
            return table.replace_schema_metadata(about | {OWN: b"{"})
        case "no text":
            return table.replace_schema_metadata(about | {OWN: b"\xff\xfe"})
        case "no table":
            return table.replace_schema_metadata(about | {OWN: b"[1]"})
        case "deep":
            return table.replace_schema_metadata(about | {OWN: b"[" * 100_000})
        case "no column":
            return table.drop_columns(["wall_time_s"])
        case "twice":
            return table.append_column("status", table.column("status"))
        case "no numbers":
            return table.append_column("x_N", pa.array(["a"] * len(table)))
        case "steering":
            return table.rename_columns([*names[:-1], "a\x1b[2J"])
    field = table.schema.field(0).with_metadata({b"unit": b"\xff", b"meaning": b"varied"})
    return table.set_column(0, field, table.column(0))


@pytest.fixture(scope="module")
def store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("store")
    main(["sweep", str(write_sweep(folder, speeds(2))), "--workers", "1"])
    return folder / "sweep_sweep"
