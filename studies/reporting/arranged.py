"""The report as a page that answers in a minute, and an appendix with all that is behind it.

Every figure and table stands once: on the page if it is a study's key figure or the beginning of its key table,
else in the appendix; tables that are long on the page stand in the appendix as a whole.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

from jinja2 import PackageLoader
from markupsafe import Markup, escape

from studies.common.words import REFERENCE, Chapter, JudgedClaim, Picture
from studies.reporting.content import ReportSection, around_chapters
from support_exudyn.postprocessing.page import live_html
from support_exudyn.postprocessing.page.pieces import (
    FileLink,
    Sheet,
    ShownFigure,
    ShownTable,
    image,
    templates,
)

PAGE, APPENDIX = "report.html", "appendix.html"
MACHINE = "machine"  # the figure with the clearance pin marked
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


def pages(
    out: Path,
    sections: Sequence[ReportSection],
    waited: Sequence[str] = (),
    others: Mapping[str, str] | None = None,
) -> dict[str, str]:
    """Both pages, by the name of their file.

    Arguments:
        out: the folder of both; links to other files are relative to it.
        sections: in the order in which they are to be read.
        waited: studies of the paper's answer that have not run yet.
        others: questions of further studies that have not run, by their names.

    Raises OSError if a picture cannot be read.
    """
    arranged = Arrangement(out, sections)
    words = {"around": around_chapters(sections), "waited": waited, "others": others or {}}
    made = templates(PackageLoader("studies.reporting"))
    found = {}
    for file in (PAGE, APPENDIX):
        made.filters["linked"] = partial(arranged.places.linked, file)
        made.filters["link"] = partial(arranged.places.link, file)
        scripts = Markup(arranged.live[file].scripts)
        of_page = made.get_template(f"{file}.j2")
        found[file] = of_page.render(words, arranged=arranged, table_of=ShownTable, scripts=scripts)
    return found


# --- places ---


@dataclass
class Places:
    """File and label, such as "Fig. 5", of figures and tables by "study/stem", numbered in reading order."""

    known: dict[str, tuple[str, str]] = field(default_factory=dict)
    last: dict[str, int] = field(default_factory=dict)

    def number(self, file: str, kind: str, names: Iterable[str]) -> None:
        """Give figures ("Fig.") or tables ("Table") their places; those that have one keep it."""
        for name in names:
            if name not in self.known:
                self.last[kind] = self.last.get(kind, 0) + 1
                self.known[name] = file, f"{kind} {self.last[kind]}"

    def link(self, file: str, name: str) -> Markup:
        """A link from a page to a figure or table; its bare name if the report has none such."""
        if name not in self.known:
            return escape(name.rpartition("/")[2])
        place, label = self.known[name]
        page = "" if place == file else place
        return Markup('<a href="{}#{}">{}</a>').format(page, anchor(name), label.replace(" ", "\u00a0"))

    def linked(self, file: str, text: str, study: str) -> Markup:
        """A sentence of a study on a page, with links in place of its references."""
        parts = REFERENCE.split(text)  # every second one is a reference
        return Markup().join(
            self.link(file, part if "/" in part else f"{study}/{part}") if n % 2 else part
            for n, part in enumerate(parts)
        )


def anchor(name: str) -> str:
    """The id of an element: "study-stem" of "study/stem"."""
    return name.replace("/", "-").replace(" ", "-")


# --- what stands where ---


class ShownStudy(NamedTuple):
    """A chapter on one of the pages, with its figures, tables and links there."""

    chapter: Chapter
    figures: tuple[ShownFigure, ...]
    tables: tuple[ShownTable, ...]
    links: tuple[FileLink, ...] = ()


class Arrangement:
    """All chapters of a report, arranged.

    Arguments:
        out: the folder of both pages.
        sections: in the order in which they are to be read.

    Raises OSError if a picture cannot be read.
    """

    def __init__(self, out: Path, sections: Sequence[ReportSection]) -> None:
        self.out, self.sections = out, sections
        self.by_name = {one.chapter.study: one for one in sections}
        chapters = [one.chapter for one in sections]
        self.leading = next(iter([one for one in chapters if one.tiles] + chapters), None)
        self.places = Places()
        self.first = list(self._first())
        self.places.number(PAGE, "Fig.", self.first)
        for one in chapters:
            self.places.number(PAGE, "Fig.", self._key_figure(one))
            self.places.number(PAGE, "Table", _names(one, one.sheets[:1]))
        for one in chapters:
            self.places.number(APPENDIX, "Fig.", _names(one, one.pictures))
            self.places.number(APPENDIX, "Table", _names(one, one.sheets))

    def _first(self) -> Iterator[str]:
        """Figures of the first screen: the machine, and the key figure of the leading study."""
        if self.leading is not None:
            names, machine = _names(self.leading, self.leading.pictures), f"{self.leading.study}/{MACHINE}"
            yield from (name for name in names if name == machine)
            yield from [name for name in names if name != machine][:1]

    def _key_figure(self, chapter: Chapter) -> list[str]:
        """The first figure of a study that is not on the first screen."""
        return [name for name in _names(chapter, chapter.pictures) if name not in self.first][:1]

    # --- the first screen ---

    def figure_on_top(self, machine: bool) -> ShownFigure | None:
        """The machine, or the key figure of the leading study."""
        found = [name for name in self.first if name.endswith(f"/{MACHINE}") == machine]
        return self._figure(PAGE, found[0]) if found else None

    @property
    def sentences(self) -> list[tuple[str, str]]:
        """The effect of clearance, from the leading study; how sure that is, from the claims; or others.

        Each with its study.
        """
        answers = {
            one.chapter.study: END_OF_SENTENCE.split(one.chapter.answer)
            for one in self.sections
            if one.chapter.answer
        }
        leading = self.leading.study if self.leading is not None else ""
        ahead = [(text, leading) for text in answers.get(leading, ())[: SENTENCES - 1]]
        others = [(texts[0], name) for name, texts in answers.items() if name != leading]
        others.sort(key=lambda one: not self.by_name[one[1]].chapter.claims)
        return (ahead + others)[:SENTENCES]

    @cached_property
    def claims(self) -> list[tuple[JudgedClaim, str]]:
        """All claims of the paper that were judged, with their study."""
        return [(claim, one.chapter.study) for one in self.sections for claim in one.chapter.claims]

    @property
    def counts(self) -> list[tuple[str, str, str, int]]:
        """Class, symbol and word of each kind of verdict, and how many claims have it."""
        kinds = [self.kind(claim) for claim, _ in self.claims]
        return [(*kind, kinds.count(kind)) for kind in VERDICTS.values() if kind in kinds]

    def kind(self, claim: JudgedClaim) -> tuple[str, str, str]:
        """Class, symbol and word of a claim's verdict."""
        beginnings = [start for start in VERDICTS if claim.verdict.lower().startswith(start)]
        return VERDICTS[max(beginnings, key=len)] if beginnings else ("", "", claim.verdict)

    # --- studies ---

    @property
    def studies(self) -> Iterator[ShownStudy]:
        """The studies on the page: their key figure, their key table, and links to the rest."""
        for one in self.sections:
            figures, tables = self._key_figure(one.chapter), _names(one.chapter, one.chapter.sheets[:1])
            yield self._study(PAGE, one, figures, tables, self._more(one))

    @property
    def rest(self) -> Iterator[ShownStudy]:
        """All studies in the appendix: figures and tables that the page has not, or has in part."""
        for one in self.sections:
            chapter, known = one.chapter, self.places.known
            figures = [name for name in _names(chapter, chapter.pictures) if known[name][0] == APPENDIX]
            tables = [
                name
                for name, sheet in zip(_names(chapter, chapter.sheets), chapter.sheets, strict=True)
                if known[name][0] == APPENDIX or len(sheet.rows) > MOST_ROWS
            ]
            yield self._study(APPENDIX, one, figures, tables)

    def _study(
        self,
        file: str,
        section: ReportSection,
        figures: Sequence[str],
        tables: Sequence[str],
        links: tuple[FileLink, ...] = (),
    ) -> ShownStudy:
        return ShownStudy(
            section.chapter,
            tuple(self._figure(file, name) for name in figures),
            tuple(self._table(file, section, name) for name in tables),
            links,
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
            f"{study}/{stem}": live for study, one in self.by_name.items() for stem, live in one.live.items()
        }
        known = self.places.known
        return {
            file: live_html.html({name: live for name, live in of_all.items() if known[name][0] == file})
            for file in (PAGE, APPENDIX)
        }

    def _figure(self, file: str, name: str) -> ShownFigure:
        study, _, stem = name.partition("/")
        section = self.by_name[study]
        picture = next(one for one in section.chapter.pictures if one.stem == stem)
        return ShownFigure(
            image=image(section.folder / f"{stem}.png"),
            caption=self.places.linked(file, picture.caption, study),
            live=Markup(self.live[file].places.get(name, "")),
            anchor=anchor(name),
            label=self.places.known[name][1] + ".",
            links=self._files(section.folder, stem, "csv", "pdf"),
        )

    def _table(self, file: str, section: ReportSection, name: str) -> ShownTable:
        """A table with links to its files; on the page no more than its first rows."""
        chapter = section.chapter
        sheet = chapter.sheets[_names(chapter, chapter.sheets).index(name)]

        def linked(text: str) -> Markup:
            return self.places.linked(file, text, chapter.study)

        caption, rows = linked(sheet.caption), sheet.rows
        if file == PAGE and len(rows) > MOST_ROWS:
            rows = rows[:MOST_ROWS]
            more = Markup(' <a href="{}#{}">All {} rows.</a>').format(APPENDIX, anchor(name), len(sheet.rows))
            caption += more
        cells = tuple(tuple(map(linked, row)) for row in rows)
        return ShownTable(
            sheet=replace(sheet, title=linked(sheet.title), rows=cells, caption=caption, name=""),
            anchor=anchor(name),
            label=self.places.known[name][1] + ".",
            links=self._files(section.folder, sheet.name, "csv"),
        )

    def _files(self, folder: Path, stem: str, *endings: str) -> tuple[FileLink, ...]:
        paths = [folder / f"{stem}.{ending}" for ending in endings]
        return tuple(FileLink(path.suffix[1:].upper(), self._href(path)) for path in paths if path.is_file())

    def _href(self, path: Path) -> str:
        return quote(Path(os.path.relpath(path, self.out)).as_posix())


def _names(chapter: Chapter, parts: Sequence[Picture | Sheet]) -> list[str]:
    """The parts as "study/stem" or "study/name"."""
    return [f"{chapter.study}/{one.stem if isinstance(one, Picture) else one.name}" for one in parts]
