"""Several runs side by side, in processes of their own."""

from collections.abc import Callable, Mapping
from pathlib import Path

from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Failure
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from support_exudyn.sweeps.workers import ProcessEndedError, Workers, report, worker_pool

Shares = Callable[[Mapping[str, float]], None]  # is told the share done of every run, by name

ADVICE = (
    "Look at the memory that the run takes: it is less with fewer channels or records. Run fewer side by side, "
    "or run it by itself."
)


def _run(place: int, scenario: Scenario, file: Path | None) -> Result | Failure:
    result = simulate(scenario, progress=report, throw=False)
    if file is not None and isinstance(result, Result):
        result.save(file)
    return result


def _ignore(shares: Mapping[str, float]) -> None:
    del shares


def run_all(
    scenarios: Mapping[str, Scenario],
    *,
    workers: int | Workers = 2,
    progress: Shares = _ignore,
    files: Mapping[str, Path] | None = None,
) -> dict[str, Result | Failure]:
    """Run scenarios in parallel processes; the order given is the order in which they are started.

    Arguments:
        scenarios: what to run, by name.
        workers: number of processes, >= 1, or the pool to use.
        progress: called about ten times a second.
        files: where a run is written as soon as it has ended, by its name; none by default.

    Returns:
        For each name its Result, or the Failure that says why there is none: also of a run whose process was
        killed or crashed. Any other exception in a run (a bug, an interruption) ends all of them.
    """
    chosen = list(scenarios.values())
    jobs = [(scenario, (files or {}).get(name)) for name, scenario in scenarios.items()]

    def told(shares: list[float]) -> None:
        progress(dict(zip(scenarios, shares, strict=True)))

    def ended(error: ProcessEndedError) -> Failure:
        return Failure(error.reason, ADVICE, error.share * chosen[error.place].duration)

    number = workers if isinstance(workers, Workers) else min(workers, len(scenarios))
    with worker_pool(number) as pool:
        results = pool.run(jobs, _run, told, ended)
    return dict(zip(scenarios, results, strict=True))
