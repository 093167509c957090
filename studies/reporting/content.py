"""What the report holds: what studies left in their folders, and what is said around it."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import BaseModel, ValidationError

from studies.common.chapter import LARGEST_FILE, Chapter
from studies.common.words import TextTable, Words
from studies.reporting import assumptions
from support_exudyn import reference_support
from support_exudyn.files.whole_file import contents
from support_exudyn.postprocessing.page.live import LiveFigure
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import provenance
from user_forces.values.value import InputError


class Summary(BaseModel, strict=True):
    """What the report takes from a study's summary.json."""

    versions: dict[str, str]
    wall_s: float


@dataclass(frozen=True)
class ReportSection:
    """A chapter, the folder where its files are, its live figures, and with what it was made in which time."""

    folder: Path
    chapter: Chapter
    wall_s: float
    versions: dict[str, str]
    live: Mapping[str, LiveFigure]

    @staticmethod
    def load(folder: Path) -> ReportSection:
        """Read what a study left. Raises InputError that says what is wrong in which file."""
        chapter = Chapter.load(folder)
        path = folder / "summary.json"
        try:
            summary = Summary.model_validate_json(contents(path, LARGEST_FILE))
        except FileNotFoundError:
            raise InputError(f"{path}: no such file; the study that writes it has not ended here") from None
        except ValidationError as error:
            raise InputError(f"{path}: {error.errors()[0]['loc']}: {error.errors()[0]['msg']}") from None
        live = {}
        for picture in chapter.pictures:
            if not (folder / f"{picture.stem}.png").is_file():
                raise InputError(f"{folder / picture.stem}.png: no such file; the chapter beside it shows it")
            if (data := folder / f"{picture.stem}.live.json").is_file():
                live[picture.stem] = LiveFigure.load(data)
        return ReportSection(folder, chapter, summary.wall_s, summary.versions, live)


@dataclass(frozen=True)
class AroundChapters:
    """What the report says around its chapters.

    title, asked: of all. made_at: date and time. notes, data: on the assumptions. commands: what each does.
    """

    title: str
    asked: str
    made_at: str
    notes: tuple[str, ...]
    data: tuple[Sheet, ...]
    commands: tuple[tuple[str, str], ...]
    times: Sheet
    versions: Sheet


def around_chapters(sections: Sequence[ReportSection]) -> AroundChapters:
    """What is said around these chapters; the paper's machine is left out if none is about it."""
    support = reference_support()
    machines = tuple(dict.fromkeys(one.chapter.machine for one in sections if one.chapter.machine))
    contacts = tuple(dict.fromkeys(one.chapter.contact for one in sections if one.chapter.contact))
    of_paper = any(not one.chapter.machine for one in sections)
    words = Words("reporting").blocks({
        "machines": machines,
        "contacts": contacts,
        "of_paper": of_paper,
        "start_height": assumptions.millimetres(support.start_hinge_height),
        "total_mass": sum(part.mass for parts in support.parts.values() for part in parts),
        "platform": platform.platform(),
    })  # fmt: skip
    title = next(iter(words))

    def sheet(name: str, table: TextTable) -> Sheet:
        return table.sheet(name, *words[name])

    data = assumptions.tables(support) if of_paper else {}
    return AroundChapters(
        title=title,
        asked=" ".join(words[title]),
        made_at=provenance()["made_at"].replace("T", " ").removesuffix("+00:00") + " UTC",
        notes=tuple(words["Notes"]),
        data=tuple(sheet(name, table) for name, table in data.items()),
        commands=COMMANDS,
        times=sheet("times", _times(sections)),
        versions=sheet("versions", _versions(sections)),
    )


COMMANDS = (
    ("python -m pip install -e .", "install, from the project's folder"),
    ("python -m studies", "run the studies of the paper's answer and write this report"),
    ("python -m studies NAME", "run one study, by its name in the table below"),
    ("python -m studies --all", "run all studies"),
    ("python -m studies.report", "write this report again from the results that are there"),
)


def _times(sections: Sequence[ReportSection]) -> TextTable:
    rows = [(s.chapter.study, f"{s.wall_s:.1f}") for s in sections]
    total = sum(section.wall_s for section in sections)
    return TextTable(("study", "wall time [s]"), (*rows, ("together", f"{total:.1f}")))


def _versions(sections: Sequence[ReportSection]) -> TextTable:
    """Versions recorded by the studies; more than one where the studies were run with different ones."""
    found: dict[str, dict[str, None]] = {}
    for section in sections:
        for name, version in section.versions.items():
            found.setdefault(name, {})[version] = None
    rows = tuple((name, ", ".join(versions)) for name, versions in found.items())
    return TextTable(("package", "version"), rows, left=2)
