"""The report as one HTML page that needs nothing from elsewhere."""

import base64
from pathlib import Path

from jinja2 import Environment, PackageLoader, StrictUndefined

from studies.common.chapter import LARGEST_FILE
from studies.reporting.content import Report, ReportSection, verdict_class, verdict_column
from support_exudyn.files.whole_file import contents
from support_exudyn.postprocessing.page.pieces import SHORT, Cell, Sheet, unbroken


def page(report: Report) -> str:
    """The whole report with its style and its pictures in it."""
    return _templates().get_template("report.html.j2").render(report=report)


def _templates() -> Environment:
    surroundings = Environment(
        loader=PackageLoader("studies.reporting"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    surroundings.filters["unbroken"] = unbroken
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
