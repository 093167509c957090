"""A drawing of a machine from its side: bodies, pins, actuators, and the bore of a clearance pin, enlarged."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch
from matplotlib.patheffects import withStroke
from shapely.geometry import LineString, Point, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import polylabel

from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.pins import ClearancePin
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.outlines import LAYERS, Shape, parts, path, shapes
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.plain import MARGIN, bore_radius, extent
from support_exudyn.postprocessing.look.poses import PlacedPin, planar_pins
from support_exudyn.postprocessing.look.solid import COLOURS, EDGE, Colour, Role
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError, Vector2, short

WIDTH_MM, HIGHEST_MM = 130.0, 110.0
EDGE_MM, UNDER_MM, HATCH_MM = 3.0, 10.0, 2.2
PALE = 0.4  # share of white in the colours of bodies, so that words on them are read
SHOWN_CRANK = math.radians(50.0)  # of a crank that starts in line with its rod, where one hides the other
IN_LINE = 0.2  # sine of its angle below which it does
# the detail: circle, bore in it, and words on its right [mm]
CIRCLE_MM, BORE_MM, WORDS_MM = 15.0, 10.5, (43.0, 15.0)
DRAWN_CLEARANCE = 0.25  # about which the detail shows the clearance, of the bore's radius
LARGE, SMALL, LETTER_MM, LINE_MM = 8.0, 7.0, 1.35, 3.0  # letters [points]; of a small one width and height
STEEPEST = math.radians(-70.0)  # of words that go down
GREY, MARK = "#555555", style.CONTACT
HALO = [withStroke(linewidth=2.2, foreground="white")]


def machine_drawing(scenario: Scenario, marked: Sequence[str] | None = None) -> Figure:
    """Draw a scenario's machine from its side in the start posture, forward to the right.

    Bodies are filled outlines and pins are discs; a marked pin has a ring, and its name and radial clearance
    beside it. A detail shows the bore of the first marked clearance pin with its clearance enlarged. A crank
    that starts in line with its rod is drawn at 50 degrees, and the drawing says so.

    Arguments:
        scenario: whose machine is drawn.
        marked: names of pins; None: all clearance pins of the scenario.

    Raises InputError for a marked pin that the machine does not have.
    """
    shown, note = _not_in_line(scenario)
    pins = planar_pins(shown)
    marked = tuple(shown.clearance_pins) if marked is None else tuple(marked)
    for name in marked:
        if name not in pins:
            raise InputError(f"marked = {short(name)}: no such pin; allowed: {', '.join(pins)}")
    detailed = next((pins[name] for name in marked if pins[name].with_clearance), None)
    drawn = look(shown)
    with style.look():
        sheet = _Sheet(shapes(drawn), drawn.floor, detailed)
        sheet.bodies()
        sheet.pins(shown, pins, marked)
        sheet.scale(note)
    return sheet.figure


def _not_in_line(scenario: Scenario) -> tuple[Scenario, str]:
    """The scenario in a posture in which nothing hides the rest, and words that say so."""
    machine = scenario.machine
    if not isinstance(machine, SliderCrank) or abs(math.sin(machine.start_angle)) > IN_LINE:
        return scenario, ""
    turned = replace(scenario, machine=replace(machine, start_angle=SHOWN_CRANK))
    return turned, f"crank drawn at {math.degrees(SHOWN_CRANK):.0f}°"


class _Sheet:
    """The drawing, in metres; floor: height of the ground [m]; detailed: the pin whose bore is enlarged."""

    def __init__(self, drawn: Sequence[Shape], floor: float, detailed: PlacedPin | None) -> None:
        self.shapes, self.detailed = drawn, detailed
        self.whole = shapely.unary_union([shape.outline for shape in drawn])
        left, low, right, high = self.whole.bounds
        self.mm = max((right - left) / (WIDTH_MM - 2.0 * EDGE_MM), (high - low) / HIGHEST_MM)  # on paper [m]
        middle, half = 0.5 * (left + right), 0.5 * WIDTH_MM * self.mm
        self.left, self.right = middle - half, middle + half
        self.stands = low > floor - self.mm
        self.floor = floor if self.stands else low
        self.detail_place = self._free_place()  # centre of its circle
        top = max(high, self.detail_place[1] + CIRCLE_MM * self.mm) if detailed else high
        self.low, self.high = self.floor - UNDER_MM * self.mm, top + EDGE_MM * self.mm
        self.figure = Figure(figsize=style.size(WIDTH_MM, (self.high - self.low) / self.mm))
        self.figure.set_layout_engine("none")
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set(xlim=(self.left, self.right), ylim=(self.low, self.high))
        self.axes.set_axis_off()
        self.taken: list[BaseGeometry] = []  # by words

    def _free_place(self) -> Vector2:
        """The centre of the detail: above the machine, where it needs the least height, left if possible."""
        mm, (wide, high) = self.mm, WORDS_MM
        boxes = ((-CIRCLE_MM, CIRCLE_MM, -CIRCLE_MM), (CIRCLE_MM, CIRCLE_MM + wide, CIRCLE_MM - high))
        found: list[Vector2] = []
        for x in np.arange(
            self.left + (EDGE_MM + CIRCLE_MM) * mm, self.right - (CIRCLE_MM + wide) * mm, 2.0 * mm
        ):
            heights = []
            for start, end, bottom in boxes:
                below = self.whole.intersection(box(x + start * mm, -1e9, x + end * mm, 1e9))
                heights.append((self.floor if below.is_empty else below.bounds[3]) - (bottom - 2.0) * mm)
            found.append((float(x), max(heights)))
        return min(found, key=lambda place: (round(place[1] / mm), place[0]))

    # --- bodies ---

    def bodies(self) -> None:
        """Fill all outlines, and write the names of bodies where there is room on what is seen of them."""
        wide, mm = self.right - self.left, self.mm
        if self.stands:
            self.axes.axhline(self.floor, color=GREY, lw=0.8, zorder=1)
            self._hatch(box(self.left - wide, self.floor - HATCH_MM * mm, self.right + wide, self.floor))
        for n, shape in enumerate(self.shapes):
            colour = (*_pale(COLOURS[shape.role]), LAYERS[shape.role])
            self.axes.add_patch(PathPatch(path(shape.outline), fc=colour, ec=EDGE, lw=0.6, zorder=2))
            if shape.role is Role.BASE and not self.stands:
                self._hatch(shape.outline)
            in_front = shapely.unary_union([other.outline for other in self.shapes[n + 1 :]])
            self._name(shape, shape.outline.difference(in_front))

    def _hatch(self, area: BaseGeometry) -> None:
        """Mark an area as ground."""
        self.axes.add_patch(PathPatch(path(area), fc="none", ec="#888888", lw=0.0, hatch="//////", zorder=2))

    def _name(self, shape: Shape, seen: BaseGeometry) -> None:
        """Write a body's name along what is seen of it, if it fits."""
        text = shape.name.replace("_", " ")
        regions = parts(seen)
        if shape.role is Role.ROD or not regions:
            return
        region = max(regions, key=lambda part: part.area)
        long, high = (LETTER_MM * len(text) + 1.0) * self.mm, LINE_MM * self.mm
        for x, y, angle in _places(region, self.mm):
            c, s = 0.5 * long * math.cos(angle), 0.5 * long * math.sin(angle)
            area = LineString([(x - c, y - s), (x + c, y + s)]).buffer(0.5 * high, cap_style="flat")
            if region.contains(area):
                self.axes.text(
                    x, y, text, fontsize=SMALL, rotation=math.degrees(angle), rotation_mode="anchor",
                    ha="center", va="center_baseline", color="#222222", zorder=4,
                )  # fmt: skip
                self.taken.append(area)
                return

    # --- pins ---

    def pins(self, scenario: Scenario, pins: Mapping[str, PlacedPin], marked: Sequence[str]) -> None:
        """Discs at all pins, diamonds at traced points, rings and words at the marked pins."""
        mm, margin = self.mm, MARGIN * extent(scenario.linkage)
        centres = {name: pin.journal.point[:2] for name, pin in pins.items()}
        rings: dict[str, float] = {}
        for name, centre in centres.items():
            radius = max(bore_radius(scenario, name, margin), 1.0 * mm)
            self.axes.add_patch(Circle(centre, radius, fc="white", ec=EDGE, lw=0.8, zorder=5))
            self.axes.add_patch(Circle(centre, min(0.3 * radius, 0.7 * mm), fc=EDGE, lw=0.0, zorder=5))
            self.taken.append(Point(centre).buffer(radius))
            if name in marked:
                rings[name] = max(3.4 * mm, radius + 1.2 * mm)
                for colour, width in (("white", 3.4), (MARK, 2.0)):
                    self.axes.add_patch(Circle(centre, rings[name], fc="none", ec=colour, lw=width, zorder=6))
                self.taken.append(Point(centre).buffer(rings[name]))
        if self.detailed is not None and self.detailed.with_clearance is not None:
            name = self.detailed.name
            self._detail(centres[name], rings[name], name, self.detailed.with_clearance)
        for name in marked:
            if pins[name] is not self.detailed:
                self._beside(centres[name], rings[name] + 0.8 * mm, _words(name, pins[name]), MARK, bold=True)
        for name, traced in scenario.linkage.points.items():
            if all(math.dist(traced.point, centre) > mm for centre in centres.values()):
                self.axes.plot(
                    *traced.point, "D", ms=4.0, mfc="white", mec=EDGE, mew=0.8, zorder=5, clip_on=False
                )
                self._beside(traced.point, 1.5 * mm, name.replace("_", " "), "#222222")

    def _beside(self, place: Vector2, away: float, text: str, colour: str, *, bold: bool = False) -> None:
        """Write a text beside a place, on the side where it covers least."""
        mm, size = self.mm, LARGE if bold else SMALL
        long, high = LETTER_MM * (1.2 if bold else 1.0) * len(text) * mm, LINE_MM * mm
        sheet = box(self.left, self.floor, self.right, self.high)
        best: tuple[float, Vector2] | None = None
        for up in (0.0, 1.0, -1.0, 0.7, -0.7):
            for side in (1.0, -1.0) if abs(up) < 1.0 else (0.0,):
                across = math.sqrt(1.0 - up**2)
                x = place[0] + side * (across * away + 0.5 * long)
                y = place[1] + up * (away + 0.5 * high)
                area = box(x - 0.5 * long, y - 0.5 * high, x + 0.5 * long, y + 0.5 * high)
                covered = area.intersection(self.whole).area
                cost = covered + 20.0 * (area.area - area.intersection(sheet).area)
                cost += 10.0 * sum(area.intersection(other).area for other in self.taken)
                if best is None or cost < best[0] - 1e-3 * area.area:
                    best = cost, (x, y)
        assert best is not None  # there are sides
        x, y = best[1]
        self.axes.text(
            x, y, text, fontsize=size, color=colour, weight="bold" if bold else "normal", ha="center",
            va="center_baseline", zorder=8, path_effects=HALO,
        )  # fmt: skip
        self.taken.append(box(x - 0.5 * long, y - 0.5 * high, x + 0.5 * long, y + 0.5 * high))

    # --- detail ---

    def _detail(self, centre: Vector2, ring: float, name: str, pin: ClearancePin) -> None:
        """The bore and the journal of a pin, the clearance enlarged so that it is seen."""
        mm, (x, y), bearing = self.mm, self.detail_place, pin.contact.bearing
        bore = BORE_MM * mm
        larger = _round(DRAWN_CLEARANCE * bearing.bore_radius / bearing.clearance)
        gap = bore * larger * bearing.clearance / bearing.bore_radius
        rim, way = CIRCLE_MM * mm, math.dist(centre, (x, y))
        start = [centre[n] + (self.detail_place[n] - centre[n]) * ring / way for n in (0, 1)]
        end = [self.detail_place[n] - (self.detail_place[n] - centre[n]) * rim / way for n in (0, 1)]
        self.axes.plot([start[0], end[0]], [start[1], end[1]], color=MARK, lw=0.8, zorder=6)
        self.taken.append(box(x - rim, y - rim, x + rim + WORDS_MM[0] * mm, y + rim))
        self.axes.add_patch(Circle((x, y), rim, fc=_pale(COLOURS[Role.BASE]), ec=MARK, lw=1.4, zorder=6))
        self.axes.add_patch(Circle((x, y), bore, fc="white", ec=EDGE, lw=1.0, zorder=6))
        off = [larger * part / bearing.bore_radius * bore for part in pin.eccentricity]
        journal = x + off[0], y + off[1]
        self.axes.add_patch(Circle(journal, bore - gap, fc="#d5d5d5", ec=EDGE, lw=1.0, zorder=6))
        self.axes.plot(*journal, "+", color=EDGE, ms=5.0, mew=0.8, zorder=7)
        arrow = {"arrowstyle": "-|>", "color": MARK, "lw": 1.0, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6}
        for tail, tip in (
            (x + bore + 4.0 * mm, x + bore),
            (journal[0] + bore - gap - 4.0 * mm, journal[0] + bore - gap),
        ):
            self.axes.annotate("", (tip, y), (tail, y), arrowprops=arrow, zorder=7)
        self.axes.text(
            journal[0] + bore - gap - 4.6 * mm, y, "c", color=MARK, fontsize=LARGE, weight="bold", ha="right",
            va="center_baseline", zorder=7,
        )  # fmt: skip
        lines = (
            (_pin(name), MARK, "bold"),
            (f"radial clearance c = {1e3 * bearing.clearance:.4g} mm", "#222222", "normal"),
            (f"bore diameter {2e3 * bearing.bore_radius:.4g} mm", "#222222", "normal"),
            (f"(clearance drawn {larger:g} times larger)", GREY, "normal"),
        )
        for n, (text, colour, weight) in enumerate(lines):
            self.axes.text(
                x + (CIRCLE_MM + 2.0) * mm, y + (CIRCLE_MM - 1.5 - 3.7 * n) * mm, text, color=colour,
                weight=weight, fontsize=LARGE if n == 0 else SMALL, va="center", zorder=8, path_effects=HALO,
            )  # fmt: skip

    def scale(self, note: str) -> None:
        """A bar of a round length, an arrow that says which way is forward, and a note."""
        mm = self.mm
        y = self.low + 3.0 * mm
        long, start = _round(0.2 * WIDTH_MM * mm), self.left + EDGE_MM * mm
        self.axes.plot([start, start + long], [y, y], color=EDGE, lw=1.6, solid_capstyle="butt")
        text = f"{long:g} m" if long >= 1.0 else f"{1e3 * long:g} mm"
        line: dict[str, Any] = {"fontsize": SMALL, "va": "center_baseline", "color": EDGE}
        self.axes.text(start + long + 1.5 * mm, y, text, **line)
        end = self.right - EDGE_MM * mm
        self.axes.annotate(
            "",
            (end, y),
            (end - 14.0 * mm, y),
            arrowprops={"arrowstyle": "-|>", "color": EDGE, "lw": 1.2, "shrinkA": 0, "shrinkB": 0},
        )
        self.axes.text(end - 15.5 * mm, y, "forward", ha="right", **line)
        self.axes.text(0.5 * (self.left + self.right), y, note, ha="center", **line)


def _places(region: BaseGeometry, tolerance: float) -> list[tuple[float, float, float]]:
    """Where words may stand in a region: x, y, angle [rad]; first level, then along its longer side."""
    inner = polylabel(region, tolerance)
    corners = np.array(region.minimum_rotated_rectangle.exterior.coords)
    sides = np.diff(corners, axis=0)[:2]
    u, v = sides[int(np.argmax(np.hypot(*sides.T)))]
    angle = (math.atan2(v, u) - STEEPEST) % math.pi + STEEPEST
    middle = corners[:-1].mean(axis=0)
    shares = [(along, across) for across in (0.0, -0.2, 0.2) for along in (0.0, -0.15, 0.15, -0.3, 0.3)]
    short_side = sides[int(np.argmin(np.hypot(*sides.T)))]
    points = [(inner.x, inner.y)]
    points += [tuple(middle + along * np.array((u, v)) + across * short_side) for along, across in shares]
    return [(*point, turn) for turn in (0.0, angle) for point in points]


def _pin(name: str) -> str:
    """A pin's name in words."""
    words = name.replace("_", " ")
    return words if words.endswith("pin") else f"{words} pin"


def _words(name: str, pin: PlacedPin) -> str:
    """A marked pin's name and clearance."""
    words = _pin(name)
    if pin.with_clearance is None:
        return words
    return f"{words}, c = {1e3 * pin.with_clearance.contact.bearing.clearance:.4g} mm"


def _round(value: float) -> float:
    """The largest of 1, 2, 3, 4, 5, 6, 8 times a power of ten that is not above a value."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(
        step * power for step in (8.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0) if step * power <= value * (1.0 + 1e-9)
    )


def _pale(colour: Colour) -> Colour:
    red, green, blue = (part + PALE * (1.0 - part) for part in colour)
    return red, green, blue
