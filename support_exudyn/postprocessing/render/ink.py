"""Text, lines and arrows with smooth edges, in pixels from the upper left corner."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import matplotlib as mpl
from PIL import Image, ImageDraw, ImageFont

Point = tuple[float, float]
FINER = 3  # what is drawn with smooth edges is drawn so many times larger, and shrunk
SMALLEST_FONT = 6  # [pixels]
SHORTEST = 1.8  # length of an arrow that is drawn, of its shaft's thickness
HEAD = 0.42  # half width of an arrow's head, of its length
INK = "#1a1a1a"
FAINT = "#6b6b6b"
RULE = "#c9c9c9"


@cache
def font(size: float, bold: bool = False) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, which comes with matplotlib; size: [pixels]."""
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    folder = Path(mpl.get_data_path()) / "fonts" / "ttf"
    return ImageFont.truetype(str(folder / name), max(SMALLEST_FONT, round(size)))


def width(text: str, size: float, bold: bool = False) -> float:
    """Of a text [pixels]."""
    return font(size, bold).getlength(text)


def fitting(text: str, room: float, size: float, bold: bool = False) -> float:
    """The font size, at most `size`, at which a text is no wider than there is room [pixels]."""
    while size > SMALLEST_FONT and width(text, size, bold) > room:
        size -= 0.5
    return size


def write(
    picture: Image.Image,
    place: Point,
    text: str,
    size: float,
    colour: str = INK,
    anchor: str = "ls",
    bold: bool = False,
) -> None:
    """A text; anchor: what of it is at the place, as Pillow has it ("ls": left end of the base line)."""
    ImageDraw.Draw(picture).text(place, text, fill=colour, font=font(size, bold), anchor=anchor)


class Sheet:
    """A part of a picture on which is drawn with smooth edges.

    Arguments:
        box: left, top, right, bottom in the picture [pixels].
    """

    def __init__(self, box: tuple[float, float, float, float]) -> None:
        left, top, right, bottom = (
            math.floor(box[0]),
            math.floor(box[1]),
            math.ceil(box[2]),
            math.ceil(box[3]),
        )
        self._corner = (left, top)
        size = (max(1, right - left) * FINER, max(1, bottom - top) * FINER)
        self._image = Image.new("RGBA", size, (255, 255, 255, 0))
        self._draw = ImageDraw.Draw(self._image)

    def _at(self, point: Point) -> Point:
        x, y = self._corner
        return FINER * (point[0] - x), FINER * (point[1] - y)

    def line(self, points: Sequence[Point], colour: str, thick: float) -> None:
        """Through points."""
        self._draw.line(
            [self._at(p) for p in points], fill=colour, width=max(1, round(FINER * thick)), joint="curve"
        )

    def polygon(self, points: Sequence[Point], colour: str) -> None:
        """A filled one."""
        self._draw.polygon([self._at(p) for p in points], fill=colour)

    def disc(
        self, centre: Point, radius: float, fill: str | None, rim: str | None = None, thick: float = 0.0
    ) -> None:
        """A circle, filled or with a rim inside of its radius."""
        x, y = self._at(centre)
        r = FINER * radius
        self._draw.ellipse(
            (x - r, y - r, x + r, y + r),
            fill=fill,
            outline=rim,
            width=max(1, round(FINER * thick)) if rim else 0,
        )

    def box(self, box: tuple[float, float, float, float], fill: str, radius: float = 0.0) -> None:
        """A filled rectangle."""
        first, last = self._at(box[:2]), self._at(box[2:])
        self._draw.rounded_rectangle((*first, *last), radius=FINER * radius, fill=fill)

    def dashes(self, centre: Point, radius: float, colour: str, thick: float) -> None:
        """A circle in dashes."""
        x, y = self._at(centre)
        r = FINER * radius
        for start in range(0, 360, 20):
            self._draw.arc(
                (x - r, y - r, x + r, y + r), start, start + 11, fill=colour, width=max(1, round(FINER * thick))
            )

    def arrow(self, tail: Point, tip: Point, colour: str, thick: float, cut: bool = False) -> None:
        """An arrow with a white edge, so that it is seen on anything; cut: its shaft is broken.

        One that is hardly longer than thick is not drawn.
        """
        length = math.dist(tail, tip)
        if length < SHORTEST * thick:
            return
        along = ((tip[0] - tail[0]) / length, (tip[1] - tail[1]) / length)
        across = (-along[1], along[0])
        head = min(4.2 * thick, 0.7 * length)

        def at(forward: float, aside: float) -> Point:
            return (
                tail[0] + forward * along[0] + aside * across[0],
                tail[1] + forward * along[1] + aside * across[1],
            )

        def outline(more: float) -> list[Point]:
            half, neck, wide = 0.5 * thick + more, length - head, HEAD * head + 1.6 * more
            return [
                *(at(-more, half), at(neck - more, half), at(neck - more, wide), at(length + 1.8 * more, 0.0)),
                *(at(neck - more, -wide), at(neck - more, -half), at(-more, -half)),
            ]

        self.polygon(outline(0.35 * thick), "#ffffff")
        self.polygon(outline(0.0), colour)
        if cut:
            middle = 0.5 * (length - head)
            for off in (-0.7 * thick, 0.7 * thick):
                self.line(
                    [at(middle + off - 0.5 * thick, -thick), at(middle + off + 0.5 * thick, thick)],
                    "#ffffff",
                    0.45 * thick,
                )

    def onto(self, picture: Image.Image) -> None:
        """Put it there."""
        shrunk = self._image.reduce(FINER)
        picture.paste(shrunk, self._corner, shrunk)
