"""The report as a page that answers in a minute, and an appendix with all that is behind it.

Every figure and table stands once: on the page if it is a study's key figure or the beginning of its key table,
else in the appendix; tables that are long on the page stand in the appendix as a whole.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from urllib.parse import quote

from jinja2 import PackageLoader
from markupsafe import Markup, escape

from studies.common.words import REFERENCE, JudgedClaim
from studies.reporting.content import ReportSection, around_chapters
from support_exudyn.postprocessing.page.live import html
from support_exudyn.postprocessing.page.pieces import FileLink, ShownFigure, ShownTable, image, templates

PAGE, APPENDIX = "report.html", "appendix.html"
MACHINE = "machine"  # the figure with the clearance pin marked
MOST_ROWS = 8  # of a table on the page
SENTENCES = 3  # on the first screen
VERDICTS = {  # class, symbol and word of a verdict
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
    waited: Sequence[str],
    others: Mapping[str, str],
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
    words = {"around": around_chapters(sections), "waited": waited, "others": others}
    surroundings = templates(PackageLoader("studies.reporting"))
    found = {}
    for file in (PAGE, APPENDIX):
        surroundings.filters["linked"] = partial(arranged.linked, file)
        surroundings.filters["link"] = partial(arranged.link, file)
        page = surroundings.get_template(f"{file}.j2")
        scripts = Markup(arranged.live[file].scripts)
        found[file] = page.render(words, arranged=arranged, table_of=ShownTable, scripts=scripts)
    return found


def anchor(name: str) -> str:
    """The id of an element: "study-stem" of "study/stem"."""
    return name.replace("/", "-").replace(" ", "-")


class Arrangement:
    """All chapters of a report, with the place of every figure and table, which are named "study/stem".

    places: file and label, such as "Fig. 5", of each, numbered in reading order. leading: the chapter with key
    numbers, or the first. top: figures of the first screen: the machine, and the leading chapter's key figure.

    Arguments:
        out: the folder of both pages.
        sections: in the order in which they are to be read.
    """

    def __init__(self, out: Path, sections: Sequence[ReportSection]) -> None:
        self.out, self.sections = out, sections
        self.by_name = {one.chapter.study: one for one in sections}
        chapters = [one.chapter for one in sections]
        figures = {one.study: [f"{one.study}/{picture.stem}" for picture in one.pictures] for one in chapters}
        tables = {one.study: [f"{one.study}/{sheet.name}" for sheet in one.sheets] for one in chapters}
        self.leading = next((one for one in chapters if one.tiles), chapters[0])
        ahead = figures[self.leading.study]
        self.top = {
            is_machine: next((name for name in ahead if name.endswith(f"/{MACHINE}") == is_machine), "")
            for is_machine in (True, False)
        }
        self.figures, self.places = figures, dict[str, tuple[str, str]]()
        self._number(PAGE, "Fig.", filter(None, self.top.values()))
        self.key_figure: dict[str, list[str]] = {}
        for study, names in figures.items():
            self.key_figure[study] = [name for name in names if name not in self.top.values()][:1]
            self._number(PAGE, "Fig.", self.key_figure[study])
            self._number(PAGE, "Table", tables[study][:1])
        for study in figures:
            self._number(APPENDIX, "Fig.", figures[study])
            self._number(APPENDIX, "Table", tables[study])
        of_all = {
            f"{study}/{stem}": live for study, one in self.by_name.items() for stem, live in one.live.items()
        }
        self.live = {
            file: html({name: live for name, live in of_all.items() if self.places[name][0] == file})
            for file in (PAGE, APPENDIX)
        }

    def _number(self, file: str, kind: str, names: Iterable[str]) -> None:
        """Give figures ("Fig.") or tables ("Table") their places; those that have one keep it."""
        for name in names:
            last = sum(label.startswith(kind) for _, label in self.places.values())
            self.places.setdefault(name, (file, f"{kind} {last + 1}"))

    def link(self, file: str, name: str) -> Markup:
        """A link from a page to a figure or table; its bare name if the report has none such."""
        if name not in self.places:
            return escape(name.rpartition("/")[2])
        place, label = self.places[name]
        page = "" if place == file else place
        return Markup('<a href="{}#{}">{}</a>').format(page, anchor(name), label.replace(" ", "\u00a0"))

    def linked(self, file: str, text: str, study: str) -> Markup:
        """A sentence of a study on a page, with links in place of its references."""
        parts = REFERENCE.split(text)  # every second one is a reference
        return Markup().join(
            self.link(file, part if "/" in part else f"{study}/{part}") if n % 2 else part
            for n, part in enumerate(parts)
        )

    @property
    def sentences(self) -> list[tuple[str, str]]:
        """The first screen: the effect of clearance, from the leading study; how sure that is, from the claims.

        Or others; each with its study.
        """
        answers = {
            study: END_OF_SENTENCE.split(one.chapter.answer)
            for study, one in self.by_name.items()
            if one.chapter.answer
        }
        leading = self.leading.study
        ahead = [(text, leading) for text in answers.get(leading, ())[: SENTENCES - 1]]
        others = [(texts[0], name) for name, texts in answers.items() if name != leading]
        others.sort(key=lambda one: not self.by_name[one[1]].chapter.claims)
        return (ahead + others)[:SENTENCES]

    @property
    def claims(self) -> list[tuple[JudgedClaim, str, tuple[str, str, str]]]:
        """All claims of the paper that were judged, with study, and class, symbol, word of the verdict."""
        return [
            (claim, study, VERDICTS[claim.verdict])
            for study, one in self.by_name.items()
            for claim in one.chapter.claims
        ]

    @property
    def counts(self) -> list[tuple[str, str, str, int]]:
        """Class, symbol and word of each kind of verdict, and how many claims have it."""
        kinds = [kind for _, _, kind in self.claims]
        return [(*kind, kinds.count(kind)) for kind in VERDICTS.values() if kind in kinds]

    def shown_figures(self, file: str, study: str) -> list[ShownFigure]:
        """The key figure of a study, on the page, or all others that are not there."""
        rest = [name for name in self.figures[study] if self.places[name][0] == file]
        return [self.figure(file, name) for name in (self.key_figure[study] if file == PAGE else rest)]

    def figure(self, file: str, name: str) -> ShownFigure:
        """A figure on a page. Raises OSError if its picture cannot be read."""
        study, _, stem = name.partition("/")
        section = self.by_name[study]
        caption = next(one.caption for one in section.chapter.pictures if one.stem == stem)
        return ShownFigure(
            image=image(section.folder / f"{stem}.png"),
            caption=self.linked(file, caption, study),
            live=Markup(self.live[file].places.get(name, "")),
            anchor=anchor(name),
            label=self.places[name][1] + ".",
            links=self._files(section.folder, stem, "csv", "pdf"),
        )

    def shown_tables(self, file: str, study: str) -> list[ShownTable]:
        """The first rows of a study's key table, on the page, or all that are not whole there."""
        section, shown = self.by_name[study], list[ShownTable]()
        for sheet in section.chapter.sheets:
            name = f"{study}/{sheet.name}"
            place, label = self.places[name]
            cut = place == PAGE and len(sheet.rows) > MOST_ROWS
            if place != file and not cut:
                continue
            caption, rows = self.linked(file, sheet.caption, study), sheet.rows
            if file == PAGE and cut:
                rows = rows[:MOST_ROWS]
                more = Markup(' <a href="{}#{}">All {} rows.</a>')
                caption += more.format(APPENDIX, anchor(name), len(sheet.rows))
            cells = tuple(tuple(self.linked(file, cell, study) for cell in row) for row in rows)
            title, files = self.linked(file, sheet.title, study), self._files(section.folder, sheet.name, "csv")
            whole = replace(sheet, title=title, rows=cells, caption=caption, name="")
            shown.append(ShownTable(whole, anchor(name), f"{label}.", files))
        return shown

    def more(self, study: str) -> list[FileLink]:
        """Links to the rest of a study, and to its runs."""
        runs = self.by_name[study].folder / "runs"
        count = len(list(runs.glob("*.h5")))
        links = [FileLink("method, findings, all figures and tables", f"{APPENDIX}#{study}")]
        return links + ([FileLink(f"{count} runs (HDF5)", self._href(runs) + "/")] if count else [])

    def _files(self, folder: Path, stem: str, *endings: str) -> tuple[FileLink, ...]:
        paths = [folder / f"{stem}.{ending}" for ending in endings]
        return tuple(FileLink(path.suffix[1:].upper(), self._href(path)) for path in paths if path.is_file())

    def _href(self, path: Path) -> str:
        return quote(Path(os.path.relpath(path, self.out)).as_posix())
