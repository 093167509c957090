"""`sweep FILE`: many runs, in one store that can be continued."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

from support_exudyn.commands.command_line import add_out, count, folder, say, warn
from user_forces.values.value import cleaned

if TYPE_CHECKING:
    from support_exudyn.sweeps.run import SweepOutcome, Told

EPILOG = """
The store is a folder with a file for every run, named by a key of its inputs and of the program's versions,
and one table, table.parquet and table.csv, with a row for every run. A sweep that was interrupted goes on
where it stopped; after a change of FILE only those runs are made that the store does not hold. A run that
fails is a row with its reason. Exit code 3: the table is whole, but some of its rows are failures.
"""
FAILURES = 3  # exit code
MOST_WORKERS = 1024
SELDOM = 60.0  # seconds between lines where there is no terminal
SHOWN = 12  # first rows and columns that are shown in a terminal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The sweep's file, where the store is, and who runs it."""
    add = parser.add_argument
    parser.epilog = EPILOG
    add("file", type=folder, metavar="FILE", help="what is varied, as TOML")
    add_out(parser, "the store; by default FILE_sweep beside FILE")
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--workers",
        type=lambda text: count(text, MOST_WORKERS),
        metavar="N",
        help="processes on this machine (as many as there are cores)",
    )
    where.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        default="",
        help="of a Dask scheduler, such as tcp://10.0.0.5:8786, whose workers have this program, too; needs "
        "pip install 'support-exudyn[cluster]'",
    )
    add("--retry-failed", action="store_true", help="run again what has failed before")
    add("--prune", action="store_true", help="remove runs from the store that FILE no longer asks for")
    add("--dry-run", action="store_true", help="only tell how many runs there are to do")
    add("--json", action="store_true", help="one JSON object instead of text")


def run(given: argparse.Namespace) -> None:
    """Run what is missing, and tell how many runs there are of each kind, and where the table is."""
    from support_exudyn.sweeps import read_sweep, sweep  # and pyarrow
    from support_exudyn.sweeps.run import known

    plan = read_sweep(given.file)
    out = given.out or plan.store or Path()
    if given.dry_run:
        outcome = known(plan, out, given.retry_failed)
        _tell(
            outcome, given, f"{outcome.runs} runs, {outcome.runs - outcome.finished} to do; {_counts(outcome)}"
        )
        return
    with _shown(len(plan.points)) as progress:
        outcome = sweep(
            plan,
            out,
            workers=given.workers,
            scheduler=given.scheduler,
            retry_failed=given.retry_failed,
            prune=given.prune,
            progress=progress,
        )
    for name in outcome.missing:
        warn(f"{name}: no run has this number")
    _tell(outcome, given, f"{outcome.runs} runs: {_counts(outcome)}")
    if outcome.unmet:
        print(
            f"{outcome.unmet} runs are less accurate than asked for; the table's reason tells which",
            file=sys.stderr,
        )
    if outcome.done < outcome.runs:
        print("some runs have failed; their reasons are in the table", file=sys.stderr)
        raise SystemExit(FAILURES)


def _tell(outcome: SweepOutcome, given: argparse.Namespace, words: str) -> None:
    if given.json:
        from support_exudyn.commands.command_line import answer

        data: dict[str, Any] = asdict(outcome)
        answer(data | {"to_do": outcome.runs - outcome.finished})
        return
    say(words + (f", {outcome.pruned} others removed from the store" if outcome.pruned else ""))
    if given.dry_run:
        return
    say(str(outcome.table))
    say(f"next: support-exudyn show {outcome.table.parent}")
    if sys.stdout.isatty():
        _show(outcome.table)


def _counts(outcome: SweepOutcome) -> str:
    kinds = {"done": outcome.done, "failed": outcome.failed, "killed": outcome.killed}
    said = ", ".join(f"{number} {kind}" for kind, number in kinds.items() if number) or "none done"
    return f"{said} ({outcome.found} of them were in the store)" if outcome.found else said


@contextmanager
def _shown(runs: int) -> Iterator[Told]:
    """A bar with counts on a terminal, else a line once in a while."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    console = Console(stderr=True)
    columns = BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}"), TimeRemainingColumn()
    said = monotonic()
    with Bar(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("", total=runs)

        def tell(outcome: SweepOutcome) -> None:
            nonlocal said
            if console.is_terminal:
                bad = outcome.failed + outcome.killed
                bar.update(task, completed=outcome.finished, description=f"{bad} failed" if bad else "")
            elif monotonic() - said > SELDOM:
                said = monotonic()
                print(f"{outcome.finished} of {outcome.runs} runs", file=sys.stderr, flush=True)

        yield tell


def _show(path: Path) -> None:
    """The first rows and columns of a table."""
    from rich import box
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    from support_exudyn.sweeps import read_table

    found = read_table(path)
    wanted = [name for name in found.column_names if name not in ("key", "reason", "wall_time_s")]
    names = [name for name in wanted if not name.endswith("_error")][:SHOWN]
    shown = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in names:
        shown.add_column(escape(cleaned(name)), justify="right", overflow="fold")
    for row in found.slice(0, SHOWN).to_pylist():
        shown.add_row(*(escape(_said(row[name])) for name in names))
    Console(highlight=False).print(shown)
    rest = found.num_rows - SHOWN
    if rest > 0:
        say(f"... and {rest} more rows")


def _said(item: Any) -> str:
    return "" if item is None else f"{item:.6g}" if isinstance(item, float) else cleaned(str(item))
