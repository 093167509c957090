"""What all studies share: their options, runs with errors, numbers and summary."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from studies.common.chapter import Sheet
from studies.common.rise import Peak
from support_exudyn import Failure, Result, Scenario, SimulationError
from support_exudyn.commands.command_line import Parser, answered, count, folder
from support_exudyn.files.temporary import remove_leftovers
from support_exudyn.files.whole_file import whole_file, writing_alone
from support_exudyn.postprocessing.figures import style
from support_exudyn.simulation.provenance import versions
from support_exudyn.sweeps.parallel_runs import run_all
from support_exudyn.sweeps.workers import Workers

MOST_BARS = 12  # more runs than that share one progress bar


@dataclass(frozen=True)
class Options:
    """How a study is to be run.

    out: folder for its output. quick: coarse steps for a quick look. workers: number of processes, or the pool
    that all studies share. machines: number of plausible machines of the study that draws them, None for its
    own choice.
    """

    out: Path
    quick: bool
    workers: int | Workers
    machines: int | None = None


ALL_OPTIONS = ("quick", "workers", "machines")
MOST_WORKERS, MOST_MACHINES = 1024, 100_000


def options(
    study: str, argv: Sequence[str] | None, description: str, taken: Sequence[str] = ALL_OPTIONS
) -> Options:
    """Options of a study from the command line; taken: which it has a use for, besides the folder."""
    parser = Parser(prog=f"python -m studies.{study}", description=description)
    add_options(parser, Path("results") / study, taken)
    given = parser.parse_args(argv)
    return Options(given.out, given.quick, given.workers, given.machines)


def add_options(parser: argparse.ArgumentParser, out: Path, taken: Sequence[str] = ALL_OPTIONS) -> None:
    """Options of a study; those that it has no use for keep their defaults."""
    parser.set_defaults(quick=False, workers=1, machines=None)
    parser.add_argument("--out", type=folder, default=out, metavar="DIR", help=f"folder for output ({out})")
    if "quick" in taken:
        parser.add_argument(
            "--quick", action="store_true", help="coarser steps: a look in seconds, larger errors"
        )
    if "workers" in taken:
        parser.add_argument(
            "--workers",
            type=partial(count, most=MOST_WORKERS),
            default=os.cpu_count() or 1,
            metavar="N",
            help="processes (all cores)",
        )
    if "machines" in taken:
        parser.add_argument(
            "--machines",
            type=partial(count, most=MOST_MACHINES),
            metavar="N",
            help="plausible machines to judge claims by (256; 8 if quick)",
        )


@dataclass(frozen=True)
class Number:
    """A number that a study reports.

    name, case: what, and of which run. value, unit. numerical_error: as accuracies estimate it, of three runs,
    see `simulation.estimate`; 0 for a closed form. paper: the printed value, None if there is none.
    """

    name: str
    case: str
    value: float
    unit: str
    numerical_error: float
    paper: float | None = None


Measure = Callable[[Result], float]


def measured(
    name: str, case: str, unit: str, result: Result, measure: Measure, paper: float | None = None
) -> Number:
    """A number of a run with errors, see `run_with_errors`."""
    found = result.estimate(measure, unit)
    between_records = measure.missed(result) if isinstance(measure, Peak) else 0.0
    return Number(name, case, found.value, unit, found.error + between_records, paper)


def counted(name: str, case: str, result: Result, count: Callable[[Result], int]) -> Number:
    """A count of a run; its error is how far its coarser ones are away, for counts do not converge."""
    found = [count(run) for run in halvings(result)]
    return Number(name, case, float(found[-1]), "1", float(max(abs(found[-1] - one) for one in found)))


def compared(
    name: str,
    case: str,
    unit: str,
    run: Result,
    other: Result,
    measure: Callable[[Result, Result], float],
    paper: float | None = None,
) -> Number:
    """A number of a run beside another one; the errors of both add up."""
    here = run.estimate(lambda finer: measure(finer, other), unit)
    there = other.estimate(lambda finer: measure(run, finer), unit)
    error = here.error if run is other else here.error + there.error
    return Number(name, case, here.value, unit, error, paper)


def run_with_errors(cases: Mapping[str, Scenario], workers: int | Workers) -> dict[str, Result]:
    """Run every case at its steps, at half and at a quarter of them, in parallel, under a progress bar.

    Each result is that of the shortest steps, and the others are its `coarser` ones: every number of it has the
    error that accuracies estimate, `Result.estimate`. Where numbers do not settle that is large, and no reason
    to end a study.

    Raises SimulationError if a run fails.
    """
    steps: dict[str, list[Scenario]] = {}
    for name, case in cases.items():
        half = case.refined()
        steps[name] = [case, half, half.refined()]
    # the longest first, so that no process is left alone with a long run at the end
    runs = {_at(name, n): chosen[n] for n in (2, 1, 0) for name, chosen in steps.items()}
    good = run_cases(runs, workers)
    return {name: with_coarser([good[_at(name, n)] for n in range(3)]) for name in cases}


def _at(name: str, n: int) -> str:
    return f"{name}, steps / {2**n}" if n else name


def with_coarser(runs: Sequence[Result]) -> Result:
    """The last of runs of a scene, the coarsest first, with those before as its coarser ones."""
    found, *finer = runs
    for run in finer:
        found = replace(run, coarser=found)
    return found


def halvings(result: Result) -> tuple[Result, ...]:
    """A run and its coarser ones, the coarsest first."""
    return (*(halvings(result.coarser) if result.coarser else ()), result)


def touches(result: Result, pin: str) -> int:
    """How many touches of a pin a run and all its coarser ones have: that of others has no error."""
    return min(len(run.onsets.get(pin, ())) for run in halvings(result))


def save_run(result: Result, out: Path, name: str) -> None:
    """Write a run into the folder of runs; one at chosen steps without its coarser ones, which treble it."""
    kept = result if result.goal is not None else replace(result, coarser=None)
    kept.save(out / "runs" / f"{name}.h5")


def run_cases(runs: Mapping[str, Scenario], workers: int | Workers) -> dict[str, Result]:
    """Run scenarios in parallel, in the order given, under a progress bar.

    Raises SimulationError if a run fails.
    """
    together = len(runs) > MOST_BARS
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %"))
    with Progress(*columns, TimeRemainingColumn(), console=Console(stderr=True)) as bars:
        total = [bars.add_task(f"{len(runs)} runs", total=float(len(runs)))] if together else []
        tasks = {} if together else {name: bars.add_task(name, total=1.0) for name in runs}

        def show(shares: Mapping[str, float]) -> None:
            for task in total:
                bars.update(task, completed=sum(shares.values()))
            for name, task in tasks.items():
                bars.update(task, completed=shares[name])

        results = run_all(runs, workers=workers, progress=show)
    good: dict[str, Result] = {}
    for name, result in results.items():
        if isinstance(result, Failure):
            raise SimulationError(replace(result, reason=f"{name}: {result.reason}"))
        good[name] = result
    return good


def write_summary(
    out: Path, study: str, numbers: Sequence[Number], wall_s: float, counts: Mapping[str, int] | None = None
) -> Path:
    """Write DIR/summary.json: study, versions, wall time, counts of the study's own, and all numbers."""
    summary = {
        "study": study,
        "versions": versions(),
        "wall_s": round(wall_s, 3),
        **(counts or {}),
        "numbers": [asdict(number) for number in numbers],
    }
    path = out / "summary.json"
    with whole_file(path) as temporary:
        temporary.write_text(json.dumps(summary, indent=1, allow_nan=False) + "\n", encoding="utf-8")
    return path


def save_figures(chosen: Options, drawings: Mapping[str, Figure]) -> None:
    """Write a study's figures into its folder, as PDF too in the full form; side by side if there is a pool."""
    jobs = [(drawing, chosen.out, name, not chosen.quick) for name, drawing in drawings.items()]
    if isinstance(chosen.workers, Workers):
        chosen.workers.run(jobs, _save_figure, lambda shares: None)
    else:  # starting a pool takes longer
        for place, job in enumerate(jobs):
            _save_figure(place, *job)


def _save_figure(place: int, drawing: Figure, out: Path, name: str, pdf: bool) -> None:
    del place
    with style.look():
        style.save(drawing, out, name, pdf=pdf)


def show_table(path: Path, table: Sheet, width: int = 150) -> None:
    """Print a table and write it as text, so many characters wide where there is no terminal."""
    shown = table.rich()
    Console(width=None if sys.stdout.isatty() else width).print(shown)
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8") as file:
        Console(file=file, width=width).print(shown)


def rounded(value: float, error: float) -> str:
    """A number with its error, both to the digits that the error leaves; alone if it has none."""
    if error == 0.0 or not math.isfinite(error):
        return f"{value:.9g}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    if digits > 9:
        return f"{value:.6g} ± {error:.0e}"
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def brief(value: float, error: float) -> str:
    """A number with its error in at most seven digits, for tables in which many stand side by side."""
    if error == 0.0 or not math.isfinite(error):
        return f"{value:.7g}"
    if value == 0.0:
        return f"0 ± {error:.0e}"
    digits = max(0, 6 - math.floor(math.log10(abs(value))))
    if error < 0.5 * 10.0**-digits:
        return f"{value:.{digits}f} ± {error:.0e}"
    left = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f} ± {error:.{digits}f}" if digits < left else rounded(value, error)


@contextmanager
def bar(name: str) -> Iterator[Callable[[Sequence[float]], None]]:
    """One progress bar for many jobs: gives what is told the share done of each."""
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %"))
    with Progress(*columns, TimeRemainingColumn(), console=Console(stderr=True)) as bars:
        task = bars.add_task(name, total=1.0)
        yield lambda shares: bars.update(task, completed=sum(shares) / max(1, len(shares)))


@contextmanager
def output_folder(out: Path) -> Iterator[None]:
    """An output folder made ready, for this process alone: better to fail now than after the work.

    Temporary files of processes that are gone are cleared away before the block and after it.

    Raises OSError if it cannot be made or written to, or if another process is writing there.
    """
    with ExitStack() as held:
        try:
            out.mkdir(parents=True, exist_ok=True)
            held.enter_context(writing_alone(out))
            remove_leftovers(out, below=True)  # of a run that was killed
            with tempfile.TemporaryFile(dir=out):
                pass
        except OSError as error:
            raise OSError(
                f"--out {out}: {error.strerror}; allowed: a folder that can be made and written to"
            ) from None
        except ValueError as error:  # a name that no folder can have
            raise OSError(f"--out {str(out)!r}: {error}; allowed: a folder that can be made") from None
        try:
            yield
        finally:
            remove_leftovers(out, below=True)  # of its own processes, which ended in mid-work


def run_main(main: Callable[[Options], None], chosen: Options) -> int:
    """Run a study; what the user can mend is said in a sentence. Returns the exit code."""

    def work() -> None:
        started = time.perf_counter()
        with output_folder(chosen.out):
            main(chosen)
        print(f"{chosen.out}: done in {time.perf_counter() - started:.1f} s", file=sys.stderr)

    return answered(work)
