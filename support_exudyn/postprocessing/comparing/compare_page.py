"""The page of a comparison: verdict, notes, tables, and curves to look into."""

from __future__ import annotations

import tempfile
from pathlib import Path

from markupsafe import Markup

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing import tables
from support_exudyn.postprocessing.comparing.compare_figure import MOST, compare_figure
from support_exudyn.postprocessing.comparing.files_compared import FilesCompared
from support_exudyn.postprocessing.comparing.notes import notes
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.live import of_drawing
from support_exudyn.postprocessing.page.live_html import html
from support_exudyn.postprocessing.page.pieces import Sheet, ShownFigure, ShownTable, image, templates
from user_forces.values.value import InputError

TEMPLATE = "compare.html.j2"
ENDING = ".html"


def check_page(path: Path) -> None:
    """Raise InputError for a page's file of a kind that is not written."""
    if path.suffix.lower() != ENDING:
        raise InputError(f"{path}: allowed: a file that ends in {ENDING}")


def write_page(compared: FilesCompared, path: Path) -> None:
    """Write the page, HTML that needs nothing from elsewhere, whole or not at all."""
    check_page(path)
    drawn = [FilesCompared(compared.reference, (pair,)) for pair in compared.pairs]
    figures = [compare_figure(one, len(one.pairs[0].channels)) for one in drawn]
    live = {f"curves{n}": of_drawing(figure, range(len(figure.axes))) for n, figure in enumerate(figures)}
    pages = html(live)
    files = [
        {
            "name": pair.other.name,
            "anchor": f"file{n}",
            "faults": [text for one in pair.channels.values() for text in tables.faults(one)],
            "sentences": [line[:1].upper() + line[1:].rstrip(".") for line in notes(pair)],
            "tables": [_shown(table) for table in tables.tables(pair, brief=False)],
            "curves": _curves(drawn[n], Markup(pages.places[f"curves{n}"])),
        }
        for n, pair in enumerate(compared.pairs)
    ]
    names = ", ".join(pair.other.name for pair in compared.pairs)
    page = {
        "title": f"{names} compared with {compared.reference.name}",
        "verdict": tables.VERDICTS[compared.verdict],
        "files": files,
    }
    text = templates().get_template(TEMPLATE).render(page=page, scripts=Markup(pages.scripts))
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _shown(table: tables.Table) -> ShownTable:
    left = next(n for n, head in enumerate(table.header) if head.startswith(">"))
    header = tuple(head.lstrip(">") for head in table.header)
    return ShownTable(Sheet(table.title, header, table.rows, table.note, left=left))


def _curves(compared: FilesCompared, live: Markup) -> ShownFigure:
    """The curves to look into, and as printed: of the first channels if they are many."""
    count = len(compared.pairs[0].channels)
    rest = f" Printed are the first {MOST} of {count} channels." if count > MOST else ""
    caption = (
        f"Curves, and below each the difference from {compared.reference.name}.{rest} Thinned so that no peak "
        "is lost."
    )
    with tempfile.TemporaryDirectory() as folder, style.look():
        path = Path(folder) / "drawing.png"
        compare_figure(compared, MOST).savefig(path)
        return ShownFigure(image(path), caption, live)
