"""The hypercube: killed and started again it gives the same bytes, and nothing is run twice or lost."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from studies.claims import hypercube
from studies.claims.plausible import FACTORS, REFERENCE, Choice
from studies.claims.plausible_runs import CASES, measures
from support_exudyn import Failure, SimulationError
from support_exudyn.sweeps.workers import Workers
from tests.at_once import at_once
from tests.cases.evidence_cases import data, right
from user_forces import InputError


def contents(folder: Path) -> dict[str, bytes]:
    """Of everything in a folder."""
    return {path.name: path.read_bytes() for path in folder.iterdir()}


# --- in this process ---


@pytest.fixture
def ran(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Scales of the machines that are run, here and cheaply; those below 0.65 cannot be."""
    done: list[float] = []

    def cheap(sample: Mapping[str, Choice]) -> hypercube.Data:
        scale = float(sample["scale"])
        done.append(scale)
        if scale < 0.65:
            raise SimulationError(Failure("the linkage is at a dead centre", "Look there.", 1.5, {}))
        return data(right()) | {"scale": {"scale": [scale, 0.0]}}

    @contextmanager
    def here(workers: int) -> Iterator[Workers]:
        assert workers >= 1
        yield at_once()

    monkeypatch.setattr(hypercube, "measures", cheap)
    monkeypatch.setattr(hypercube, "worker_pool", here)
    monkeypatch.setattr(hypercube, "warm_up", lambda: None)
    return done


GOOD = [REFERENCE | {"scale": scale} for scale in (0.7, 0.8, 0.9)]
BAD = REFERENCE | {"scale": 0.6}


def run(machines: list[dict[str, Choice]], out: Path) -> list[hypercube.Row]:
    return hypercube.run(machines, out, 2, lambda done, of: None)


def scales(rows: list[hypercube.Row]) -> list[float]:
    return [row.measures["scale"]["scale"][0] for row in rows if row.measures is not None]


def place(out: Path, sample: Mapping[str, Choice]) -> Path:
    return out / hypercube.FOLDER / f"{hypercube.key(sample)}.json"


def test_rows_are_in_the_order_of_the_samples(tmp_path: Path, ran: list[float]) -> None:
    assert scales(run(GOOD, tmp_path)) == [0.7, 0.8, 0.9]
    assert ran == [0.7, 0.8, 0.9]
    assert scales(run(GOOD[::-1], tmp_path)) == [0.9, 0.8, 0.7]
    assert len(ran) == 3


def test_only_what_is_missing_is_run(tmp_path: Path, ran: list[float]) -> None:
    run(GOOD[1:2], tmp_path)
    assert scales(run(GOOD, tmp_path)) == [0.7, 0.8, 0.9]
    assert ran == [0.8, 0.7, 0.9]


TORN: dict[str, Callable[[bytes], bytes]] = {
    "truncated": lambda whole: whole[: len(whole) // 2],
    "empty": lambda whole: b"",
    "zeros": lambda whole: bytes(len(whole)),
    "no text": lambda whole: b"\xff\xfe" + whole,
    "a list": lambda whole: b"[]",
    "a word": lambda whole: b'"sample"',
    "a part missing": lambda whole: json.dumps({"sample": {}, "failure": None}).encode(),
}


@pytest.mark.parametrize("way", TORN)
def test_a_spoilt_file_is_run_again(tmp_path: Path, ran: list[float], way: str) -> None:
    run(GOOD, tmp_path)
    whole = contents(tmp_path / hypercube.FOLDER)
    path = place(tmp_path, GOOD[1])
    path.write_bytes(TORN[way](path.read_bytes()))
    assert scales(run(GOOD, tmp_path)) == [0.7, 0.8, 0.9]
    assert ran == [0.7, 0.8, 0.9, 0.8]
    assert contents(tmp_path / hypercube.FOLDER) == whole


def test_a_bug_is_not_taken_for_a_machine_that_fails(
    tmp_path: Path, ran: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    def wrong(sample: Mapping[str, Choice]) -> hypercube.Data:
        raise LookupError(f"a bug at {sample['scale']}")

    run(GOOD[:1], tmp_path)
    monkeypatch.setattr(hypercube, "measures", wrong)
    with pytest.raises(LookupError, match=r"a bug at 0\.[89]"):
        run(GOOD, tmp_path)
    assert len(contents(tmp_path / hypercube.FOLDER)) == 1


# --- machines that fail ---


def test_a_machine_that_fails_is_a_row_with_its_reason(tmp_path: Path, ran: list[float]) -> None:
    rows = run([GOOD[0], BAD, GOOD[1]], tmp_path)
    assert [row.failure is None for row in rows] == [True, False, True]
    assert rows[1].measures is None
    assert "the linkage is at a dead centre" in (rows[1].failure or "")
    assert run([BAD], tmp_path) == [rows[1]]
    assert ran == [0.7, 0.6, 0.8]  # it is not tried again


def test_a_real_machine_that_cannot_be_closed_fails_with_the_reason(tmp_path: Path) -> None:
    sample = REFERENCE | {"start_height": 5.0}
    path = tmp_path / "machine.json"
    hypercube._run_one(0, path, sample)
    kept = json.loads(path.read_bytes())
    assert kept["sample"] == sample
    assert kept["measures"] is None
    assert "start_hinge_height = 9.0 m: the four-bar cannot bring the hinge there" in kept["failure"]
    with pytest.raises(InputError, match="start_hinge_height"):
        measures(sample)


def test_a_real_machine_is_measured_in_all_cases(tmp_path: Path) -> None:
    path = tmp_path / "machine.json"
    hypercube._run_one(0, path, REFERENCE)
    kept = json.loads(path.read_bytes())
    assert kept["failure"] is None
    assert set(kept["measures"]) == set(CASES)
    # the tolerances of the two runs differ by a hundred: the mean force by far less than by a thousandth
    value, error = kept["measures"]["1.5 mm"]["mean_force"]
    assert 0.0 < error < 1e-3 * value


# --- keys ---


@pytest.mark.parametrize("factor", FACTORS, ids=lambda f: f.name)
def test_the_key_changes_with_every_datum(factor: Any) -> None:
    other = factor.choices[-1] if factor.choices else float(REFERENCE[factor.name]) * (1 + 1e-15) + 1e-300
    assert other != REFERENCE[factor.name]
    assert hypercube.key(REFERENCE | {factor.name: other}) != hypercube.key(REFERENCE)


def test_the_key_changes_with_the_program(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source, numbers = tmp_path / "law.py", tmp_path / "data" / "support.toml"
    numbers.parent.mkdir()
    for name in ("user_forces", "support_exudyn", "studies"):
        monkeypatch.setattr(hypercube, name, SimpleNamespace(__path__=[str(tmp_path)]))

    def digest() -> str:
        return hypercube._program.__wrapped__()

    source.write_text("x = 1\n", encoding="utf-8")
    numbers.write_text("x = 1\n", encoding="utf-8")
    context = [digest()]
    os.utime(source, (0, 0))
    assert digest() == context[0]  # what is in it counts, not when it was written
    (tmp_path / "notes.txt").write_text("x", encoding="utf-8")
    assert digest() == context[0]
    source.write_text("x = 2\n", encoding="utf-8")
    context.append(digest())
    numbers.write_text("x = 2\n", encoding="utf-8")
    context.append(digest())
    source.rename(tmp_path / "other.py")
    context.append(digest())
    monkeypatch.setattr(hypercube, "installed", lambda name: "0.0")
    context.append(digest())
    assert len(set(context)) == len(context)


def test_a_changed_program_runs_all_anew(
    tmp_path: Path, ran: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    run(GOOD, tmp_path)
    monkeypatch.setattr(hypercube, "_program", lambda: "another program")
    run(GOOD, tmp_path)
    assert ran == [0.7, 0.8, 0.9] * 2
