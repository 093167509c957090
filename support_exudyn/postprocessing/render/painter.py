"""A frame: the machine as the ray tracer sees it, and what is written and drawn on and beside it."""

from __future__ import annotations

import numpy as np
from PIL import Image

from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT, IDEAL
from support_exudyn.postprocessing.render.camera import Camera
from support_exudyn.postprocessing.render.ink import FAINT, INK, Point, Sheet, fitting, width, write
from support_exudyn.postprocessing.render.inset import TRAIL, Inset
from support_exudyn.postprocessing.render.layout import Box, Layout
from support_exudyn.postprocessing.render.moments import Moments
from support_exudyn.postprocessing.render.pin_view import PinView
from support_exudyn.postprocessing.render.scales import round_down, said, usual
from support_exudyn.postprocessing.render.scene import Scene
from support_exudyn.postprocessing.render.stage import Image as Picture
from support_exudyn.postprocessing.render.strip import Strip
from support_exudyn.scenario.scenario import Scenario

ARROW = 0.24  # length of the usual force's arrow, of the height of a machine's picture that is as wide as usual
LONGEST = 0.42  # of an arrow in it


class Painter:
    """Of all frames of a run; what does not change is drawn once.

    Arguments:
        scene: the run.
        layout, camera: of the frames.
        pin: whose force is shown; None: nothing is.
        moments: of the frames.
    """

    def __init__(
        self, scene: Scene, layout: Layout, camera: Camera, pin: PinView | None, moments: Moments
    ) -> None:
        self._scene, self._layout, self._camera, self._pin = scene, layout, camera, pin
        self._moments = moments
        self._time = scene.poses.time
        u = layout.unit
        self._background = Image.new("RGB", (layout.width, layout.height), "#ffffff")
        write(
            self._background,
            (layout.line[0], 0.66 * layout.line[3]),
            *self._title(layout.line[2] - layout.line[0] - 360 * u),
        )
        self._inset: Inset | None = None
        self._strip: Strip | None = None
        if pin is None:
            return
        inside = (self._time >= moments.shown[0]) & (self._time <= moments.shown[1])
        seen = pin.size[moments.records] if moments.times.size > 1 else pin.size[inside]
        self._usual = usual(seen)
        self._largest = LONGEST / ARROW * self._usual
        wide, high = layout.picture[2] - layout.picture[0], layout.picture[3] - layout.picture[1]
        self._scale = ARROW * min(high, 0.55 * wide) / self._usual  # pixels to a newton
        left, top, right, _ = layout.panel
        if pin.bore is not None:
            self._inset = Inset((left, top, right, top + right - left), pin.bore, u)
        self._strip = Strip(layout.strip, self._time, pin, *moments.shown, u)
        self._strip.draw(self._background)
        self._still_panel()

    def _title(self, room: float) -> tuple[str, float]:
        """What is shown, and the size of the letters."""
        text = title(self._scene.result.scenario, self._pin)
        return text, fitting(text, room, 17 * self._layout.unit)

    @property
    def _words(self) -> Box:
        """What of the panel is below the inset."""
        left, top, right, bottom = self._layout.panel
        below = top + (right - left if self._inset else 0) + round(10 * self._layout.unit)
        return left, below, right, bottom

    def _still_panel(self) -> None:
        """What of the panel does not change: the scale of the arrow."""
        assert self._pin is not None
        u, (left, top, *_) = self._layout.unit, self._words
        bar = round_down(self._usual / 1e3)
        long = bar * 1e3 * self._scale
        y = top + 118 * u
        sheet = Sheet((left - 4, y - 12 * u, left + long + 8 * u, y + 12 * u))
        sheet.arrow((left, y), (left + long, y), self._colour, 5.5 * u)
        sheet.onto(self._background)
        write(self._background, (left + long + 14 * u, y), f"{said(bar)} kN", 14 * u, INK, "lm")
        write(self._background, (left, top + 84 * u), f"on the {self._pin.on}", 14 * u, INK, "lt")

    @property
    def _colour(self) -> str:
        return IDEAL if self._pin is None or self._pin.bore is None else CONTACT

    def frame(self, machine: Picture, number: int) -> Image.Image:
        """The frame of a number, around the picture of the machine."""
        layout, u = self._layout, self._layout.unit
        record = int(self._moments.records[number])
        frame = self._background.copy()
        frame.paste(Image.fromarray(machine), layout.picture[:2])
        self._labels(frame, record)
        clock = f"t = {self._time[record]:.{self._moments.decimals}f} s"
        write(frame, (layout.line[2], 0.66 * layout.line[3]), clock, 22 * u, anchor="rs", bold=True)
        left = layout.line[2] - width(clock, 22 * u, True) - 16 * u
        write(frame, (left, 0.66 * layout.line[3]), self._moments.pace, 14 * u, FAINT, "rs")
        if self._pin is not None:
            self._force(frame, record, number)
        return frame

    def _labels(self, frame: Image.Image, record: int) -> None:
        u, (left, top, *_) = self._layout.unit, self._layout.picture
        for label in self._scene.labels(record):
            x, y = self._camera.pixels(np.array([label.place]))[0]
            colour = "#ffffff" if label.light else INK
            lines = label.text.split("\n")
            for n, line in enumerate(lines):
                down = 18 * u * (n - 0.5 * (len(lines) - 1))
                write(frame, (left + float(x), top + float(y) + down), line, 15 * u, colour, "mm")

    def _force(self, frame: Image.Image, record: int, number: int) -> None:
        """Arrows, numbers, inset and cursor."""
        assert self._pin is not None
        assert self._strip is not None
        u, pin = self._layout.unit, self._pin
        size = float(pin.size[record])
        cut = size > self._largest
        drawn = min(size, self._largest)
        direction = pin.force[record] / size if size > 0.0 else np.zeros(2)
        self._arrow(frame, record, direction * drawn, cut)
        left, top, *_ = self._words
        number_text = f"{size / 1e3:.1f} kN"
        write(frame, (left, top + 8 * u), f"force in {pin.name.replace('_', ' ')}", 14 * u, INK, "lt")
        write(frame, (left, top + 36 * u), number_text, 30 * u, INK if size > 0.0 else FAINT, "lt", True)
        if cut:
            write(frame, (left, top + 134 * u), "the arrow is cut short", 13 * u, FAINT, "lt")
        if self._inset is not None:
            shown = self._scale * drawn
            arrow: Point = (-float(direction[0]) * shown, -float(direction[1]) * shown)
            self._inset.draw(frame, record, int(self._moments.back(number, TRAIL)), arrow, cut)
        self._strip.cursor(frame, float(self._time[record]), size)

    def _arrow(self, frame: Image.Image, record: int, force: np.ndarray, cut: bool) -> None:
        """Of the force, in the machine's picture."""
        assert self._pin is not None
        u, (left, top, *_) = self._layout.unit, self._layout.picture
        x, y = self._camera.pixels(np.array([self._scene.seen(self._pin, record)]))[0]
        place = (left + float(x), top + float(y))
        along = self._camera.arrow(np.array([force[0], force[1], 0.0])) / self._camera.scale * self._scale
        tip = (place[0] + float(along[0]), place[1] + float(along[1]))
        reach = 24 * u
        sheet = Sheet(
            (
                min(place[0], tip[0]) - reach,
                min(place[1], tip[1]) - reach,
                max(place[0], tip[0]) + reach,
                max(place[1], tip[1]) + reach,
            )
        )
        bore = self._pin.bore
        ring = IDEAL if bore is None else CONTACT if bore.touching[record] else FLIGHT
        sheet.disc(place, 8.0 * u, ring, "#ffffff", 1.5 * u)
        sheet.arrow(place, tip, self._colour, 8.0 * u, cut)
        sheet.onto(frame)


def title(scenario: Scenario, pin: PinView | None) -> str:
    """A run in a line."""
    words = [_spaced(type(scenario.machine).__name__)]
    if scenario.dimensions == 3:
        words[0] += " in space"
    if pin is not None and pin.bore is not None:
        words.append(f"{pin.name.replace('_', ' ')}: {_of_loose(pin.bore.pin)}")
    elif not scenario.clearance_pins:
        words.append("ideal pins")
    more = len(scenario.clearance_pins) - (pin is not None and pin.bore is not None)
    if more > 0:
        words.append(f"{more} more loose pin{'s' * (more > 1)}")
    return "  \u00b7  ".join(words)


def _of_loose(pin: ClearancePin) -> str:
    """Clearance and friction."""
    clearance = f"radial clearance {1e3 * pin.contact.bearing.clearance:.4g} mm"
    friction = pin.contact.friction
    coefficient = getattr(friction, "sliding_coefficient", None)
    if coefficient is None:
        name = _spaced(type(friction).__name__)
        return f"{clearance}, {'no friction' if name == 'frictionless' else name + ' friction'}"
    return f"{clearance}, friction {coefficient:g}"


def _spaced(name: str) -> str:
    """A class's name as words."""
    return "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name).strip()
