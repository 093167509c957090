"""What stands beside and below the machine on a frame: the journal in its bore, and force over time."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from matplotlib.colors import to_hex
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL, draw_pieces, pieces
from support_exudyn.postprocessing.figures.units import readable
from support_exudyn.postprocessing.look.poses import Poses, placed_pins
from support_exudyn.postprocessing.look.solid import COLOURS, Role
from support_exudyn.postprocessing.render.sheet import FAINT, INK, RULE, SMALLEST_FONT, Box, Canvas, Point
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

WHY = "pictures show it"


@dataclass(frozen=True)
class Bore:
    """A journal in its bore, at the records.

    Arguments:
        pin: of the scenario.
        eccentricity: of the journal's centre from the bore's, forward and up, shape (n, 2) [m]; in space
            that of the middle of the bearing.
        touching: whether it is in contact, shape (n,).
        carrier: name of the body that has the bore.
        can_tilt: whether the journal may make contact with an edge while its middle is away from the wall.
    """

    pin: ClearancePin
    eccentricity: Series
    closed: npt.NDArray[np.bool_]
    carrier: str
    can_tilt: bool = False


@dataclass(frozen=True)
class PinView:
    """A pin at the records.

    Arguments:
        name: of the pin, as the channels know it.
        on: of what the force is said to be on.
        force: forward and up, shape (n, 2) [N].
        path: where the pin is, shape (n, 3) [m].
        bore: None if the pin is ideal.
    """

    name: str
    on: str
    force: Series
    path: Series
    bore: Bore | None

    @property
    def size(self) -> Series:
        """Magnitude of the force, as far as it is in the plane (n,) [N]."""
        size: Series = np.hypot(self.force[:, 0], self.force[:, 1])
        return size


def pin_names(result: Result) -> list[str]:
    """All pins, by what channels call them; those with clearance first."""
    known = sorted(placed_pins(result.scenario), key=lambda pin: pin.with_clearance is None)
    return [pin.name for pin in known]


def pin_view(result: Result, name: str | None = None) -> PinView | None:
    """A pin by its name; None: the first with clearance, or the first of all, or nothing if the machine has no
    pins.

    Raises InputError if there is no such pin, or if a channel that this needs was not recorded.
    """
    names = pin_names(result)
    if name is None and not names:
        return None
    if name is not None and name not in names:
        raise InputError(f"pin = {short(name)}: no such pin; allowed: {', '.join(names) or 'none'}")
    name = name or names[0]
    pin = next(pin for pin in placed_pins(result.scenario) if pin.name == name)
    sign = -1.0 if pin.bore_is_second else 1.0
    force = sign * np.column_stack([result.recorded(f"pin.{name}.force_{axis}", WHY) for axis in "xy"])
    path = Poses(result).of(pin.bore.body).path(pin.bore.point)
    if pin.with_clearance is None:
        return PinView(name, pin.second.body.replace("_", " "), force, path, None)
    bore = Bore(
        pin.with_clearance,
        _eccentricity(result, name),
        np.hypot(*force.T) > 0.0,
        pin.bore.body,
        result.scenario.dimensions == 3,
    )
    return PinView(name, "journal", force, path, bore)


def pin_views(result: Result, name: str | None = None) -> list[PinView]:
    """A pin as `pin_view` gives it, then all other clearance pins whose force and journal were recorded."""
    first = pin_view(result, name)
    if first is None:
        return []
    others = [pin.name for pin in placed_pins(result.scenario) if pin.with_clearance is not None]
    return [
        first,
        *(pin_view(result, one) or first for one in others if one != first.name and _seen(result, one)),
    ]


def _seen(result: Result, name: str) -> bool:
    try:
        return pin_view(result, name) is not None
    except InputError:  # not recorded
        return False


def _eccentricity(result: Result, name: str) -> Series:
    sides = ("left_", "right_") if result.scenario.dimensions == 3 else ("",)
    ends = [
        np.column_stack([result.recorded(f"pin.{name}.{side}eccentricity_{axis}", WHY) for axis in "xy"])
        for side in sides
    ]
    middle: Series = np.mean(ends, axis=0)
    return middle


# --- panels ---

SHOWN = 0.2  # clearance in the picture, of the bore's radius, at least
RING = 1.2  # radius of what is drawn about the bore, of the bore's
ROUNDING = 1e-6  # of the clearance
LONGEST = 1.6  # of an arrow, in radii of the bore
TRAIL = 0.25  # how long the trail of the journal's centre is, in seconds of the movie
HOUSING, JOURNAL = to_hex(COLOURS[Role.BASE]), to_hex(COLOURS[Role.PIN])
FLIGHT_TEXT = "#1c7fb5"  # sky blue is too light for letters
CUT = 1.25  # how far the axis of forces goes beyond what is usual
STEPS = (1.0, 2.0, 5.0, 10.0)
MOST = 0.97  # share of forces that arrows and axes are made for; what is beyond is cut


# --- round numbers for scales ---


def round_up(number: float) -> float:
    """The next of ..., 1, 2, 5, 10, ...; 1 for what is not above 0."""
    if not number > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(number))
    return next(step * power for step in STEPS if step * power >= number * (1.0 - 1e-9))


def round_down(number: float) -> float:
    """The last of ..., 1, 2, 5, 10, ... that is not above it; 1 for what is not above 0."""
    return 1.0 / round_up(1.0 / number) if number > 0.0 else 1.0


def usual(sizes: Series) -> float:
    """A size that nearly all, without those that are 0, do not exceed; 1 if there are none."""
    there = sizes[sizes > 0.0]
    return float(np.quantile(there, MOST)) if there.size else 1.0


def said(number: float) -> str:
    """A round number as it is written."""
    return f"{number:,.0f}".replace(",", " ") if number >= 1.0 else f"{number:g}"


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
        self.factor = max(1.0, round_up(SHOWN * bearing.bore_radius / bearing.clearance))
        self._scale = self.factor * self._radius / bearing.bore_radius  # pixels to a metre of eccentricity
        self._gap = self._scale * bearing.clearance

    @property
    def title(self) -> str:
        """The words for how much the clearance is enlarged."""
        return f"{self._name or 'clearance'} \u00d7 {said(self.factor)}"

    def draw_still(self, sheet: Canvas) -> None:
        """Draw what does not change: the bore, and what is said of it."""
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

    def draw(self, sheet: Canvas, record: int, first: int, force: Point, cut: bool) -> None:
        """Draw the journal at a record.

        Arguments:
            first: record at which the trail begins.
            force: arrow of the force on the journal, to the right and down [pixels].
            cut: whether it is longer than drawn.
        """
        u = self._unit
        x, y = self._places(slice(first, record + 1))
        at = float(x[-1]), float(y[-1])
        sheet.disc(at, self._radius - self._gap, JOURNAL)
        sheet.circle(self.centre, self._gap, "#9a9a9a", 1.2 * u)
        before = self._bore.closed[first:record]
        for chosen, colour in ((~before, FLIGHT), (before, CONTACT)):
            if chosen.any():
                sheet.line(*pieces(x, y, chosen), colour, 2.0 * u)
        closed = bool(self._bore.closed[record])
        colour, word, ink = (CONTACT, "contact", CONTACT) if closed else (FLIGHT, "free flight", FLIGHT_TEXT)
        if closed:
            tail = self._struck(at)
            if tail != at:
                sheet.disc(tail, 6.0 * u, CONTACT, 1.2 * u)
            shorter = min(1.0, LONGEST * self._radius / max(math.hypot(*force), 1e-9))
            tip = (tail[0] + shorter * force[0], tail[1] + shorter * force[1])
            sheet.arrow(tail, tip, CONTACT, 7.0 * u, cut or shorter < 1.0)
        sheet.disc(at, 4.0 * u, colour, 1.2 * u)
        sheet.write(
            (self._box[2] - 8 * u, self._box[3] - 8 * u), word, 14 * u, ink, "right baseline", bold=True
        )

    def _places(self, records: slice) -> tuple[Series, Series]:
        """The middle of the journal at records; forward is to the right, as in the picture of the machine."""
        x, y = self._scale * self._bore.eccentricity[records].T
        return self.centre[0] + x, self.centre[1] - y

    def _struck(self, at: Point) -> Point:
        """Where on the wall it makes contact; its middle, if a tilted one does so elsewhere along the pin."""
        (x, y), away = self.centre, math.dist(at, self.centre)
        if away < (1.0 - ROUNDING) * self._gap:
            return at
        out = self._radius / away
        return x + out * (at[0] - x), y + out * (at[1] - y)


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
        self._touching = None if pin.bore is None else pin.bore.closed[inside]
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
        axes.tick_params("x", length=4 * u)
        axes.grid(axis="y", color=RULE, lw=max(1.0, u))
        axes.set_axisbelow(True)
        name = sheet.write((left, top - 9 * u), f"force [{self._shown.name}] over time [s]", 13 * u)
        if self._touching is not None:
            axes.legend(
                handles=[Patch(fc=CONTACT, label="contact"), Patch(fc=FLIGHT, label="free flight")],
                loc="center left", bbox_to_anchor=(left + sheet.width(name) + 12 * u, top - 13 * u), ncols=2,
                bbox_transform=sheet.axes.transData, frameon=False, fontsize=small, handlelength=1.4,
                handleheight=0.3, handletextpad=0.5, columnspacing=1.5, labelcolor=INK,
            )  # fmt: skip
        if self._peak > self._top:
            # without the peak, which records miss: the page of the run has it
            text = f"cut off at {self._top:.3g} {self._shown.name}"
            sheet.write((right, top - 9 * u), text, 12 * u, FAINT, "right baseline")
        force = np.minimum(self._force, self._top)
        if self._touching is None:
            axes.plot(self._time, force, color=IDEAL, lw=1.3 * u)
            return
        pressed = self._touching[1:] | self._touching[:-1]  # there is a force at one of both records
        widths = (3.0 * u, 1.3 * u)
        draw_pieces(axes, self._time, force, pressed, widths, solid_capstyle="butt", clip_on=False)

    def cursor(self, sheet: Canvas, time: float, force: float) -> None:
        """Draw the cursor at a time [s], with a dot at the force [N]."""
        u, (left, top, right, bottom) = self._unit, self._box
        x = left + (time - self._start) / self._length * (right - left)
        y = bottom - min(self._shown.scale * force / self._top, 1.0) * (bottom - top)
        sheet.line(np.array([x, x]), np.array([top, bottom]), INK, 1.4 * u)
        sheet.disc((x, y), 4.5 * u, INK, 1.2 * u)
