"""The journal in its bore, with its clearance so much larger that it is seen."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from matplotlib.colors import to_hex
from PIL import Image

from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.look.solid import COLOURS, Role
from support_exudyn.postprocessing.render.ink import FAINT, Point, Sheet, write
from support_exudyn.postprocessing.render.layout import Box
from support_exudyn.postprocessing.render.pin_view import Bore
from support_exudyn.postprocessing.render.scales import round_up, said

SHOWN = 0.2  # clearance in the picture, of the bore's radius, at least
RING = 1.2  # radius of what is drawn about the bore, of the bore's
ROUNDING = 1e-6  # of the clearance
LONGEST = 1.6  # of an arrow, in radii of the bore
TRAIL = 0.25  # how long the trail of the journal's centre is, in seconds of the movie
HOUSING = to_hex(COLOURS[Role.BASE])
FLIGHT_TEXT = "#1c7fb5"  # sky blue is too light for letters
JOURNAL = to_hex(COLOURS[Role.PIN])


class Inset:
    """Draws it.

    Arguments:
        box: where, a square [pixels].
        bore: journal in its bore at the records.
        unit: by what lengths of a frame of 1280 x 720 are multiplied.
    """

    def __init__(self, box: Box, bore: Bore, unit: float) -> None:
        self._box, self._bore, self._unit = box, bore, unit
        bearing = bore.pin.contact.bearing
        self._radius = 0.5 * (box[2] - box[0] - 62 * unit) / RING
        self.factor = max(1.0, round_up(SHOWN * bearing.bore_radius / bearing.clearance))
        self._scale = self.factor * self._radius / bearing.bore_radius  # pixels to a metre of eccentricity
        self._gap = self._scale * bearing.clearance

    @property
    def title(self) -> str:
        """What is said of it."""
        return f"clearance \u00d7 {said(self.factor)}"

    @property
    def centre(self) -> Point:
        """Of the bore."""
        left, top, right, bottom = self._box
        return 0.5 * (left + right), 0.5 * (top + bottom) + 2 * self._unit

    def journal(self, record: int) -> Point:
        """The middle of the journal; forward is to the left, as in the picture of the machine."""
        x, y = self._scale * self._bore.eccentricity[record]
        return self.centre[0] - float(x), self.centre[1] - float(y)

    def draw(self, picture: Image.Image, record: int, first: int, force: Point, cut: bool) -> None:
        """At a record.

        Arguments:
            first: record at which the trail begins.
            force: arrow of the force on the journal, to the right and down [pixels].
            cut: whether it is longer than drawn.
        """
        u, centre, at = self._unit, self.centre, self.journal(record)
        sheet = Sheet(self._box)
        sheet.box(self._box, "#eef0f2", 6 * u)
        sheet.disc(centre, RING * self._radius, HOUSING)
        sheet.disc(centre, self._radius, "#ffffff")
        sheet.disc(at, self._radius - self._gap, JOURNAL)
        sheet.dashes(centre, self._gap, "#9a9a9a", 1.2 * u)
        self._trail(sheet, first, record)
        touching = bool(self._bore.touching[record])
        if touching:
            tail = self._touched(at)
            if tail != at:
                sheet.disc(tail, 6.0 * u, CONTACT, "#ffffff", 1.2 * u)
            shorter = min(1.0, LONGEST * self._radius / max(math.hypot(*force), 1e-9))
            tip = (tail[0] + shorter * force[0], tail[1] + shorter * force[1])
            sheet.arrow(tail, tip, CONTACT, 7.0 * u, cut or shorter < 1.0)
        sheet.disc(at, 4.0 * u, CONTACT if touching else FLIGHT, "#ffffff", 1.2 * u)
        sheet.onto(picture)
        left, top, right, _ = self._box
        write(picture, (left + 8 * u, top + 8 * u), self.title, 14 * u, anchor="lt", bold=True)
        if self._bore.can_tilt:
            write(picture, (right - 8 * u, top + 8 * u), "middle of the pin", 13 * u, FAINT, "rt")
        word = "contact" if touching else "free flight"
        write(
            picture,
            (right - 8 * u, self._box[3] - 8 * u),
            word,
            14 * u,
            CONTACT if touching else FLIGHT_TEXT,
            "rs",
            True,
        )
        carrier = "base" if self._bore.carrier == GROUND else self._bore.carrier.replace("_", " ")
        write(picture, (left + 8 * u, self._box[3] - 8 * u), f"bore in {carrier}", 13 * u, FAINT)

    def _touched(self, at: Point) -> Point:
        """Where on the wall it touches; its middle, if a tilted one does so elsewhere along the pin."""
        centre, away = self.centre, math.dist(at, self.centre)
        if away < (1.0 - ROUNDING) * self._gap:
            return at
        out = self._radius / away
        return centre[0] + out * (at[0] - centre[0]), centre[1] + out * (at[1] - centre[1])

    def _trail(self, sheet: Sheet, first: int, record: int) -> None:
        """Where the journal's centre has been."""
        if first >= record:
            return
        places = [self.journal(one) for one in range(first, record + 1)]
        touching = self._bore.touching[first : record + 1]
        turns = np.flatnonzero(np.diff(touching.astype(int))) + 1
        edges = [0, *turns.tolist(), len(places) - 1]
        for start, end in pairwise(edges):
            if end > start:
                colour = CONTACT if touching[start] else FLIGHT
                sheet.line(places[start : end + 1], colour, 1.8 * self._unit)
