"""What stands where: the first screen, a screen for each study, and the rest in the appendix."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from urllib.parse import quote

from markupsafe import Markup

from studies.common.chapter import JudgedClaim, Picture
from studies.reporting.content import ReportSection
from studies.reporting.places import APPENDIX, PAGE, Places, anchor
from support_exudyn.postprocessing.page import live_html
from support_exudyn.postprocessing.page.pieces import (
    FileLink,
    KeyNumber,
    Sheet,
    ShownFigure,
    ShownTable,
    image,
)

MACHINE = "machine"  # the figure with the loose pin marked
MOST_ROWS = 8  # of a table on the page
SENTENCES = 3  # on the first screen
VERDICTS = {  # class, symbol and word of a verdict by its beginning
    "holds": ("holds", "✓", "holds"),
    "in part": ("partly", "◐", "holds in part"),
    "fails": ("unsupported", "✗", "fails"),
    "needs more machines": ("few", "+", "needs more"),
    "not measurable": ("open", "?", "not measurable"),
}
END_OF_SENTENCE = re.compile(r"(?<=[.!?])\s+(?=[A-Z])")


@dataclass(frozen=True)
class ShownClaim:
    """A claim with its verdict as class, symbol and word, and what shows it."""

    claim: JudgedClaim
    why: Markup
    css: str
    symbol: str
    word: str
    shown_in: tuple[Markup, ...]


@dataclass(frozen=True)
class ShownStudy:
    """A study on one of the pages: its texts with links, its figures and tables there."""

    name: str
    title: str
    question: str
    answer: Markup
    numbers: tuple[Markup, ...]
    method: tuple[Markup, ...]
    findings: tuple[Markup, ...]
    figures: tuple[ShownFigure, ...]
    tables: tuple[ShownTable, ...]
    links: tuple[FileLink, ...]


class Arrangement:
    """All chapters of a report, arranged.

    Arguments:
        out: the folder of both pages.
        sections: in the order in which they are to be read.
        beside: studies that stand in the appendix alone.

    Raises OSError if a picture cannot be read.
    """

    def __init__(self, out: Path, sections: Sequence[ReportSection], beside: Collection[str] = ()) -> None:
        self.out = out
        self.sections = sections
        self.on_page = [one for one in sections if one.chapter.study not in beside]
        with_tiles = [one for one in self.on_page if one.chapter.tiles]
        self.leading = next(iter(with_tiles + self.on_page), None)
        self.places = Places()
        self.first = [name for name in self._first() if name]
        self.places.number(PAGE, "Fig.", self.first)
        for one in self.on_page:
            self.places.number(PAGE, "Fig.", self._key_figure(one))
            self.places.number(PAGE, "Table", _names(one, one.chapter.sheets[:1]))
        for one in sections:
            self.places.number(APPENDIX, "Fig.", _names(one, one.chapter.pictures))
            self.places.number(APPENDIX, "Table", _names(one, one.chapter.sheets))

    def _first(self) -> Iterator[str]:
        """Figures of the first screen: the machine, and the key one of the leading study."""
        if self.leading is not None:
            names = list(_names(self.leading, self.leading.chapter.pictures))
            machine = f"{self.leading.chapter.study}/{MACHINE}"
            yield from (name for name in names if name == machine)
            yield from [name for name in names if name != machine][:1]

    def _key_figure(self, section: ReportSection) -> list[str]:
        """The first figure of a study that is not on the first screen."""
        return [name for name in _names(section, section.chapter.pictures) if name not in self.first][:1]

    # --- the first screen ---

    def figure_on_top(self, machine: bool) -> ShownFigure | None:
        """The machine, or the key figure of the leading study."""
        found = [name for name in self.first if name.endswith(f"/{MACHINE}") == machine]
        return self._figures(PAGE, found)[0] if found else None

    @property
    def tiles(self) -> list[KeyNumber]:
        """The numbers of the first screen."""
        tiles = self.leading.chapter.tiles if self.leading is not None else ()
        return [KeyNumber(one.name, one.with_clearance, one.ideal, one.change) for one in tiles]

    @property
    def computed_by(self) -> str:
        """Engine and method of the leading study."""
        return self.leading.chapter.computed_by if self.leading is not None else ""

    @property
    def sentences(self) -> list[Markup]:
        """What clearance does, from the leading study; how sure that is, from the claims; else from others."""
        chapters = [one.chapter for one in self.on_page]
        told = [(one.study, END_OF_SENTENCE.split(one.answer)) for one in chapters if one.answer]
        leading = self.leading.chapter.study if self.leading is not None else ""
        ahead = [(name, text) for name, texts in told if name == leading for text in texts[: SENTENCES - 1]]
        judged = [
            (one.study, END_OF_SENTENCE.split(one.answer)[0]) for one in chapters if one.claims and one.answer
        ]
        others = [(name, texts[0]) for name, texts in told if name != leading]
        chosen = list(dict.fromkeys(ahead + judged + others))[:SENTENCES]
        return [self.places.linked(PAGE, name, text) for name, text in chosen]

    @property
    def claims(self) -> list[ShownClaim]:
        """All claims of the paper that were judged."""
        return [self._claim(one.chapter.study, claim) for one in self.on_page for claim in one.chapter.claims]

    @property
    def counts(self) -> list[tuple[str, str, str, int]]:
        """Class, symbol and word of each kind of verdict, and how many claims have it."""
        kinds = [one.css for one in self.claims]
        return [(*kind, kinds.count(kind[0])) for kind in VERDICTS.values() if kind[0] in kinds]

    def _claim(self, study: str, claim: JudgedClaim) -> ShownClaim:
        beginnings = [start for start in VERDICTS if claim.verdict.lower().startswith(start)]
        css, symbol, word = VERDICTS[max(beginnings, key=len)] if beginnings else ("", "", claim.verdict)
        shown_in = tuple(
            self.places.link(PAGE, name) for name in (claim.figure, claim.table) if name in self.places.known
        )
        return ShownClaim(claim, self.places.linked(PAGE, study, claim.why), css, symbol, word, shown_in)

    # --- studies ---

    @cached_property
    def studies(self) -> list[ShownStudy]:
        """The studies on the page: their key figure and key table."""
        return [
            replace(
                self._study(PAGE, one, self._key_figure(one), _names(one, one.chapter.sheets[:1])),
                links=self._more(one),
            )
            for one in self.on_page
        ]

    @cached_property
    def rest(self) -> list[ShownStudy]:
        """All studies in the appendix: what the page does not show, and tables that it shows in part."""
        return [self._study(APPENDIX, one, self._left(one), self._long(one)) for one in self.sections]

    def _left(self, section: ReportSection) -> list[str]:
        names = _names(section, section.chapter.pictures)
        return [name for name in names if self.places.known[name].file == APPENDIX]

    def _long(self, section: ReportSection) -> list[str]:
        sheets = section.chapter.sheets
        names = zip(_names(section, sheets), sheets, strict=True)
        known = self.places.known
        return [n for n, sheet in names if known[n].file == APPENDIX or len(sheet.rows) > MOST_ROWS]

    def _study(
        self, file: str, section: ReportSection, figures: Sequence[str], tables: Sequence[str]
    ) -> ShownStudy:
        chapter = section.chapter

        def linked(texts: Sequence[str]) -> tuple[Markup, ...]:
            return tuple(self.places.linked(file, chapter.study, text) for text in texts)

        return ShownStudy(
            name=chapter.study,
            title=chapter.title,
            question=chapter.question,
            answer=linked((chapter.answer,))[0],
            numbers=linked(chapter.numbers),
            method=linked(chapter.method),
            findings=linked(chapter.findings),
            figures=tuple(self._figures(file, figures)),
            tables=tuple(self._table(file, section, name) for name in tables),
            links=(),
        )

    def _more(self, section: ReportSection) -> tuple[FileLink, ...]:
        """Links to the rest of a study, and to its runs."""
        more = FileLink("method, findings, all figures and tables", f"{APPENDIX}#{section.chapter.study}")
        runs = section.folder / "runs"
        count = len(list(runs.glob("*.h5"))) if runs.is_dir() else 0
        return (more, FileLink(f"{count} runs (HDF5)", self._href(runs) + "/")) if count else (more,)

    # --- figures and tables ---

    @cached_property
    def live(self) -> dict[str, live_html.LiveHtml]:
        """Live figures of both pages, by the page's file."""
        of_all = {
            f"{one.chapter.study}/{stem}": figure for one in self.sections for stem, figure in one.live.items()
        }
        return {
            file: live_html.html(
                {name: of for name, of in of_all.items() if self.places.known[name].file == file}
            )
            for file in (PAGE, APPENDIX)
        }

    def _figures(self, file: str, names: Sequence[str]) -> list[ShownFigure]:
        found = []
        by_name = {one.chapter.study: one for one in self.sections}
        for name in names:
            study, _, stem = name.partition("/")
            section = by_name[study]
            picture = next(one for one in section.chapter.pictures if one.stem == stem)
            found.append(self._figure(file, section, picture))
        return found

    def _figure(self, file: str, section: ReportSection, picture: Picture) -> ShownFigure:
        name = f"{section.chapter.study}/{picture.stem}"
        return ShownFigure(
            image=image(section.folder / f"{picture.stem}.png"),
            caption=self.places.linked(file, section.chapter.study, picture.caption),
            live=Markup(self.live[file].places.get(name, "")),
            anchor=anchor(name),
            label=self.places.known[name].label + ".",
            links=self._files(section.folder, picture.stem, "csv", "pdf"),
        )

    def _table(self, file: str, section: ReportSection, name: str) -> ShownTable:
        """A table with links to its files; on the page no more than its first rows."""
        study = section.chapter.study
        n = list(_names(section, section.chapter.sheets)).index(name)
        sheet = section.chapter.sheets[n]

        def linked(text: str) -> Markup:
            return self.places.linked(file, study, text)

        caption = linked(sheet.caption)
        rows = sheet.rows
        if file == PAGE and len(rows) > MOST_ROWS:
            rows = rows[:MOST_ROWS]
            more = Markup(' <a href="{}#{}">All {} rows.</a>').format(APPENDIX, anchor(name), len(sheet.rows))
            caption += more
        return ShownTable(
            sheet=Sheet(
                title=linked(sheet.title),
                header=sheet.header,
                rows=tuple(tuple(linked(cell) for cell in row) for row in rows),
                caption=caption,
                left=sheet.left,
                wide=sheet.wide,
            ),
            anchor=anchor(name),
            label=self.places.known[name].label + ".",
            links=self._files(section.folder, sheet.name, "csv") if sheet.name else (),
        )

    def _files(self, folder: Path, stem: str, *endings: str) -> tuple[FileLink, ...]:
        paths = [folder / f"{stem}.{ending}" for ending in endings]
        return tuple(FileLink(path.suffix[1:].upper(), self._href(path)) for path in paths if path.is_file())

    def _href(self, path: Path) -> str:
        return quote(Path(os.path.relpath(path, self.out)).as_posix())


def _names(section: ReportSection, parts: Sequence[Picture | Sheet]) -> list[str]:
    """The parts as "study/stem" or "study/name"; a table without a name is called by its place."""
    stems = [
        one.stem if isinstance(one, Picture) else one.name or f"table-{n}" for n, one in enumerate(parts, 1)
    ]
    return [f"{section.chapter.study}/{stem}" for stem in stems]
