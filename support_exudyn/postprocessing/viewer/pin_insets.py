"""Clearance pins next to the machine in the viewer: journals in their bores, enlarged, and their forces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from exudyn import graphics
from matplotlib.colors import to_rgb

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.figures.units import said_beside
from support_exudyn.postprocessing.render.pin_views import PinView, format_round, usual

RADIUS = 0.07  # of a bore, of the machine's length
APART = 3.2  # distance of bores, in radii
REACH = 1.8  # of an inset around its middle, in radii
LONGEST = 1.5  # of an arrow, in radii: that of the usual force is as long as the radius
HEAD = 0.25  # of an arrow, of its length
CORNERS = 48  # of a circle
INK, JOURNAL = [0.1, 0.1, 0.1, 1.0], [0.45, 0.45, 0.48, 1.0]


class PinInsets:
    """The insets of clearance pins, in a row below the machine.

    Arguments:
        views: of the pins; ideal pins have no inset.
        time: of the records (n,) [s].
        low, high: least and largest coordinates of the machine (3,) [m].
    """

    def __init__(self, views: Sequence[PinView], time: Series, low: Series, high: Series) -> None:
        self._views = [view for view in views if view.bore is not None]
        self._time = time
        self._usual = max((usual(view.size) for view in self._views), default=1.0)
        self._radius = RADIUS * float(high[0] - low[0])
        self._depth = float(low[2])  # the view is along z
        places = APART * self._radius * (np.arange(len(self._views)) - 0.5 * (len(self._views) - 1))
        x, y = 0.5 * float(low[0] + high[0]) + places, float(low[1]) - 2.0 * self._radius
        self._centres = np.column_stack([x, np.full_like(x, y)])

    @property
    def corners(self) -> Series:
        """The corners of all insets, shape (n, 3) [m]."""
        reach = REACH * self._radius
        corners = np.concatenate([self._centres - reach, self._centres + reach])
        return np.column_stack([corners, np.full(len(corners), self._depth)])

    def graphics(self, now: float) -> list[dict[str, Any]]:
        """The engine's graphics data of the insets at a time [s]: of the record next to it."""
        record = int(np.abs(self._time - now).argmin())
        pairs = zip(self._views, self._centres, strict=True)
        return [part for view, centre in pairs for part in self._of(view, centre, record)]

    def _of(self, view: PinView, centre: Series, record: int) -> Iterator[dict[str, Any]]:
        assert view.bore is not None
        aside, inner = view.bore.enlarged(record, self._radius)
        at, colour = centre + aside, (*to_rgb(CONTACT if view.bore.closed[record] else FLIGHT), 1.0)
        thin = 0.01 * inner  # the disc lies behind the lines
        yield graphics.Cylinder([*at, self._depth + thin], [0.0, 0.0, thin], inner, JOURNAL, nTiles=CORNERS)
        yield graphics.Circle([*centre, self._depth], self._radius, INK)
        yield graphics.Circle([*at, self._depth], inner, colour)
        size = float(view.size[record])
        if size > 0.0:
            way = min(size / self._usual, LONGEST) * self._radius * view.force[record] / size
            tip, across = at + way, np.array([-way[1], way[0]])
            for start in (at, *(tip - HEAD * (way + side * across) for side in (-0.5, 0.5))):
                yield graphics.Lines([[*start, self._depth], [*tip, self._depth]], colour)
        force = said_beside(size, "N", float(view.size.max(initial=0.0)))
        lines = view.name.replace("_", " "), f"{force}, gap x {format_round(view.bore.enlargement)}"
        for n, words in enumerate(lines):
            x, y = centre + self._radius * np.array([1.0, -1.4 - 0.4 * n])  # x points to the left here
            yield graphics.Text([x, y, self._depth], words, INK)
