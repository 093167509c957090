"""What the report holds, before it is set as a page or as text."""

from __future__ import annotations

import platform
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from pydantic import BaseModel, ValidationError

from studies.common.chapter import LARGEST_FILE, Chapter, Picture, Sheet
from studies.reporting import assumptions
from support_exudyn.files.whole_file import contents
from support_exudyn.simulation.provenance import provenance
from user_forces.values.value import InputError

TITLE = "Clearance in the rear-link pin of a hydraulic support: the published results repeated"
SUMMARY = (
    'The paper "Dynamic Analysis of Hydraulic Support with Single Clearance" says what clearance in the '
    "rear-link pin of a hydraulic support does to its rise. Here its results are repeated with the free "
    "multibody program Exudyn. The paper prints no dimensions, masses, restitution or friction; those used "
    "here are assumed, and listed below. Directions, orderings and shapes can therefore be compared with the "
    "paper; values cannot. Every computed number comes with its numerical error, estimated from three runs "
    "with ever shorter steps."
)
QUICK = "This is a quick report: some or all studies were run with coarse steps, and their errors are larger."
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
class Section:
    """A chapter, the folder where its pictures are, and with what it was made in which time."""

    folder: Path
    chapter: Chapter
    wall_s: float
    versions: dict[str, str]

    @staticmethod
    def load(folder: Path) -> Section:
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
        return Section(folder, chapter, summary.wall_s, summary.versions)


@dataclass(frozen=True)
class Report:
    """All that is said, with figures and tables numbered throughout."""

    title: str
    made_at: str
    summary: tuple[str, ...]
    sections: tuple[Section, ...]
    notes: tuple[str, ...]  # on the assumptions
    assumptions: tuple[Sheet, ...]
    commands: tuple[tuple[str, str], ...]  # what each does
    times: Sheet
    versions: Sheet


def content(sections: Sequence[Section], quick: bool) -> Report:
    """The report on these chapters; quick: how those were run that do not say it."""
    figures, tables = _Numbers("Figure"), _Numbers("Table")
    numbered = tuple(_numbered(section, figures, tables) for section in sections)
    quicks = [quick if s.chapter.quick is None else s.chapter.quick for s in sections]
    return Report(
        title=TITLE,
        made_at=provenance()["made_at"].replace("T", " ").removesuffix("+00:00") + " UTC",
        summary=(SUMMARY, *_verdict_counts(sections), *([QUICK] if any(quicks) else [])),
        sections=numbered,
        notes=assumptions.NOTES,
        assumptions=tuple(tables.sheet(sheet) for sheet in assumptions.sheets()),
        commands=_commands(any(quicks)),
        times=tables.sheet(_times(sections, quicks)),
        versions=tables.sheet(_versions(sections)),
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


def _numbered(section: Section, figures: _Numbers, tables: _Numbers) -> Section:
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


def _verdict_counts(sections: Iterable[Section]) -> tuple[str, ...]:
    """How the claims come out, if the study of the claims is there."""
    claims = [s for section in sections if section.chapter.study == "claims" for s in section.chapter.sheets]
    cells = [row[column] for s in claims if (column := verdict_column(s)) is not None for row in s.rows]
    kinds = [verdict_class(cell) for cell in cells]
    words = {name: f'"{start}"' for start, name in VERDICTS.items()} | {"": "another"}
    counts = [f"{kinds.count(name)} {word}" for name, word in words.items() if name in kinds]
    return (f"Verdicts on {len(cells)} claims of the paper: {', '.join(counts)}.",) if counts else ()


# --- how to repeat ---


def _commands(quick: bool) -> tuple[tuple[str, str], ...]:
    option = " --quick" if quick else ""
    return (
        ("python -m pip install -e .", "install, from the project's folder"),
        (f"python -m studies{option}", "run all studies and write this report"),
        (f"python -m studies.NAME{option}", "run one study, by its name in the table below"),
        ("python -m studies.report", "write this report again from the results that are there"),
    )


def _times(sections: Sequence[Section], quicks: Sequence[bool]) -> Sheet:
    rows = [
        (s.chapter.study, "quick" if quick else "full", f"{s.wall_s:.1f}")
        for s, quick in zip(sections, quicks, strict=True)
    ]
    total = sum(section.wall_s for section in sections)
    return Sheet(
        title="Studies, how they were run, and how long they took",
        header=("study", "form", "wall time [s]"),
        rows=(*rows, ("together", "", f"{total:.1f}")),
        left=2,
    )


def _versions(sections: Sequence[Section]) -> Sheet:
    """Versions recorded by the studies; more than one where the studies were run with different ones."""
    found: dict[str, dict[str, None]] = {}
    for section in sections:
        for name, version in section.versions.items():
            found.setdefault(name, {})[version] = None
    return Sheet(
        title="Versions with which the numbers were made",
        header=("package", "version"),
        rows=tuple((name, ", ".join(versions)) for name, versions in found.items()),
        caption=f"Report written on {platform.platform()}.",
        left=2,
    )
