"""What every figure has to be: nothing cut off, no text upon another, a unit on every axis."""

from __future__ import annotations

import re
from itertools import combinations

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

EDGE = 1.0  # pixels that a letter may reach over the canvas: half of it is the rounding of its outline
SHARED = 1.0  # pixels that two texts may share, as wide as high, for the same reason
# quantities that have none: logarithms, ratios, names
UNIT = re.compile(r"\[[^\]]+\]|\bshare\b|\b(?:times|number|calls|factor|ratio|relative|coefficient)\b")


def texts(figure: Figure) -> list[tuple[str, Bbox]]:
    """All texts that are seen, with where they are in pixels, once the figure is laid out."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    unseen = {id(text) for axes in figure.axes for text in _unseen(axes)}
    return [
        (text.get_text(), text.get_window_extent(renderer))
        for text in figure.findobj(Text)
        if text.get_visible() and text.get_text().strip() and id(text) not in unseen
    ]


def _unseen(axes: Axes) -> list[Text]:
    """Labels of axes that are off, and of ticks beyond the limits: they are kept, but not drawn."""
    if not axes.axison:
        return [text for axis in (axes.xaxis, axes.yaxis) for text in axis.findobj(Text)]
    found: list[Text] = []
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        margin = 1e-9 * (high - low)
        context = [
            tick
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())
            if low - margin <= tick.get_loc() <= high + margin
        ]
        kept = {id(text) for tick in context for text in (tick.label1, tick.label2)}
        kept |= {id(axis.label), id(axis.offsetText)}
        found += [text for text in axis.findobj(Text) if id(text) not in kept]
    return found


def cut_off(figure: Figure) -> list[str]:
    """Texts that reach over the edge of the canvas."""
    width, height = figure.canvas.get_width_height()
    return [
        text
        for text, box in texts(figure)
        if box.x0 < -EDGE or box.y0 < -EDGE or box.x1 > width + EDGE or box.y1 > height + EDGE
    ]


def overlapping(figure: Figure) -> list[tuple[str, str]]:
    """Pairs of texts that lie upon another."""
    found = []
    for (one, first), (other, second) in combinations(texts(figure), 2):
        shared = Bbox.intersection(first, second)
        if shared is not None and shared.width > SHARED and shared.height > SHARED:
            found.append((one, other))
    return found


def without_unit(figure: Figure) -> list[str]:
    """Labels of axes that name no unit in brackets; axes that share the label of another have none."""
    labels = [label for axes in figure.axes if axes.axison for label in (axes.get_xlabel(), axes.get_ylabel())]
    return [label for label in labels if label and not UNIT.search(label)]


def words_below(figure: Figure) -> str:
    """The caption, in one line."""
    return " ".join(figure.get_supxlabel().split())


def check(figure: Figure) -> None:
    """Fail unless a figure is fit to be shown."""
    assert not cut_off(figure)
    assert not overlapping(figure)
    assert not without_unit(figure)
