"""Counterparts of Fig. 6 to 11 of the paper."""

from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.clearance_size.measures import COLUMNS
from studies.common import rise
from studies.common.numbers import Found
from studies.common.panels import WINDOWS, fit_height, forward_arrow, legend, letters, time_ticks
from studies.common.paper_machine import SIZES_MM, case_name, ideal_name, ideal_of
from studies.common.study import LivePanels
from studies.common.subject import Subject
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

COLOURS = {0.5: "#009E73", 1.0: "#E69F00", 1.5: "#0072B2", 2.0: "#CC79A7"}  # Okabe and Ito
DASHES = {0.5: "-", 1.0: (0, (5, 1)), 1.5: (0, (3, 1, 1, 1)), 2.0: (0, (1, 1))}  # for grey prints
NO_FRICTION = "#777777"
DASHED: style.Dashes = (0, (4, 2))  # of ideal pins
Results = Mapping[str, Result]


def figures(subject: Subject, results: Results, found: Found) -> dict[str, Figure]:
    """All figures that this machine has something for, by file name; the names are those of the paper's."""
    watched = subject.watched
    drawings = {
        "trends_with_clearance": trend_figure(subject, found),
        "fig6_angular_velocity": velocity_figure(subject, results),
        "fig7_angular_acceleration": panel_figure(
            subject, results, watched.acceleration, rise.DEGREES, "angular acceleration [deg/s²]"
        ),
        "fig8_pin_force": panel_figure(subject, results, watched.force, 1e-3, "pin force [kN]"),
    }
    channels = results[ideal_name(0.0)].channels
    if "tip.x" in channels:
        drawings["fig9_tip_path"] = tip_path_figure(subject, results)
        drawings["fig10_tip_shift"] = tip_shift_figure(subject, results)
    if all(f"{column}.angle" in channels for column in COLUMNS):
        drawings["fig11_column_angles"] = angle_figure(subject, results)
    return drawings


def live(drawings: Mapping[str, Figure]) -> dict[str, LivePanels]:
    """Which panels of those figures are time series to look into."""
    sizes = [f"{size:.1f} mm" for size in reversed(SIZES_MM)]
    found: dict[str, LivePanels] = {
        "fig6_angular_velocity": (0,),
        "fig7_angular_acceleration": {
            n: f"angular acceleration, {one} [deg/s²]" for n, one in enumerate(sizes)
        },
        "fig8_pin_force": {n: f"pin force, {one} [kN]" for n, one in enumerate(sizes)},
        "fig10_tip_shift": (0, 1),
        "fig11_column_angles": (0, 1, 2, 3),
    }
    return {name: panels for name, panels in found.items() if name in drawings}


def windows(watched: rise.Watched) -> list[tuple[float, float]]:
    """Three short pieces of the motion: those of the paper's rise, or at the same shares of another one."""
    scale = (watched.end - watched.start) / (rise.END - rise.START)
    return [
        (watched.start + scale * (a - rise.START), watched.start + scale * (b - rise.START))
        for a, b in WINDOWS.values()
    ]


def velocity_figure(subject: Subject, results: Results) -> Figure:
    """The motion and three windows of it; in the first panel the curves lie upon each other."""
    drawing = Figure(figsize=style.size(170, 115))
    panels = list(drawing.subplots(2, 2).flat)
    watched = subject.watched
    spans = [(watched.start, watched.end), *windows(watched)]
    for axes, span in zip(panels, spans, strict=True):
        _curves(axes, subject, results, watched.speed, rise.DEGREES, span)
        axes.set(xlabel="time [s]", ylabel="angular velocity\n[deg/s]")
        time_ticks(axes, watched)
    top = panels[0].get_ylim()[1]
    for letter, span in zip("bcd", spans[1:], strict=True):
        panels[0].axvspan(*span, color="#dddddd", zorder=0)
        panels[0].text(sum(span) / 2.0, top, letter, ha="center", va="top", fontsize=7)
    legend(drawing, panels[0], 5)
    letters(panels)
    return drawing


def panel_figure(subject: Subject, results: Results, channel: str, scale: float, label: str) -> Figure:
    """A panel for each clearance, the largest first as in the paper, on one scale."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = list(drawing.subplots(2, 2, sharex=True, sharey=True).flat)
    watched = subject.watched
    edge = 1e-3 * (watched.end - watched.start)  # the jumps at both ends would set the scale
    span = watched.start + edge, watched.end - edge
    for axes, size in zip(panels, reversed(SIZES_MM), strict=True):
        for case, colour, dashes, name in (
            (case_name(size, subject.friction), style.WITH_CLEARANCE, "-", f"friction {subject.friction:g}"),
            (case_name(size, 0.0), style.SMOOTH, "-", "no friction"),
            (ideal_name(subject.friction), style.IDEAL, (0, (1, 1)), f"ideal, friction {subject.friction:g}"),
            (ideal_name(0.0), style.IDEAL, DASHED, "ideal, no friction"),
        ):
            run = results[case]
            inside = rise.between(run, *span)
            axes.plot(
                run.time[inside], scale * run[channel][inside], color=colour, lw=0.8, ls=dashes, label=name
            )
        axes.set(xlim=(watched.start, watched.end), ylabel=label)
        axes.annotate(
            f"{size:.1f} mm", (0.5, 1.0), (0.0, 3.0), "axes fraction", "offset points", ha="center", fontsize=8
        )
        time_ticks(axes, watched)
        axes.label_outer()
    for axes in panels[2:]:
        axes.set_xlabel("time [s]")
    legend(drawing, panels[0], 2)
    letters(panels)
    return drawing


def tip_path_figure(subject: Subject, results: Results) -> Figure:
    """Height over horizontal position."""
    drawing = Figure(figsize=style.size(170, 85))
    whole, near = drawing.subplots(1, 2)
    watched = subject.watched
    for axes in (whole, near):
        for case, colour, dashes, label in _cases(subject):
            run = results[case]
            inside = watched.in_rise(run)
            axes.plot(
                1e3 * run["tip.x"][inside], 1e3 * run["tip.y"][inside], color=colour, ls=dashes, label=label
            )
        axes.set(xlabel="tip, horizontal [mm]", ylabel="tip, height [mm]")
    forward_arrow(whole)
    middle, half = 0.5 * (watched.start + watched.end), 0.05 * (watched.end - watched.start)
    near_ones = [run for case, *_ in _cases(subject) for run in (results[case],)]
    cuts = [(run, rise.between(run, middle - half, middle + half)) for run in near_ones]
    x = [1e3 * run["tip.x"][inside] for run, inside in cuts]
    y = [1e3 * run["tip.y"][inside] for run, inside in cuts]
    near.set(xlim=(min(map(min, x)) - 1.0, max(map(max, x)) + 1.0), ylim=(min(map(min, y)), max(map(max, y))))
    legend(drawing, whole, 5)
    letters([whole, near])
    return drawing


def tip_shift_figure(subject: Subject, results: Results) -> Figure:
    """Horizontal position over time, and its distance from that with the ideal pin."""
    drawing = Figure(figsize=style.size(170, 115))
    panels = list(drawing.subplots(2, 1, sharex=True))
    place, shift = panels
    watched = subject.watched
    _curves(place, subject, results, "tip.x", 1e3, (watched.start, watched.end))
    for case, colour, dashes, label in _cases(subject):
        if case != ideal_of(case):
            run = results[case]
            moved = 1e3 * watched.departure(run, results[ideal_of(case)], "tip.x")
            shift.plot(run.time[watched.in_rise(run)], moved, color=colour, ls=dashes, label=label)
    place.set(ylabel="tip, horizontal [mm]")
    shift.axhline(0.0, color=style.IDEAL, lw=0.8, ls=DASHED)
    shift.set(ylabel="shift of the tip [mm]", xlabel="time [s]", xlim=(watched.start, watched.end))
    for axes in panels:
        time_ticks(axes, watched)
        axes.label_outer()
    legend(drawing, place, 5)
    letters(panels)
    return drawing


def angle_figure(subject: Subject, results: Results) -> Figure:
    """Angles of both columns, and their change."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, 2, sharex=True)
    watched = subject.watched
    for n, column in enumerate(COLUMNS):
        whole, change = panels[:, n]
        ideal = rise.rearward_angle(results[ideal_name(subject.friction)], column)
        for case, colour, dashes, label in _cases(subject):
            run = results[case]
            inside = watched.in_rise(run)
            angle = rise.rearward_angle(run, column)
            whole.plot(run.time[inside], rise.DEGREES * angle[inside], color=colour, ls=dashes, label=label)
            change.plot(
                run.time[inside], rise.DEGREES * (angle - ideal)[inside], color=colour, ls=dashes, label=label
            )
        name = column.replace("_", " ")
        whole.set(ylabel=f"{name} [deg]")
        change.set(ylabel=f"{name}, change [deg]", xlabel="time [s]", xlim=(watched.start, watched.end))
    for axes in panels.flat:
        time_ticks(axes, watched)
    legend(drawing, panels[0, 0], 5)
    letters(list(panels.flat))
    return drawing


TRENDS = (
    ("mean_pin_force", 1e-3, "mean force [kN]"),
    ("std_pin_force", 1e-3, "std. deviation\nof force [kN]"),
    ("rms_pin_force", 1e-3, "fluctuation\nof force [kN]"),
    ("rms_angular_velocity", 1.0, "fluctuation of ang.\nvelocity [deg/s]"),
    ("rms_angular_acceleration", 1.0, "fluctuation of ang.\nacceleration [deg/s²]"),
    ("mean_tip_shift", 1.0, "tip shift [mm]"),
)
FROM_ZERO = "rms_"  # such names begin their axis at 0


def trend_figure(subject: Subject, found: Found) -> Figure:
    """Statistics over the clearance, with and without friction."""
    shown = [trend for trend in TRENDS if (trend[0], ideal_name(0.0)) in found]
    drawing = Figure(figsize=style.size(170, 100))
    panels = list(drawing.subplots(2, 3).flat)
    for axes in panels[len(shown) :]:
        axes.remove()
    for axes, (name, scale, label) in zip(panels, shown, strict=False):
        for friction, colour, mark in ((subject.friction, style.WITH_CLEARANCE, "o"), (0.0, NO_FRICTION, "s")):
            row = [found[name, case_name(size, friction)] for size in SIZES_MM]
            axes.errorbar(
                SIZES_MM, [scale * n.value for n in row], yerr=[scale * n.numerical_error for n in row],
                color=colour, marker=mark, ms=3.5, capsize=2, lw=0.9,
                label=f"friction {friction:g}" if friction else "no friction",
            )  # fmt: skip
            printed = [scale * n.paper for n in row if n.paper is not None]
            if len(printed) == len(SIZES_MM):
                axes.plot(SIZES_MM, printed, "x", color=style.PAPER, ms=5, label="paper")
            ideal = found[name, ideal_name(friction)]
            tight = f"ideal, friction {friction:g}" if friction else "ideal, no friction"
            axes.axhline(scale * ideal.value, color=colour, lw=0.8, ls=DASHED, label=tight)
        axes.set(xticks=SIZES_MM, ylabel=label, xlabel="clearance [mm]")
        axes.margins(y=0.12)
        if name.startswith(FROM_ZERO):
            axes.set_ylim(0.0, None)
    legend(drawing, panels[0], 3)
    letters(panels[: len(shown)])
    return drawing


def _cases(subject: Subject) -> list[tuple[str, str, object, str]]:
    """Case, colour, dashes and label of the curves, the largest clearance undermost."""
    with_clearance = [
        (case_name(size, subject.friction), COLOURS[size], DASHES[size], f"{size:.1f} mm")
        for size in reversed(SIZES_MM)
    ]
    return [*with_clearance, (ideal_name(subject.friction), style.IDEAL, DASHED, "ideal pin")]


def _curves(
    axes: Axes, subject: Subject, results: Results, channel: str, scale: float, span: tuple[float, float]
) -> None:
    for case, colour, dashes, label in _cases(subject):
        run = results[case]
        axes.plot(run.time, scale * run[channel], color=colour, ls=dashes, lw=0.9, label=label)
    axes.set(xlim=span)
    fit_height(
        axes, (scale * results[c][channel][rise.between(results[c], *span)] for c, *_ in _cases(subject))
    )
