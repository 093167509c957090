"""The runs of a sweep on a Dask cluster; its machines need not see this one's disk."""

import logging
import sys
import threading
from collections.abc import Generator, Iterable
from itertools import islice
from typing import Any

from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.store import StoredRun
from support_exudyn.sweeps.work import Task, run_task
from user_forces.values.value import InputError

AHEAD = 2  # runs for each thread of the cluster that wait there, so that none waits for us
FEWEST = 4  # runs at once, also while no worker has come yet
REACHED = 10.0  # [s] within which a scheduler must answer
ONE = threading.Lock()  # the engine runs once in a process, however many threads a worker has


def on_cluster(tasks: Iterable[Task], address: str) -> Generator[StoredRun, None, None]:
    """Rows as they come.

    A run whose worker is lost is done again by another; how often is the scheduler's setting
    (`distributed.scheduler.allowed-failures`). If that is used up its row is "killed".

    address: of the scheduler, such as "tcp://10.0.0.5:8786".

    Raises InputError if dask.distributed is not installed, or if a worker runs another program than this one;
    OSError if the scheduler cannot be reached.
    """
    client = _connected(address)
    from distributed import CancelledError, KilledWorker, as_completed  # it is installed, then

    lost = OSError(f"scheduler = {address!r}: was lost; the same command goes on from here")
    under_way: dict[Any, Task] = {}
    source = iter(tasks)

    def further(done: Any) -> None:
        try:
            room = max(FEWEST, AHEAD * sum(client.nthreads().values()))
        except OSError:  # of a connection that is closed
            raise lost from None
        for task in islice(source, max(0, room - len(under_way))):
            # a name of its own every time: else the cluster might hold what an earlier sweep has left there
            future = client.submit(_remote, task, program(), pure=False)
            under_way[future] = task
            done.add(future)

    if not client.nthreads():
        print(f"{address}: no worker is there yet; waiting", file=sys.stderr, flush=True)
    with client:
        done = as_completed(loop=client.loop)
        try:
            further(done)
            while under_way:
                future = next(done)
                task = under_way.pop(future)
                try:
                    row: StoredRun = future.result()
                except KilledWorker as error:
                    reason = f"lost with its worker, again and again: {_said(error)}"
                    row = StoredRun(task.key, "killed", reason)
                except CancelledError:
                    raise lost from None
                yield row
                future.release()
                further(done)
        finally:
            if client.status == "running":
                client.cancel(list(under_way), force=True)


def _connected(address: str) -> Any:
    """A client of the scheduler. Raises as `on_cluster` does."""
    try:
        from distributed import Client
        from distributed.comm import get_address_host_port
    except ImportError:
        raise InputError(
            f"scheduler = {address!r}: needs dask.distributed, which is not installed; "
            "pip install 'support-exudyn[cluster]'"
        ) from None
    _silence_output()
    try:  # before there is a client, which would wait for its own end
        get_address_host_port(address, strict=True)
    except ValueError as error:
        raise InputError(
            f"scheduler = {address!r}: {_said(error)}; allowed: an address such as tcp://10.0.0.5:8786"
        ) from None
    try:
        return Client(address, timeout=REACHED, set_as_default=False)
    except Exception as error:  # of many kinds
        raise OSError(
            f"scheduler = {address!r}: cannot be reached ({_said(error)}); is it running there?"
        ) from None


def _silence_output() -> None:
    """Let Dask's log be silent: what goes wrong is said in a line of ours."""
    for name in [*logging.root.manager.loggerDict]:  # some of them have levels of their own
        if name.partition(".")[0] in ("distributed", "tornado", "asyncio"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _said(error: Exception) -> str:
    return " ".join(str(error).split())


def _remote(task: Task, ours: dict[str, str]) -> StoredRun:
    """On a worker: a run's row."""
    theirs = program()
    differing = sorted(name for name in {*ours, *theirs} if ours.get(name) != theirs.get(name))
    if differing:
        said = "; ".join(f"{n}: {theirs.get(n, 'none')} there, {ours.get(n, 'none')} here" for n in differing)
        raise InputError(f"a worker of the cluster runs another program ({said}); allowed: the same everywhere")
    with ONE:
        return run_task(task)
