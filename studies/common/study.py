"""What a study is, and everything that it leaves in its folder."""

import csv
import json
import sys
import textwrap
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, replace
from functools import cached_property
from pathlib import Path
from typing import ClassVar

from matplotlib.figure import Figure
from rich.console import Console

from studies.common import witness
from studies.common.numbers import (
    LONGEST,
    NUMBERS,
    Found,
    Measures,
    Number,
    by_case,
    measured_all,
    number_table,
)
from studies.common.options import Options
from studies.common.runs import file_name, run_with_errors
from studies.common.words import FILE, Chapter, JudgedClaim, Picture, filled, titled, without_references
from support_exudyn import Result, Scenario
from support_exudyn.commands.command_line import answered, say
from support_exudyn.files.whole_file import remove_leftovers, whole_file, writing_alone
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.live import of_drawing
from support_exudyn.postprocessing.page.pieces import HARD_SPACE, KeyNumber, Sheet, unbroken
from support_exudyn.simulation.at_start import be_interruptible
from support_exudyn.simulation.provenance import versions
from support_exudyn.sweeps.workers import Workers
from user_forces.values.value import InputError

LivePanels = Sequence[int] | Mapping[int, str]  # of a live figure, see `of_drawing`
ALL_NUMBERS = "All numbers of the study; the number behind ± is the numerical error"


class Study:
    """A question and the work that answers it.

    A study is a class whose docstring is its question; an object is that study with the options of a command.
    It has cases and measures, or its own `work`; figures, tables and words follow from the runs and numbers.

    Attributes:
        name: of its folder.
        seconds: that it takes on two cores, once all is compiled.
        own_machine: whether it can be about the user's machine.
        sentences: file of the template in the folder of its module.
        has_witness: whether its cases are run on Exudyn and by the witness, see `studies.common.witness`.
        live: panels of a figure that readers of the report can zoom, by the figure's name.
        papers: printed values of numbers by name and case.
        runs: all runs by case, once `work` is done.
        numbers: all numbers, once `work` is done.
    """

    name: ClassVar[str]
    seconds: ClassVar[float] = 60.0
    own_machine: ClassVar[bool] = False
    sentences: ClassVar[str] = "words.md.j2"
    has_witness: ClassVar[bool] = False
    live: ClassVar[Mapping[str, LivePanels]] = {}
    papers: Mapping[tuple[str, str], float] = {}

    def __init__(self, chosen: Options) -> None:
        if not (self.own_machine or chosen.subject.is_paper):
            raise InputError(f"--machine: {self.name} is about the paper's machine alone; allowed: without it")
        self.chosen, self.subject = chosen, chosen.subject
        self.runs: Mapping[str, Result] = {}
        self.numbers: Sequence[Number] = ()

    @classmethod
    def question(cls) -> str:
        """The question, in a line."""
        return (cls.__doc__ or "").splitlines()[0]

    @classmethod
    def template(cls) -> str:
        """The template of the sentences, below `studies`."""
        return f"{cls.__module__.split('.')[1]}/{cls.sentences}"

    @cached_property
    def found(self) -> Found:
        """All numbers by name and case."""
        return by_case(self.numbers)

    # --- what the studies define ---

    def cases(self) -> Mapping[str, Scenario]:
        """Scenarios by the name of their case."""
        raise NotImplementedError(
            f"{self.name}: allowed: a study with `cases` and `measures`, or its own `work`"
        )

    def measures(self, run: Result) -> Measures:
        """Unit and measure of every number of a run, by name."""
        raise NotImplementedError(f"{self.name}: allowed: a study with `measures`, or its own `work`")

    def ideal_of(self, case: str) -> str:
        """The case with ideal pins with which a case is compared."""
        return case

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        """All numbers of these runs of the cases."""
        return measured_all(runs, self.measures, self.ideal_of, self.papers)

    def work(self) -> None:
        """Run all cases and measure the runs."""
        if self.has_witness:
            self.runs, self.numbers = witness.run_and_measure(self.cases(), self.measure, self.chosen)
        else:
            self.runs = run_with_errors(self.cases(), self.chosen)
            self.numbers = self.measure(self.runs)

    def figures(self) -> Mapping[str, Figure]:
        """Figures by the name of their files."""
        return {}

    def tables(self) -> Mapping[str, Sheet]:
        """Tables by the name of their files; title and caption come from the template."""
        return {}

    def words(self) -> Mapping[str, object]:
        """What the template is filled with besides `study`, `subject`, `runs` and `found`."""
        return {}

    def saved(self) -> Mapping[str, Result]:
        """The runs that are written, by case."""
        return self.runs

    def tiles(self) -> Sequence[KeyNumber]:
        """Numbers of the report's first screen."""
        return ()

    def claims(self) -> Sequence[JudgedClaim]:
        """Judged statements of the paper."""
        return ()

    def counts(self) -> Mapping[str, int]:
        """Counts of its own, for the summary."""
        return {}

    # --- what all studies have in common ---

    def write(self) -> Chapter:
        """Compute, draw and write everything into the output folder. Returns the chapter.

        Raises KeyError if the template has no title for a table.
        """
        started, out = time.perf_counter(), self.chosen.out
        with style.look():
            self.work()
            drawings = self.figures()
        for case, run in self.saved().items():
            # without the coarser ones of chosen steps, which treble the file
            kept = run if run.goal is not None else replace(run, coarser=None)
            kept.save(out / "runs" / f"{file_name(case)}.h5")
        jobs = [(drawing, out, name, self.live.get(name, ())) for name, drawing in drawings.items()]
        if isinstance(self.chosen.workers, Workers):
            self.chosen.workers.run(jobs, _save_figure, lambda shares: None)
        else:  # starting a pool takes longer
            for place, job in enumerate(jobs):
                _save_figure(place, *job)
        chapter = self._chapter(drawings, round(time.perf_counter() - started, 3))
        numbers = [asdict(number) for number in self.numbers]
        about = {"study": self.name, "versions": chapter.versions, "wall_s": chapter.wall_s}
        texts = {
            FILE: chapter.model_dump_json(indent=1),
            "summary.json": json.dumps(
                {**about, **self.counts(), "numbers": numbers}, indent=1, allow_nan=False
            ),
        }
        for file, text in texts.items():
            with whole_file(out / file) as temporary:
                temporary.write_text(text + "\n", encoding="utf-8")
        return chapter

    def _chapter(self, drawings: Mapping[str, Figure], wall_s: float) -> Chapter:
        """The chapter of the report; all tables are written, those too long for the chapter among them.

        A study with a witness names engine and method in every caption, and what the witness confirms.
        """
        every_run = {"study": self, "subject": self.subject, "runs": self.runs, "found": self.found}
        blocks = filled(self.template(), {**every_run, **self.words()})
        blocks.setdefault(NUMBERS, [ALL_NUMBERS])
        title, question = next(iter(blocks.items()))
        by, confirmed = (
            (witness.computed_by(), [witness.verdict(self.numbers)]) if self.has_witness else ("", [])
        )
        sheets = []
        for name, table in {**self.tables(), NUMBERS: number_table(self.numbers)}.items():
            sheet = titled(table, name, blocks)
            there = f" Witness of every number, and the difference: [@{NUMBERS}]." if name != NUMBERS else ""
            sheet = replace(sheet, caption=f"{sheet.caption} {by}{there}".strip()) if by else sheet
            save_table(self.chosen.out / f"{name}.csv", sheet)
            sheets.append(sheet)
        pictures = (item.partition(": ") for item in blocks.get("Figures", ()))
        return Chapter(
            study=self.name,
            machine=self.subject.name,
            contact="" if self.subject.is_paper else self.subject.contact_in_words,
            title=title,
            question=" ".join(question),
            answer=" ".join(blocks.get("Answer", ())),
            numbers=tuple(blocks.get("Numbers", ())),
            method=(*blocks["Method"], *([by] if by else ())),
            findings=(*blocks.get("Findings", ()), *confirmed),
            pictures=tuple(Picture(stem, caption) for stem, _, caption in pictures if stem in drawings),
            sheets=tuple(sheet for sheet in sheets if len(sheet.rows) <= LONGEST),
            tiles=tuple(self.tiles()),
            claims=tuple(self.claims()),
            computed_by=by,
            wall_s=wall_s,
            versions=versions(),
        )


def _save_figure(place: int, drawing: Figure, out: Path, name: str, live: LivePanels) -> None:
    del place
    with style.look():
        style.save(drawing, out, name)
    if live:
        of_drawing(drawing, live).save(out / f"{name}.live.json")


def say_short(chapter: Chapter, out: Path) -> None:
    """Print a study in ten lines: question, answer, three numbers, where to look."""
    lines = [f"question  {chapter.question}", f"answer    {chapter.answer}"]
    lines += [f"        - {number}" for number in chapter.numbers]
    say(f"\n{chapter.study}")
    for line in lines:
        wrapped = textwrap.fill(unbroken(without_references(line)), 100, subsequent_indent=10 * " ")
        say(wrapped.replace(HARD_SPACE, " "))
    say(f"look at   {out}")


def print_table(table: Sheet, width: int) -> None:
    """Print a table, so many characters wide unless a terminal has a width of its own."""
    Console(width=None if sys.stdout.isatty() else width).print(table.rich())


def save_table(path: Path, table: Sheet) -> None:
    """Write a table as CSV; names of files stand in place of links."""
    with whole_file(path) as temporary, temporary.open("w", encoding="utf-8", newline="") as file:
        rows = ([without_references(cell) for cell in row] for row in table.rows)
        csv.writer(file).writerows([table.header, *rows])


def work_in_folder(work: Callable[[Path], None], out: Path) -> int:
    """Fill an output folder; what the user can mend is printed in a sentence. Returns the exit code."""

    def done() -> None:
        with output_folder(out):
            work(out)

    return answered(done)


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
            held.enter_context(writing_alone(out))  # which writes a file
        except (OSError, ValueError) as error:  # a ValueError: a name that no folder can have
            why = getattr(error, "strerror", None) or error
            allowed = "a folder that can be made and written to"
            raise OSError(f"--out {str(out)!r}: {why}; allowed: {allowed}") from None
        try:
            remove_leftovers(out, below=True, older=0.0)  # of a run that was killed
            yield
        finally:
            remove_leftovers(out, below=True, older=0.0)  # of its own processes, which ended in mid-work
