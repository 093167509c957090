"""A frame: the machine as the ray tracer sees it, and what is written and drawn on and beside it."""

from collections.abc import Sequence

import numpy as np

from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL
from support_exudyn.postprocessing.figures.units import readable, said_beside
from support_exudyn.postprocessing.render.movie import Moments
from support_exudyn.postprocessing.render.panels import TRAIL, Inset, Strip
from support_exudyn.postprocessing.render.pin_views import PinView, round_down, said, usual
from support_exudyn.postprocessing.render.scene import RenderedScene
from support_exudyn.postprocessing.render.sheet import FAINT, INK, Box, Canvas, Image
from support_exudyn.postprocessing.render.stage import Camera
from support_exudyn.scenario.scenario import Scenario

ARROW = 0.24  # length of the usual force's arrow, of the height of a machine's picture that is as wide as usual
LONGEST = 0.42  # of an arrow in it


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
        left = margin + round(58 * u)
        self.strip: Box = (left, bottom + round(28 * u), right - margin, height - round(30 * u))


SMALL = 0.72  # size of the letters of an inset that is one of several
GAP = 8.0  # between insets
WORDS = 135.0  # height of what is written below them


def inset_boxes(panel: Box, count: int, unit: float) -> list[Box]:
    """Places of so many insets in a panel: squares, as large as leaves room for the words below them."""
    left, top, right, bottom = panel
    if count < 2:
        return [(left, top, right, top + right - left)][:count]
    gap, room = GAP * unit, bottom - top - WORDS * unit

    def side(columns: int) -> float:
        return min((right - left + gap) / columns, room / -(-count // columns)) - gap

    columns = max(range(1, count + 1), key=side)
    step = side(columns) + gap
    corners = [(left + n % columns * step, top + n // columns * step) for n in range(count)]
    return [(round(x), round(y), round(x + step - gap), round(y + step - gap)) for x, y in corners]


class Painter:
    """Paints all frames of a run; what does not change is drawn once.

    Arguments:
        scene: the run.
        layout, camera: of the frames.
        pins: the first is that whose force is shown; of the others journals and arrows. Empty: nothing is.
        moments: of the frames.
    """

    def __init__(
        self, scene: RenderedScene, layout: Layout, camera: Camera, pins: Sequence[PinView], moments: Moments
    ) -> None:
        pin = pins[0] if pins else None
        self._others = pins[1:]
        self._scene, self._layout, self._camera, self._pin = scene, layout, camera, pin
        self._moments, self._time = moments, scene.result.time
        self._sheet = Canvas(layout.width, layout.height)
        self._insets: list[tuple[PinView, Inset]] = []
        self._below = layout.panel[1]  # of the insets
        u, (left, _, right, bottom) = layout.unit, layout.line
        text = title(scene.result.scenario, pin)
        self._sheet.write((left, 0.66 * bottom), text, 17 * u, room=right - left - 360 * u)
        if pin is not None:
            inside = (self._time >= moments.shown[0]) & (self._time <= moments.shown[1])
            self._peak = float(pin.size.max(initial=0.0))  # [N]
            self._usual = usual(pin.size[moments.records] if moments.times.size > 1 else pin.size[inside])
            wide, high = layout.picture[2] - layout.picture[0], layout.picture[3] - layout.picture[1]
            self._scale = ARROW * min(high, 0.55 * wide) / self._usual  # pixels to a newton
            self._colour = IDEAL if pin.bore is None else CONTACT
            self._panel(pin)
            self._strip = Strip(layout.strip, self._time, pin, *moments.shown, u)
            self._strip.draw_still(self._sheet)
        self._sheet.hold()

    def _panel(self, pin: PinView) -> None:
        """Draw what of the panel does not change: the bore, and the scale of the arrow."""
        u, sheet = self._layout.unit, self._sheet
        with_bore = [one for one in (pin, *self._others) if one.bore is not None]
        several = len(with_bore) > 1
        for one, box in zip(with_bore, inset_boxes(self._layout.panel, len(with_bore), u), strict=True):
            assert one.bore is not None
            inset = Inset(box, one.bore, SMALL * u if several else u, one.name if several else "")
            inset.draw_still(sheet)
            self._insets.append((one, inset))
            self._below = box[3]
        x, y = self._words
        sheet.write((x, y), f"force in {pin.name.replace('_', ' ')}", 14 * u, anchor="left top")
        sheet.write((x, y + 76 * u), f"on the {pin.on}", 14 * u, anchor="left top")
        force = readable("N", self._usual)
        bar = round_down(force.scale * self._usual)
        long = bar / force.scale * self._scale
        sheet.arrow((x, y + 110 * u), (x + long, y + 110 * u), self._colour, 5.5 * u)
        sheet.write((x + long + 14 * u, y + 110 * u), f"{said(bar)} {force.name}", 14 * u, anchor="left center")

    @property
    def _words(self) -> tuple[float, float]:
        """The corner of what of the panel is below the inset."""
        return self._layout.panel[0], self._below + round(18 * self._layout.unit)

    def frame(self, machine: Image, number: int) -> Image:
        """The frame of a number, around the picture of the machine."""
        layout, u, sheet = self._layout, self._layout.unit, self._sheet
        record = int(self._moments.records[number])
        left, top, *_ = layout.picture
        sheet.paste(machine, (left, top))
        self._forward()
        for label in self._scene.labels(record):
            x, y = self._camera.pixels(np.array([label.place]))[0]
            colour = "#ffffff" if label.light else INK
            sheet.write((left + float(x), top + float(y)), label.text, 15 * u, colour, "center center")
        _, _, right, bottom = layout.line
        text = f"t = {self._time[record]:.{self._moments.decimals}f} s"
        clock = sheet.write((right, 0.66 * bottom), text, 22 * u, anchor="right baseline", bold=True)
        before = right - sheet.width(clock) - 16 * u
        sheet.write((before, 0.66 * bottom), self._moments.pace, 14 * u, FAINT, "right baseline")
        if self._pin is not None:
            self._force(self._pin, record, number)
        return sheet.frame()

    def _forward(self) -> None:
        """Say which way is forward, in the lower right corner of the machine's picture."""
        u, (_, _, right, bottom) = self._layout.unit, self._layout.picture
        start, y = right - 64 * u, bottom - 14 * u
        self._sheet.arrow((start, y), (right - 10 * u, y), INK, 2.5 * u)
        self._sheet.write((start - 8 * u, y), "forward", 13 * u, anchor="right center")

    def _force(self, pin: PinView, record: int, number: int) -> None:
        """Draw arrows, numbers, journal and cursor."""
        u, sheet, (left, top) = self._layout.unit, self._sheet, self._words
        size = float(pin.size[record])
        for one in (*self._others, pin):
            self._arrow(one, record)
        colour = INK if size > 0.0 else FAINT
        number_text = said_beside(size, "N", self._peak)
        sheet.write((left, top + 28 * u), number_text, 30 * u, colour, "left top", bold=True)
        if self._cut(pin, record) < 1.0:
            sheet.write((left, top + 126 * u), "the arrow is cut short", 13 * u, FAINT, "left top")
        for one, inset in self._insets:
            x, y = (self._scale * self._cut(one, record) * one.force[record]).tolist()
            inset.draw(sheet, record, self._moments.back(number, TRAIL), (x, -y))
        self._strip.cursor(sheet, float(self._time[record]), size)

    def _cut(self, pin: PinView, record: int) -> float:
        """The share of a force whose arrow is drawn: 1, or less if it would be too long."""
        return min(1.0, LONGEST / ARROW * self._usual / max(float(pin.size[record]), 1e-300))

    def _arrow(self, pin: PinView, record: int) -> None:
        """Draw the arrow of the force in the machine's picture, and a mark on the pin."""
        u, (left, top, *_) = self._layout.unit, self._layout.picture
        x, y = self._camera.pixels(np.array([self._scene.context(pin, record)]))[0]
        place = (left + float(x), top + float(y))
        force = self._cut(pin, record) * pin.force[record]
        along = self._camera.arrow(np.array([*force, 0.0])) / self._camera.scale * self._scale
        mark = IDEAL if pin.bore is None else CONTACT if pin.bore.closed[record] else FLIGHT
        self._sheet.disc(place, 8.0 * u, mark, 1.5 * u)
        tip = (place[0] + float(along[0]), place[1] + float(along[1]))
        self._sheet.arrow(place, tip, IDEAL if pin.bore is None else CONTACT, 8.0 * u)


def title(scenario: Scenario, pin: PinView | None) -> str:
    """A run in a line: machine, clearances, friction."""
    words = [_spaced(type(scenario.machine).__name__) + (" in space" if scenario.dimensions == 3 else "")]
    if pin is not None and pin.bore is not None:
        contact = pin.bore.pin.contact
        coefficient = getattr(contact.friction, "sliding_coefficient", None)
        friction = (
            _spaced(type(contact.friction).__name__) if coefficient is None else f"friction {coefficient:g}"
        )
        clearance = f"radial clearance {1e3 * contact.bearing.clearance:.4g} mm"
        words.append(f"{pin.name.replace('_', ' ')}: {clearance}, {friction}")
    elif not scenario.contact_places:
        words.append("ideal pins")
    more = len(scenario.clearance_pins) - (pin is not None and pin.bore is not None)
    if more > 0:
        words.append(f"{more} more clearance pin{'s' * (more > 1)}")
    for name, guide in scenario.guides.items():
        for part in list(guide.contacts().values())[:1]:  # by how much what slides can go to either side
            play = part.contact.bearing.clearance - abs(part.point[1])
            words.append(f"{name.replace('_', ' ')}: play \u00b1{1e3 * play:.4g} mm")
    return "  \u00b7  ".join(words)


def _spaced(name: str) -> str:
    """A class's name as words."""
    return "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name).strip()
