"""Stability maps: where a run is good, how large its error is, and where theory has its limits."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from studies.extremes.cases import CLEARANCE_SPEED, FRICTION_STEP, STEP_STIFFNESS
from studies.extremes.judge import GOOD, SILENT, Case, Judgement
from studies.extremes.ranges import Point
from studies.extremes.scenes import IMPACT_STEPS, fallen
from support_exudyn.postprocessing.figures import style
from support_exudyn.scenario.timescales import timescales
from user_forces import Impact

SMALLEST, LARGEST = 1e-6, 1.0  # of the colours
PULL = 9.81  # [m/s^2]
MASS = 3000.0  # [kg] that moves with the journal of the rear pin, see `effective_mass`
Judged = Sequence[tuple[Case, Judgement]]
Curve = tuple[str, Callable[[float], float]]


@dataclass(frozen=True)
class Map:
    """A map: of which group, by which values, their names and units, and where the defaults are."""

    group: str
    x: str
    y: str
    x_label: str
    y_label: str
    default: tuple[float, float]
    default_name: str


MAPS = {
    "step_stiffness": Map(
        STEP_STIFFNESS, "stiffness", "step_s", "contact stiffness / paper's [-]", "step [s]",
        (1.0, 5e-4), "defaults",
    ),
    "clearance_speed": Map(
        CLEARANCE_SPEED, "clearance_m", "speed_m_s", "clearance [m]", "speed of the columns [m/s]",
        (1.5e-3, 0.25), "the paper's case",
    ),
    "friction_step": Map(
        FRICTION_STEP, "static_speed_m_s", "step_s", "$v_s$ [m/s], $v_d = 2 v_s$", "step [s]",
        (5e-3, 5e-4), "defaults",
    ),
}  # fmt: skip


def figures(judged: Judged) -> dict[str, Figure]:
    """All maps of which there are cases, by file name."""
    groups = {case.group for case, _ in judged}
    return {f"map_{name}": _figure(one, judged) for name, one in MAPS.items() if one.group in groups}


def _figure(one: Map, judged: Judged) -> Figure:
    drawing = Figure(figsize=style.size(150, 105))
    axes = drawing.subplots()
    found = [(case, verdict) for case, verdict in judged if case.group == one.group]
    _cells(drawing, axes, one, found)
    xs = np.geomspace(*_span([float(case.values[one.x]) for case, _ in found]), 200)
    handles: list[Line2D] = []
    limits = axes.get_ylim()
    for n, (name, curve) in enumerate(LIMITS[one.group]()):
        line = axes.plot(
            xs, [curve(float(x)) for x in xs], color="black", linestyle=("-", "--", ":")[n], label=name
        )
        handles += line
    axes.set_ylim(limits)
    handles += axes.plot(*one.default, "*", color="white", markeredgecolor="black", markersize=13,
                         linestyle="none", label=one.default_name)  # fmt: skip
    handles.append(Line2D([], [], color="black", marker="x", linestyle="none", label="refused"))
    if any(verdict.outcome == SILENT for _, verdict in found):
        handles.append(Line2D([], [], color=style.SMOOTH, marker="s", linestyle="none", label="silent failure"))
    drawing.legend(handles=handles, loc="outside lower center", ncols=2)
    return drawing


def _cells(drawing: Figure, axes: Axes, one: Map, found: Judged) -> None:
    """Each case a cell: its error, or a cross."""
    xs = sorted({float(case.values[one.x]) for case, _ in found})
    ys = sorted({float(case.values[one.y]) for case, _ in found})
    errors = np.full((len(ys), len(xs)), np.nan)
    for case, verdict in found:
        x, y = float(case.values[one.x]), float(case.values[one.y])
        if verdict.outcome == GOOD:
            errors[ys.index(y), xs.index(x)] = min(max(verdict.error, SMALLEST), LARGEST)
        else:
            mark = (
                {"marker": "s", "color": style.SMOOTH}
                if verdict.outcome == SILENT
                else {"marker": "x", "color": "black"}
            )
            axes.plot(x, y, markersize=5, **mark)  # type: ignore[arg-type]
    shown = axes.pcolormesh(
        _edges(xs), _edges(ys), errors, norm=LogNorm(SMALLEST, LARGEST), cmap="viridis_r", shading="flat"
    )
    axes.set(xscale="log", yscale="log", xlabel=one.x_label, ylabel=one.y_label)
    axes.set_facecolor("#eeeeee")
    axes.grid(visible=False)
    drawing.colorbar(shown, ax=axes, label="reported error of the worst number [-]")


def _span(values: Sequence[float]) -> tuple[float, float]:
    return min(values), max(values)


def _edges(values: Sequence[float]) -> np.ndarray:
    """Edges of cells around values that are even in their logarithm."""
    logs = np.log(values)
    half = 0.5 * (logs[1] - logs[0]) if len(logs) > 1 else 0.5
    edges: np.ndarray = np.exp(np.append(logs - half, logs[-1] + half))
    return edges


# --- limits ---


def _first_impact(point: Point) -> Impact:
    """The first impact of a fall through the clearance."""
    return Impact(math.sqrt(2.0 * PULL * point.clearance_m), MASS)


def _of_contact() -> list[Curve]:
    def duration(stiffness: float) -> float:
        point = Point(stiffness=stiffness)
        return point.normal.impact_time(_first_impact(point))

    return [
        ("duration of the first contact", duration),
        (f"step in it (1/{IMPACT_STEPS})", lambda stiffness: duration(stiffness) / IMPACT_STEPS),
    ]


def _of_flight() -> list[Curve]:
    def flight(clearance: float) -> float:
        return 0.05 / math.sqrt(2.0 * clearance / PULL)

    return [("stroke as long as the fall through the clearance", flight)]


def _of_friction() -> list[Curve]:
    def rubbing(static: float) -> float:
        point = Point(mu=0.25, static_speed_m_s=static, dynamic_speed_m_s=2.0 * static)
        return timescales(fallen(point)).rubbing

    return [("time constant of friction", rubbing), ("10 000 of it", lambda static: 1e4 * rubbing(static))]


LIMITS: Mapping[str, Callable[[], list[Curve]]] = {
    STEP_STIFFNESS: _of_contact,
    CLEARANCE_SPEED: _of_flight,
    FRICTION_STEP: _of_friction,
}
