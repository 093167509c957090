"""Change against cost, columns driven apart, and the plane beside space."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from studies.common import rise
from studies.common.panels import legend
from studies.scene_detail.measures import Change, MeasuredScene, times_as_long
from studies.scene_detail.scenes import (
    CLEARANCE_IN_SPACE,
    CLEARANCE_MM,
    EQUAL,
    PAPERS,
    PAPERS_IN_SPACE,
    REAR,
    UNEQUAL_FULLEST,
    UNEQUAL_IDEAL,
    WITH_CLEARANCE,
)
from studies.scene_detail.tables import FARTHEST, RELATIVE, changes
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

PANELS = {
    RELATIVE["mean_pin_force"]: "mean force [%]",
    RELATIVE["std_pin_force"]: "spread of the force [%]",
    RELATIVE["largest_pin_force"]: "largest force [%]",
    FARTHEST: "tip, farthest [mm]",
}
PURPLE, OLIVE = "#CC79A7", "#999933"
# what an element is of by its words, the first that fits; colour
KINDS = {
    "friction": style.SMOOTH,
    "clearance": style.WITH_CLEARANCE,
    "columns": style.THIRD,
    "tail": PURPLE,
    "start": style.IDEAL,
    "space": OLIVE,
}
MARKERS = "osD^vP"
SMALLEST = 1e-6  # changes below are not told apart from none [%, mm]


def figures(measured: Mapping[str, MeasuredScene]) -> dict[str, Figure]:
    """All figures, by file name."""
    runs = {name: one.run for name, one in measured.items()}
    return {
        "change_and_cost": change_figure(measured),
        "unequal_columns": unequal_figure(runs),
        "plane_and_space": space_figure(runs),
    }


# --- change and cost ---


def change_figure(measured: Mapping[str, MeasuredScene]) -> Figure:
    """A dot for each element."""
    drawing = Figure(figsize=style.size(190, 175))
    rows = {
        "added": "Added to the plainest scene: size of the change against its cost",
        "taken": "Taken from the fullest scene: size of the change against the cost of what is left",
    }
    places = np.ravel(np.asarray(drawing.subfigures(2, 1)))
    for part, (group, title) in zip(places, rows.items(), strict=True):
        panels = part.subplots(1, len(PANELS))
        names = [name for name, one in measured.items() if one.scene.group == group and one.scene.reference]
        looks = _looks(names)
        for axes, (heading, label) in zip(panels, PANELS.items(), strict=True):
            for name in names:
                one = measured[name]
                reference = measured[one.scene.reference]
                times = times_as_long(one, reference)
                _dot(axes, times, changes(one, reference)[heading], *looks[name])
            axes.set(xscale="log", yscale="log", title=label, xlabel="times the cost")
            axes.margins(0.12)
            axes.minorticks_off()  # the grid tells enough, and it is drawn in half the time
        part.suptitle(title, x=0.01, ha="left")
        handles = [
            Line2D([], [], color=colour, marker=marker, ls="", ms=5, label=measured[name].scene.element)
            for name, (colour, marker) in looks.items()
        ]
        hollow = Line2D([], [], color="#777777", mfc="white", marker="o", ls="", ms=5, label="below the error")
        handles.append(hollow)
        part.legend(handles=handles, loc="outside lower center", ncols=3, fontsize=8)
    return drawing


def _looks(names: Sequence[str]) -> dict[str, tuple[str, str]]:
    """Colour and marker of each element: what it is of, and which of those."""
    used: dict[str, int] = {}
    found = {}
    for name in names:
        kind = next(kind for kind in KINDS if kind in name.replace(WITH_CLEARANCE, "", name != WITH_CLEARANCE))
        found[name] = (KINDS[kind], MARKERS[used.get(kind, 0)])
        used[kind] = used.get(kind, 0) + 1
    return found


def _dot(axes: Axes, times: float, change: Change, colour: str, marker: str) -> None:
    place = MARKERS.index(marker)
    width, above = 7.0 - 1.2 * place, 3.0 + 0.1 * place  # so that those behind can be seen
    size = max(abs(change.value), SMALLEST)
    if change.below_error:
        height = max(change.error, SMALLEST)
        axes.plot(times, height, marker, mfc="white", mec=colour, ms=width, zorder=above)
        return
    below = min(change.error, 0.9 * size)
    axes.errorbar(
        times,
        size,
        yerr=[[below], [change.error]],
        fmt=marker,
        color=colour,
        ms=width,
        mec="white",  # apart from others of the same colour
        mew=0.6,
        lw=0.8,
        zorder=above,
    )


# --- columns driven apart ---


def unequal_figure(runs: Mapping[str, Result]) -> Figure:
    """Six panels."""
    drawing = Figure(figsize=style.size(190, 125))
    panels = list(drawing.subplots(2, 3).flat)
    with_clearance, ideal, equal = (runs[name] for name in (UNEQUAL_FULLEST, UNEQUAL_IDEAL, EQUAL))
    sides = {"left": style.WITH_CLEARANCE, "right": style.SMOOTH}
    dashes = (0, (4, 2))
    _title(panels[0], "a) canopy", "turn [deg]")
    _lines(panels[0], with_clearance, ideal, {"canopy.roll": style.THIRD, "canopy.yaw": PURPLE}, rise.DEGREES)
    for name, colour, above in (("roll", style.THIRD, 6), ("yaw", PURPLE, -10)):  # beside their ends
        last = rise.DEGREES * with_clearance[f"canopy.{name}"][-1]
        panels[0].annotate(
            name,
            (with_clearance.time[-1], last),
            (-14, above),
            textcoords="offset points",
            color=colour,
            ha="center",
        )
    _title(panels[1], "b) edges of the rear pin", "depth [mm]")
    for side, colour in sides.items():
        panels[1].plot(with_clearance.time, 1e3 * with_clearance[f"pin.{REAR}.{side}_depth"], color=colour)
    _title(panels[2], "c) front columns", "force [kN]")
    _lines(
        panels[2], with_clearance, ideal, {f"front_column_{side}.force": c for side, c in sides.items()}, 1e-3
    )
    _title(panels[3], "d) moment on the rear pin", "moment [kN m]")
    # with ideal pins rigid bodies do not determine it
    moment = np.hypot(with_clearance[f"pin.{REAR}.moment_x"], with_clearance[f"pin.{REAR}.moment_y"])
    panels[3].plot(with_clearance.time, 1e-3 * moment, color=style.IDEAL)
    for axes in panels[:4]:
        axes.set_xlabel("time [s]")
    _orbits(panels[4], with_clearance, sides, "e) ends in the bore, apart")
    _orbits(panels[5], equal, sides, "f) the same, driven alike")
    handles = [
        _key("left", style.WITH_CLEARANCE),
        _key("right", style.SMOOTH),
        _key(f"{CLEARANCE_MM:g} mm and friction", style.IDEAL),
        Line2D([], [], color=style.IDEAL, ls=dashes, label="ideal pins (a, c)"),
    ]
    drawing.legend(handles=handles, loc="outside lower center", ncols=4)
    return drawing


def _lines(axes: Axes, with_clearance: Result, ideal: Result, colours: Mapping[str, str], scale: float) -> None:
    for channel, colour in colours.items():
        axes.plot(ideal.time, scale * ideal[channel], color=colour, ls=(0, (4, 2)))
        axes.plot(with_clearance.time, scale * with_clearance[channel], color=colour)


def _orbits(axes: Axes, run: Result, sides: Mapping[str, str], title: str) -> None:
    """Paths of the journal's ends; grey: where it makes contact."""
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    axes.plot(CLEARANCE_MM * np.cos(turn), CLEARANCE_MM * np.sin(turn), color="#999999", lw=0.8)
    for side, colour in sides.items():
        x, y = (1e3 * run[f"pin.{REAR}.{side}_eccentricity_{axis}"] for axis in "xy")
        axes.plot(x, y, color=colour, lw=1.4 if side == "left" else 0.8)
        axes.plot(x[-1], y[-1], "o", color=colour, ms=4)
    axes.set(aspect="equal", xlabel="forward [mm]", ylabel="up [mm]", title=title)


def _title(axes: Axes, title: str, label: str) -> None:
    axes.set(title=title, ylabel=label)


def _key(label: str, colour: str) -> Line2D:
    return Line2D([], [], color=colour, label=label)


# --- plane and space ---


def space_figure(runs: Mapping[str, Result]) -> Figure:
    """Forces above, their distance below."""
    drawing = Figure(figsize=style.size(190, 105))
    panels = drawing.subplots(2, 2, sharex=True, sharey="row", height_ratios=(2, 1))
    pairs = {"no friction": (WITH_CLEARANCE, CLEARANCE_IN_SPACE), "friction 0.25": (PAPERS, PAPERS_IN_SPACE)}
    force = f"pin.{REAR}.force"
    for column, (title, (plane, space)) in enumerate(pairs.items()):
        above, below = panels[:, column]
        one, other = runs[plane], runs[space]
        above.plot(one.time, 1e-3 * one[force], color=style.SMOOTH, lw=2.2, label="in the plane")
        above.plot(other.time, 1e-3 * other[force], color=style.IDEAL, lw=0.7, label="in space")
        above.set_title(title)
        apart = np.abs(other[force] - one[force])
        below.semilogy(other.time, np.maximum(apart, 1e-9), color=style.WITH_CLEARANCE, lw=0.7)
        below.set_xlabel("time [s]")
    panels[0, 0].set_ylabel("rear pin force [kN]")
    panels[1, 0].set_ylabel("apart [N]")
    legend(drawing, panels[0, 0], 2)
    return drawing
