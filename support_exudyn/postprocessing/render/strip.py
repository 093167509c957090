"""Force over time, with a cursor at the time of the frame."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from PIL import Image, ImageDraw

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL
from support_exudyn.postprocessing.render.ink import FAINT, INK, RULE, Sheet, width, write
from support_exudyn.postprocessing.render.layout import Box
from support_exudyn.postprocessing.render.pin_view import PinView
from support_exudyn.postprocessing.render.scales import round_up, said, usual

CUT = 1.25  # how far the axis goes beyond what is usual


class Strip:
    """Draws it.

    Arguments:
        box: of the axes [pixels].
        time: of the records [s].
        pin: whose force it is.
        start, end: of the frames [s].
        unit: by what lengths of a frame of 1280 x 720 are multiplied.
    """

    def __init__(self, box: Box, time: Series, pin: PinView, start: float, end: float, unit: float) -> None:
        self._box, self._unit, self._start = box, unit, start
        self._length = max(end - start, 1e-12)
        inside = (time >= start - 1e-12) & (time <= end + 1e-12)
        self._time, self._force = time[inside], pin.size[inside] / 1e3
        self._touching = None if pin.bore is None else pin.bore.touching[inside]
        peak = float(self._force.max(initial=0.0))
        self._top = min(CUT * usual(self._force), 1.08 * peak) if peak > 0.0 else 1.0
        self._peak = peak if peak > self._top else None

    def _x(self, time: Series) -> Series:
        left, _, right, _ = self._box
        x: Series = left + (time - self._start) / self._length * (right - left)
        return x

    def _y(self, force: Series) -> Series:
        _, top, _, bottom = self._box
        y: Series = bottom - np.minimum(force / self._top, 1.0) * (bottom - top)
        return y

    def draw(self, picture: Image.Image) -> None:
        """All but the cursor."""
        u = self._unit
        left, top, right, bottom = self._box
        pen = ImageDraw.Draw(picture)
        step = round_up(self._top / 4.5)
        for n in range(int(self._top / step + 1e-9) + 1):
            y = round(float(self._y(np.array(n * step))))
            pen.line((left, y, right, y), fill=RULE)
            write(picture, (left - 6 * u, y), said(n * step), 12 * u, FAINT, "rm")
        step = round_up(self._length / 10.5)
        first = int(np.ceil(self._start / step - 1e-9))
        for n in range(first, int((self._start + self._length) / step + 1e-9) + 1):
            x = round(float(self._x(np.array(n * step))))
            pen.line((x, bottom, x, bottom + round(4 * u)), fill=FAINT)
            text = f"{n * step:.6g}"
            half = 0.5 * width(text, 12 * u)
            x = int(min(max(x, left + 0.0), right - half))
            write(picture, (x, bottom + 7 * u), text, 12 * u, FAINT, "mt")
        name = "force [kN] over time [s]"
        write(picture, (left, top - 9 * u), name, 13 * u, INK)
        self._legend(picture, left + width(name, 13 * u) + 24 * u, top - 9 * u)
        if self._peak is not None:
            text = f"cut off at {self._top:.3g} kN, largest {self._peak:.4g} kN"
            write(picture, (right, top - 9 * u), text, 12 * u, FAINT, "rs")
        self._curve(picture)

    def _legend(self, picture: Image.Image, x: float, y: float) -> None:
        if self._touching is None:
            return
        u = self._unit
        for colour, word in ((CONTACT, "contact"), (FLIGHT, "free flight")):
            ImageDraw.Draw(picture).rectangle((x, y - 7 * u, x + 18 * u, y - 3 * u), fill=colour)
            write(picture, (x + 24 * u, y), word, 13 * u)
            x += 24 * u + width(word, 13 * u) + 20 * u

    def _curve(self, picture: Image.Image) -> None:
        left, top, right, bottom = self._box
        sheet = Sheet((left - 2, top - 2, right + 2, bottom + 3))
        x, y = self._x(self._time), self._y(self._force)
        touching = np.ones(x.size, dtype=bool) if self._touching is None else self._touching
        colour = IDEAL if self._touching is None else CONTACT
        pressed = touching[1:] | touching[:-1]  # from record to record; there is a force at one of them
        turns = [0, *(np.flatnonzero(np.diff(pressed.astype(int))) + 1).tolist(), pressed.size]
        for start, end in pairwise(turns):
            points = [(float(a), float(b)) for a, b in zip(x[start : end + 1], y[start : end + 1], strict=True)]
            if len(points) > 1:
                ink, width_ = (colour, 1.3) if pressed[start] else (FLIGHT, 3.0)
                sheet.line(points, ink, width_ * self._unit)
        sheet.onto(picture)

    def cursor(self, picture: Image.Image, record_time: float, force: float) -> None:
        """At a time [s], with a dot at the force [N]."""
        u = self._unit
        _, top, _, bottom = self._box
        x, y = float(self._x(np.array(record_time))), float(self._y(np.array(force / 1e3)))
        sheet = Sheet((x - 8 * u, top - 8 * u, x + 8 * u, bottom + 8 * u))
        sheet.line([(x, top), (x, bottom)], INK, 1.4 * u)
        sheet.disc((x, y), 4.5 * u, INK, "#ffffff", 1.2 * u)
        sheet.onto(picture)
