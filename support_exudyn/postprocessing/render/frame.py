"""A frame: the machine as the ray tracer sees it, journals in their bores, and force over time."""

import math
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrow, Rectangle
from matplotlib.patheffects import withStroke

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures.selection import as_words, machine_name, nearest
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL, draw_pieces, pieces
from support_exudyn.postprocessing.figures.units import amount, readable
from support_exudyn.postprocessing.look.shapes import COLOURS, Role
from support_exudyn.postprocessing.render.pin_views import PinView, format_round, pin_views, usual
from support_exudyn.postprocessing.render.stage import VIEW, Picture, Stage
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result

USUAL = 1280, 720  # size of a frame in which lengths are counted; another one is larger or smaller in all
MARGIN, TOP, PANEL, BELOW, GAP = 14, 48, 286, 142, 8  # of a frame: border, title, insets, strip, between insets
ARROW, LONGEST = 0.2, 0.4  # length of the usual force's arrow, and of the longest, of the picture's height
RING = 1.2  # radius of what is drawn about a bore, of the bore's
LONGEST_INSIDE = 1.6  # of an arrow, in radii of the bore
TRAIL = 0.25  # how long the trail of the journal's centre is, in seconds of the movie
CUT = 1.25  # how far the axis of forces goes beyond what is usual
INK, FAINT, FLIGHT_TEXT = "#1a1a1a", "#6b6b6b", "#1c7fb5"
HOUSING, JOURNAL = to_hex(COLOURS[Role.BASE]), to_hex(COLOURS[Role.PIN])
Point = tuple[float, float]


class Times(NamedTuple):
    """The times of frames (n,) [s], their step [s of the run], their rate [1/s], and the shown window [s].

    Frames need not be at records: each shows the record next to its time, for between records it is not known
    whether a journal has been in contact. In slow motion one record may so be seen in several frames.
    """

    frames: Series
    step: float
    rate: float
    window: tuple[float, float]

    @property
    def pace(self) -> str:
        """The words for the movie's speed; none at the run's."""
        speed = self.step * self.rate
        if self.frames.size == 1 or abs(speed - 1.0) < 1e-9:
            return ""
        return f"{1.0 / speed:.4g} \u00d7 slower" if speed < 1.0 else f"{speed:.4g} \u00d7 faster"


class Painter:
    """Paints the frames of a run.

    Arguments:
        result: the run.
        size: width and height of frames [pixels].
        pin: whose force is shown; None: the first clearance pin, or the first of all.
        times: of the frames.

    Raises InputError if there is no such pin, or the run has not recorded what frames show.
    """

    def __init__(self, result: Result, size: tuple[int, int], pin: str | None, times: Times) -> None:
        self._result, self._times, self._pins = result, times, pin_views(result, pin)
        self._unit = unit = min(size[0] / USUAL[0], size[1] / USUAL[1])  # pixels to a unit of length
        width, height = size[0] / unit, size[1] / unit
        right, bottom = (width - PANEL - 2 * MARGIN, height - BELOW) if self._pins else (width, height)
        self._stage = Stage(result, (round(right * unit), round((bottom - TOP) * unit)))
        # a hundredth of a pixel more: sizes are cut to whole pixels
        inches = (size[0] + 0.01) / (72 * unit), (size[1] + 0.01) / (72 * unit)
        self._figure = Figure(inches, dpi=72 * unit, facecolor="white")
        self._figure.set_layout_engine("none")
        self._canvas: Any = FigureCanvasAgg(self._figure)  # matplotlib has no types of it
        self._page = self._axes((0, 0, width, height))
        self._page.set(xlim=(0, width), ylim=(height, 0))
        self._page.set_axis_off()
        self._moving: list[Artist] = []
        self._write((MARGIN, 32), title(result.scenario, self._pins[0] if self._pins else None), 17)
        self._write((right - 74, bottom - 14), "forward", 13, ha="right", va="center")
        self._arrow((right - 64, bottom - 14), (54, 0), INK, 2.5)
        self._right, self._bottom, self._insets = right, bottom, list[tuple[PinView, Point, float]]()
        if self._pins:
            self._draw_panel(width)
            self._draw_strip((MARGIN + 58, bottom + 28, width - 2 * MARGIN, height - 30))
        self._moving.clear()

    # --- what all frames have ---

    def _axes(self, box: tuple[float, float, float, float]) -> Axes:
        """Axes in a box: left, top, right and bottom."""
        wide, high = (float(side) / self._unit for side in self._figure.bbox.size)
        left, top, right, bottom = box
        return self._figure.add_axes(
            (left / wide, 1 - bottom / high, (right - left) / wide, (bottom - top) / high)
        )

    def _draw_panel(self, width: float) -> None:
        """Draw bores with the names of their pins, and what force is shown."""
        loose, left = [one for one in self._pins if one.is_loose], width - MARGIN - PANEL
        columns, below = max(1, math.ceil(math.sqrt(len(loose)))), TOP
        side = (PANEL + GAP) / columns - GAP
        for n, view in enumerate(loose):
            x, y = left + n % columns * (side + GAP), TOP + n // columns * (side + GAP)
            centre, radius = (x + 0.5 * side, y + 0.5 * side), 0.39 * side / RING
            self._add(Rectangle((x, y), side, side, fc="#eef0f2"))
            self._add(Circle(centre, RING * radius, fc=HOUSING))
            self._add(Circle(centre, radius, fc="white"))
            play = radius - view.enlarged(0, radius)[1]
            self._add(Circle(centre, play, fill=False, ec="#9a9a9a", ls=(0, (3.0, 2.5)), zorder=2.5))
            text = f"\u00d7 {format_round(view.enlargement)}"
            if columns > 1:
                self._write((x + 4, y + 3), f"{as_words(view.name)} {text}", 24 / columns, va="top")
            else:
                self._write((x + GAP, y + GAP), f"clearance {text}", 14, va="top", weight="bold")
                carrier = view.pin.bore.body
                words = f"bore in {'base' if carrier == GROUND else as_words(carrier)}"
                self._write((x + GAP, y + side - GAP), words, 13, color=FAINT)
            self._insets.append((view, centre, radius))
            below = int(y + side)
        pin = self._pins[0]
        self._words = left, below + 18.0
        self._write((left, below + 18), f"force in {as_words(pin.name)}", 14, va="top")
        on = "journal" if pin.is_loose else as_words(pin.pin.second.body)
        self._write((left, below + 94), f"on the {on}", 14, va="top")

    def _draw_strip(self, box: tuple[float, float, float, float]) -> None:
        """Draw the force over time."""
        pin, (first, last), time = self._pins[0], self._times.window, self._result.time
        inside = (time >= first) & (time <= last)
        seen = np.union1d(np.flatnonzero(inside), nearest(time, self._times.frames))  # frames may lie outside
        sizes = pin.size[seen]
        self._usual = usual(sizes)
        self._shown = readable("N", float(sizes.max(initial=0.0)))
        force = self._shown.scale * pin.size[inside]
        peak = self._shown.scale * float(sizes.max(initial=0.0))
        self._top = min(CUT * self._shown.scale * self._usual, 1.08 * peak) if peak > 0.0 else 1.0
        self._strip = axes = self._axes(box)
        axes.set(xlim=(first, max(last, first + 1e-12)), ylim=(0.0, self._top))
        axes.spines[:].set_visible(False)
        axes.tick_params(labelsize=12, labelcolor=FAINT, color=FAINT)
        axes.locator_params(axis="y", nbins=4)
        axes.grid(axis="y", color="#c9c9c9")
        axes.set_axisbelow(True)
        self._write((box[0], box[1] - 9), f"force [{self._shown.name}] over time [s]", 13)
        if peak > self._top:
            words = f"cut off at {self._top:.3g} {self._shown.name}"
            self._write((box[2], box[1] - 9), words, 12, color=FAINT, ha="right")
        force = np.minimum(force, self._top)
        if not pin.is_loose:
            axes.plot(time[inside], force, color=IDEAL, lw=1.3)
            return
        closed = pin.closed[inside]
        pressed = closed[1:] | closed[:-1]  # there is a force at one of both records
        draw_pieces(axes, time[inside], force, pressed, (3.0, 1.3), solid_capstyle="butt", clip_on=False)
        look: dict[str, Any] = {"frameon": False, "fontsize": 12, "ncols": 2, "borderaxespad": 0.0}
        if pressed.size:
            axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.02), **look)

    # --- a frame ---

    def frame(self, number: int) -> Picture:
        """The frame of a number, RGB (height, width, 3)."""
        record = int(nearest(self._result.time, self._times.frames[number : number + 1])[0])
        picture = self._stage.image(record)
        down = round(self._figure.bbox.height) - round(TOP * self._unit) - len(picture)
        self._moving.append(self._figure.figimage(picture, 0, down, origin="upper", zorder=-1))
        right = float(self._page.get_xlim()[1]) - MARGIN
        decimals = min(7, max(3, math.ceil(-math.log10(max(self._times.step, 1e-9)) - 1e-9)))
        clock = f"t = {self._result.time[record]:.{decimals}f} s"
        self._write((right, 32), clock, 22, ha="right", weight="bold")
        self._write((right - 16 - 13.5 * len(clock), 32), self._times.pace, 14, color=FAINT, ha="right")
        for pin in reversed(self._pins):
            self._draw_force(pin, record)
        for view, centre, radius in self._insets:
            self._draw_journal(view, centre, radius, record, number)
        if self._pins:
            size = float(self._pins[0].size[record])
            text = f"{self._shown.scale * size:.1f} {self._shown.name}"
            if size > 0.0 and text.startswith("0.0 "):
                text = amount(size, "N")
            place = self._words[0], self._words[1] + 28
            self._write(place, text, 30, color=INK if size > 0.0 else FAINT, va="top", weight="bold")
            if ARROW * size > LONGEST * self._usual:
                cut = self._words[0], self._words[1] + 100
                self._write(cut, "the arrow is cut short", 13, color=FAINT, va="top")
            time, force = self._result.time[record], min(self._shown.scale * size, self._top)
            self._moving.append(self._strip.axvline(time, color=INK, lw=1.4))
            dot: dict[str, Any] = {"ms": 9, "mfc": INK, "mec": "white", "clip_on": False, "zorder": 5}
            self._moving += self._strip.plot(time, force, "o", **dot)
        self._canvas.draw()
        image = np.array(self._canvas.buffer_rgba())[:, :, :3]
        for artist in self._moving:
            artist.remove()
        self._moving.clear()
        return image

    def arrow_of(self, pin: PinView, record: int) -> Series:
        """The arrow of the force of a pin at a record, to the right and up, before it is turned (2,)."""
        high = self._bottom - TOP
        size = max(float(pin.size[record]), 1e-300)
        length = min(ARROW * size / self._usual, LONGEST) * high
        return np.asarray(length / size * pin.force[record])

    def _draw_force(self, pin: PinView, record: int) -> None:
        """Draw the arrow of a force in the picture of the machine, and a mark on the pin."""
        x, y = self._stage.camera.pixels(np.array([self._stage.front_of(pin, record)]))[0] / self._unit
        right, up, _ = VIEW.apply([*self.arrow_of(pin, record), 0.0])
        colour = IDEAL if not pin.is_loose else CONTACT if pin.closed[record] else FLIGHT
        self._add(Circle((x, y + TOP), 7.0, fc=colour, ec="white", lw=1.5, zorder=4))
        self._arrow((x, y + TOP), (right, -up), colour, 8.0)

    def _draw_journal(self, view: PinView, centre: Point, radius: float, record: int, number: int) -> None:
        """Draw a journal in its bore with its trail and the force on it."""
        times = self._times
        past = max(times.frames[number] - TRAIL * times.rate * times.step, times.frames[0])
        first = min(int(np.searchsorted(self._result.time, past)), record)
        path, inner = view.enlarged(slice(first, record + 1), radius)
        x, y = centre[0] + path[:, 0], centre[1] - path[:, 1]
        at, before, closed = (float(x[-1]), float(y[-1])), view.closed[first:record], bool(view.closed[record])
        self._add(Circle(at, inner, fc=JOURNAL))
        for chosen, colour in ((~before, FLIGHT), (before, CONTACT)):
            if chosen.any():
                look: dict[str, Any] = {"color": colour, "lw": 2.0, "scalex": False, "scaley": False}
                self._moving += self._page.plot(*pieces(x, y, chosen), zorder=3, **look)
        self._add(Circle(at, 4.0, fc=CONTACT if closed else FLIGHT, ec="white", lw=1.2, zorder=5))
        if closed:
            force = self.arrow_of(view, record) * [1.0, -1.0]
            force *= min(1.0, LONGEST_INSIDE * radius / max(float(np.hypot(*force)), 1e-9))
            self._arrow(at, tuple(force.tolist()), CONTACT, 7.0)
        if len(self._insets) == 1:
            word, ink = ("contact", CONTACT) if closed else ("free flight", FLIGHT_TEXT)
            corner = centre[0] + 0.5 * PANEL - GAP, centre[1] + 0.5 * PANEL - GAP
            self._write(corner, word, 14, color=ink, ha="right", weight="bold")

    # --- on the page ---

    def _add(self, artist: Any) -> None:
        self._moving.append(self._page.add_patch(artist))

    def _write(self, place: Point, text: str, size: float, **look: Any) -> None:
        self._moving.append(self._page.text(*place, text, size=size, **{"color": INK, **look}))

    def _arrow(self, tail: Point, way: Point, colour: str, thick: float) -> None:
        """Draw an arrow with a white edge, which is seen on anything, unless it is hardly longer than thick."""
        length = math.hypot(*way)
        if length > 1.8 * thick:
            head, edge = min(4.2 * thick, 0.7 * length), withStroke(linewidth=0.7 * thick, foreground="white")
            shape: dict[str, Any] = {
                "head_length": head,
                "head_width": 0.84 * head,
                "length_includes_head": True,
            }
            self._add(FancyArrow(
                *tail, *way, width=thick, fc=colour, lw=0.0, zorder=4.5, path_effects=[edge], **shape
            ))  # fmt: skip


def title(scenario: Scenario, pin: PinView | None) -> str:
    """A run in a line: machine, clearance, friction, and how many more clearance joints there are."""
    words = [machine_name(scenario) + (" in space" if scenario.dimensions == 3 else "")]
    loose = None if pin is None else pin.pin.with_clearance
    if pin is not None and loose is not None:
        law = loose.contact.friction
        coefficient = getattr(law, "sliding_coefficient", None)
        friction = as_words(type(law).__name__) if coefficient is None else f"friction {coefficient:g}"
        clearance = f"radial clearance {1e3 * loose.contact.bearing.clearance:.4g} mm"
        words.append(f"{as_words(pin.name)}: {clearance}, {friction}")
    elif not scenario.contact_places:
        words.append("ideal pins")
    guides = [name for name, guide in scenario.guides.items() if guide.contacts()]
    for more, what in ((len(scenario.clearance_pins) - (loose is not None), "pin"), (len(guides), "guide")):
        if more > 0:
            words.append(f"{more} {'more ' * (what == 'pin')}clearance {what}{'s' * (more > 1)}")
    return "  \u00b7  ".join(words)
