"""What a study is and how it is run: its options, its folder, and everything that it leaves there."""

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from matplotlib.figure import Figure
from rich.console import Console

from studies.common.chapter import Sheet
from studies.common.numbers import Number, write_summary
from studies.common.runs import file_name, save_run
from studies.common.words import TextTable, Words
from support_exudyn import Result
from support_exudyn.commands.command_line import Parser, answered, count, folder
from support_exudyn.files.temporary import remove_leftovers
from support_exudyn.files.whole_file import whole_file, writing_alone
from support_exudyn.postprocessing.figures import style
from support_exudyn.sweeps.workers import Workers

ALL_OPTIONS = ("quick", "workers", "machines")
MOST_WORKERS, MOST_MACHINES = 1024, 100_000


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


@dataclass(frozen=True)
class StudyOutcome:
    """What a study found.

    numbers: of summary.json. words: what the sentences of words.md.j2 are filled with, by name. figures,
    tables: by the name of their files. runs: by that of their case. counts: of its own, for the summary.
    """

    numbers: Sequence[Number]
    words: Mapping[str, object]
    figures: Mapping[str, Figure]
    tables: Mapping[str, TextTable]
    runs: Mapping[str, Result] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Study:
    """A study: a question, and the work that answers it.

    name: of its folder. asks: the docstring of its module, whose first line is its help. work: computes all
    that it leaves. taken: the options that it takes, besides the folder.
    """

    name: str
    asks: str | None
    work: Callable[[Options], StudyOutcome]
    taken: Sequence[str] = ALL_OPTIONS

    @property
    def description(self) -> str:
        """The question, in a line."""
        return (self.asks or "").splitlines()[0]

    def __call__(self, chosen: Options) -> None:
        """Compute, draw and write everything into the output folder."""
        started = time.perf_counter()
        with style.look():
            found = self.work(chosen)
        for case, run in found.runs.items():
            save_run(run, chosen.out, file_name(case))
        save_figures(chosen, found.figures)
        chapter, sheets = Words(self.name).chapter(found.words, found.tables, chosen.quick)
        for name, table in found.tables.items():
            if table.in_file:
                show_table(chosen.out / f"{name}.txt", sheets[name], table.width)
        chapter.save(chosen.out)
        write_summary(chosen.out, self.name, found.numbers, time.perf_counter() - started, found.counts)

    def main(self, argv: Sequence[str] | None = None) -> int:
        """Entry of `python -m studies.NAME`; returns the exit code."""
        return run_main(self, options(self.name, argv, self.description, self.taken))


def options(
    study: str, argv: Sequence[str] | None, description: str, taken: Sequence[str] = ALL_OPTIONS
) -> Options:
    """Options of a study from the command line; taken: which it has a use for, besides the folder."""
    parser = Parser(prog=f"python -m studies.{study}", description=description)
    add_options(parser, Path("results") / study.rpartition(".")[2], taken)
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
