"""One look for all figures."""

import io
import textwrap
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import get_font_names

from support_exudyn.files.whole_file import whole_file
from support_exudyn.mechanics.trajectory import Series

# Okabe and Ito's colours: which differ for colour-blind readers; the lightness differs too, for grey prints.
IDEAL = "#000000"
WITH_CLEARANCE = "#0072B2"
SMOOTH = "#E69F00"
THIRD = "#009E73"
# of a single run: what a journal does, and the force on it
CONTACT = "#D55E00"
FLIGHT = "#56B4E9"
STATES = ((FLIGHT, "free flight"), (CONTACT, "contact"))
# what the paper prints, as crosses
PAPER = "#882255"

Dashes = str | tuple[int, tuple[float, ...]]
# curves of a panel: colours that differ for all readers, dashes for grey prints
CURVES: tuple[tuple[str, Dashes], ...] = (
    (WITH_CLEARANCE, "-"),
    (SMOOTH, (0, (6, 1.5))),
    (THIRD, (0, (3, 1, 1, 1))),
    (IDEAL, (0, (1, 1))),
    (PAPER, (0, (8, 1, 1, 1, 1, 1))),
)
# fonts with Chinese letters, as far as they are installed, for names that have some
CHINESE = (
    "Noto Sans CJK SC",
    "Source Han Sans SC",
    "Microsoft YaHei",
    "PingFang SC",
    "SimHei",
    "WenQuanYi Zen Hei",
)
EASTERN = tuple(name for name in CHINESE if name in get_font_names())
SCREEN_DPI = 110  # of figures in notebooks
CAPTION = 7  # size of the letters of a caption [points]
TITLE = 95  # letters of a line of a title
LETTER_MM = 1.3  # width of one of them, of a line that has many wide ones
STYLE: dict[Any, Any] = {
    "font.family": ["sans-serif", *EASTERN],
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.titlelocation": "left",
    "figure.titlesize": 10,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
    "savefig.dpi": 200,
    "axes.formatter.useoffset": False,
    "pdf.fonttype": 42,
}


def look() -> AbstractContextManager[None]:
    """Put the common style into force for all drawing and saving inside the with block."""
    return mpl.rc_context(STYLE)


def size(width_mm: float, height_mm: float) -> tuple[float, float]:
    """Size of a figure in the inches that matplotlib wants."""
    return width_mm / 25.4, height_mm / 25.4


class NotebookFigure(Figure):
    """A figure that notebooks show without pyplot."""

    def _repr_png_(self) -> bytes:
        """The figure as PNG."""
        with look(), io.BytesIO() as image:
            self.savefig(image, format="png", dpi=SCREEN_DPI)
            return image.getvalue()


def begin(width_mm: float, height_mm: float, title: str) -> Figure:
    """An empty figure of a size with a title on its left."""
    # laid out also where the figure is drawn outside of `look`
    drawing = NotebookFigure(figsize=size(width_mm, height_mm), layout="constrained")
    drawing.suptitle(title, x=0.01, ha="left")
    return drawing


def named(drawing: Figure, name: str) -> Figure:
    """A figure with the name of what it shows before its title."""
    drawing.suptitle("\n".join(textwrap.wrap(f"{name}: {drawing.get_suptitle()}", TITLE)), x=0.01, ha="left")
    return drawing


def caption(drawing: Figure, text: str) -> None:
    """Write a text below all panels, in lines as long as the figure is wide."""
    width_mm = 25.4 * float(drawing.get_figwidth())
    lines = textwrap.fill(text, int((width_mm - 6.0) / LETTER_MM))
    drawing.supxlabel(lines, fontsize=CAPTION, x=0.01, ha="left", linespacing=1.3)


def save(drawing: Figure, out: Path, name: str, *, pdf: bool = True) -> list[Path]:
    """Write a figure as PNG, and as PDF for print."""
    paths = [out / f"{name}.png"] + ([out / f"{name}.pdf"] if pdf else [])
    for path in paths:
        with whole_file(path) as temporary:
            drawing.savefig(temporary, format=path.suffix[1:])
        drawing.set_layout_engine("none")  # it is laid out now; once more would take as long as drawing it
    return paths


def draw_pieces(
    axes: Axes, x: Series, y: Series, contact: npt.NDArray[np.bool_], widths: tuple[float, float], **more: Any
) -> None:
    """Draw a line (n,) in the colours of flight and contact, by which of its n - 1 pieces are contact.

    widths: of flight and of contact [points]. more: for `Axes.plot`.
    """
    for chosen, (colour, name), width in zip((~contact, contact), STATES, widths, strict=True):
        if chosen.any():
            axes.plot(*pieces(x, y, chosen), color=colour, lw=width, label=name, **more)


def pieces(x: Series, y: Series, chosen: npt.NDArray[np.bool_]) -> tuple[Series, Series]:
    """One line of the chosen pieces (n - 1,) of a path (n,), broken by NaN where others lie between."""
    drawn = np.zeros(x.size, dtype=bool)
    drawn[:-1] |= chosen
    drawn[1:] |= chosen
    # where two chosen pieces are separated by one that is not, both of its ends are drawn: a gap goes in
    # between
    gaps = np.flatnonzero(~chosen & drawn[:-1] & drawn[1:]) + 1
    broken_x, broken_y = (np.insert(np.where(drawn, values, np.nan), gaps, np.nan) for values in (x, y))
    return broken_x, broken_y
