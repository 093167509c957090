"""What a study is and how it is run: its options, its folder, and everything that it leaves there."""

import csv
import sys
import tempfile
import textwrap
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from matplotlib.figure import Figure
from rich.console import Console

from studies.common import witness
from studies.common.numbers import NUMBERS, Number, number_rows, write_summary
from studies.common.options import Options
from studies.common.runs import file_name, save_run
from studies.common.witness import Witness
from studies.common.words import Chapter, JudgedClaim, Words, text_table, without_references
from support_exudyn import Result
from support_exudyn.commands.command_line import answered, say
from support_exudyn.files.whole_file import remove_leftovers, whole_file, writing_alone
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.drawing_data import save_drawing_data
from support_exudyn.postprocessing.page.live import of_drawing
from support_exudyn.postprocessing.page.pieces import HARD_SPACE, KeyNumber, Sheet, unbroken
from support_exudyn.simulation.at_start import be_interruptible
from support_exudyn.sweeps.workers import Workers
from user_forces.values.value import InputError

LivePanels = Sequence[int] | Mapping[int, str]  # of a live figure, see `of_drawing`


@dataclass(frozen=True)
class StudyOutcome:
    """What a study found.

    numbers: of summary.json. words: what the sentences of words.md.j2 are filled with, by name. figures,
    tables: by the name of their files. runs: by that of their case. counts: of its own, for the summary. live:
    which panels of a figure are time series that the report lets readers look into, by the figure's name.
    tiles: numbers on the first screen of the report. claims: see `JudgedClaim`. witness: of a study whose runs
    are those of Exudyn.
    """

    numbers: Sequence[Number]
    words: Mapping[str, object]
    figures: Mapping[str, Figure]
    tables: Mapping[str, Sheet]
    runs: Mapping[str, Result] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)
    live: Mapping[str, LivePanels] = field(default_factory=dict)
    tiles: Sequence[KeyNumber] = ()
    claims: Sequence[JudgedClaim] = ()
    witness: Witness | None = None


@dataclass(frozen=True)
class Study:
    """A study: a question, and the work that answers it.

    name: of its folder. asks: the docstring of its module, whose first line is its question. work: computes all
    that it leaves. seconds: that it takes on two cores, once all is compiled. own_machine: whether it can be
    about the user's machine. sentences: their template
    below `studies`; empty: words.md.j2 in its folder.
    """

    name: str
    asks: str | None
    work: Callable[[Options], StudyOutcome]
    seconds: float = 60.0
    own_machine: bool = False
    sentences: str = ""

    @property
    def template(self) -> str:
        """The template of its sentences, below `studies`."""
        return self.sentences or f"{self.name}/words.md.j2"

    @property
    def question(self) -> str:
        """The question, in a line."""
        return (self.asks or "").splitlines()[0]

    def __call__(self, chosen: Options) -> Chapter:
        """Compute, draw and write everything into the output folder. Returns the chapter."""
        if not (self.own_machine or chosen.subject.is_paper):
            raise InputError(f"--machine: {self.name} is about the paper's machine alone; allowed: without it")
        started = time.perf_counter()
        with style.look():
            found = self.work(chosen)
        numbers, tables = found.numbers, dict(found.tables)
        if found.witness is not None:
            numbers = found.witness.compared(numbers, chosen)
            tables = dict(found.witness.tables(numbers))
        for case, run in found.runs.items():
            save_run(run, chosen.out, file_name(case))
        save_figures(chosen, found.figures, found.live)
        words = {"subject": chosen.subject, "runs": found.runs, **found.words}
        tables[NUMBERS] = text_table(*number_rows(numbers), left=3)
        chapter, sheets = Words(self.name, self.template).chapter(
            words, tables, found.figures, found.tiles, found.claims
        )
        if found.witness is not None:
            chapter, sheets = witness.with_method(chapter, sheets, numbers)
        for name, sheet in sheets.items():
            save_table(chosen.out / f"{name}.csv", sheet)
        chapter.save(chosen.out)
        write_summary(chosen.out, self.name, numbers, time.perf_counter() - started, found.counts)
        return chapter


def work_in_folder(work: Callable[[Path], None], out: Path) -> int:
    """Do what fills an output folder; what the user can mend is said in a sentence. Returns the exit code."""

    def done() -> None:
        with output_folder(out):
            work(out)

    return answered(done)


def say_short(chapter: Chapter, out: Path) -> None:
    """Print a study in ten lines: question, answer, three numbers, where to look."""
    lines = [f"question  {chapter.question}", f"answer    {chapter.answer}"]
    lines += [f"        - {number}" for number in chapter.numbers]
    say(f"\n{chapter.study}")
    for line in lines:
        whole = unbroken(without_references(line))
        wrapped = textwrap.fill(whole, 100, subsequent_indent=10 * " ")
        say(wrapped.replace(HARD_SPACE, " "))
    say(f"look at   {out}")


def save_figures(
    chosen: Options, drawings: Mapping[str, Figure], live: Mapping[str, LivePanels] | None = None
) -> None:
    """Write a study's figures into its folder, as PNG, PDF and CSV; side by side if there is a pool.

    live: which panels of a figure are written as a live figure, too, see `of_drawing`.
    """
    panels = live or {}
    jobs = [(drawing, chosen.out, name, panels.get(name, ())) for name, drawing in drawings.items()]
    if isinstance(chosen.workers, Workers):
        chosen.workers.run(jobs, _save_figure, lambda shares: None)
    else:  # starting a pool takes longer
        for place, job in enumerate(jobs):
            _save_figure(place, *job)


def _save_figure(place: int, drawing: Figure, out: Path, name: str, live: LivePanels) -> None:
    del place
    with style.look():
        style.save(drawing, out, name)
    save_drawing_data(drawing, out / f"{name}.csv")
    if live:
        of_drawing(drawing, live).save(out / f"{name}.live.json")


def print_table(table: Sheet, width: int) -> None:
    """Print a table, so many characters wide unless a terminal has a width of its own."""
    Console(width=None if sys.stdout.isatty() else width).print(table.rich())


def save_table(path: Path, table: Sheet) -> None:
    """Write a table as CSV; names of files stand in place of links."""
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(table.header)
        writer.writerows(map(without_references, row) for row in table.rows)


@contextmanager
def output_folder(out: Path) -> Iterator[None]:
    """An output folder made ready, for this process alone: better to fail now than after the work.

    Temporary files of processes that are gone are cleared away before the block and after it.

    Raises OSError if it cannot be made or written to, or if another process is writing there.
    """
    be_interruptible()
    with ExitStack() as held:
        try:
            out.mkdir(parents=True, exist_ok=True)
            held.enter_context(writing_alone(out))
            remove_leftovers(out, below=True, older=0.0)  # of a run that was killed
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
            remove_leftovers(out, below=True, older=0.0)  # of its own processes, which ended in mid-work
