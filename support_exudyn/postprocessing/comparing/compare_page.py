"""The page of a comparison: verdict, notes, tables, and curves to look into."""

from __future__ import annotations

import tempfile
from pathlib import Path

from markupsafe import Markup

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.comparing import tables
from support_exudyn.postprocessing.comparing.compare_figure import CAPTION, MOST, compare_figure
from support_exudyn.postprocessing.comparing.files_compared import FilesCompared
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.live import of_drawing
from support_exudyn.postprocessing.page.live_html import html
from support_exudyn.postprocessing.page.pieces import ShownFigure, ShownTable, image, templates
from user_forces.values.value import InputError

TEMPLATE = "compare.html.j2"
ENDING = ".html"


def check_page(path: Path) -> None:
    """Raise InputError for a page's file of a kind that is not written."""
    if path.suffix.lower() != ENDING:
        raise InputError(f"{path}: allowed: a file that ends in {ENDING}")


def write_page(compared: FilesCompared, path: Path) -> None:
    """Write the page, HTML that needs nothing from elsewhere, whole or not at all.

    Its live figures have all channels, and the printed ones of more than `MOST` channels the first.
    """
    check_page(path)
    drawn = [FilesCompared(compared.reference, (pair,)) for pair in compared.pairs]
    figures = [compare_figure(one, len(one.pairs[0].channels)) for one in drawn]
    pages = html(
        {f"curves{n}": of_drawing(figure, range(len(figure.axes))) for n, figure in enumerate(figures)}
    )
    files = []
    with tempfile.TemporaryDirectory() as folder, style.look():
        for n, pair in enumerate(compared.pairs):
            printed = Path(folder) / f"{n}.png"
            compare_figure(drawn[n], MOST).savefig(printed)
            files.append({
                "name": pair.other.name,
                "anchor": f"file{n}",
                "faults": [text for one in pair.channels.values() for text in tables.faults(one)],
                "sentences": [line[:1].upper() + line[1:].rstrip(".") for line in tables.notes(pair)],
                "tables": [ShownTable(tables.table(pair))],
                "curves": ShownFigure(image(printed), CAPTION, Markup(pages.places[f"curves{n}"])),
            })  # fmt: skip
    names = ", ".join(pair.other.name for pair in compared.pairs)
    page = {
        "title": f"{names} compared with {compared.reference.name}",
        "verdict": tables.VERDICTS[compared.verdict],
        "files": files,
    }
    text = templates().get_template(TEMPLATE).render(page=page, scripts=Markup(pages.scripts))
    with whole_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
