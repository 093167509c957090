"""Stability maps: where a run is good, how large its error is, and where theory has its limits."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from studies.extremes.judge import GOOD, REFUSED, SILENT, Judgement
from studies.extremes.ranges import Point
from studies.extremes.scenes import (
    CLEARANCE_SPEED,
    FRICTION_STEP,
    IMPACT_STEPS,
    STEP_STIFFNESS,
    Case,
    fallen,
)
from support_exudyn.postprocessing.figures import style
from support_exudyn.scenario.timescales import timescales

SMALLEST, LARGEST = 1e-6, 1.0  # of the colours
SQUARE = 85.0  # area of the mark of a run [points^2]
ROOM = 0.04  # beside the outermost, as a share of an axis
MARKS: Mapping[str, Mapping[str, Any]] = {
    REFUSED: {"marker": "x", "color": "black", "markersize": 6},
    SILENT: {"marker": "D", "color": style.CONTACT, "markersize": 7},
}
PULL = 9.81  # [m/s^2]
MASS = 3000.0  # [kg] that moves with the journal of the rear pin
Judged = Sequence[tuple[Case, Judgement]]
Curve = tuple[str, Callable[[float], float]]


# --- limits ---


def _first_impact(point: Point) -> float:
    """The velocity of the first impact of a fall through the clearance [m/s]."""
    return math.sqrt(2.0 * PULL * point.clearance_m)


def _of_contact() -> list[Curve]:
    def duration(stiffness: float) -> float:
        point = Point(stiffness=stiffness)
        return point.normal.impact_time(_first_impact(point), MASS)

    return [
        ("duration of the first contact", duration),
        (
            f"step that is taken in it: 1/{IMPACT_STEPS} of it",
            lambda stiffness: duration(stiffness) / IMPACT_STEPS,
        ),
    ]


def _of_flight() -> list[Curve]:
    def flight(clearance: float) -> float:
        return 0.05 / math.sqrt(2.0 * clearance / PULL)

    return [("stroke as long as the fall through the clearance", flight)]


def _of_friction() -> list[Curve]:
    def rubbing(static: float) -> float:
        point = Point(mu=0.25, static_speed_m_s=static, dynamic_speed_m_s=2.0 * static)
        return timescales(fallen(point)).rubbing

    return [
        ("time constant of friction", rubbing),
        ("10 000 times as long", lambda static: 1e4 * rubbing(static)),
    ]


# --- maps ---


@dataclass(frozen=True)
class Map:
    """A map: of which group, by which values, their names and units, where the defaults are, and its limits."""

    group: str
    x: str
    y: str
    x_label: str
    y_label: str
    default: tuple[float, float]
    default_name: str
    limits: Callable[[], list[Curve]]


MAPS = {
    "step_stiffness": Map(
        STEP_STIFFNESS, "stiffness", "step_s", "contact stiffness / paper's [-]", "step [s]",
        (1.0, 5e-4), "defaults", _of_contact,
    ),
    "clearance_speed": Map(
        CLEARANCE_SPEED, "clearance_m", "speed_m_s", "clearance [m]", "speed of the columns [m/s]",
        (1.5e-3, 0.25), "the paper's case", _of_flight,
    ),
    "friction_step": Map(
        FRICTION_STEP, "static_speed_m_s", "step_s", "speed $v_s$ of the friction ramp [m/s]", "step [s]",
        (5e-3, 5e-4), "defaults", _of_friction,
    ),
}  # fmt: skip


def figures(judged: Judged) -> dict[str, Figure]:
    """All maps of which there are cases, by file name."""
    groups = {case.group for case, _ in judged}
    return {f"map_{name}": _figure(one, judged) for name, one in MAPS.items() if one.group in groups}


def _figure(one: Map, judged: Judged) -> Figure:
    drawing = Figure(figsize=style.size(150, 110))
    axes = drawing.subplots()
    found = [(case, verdict) for case, verdict in judged if case.group == one.group]
    xs, ys = ([float(case.values[name]) for case, _ in found] for name in (one.x, one.y))
    axes.set(
        xscale="log", yscale="log", xlabel=one.x_label, ylabel=one.y_label, xlim=_around(xs), ylim=_around(ys)
    )
    axes.grid(visible=False)
    errors = [
        min(max(verdict.error, SMALLEST), LARGEST) if verdict.outcome == GOOD else np.nan
        for _, verdict in found
    ]
    shown = axes.scatter(
        xs, ys, c=errors, norm=LogNorm(SMALLEST, LARGEST), cmap="viridis_r", marker="s", s=SQUARE, zorder=2
    )
    drawing.colorbar(shown, ax=axes, label="reported error of the worst number [-]")
    for outcome, mark in MARKS.items():
        here = [n for n, (_, verdict) in enumerate(found) if verdict.outcome == outcome]
        if here:
            axes.plot([xs[n] for n in here], [ys[n] for n in here], linestyle="none", label=outcome, **mark)
    along = np.geomspace(min(xs), max(xs), 200)
    for n, (name, curve) in enumerate(one.limits()):
        values = [curve(float(x)) for x in along]
        axes.plot(along, values, color="black", linestyle=("-", "--")[n], label=name, zorder=3)
    axes.plot(*one.default, "*", color="white", markeredgecolor="black", markersize=11,
              linestyle="none", label=one.default_name, zorder=4)  # fmt: skip
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return drawing


def _around(values: Sequence[float]) -> tuple[float, float]:
    """Limits of a logarithmic axis that has room for the squares of these values."""
    low, high = min(values), max(values)
    room = (high / low) ** ROOM if high > low else 10.0
    return low / room, high * room
