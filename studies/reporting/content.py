"""What the report holds, before it is set as a page or as text."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from pydantic import BaseModel, ValidationError

from studies.common.chapter import LARGEST_FILE, Chapter, Picture
from studies.common.words import TextTable, Words
from studies.reporting import assumptions
from support_exudyn import reference_support
from support_exudyn.files.whole_file import contents
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.simulation.provenance import provenance
from user_forces.values.value import InputError

VERDICT = "verdict"  # the heading of the column that is coloured
VERDICTS = {  # class of a verdict by its beginning
    "holds": "holds",
    "holds only": "partly",
    "not supported": "unsupported",
    "cannot be judged": "open",
}


class Summary(BaseModel, strict=True):
    """What the report takes from a study's summary.json."""

    versions: dict[str, str]
    wall_s: float


@dataclass(frozen=True)
class ReportSection:
    """A chapter, the folder where its pictures are, and with what it was made in which time."""

    folder: Path
    chapter: Chapter
    wall_s: float
    versions: dict[str, str]

    @staticmethod
    def load(folder: Path) -> ReportSection:
        """Read chapter.json and summary.json. Raises InputError that says what is wrong in which file."""
        chapter = Chapter.load(folder)
        path = folder / "summary.json"
        try:
            summary = Summary.model_validate_json(contents(path, LARGEST_FILE))
        except FileNotFoundError:
            raise InputError(f"{path}: no such file; the study that writes it has not ended here") from None
        except ValidationError as error:
            raise InputError(f"{path}: {error.errors()[0]['loc']}: {error.errors()[0]['msg']}") from None
        for picture in chapter.pictures:
            if not (folder / f"{picture.stem}.png").is_file():
                raise InputError(f"{folder / picture.stem}.png: no such file; the chapter beside it shows it")
        return ReportSection(folder, chapter, summary.wall_s, summary.versions)


@dataclass(frozen=True)
class Report:
    """All that is said, with figures and tables numbered throughout."""

    title: str
    made_at: str
    summary: tuple[str, ...]
    sections: tuple[ReportSection, ...]
    notes: tuple[str, ...]  # on the assumptions
    assumptions: tuple[Sheet, ...]
    commands: tuple[tuple[str, str], ...]  # what each does
    times: Sheet
    versions: Sheet


def content(sections: Sequence[ReportSection]) -> Report:
    """The report on these chapters."""
    figures, tables = _Numbers("Figure"), _Numbers("Table")
    numbered = tuple(_numbered(section, figures, tables) for section in sections)
    support = reference_support()
    data = assumptions.tables(support)
    claims, counts = _verdict_counts(sections)
    words = Words("reporting").blocks({
        "claims": claims,
        "counts": counts,
        "start_height": assumptions.millimetres(support.start_hinge_height),
        "total_mass": sum(part.mass for parts in support.parts.values() for part in parts),
        "platform": platform.platform(),
    })  # fmt: skip
    title = next(iter(words))

    def sheet(name: str, table: TextTable) -> Sheet:
        return tables.sheet(table.sheet(name, *words[name]))

    return Report(
        title=title,
        made_at=provenance()["made_at"].replace("T", " ").removesuffix("+00:00") + " UTC",
        summary=tuple(words[title]),
        sections=numbered,
        notes=tuple(words["Notes"]),
        assumptions=tuple(sheet(name, table) for name, table in data.items()),
        commands=COMMANDS,
        times=sheet("times", _times(sections)),
        versions=sheet("versions", _versions(sections)),
    )


class _Numbers:
    """Counts figures or tables."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.last = 0

    def __call__(self, text: str) -> str:
        self.last += 1
        return f"{self.kind} {self.last}. {text}"

    def sheet(self, sheet: Sheet) -> Sheet:
        return replace(sheet, title=self(sheet.title))

    def picture(self, picture: Picture) -> Picture:
        return replace(picture, caption=self(picture.caption))


def _numbered(section: ReportSection, figures: _Numbers, tables: _Numbers) -> ReportSection:
    chapter = section.chapter
    pictures = tuple(figures.picture(picture) for picture in chapter.pictures)
    sheets = tuple(tables.sheet(sheet) for sheet in chapter.sheets)
    return replace(section, chapter=replace(chapter, pictures=pictures, sheets=sheets))


# --- verdicts ---


def verdict_class(text: str) -> str:
    """Class of a verdict by its beginning; empty if it is none of them."""
    beginnings = [start for start in VERDICTS if text.lower().startswith(start)]
    return VERDICTS[max(beginnings, key=len)] if beginnings else ""


def verdict_column(sheet: Sheet) -> int | None:
    """Which column holds verdicts."""
    return next((n for n, heading in enumerate(sheet.header) if heading.lower() == VERDICT), None)


def _verdict_counts(sections: Iterable[ReportSection]) -> tuple[int, list[str]]:
    """Of how many claims there are verdicts, and how many of each kind, if the study of the claims is there."""
    claims = [s for section in sections if section.chapter.study == "claims" for s in section.chapter.sheets]
    cells = [row[column] for s in claims if (column := verdict_column(s)) is not None for row in s.rows]
    kinds = [verdict_class(cell) for cell in cells]
    words = {name: f'"{start}"' for start, name in VERDICTS.items()} | {"": "another"}
    return len(cells), [f"{kinds.count(name)} {word}" for name, word in words.items() if name in kinds]


# --- how to repeat ---


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
