"""Several runs side by side, in processes of their own."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from support_exudyn.errors import Failure
from support_exudyn.result import Result
from support_exudyn.scenario import Scenario
from support_exudyn.simulate import simulate
from support_exudyn.workers import Workers, report, worker_pool

Shares = Callable[[Mapping[str, float]], None]  # is told the share done of every run, by name


def _run(place: int, scenario: Scenario) -> Result | Failure:
    return simulate(scenario, progress=lambda share: report(place, share), throw=False)


def _ignore(shares: Mapping[str, float]) -> None:
    del shares


def run_all(
    scenarios: Mapping[str, Scenario], *, workers: int | Workers = 2, progress: Shares = _ignore
) -> dict[str, Result | Failure]:
    """Run scenarios in parallel processes; the order given is the order in which they are started.

    Arguments:
        scenarios: what to run, by name.
        workers: number of processes, >= 1, or the pool to use.
        progress: called about ten times a second.

    Returns:
        For each name its Result, or the Failure that says why there is none. Any other exception in a
        run (a bug, an interruption) ends all of them.
    """

    def told(shares: list[float]) -> None:
        progress(dict(zip(scenarios, shares, strict=True)))

    number = workers if isinstance(workers, Workers) else min(workers, len(scenarios))
    with worker_pool(number) as pool:
        results = pool.run([(scenario,) for scenario in scenarios.values()], _run, told)
    return dict(zip(scenarios, results, strict=True))
