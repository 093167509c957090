"""Counterparts of Fig. 3, 4 and 5 of the paper."""

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import paper_machine, rise
from studies.common.panels import WINDOWS, finish, fit_height, time_ticks
from studies.common.paper_machine import CLEARANCE_MM, CLEARANCE_PIN, case_name, ideal_name, ideal_of
from studies.common.study import LivePanels
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

FRICTION = paper_machine.SLIDING_COEFFICIENT
IDEAL, IDEAL_DRY = (ideal_name(friction) for friction in (0.0, FRICTION))
SMOOTH, DRY = (case_name(CLEARANCE_MM, friction) for friction in (0.0, FRICTION))
CASES = (IDEAL, SMOOTH, IDEAL_DRY, DRY)
CURVES = {  # colour, width, dashes and label, the largest fluctuation undermost
    DRY: (style.WITH_CLEARANCE, 0.9, "-", f"{CLEARANCE_MM} mm, friction {FRICTION}"),
    SMOOTH: (style.SMOOTH, 1.2, "-", f"{CLEARANCE_MM} mm, no friction"),
    IDEAL_DRY: (style.IDEAL, 1.0, (0, (1, 1)), f"ideal pin, friction {FRICTION}"),
    IDEAL: (style.IDEAL, 1.0, (0, (4, 2)), "ideal pin, no friction"),
}
PANELS = {0: f"friction {FRICTION}", 1: "no friction"}  # of the figures with a panel for each
LIVE: dict[str, LivePanels] = {
    "fig5_pin_force": {n: f"pin force, {which} [kN]" for n, which in PANELS.items()},
    "fig3_angular_velocity": (0,),
    "fig4_angular_acceleration": {n: f"acceleration, {which} [deg/s²]" for n, which in PANELS.items()},
}


def figures(results: Mapping[str, Result]) -> dict[str, Figure]:
    """All figures, by file name."""
    return {
        "fig5_pin_force": _split_figure(results, rise.FORCE, 1e-3, "pin force [kN]"),
        "fig3_angular_velocity": _velocity_figure(results),
        "fig4_angular_acceleration": _split_figure(
            results, rise.ACCELERATION, rise.DEGREES, "angular acceleration\n[deg/s²]"
        ),
    }


def _draw(axes: Axes, results: Mapping[str, Result], channel: str, scale: float, *cases: str) -> None:
    for case in cases or CURVES:
        colour, width, dashes, label = CURVES[case]
        run = results[case]
        axes.plot(run.time, scale * run[channel], color=colour, lw=width, ls=dashes, label=label)


def _velocity_figure(results: Mapping[str, Result]) -> Figure:
    """The whole run, and three windows of the rise."""
    drawing = Figure(figsize=style.size(170, 115))
    panels = list(drawing.subplots(2, 2).flat)
    for axes, window in zip(panels, ((0.0, 5.0), *WINDOWS.values()), strict=True):
        _draw(axes, results, rise.SPEED, rise.DEGREES, DRY, SMOOTH, IDEAL)  # friction moves no ideal pin
        axes.set(xlabel="time [s]", ylabel="angular velocity\n[deg/s]", xlim=window)
        fit_height(axes, (rise.DEGREES * r[rise.SPEED][rise.between(r, *window)] for r in results.values()))
        time_ticks(axes, rise.PAPER)
    for letter, window in zip("bcd", WINDOWS.values(), strict=True):
        panels[0].axvspan(*window, color="#dddddd", zorder=0)
        panels[0].text(sum(window) / 2.0, 0.0, letter, ha="center", va="bottom", fontsize=7)
    return finish(drawing, panels, 3)


def _split_figure(results: Mapping[str, Result], channel: str, scale: float, label: str) -> Figure:
    """The whole run with friction and without, a panel each so that no peak hides another, and the rise."""
    drawing = Figure(figsize=style.size(170, 115))
    panels = drawing.subplot_mosaic([["dry", "smooth"], ["rise", "rise"]])
    for axes, case in ((panels["dry"], DRY), (panels["smooth"], SMOOTH)):
        _draw(axes, results, channel, scale, case, ideal_of(case))
        axes.set(xlabel="time [s]", ylabel=label, xlim=(0.0, 5.0))
        _mark_peak(axes, results[case], channel, scale, label)
    limits = [limit for name in ("dry", "smooth") for limit in panels[name].get_ylim()]
    low, high = min(limits), max(limits)
    for name in ("dry", "smooth"):
        panels[name].set_ylim(low, high + 0.08 * (high - low))
    _draw(panels["rise"], results, channel, scale)
    panels["rise"].set(xlabel="time [s]", ylabel=label, xlim=(rise.START, rise.END))
    inside = rise.START + 1e-3, rise.END - 1e-3
    fit_height(panels["rise"], (scale * r[channel][rise.between(r, *inside)] for r in results.values()))
    for axes in panels.values():
        time_ticks(axes, rise.PAPER)
    return finish(drawing, list(panels.values()), 2, panels["rise"])


def _mark_peak(axes: Axes, run: Result, channel: str, scale: float, label: str) -> None:
    """The largest value with its number: of the force that of any step, which tables print, too."""
    values = scale * run[channel]
    n = int(abs(values).argmax())
    unit = label[label.index("[") + 1 : label.index("]")]
    peak = scale * run.largest_force[CLEARANCE_PIN] if channel == rise.FORCE else values[n]
    axes.annotate(
        f"{peak:.0f} {unit}", (run.time[n], values[n]), (8.0, 0.0), textcoords="offset points", fontsize=8,
        va="center", arrowprops={"arrowstyle": "-", "lw": 0.5},
    )  # fmt: skip
