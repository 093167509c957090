"""A schematic drawing of any linkage: bodies, pivots, guides, actuators and loads, in postures of its range."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke
from shapely.geometry import MultiPoint

from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.load import ActingLoad, Load, LoadedPoint
from support_exudyn.model.loads.springs import SpringDamper
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.selection import as_words, machine_name
from support_exudyn.postprocessing.figures.style import CURVES, Dashes
from support_exudyn.postprocessing.look.poses import joined_points
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError, Vector2, short

GREY, START, LOAD, MARK = "#777777", "#000000", style.PAPER, style.CONTACT
BLOCK = 0.035, 0.022  # half of a block of unknown size, along and across, of the drawing's size
SMALL = 0.08  # of the drawing's size: smaller bodies have no name on them
SUPPORT = 0.028  # a pivot on the ground, of the drawing's size
ALONG, ASIDE = 0.42, 8.0  # where the name of a bar stands: share of its length, and its distance [points]
COILS, COIL, ARROW = 6, 0.02, 0.12  # of a spring, half its width; of a force: of the drawing's size
HALO = [withStroke(linewidth=2.2, foreground="white")]
SHOWN_CRANK = math.radians(50.0)  # of a crank that starts in line with its rod, where one hides the other
IN_LINE = 0.2  # sine of its angle below which it does


def machine_drawing(scenario: Scenario, marked: Sequence[str] | None = None) -> Figure:
    """Draw a scenario's linkage in the start posture; a marked pin has a ring, its name and radial clearance.

    A crank that starts in line with its rod is drawn at 50 degrees, and the drawing says so.

    Arguments:
        scenario: whose machine is drawn.
        marked: names of pins; None: all clearance pins of the scenario.

    Raises InputError for a marked pin that the machine does not have.
    """
    machine, note = scenario.machine, ""
    if isinstance(machine, SliderCrank) and abs(math.sin(machine.start_angle)) <= IN_LINE:
        scenario = replace(scenario, machine=replace(machine, start_angle=SHOWN_CRANK))
        note = f", crank drawn at {math.degrees(SHOWN_CRANK):.0f}°"
    linkage, loose = scenario.linkage, scenario.clearance_pins
    marked = tuple(loose) if marked is None else tuple(marked)
    for name in marked:
        if name not in linkage.pins:
            raise InputError(f"marked = {short(name)}: no such pin; allowed: {', '.join(linkage.pins)}")
    start = np.zeros(3 * len(linkage.bodies))
    with style.look():
        drawing = style.begin(150, 105, f"{machine_name(scenario)}, start posture{note}")
        shown = LinkageDrawing(drawing.subplots(), linkage, {}, [start])
        shown.posture(start)
        shown.names(start)
        for n, name in enumerate(marked):
            clearance = 1e3 * loose[name].contact.bearing.clearance if name in loose else 0.0
            colour = CURVES[(n - 1) % len(CURVES)][0] if n else MARK
            shown.mark(start, name, colour, f", c = {clearance:.4g} mm" if clearance else "")
        if marked:
            shown.axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return drawing


class LinkageDrawing:
    """Draws a linkage on axes in mm.

    Arguments:
        axes: on which it is drawn.
        linkage: the mechanism.
        blocks: length along and height across of what slides in a guide [m], by guide.
        reached: coordinates (3 bodies,) of postures; guides are as long as they need, the first is the start.
    """

    def __init__(
        self,
        axes: Axes,
        linkage: Linkage,
        blocks: Mapping[str, tuple[float, float]],
        reached: Sequence[Series],
    ) -> None:
        self.axes, self.linkage, self.blocks, self.reached = axes, linkage, blocks, reached
        self._kinetics, self._joints = kinetics_of(linkage), _drawn_points(linkage)
        everything = np.concatenate([self._corners(reached[0], body) for body in self._joints])
        self._size = max(float(np.ptp(everything, axis=0).max()), 1e-6)  # [mm]
        axes.set(xlabel="x [mm]", ylabel="y [mm]")
        axes.set_aspect("equal", adjustable="datalim")
        axes.margins(0.08)
        axes.grid(False)

    def at(self, position: Series, body: str, point: Vector2) -> Series:
        """The place of a point of a body in a posture (2,) [mm]."""
        place: Series = 1e3 * self._kinetics.point(position, body, point)[0]
        return place

    def _corners(self, position: Series, body: str) -> Series:
        """The places of all points of a body (n, 2) [mm]."""
        points = dict.fromkeys(self._joints[body])
        return np.reshape([self.at(position, body, point) for point in points], (-1, 2))

    def _ends(self, name: str, position: Series) -> Series:
        """Foot and head of an actuator (2, 2) [mm]."""
        one = self.linkage.actuators[name]
        ends = ((one.foot, one.foot_point), (one.head, one.head_point))
        return np.array([self.at(position, *end) for end in ends])

    def _line(self, places: Sequence[Series] | Series, **look: Any) -> None:
        self.axes.plot(*np.transpose(places), **look)

    def _write(self, text: str, place: Series, offset: tuple[float, float], **look: Any) -> None:
        """A text next to a place [mm], offset in points."""
        at = float(place[0]), float(place[1])
        self.axes.annotate(text, at, xytext=offset, textcoords="offset points", **look)

    def paths(self, positions: Sequence[Series], colour: str) -> None:
        """The paths of the traced points through postures, each with its name."""
        for name, traced in self.linkage.points.items():
            path = np.array([self.at(position, traced.body, traced.point) for position in positions])
            if np.ptp(path, axis=0).max() > self._size * 1e-6:
                self._line(path, color=colour, lw=0.9, ls="-", zorder=2)
                self._write(as_words(name), path[len(path) // 3], (3, 3), fontsize=7, color=colour)

    # --- a posture ---

    def posture(
        self, position: Series, colour: str = START, dashes: Dashes = "-", *, strong: bool = True
    ) -> None:
        """All bodies in a posture, strong or pale: plates or lines, blocks, actuators, pivots."""
        pale: dict[str, Any] = {"color": colour, "alpha": 1.0 if strong else 0.55}
        layer = 4.0 if strong else 2.5
        for name in self.linkage.slides:
            self._guide(name, position, colour, strong)
        for body in self.linkage.bodies:
            corners = _hull(self._corners(position, body))
            if len(corners) > 2:
                fill = {"fc": colour, "alpha": 0.12 if strong else 0.04}
                self.axes.add_patch(Polygon(corners, closed=True, lw=0, zorder=layer - 1, **fill))
                corners = np.vstack([corners, corners[:1]])
            mark = {"marker": "x", "ms": 5} if len(corners) == 1 else {}  # joined to nothing
            self._line(corners, ls=dashes, lw=1.8 if strong else 0.9, zorder=layer, **pale, **mark)
        for name in self.linkage.actuators:  # a thick cylinder and a thin rod
            foot, head = self._ends(name, position)
            middle = foot + 0.55 * (head - foot)
            for part, width in (((foot, middle), 3.6), ((middle, head), 1.4)):
                thick = width if strong else 0.6 * width
                self._line(part, lw=thick, solid_capstyle="butt", zorder=layer, **pale)
        if strong:
            self._pivots(position, colour)

    def _pivots(self, position: Series, colour: str) -> None:
        """Pins, ends of actuators, and triangles on hatched lines where the ground carries something."""
        linkage, size = self.linkage, SUPPORT * self._size
        ends = [(pin.second, pin.second_point) for pin in linkage.pins.values()]
        ends += [(slide.body, slide.point) for slide in linkage.slides.values() if slide.turns]
        places = [self.at(position, *end) for end in ends]
        places += [end for name in linkage.actuators for end in self._ends(name, position)]
        circle: dict[str, Any] = {"marker": "o", "ms": 4.5, "mfc": "white", "mec": colour, "mew": 1.0}
        self._line(np.reshape(places, (-1, 2)), ls="none", zorder=6, **circle)
        for x, y in self._corners(position, GROUND):
            foot = y - 1.3 * size
            grey: dict[str, Any] = {"color": GREY, "zorder": 3}
            corners = [(x, y), (x - 0.8 * size, foot), (x + 0.8 * size, foot)]
            self.axes.add_patch(Polygon(corners, closed=True, fc="white", ec=GREY, lw=0.9, zorder=3))
            self.axes.plot((x - 1.2 * size, x + 1.2 * size), (foot, foot), lw=0.9, **grey)
            starts = x + size * np.linspace(-0.9, 1.2, 5)
            self.axes.plot([starts, starts - 0.4 * size], [[foot] * 5, [foot - 0.4 * size] * 5], lw=0.6, **grey)

    def _guide(self, name: str, position: Series, colour: str, strong: bool) -> None:
        """The line of a guide, as far as it is used, and the block that slides along it."""
        slide, along = self.linkage.slides[name], self._direction(name, position)
        across = np.array([-along[1], along[0]])
        unknown = 2e-3 * BLOCK[0] * self._size, 2e-3 * BLOCK[1] * self._size
        length, height = (0.5e3 * side for side in self.blocks.get(name, unknown))
        if strong:
            origin, used = self.at(position, slide.against, slide.point), self._used(name)
            low, high = min(used) - 2.0 * length, max(used) + 2.0 * length
            off = 0.5 * height if slide.turns else height
            for side in (-off, off):
                ends = [origin + s * along + side * across for s in (low, high)]
                self._line(ends, color=GREY, lw=0.9, zorder=1.5)
        if not slide.turns:
            place = self.at(position, slide.body, slide.point)
            signs = (-1, -1), (1, -1), (1, 1), (-1, 1)
            corners = [place + s * length * along + t * height * across for s, t in signs]
            look: dict[str, Any] = {"fc": "white", "lw": 1.4, "alpha": 1.0, "zorder": 3.8}
            if not strong:
                look = {"fc": "none", "lw": 0.7, "alpha": 0.55, "zorder": 2.4}
            self.axes.add_patch(Polygon(corners, closed=True, ec=colour, **look))

    def _direction(self, name: str, position: Series) -> Series:
        """Unit vector along a guide in a posture (2,)."""
        slide = self.linkage.slides[name]
        turn = 0.0 if slide.against == GROUND else position[self._kinetics.first(slide.against) + 2]
        return np.array([math.cos(slide.direction + turn), math.sin(slide.direction + turn)])

    def _used(self, name: str) -> list[float]:
        """Where along its guide something stands in all postures, from its place at the start [mm]."""
        slide = self.linkage.slides[name]
        apart = (
            np.subtract(*(self.at(position, body, slide.point) for body in (slide.body, slide.against)))
            for position in self.reached
        )
        return [float(way @ self._direction(name, one)) for way, one in zip(apart, self.reached, strict=True)]

    # --- names ---

    def pin_names(self, position: Series) -> None:
        """The names of pins at their places; of several pins at one place together."""
        together: dict[tuple[float, ...], list[str]] = {}
        for name, pin in self.linkage.pins.items():
            near = np.round(self.at(position, pin.second, pin.second_point) / (0.02 * self._size))
            together.setdefault(tuple(near.tolist()), []).append(name)
        for names in together.values():
            pin, words = self.linkage.pins[names[0]], ", ".join(map(as_words, names))
            place = self.at(position, pin.second, pin.second_point)
            self._write(words, place, (4, 5), fontsize=7.5, zorder=7, path_effects=HALO)

    def names(self, position: Series) -> None:
        """The names of bodies on them, and of actuators along them."""
        blocks = {one.body for one in self.linkage.slides.values() if not one.turns}
        for name in self.linkage.bodies:
            corners = self._corners(position, name)
            if name in blocks:
                self._word(corners[:1], name)
            elif len(corners) == 1 or np.ptp(corners, axis=0).max() > SMALL * self._size:
                self._word(_hull(corners), name)
        for name in self.linkage.actuators:
            self._word(self._ends(name, position), name)

    def mark(self, position: Series, name: str, colour: str, more: str) -> None:
        """A ring around a pin, whose name and more words stand in the legend."""
        pin, words = self.linkage.pins[name], as_words(name)
        label = f"{words if words.endswith('pin') else f'{words} pin'}{more}"
        look: dict[str, Any] = {"ms": 12, "mfc": "none", "mec": colour, "mew": 2.0, "ls": "none", "zorder": 8}
        self._line([self.at(position, pin.second, pin.second_point)], marker="o", label=label, **look)

    def _word(self, corners: Series, name: str) -> None:
        """The name of a body: on a plate, next to a bar, below a block."""
        place, aside = corners.mean(axis=0), np.zeros(2)
        if len(corners) == 1:
            aside = np.array([-1.2 * ASIDE, 1.6 * ASIDE])
        elif len(corners) == 2:
            along = corners[1] - corners[0]
            place = corners[0] + ALONG * along
            aside = ASIDE * np.array([along[1], -along[0]]) / np.hypot(*along)
        side = "center" if abs(aside[0]) < 0.5 * ASIDE else ("left" if aside[0] > 0.0 else "right")
        look: dict[str, Any] = {"fontsize": 7, "style": "italic", "color": "#333333", "path_effects": HALO}
        offset = float(aside[0]), float(aside[1])
        self._write(as_words(name), place, offset, ha=side, va="center", zorder=5.5, **look)

    def load(self, name: str, load: ActingLoad) -> None:
        """A spring as a zigzag between its ends, another force as an arrow at its point, start posture."""
        if not isinstance(load, Load):
            return
        still = np.zeros(3 * len(self.linkage.bodies))
        end = self.at(still, load.body, load.point)
        if isinstance(load, SpringDamper):
            start = self.at(still, load.against(name), load.origin)
            along = (end - start) / np.hypot(*(end - start))
            share = np.concatenate([[0.0], np.linspace(0.2, 0.8, 2 * COILS + 1), [1.0]])
            aside = np.concatenate([[0.0, 0.0], np.tile([1.0, -1.0], COILS)[:-1], [0.0, 0.0]])
            across = COIL * self._size * np.outer(aside, (-along[1], along[0]))
            self._line(start + np.outer(share, end - start) + across, color=LOAD, lw=1.0, zorder=4.5)
            self._word(np.array([start, end]), name)
            return
        complete = LoadedPoint(max(load.breaks, default=0.0), 0.0, 0.0, 0.0, 0.0)
        force = np.array(load.numbers(complete)[:2])
        if np.hypot(*force) > 0.0:
            tail = end - ARROW * self._size * force / np.hypot(*force)
            arrow = {"arrowstyle": "-|>", "color": LOAD, "lw": 1.4, "shrinkA": 0, "shrinkB": 0}
            self.axes.annotate("", tuple(end.tolist()), tuple(tail.tolist()), arrowprops=arrow)
            self._word(np.array([tail, end]), name)


def _drawn_points(linkage: Linkage) -> dict[str, list[Vector2]]:
    """The points of each body, and of the ground, at which something is joined or traced, start posture [m].

    Of a body with fewer than two and without a guide the centre of mass, too.
    """
    joints = joined_points(linkage)
    for slide in linkage.slides.values():
        joints[slide.body].append(slide.point)
    for name, body in linkage.bodies.items():
        if len(set(joints[name])) < 2 and not any(one.body == name for one in linkage.slides.values()):
            joints[name].append(body.centre)
    return joints


def _hull(places: Series) -> Series:
    """Corners around points (n, 2); the farthest two if they lie in line."""
    shape = MultiPoint(places).convex_hull
    corners: Series = np.array(shape.exterior.coords[:-1] if shape.geom_type == "Polygon" else shape.coords)
    return corners
