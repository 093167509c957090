"""What a study is and how it is run: its folder, and everything that it leaves there."""

import csv
import json
import sys
import tempfile
import textwrap
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from matplotlib.figure import Figure
from rich.console import Console

from studies.common import witness
from studies.common.numbers import LONGEST, NUMBERS, Number, by_case, number_rows
from studies.common.options import Options
from studies.common.runs import file_name
from studies.common.words import (
    FILE,
    Chapter,
    JudgedClaim,
    Picture,
    filled,
    items,
    text_table,
    titled,
    without_references,
)
from support_exudyn import Result
from support_exudyn.commands.command_line import answered, say
from support_exudyn.files.whole_file import remove_leftovers, whole_file, writing_alone
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.drawing_data import save_drawing_data
from support_exudyn.postprocessing.page.live import of_drawing
from support_exudyn.postprocessing.page.pieces import HARD_SPACE, KeyNumber, Sheet, unbroken
from support_exudyn.simulation.at_start import be_interruptible
from support_exudyn.simulation.provenance import versions
from support_exudyn.sweeps.workers import Workers
from user_forces.values.value import InputError

LivePanels = Sequence[int] | Mapping[int, str]  # of a live figure, see `of_drawing`
ALL_NUMBERS = "All numbers of the study; the number behind ± is the numerical error"


@dataclass(frozen=True)
class StudyOutcome:
    """The results of a study.

    numbers: of summary.json. words: what the sentences of words.md.j2 are filled with, by name, besides the
    numbers by name and case (`found`), the runs and the subject. figures, tables: by the name of their files.
    runs: by that of their case. counts: of its own, for the summary. live: which panels of a figure are time
    series that the report lets readers look into, by the figure's name. tiles: numbers on the first screen of
    the report. claims: see `JudgedClaim`. has_witness: whether numbers are those of Exudyn and its witness.
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
    has_witness: bool = False


@dataclass(frozen=True)
class Study:
    """A study: a question, and the work that answers it.

    name: of its folder. asks: the docstring of its module, whose first line is its question. work: computes all
    that it leaves. seconds: that it takes on two cores, once all is compiled. own_machine: whether it can be
    about the user's machine. sentences: their template below `studies`; empty: words.md.j2 in its folder.
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
        """Compute, draw and write everything into the output folder. Returns the chapter.

        Raises KeyError if the template has no title for a table.
        """
        if not (self.own_machine or chosen.subject.is_paper):
            raise InputError(f"--machine: {self.name} is about the paper's machine alone; allowed: without it")
        started = time.perf_counter()
        with style.look():
            found = self.work(chosen)
        for case, run in found.runs.items():  # one at chosen steps without its coarser ones, which treble it
            kept = run if run.goal is not None else replace(run, coarser=None)
            kept.save(chosen.out / "runs" / f"{file_name(case)}.h5")
        save_figures(chosen, found.figures, found.live)
        chapter, sheets = self._chapter(found, chosen)
        for name, sheet in sheets.items():
            save_table(chosen.out / f"{name}.csv", sheet)
        _write(chosen.out / FILE, chapter.model_dump_json(indent=1))
        summary = {
            "study": self.name,
            "versions": versions(),
            "wall_s": round(time.perf_counter() - started, 3),
            **found.counts,
            "numbers": [asdict(number) for number in found.numbers],
        }
        _write(chosen.out / "summary.json", json.dumps(summary, indent=1, allow_nan=False))
        return chapter

    def _chapter(self, found: StudyOutcome, chosen: Options) -> tuple[Chapter, dict[str, Sheet]]:
        """The chapter of the report, and all tables by name, those that are too long for it among them.

        A study with a witness names engine and method in every caption, and what the witness confirms.
        """
        subject, of_all = chosen.subject, found.numbers
        numbers = {"subject": subject, "runs": found.runs, "found": by_case(of_all), **found.words}
        blocks = filled(self.template, numbers)
        blocks.setdefault(NUMBERS, [ALL_NUMBERS])
        tables = {**found.tables, NUMBERS: text_table(*number_rows(of_all), left=3)}
        sheets = {name: titled(table, name, blocks) for name, table in tables.items()}
        by, confirmed = (witness.computed_by(), [witness.verdict(of_all)]) if found.has_witness else ("", [])
        if by:
            there = f" Witness of every number, and the difference: [@{NUMBERS}]."
            for name, one in sheets.items():
                caption = f"{one.caption} {by}{'' if name == NUMBERS else there}".strip()
                sheets[name] = replace(one, caption=caption)
        pictures = (item.partition(": ") for item in items(blocks, "Figures"))
        title = next(iter(blocks))
        chapter = Chapter(
            study=self.name,
            machine=subject.name,
            contact="" if subject.is_paper else subject.contact_in_words,
            title=title,
            question=" ".join(blocks[title]),
            answer=" ".join(blocks.get("Answer", ())),
            numbers=items(blocks, "Numbers"),
            method=(*blocks["Method"], *([by] if by else ())),
            findings=(*items(blocks, "Findings"), *confirmed),
            pictures=tuple(Picture(stem, caption) for stem, _, caption in pictures if stem in found.figures),
            sheets=tuple(one for one in sheets.values() if len(one.rows) <= LONGEST),
            tiles=tuple(found.tiles),
            claims=tuple(found.claims),
            computed_by=by,
        )
        return chapter, sheets


def _write(path: Path, text: str) -> None:
    with whole_file(path) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")


def work_in_folder(work: Callable[[Path], None], out: Path) -> int:
    """Fill an output folder; what the user can mend is printed in a sentence. Returns the exit code."""

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
    jobs = [(drawing, chosen.out, name, (live or {}).get(name, ())) for name, drawing in drawings.items()]
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
