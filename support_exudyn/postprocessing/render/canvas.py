"""A figure of matplotlib that counts in pixels: what is drawn once, and what changes from frame to frame."""

import math
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrow
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

from support_exudyn.postprocessing.render.stage import Picture

Point = tuple[float, float]
Box = tuple[int, int, int, int]  # left, top, right, bottom [pixels]
POINTS = 72  # pixels to an inch: sizes of letters and lines, in points, are pixels
SMALLEST_FONT = 6.0  # [pixels]
SHORTEST = 1.8  # length of an arrow that is drawn, of its shaft's thickness
HEAD = 0.42  # half width of an arrow's head, of its length
INK, FAINT, RULE = "#1a1a1a", "#6b6b6b", "#c9c9c9"


class Canvas:
    """A picture of a size [pixels]; places on it count to the right and down from its upper left corner."""

    def __init__(self, width: int, height: int) -> None:
        self._height = height
        # a hundredth of a pixel more: sizes are cut to whole pixels
        inches = (width + 0.01) / POINTS, (height + 0.01) / POINTS
        self._figure = Figure(inches, dpi=POINTS, facecolor="white")
        self._figure.set_layout_engine("none")
        self._canvas: Any = FigureCanvasAgg(self._figure)  # matplotlib has no types of it
        self.axes = self.axes_in((0, 0, width, height))
        self.axes.set(xlim=(0.0, width + 0.01), ylim=(height + 0.01, 0.0), zorder=1)
        self.axes.set_axis_off()
        self._moving: list[Artist] = []

    def axes_in(self, box: Box) -> Axes:
        """Axes of a diagram that fill a box."""
        left, top, right, bottom = box
        wide, high = self._figure.bbox.size
        place = left / wide, 1.0 - bottom / high, (right - left) / wide, (bottom - top) / high
        return self._figure.add_axes(place)

    def hold(self) -> None:
        """Keep what has been drawn; from now on each drawn thing is only of the next frame."""
        self._canvas.draw()
        self._still = self._canvas.copy_from_bbox(self._figure.bbox)
        self._moving.clear()

    def frame(self) -> Picture:
        """The picture; what has moved is gone from the next one."""
        self._canvas.restore_region(self._still)
        for artist in self._moving:
            artist.draw(self._canvas.get_renderer())
            artist.remove()
        self._moving.clear()
        return np.array(self._canvas.buffer_rgba())[:, :, :3]

    def paste(self, picture: Picture, place: tuple[int, int]) -> None:
        """Put a picture with its upper left corner at a place."""
        down = self._height - place[1] - len(picture)
        self._moving.append(self._figure.figimage(picture, place[0], down, origin="upper"))

    def write(
        self, place: Point, text: str, size: float, colour: str = INK, anchor: str = "left baseline", *,
        bold: bool = False, room: float = math.inf,
    ) -> Text:  # fmt: skip
        """Write a text of a size [pixels], smaller where it is wider than there is room [pixels].

        anchor: which point of the text is at the place, as matplotlib calls it: horizontal, then vertical.
        """
        ha, va = anchor.split()
        size, weight = max(SMALLEST_FONT, size), "bold" if bold else "normal"
        written = self.axes.text(*place, text, color=colour, size=size, ha=ha, va=va, weight=weight)
        if (wide := self.width(written)) > room:
            written.set_fontsize(max(SMALLEST_FONT, size * room / wide))
        self._moving.append(written)
        return written

    def width(self, written: Text) -> float:
        """The width of a text [pixels]."""
        return float(written.get_window_extent(self._canvas.get_renderer()).width)

    def line(self, x: Any, y: Any, colour: str, thick: float) -> None:
        """Draw a line through points; NaN breaks it."""
        self._moving += self.axes.plot(x, y, color=colour, lw=thick, solid_capstyle="butt", scalex=False,
                                       scaley=False)  # fmt: skip

    def disc(self, centre: Point, radius: float, colour: str, rim: float = 0.0) -> None:
        """Draw a disc, with a white rim of a thickness inside of its radius."""
        self.add(Circle(centre, radius - 0.5 * rim, fc=colour, ec="white", lw=rim))

    def arrow(self, tail: Point, tip: Point, colour: str, thick: float) -> None:
        """Draw an arrow with a white edge, which is seen on anything, unless it is hardly longer than thick."""
        way = np.subtract(tip, tail)
        length = math.hypot(*way)
        if length < SHORTEST * thick:
            return
        head = min(4.2 * thick, 0.7 * length)
        self.add(FancyArrow(
            *tail, *way, width=thick, head_length=head, head_width=2.0 * HEAD * head, color=colour, lw=0.0,
            length_includes_head=True, path_effects=[withStroke(linewidth=0.7 * thick, foreground="white")],
        ))  # fmt: skip

    def add(self, artist: Any) -> None:
        """Draw anything that matplotlib can, in pixels."""
        self._moving.append(self.axes.add_artist(artist))
