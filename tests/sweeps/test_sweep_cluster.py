"""A sweep on a Dask cluster: a real scheduler and workers, one of which is killed."""

from __future__ import annotations

import importlib.util
import json
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from support_exudyn.sweeps import read_sweep, sweep
from support_exudyn.sweeps.cluster import _remote
from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.plan import Record
from support_exudyn.sweeps.work import Task
from tests.cases.sweep_cases import columns, rows, run_by, speeds, start, write_sweep
from tests.processes import ROOT, environment, linux_only, wait_until
from user_forces.values.value import InputError

SOON = 90.0  # [s]; what comes at all has come by then, on a busy machine too
RUNS = 20
Started = Callable[..., subprocess.Popen[bytes]]

needs_dask = pytest.mark.skipif(
    importlib.util.find_spec("distributed") is None, reason="needs the extra [cluster]"
)


@pytest.fixture
def started(tmp_path: Path) -> Iterator[Started]:
    """Starts programs of Dask, and ends them after the test."""
    processes: list[subprocess.Popen[bytes]] = []

    def begin(program: str, *options: str) -> subprocess.Popen[bytes]:
        with (tmp_path / f"{program}_{len(processes)}.log").open("wb") as log:
            processes.append(
                subprocess.Popen(
                    [sys.executable, "-m", f"distributed.cli.dask_{program}", "--no-dashboard", *options],
                    cwd=ROOT,
                    env=environment(),
                    stdout=log,
                    stderr=log,
                )
            )
        return processes[-1]

    try:
        yield begin
    finally:
        for process in processes:
            process.kill()
            process.wait()


@pytest.mark.slow  # five processes, each of which imports all
@needs_dask
@linux_only
def test_with_a_worker_killed_midway_it_gives_the_same_table_as_here(
    tmp_path: Path, started: Started, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_sweep(tmp_path, speeds(RUNS), duration=0.04)
    file, store = tmp_path / "scheduler.json", tmp_path / "store"
    started("scheduler", "--port", "0", "--host", "127.0.0.1", "--scheduler-file", str(file))
    assert wait_until(lambda: file.exists() and file.stat().st_size > 0, SOON)  # it is there before its text
    options = "--scheduler-file", str(file), "--nthreads", "1", "--no-nanny"
    workers = [started("worker", *options) for _ in range(2)]
    address = json.loads(file.read_text(encoding="utf-8"))["address"]
    process = start(path, "--scheduler", address, "--out", str(store))
    try:
        assert wait_until(lambda: len(rows(store)) >= 4, SOON)
        workers[0].send_signal(signal.SIGKILL)
        assert len(rows(store)) < RUNS
        out, errors = process.communicate(timeout=SOON)
    finally:
        process.kill()
    assert process.returncode == 0, errors
    assert out.splitlines()[0] == f"{RUNS} runs: {RUNS} done"
    assert workers[0].wait() == -signal.SIGKILL
    run_by(monkeypatch)
    sweep(read_sweep(path), tmp_path / "whole")
    assert columns(store) == columns(tmp_path / "whole")


def test_a_worker_with_another_program_refuses(tmp_path: Path) -> None:
    plan = read_sweep(write_sweep(tmp_path, speeds(2)))
    task = Task("key", plan.scenario(plan.points[0]), Record())
    with pytest.raises(InputError, match=r"another program \(exudyn: .* there, 9.9 here\)"):
        _remote(task, program() | {"exudyn": "9.9"})
    assert _remote(task, program()).status == "done"
