"""What stands next to and below the machine on a frame: the journal in its bore, and force over time."""

import math

import numpy as np
from matplotlib.colors import to_hex
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL, draw_pieces, pieces
from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.postprocessing.look.solid import COLOURS, Role
from support_exudyn.postprocessing.render.pin_views import STEPS, Bore, PinView, said, usual
from support_exudyn.postprocessing.render.sheet import FAINT, INK, RULE, SMALLEST_FONT, Box, Canvas, Point

RING = 1.2  # radius of what is drawn about the bore, of the bore's
ROUNDING = 1e-6  # of the clearance
LONGEST = 1.6  # of an arrow, in radii of the bore
TRAIL = 0.25  # how long the trail of the journal's centre is, in seconds of the movie
HOUSING, JOURNAL = to_hex(COLOURS[Role.BASE]), to_hex(COLOURS[Role.PIN])
FLIGHT_TEXT = "#1c7fb5"  # sky blue is too light for letters
CUT = 1.25  # how far the axis of forces goes beyond what is usual


class Inset:
    """The journal in its bore, with its clearance so much larger that it is seen.

    Arguments:
        box: where, a square [pixels].
        bore: journal in its bore at the records.
        unit: by what lengths of a frame of 1280 x 720 are multiplied.
        name: of the pin, where there are several insets; these are small, and say less.
    """

    def __init__(self, box: Box, bore: Bore, unit: float, name: str = "") -> None:
        self._box, self._bore, self._unit, self._name = box, bore, unit, name.replace("_", " ")
        bearing = bore.pin.contact.bearing
        left, top, right, bottom = box
        self.centre: Point = (0.5 * (left + right), 0.5 * (top + bottom) + 2 * unit)  # of the bore
        self._radius = 0.5 * (right - left - 62 * unit) / RING
        self.title = f"{self._name or 'clearance'} \u00d7 {said(bore.enlargement)}"
        self._scale = bore.enlargement * self._radius / bearing.bore_radius  # pixels to a metre of eccentricity
        self._gap = self._scale * bearing.clearance

    def draw_still(self, sheet: Canvas) -> None:
        """Draw what does not change: the bore, and the words on it."""
        u, (left, top, right, bottom) = self._unit, self._box
        sheet.box(self._box, "#eef0f2", 6 * u)
        sheet.disc(self.centre, RING * self._radius, HOUSING)
        sheet.disc(self.centre, self._radius, "#ffffff")
        place, room = (left + 8 * u, top + 8 * u), right - left - 16 * u
        sheet.write(place, self.title, 14 * u, anchor="left top", bold=True, room=room)
        if self._name:
            return
        if self._bore.can_tilt:
            sheet.write((right - 8 * u, top + 8 * u), "middle of the pin", 13 * u, FAINT, "right top")
        carrier = "base" if self._bore.carrier == GROUND else self._bore.carrier.replace("_", " ")
        sheet.write((left + 8 * u, bottom - 8 * u), f"bore in {carrier}", 13 * u, FAINT)

    def draw(self, sheet: Canvas, record: int, first: int, force: Point) -> None:
        """Draw the journal at a record.

        Arguments:
            first: record at which the trail begins.
            force: arrow of the force on the journal, to the right and down [pixels].
        """
        u, bore = self._unit, self._bore
        x, y = self._scale * bore.eccentricity[first : record + 1].T
        x, y = self.centre[0] + x, self.centre[1] - y
        at = float(x[-1]), float(y[-1])
        sheet.disc(at, self._radius - self._gap, JOURNAL)
        sheet.circle(self.centre, self._gap, "#9a9a9a", 1.2 * u)
        before = bore.closed[first:record]
        for chosen, colour in ((~before, FLIGHT), (before, CONTACT)):
            if chosen.any():
                sheet.line(*pieces(x, y, chosen), colour, 2.0 * u)
        closed = bool(bore.closed[record])
        colour, word, ink = (CONTACT, "contact", CONTACT) if closed else (FLIGHT, "free flight", FLIGHT_TEXT)
        if closed:
            tail, shorter = at, min(1.0, LONGEST * self._radius / max(math.hypot(*force), 1e-9))
            if (away := math.dist(at, self.centre)) >= (1.0 - ROUNDING) * self._gap:  # on the wall, not tilted
                out, (x0, y0) = self._radius / away, self.centre
                tail = x0 + out * (at[0] - x0), y0 + out * (at[1] - y0)
                sheet.disc(tail, 6.0 * u, CONTACT, 1.2 * u)
            sheet.arrow(tail, (tail[0] + shorter * force[0], tail[1] + shorter * force[1]), CONTACT, 7.0 * u)
        sheet.disc(at, 4.0 * u, colour, 1.2 * u)
        place = self._box[2] - 8 * u, self._box[3] - 8 * u
        sheet.write(place, word, 14 * u, ink, "right baseline", bold=True)


class Strip:
    """Force over time, with a cursor at the time of the frame.

    Arguments:
        box: of the axes [pixels].
        time: of the records [s].
        pin: whose force it is.
        start, end: of the frames [s].
        unit: by what lengths of a frame of 1280 x 720 are multiplied.
    """

    def __init__(self, box: Box, time: Series, pin: PinView, start: float, end: float, unit: float) -> None:
        self._box, self._unit = box, unit
        self._start, self._length = start, max(end - start, 1e-12)
        inside = (time >= start - 1e-12) & (time <= end + 1e-12)
        self._shown = readable("N", float(pin.size[inside].max(initial=0.0)))
        self._time, self._force = time[inside], self._shown.scale * pin.size[inside]
        self._closed = None if pin.bore is None else pin.bore.closed[inside]
        self._peak = float(self._force.max(initial=0.0))
        self._top = min(CUT * usual(self._force), 1.08 * self._peak) if self._peak > 0.0 else 1.0

    def draw_still(self, sheet: Canvas) -> None:
        """Draw all but the cursor."""
        u, (left, top, right, _) = self._unit, self._box
        axes = sheet.axes_in(self._box)
        axes.set(xlim=(self._start, self._start + self._length), ylim=(0.0, self._top))
        axes.xaxis.set_major_locator(MaxNLocator(10, steps=STEPS))
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=STEPS))
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:.6g}")
        axes.yaxis.set_major_formatter(lambda y, _: said(y))
        axes.spines[:].set_visible(False)
        small = max(SMALLEST_FONT, 12 * u)
        axes.tick_params(labelsize=small, labelcolor=FAINT, color=FAINT, pad=4 * u, width=u)
        axes.tick_params("y", length=0.0)
        axes.grid(axis="y", color=RULE, lw=max(1.0, u))
        axes.set_axisbelow(True)
        name = sheet.write((left, top - 9 * u), f"force [{self._shown.name}] over time [s]", 13 * u)
        if self._peak > self._top:  # without the peak, which records miss: the page of the run has it
            text = f"cut off at {self._top:.3g} {self._shown.name}"
            sheet.write((right, top - 9 * u), text, 12 * u, FAINT, "right baseline")
        force = np.minimum(self._force, self._top)
        if self._closed is None:
            axes.plot(self._time, force, color=IDEAL, lw=1.3 * u)
            return
        axes.legend(
            handles=[Patch(fc=CONTACT, label="contact"), Patch(fc=FLIGHT, label="free flight")],
            loc="center left", bbox_to_anchor=(left + sheet.width(name) + 12 * u, top - 13 * u), ncols=2,
            bbox_transform=sheet.axes.transData, frameon=False, fontsize=small, handlelength=1.4,
            handleheight=0.3, handletextpad=0.5, columnspacing=1.5, labelcolor=INK,
        )  # fmt: skip
        pressed = self._closed[1:] | self._closed[:-1]  # there is a force at one of both records
        widths = (3.0 * u, 1.3 * u)
        draw_pieces(axes, self._time, force, pressed, widths, solid_capstyle="butt", clip_on=False)

    def cursor(self, sheet: Canvas, time: float, force: float) -> None:
        """Draw the cursor at a time [s], with a dot at the force [N]."""
        u, (left, top, right, bottom) = self._unit, self._box
        x = left + (time - self._start) / self._length * (right - left)
        y = bottom - min(self._shown.scale * force / self._top, 1.0) * (bottom - top)
        sheet.line(np.array([x, x]), np.array([top, bottom]), INK, 1.4 * u)
        sheet.disc((x, y), 4.5 * u, INK, 1.2 * u)
