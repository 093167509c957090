"""A schematic drawing of any linkage: bodies, pivots, guides, actuators and loads, in postures of its way."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke
from scipy.spatial import ConvexHull, QhullError

from support_exudyn.machines.check.drive_way import DriveWay, Moved
from support_exudyn.machines.check.report import CheckReport
from support_exudyn.mechanics.kinetics import Kinetics, kinetics_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.loads.load import ActingLoad, Load, LoadedPoint
from support_exudyn.model.loads.springs import SpringDamper
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.style import CURVES, Dashes
from user_forces.values.value import Vector2

GREY, START, LOAD = "#777777", "#000000", style.PAPER
GHOSTS = 3  # further postures of a crank that turns right round
BLOCK = 0.035, 0.022  # half of a block whose size is not said, along and across, of the drawing's size
SMALL = 0.08  # of the drawing's size: smaller bodies have no name on them
SUPPORT = 0.028  # of a pivot on the ground, of the drawing's size
ALONG, BESIDE = 0.42, 8.0  # where the name of a bar stands: share of its length, and beside it [points]
COILS, COIL, ARROW = 6, 0.02, 0.12  # of a spring, half its width; of a force: of the drawing's size
HALO = [withStroke(linewidth=2.2, foreground="white")]


def draw_linkage(axes: Axes, report: CheckReport) -> None:
    """Bodies at the start, and pale ones at ends of ways or over a turn; paths of traced points."""
    kinetics = kinetics_of(report.linkage)
    size = _size(kinetics, report)
    for way, (colour, dashes) in zip(report.ways, _colours(report.ways), strict=True):
        for name, traced in report.linkage.points.items():
            path = 1e3 * np.array(
                [kinetics.point(one.position, traced.body, traced.point)[0] for one in way.moved]
            )
            if np.ptp(path, axis=0).max() > 1e-3 * size:
                axes.plot(path[:, 0], path[:, 1], color=colour, lw=0.9, ls="-", zorder=2)
                axes.annotate(
                    name,
                    path[len(path) // 3],
                    xytext=(3, 3),
                    textcoords="offset points",
                    fontsize=7,
                    color=colour,
                )
        for one in _others(way, len(report.ways) == 1):
            _bodies(_Posture(axes, kinetics, report, one.position, size, colour, dashes, strong=False))
    _bodies(_Posture(axes, kinetics, report, report.start.position, size, START, "-", strong=True))
    for name, load in report.loads.items():
        _load(axes, kinetics, name, load, size)
    _names(axes, kinetics, report, size)
    handles = [axes.plot([], [], color=START, lw=1.8, label=_start_said(report))[0]]
    for way, (colour, dashes) in zip(report.ways, _colours(report.ways), strict=True):
        others = _others(way, len(report.ways) == 1)
        said = ", ".join(f"{way.shown(one.travel):.4g}" for one in others)
        label = f"{way.label} at {said} {way.unit}"
        if others:
            handles.append(axes.plot([], [], color=colour, ls=dashes, lw=1.2, label=label)[0])
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(0.0, -0.12), ncols=2, fontsize=7.5)
    axes.set(xlabel="x [mm]", ylabel="y [mm]")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    axes.grid(False)


def _start_said(report: CheckReport) -> str:
    where = [way.at(0.0) for way in report.ways if len(way.drives) == 1]
    return "start" + (f": {', '.join(where)}" if len(where) == 1 else "")


def _colours(ways: Sequence[DriveWay]) -> list[tuple[str, Dashes]]:
    return [CURVES[n % len(CURVES)] for n in range(len(ways))]


def _others(way: DriveWay, alone: bool) -> list[Moved]:
    """Postures drawn beside the start: ends, and the middle if no other part is driven; or some of a turn."""
    if way.right_round:
        return [way.moved[round(n)] for n in np.linspace(0, len(way.moved) - 1, GHOSTS + 2)[1:-1]]
    shown = (way.moved[0], *([way.moved[len(way.moved) // 2]] if alone else []), way.moved[-1])
    return [one for one in shown if one.travel != 0.0]


def _size(kinetics: Kinetics, report: CheckReport) -> float:
    """Extent of the drawing [mm]."""
    points = [
        kinetics.point(report.start.position, body, point)[0]
        for body, points in _joints(report).items()
        for point in points
    ]
    return 1e3 * max(float(np.ptp(np.array(points), axis=0).max()), 1e-9)


def _joints(report: CheckReport) -> dict[str, list[Vector2]]:
    """Points of each body at which something is joined to it, or that are traced."""
    linkage = report.linkage
    joints: dict[str, list[Vector2]] = {name: [] for name in (GROUND, *linkage.bodies)}
    for pin in linkage.pins.values():
        joints[pin.first].append(pin.first_point)
        joints[pin.second].append(pin.second_point)
    for one in linkage.actuators.values():
        joints[one.foot].append(one.foot_point)
        joints[one.head].append(one.head_point)
    for slide in linkage.slides.values():
        joints[slide.body].append(slide.point)
    for traced in linkage.points.values():
        joints[traced.body].append(traced.point)
    for name, body in linkage.bodies.items():
        if len(set(joints[name])) < 2 and not any(one.body == name for one in linkage.slides.values()):
            joints[name].append(body.centre)
    return joints


@dataclass(frozen=True)
class _Posture:
    """A posture of a linkage and how it is drawn: strong, or pale beside another."""

    axes: Axes
    kinetics: Kinetics
    report: CheckReport
    position: Series
    size: float
    colour: str
    dashes: Dashes
    strong: bool

    def at(self, body: str, point: Vector2) -> Series:
        """Where a point of a body is (2,) [mm]."""
        place: Series = 1e3 * self.kinetics.point(self.position, body, point)[0]
        return place


def _bodies(drawn: _Posture) -> None:
    """All bodies in a posture: plates or lines between their joints, blocks, actuators, pivots."""
    axes, report, linkage, at = drawn.axes, drawn.report, drawn.report.linkage, drawn.at
    colour, dashes, strong = drawn.colour, drawn.dashes, drawn.strong
    layer, alpha = (4.0, 1.0) if strong else (2.5, 0.55)
    width = 1.8 if strong else 0.9
    _guides(drawn)
    for body, points in _joints(report).items():
        if body == GROUND:
            continue
        places = np.array([at(body, point) for point in dict.fromkeys(points)])
        corners = _hull(places)
        if len(corners) > 2:
            face = Polygon(
                corners, closed=True, fc=colour, alpha=0.12 if strong else 0.04, lw=0, zorder=layer - 1
            )
            axes.add_patch(face)
        closed = np.vstack([corners, corners[:1]]) if len(corners) > 2 else corners
        if len(corners) == 1:  # nothing is joined to it but at its centre, if at all
            axes.plot(*corners[0], "x", ms=5, color=colour, alpha=alpha, zorder=layer)
        axes.plot(closed[:, 0], closed[:, 1], color=colour, ls=dashes, lw=width, alpha=alpha, zorder=layer)
    for one in linkage.actuators.values():
        foot, head = at(one.foot, one.foot_point), at(one.head, one.head_point)
        middle = foot + 0.55 * (head - foot)
        for ends, lw in (((foot, middle), 3.6), ((middle, head), 1.4)):
            x, y = np.transpose(ends)
            lw *= 1.0 if strong else 0.6
            axes.plot(x, y, color=colour, lw=lw, alpha=alpha, solid_capstyle="butt", zorder=layer)
    if not strong:
        return
    pins = [at(pin.second, pin.second_point) for pin in linkage.pins.values()]
    for one in linkage.actuators.values():
        pins += [at(one.foot, one.foot_point), at(one.head, one.head_point)]
    for x, y in pins:
        axes.plot(x, y, "o", ms=4.5, mfc="white", mec=colour, mew=1.0, zorder=6)
    for x, y in dict.fromkeys(tuple(at(GROUND, point).tolist()) for point in _joints(report)[GROUND]):
        _support(axes, x, y, SUPPORT * drawn.size)


def _hull(places: Series) -> Series:
    """Corners around points (n, 2); the farthest two if they lie in line."""
    try:
        corners: Series = places[ConvexHull(places).vertices] if len(places) > 2 else places
    except QhullError:
        along = places - places[0]
        far = along[int(np.argmax(np.hypot(*along.T)))]
        order = np.argsort(along @ far)
        corners = places[[order[0], order[-1]]]
    return corners


def _guides(drawn: _Posture) -> None:
    """The line of each guide, as far as it is used, and what slides along it."""
    axes, kinetics, report, position = drawn.axes, drawn.kinetics, drawn.report, drawn.position
    size, colour, strong = drawn.size, drawn.colour, drawn.strong
    for name, slide in report.linkage.slides.items():
        turned = 0.0 if slide.against == GROUND else position[kinetics.first(slide.against) + 2]
        angle = slide.direction + turned
        along = np.array([math.cos(angle), math.sin(angle)])
        across = np.array([-along[1], along[0]])
        place = drawn.at(slide.body, slide.point)
        half = [
            0.5e3 * one for one in report.blocks.get(name, (2e-3 * BLOCK[0] * size, 2e-3 * BLOCK[1] * size))
        ]
        if strong:
            origin = drawn.at(slide.against, slide.point)
            used = list(_used(kinetics, report, name))
            low, high = min(used) - 2.0 * half[0], max(used) + 2.0 * half[0]
            for side in (-half[1], half[1]) if not slide.turns else (-0.5 * half[1], 0.5 * half[1]):
                ends = [origin + s * along + side * across for s in (low, high)]
                axes.plot(*np.transpose(ends), color=GREY, lw=0.9, zorder=1.5)
        if slide.turns:
            continue
        corners = [
            place + s * half[0] * along + t * half[1] * across for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))
        ]
        axes.add_patch(
            Polygon(
                corners, closed=True, fc="white" if strong else "none", ec=colour, lw=1.4 if strong else 0.7,
                alpha=1.0 if strong else 0.55, zorder=3.8 if strong else 2.4,
            )
        )  # fmt: skip
    if strong:
        for slide in report.linkage.slides.values():
            if slide.turns:
                x, y = drawn.at(slide.body, slide.point)
                axes.plot(x, y, "o", ms=5.5, mfc="white", mec=colour, mew=1.2, zorder=6)


def _used(kinetics: Kinetics, report: CheckReport, name: str) -> Iterator[float]:
    """Where along its guide something stands in all postures, from where it is at the start [mm]."""
    slide = report.linkage.slides[name]
    for one in (report.start, *(moved for way in report.ways for moved in way.moved)):
        turned = 0.0 if slide.against == GROUND else one.position[kinetics.first(slide.against) + 2]
        ends = (kinetics.point(one.position, body, slide.point)[0] for body in (slide.body, slide.against))
        x, y = np.subtract(*ends)
        angle = slide.direction + turned
        yield 1e3 * float(x * math.cos(angle) + y * math.sin(angle))


def _support(axes: Axes, x: float, y: float, size: float) -> None:
    """A pivot on the ground: a triangle on a hatched line."""
    foot = y - 1.3 * size
    corners = [(x, y), (x - 0.8 * size, foot), (x + 0.8 * size, foot)]
    axes.add_patch(Polygon(corners, closed=True, fc="white", ec=GREY, lw=0.9, zorder=3))
    axes.plot((x - 1.2 * size, x + 1.2 * size), (foot, foot), color=GREY, lw=0.9, zorder=3)
    for step in np.linspace(-0.9, 1.2, 5):
        start = x + step * size
        axes.plot((start, start - 0.4 * size), (foot, foot - 0.4 * size), color=GREY, lw=0.6, zorder=3)


def _names(axes: Axes, kinetics: Kinetics, report: CheckReport, size: float) -> None:
    """Names of pins beside them, of bodies on them, of actuators along them, each once."""
    linkage, position = report.linkage, report.start.position
    together: dict[tuple[int, int], list[str]] = {}
    places = {
        name: 1e3 * kinetics.point(position, pin.second, pin.second_point)[0]
        for name, pin in linkage.pins.items()
    }
    for name, (x, y) in places.items():
        together.setdefault((round(x / (0.02 * size)), round(y / (0.02 * size))), []).append(name)
    for names in together.values():
        axes.annotate(
            ", ".join(names), tuple(places[names[0]].tolist()), xytext=(4, 5), textcoords="offset points",
            fontsize=7.5, zorder=7, path_effects=HALO,
        )  # fmt: skip
    blocks = {one.body for one in linkage.slides.values() if not one.turns}
    for name, points in _joints(report).items():
        corners = 1e3 * np.array([kinetics.point(position, name, one)[0] for one in dict.fromkeys(points)])
        if name in blocks:
            _word(axes, corners[:1], name)
        elif name != GROUND and (len(corners) == 1 or np.ptp(corners, axis=0).max() > SMALL * size):
            _word(axes, _hull(corners), name)
    for name, one in linkage.actuators.items():
        ends = ((one.foot, one.foot_point), (one.head, one.head_point))
        _word(axes, 1e3 * np.array([kinetics.point(position, *end)[0] for end in ends]), name)


def _word(axes: Axes, corners: Series, name: str) -> None:
    """The name of a body: on a plate, beside a bar, below a block."""
    place, aside = corners.mean(axis=0), np.zeros(2)
    if len(corners) == 1:
        aside = np.array([-1.2 * BESIDE, 1.6 * BESIDE])
    elif len(corners) == 2:
        along = corners[1] - corners[0]
        place, aside = corners[0] + ALONG * along, BESIDE * np.array([along[1], -along[0]]) / np.hypot(*along)
    side = "center" if abs(aside[0]) < 0.5 * BESIDE else ("left" if aside[0] > 0.0 else "right")
    axes.annotate(
        name, (float(place[0]), float(place[1])), xytext=(float(aside[0]), float(aside[1])),
        textcoords="offset points", fontsize=7,
        style="italic", ha=side, va="center", color="#333333", zorder=5.5, path_effects=HALO,
    )  # fmt: skip


def _load(axes: Axes, kinetics: Kinetics, name: str, load: ActingLoad, size: float) -> None:
    """A spring as a zigzag between its ends, another force as an arrow at its point, in the start posture."""
    still = np.zeros(3 * len(kinetics.linkage.bodies))
    if not isinstance(load, Load):
        return
    end = 1e3 * kinetics.point(still, load.body, load.point)[0]
    if isinstance(load, SpringDamper):
        start = 1e3 * kinetics.point(still, load.against(name), load.origin)[0]
        along = (end - start) / np.hypot(*(end - start))
        share = np.concatenate([[0.0, 0.2], np.linspace(0.2, 0.8, 2 * COILS + 1)[1:-1], [0.8, 1.0]])
        aside = np.concatenate([[0.0, 0.0], np.tile([1.0, -1.0], COILS)[: 2 * COILS - 1], [0.0, 0.0]])
        x, y = (
            start[:, None] + np.outer(end - start, share) + COIL * size * np.outer((-along[1], along[0]), aside)
        )
        axes.plot(x, y, color=LOAD, lw=1.0, zorder=4.5)
        _word(axes, np.array([start, end]), name)
        return
    come_on = LoadedPoint(max(load.breaks, default=0.0), 0.0, 0.0, 0.0, 0.0)
    force = np.array(load.acting(come_on).forces[:2])
    if np.hypot(*force) > 0.0:
        tail = end - ARROW * size * force / np.hypot(*force)
        arrow = {"arrowstyle": "-|>", "color": LOAD, "lw": 1.4, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (float(end[0]), float(end[1])), (float(tail[0]), float(tail[1])), arrowprops=arrow)
        _word(axes, np.array([tail, end]), name)
