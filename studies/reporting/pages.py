"""The report as one HTML page that needs nothing from elsewhere, and as Markdown for a terminal."""

import base64
import os
import re
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined

from studies.common.chapter import LARGEST_FILE, Sheet
from studies.common.markdown import bullets, escaped, paragraph, unbroken
from studies.reporting.content import Report, ReportSection, verdict_class, verdict_column
from support_exudyn.files.whole_file import contents

SHORT = 28  # characters of a cell that is kept in one line, unless the table is wide


@dataclass(frozen=True)
class Cell:
    """A cell of a table and how it is shown."""

    text: str
    css: str


def page(report: Report) -> str:
    """The whole report with its style and its pictures in it."""
    return _templates(autoescape=True).get_template("report.html.j2").render(report=report)


def text(report: Report, out: Path) -> str:
    """The whole report as Markdown; pictures are links relative to the folder `out`."""

    def link(section: ReportSection, stem: str) -> str:
        return quote((Path(os.path.relpath(section.folder, out)) / f"{stem}.png").as_posix())

    written = _templates(autoescape=False).get_template("report.md.j2").render(report=report, link=link)
    return re.sub(r"\n{3,}", "\n\n", written).strip("\n") + "\n"


def _templates(autoescape: bool) -> Environment:
    surroundings = Environment(
        loader=PackageLoader("studies.reporting"),
        autoescape=autoescape,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    surroundings.filters.update(unbroken=unbroken, escaped=escaped, paragraph=paragraph, bullets=bullets)
    surroundings.globals.update(heading=heading, cells=cells, picture_data=picture_data)
    return surroundings


def heading(sheet: Sheet) -> list[Cell]:
    """The head of a table."""
    return [Cell(text, _alignment(sheet, n)) for n, text in enumerate(sheet.header)]


def cells(sheet: Sheet) -> list[list[Cell]]:
    """The rows of a table; verdicts have a class of their own."""
    verdicts = verdict_column(sheet)

    def css(column: int, text: str) -> str:
        verdict = verdict_class(text) if column == verdicts else ""
        length = "short" if len(text) <= SHORT else "long"
        return " ".join(filter(None, (_alignment(sheet, column), length, verdict and f"verdict {verdict}")))

    return [[Cell(text, css(column, text)) for column, text in enumerate(row)] for row in sheet.rows]


def _alignment(sheet: Sheet, column: int) -> str:
    return "text" if column < sheet.left_columns else "number"


def picture_data(section: ReportSection, stem: str) -> str:
    """A picture as a data URI, byte for byte."""
    path: Path = section.folder / f"{stem}.png"
    return "data:image/png;base64," + base64.b64encode(contents(path, LARGEST_FILE)).decode("ascii")
