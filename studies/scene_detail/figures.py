"""What elements change and cost, columns driven apart, and the plane beside space."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from studies.common import rise
from studies.common.panels import legend, letters
from studies.scene_detail.measures import MM, Change, MeasuredScene, times_as_long
from studies.scene_detail.scenes import (
    CLEARANCE_IN_SPACE,
    CLEARANCE_MM,
    EQUAL,
    FULLEST,
    PAPERS,
    PAPERS_IN_SPACE,
    PLAINEST,
    REAR,
    UNEQUAL_FULLEST,
    UNEQUAL_IDEAL,
    WITH_CLEARANCE,
    DetailScene,
)
from studies.scene_detail.tables import FARTHEST, RELATIVE, changes
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

# columns of the figure of changes: of `tables.changes`, with the smallest that is told apart from none
PANELS = {
    RELATIVE["mean_pin_force"]: ("mean force [%]", 1e-2),
    RELATIVE["std_pin_force"]: ("its spread [%]", 1e-1),
    RELATIVE["largest_pin_force"]: ("largest force [%]", 1e-2),
    FARTHEST: ("tip, farthest [mm]", 1e-3),
}
COST = "cost ratio"
MORE, LESS, OPEN = style.CONTACT, style.WITH_CLEARANCE, "#777777"
PURPLE = "#CC79A7"
DASHES = (0, (4, 2))
WIDTHS = {"left": 1.8, "right": 0.8}  # the thinner curve is drawn on top
LEAST_APART = 1e-9  # [N]
ROW_MM = 4.3  # height of an element's row


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
    """A row for each element, named beside it; a panel for each number that it changes, and for its cost."""
    groups = {group: _elements(measured, group) for group in ("added", "taken")}
    heights = [len(names) for names in groups.values()]
    drawing = Figure(figsize=style.size(180, 30 + ROW_MM * sum(heights)))
    panels = drawing.subplots(2, len(PANELS) + 1, sharey="row", sharex="col", height_ratios=heights)
    for line, names in zip(panels, groups.values(), strict=True):
        for axes, (heading, (_, smallest)) in zip(line, PANELS.items(), strict=False):
            for place, name in enumerate(names):
                one = measured[name]
                _dot(axes, place, changes(one, measured[one.scene.reference])[heading], smallest)
            axes.set_xscale("log")
        times = [times_as_long(measured[name], measured[measured[name].scene.reference]) for name in names]
        line[-1].plot(times, range(len(names)), "s", color=style.IDEAL, ms=3.5)
        line[-1].axvline(1.0, color=style.IDEAL, lw=0.6)
        line[-1].set_xscale("log")
        line[0].set_yticks(range(len(names)), [_named(measured[name].scene) for name in names])
        line[0].set_ylim(len(names) - 0.4, -0.6)
    for axes, label in zip(panels[-1], (*(label for label, _ in PANELS.values()), COST), strict=True):
        axes.set_xlabel(label, fontsize=8)
    for axes in panels.flat:
        axes.tick_params(labelsize=7)
        axes.xaxis.set_major_locator(LogLocator(numticks=3))
        axes.minorticks_off()
    letters(list(panels.flat))
    drawing.legend(handles=_signs(), loc="outside lower center", ncols=3, fontsize=8)
    return drawing


def _elements(measured: Mapping[str, MeasuredScene], group: str) -> list[str]:
    return [name for name, one in measured.items() if one.scene.group == group and one.scene.reference]


def _named(scene: DetailScene) -> str:
    """An element with its sign; what has another reference than the others of its group says which."""
    of_another = scene.reference not in (PLAINEST, FULLEST)
    return f"{scene.element} *" if of_another else scene.element


def _dot(axes: Axes, place: int, change: Change, smallest: float) -> None:
    size = abs(change.value)
    if change.below_error or size < smallest:
        axes.plot(max(change.error, smallest), place, "<", mfc="white", mec=OPEN, ms=4)
        return
    below = min(change.error, 0.9 * size)
    colour, marker = (MORE, "^") if change.value > 0.0 else (LESS, "v")
    axes.errorbar(size, place, xerr=[[below], [change.error]], fmt=marker, color=colour, ms=4, lw=0.8)


def _signs() -> list[Line2D]:
    kinds = ((MORE, MORE, "^", "more"), (LESS, LESS, "v", "less"), (OPEN, "white", "<", "no more than this"))
    return [Line2D([], [], color=edge, mfc=face, marker=mark, ls="", ms=4.5, label=said)
            for edge, face, mark, said in kinds]  # fmt: skip


# --- columns driven apart ---


def unequal_figure(runs: Mapping[str, Result]) -> Figure:
    """Six panels."""
    drawing = Figure(figsize=style.size(180, 125))
    panels = list(drawing.subplots(2, 3).flat)
    with_clearance, ideal, equal = (runs[name] for name in (UNEQUAL_FULLEST, UNEQUAL_IDEAL, EQUAL))
    sides = {"left": style.WITH_CLEARANCE, "right": style.SMOOTH}
    turns = {"canopy.roll": style.THIRD, "canopy.yaw": PURPLE}
    _lines(panels[0], with_clearance, ideal, turns, rise.DEGREES)
    _at_end(panels[0], with_clearance, turns, rise.DEGREES)
    for side, colour in sides.items():
        depth = MM * with_clearance[f"pin.{REAR}.{side}_depth"]
        panels[1].plot(with_clearance.time, depth, color=colour, lw=WIDTHS[side], label=f"{side} edge")
    columns = {f"front_column_{side}.force": colour for side, colour in sides.items()}
    _lines(panels[2], with_clearance, ideal, columns, 1e-3)
    _at_end(panels[2], with_clearance, columns, 1e-3)
    # with ideal pins rigid bodies do not determine it
    moment = np.hypot(with_clearance[f"pin.{REAR}.moment_x"], with_clearance[f"pin.{REAR}.moment_y"])
    panels[3].plot(with_clearance.time, 1e-3 * moment, color=style.IDEAL, label="moment across the pin")
    labels = (
        "turn of the canopy [deg]",
        "indentation [mm]",
        "column force [kN]",
        "moment on the\nrear pin [kN m]",
    )
    drive = with_clearance.scenario.drive
    for axes, label in zip(panels, labels, strict=False):
        axes.set(xlabel="time [s]", ylabel=label)
        axes.set_xlim(0.0, with_clearance.scenario.duration)
        axes.set_xticks(np.linspace(drive.breaks[0], drive.breaks[-1], 5))
        axes.margins(y=0.12)
    for axes, run in zip(panels[4:], (with_clearance, equal), strict=True):
        _orbits(axes, run, sides)
    letters(panels)
    handles = [_key("left", sides["left"]), _key("right", sides["right"])]
    handles += [_key(f"clearance {CLEARANCE_MM:g} mm, friction", style.IDEAL)]
    handles += [Line2D([], [], color=style.IDEAL, ls=DASHES, label="ideal pins (a, c)")]
    drawing.legend(handles=handles, loc="outside lower center", ncols=4)
    return drawing


def _at_end(axes: Axes, run: Result, colours: Mapping[str, str], scale: float) -> None:
    """What a curve is, beside its end, above the higher and below the lower one."""
    ends = {channel: scale * run[channel][-1] for channel in colours}
    for channel, colour in colours.items():
        above = ends[channel] == max(ends.values())
        said = channel.split(".")[0].split("_")[-1] if channel.endswith(".force") else channel.split(".")[1]
        axes.annotate(
            said, (run.time[-1], ends[channel]), (-4, 5 if above else -5), textcoords="offset points",
            color=colour, ha="right", va="bottom" if above else "top", fontsize=8,
        )  # fmt: skip


def _lines(axes: Axes, with_clearance: Result, ideal: Result, colours: Mapping[str, str], scale: float) -> None:
    for channel, colour in colours.items():
        name = channel.replace("_", " ").replace(".", ", ")
        axes.plot(ideal.time, scale * ideal[channel], color=colour, ls=DASHES, label=f"{name}, ideal pins")
        axes.plot(
            with_clearance.time, scale * with_clearance[channel], color=colour, label=f"{name}, clearance"
        )


def _orbits(axes: Axes, run: Result, sides: Mapping[str, str]) -> None:
    """Paths of the journal's ends; grey: where it makes contact."""
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    axes.plot(CLEARANCE_MM * np.cos(turn), CLEARANCE_MM * np.sin(turn), color="#999999", lw=0.8)
    for side, colour in sides.items():
        x, y = (MM * run[f"pin.{REAR}.{side}_eccentricity_{axis}"] for axis in "xy")
        axes.plot(x, y, color=colour, lw=WIDTHS[side])
        axes.plot(x[-1], y[-1], "o", color=colour, ms=5 if side == "left" else 3)
    axes.set(aspect="equal", xlabel="forward [mm]", ylabel="up [mm]")


def _key(label: str, colour: str) -> Line2D:
    return Line2D([], [], color=colour, label=label)


# --- plane and space ---


def space_figure(runs: Mapping[str, Result]) -> Figure:
    """Forces above, their distance below."""
    drawing = Figure(figsize=style.size(180, 105))
    panels = drawing.subplots(2, 2, sharex=True, sharey="row", height_ratios=(2, 1))
    pairs = {"no friction": (WITH_CLEARANCE, CLEARANCE_IN_SPACE), "friction 0.25": (PAPERS, PAPERS_IN_SPACE)}
    force = f"pin.{REAR}.force"
    for column, (said, (plane, space)) in enumerate(pairs.items()):
        above, below = panels[:, column]
        one, other = runs[plane], runs[space]
        above.plot(one.time, 1e-3 * one[force], color=style.SMOOTH, lw=2.2, label="in the plane")
        above.plot(other.time, 1e-3 * other[force], color=style.IDEAL, lw=0.7, label="in space")
        above.annotate(said, (0.98, 0.95), xycoords="axes fraction", ha="right", va="top")
        apart = np.maximum(np.abs(other[force] - one[force]), LEAST_APART)
        below.semilogy(other.time, apart, color=style.WITH_CLEARANCE, lw=0.7, label="difference")
        below.set_xlim(0.0, one.scenario.duration)
        below.set_xlabel("time [s]")
    panels[0, 0].set_ylabel("rear pin force [kN]")
    panels[1, 0].set_ylabel("difference [N]")
    letters(list(panels.flat))
    drawing.align_ylabels()
    legend(drawing, panels[0, 0], 2)
    return drawing
