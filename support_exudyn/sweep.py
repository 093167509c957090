"""Several runs side by side, in processes of their own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import FIRST_COMPLETED, wait
from typing import Any

from support_exudyn.errors import Failure
from support_exudyn.result import Result
from support_exudyn.scenario import Scenario
from support_exudyn.simulate import simulate
from support_exudyn.workers import CONTEXT, worker_pool

Shares = Callable[[Mapping[str, float]], None]  # is told the share done of every run, by name

_shares: Any = None  # in a worker: the shared array of shares done


def _start_worker(shares: Any) -> None:
    global _shares
    _shares = shares


def _run(place: int, scenario: Scenario) -> Result | Failure:
    def progress(share: float) -> None:
        _shares[place] = share

    return simulate(scenario, progress=progress, throw=False)


def _ignore(shares: Mapping[str, float]) -> None:
    del shares


def run_all(
    scenarios: Mapping[str, Scenario], *, workers: int = 2, progress: Shares = _ignore
) -> dict[str, Result | Failure]:
    """Run scenarios in parallel processes; the order given is the order in which they are started.

    Arguments:
        scenarios: what to run, by name.
        workers: number of processes, >= 1.
        progress: called about ten times a second.

    Returns:
        For each name its Result, or the Failure that says why there is none. Any other exception in a
        run (a bug, an interruption) ends all of them.
    """
    shares = CONTEXT.Array("d", len(scenarios), lock=False)
    with worker_pool(max(1, min(workers, len(scenarios))), _start_worker, (shares,)) as pool:
        futures = {
            name: pool.submit(_run, place, scenario) for place, (name, scenario) in enumerate(scenarios.items())
        }
        waiting = set(futures.values())
        while waiting:
            done, waiting = wait(waiting, timeout=0.1, return_when=FIRST_COMPLETED)
            for future in done:
                future.result()
            progress(dict(zip(scenarios, shares, strict=True)))
        return {name: future.result() for name, future in futures.items()}
