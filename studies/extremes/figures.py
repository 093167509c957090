"""Stability maps: where a run is good, how large its error is, and where theory has its limits."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from studies.common.panels import finish, grid
from studies.extremes.drawn import Point
from studies.extremes.judge import GOOD, REFUSED, SILENT, Judgement
from studies.extremes.scenes import (
    CLEARANCE_SPEED,
    FRICTION_STEP,
    IMPACT_STEPS,
    STEP_STIFFNESS,
    STROKE,
    Case,
    fallen,
)
from support_exudyn.postprocessing.figures import style
from support_exudyn.scenario.timescales import timescales

SMALLEST, LARGEST = 1e-6, 1.0  # of the colours
SQUARE = 85.0  # area of the mark of a run [points^2]
ROOM = 0.04  # around the outermost, as a share of an axis
MARKS: Mapping[str, Mapping[str, Any]] = {
    REFUSED: {"marker": "x", "color": "black", "markersize": 6},
    SILENT: {"marker": "D", "color": style.CONTACT, "markersize": 7},
}
PULL = 9.81  # [m/s^2]
MASS = 3000.0  # [kg] that moves with the journal of the rear pin
Judged = Sequence[tuple[Case, Judgement]]


def _contact_time(stiffness: float) -> float:
    """Duration [s] of the first contact after the fall."""
    point = Point(stiffness=stiffness)
    return point.normal.impact_time(math.sqrt(2.0 * PULL * point.clearance_m), MASS)


def _rubbing_time(static: float) -> float:
    """Time constant [s] of friction whose ramp begins at a speed [m/s]."""
    point = Point(mu=0.25, static_speed_m_s=static, dynamic_speed_m_s=2.0 * static)
    return timescales(fallen(point)).rubbing


@dataclass(frozen=True)
class Map:
    """A map: of which group, by which values, their labels, where the defaults are, and its limits by name."""

    group: str
    x: str
    y: str
    x_label: str
    y_label: str
    default: tuple[float, float]
    default_name: str
    limits: Mapping[str, Callable[[float], float]]


MAPS = {
    "step_stiffness": Map(
        STEP_STIFFNESS, "stiffness", "step_s", "contact stiffness / paper's [-]", "step [s]",
        (1.0, 5e-4), "defaults",
        {
            "duration of the first contact": _contact_time,
            f"step that is taken in it: 1/{IMPACT_STEPS} of it": lambda k: _contact_time(k) / IMPACT_STEPS,
        },
    ),
    "clearance_speed": Map(
        CLEARANCE_SPEED, "clearance_m", "speed_m_s", "clearance [m]", "speed of the columns [m/s]",
        (1.5e-3, 0.25), "the paper's case",
        {"stroke as long as the fall through the clearance": lambda c: STROKE / math.sqrt(2.0 * c / PULL)},
    ),
    "friction_step": Map(
        FRICTION_STEP, "static_speed_m_s", "step_s", "speed $v_s$ of the friction ramp [m/s]", "step [s]",
        (5e-3, 5e-4), "defaults",
        {"time constant of friction": _rubbing_time, "10 000 times as long": lambda v: 1e4 * _rubbing_time(v)},
    ),
}  # fmt: skip


def figures(judged: Judged) -> dict[str, Figure]:
    """All maps of which there are cases, by file name."""
    groups = {case.group for case, _ in judged}
    maps = {f"map_{name}": _figure(one, judged) for name, one in MAPS.items() if one.group in groups}
    return {"map_solvers": solver_figure(judged)} | maps


def _figure(one: Map, judged: Judged) -> Figure:
    """Squares of the colour of the error, marks of what is not good, limits and the defaults."""
    drawing = Figure(figsize=style.size(150, 110))
    axes = drawing.subplots()
    found = [(case, verdict) for case, verdict in judged if case.group == one.group]
    xs, ys = (np.array([float(case.values[name]) for case, _ in found]) for name in (one.x, one.y))
    axes.set(
        xscale="log", yscale="log", xlabel=one.x_label, ylabel=one.y_label, xlim=_around(xs), ylim=_around(ys)
    )
    axes.grid(visible=False)
    outcomes = np.array([verdict.outcome for _, verdict in found])
    errors = np.clip([verdict.error for _, verdict in found], SMALLEST, LARGEST)
    shown = axes.scatter(
        xs, ys, c=np.where(outcomes == GOOD, errors, np.nan), norm=LogNorm(SMALLEST, LARGEST),
        cmap="viridis_r", marker="s", s=SQUARE, zorder=2,
    )  # fmt: skip
    drawing.colorbar(shown, ax=axes, label="reported error of the worst number [-]")
    for outcome, mark in MARKS.items():
        if (here := outcomes == outcome).any():
            axes.plot(xs[here], ys[here], linestyle="none", label=outcome, **mark)
    along = np.geomspace(xs.min(), xs.max(), 200).tolist()
    for dashes, (name, curve) in zip(("-", "--"), one.limits.items(), strict=False):
        axes.plot(along, [*map(curve, along)], color="black", linestyle=dashes, label=name, zorder=3)
    axes.plot(*one.default, "*", color="white", markeredgecolor="black", markersize=11,
              linestyle="none", label=one.default_name, zorder=4)  # fmt: skip
    drawing.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return drawing


def _around(values: np.ndarray) -> tuple[float, float]:
    """Limits of a logarithmic axis that has room for the squares of these values."""
    low, high = float(values.min()), float(values.max())
    room = (high / low) ** ROOM if high > low else 10.0
    return low / room, high * room


SOLVERS = {"compiled": style.SMOOTH, "exudyn": style.WITH_CLEARANCE}
PANELS = (
    ("stiffness", "step_s"), ("clearance_m", "step_s"), ("mass_ratio", "step_s"), ("clearance_m", "mass_ratio"),
)  # fmt: skip
AXES = {  # of the panels: a value of a map, or of a verdict
    "step_s": "step [s]",
    "stiffness": "contact stiffness / paper's [-]",
    "clearance_m": "clearance [m]",
    "mass_ratio": "heaviest over lightest body [-]",
}


def solver_figure(judged: Judged) -> Figure:
    """All scenes by the solver that ran them, over step, stiffness, clearance and mass ratio."""
    drawing, panels = grid(150, 2, 2)
    for axes, names in zip(panels.flat, PANELS, strict=True):
        axes.set(xscale="log", yscale="log", xlabel=AXES[names[0]], ylabel=AXES[names[1]])
        for solver, colour in SOLVERS.items():
            _scatter(axes, names, judged, GOOD, solver, marker=".", color=colour, ms=4, alpha=0.6)
            _scatter(axes, names, judged, REFUSED, solver, marker="x", color=colour, ms=6)
        _scatter(axes, names, judged, SILENT, "", marker="D", color="black", ms=5)
    return finish(drawing, panels, 3)


def _scatter(
    axes: Axes, names: tuple[str, str], judged: Judged, outcome: str, solver: str, **look: Any
) -> None:
    """Marks of all scenes of an outcome, and of a solver if it is named, at two of their values."""
    values = [
        {**verdict.values, **case.values}
        for case, verdict in judged
        if verdict.outcome == outcome and solver in ("", verdict.solver)
    ]
    x, y = ([one.get(name, math.nan) for one in values] for name in names)
    axes.plot(x, y, ls="none", label=f"{solver}, {outcome}".removeprefix(", "), **look)
