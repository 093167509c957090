"""Tables, figures and key numbers of a page as data, and the templates that set them."""

from __future__ import annotations

import base64
import hashlib
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from jinja2 import BaseLoader, ChoiceLoader, Environment, PackageLoader, StrictUndefined
from PIL import Image
from pydantic import ConfigDict
from rich.table import Table
from rich.text import Text

SHORT = 28  # characters of a cell that is kept in one line, unless the table is wide
HARD_SPACE = "\u00a0"
KEPT = 256  # pictures, for the next page
COLOURS = 64  # of a picture; drawings with thin lines and smooth edges keep their look
WIDEST = 1600  # pixels of a picture; a page shows it 800 wide
SCRIPT = re.compile(r"<script\b([^>]*)>(.*?)</script>", re.DOTALL)


@dataclass(frozen=True)
class Sheet:
    """A table of text cells.

    left: so many columns from the left are left-aligned, the others right-aligned.
    wide: long text cells that wrap; all columns are left-aligned. name: of its files, without ending.
    """

    __pydantic_config__ = ConfigDict(extra="forbid", strict=True)  # for reading

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""
    left: int = 1
    wide: bool = False
    name: str = ""

    def __post_init__(self) -> None:
        if not self.header:
            raise ValueError("header = (): allowed: at least one heading")
        for n, row in enumerate(self.rows):
            if len(row) != len(self.header):
                raise ValueError(f"row {n} has {len(row)} cells; allowed: {len(self.header)}, as the header")

    @property
    def left_columns(self) -> int:
        """How many columns are left-aligned."""
        return len(self.header) if self.wide else self.left

    def rich(self) -> Table:
        """For a terminal; nothing in the cells is taken for markup."""
        shown = Table(
            title=Text(self.title, style="table.title"),
            caption=Text(self.caption, style="table.caption") if self.caption else None,
            caption_justify="left",
        )
        for n, heading in enumerate(self.header):
            shown.add_column(Text(heading), justify="left" if n < self.left_columns else "right")
        for row in self.rows:
            shown.add_row(*(Text(cell) for cell in row))
        return shown


@dataclass(frozen=True)
class KeyNumber:
    """A number in large type: what it is, its value, what it was `before`, and a `note` such as the change."""

    name: str
    value: str
    before: str = ""
    note: str = ""


@dataclass(frozen=True)
class FileLink:
    """A link to a file, relative to the page."""

    text: str
    href: str


@dataclass(frozen=True)
class ShownTable:
    """A table on a page. anchor: its id. label: such as "Table 3"; empty: it has no number."""

    sheet: Sheet
    anchor: str = ""
    label: str = ""
    links: tuple[FileLink, ...] = ()


@dataclass(frozen=True)
class ShownFigure:
    """A figure on a page.

    image: a data URI, see `image`. live: the place of its live figure, as HTML; empty if it has none. anchor:
    its id. label: such as "Fig. 5"; empty: it has no number.
    """

    image: str
    caption: str
    live: str = ""
    anchor: str = ""
    label: str = ""
    links: tuple[FileLink, ...] = ()


def image(path: Path) -> str:
    """A PNG file as a data URI: made smaller if it is larger than a page can show, in a palette of colours.

    Raises OSError if it cannot be read.
    """
    there = path.stat()
    return _image(path, there.st_mtime_ns, there.st_size)


@lru_cache(maxsize=KEPT)  # a report is written anew after each study, and most of its figures are those before
def _image(path: Path, changed: int, size: int) -> str:
    """The data URI of a file as it was changed last [ns], of so many bytes."""
    with Image.open(path) as opened:
        picture = Image.alpha_composite(Image.new("RGBA", opened.size, "white"), opened.convert("RGBA"))
    picture = picture.convert("RGB")
    if picture.width > WIDEST:
        picture = picture.resize(
            (WIDEST, round(picture.height * WIDEST / picture.width)), Image.Resampling.LANCZOS
        )
    small = io.BytesIO()
    picture.quantize(COLOURS, dither=Image.Dither.NONE).save(small, "PNG")
    return "data:image/png;base64," + base64.b64encode(small.getvalue()).decode("ascii")


def unbroken(text: str) -> str:
    """Text with a value and its error, and a share and its sign, kept in one line."""
    return text.replace(" ± ", f"{HARD_SPACE}±{HARD_SPACE}").replace(" %", f"{HARD_SPACE}%")


def css(sheet: Sheet, column: int, text: str | None = None) -> str:
    """The classes of a cell of a table, or of a heading, which has no text."""
    kind = "text" if column < sheet.left_columns else "number"
    return kind if text is None else f"{kind} {'short' if len(text) <= SHORT else 'long'}"


def policy(scripts: Sequence[str]) -> str:
    """The content security policy of a page: nothing from outside, and no script but these.

    Arguments:
        scripts: texts with <script> elements, of those that the page holds.
    """
    found = [body for text in scripts for kind, body in SCRIPT.findall(text) if "json" not in kind]
    hashes = [base64.b64encode(hashlib.sha256(body.encode()).digest()).decode("ascii") for body in found]
    allowed = " ".join(f"'sha256-{one}'" for one in hashes) or "'none'"
    return f"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src {allowed}"


def templates(*loaders: BaseLoader) -> Environment:
    """Templates of pages: those of this folder (base.html.j2, macros.html.j2) and others.

    A template that extends base.html.j2 fills its blocks title, nav and main, and is given `scripts`: what live
    figures need, as HTML.
    """
    surroundings = Environment(
        loader=ChoiceLoader([*loaders, PackageLoader("support_exudyn.postprocessing.page", "")]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    surroundings.filters["unbroken"] = unbroken
    surroundings.globals.update(css=css, policy=policy)
    return surroundings
