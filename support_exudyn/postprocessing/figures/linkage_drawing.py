"""A schematic drawing of any linkage: bodies, pivots, guides, actuators and loads, in postures of its range."""

from __future__ import annotations

import math
from collections.abc import Sequence
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
SMALL, ARROW = 0.08, 0.12  # bodies without a name on them, arrow of a force: of the drawing's size
NEAR = 0.15, 0.04  # pins closer than that, along x and y, of the drawing's size, have names on either side
ALONG, ASIDE = 0.42, 8.0  # where the name of a bar stands: share of its length, and its distance [points]
SUPPORT = [(0.0, 0.0), (-0.6, -1.0), (0.6, -1.0), (0.0, 0.0)]  # marker of a pivot on the ground
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
        shown = LinkageDrawing(drawing.subplots(), linkage, [start])
        shown.posture(start)
        shown.names(start)
        for n, name in enumerate(marked):
            clearance = 1e3 * loose[name].contact.bearing.clearance if name in loose else 0.0
            words, colour = as_words(name), CURVES[(n - 1) % len(CURVES)][0] if n else MARK
            label = words if words.endswith("pin") else f"{words} pin"
            label += f", c = {clearance:.4g} mm" if clearance else ""
            place = shown.at(start, linkage.pins[name].second, linkage.pins[name].second_point)
            ring: dict[str, Any] = {"ms": 12, "mfc": "none", "mec": colour, "mew": 2.0, "zorder": 8}
            shown.axes.plot(*place[:, None], "o", label=label, **ring)
        if marked:
            shown.axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    return drawing


class LinkageDrawing:
    """Draws a linkage on axes in mm.

    Arguments:
        axes: on which it is drawn.
        linkage: the mechanism.
        reached: coordinates (3 bodies,) of postures; guides are as long as they need, the first is the start.
    """

    def __init__(self, axes: Axes, linkage: Linkage, reached: Sequence[Series]) -> None:
        self.axes, self.linkage, self.reached = axes, linkage, reached
        self._kinetics, self._joints = kinetics_of(linkage), joined_points(linkage)
        for slide in linkage.slides.values():
            self._joints[slide.body].append(slide.point)
        for name, body in linkage.bodies.items():
            if len(set(self._joints[name])) < 2 and all(one.body != name for one in linkage.slides.values()):
                self._joints[name].append(body.centre)
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
        """The places of all points of a body at which something is joined or traced (n, 2) [mm]."""
        points = dict.fromkeys(self._joints[body])
        return np.reshape([self.at(position, body, point) for point in points], (-1, 2))

    def _ends(self, name: str, position: Series) -> Series:
        """Foot and head of an actuator (2, 2) [mm]."""
        one = self.linkage.actuators[name]
        ends = ((one.foot, one.foot_point), (one.head, one.head_point))
        return np.array([self.at(position, *end) for end in ends])

    def _write(self, text: str, place: Series, offset: tuple[float, float], **look: Any) -> None:
        """A text next to a place [mm], offset in points."""
        at = float(place[0]), float(place[1])
        self.axes.annotate(text, at, xytext=offset, textcoords="offset points", **look)

    def paths(self, positions: Sequence[Series], colour: str) -> None:
        """The paths of the traced points through postures, each with its name."""
        for name, traced in self.linkage.points.items():
            path = np.array([self.at(position, traced.body, traced.point) for position in positions])
            if np.ptp(path, axis=0).max() > self._size * 1e-6:
                self.axes.plot(*path.T, color=colour, lw=0.9, zorder=2)
                self._write(as_words(name), path[len(path) // 3], (3, 3), fontsize=7, color=colour)

    # --- a posture ---

    def posture(
        self, position: Series, colour: str = START, dashes: Dashes = "-", *, strong: bool = True
    ) -> None:
        """All bodies in a posture, strong or pale: plates or lines, blocks, actuators, pivots."""
        layer = 4.0 if strong else 2.5
        pale: dict[str, Any] = {"color": colour, "alpha": 1.0 if strong else 0.55, "zorder": layer}
        for body in self.linkage.bodies:
            corners = _hull(self._corners(position, body))
            if len(corners) > 2:
                alpha = 0.12 if strong else 0.04
                plate = Polygon(corners, closed=True, lw=0, fc=colour, alpha=alpha, zorder=layer - 1)
                self.axes.add_patch(plate)
                corners = np.vstack([corners, corners[:1]])
            mark: dict[str, Any] = {"marker": "x", "ms": 5} if len(corners) == 1 else {}  # joined to nothing
            self.axes.plot(*corners.T, ls=dashes, lw=1.8 if strong else 0.9, **pale, **mark)
        for name in self.linkage.actuators:  # a thick cylinder and a thin rod
            foot, head = self._ends(name, position)
            middle = foot + 0.55 * (head - foot)
            for part, width in (((foot, middle), 3.6), ((middle, head), 1.4)):
                thick = width if strong else 0.6 * width
                self.axes.plot(*np.transpose(part), lw=thick, solid_capstyle="butt", **pale)
        for name, slide in self.linkage.slides.items():
            if not slide.turns:
                block: dict[str, Any] = {"ms": 15 if strong else 9, "mfc": "white" if strong else "none"}
                self.axes.plot(*self.at(position, slide.body, slide.point)[:, None], "s", **pale, **block)
            if strong:
                self._guide(name, position)
        if strong:
            self._pivots(position, colour)

    def _guide(self, name: str, position: Series) -> None:
        """The line of a guide, as far as it is used in all postures and a little farther."""
        slide = self.linkage.slides[name]

        def along(one: Series) -> Series:
            turn = 0.0 if slide.against == GROUND else one[self._kinetics.first(slide.against) + 2]
            return np.array([math.cos(slide.direction + turn), math.sin(slide.direction + turn)])

        used = [
            (self.at(one, slide.body, slide.point) - self.at(one, slide.against, slide.point)) @ along(one)
            for one in self.reached
        ]
        far, origin = 0.07 * self._size, self.at(position, slide.against, slide.point)
        ends = [origin + s * along(position) for s in (min(used) - far, max(used) + far)]
        self.axes.plot(*np.transpose(ends), color=GREY, lw=4.0, alpha=0.4, zorder=1.5)

    def _pivots(self, position: Series, colour: str) -> None:
        """Pins, ends of actuators, and triangles where the ground carries something."""
        linkage = self.linkage
        ends = [(pin.second, pin.second_point) for pin in linkage.pins.values()]
        ends += [(slide.body, slide.point) for slide in linkage.slides.values() if slide.turns]
        places = [self.at(position, *end) for end in ends]
        places += [end for name in linkage.actuators for end in self._ends(name, position)]
        circle: dict[str, Any] = {"ms": 4.5, "mfc": "white", "mec": colour, "mew": 1.0, "zorder": 6}
        self.axes.plot(*np.reshape(places, (-1, 2)).T, "o", **circle)
        ground: dict[str, Any] = {"ms": 18, "mfc": "white", "mec": GREY, "mew": 0.9, "ls": "none", "zorder": 3}
        self.axes.plot(*self._corners(position, GROUND).T, marker=SUPPORT, **ground)

    # --- names and loads ---

    def pin_names(self, position: Series) -> None:
        """The names of pins at their places; of several pins at one place together.

        A name stands on the right of its pin, or on the left if another name stands on the right.
        """
        together: dict[tuple[float, ...], list[str]] = {}
        for name, pin in self.linkage.pins.items():
            near = np.round(self.at(position, pin.second, pin.second_point) / (0.02 * self._size))
            together.setdefault(tuple(near.tolist()), []).append(name)
        firsts = {names[0]: self.linkage.pins[names[0]] for names in together.values()}
        places = {name: self.at(position, pin.second, pin.second_point) for name, pin in firsts.items()}
        for names in together.values():
            apart = [(place - places[names[0]]) / self._size for place in places.values()]
            is_left = any(0.0 < right < NEAR[0] and abs(up) < NEAR[1] for right, up in apart)
            look: dict[str, Any] = {"fontsize": 7.5, "zorder": 7, "path_effects": HALO}
            offset, look["ha"] = ((-4, 5), "right") if is_left else ((4, 5), "left")
            self._write(", ".join(map(as_words, names)), places[names[0]], offset, **look)

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

    def _word(self, corners: Series, name: str) -> None:
        """The name of a body: on a plate, next to a bar, next to a block."""
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
        """A spring as a dotted line between its ends, another force as an arrow at its point, start posture."""
        if not isinstance(load, Load):
            return
        still = np.zeros(3 * len(self.linkage.bodies))
        end = self.at(still, load.body, load.point)
        if isinstance(load, SpringDamper):
            tail, arrow = self.at(still, load.against(name), load.origin), {"arrowstyle": "-", "ls": ":"}
        else:
            force = np.array(load.numbers(LoadedPoint(max(load.breaks, default=0.0), 0.0, 0.0, 0.0, 0.0))[:2])
            if not np.hypot(*force) > 0.0:
                return
            tail, arrow = end - ARROW * self._size * force / np.hypot(*force), {"arrowstyle": "-|>"}
        shape: dict[str, Any] = arrow | {"color": LOAD, "lw": 1.4, "shrinkA": 0, "shrinkB": 0}
        self.axes.annotate("", tuple(end.tolist()), tuple(tail.tolist()), arrowprops=shape)
        self._word(np.array([tail, end]), name)


def _hull(places: Series) -> Series:
    """Corners around points (n, 2); the farthest two if they lie in line."""
    shape = MultiPoint(places).convex_hull
    corners: Series = np.array(shape.exterior.coords[:-1] if shape.geom_type == "Polygon" else shape.coords)
    return corners
