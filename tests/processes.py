"""What the system knows of processes, for tests that kill some (Linux)."""

from __future__ import annotations

import multiprocessing
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from support_exudyn.sweeps import workers

ROOT = Path(__file__).parents[1]
linux_only = pytest.mark.skipif(sys.platform != "linux", reason="asks /proc who is alive")


def environment() -> dict[str, str]:
    """For a script: it finds the same packages as this process, and takes one thread for linear algebra."""
    paths = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
    return dict(os.environ) | {"PYTHONPATH": os.pathsep.join(paths), "OPENBLAS_NUM_THREADS": "1"}


def alive(pids: Iterable[int]) -> set[int]:
    """Those that have not ended; one that has and only waits to be asked for its code counts as ended."""
    return {pid for pid in pids if (found := _state_and_session(pid)) and found[0] not in "ZX"}


def session_of(leader: int) -> set[int]:
    """All live processes of the session that a process opened, also after its own end."""
    pids = [int(entry.name) for entry in Path("/proc").iterdir() if entry.name.isdigit()]
    return {pid for pid in alive(pids) if (found := _state_and_session(pid)) and found[1] == leader}


def _state_and_session(pid: int) -> tuple[str, int] | None:
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
    except (FileNotFoundError, ProcessLookupError):
        return None
    fields = text.rpartition(")")[2].split()  # the name before it may hold anything
    return fields[0], int(fields[3])


@contextmanager
def soon_started(module: str) -> Iterator[None]:
    """Workers come from a process that has imported everything and this module, where there can be one."""
    if os.name == "nt":
        yield
        return
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["support_exudyn.formulations.exudyn.run", module])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(workers, "CONTEXT", context)
        yield


def wait_until(happened: Callable[[], bool], seconds: float) -> bool:
    """Whether it happens in time."""
    end = time.monotonic() + seconds
    while not happened():
        if time.monotonic() > end:
            return False
        time.sleep(0.002)
    return True
