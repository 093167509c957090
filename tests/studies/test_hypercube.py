"""The hypercube: killed and started again it gives the same bytes, and nothing is run twice or lost."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

import pytest

from studies.claims import plausible_runs as hypercube
from studies.claims.plausible import REFERENCE, Choice
from support_exudyn import Failure, SimulationError
from support_exudyn.sweeps.workers import Workers
from tests.at_once import at_once
from tests.cases.evidence_cases import data, right


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


def run(machines: list[dict[str, Choice]], out: Path) -> list[hypercube.MachineRow]:
    return hypercube.run_machines(machines, out, 2, lambda shares: None)


def scales(rows: list[hypercube.MachineRow]) -> list[float]:
    return [row.measures["scale"]["scale"][0] for row in rows if row.measures is not None]


def place(out: Path, sample: Mapping[str, Choice]) -> Path:
    return out / hypercube.FOLDER / f"{hypercube.key(sample)}.json"


def test_only_what_is_missing_is_run(tmp_path: Path, ran: list[float]) -> None:
    run(GOOD[1:2], tmp_path)
    assert scales(run(GOOD, tmp_path)) == [0.7, 0.8, 0.9]
    assert ran == [0.8, 0.7, 0.9]


TORN: dict[str, Callable[[bytes], bytes]] = {
    "truncated": lambda whole: whole[: len(whole) // 2],
    "empty": lambda whole: b"",
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


# --- machines that fail ---


def test_a_machine_that_fails_is_a_row_with_its_reason(tmp_path: Path, ran: list[float]) -> None:
    rows = run([GOOD[0], BAD, GOOD[1]], tmp_path)
    assert [row.failure is None for row in rows] == [True, False, True]
    assert rows[1].measures is None
    assert "the linkage is at a dead centre" in (rows[1].failure or "")
    assert run([BAD], tmp_path) == [rows[1]]
    assert ran == [0.7, 0.6, 0.8]  # it is not tried again


# --- keys ---
