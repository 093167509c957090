"""Runs of studies: in parallel, under a progress bar, at ever shorter steps, and kept as files.

A run that is kept is made once: for all studies of a command, and for the next command, also after one that was
killed. It is known by its inputs and by the program that made it, see `support_exudyn.sweeps.key`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace

from studies.common.options import Options
from support_exudyn import Failure, Result, Scenario, SimulationError
from support_exudyn.commands.command_line import shown_progress
from support_exudyn.sweeps.key import key
from support_exudyn.sweeps.work import run_all
from user_forces.values.value import InputError

SHORT = {  # what of a case's name stands otherwise in the name of its file
    " mm, mu_d = ": "mm_mu", ", mu_d = ": "_mu", " + ": "+", "m/s": "mps", ",": "", " ": "_", ".": "p",
    "/": "_",
}  # fmt: skip


def run_with_errors(cases: Mapping[str, Scenario], chosen: Options, halved: int = 2) -> dict[str, Result]:
    """Run every case at its steps, at half and at a quarter of them, in parallel, under a progress bar.

    halved: how often the steps are halved; once is enough for an error, twice tells how fast errors fall.

    Each result is that of the shortest steps, and the others are its `coarser` ones: every number of it has the
    error that accuracies estimate, `Result.estimate`. Where numbers do not settle that is large, and no reason
    to end a study. A case that asks for an accuracy has such errors by itself, and is run once.

    Raises SimulationError if a run fails.
    """
    steps: dict[str, list[Scenario]] = {}
    for name, case in cases.items():
        steps[name] = [case]
        while case.accuracy is None and len(steps[name]) <= halved:
            steps[name].append(steps[name][-1].refined())

    def label(name: str, n: int) -> str:
        return f"{name}, steps / {2**n}" if n else name

    # the longest first, so that no process is left alone with a long run at the end
    finest_first = range(halved, -1, -1)
    runs = {label(name, n): at[n] for n in finest_first for name, at in steps.items() if n < len(at)}
    good = run_cases(runs, chosen)
    return {name: with_coarser([good[label(name, n)] for n in range(len(at))]) for name, at in steps.items()}


def with_coarser(runs: Sequence[Result]) -> Result:
    """The last of runs of a scene, the coarsest first, with those before as its coarser ones."""
    found, *finer = runs
    for run in finer:
        found = replace(run, coarser=found)
    return found


def halvings(result: Result) -> tuple[Result, ...]:
    """A run and its coarser ones, the coarsest first."""
    return (*(halvings(result.coarser) if result.coarser else ()), result)


def impacts(result: Result, pin: str) -> int:
    """How many impacts of a pin a run and all its coarser ones have: that of others has no error."""
    return min(len(run.onsets.get(pin, ())) for run in halvings(result))


def file_name(case: str) -> str:
    """The name of the file of a case, without its ending: "1.5 mm, mu_d = 0.25" is kept as 1p5mm_mu0p25."""
    for text, written in SHORT.items():
        case = case.replace(text, written)
    return case


def run_cases(runs: Mapping[str, Scenario], chosen: Options) -> dict[str, Result]:
    """Run scenarios in parallel, in the order given, under a progress bar; those that are kept are read.

    Raises SimulationError if a run fails.
    """
    files = {name: chosen.kept / f"{key(case)}.h5" for name, case in runs.items()} if chosen.kept else {}
    good: dict[str, Result | Failure] = {}
    for name, path in files.items():
        with suppress(OSError, InputError):  # not there, or not whole
            good[name] = Result.load(path)
    if missing := {name: case for name, case in runs.items() if name not in good}:
        with bar(f"{len(missing)} runs") as show:
            good |= run_all(
                missing, workers=chosen.workers, progress=lambda shares: show([*shares.values()]), files=files
            )
    found: dict[str, Result] = {}
    for name in runs:
        result = good[name]
        if isinstance(result, Failure):
            raise SimulationError(replace(result, reason=f"{name}: {result.reason}"))
        found[name] = result
    return found


@contextmanager
def bar(name: str) -> Iterator[Callable[[Sequence[float]], None]]:
    """One progress bar for many jobs: yields the function that takes the completed share of each job."""
    with shown_progress(name) as show:
        yield lambda shares: show(sum(shares) / max(1, len(shares)))
