"""Counterparts of Fig. 6 to 11 of the paper."""

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import paper_machine, rise
from studies.common.numbers import Number, by_case
from studies.common.panels import WINDOWS, fit_height, legend
from studies.common.paper_machine import SIZES_MM, case_name
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

COLOURS = {0.5: "#009E73", 1.0: "#E69F00", 1.5: "#0072B2", 2.0: "#CC79A7"}  # Okabe and Ito
DASHES = {0.5: "-", 1.0: (0, (5, 1)), 1.5: (0, (3, 1, 1, 1)), 2.0: (0, (1, 1))}  # for grey prints
MU = paper_machine.SLIDING_COEFFICIENT


def figures(results: Mapping[str, Result], numbers: Sequence[Number]) -> dict[str, Figure]:
    """All figures, by file name."""
    return {
        "fig6_angular_velocity": velocity_figure(results),
        "fig7_angular_acceleration": panel_figure(
            results, rise.ACCELERATION, rise.DEGREES, "angular acceleration [deg/s²]",
            "Angular acceleration of the rear link (paper: Fig. 7)",
        ),
        "fig8_pin_force": panel_figure(
            results, rise.FORCE, 1e-3, "pin force [kN]", "Force in the rear-link pin (paper: Fig. 8)"
        ),
        "fig9_tip_path": tip_path_figure(results),
        "fig10_tip_shift": tip_shift_figure(results),
        "fig11_column_angles": angle_figure(results),
        "trends_with_clearance": trend_figure(numbers),
    }  # fmt: skip


def velocity_figure(results: Mapping[str, Result]) -> Figure:
    """The rise and three windows."""
    drawing = Figure(figsize=style.size(170, 130))
    panels = drawing.subplots(2, 2)
    spans = {"the rise": (rise.START, rise.END)} | WINDOWS
    for axes, letter, (name, span) in zip(panels.flat, "abcd", spans.items(), strict=True):
        _curves(axes, results, rise.SPEED, rise.DEGREES, span)
        axes.set(title=f"{letter}) {name}", xlabel="time [s]", ylabel="angular velocity [deg/s]")
    for span in WINDOWS.values():
        panels[0, 0].axvspan(*span, color="#eeeeee", zorder=0)
    legend(drawing, panels[0, 0], 5)
    drawing.suptitle(f"Angular velocity of the rear link, friction {MU} (paper: Fig. 6)")
    return drawing


def panel_figure(results: Mapping[str, Result], channel: str, scale: float, label: str, title: str) -> Figure:
    """A panel for each clearance, the largest first as in the paper, on one scale."""
    drawing = Figure(figsize=style.size(170, 135))
    panels = drawing.subplots(2, 2, sharex=True, sharey=True)
    span = rise.START + 2e-3, rise.END - 2e-3
    for axes, letter, size in zip(panels.flat, "abcd", reversed(SIZES_MM), strict=True):
        for case, colour, width, name in (
            (case_name(size, MU), COLOURS[size], 0.8, f"friction {MU}"),
            (case_name(size, 0.0), "#777777", 0.8, "no friction"),
            ("ideal", style.IDEAL, 0.8, "ideal pin"),
        ):
            if case not in results:
                continue
            inside = rise.between(results[case], *span)
            axes.plot(
                results[case].time[inside], scale * results[case][channel][inside],
                color=colour, lw=width, ls=(0, (4, 2)) if case == "ideal" else "-", label=name,
            )  # fmt: skip
        axes.set(title=f"{letter}) {size:.1f} mm", xlim=span)
        axes.legend(fontsize=7, loc="best")
    drawing.supxlabel("time [s]", fontsize=9)
    drawing.supylabel(label, fontsize=9)
    drawing.suptitle(title)
    return drawing


def tip_path_figure(results: Mapping[str, Result]) -> Figure:
    """Height over horizontal position."""
    drawing = Figure(figsize=style.size(170, 95))
    whole, near = drawing.subplots(1, 2)
    for axes in (whole, near):
        for case, colour, dashes, label in _cases():
            run = results[case]
            inside = rise.in_rise(run)
            axes.plot(
                1e3 * run["tip.x"][inside], 1e3 * run["tip.y"][inside], color=colour, ls=dashes, label=label
            )
        axes.set(xlabel="horizontal, towards the coal face [mm]", ylabel="height [mm]")
    ideal = results["ideal"]
    middle = rise.between(ideal, 3.9, 4.1)
    x, y = 1e3 * ideal["tip.x"][middle], 1e3 * ideal["tip.y"][middle]
    near.set(xlim=(x.min() - 7.0, x.max() + 1.0), ylim=(y.min(), y.max()))
    whole.set_title("a) the rise")
    near.set_title("b) 3.9 to 4.1 s")
    legend(drawing, whole, 5)
    drawing.suptitle(f"Path of the canopy's tip, friction {MU} (paper: Fig. 9)")
    return drawing


def tip_shift_figure(results: Mapping[str, Result]) -> Figure:
    """Horizontal position over time, and its distance from that with the ideal pin."""
    drawing = Figure(figsize=style.size(170, 125))
    place, shift = drawing.subplots(2, 1)
    _curves(place, results, "tip.x", 1e3, (rise.START, rise.END))
    for case, colour, dashes, label in _cases():
        if case != "ideal":
            run = results[case]
            moved = 1e3 * rise.departure(run, results["ideal"], "tip.x")
            shift.plot(run.time[rise.in_rise(run)], moved, color=colour, ls=dashes, label=label)
    place.set(title="a) position", ylabel="tip, horizontal [mm]", xlabel="time [s]")
    shift.set(
        title="b) against the ideal pin (minus: towards the rear link)", ylabel="shift [mm]", xlabel="time [s]"
    )
    shift.set(xlim=(rise.START, rise.END), ylim=(None, 0.0))
    legend(drawing, place, 5)
    drawing.suptitle(f"Horizontal position of the canopy's tip, friction {MU} (paper: Fig. 10)")
    return drawing


def angle_figure(results: Mapping[str, Result]) -> Figure:
    """Angles of both columns, and their change."""
    drawing = Figure(figsize=style.size(170, 130))
    panels = drawing.subplots(2, 2, sharex=True)
    for n, column in enumerate(("front_column", "rear_column")):
        whole, change = panels[:, n]
        ideal = rise.rearward_angle(results["ideal"], column)
        for case, colour, dashes, label in _cases():
            run = results[case]
            inside = rise.in_rise(run)
            angle = rise.rearward_angle(run, column)
            whole.plot(run.time[inside], rise.DEGREES * angle[inside], color=colour, ls=dashes, label=label)
            if case != "ideal":
                change.plot(run.time[inside], rise.DEGREES * (angle - ideal)[inside], color=colour, ls=dashes)
        name = column.replace("_", " ")
        whole.set(title=f"{'ab'[n]}) {name}", ylabel="angle [deg]")
        change.set(title=f"{'cd'[n]}) {name}, against the ideal pin", ylabel="change of angle [deg]")
        change.set(xlabel="time [s]", ylim=(None, 0.0), xlim=(rise.START, rise.END))
    legend(drawing, panels[0, 0], 5)
    drawing.suptitle(f"Columns' angles from the rearward horizontal, friction {MU} (paper: Fig. 11, 12)")
    return drawing


def trend_figure(numbers: Sequence[Number]) -> Figure:
    """Statistics over the clearance, with and without friction."""
    drawing = Figure(figsize=style.size(170, 115))
    panels = drawing.subplots(2, 3)
    found = by_case(numbers)
    shown = [
        ("mean_pin_force", 1e-3, "mean pin force [kN]"),
        ("std_pin_force", 1e-3, "its standard deviation [kN]"),
        ("rms_pin_force", 1e-3, "its RMS fluctuation [kN]"),
        ("rms_angular_velocity", 1.0, "RMS fluctuation of angular velocity [deg/s]"),
        ("rms_angular_acceleration", 1.0, "RMS fluctuation of ang. acceleration [deg/s²]"),
        ("mean_tip_shift", 1.0, "tip shift [mm]"),
    ]
    for axes, letter, (name, scale, label) in zip(panels.flat, "abcdef", shown, strict=True):
        for friction, colour, mark in ((MU, style.WITH_CLEARANCE, "o"), (0.0, "#777777", "s")):
            sizes = [size for size in SIZES_MM if (name, case_name(size, friction)) in found]
            row = [found[name, case_name(size, friction)] for size in sizes]
            label_here = f"friction {friction:g}" if friction else "no friction"
            axes.errorbar(
                sizes, [scale * n.value for n in row], yerr=[scale * n.numerical_error for n in row],
                color=colour, marker=mark, ms=3.5, capsize=2, lw=0.9, label=label_here,
            )  # fmt: skip
            printed = [n.paper for n in row]
            if all(value is not None for value in printed):
                values = [scale * value for value in printed if value is not None]
                axes.plot(SIZES_MM, values, "x", color=style.PAPER, ms=5, label="paper")
        axes.set_title(f"{letter}) {label}", fontsize=8)
        axes.set_xticks(SIZES_MM)
        axes.margins(y=0.15)
    legend(drawing, panels[0, 0], 3)
    for axes in panels[1]:
        axes.set_xlabel("clearance [mm]")
    drawing.suptitle("The rise over the clearance (paper: Table 3)")
    return drawing


def _cases() -> list[tuple[str, str, object, str]]:
    """Case, colour, dashes and label of the curves, the largest clearance undermost."""
    with_clearance = [
        (case_name(size, MU), COLOURS[size], DASHES[size], f"{size:.1f} mm") for size in reversed(SIZES_MM)
    ]
    return [*with_clearance, ("ideal", style.IDEAL, (0, (4, 2)), "ideal pin")]


def _curves(
    axes: Axes, results: Mapping[str, Result], channel: str, scale: float, span: tuple[float, float]
) -> None:
    for case, colour, dashes, label in _cases():
        run = results[case]
        axes.plot(run.time, scale * run[channel], color=colour, ls=dashes, lw=0.9, label=label)
    axes.set(xlim=span)
    fit_height(axes, (scale * results[c][channel][rise.between(results[c], *span)] for c, *_ in _cases()))
