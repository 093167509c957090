"""The hypercube: killed and started again it gives the same bytes, and nothing is run twice or lost."""

from __future__ import annotations

import csv
import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import pytest

from studies.claims import hypercube
from studies.claims import run as claims
from studies.claims.claim_list import CLAIMS
from studies.claims.plausible import FACTORS, REFERENCE, Choice, samples
from studies.claims.plausible_runs import CASES, measures
from studies.common.words import Words
from support_exudyn import Failure, SimulationError
from support_exudyn.sweeps.workers import Workers
from tests.at_once import at_once
from tests.cases.evidence_cases import data, right
from tests.hostile import left_behind, with_own_files
from tests.processes import ROOT, environment, linux_only, session_of, wait_until
from tests.studies import hypercube_main
from user_forces import InputError

SOON = 10.0  # [s]; what ends at once has ended by then, on a busy machine too
SEED = 2031  # of the moments

Marks = dict[str, tuple[int, int]]  # of files: what changes if one is written again


def marks(folder: Path) -> Marks:
    """Of all finished machines."""
    found = {}
    for path in folder.glob("[!.]*.json"):
        status = path.stat()
        found[path.name] = (status.st_ino, status.st_mtime_ns)
    return found


def contents(folder: Path) -> dict[str, bytes]:
    """Of everything in a folder."""
    return {path.name: path.read_bytes() for path in folder.iterdir()}


# --- killed for real ---


class Starter:
    """The script that starts hypercubes."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        assert process.stdin is not None
        assert process.stdout is not None
        self._say, self._hear = process.stdin, process.stdout

    def start(self, out: Path, machines: int, method: str) -> int:
        """A process that runs into this folder, and starts its workers so."""
        self._say.write(f"{method} {machines} {out}\n")
        self._say.flush()
        return int(self._hear.readline())

    def exit_code(self) -> int:
        """Of that process, when it has ended."""
        return int(self._hear.readline())


@contextmanager
def starter() -> Iterator[Starter]:
    command = [sys.executable, "-m", hypercube_main.__name__]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with subprocess.Popen(command, cwd=ROOT, env=environment(), text=True, **pipes) as process:
        try:
            yield Starter(process)
        finally:
            process.kill()


class Often(NamedTuple):
    """How many machines there are, and how often they are killed.

    spawned: so many runs that are killed have spawned workers, as every run of a user does; later ones forked
    ones, in less time. whole: the workers of the run that is left alone.
    """

    machines: int
    kills: int
    spawned: int
    whole: str


@dataclass(frozen=True)
class Story:
    """What became of a run that was killed again and again, and of one that was left alone."""

    often: Often
    whole: Path
    killed: Path
    exit_codes: list[int]
    left_over: list[set[int]]  # processes, by kill
    finished: list[Marks]  # what was there after each kill


@pytest.fixture(scope="module", params=[Often(6, 2, 0, "fork"), Often(12, 10, 4, "spawn")])
def story(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Story:
    often: Often = request.param
    whole, killed = tmp_path_factory.mktemp("whole"), tmp_path_factory.mktemp("killed")
    machines = killed / hypercube.FOLDER
    chance = random.Random(SEED)
    found = Story(often, whole, killed, [], [], [])
    processes: list[int] = []
    with starter() as script:
        try:
            began = time.monotonic()
            processes.append(script.start(whole, often.machines, often.whole))
            assert wait_until(lambda: bool(marks(whole / hypercube.FOLDER)), 60.0)
            work_began = time.monotonic()
            assert script.exit_code() == 0
            few = 4.0 * (time.monotonic() - work_began) / often.machines  # time for so many machines
            latest = {"spawn": work_began - began + few, "fork": few}
            for n in range(often.kills):
                method = "spawn" if n < often.spawned else "fork"
                processes.append(script.start(killed, often.machines, method))
                # at a moment that is drawn, or as soon as so many are finished that the last might be too; the
                # last time then in any case: some are to be finished before the last start
                enough, last = n + 1, n + 1 == often.kills
                moment = 60.0 if last else chance.uniform(0.0, latest[method])
                wait_until(lambda: len(marks(machines)) >= enough, moment)  # noqa: B023
                os.kill(processes[-1], signal.SIGKILL)
                found.exit_codes.append(script.exit_code())
                wait_until(lambda: not session_of(processes[-1]), SOON)
                found.left_over.append(session_of(processes[-1]))
                found.finished.append(marks(machines))
            processes.append(script.start(killed, often.machines, "fork"))
            found.exit_codes.append(script.exit_code())
        finally:
            for process in processes:
                for one in session_of(process):
                    os.kill(one, signal.SIGKILL)
    return found


@linux_only
@pytest.mark.slow
class TestKilled:
    """Several times, at moments that are drawn."""

    def test_it_gives_the_same_bytes_as_if_left_alone(self, story: Story) -> None:
        assert story.exit_codes == [-signal.SIGKILL] * story.often.kills + [0]
        whole, killed = contents(story.whole / hypercube.FOLDER), contents(story.killed / hypercube.FOLDER)
        assert len(whole) == story.often.machines
        assert killed == whole

    def test_no_process_survives_its_parent(self, story: Story) -> None:
        assert story.left_over == [set()] * story.often.kills

    def test_finished_machines_are_not_run_again(self, story: Story) -> None:
        finished = [*story.finished, marks(story.killed / hypercube.FOLDER)]
        counts = [len(found) for found in finished]
        assert counts == sorted(counts)
        assert 0 < counts[-2] < counts[-1] == story.often.machines  # some before the last start, some after
        for earlier, later in pairwise(finished):
            assert earlier.items() <= later.items()

    def test_rows_and_table_are_the_same(
        self, story: Story, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setattr(hypercube, "_program", lambda: hypercube_main.PROGRAM)
        monkeypatch.setattr(hypercube, "worker_pool", lambda *_: pytest.fail("all is there"))
        machines = samples(story.often.machines, hypercube_main.SEED)
        told: list[tuple[int, int]] = []
        tables = []
        for out in (story.whole, story.killed):
            rows = hypercube.run(machines, out, 2, lambda done, of: told.append((done, of)))
            assert [row.sample for row in rows] == machines
            claims.write_machines(tmp_path / "machines.csv", rows)
            tables.append((tmp_path / "machines.csv").read_bytes())
        assert tables[0] == tables[1]
        assert set(told) == {(story.often.machines, story.often.machines)}

    def test_a_machine_is_the_same_in_any_process(self, story: Story, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setattr(hypercube, "_program", lambda: hypercube_main.PROGRAM)
        for sample in samples(story.often.machines, hypercube_main.SEED)[: story.often.machines // 3]:
            kept = json.loads((story.whole / hypercube.FOLDER / f"{hypercube.key(sample)}.json").read_bytes())
            assert kept["sample"] == sample
            assert kept["measures"] == measures(sample)  # to the last bit


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


def test_progress_counts_what_was_there_before(tmp_path: Path, ran: list[float]) -> None:
    run(GOOD[1:2], tmp_path)
    told: list[tuple[int, int]] = []
    hypercube.run(GOOD, tmp_path, 2, lambda done, of: told.append((done, of)))
    assert told[0] == (1, 3)
    assert told[-1] == (3, 3)
    assert told == sorted(told)
    assert len(ran) == 3


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


def test_leftovers_of_half_written_files_are_removed(tmp_path: Path, ran: list[float]) -> None:
    run(GOOD[:1], tmp_path)
    folder = tmp_path / hypercube.FOLDER
    left, own = left_behind(folder), with_own_files(folder)
    assert scales(run(GOOD, tmp_path)) == [0.7, 0.8, 0.9]
    assert os.name == "nt" or not left.exists()
    assert all(path.exists() for path in own)


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


def test_failures_are_seen_in_sheet_table_and_chapter(tmp_path: Path, ran: list[float]) -> None:
    rows = run([GOOD[0], BAD, GOOD[1]], tmp_path)
    ((number, scale, height, reason),) = claims.failure_table(rows).rows
    assert (number, scale, height) == ("1", "0.6", "1")
    assert "dead centre" in reason
    claims.write_machines(tmp_path / "machines.csv", rows)
    with (tmp_path / "machines.csv").open(encoding="utf-8", newline="") as file:
        table = list(csv.DictReader(file))
    assert [line["machine"] for line in table] == ["0", "1", "2"]
    assert [float(line["scale"]) for line in table] == [0.7, 0.6, 0.8]
    assert "dead centre" in table[1]["failure"]
    assert table[0]["failure"] == ""
    judged = [name for name in table[0] if name.startswith("claim_")]
    on_machines = [n for n, claim in enumerate(CLAIMS, 1) if claim.judge is not None and not claim.closed_form]
    assert judged == [f"claim_{n}" for n in on_machines]
    assert {table[0][name] for name in judged} == {"holds"}  # the paper is right on these
    assert {table[1][name] for name in judged} == {""}
    assert [name for name in table[0] if name in {factor.name for factor in FACTORS}] == [
        f.name for f in FACTORS
    ]
    said, sheets = Words("claims").chapter(claims.words([], rows), claims.tables([], rows), ())
    assert any(text.endswith("for the reasons given in the last table: 1.") for text in said.findings)
    assert said.sheets[-1] == sheets["failures"]
    assert sheets["failures"].title.endswith(": 1")


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


def test_the_key_does_not_depend_on_the_order_of_the_data() -> None:
    assert hypercube.key(dict(reversed(REFERENCE.items()))) == hypercube.key(REFERENCE)


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
