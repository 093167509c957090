"""Clearance pins beside the machine in the viewer: journals in their bores, enlarged, and the force on them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from exudyn import graphics
from matplotlib.colors import to_rgb

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.figures.units import said_beside
from support_exudyn.postprocessing.render.pin_views import PinView, said, usual

RADIUS = 0.07  # of a bore, of the machine's length
APART = 3.2  # distance of bores, in radii
LONGEST = 1.5  # of an arrow, in radii: that of the usual force is as long as the radius
HEAD = 0.25  # of an arrow, of its length
CORNERS = 48  # of a circle
INK, JOURNAL = [0.1, 0.1, 0.1, 1.0], [0.45, 0.45, 0.48, 1.0]


class PinInsets:
    """The insets of clearance pins, in a row below the machine.

    Arguments:
        views: of the pins; those that are ideal have none.
        time: of the records (n,) [s].
        low, high: least and largest coordinates of the machine (3,) [m].
    """

    def __init__(self, views: Sequence[PinView], time: Series, low: Series, high: Series) -> None:
        self._views = [view for view in views if view.bore is not None]
        self._time = time
        self._usual = max((usual(view.size) for view in self._views), default=1.0)
        self._radius = RADIUS * float(high[0] - low[0])
        self._depth = float(low[2])  # one looks along z
        middle, y = 0.5 * float(low[0] + high[0]), float(low[1]) - 2.0 * self._radius
        step = APART * self._radius
        self._centres = [
            (middle + (n - 0.5 * (len(self._views) - 1)) * step, y) for n in range(len(self._views))
        ]

    @property
    def corners(self) -> Series:
        """What has to be seen of them, shape (n, 3) [m]."""
        reach = 1.8 * self._radius
        corners = [
            [x + side * reach, y + side * reach, self._depth] for x, y in self._centres for side in (-1.0, 1.0)
        ]
        return np.array(corners).reshape(-1, 3)

    def graphics(self, now: float) -> list[dict[str, Any]]:
        """What the engine draws of them at a time [s]: that of the record next to it."""
        record = int(np.abs(self._time - now).argmin())
        return [
            part
            for view, centre in zip(self._views, self._centres, strict=True)
            for part in self._of(view, np.array(centre), record)
        ]

    def _of(self, view: PinView, centre: Series, record: int) -> Iterator[dict[str, Any]]:
        assert view.bore is not None
        bearing = view.bore.pin.contact.bearing
        factor = view.bore.enlargement
        scale = factor * self._radius / bearing.bore_radius  # metres drawn to a metre of eccentricity
        at = centre + scale * view.bore.eccentricity[record]
        inside = self._radius - scale * bearing.clearance
        colour = (*to_rgb(CONTACT if view.bore.closed[record] else FLIGHT), 1.0)
        thin = 0.01 * inside  # the disc lies behind the lines
        yield graphics.Cylinder([*at, self._depth + thin], [0.0, 0.0, thin], inside, JOURNAL, nTiles=CORNERS)
        yield graphics.Circle([*centre, self._depth], self._radius, INK)
        yield graphics.Circle([*at, self._depth], inside, colour)
        size = float(view.size[record])
        if size > 0.0:
            way = min(size / self._usual, LONGEST) * self._radius * view.force[record] / size
            tip, aside = at + way, np.array([-way[1], way[0]])
            for start in (at, *(tip - HEAD * (way + side * aside) for side in (-0.5, 0.5))):
                yield graphics.Lines([[*start, self._depth], [*tip, self._depth]], colour)
        lines = (
            view.name.replace("_", " "),
            f"{said_beside(size, 'N', float(view.size.max(initial=0.0)))}, gap x {said(factor)}",
        )
        for n, words in enumerate(lines):
            x, y = centre + self._radius * np.array([1.0, -1.4 - 0.4 * n])  # x points to the left here
            yield graphics.Text([x, y, self._depth], words, INK)
