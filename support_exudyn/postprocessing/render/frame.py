"""A frame: the machine as the ray tracer sees it, journals in their bores, and force over time."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.colors import to_hex
from matplotlib.patches import Circle, FancyBboxPatch, Patch
from matplotlib.ticker import MaxNLocator

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures.selection import as_words, machine_name
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL, draw_pieces, pieces
from support_exudyn.postprocessing.figures.units import readable, said_beside
from support_exudyn.postprocessing.look.shapes import COLOURS, Role
from support_exudyn.postprocessing.render.canvas import FAINT, INK, RULE, SMALLEST_FONT, Box, Canvas, Point
from support_exudyn.postprocessing.render.movie import Moments
from support_exudyn.postprocessing.render.pin_views import STEPS, PinView, format_round, round_up, usual
from support_exudyn.postprocessing.render.scene import RenderedScene
from support_exudyn.postprocessing.render.stage import Camera, Picture
from support_exudyn.scenario.scenario import Scenario

ARROW = 0.24  # length of the usual force's arrow, of the height of a machine's picture that is as wide as usual
LONGEST = 0.42  # of an arrow in it
SMALL = 0.72  # size of the letters of an inset that is one of several
GAP = 8.0  # between insets
WORDS = 135.0  # height of what is written below them


class Layout:
    """Places on a frame: a line on top, the machine, a panel on the right of it, and force over time below.

    Arguments:
        width, height: of the frame [pixels].
        has_panel: whether there is a pin to show.
    """

    def __init__(self, width: int, height: int, has_panel: bool) -> None:
        self.width, self.height = width, height
        # by this lengths of a frame of 1280 x 720 are multiplied
        self.unit = u = min(width / 1280, height / 720)
        margin, top = max(2, round(14 * u)), round(48 * u)
        aside, below = (round(286 * u), round(142 * u)) if has_panel else (0, 0)
        right, bottom = width - margin, height - below
        self.line: Box = (margin, 0, right, top)
        self.picture: Box = (0, top, right - aside - margin if has_panel else width, bottom)
        self.panel: Box = (right - aside, top, right, bottom)
        self.strip: Box = (
            margin + round(58 * u),
            bottom + round(28 * u),
            right - margin,
            height - round(30 * u),
        )

    def insets(self, count: int) -> list[Box]:
        """Squares for so many insets in the panel, as large as leaves room for the words below them."""
        left, top, right, bottom = self.panel
        if count < 2:
            return [(left, top, right, top + right - left)][:count]
        gap, room = GAP * self.unit, bottom - top - WORDS * self.unit
        sides = {n: min((right - left + gap) / n, room / -(-count // n)) - gap for n in range(1, count + 1)}
        columns = max(sides, key=lambda n: sides[n])
        side, step = sides[columns], sides[columns] + gap
        corners = [(left + n % columns * step, top + n // columns * step) for n in range(count)]
        return [(round(x), round(y), round(x + side), round(y + side)) for x, y in corners]


class Painter:
    """Paints all frames of a run; what does not change is drawn once.

    Arguments:
        scene: the run.
        layout, camera: of the frames.
        pins: the first is that whose force is shown; of the others journals and arrows; none: no panel.
        moments: of the frames.
    """

    def __init__(
        self, scene: RenderedScene, layout: Layout, camera: Camera, pins: Sequence[PinView], moments: Moments
    ) -> None:
        self._scene, self._layout, self._camera, self._pins = scene, layout, camera, pins
        self._moments, self._time = moments, scene.result.time
        self._sheet = sheet = Canvas(layout.width, layout.height)
        u, (left, _, right, bottom) = layout.unit, layout.line
        text = title(scene.result.scenario, pins[0] if pins else None)
        sheet.write((left, 0.66 * bottom), text, 17 * u, room=right - left - 360 * u)
        if pins:
            pin, (first, last) = pins[0], moments.shown
            inside = (self._time >= first) & (self._time <= last)
            self._usual = usual(pin.size[moments.records] if moments.times.size > 1 else pin.size[inside])
            wide, high = layout.picture[2] - layout.picture[0], layout.picture[3] - layout.picture[1]
            self._scale = ARROW * min(high, 0.55 * wide) / self._usual  # pixels to a newton
            self._panel(pin)
            self._strip = Strip(sheet, layout.strip, self._time[inside], pin, inside, moments.shown, u)
        sheet.hold()

    def _panel(self, pin: PinView) -> None:
        """Draw what of the panel does not change: the bores, and the scale of the arrow."""
        u, sheet, below = self._layout.unit, self._sheet, self._layout.panel[1]
        loose = [one for one in self._pins if one.is_loose]
        several, self._insets = len(loose) > 1, list[Inset]()
        for one, box in zip(loose, self._layout.insets(len(loose)), strict=True):
            self._insets.append(Inset(sheet, box, one, SMALL * u if several else u, one_of_several=several))
            below = box[3]
        self._words = x, y = self._layout.panel[0], below + round(18 * u)
        sheet.write((x, y), f"force in {as_words(pin.name)}", 14 * u, anchor="left top")
        on = "journal" if pin.is_loose else pin.pin.second.body.replace("_", " ")
        sheet.write((x, y + 76 * u), f"on the {on}", 14 * u, anchor="left top")
        force = readable("N", self._usual)
        bar = 1.0 / round_up(1.0 / (force.scale * self._usual))  # the round number below it
        tip = x + bar / force.scale * self._scale
        sheet.arrow((x, y + 110 * u), (tip, y + 110 * u), CONTACT if pin.is_loose else IDEAL, 5.5 * u)
        text = f"{format_round(bar)} {force.name}"
        sheet.write((tip + 14 * u, y + 110 * u), text, 14 * u, anchor="left center")

    def frame(self, machine: Picture, number: int) -> Picture:
        """The frame of a number, around the picture of the machine."""
        u, sheet = self._layout.unit, self._sheet
        record = int(self._moments.records[number])
        left, top, right, bottom = self._layout.picture
        sheet.paste(machine, (left, top))
        start, y = right - 64 * u, bottom - 14 * u
        sheet.arrow((start, y), (right - 10 * u, y), INK, 2.5 * u)
        sheet.write((start - 8 * u, y), "forward", 13 * u, anchor="right center")
        for label in self._scene.labels(record):
            colour = "#ffffff" if label.light else INK
            sheet.write(self._seen(label.place), label.text, 15 * u, colour, "center center")
        _, _, right, bottom = self._layout.line
        text = f"t = {self._time[record]:.{self._moments.decimals}f} s"
        clock = sheet.write((right, 0.66 * bottom), text, 22 * u, anchor="right baseline", bold=True)
        before = right - sheet.width(clock) - 16 * u
        sheet.write((before, 0.66 * bottom), self._moments.pace, 14 * u, FAINT, "right baseline")
        if self._pins:
            self._force(self._pins[0], record, number)
        return sheet.frame()

    def _seen(self, point: Sequence[float]) -> Point:
        """The place on the frame of a point in space."""
        x, y = self._camera.pixels(np.array([point]))[0].tolist()
        return self._layout.picture[0] + x, self._layout.picture[1] + y

    def _force(self, pin: PinView, record: int, number: int) -> None:
        """Draw arrows, numbers, journals and cursor."""
        u, sheet, (left, top) = self._layout.unit, self._sheet, self._words
        for one in (*self._pins[1:], pin):
            self._arrow(one, record)
        size = float(pin.size[record])
        text = said_beside(size, "N", float(pin.size.max(initial=0.0)))
        colour = INK if size > 0.0 else FAINT
        sheet.write((left, top + 28 * u), text, 30 * u, colour, "left top", bold=True)
        if self._cut(pin, record) < 1.0:
            sheet.write((left, top + 126 * u), "the arrow is cut short", 13 * u, FAINT, "left top")
        for inset in self._insets:
            x, y = (self._scale * self._cut(inset.view, record) * inset.view.force[record]).tolist()
            inset.draw(record, self._moments.back(number, TRAIL), (x, -y))
        self._strip.cursor(float(self._time[record]), size)

    def _cut(self, pin: PinView, record: int) -> float:
        """The share of a force whose arrow is drawn: 1, or less if it would be too long."""
        return min(1.0, LONGEST / ARROW * self._usual / max(float(pin.size[record]), 1e-300))

    def _arrow(self, pin: PinView, record: int) -> None:
        """Draw the arrow of the force in the machine's picture, and a mark on the pin."""
        u, (x, y) = self._layout.unit, self._seen(self._scene.front_of(pin, record))
        force = self._cut(pin, record) * pin.force[record]
        along = self._camera.arrow(np.array([*force, 0.0])) / self._camera.scale * self._scale
        mark = IDEAL if not pin.is_loose else CONTACT if pin.closed[record] else FLIGHT
        self._sheet.disc((x, y), 8.0 * u, mark, 1.5 * u)
        tip = x + float(along[0]), y + float(along[1])
        self._sheet.arrow((x, y), tip, CONTACT if pin.is_loose else IDEAL, 8.0 * u)


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


# --- a journal in its bore, and force over time ---

RING = 1.2  # radius of what is drawn about the bore, of the bore's
ROUNDING = 1e-6  # of the clearance
LONGEST_INSIDE = 1.6  # of an arrow, in radii of the bore
TRAIL = 0.25  # how long the trail of the journal's centre is, in seconds of the movie
HOUSING, JOURNAL = to_hex(COLOURS[Role.BASE]), to_hex(COLOURS[Role.PIN])
FLIGHT_TEXT = "#1c7fb5"  # sky blue is too light for letters
CUT = 1.25  # how far the axis of forces goes beyond what is usual


class Inset:
    """The journal in its bore, with its clearance so much larger that it is seen; draws what does not change.

    Arguments:
        sheet: to draw on.
        box: where, a square [pixels].
        view: the clearance pin.
        unit: the factor on lengths of a frame of 1280 x 720.
        one_of_several: whether it names its pin, and has no room for more words.
    """

    def __init__(
        self, sheet: Canvas, box: Box, view: PinView, unit: float, *, one_of_several: bool = False
    ) -> None:
        self._sheet, self._box, self.view, self._unit = sheet, box, view, unit
        left, top, right, bottom = box
        self.centre: Point = (0.5 * (left + right), 0.5 * (top + bottom) + 2 * unit)  # of the bore
        self._radius, gap = 0.5 * (right - left - 62 * unit) / RING, 8 * unit
        style = f"round,pad=0,rounding_size={6 * unit}"
        sheet.add(FancyBboxPatch((left, top), right - left, bottom - top, style, fc="#eef0f2", lw=0.0))
        sheet.disc(self.centre, RING * self._radius, HOUSING)
        sheet.disc(self.centre, self._radius, "#ffffff")
        self.title = (
            f"{as_words(view.name) if one_of_several else 'clearance'} \u00d7 {format_round(view.enlargement)}"
        )
        room = right - left - 2 * gap
        sheet.write((left + gap, top + gap), self.title, 14 * unit, anchor="left top", bold=True, room=room)
        if not one_of_several:
            carrier = view.pin.bore.body
            carrier = "base" if carrier == GROUND else as_words(carrier)
            sheet.write((left + gap, bottom - gap), f"bore in {carrier}", 13 * unit, FAINT)

    def draw(self, record: int, first: int, force: Point) -> None:
        """Draw the journal at a record.

        Arguments:
            first: record at which the trail begins.
            force: arrow of the force on the journal, to the right and down [pixels].
        """
        u, view, sheet, (x0, y0) = self._unit, self.view, self._sheet, self.centre
        path, inner = view.enlarged(slice(first, record + 1), self._radius)
        x, y, play = x0 + path[:, 0], y0 - path[:, 1], self._radius - inner
        at = float(x[-1]), float(y[-1])
        sheet.disc(at, inner, JOURNAL)
        sheet.add(Circle(self.centre, play, fill=False, ec="#9a9a9a", lw=1.2 * u, ls=(0, (3.0, 2.5))))
        before = view.closed[first:record]
        for chosen, colour in ((~before, FLIGHT), (before, CONTACT)):
            if chosen.any():
                sheet.line(*pieces(x, y, chosen), colour, 2.0 * u)
        closed = bool(view.closed[record])
        colour, word, ink = (CONTACT, "contact", CONTACT) if closed else (FLIGHT, "free flight", FLIGHT_TEXT)
        if closed:
            tail, shorter = at, min(1.0, LONGEST_INSIDE * self._radius / max(math.hypot(*force), 1e-9))
            if (away := math.dist(at, self.centre)) >= (1.0 - ROUNDING) * play:  # on the wall, not tilted
                out = self._radius / away
                tail = x0 + out * (at[0] - x0), y0 + out * (at[1] - y0)
                sheet.disc(tail, 6.0 * u, CONTACT, 1.2 * u)
            sheet.arrow(tail, (tail[0] + shorter * force[0], tail[1] + shorter * force[1]), CONTACT, 7.0 * u)
        sheet.disc(at, 4.0 * u, colour, 1.2 * u)
        place = self._box[2] - 8 * u, self._box[3] - 8 * u
        sheet.write(place, word, 14 * u, ink, "right baseline", bold=True)


class Strip:
    """Force over time, with a cursor at the time of the frame; draws all but the cursor.

    Arguments:
        sheet: to draw on.
        box: of the axes [pixels].
        time: of the shown records [s].
        pin: whose force it is; inside: which of its records are shown.
        span: of the frames, from and to [s].
        unit: the factor on lengths of a frame of 1280 x 720.
    """

    def __init__(
        self, sheet: Canvas, box: Box, time: Series, pin: PinView, inside: np.ndarray,
        span: tuple[float, float], unit: float,
    ) -> None:  # fmt: skip
        self._sheet, self._box, self._unit, self._start = sheet, box, unit, span[0]
        self._length = max(span[1] - span[0], 1e-12)
        self._shown = shown = readable("N", float(pin.size[inside].max(initial=0.0)))
        force = shown.scale * pin.size[inside]
        peak = float(force.max(initial=0.0))
        self._top = top = min(CUT * usual(force), 1.08 * peak) if peak > 0.0 else 1.0
        axes, small, high = sheet.axes_in(box), max(SMALLEST_FONT, 12 * unit), box[1] - 9 * unit
        axes.set(xlim=(span[0], span[0] + self._length), ylim=(0.0, top))
        axes.xaxis.set_major_locator(MaxNLocator(10, steps=STEPS))
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=STEPS))
        axes.xaxis.set_major_formatter(lambda x, _: f"{x:.6g}")
        axes.yaxis.set_major_formatter(lambda y, _: format_round(y))
        axes.spines[:].set_visible(False)
        axes.tick_params(labelsize=small, labelcolor=FAINT, color=FAINT, pad=4 * unit, width=unit)
        axes.tick_params("y", length=0.0)
        axes.grid(axis="y", color=RULE, lw=max(1.0, unit))
        axes.set_axisbelow(True)
        name = sheet.write((box[0], high), f"force [{shown.name}] over time [s]", 13 * unit)
        if peak > top:  # without the peak, which records miss: the page of the run has it
            text = f"cut off at {top:.3g} {shown.name}"
            sheet.write((box[2], high), text, 12 * unit, FAINT, "right baseline")
        force = np.minimum(force, top)
        if not pin.is_loose:
            axes.plot(time, force, color=IDEAL, lw=1.3 * unit)
            return
        handles = [Patch(fc=CONTACT, label="contact"), Patch(fc=FLIGHT, label="free flight")]
        axes.legend(
            handles=handles, loc="center left", bbox_to_anchor=(box[0] + sheet.width(name) + 12 * unit, high),
            ncols=2, bbox_transform=sheet.axes.transData, frameon=False, fontsize=small, handlelength=1.4,
            handleheight=0.3, handletextpad=0.5, columnspacing=1.5, labelcolor=INK,
        )  # fmt: skip
        closed = pin.closed[inside]
        pressed = closed[1:] | closed[:-1]  # there is a force at one of both records
        widths = (3.0 * unit, 1.3 * unit)
        draw_pieces(axes, time, force, pressed, widths, solid_capstyle="butt", clip_on=False)

    def cursor(self, time: float, force: float) -> None:
        """Draw the cursor at a time [s], with a dot at the force [N]."""
        u, (left, top, right, bottom) = self._unit, self._box
        x = left + (time - self._start) / self._length * (right - left)
        y = bottom - min(self._shown.scale * force / self._top, 1.0) * (bottom - top)
        self._sheet.line((x, x), (top, bottom), INK, 1.4 * u)
        self._sheet.disc((x, y), 4.5 * u, INK, 1.2 * u)
