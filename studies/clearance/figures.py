"""Counterparts of Fig. 3 to 12 of the paper."""

from collections.abc import Callable, Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import paper_machine, rise
from studies.common.numbers import Found
from studies.common.panels import error_bars, finish, fit_height, forward_arrow, grid, heading, time_ticks
from studies.common.paper_machine import CLEARANCE_MM, CLEARANCE_PIN, SIZES_MM, case_name, ideal_name, ideal_of
from studies.common.rise import DEGREES
from studies.common.study import LivePanels
from studies.common.subject import Subject
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

FRICTION = paper_machine.SLIDING_COEFFICIENT
IDEAL, IDEAL_DRY = (ideal_name(friction) for friction in (0.0, FRICTION))
SMOOTH, DRY = (case_name(CLEARANCE_MM, friction) for friction in (0.0, FRICTION))
CASES = (IDEAL, SMOOTH, IDEAL_DRY, DRY)  # of section 3
COLUMNS = ("front_column", "rear_column")
WINDOWS = ((3.0, 3.12), (4.0, 4.12), (4.6, 4.72))  # enlarged in Fig. 3 and 6 [s]
DASHED: style.Dashes = (0, (4, 2))
DOTTED: style.Dashes = (0, (1, 1))
COLOURS = {0.5: "#009E73", 1.0: "#E69F00", 1.5: "#0072B2", 2.0: "#CC79A7"}  # Okabe and Ito
DASHES: dict[float, style.Dashes] = {0.5: "-", 1.0: (0, (5, 1)), 1.5: (0, (3, 1, 1, 1)), 2.0: DOTTED}
NO_FRICTION = "#777777"
Results = Mapping[str, Result]
Looks = Mapping[str, Mapping[str, Any]]  # of curves, by case
Curve = Callable[[Result], rise.Series]  # of a run, at all records
FRICTIONS = f"friction {FRICTION}", "no friction"
LARGEST_FIRST = [f"{size:.1f} mm" for size in reversed(SIZES_MM)]
LIVE: dict[str, LivePanels] = {  # which panels are time series that readers can zoom
    "fig5_pin_force": {n: f"pin force, {one} [kN]" for n, one in enumerate(FRICTIONS)},
    "fig3_angular_velocity": (0,),
    "fig4_angular_acceleration": {n: f"acceleration, {one} [deg/s²]" for n, one in enumerate(FRICTIONS)},
    "fig6_angular_velocity": (0,),
    "fig7_angular_acceleration": {
        n: f"angular acceleration, {one} [deg/s²]" for n, one in enumerate(LARGEST_FIRST)
    },
    "fig8_pin_force": {n: f"pin force, {one} [kN]" for n, one in enumerate(LARGEST_FIRST)},
    "fig10_tip_shift": (0, 1),
    "fig11_column_angles": (0, 1, 2, 3),
}


INFLUENCE: Looks = {  # the largest fluctuation undermost
    DRY: {"color": style.WITH_CLEARANCE, "label": f"{CLEARANCE_MM} mm, friction {FRICTION}"},
    SMOOTH: {"color": style.SMOOTH, "lw": 1.2, "label": f"{CLEARANCE_MM} mm, no friction"},
    IDEAL_DRY: {"color": style.IDEAL, "ls": DOTTED, "lw": 1.0, "label": f"ideal pin, friction {FRICTION}"},
    IDEAL: {"color": style.IDEAL, "ls": DASHED, "lw": 1.0, "label": "ideal pin, no friction"},
}


def _sizes(subject: Subject) -> Looks:
    """The largest clearance undermost."""
    mu = subject.friction
    return {
        case_name(n, mu): {"color": COLOURS[n], "ls": DASHES[n], "label": f"{n:.1f} mm"}
        for n in reversed(SIZES_MM)
    } | {ideal_name(mu): {"color": style.IDEAL, "ls": DASHED, "label": "ideal pin"}}


def _of(channel: str, scale: float) -> Curve:
    return lambda run: scale * run[channel]


def _draw(
    axes: Axes,
    results: Results,
    looks: Looks,
    curve: Curve,
    span: tuple[float, float],
    watched: rise.Watched = rise.PAPER,
) -> None:
    """Curves of cases over time, between two times [s]."""
    for case, look in looks.items():
        run = results[case]
        inside = rise.between(run, *span)
        axes.plot(run.time[inside], curve(run)[inside], **{"lw": 0.9, **look})
    axes.set(xlabel="time [s]", xlim=span)
    time_ticks(axes, watched)


# --- section 3 ---


def influence_figures(results: Results) -> dict[str, Figure]:
    """All figures of section 3, by file name."""
    label = "angular acceleration\n[deg/s²]"
    # friction moves no ideal pin
    smooth = {case: look for case, look in INFLUENCE.items() if case != IDEAL_DRY}
    return {
        "fig5_pin_force": split_figure(results, rise.FORCE, 1e-3, "pin force [kN]"),
        "fig3_angular_velocity": window_figure(results, smooth, rise.PAPER, (0.0, rise.END)),
        "fig4_angular_acceleration": split_figure(results, rise.ACCELERATION, DEGREES, label),
    }


def split_figure(results: Results, channel: str, scale: float, label: str) -> Figure:
    """The whole run with friction and without, a panel each so that no peak hides another, and the rise.

    The largest value stands at its peak: of the force that of any step, which tables print, too.
    """
    drawing = Figure(figsize=style.size(170, 115))
    panels = drawing.subplot_mosaic([["dry", "smooth"], ["rise", "rise"]])
    curve, whole, unit = _of(channel, scale), [panels["dry"], panels["smooth"]], label.partition("[")[2][:-1]
    for axes, case in zip(whole, (DRY, SMOOTH), strict=True):
        run, looks = results[case], {one: INFLUENCE[one] for one in (case, ideal_of(case))}
        _draw(axes, results, looks, curve, (0.0, rise.END))
        values = curve(run)
        n = int(abs(values).argmax())
        peak = scale * run.largest_force[CLEARANCE_PIN] if channel == rise.FORCE else values[n]
        axes.annotate(
            f"{peak:.0f} {unit}", (run.time[n], values[n]), (8.0, 0.0), textcoords="offset points", fontsize=8,
            va="center", arrowprops={"arrowstyle": "-", "lw": 0.5},
        )  # fmt: skip
    low, high = min(axes.get_ylim()[0] for axes in whole), max(axes.get_ylim()[1] for axes in whole)
    for axes in whole:
        axes.set_ylim(low, high + 0.08 * (high - low))
    _draw(panels["rise"], results, INFLUENCE, curve, (rise.START, rise.END))
    inside = rise.START + 1e-3, rise.END - 1e-3
    fit_height(panels["rise"], (curve(run)[rise.between(run, *inside)] for run in results.values()))
    for axes in panels.values():
        axes.set_ylabel(label)
    return finish(drawing, list(panels.values()), 2, panels["rise"])


def window_figure(results: Results, looks: Looks, watched: rise.Watched, whole: tuple[float, float]) -> Figure:
    """The angular velocity, and three windows of the motion enlarged."""
    drawing, panels = grid(115, 2, 2)
    scale = (watched.end - watched.start) / (rise.END - rise.START)
    windows = [
        (watched.start + scale * (a - rise.START), watched.start + scale * (b - rise.START)) for a, b in WINDOWS
    ]
    curve = _of(watched.speed, DEGREES)
    for axes, span in zip(panels.flat, [whole, *windows], strict=True):
        _draw(axes, results, looks, curve, span, watched)
        axes.set_ylabel("angular velocity\n[deg/s]")
        fit_height(axes, (curve(run)[rise.between(run, *span)] for run in results.values()))
    first = panels[0, 0]
    for letter, span in zip("bcd", windows, strict=True):
        first.axvspan(*span, color="#dddddd", zorder=0)
        first.text(sum(span) / 2.0, first.get_ylim()[1], letter, ha="center", va="top", fontsize=7)
    return finish(drawing, panels, len(looks))


# --- section 4 ---


def size_figures(subject: Subject, results: Results, found: Found) -> dict[str, Figure]:
    """All figures that this machine has something for, by file name; the names are those of the paper's."""
    watched, channels = subject.watched, results[ideal_name(0.0)].channels
    acceleration = _of(watched.acceleration, DEGREES), "angular acceleration [deg/s²]"
    force, motion = (_of(watched.force, 1e-3), "pin force [kN]"), (watched.start, watched.end)
    drawings = {
        "trends_with_clearance": trend_figure(subject, found),
        "fig6_angular_velocity": window_figure(results, _sizes(subject), watched, motion),
        "fig7_angular_acceleration": panel_figure(subject, results, *acceleration),
        "fig8_pin_force": panel_figure(subject, results, *force),
    }
    if "tip.x" in channels:
        tip = {("tip, horizontal [mm]", "shift of the tip [mm]"): _of("tip.x", 1e3)}
        drawings["fig9_tip_path"] = tip_path_figure(subject, results)
        drawings["fig10_tip_shift"] = change_figure(subject, results, tip)
    if all(f"{column}.angle" in channels for column in COLUMNS):
        names = {column: column.replace("_", " ") for column in COLUMNS}
        angles: dict[tuple[str, str], Curve] = {
            (f"{name} [deg]", f"{name}, change [deg]"): lambda run, column=column: (  # type: ignore[misc]
                DEGREES * rise.rearward_angle(run, column)
            )
            for column, name in names.items()
        }
        drawings["fig11_column_angles"] = change_figure(subject, results, angles)
    return drawings


def panel_figure(subject: Subject, results: Results, curve: Curve, label: str) -> Figure:
    """A panel for each clearance, the largest first as in the paper, on one scale."""
    drawing, panels = grid(120, 2, 2, sharex=True, sharey=True)
    watched, mu = subject.watched, subject.friction
    edge = 1e-3 * (watched.end - watched.start)  # the jumps at both ends would set the scale
    for axes, size in zip(panels.flat, reversed(SIZES_MM), strict=True):
        looks: Looks = {
            case_name(size, mu): {"color": style.WITH_CLEARANCE, "label": f"friction {mu:g}"},
            case_name(size, 0.0): {"color": style.SMOOTH, "label": "no friction"},
            ideal_name(mu): {"color": style.IDEAL, "ls": DOTTED, "label": f"ideal, friction {mu:g}"},
            ideal_name(0.0): {"color": style.IDEAL, "ls": DASHED, "label": "ideal, no friction"},
        }
        _draw(axes, results, looks, curve, (watched.start + edge, watched.end - edge), watched)
        axes.set(xlim=(watched.start, watched.end), ylabel=label)
        time_ticks(axes, watched)
        heading(axes, f"{size:.1f} mm")
        axes.label_outer()
    return finish(drawing, panels, 2)


def tip_path_figure(subject: Subject, results: Results) -> Figure:
    """Height over horizontal position; and a tenth of it, in mid-motion, enlarged."""
    drawing, ((whole, near),) = grid(85, 1, 2)
    watched = subject.watched
    middle, half = 0.5 * (watched.start + watched.end), 0.05 * (watched.end - watched.start)
    ends: list[tuple[float, float]] = []
    for case, look in _sizes(subject).items():
        run = results[case]
        x, y = 1e3 * run["tip.x"], 1e3 * run["tip.y"]
        inside, close = watched.in_rise(run), rise.between(run, middle - half, middle + half)
        ends += zip(x[close], y[close], strict=True)
        for axes in (whole, near):
            axes.plot(x[inside], y[inside], lw=0.9, **look)
            axes.set(xlabel="tip, horizontal [mm]", ylabel="tip, height [mm]")
    forward_arrow(whole)
    x_ends, y_ends = zip(*ends, strict=True)
    near.set(xlim=(min(x_ends) - 1.0, max(x_ends) + 1.0), ylim=(min(y_ends), max(y_ends)))
    return finish(drawing, [whole, near], 5)


def change_figure(subject: Subject, results: Results, curves: Mapping[tuple[str, str], Curve]) -> Figure:
    """Curves over the motion, and below each its distance from that with the ideal pin.

    curves: by the labels of both panels.
    """
    drawing, panels = grid(118, 2, len(curves), sharex=True)
    watched, ideal = subject.watched, results[ideal_name(subject.friction)]
    motion = watched.start, watched.end
    for (label, change), curve, (upper, lower) in zip(curves, curves.values(), panels.T, strict=True):
        _draw(upper, results, _sizes(subject), curve, motion, watched)
        tight = curve(ideal)
        _draw(lower, results, _sizes(subject), lambda run, c=curve, t=tight: c(run) - t, motion, watched)  # type: ignore[misc]
        upper.set(ylabel=label, xlabel="")
        lower.set_ylabel(change)
    return finish(drawing, panels, 5)


TRENDS = (
    ("mean_pin_force", 1e-3, "mean force [kN]"),
    ("std_pin_force", 1e-3, "std. deviation\nof force [kN]"),
    ("rms_pin_force", 1e-3, "fluctuation\nof force [kN]"),
    ("rms_angular_velocity", 1.0, "fluctuation of ang.\nvelocity [deg/s]"),
    ("rms_angular_acceleration", 1.0, "fluctuation of ang.\nacceleration [deg/s²]"),
    ("mean_tip_shift", 1.0, "tip shift [mm]"),
)


def trend_figure(subject: Subject, found: Found) -> Figure:
    """Statistics over the clearance, with and without friction."""
    shown = [trend for trend in TRENDS if (trend[0], ideal_name(0.0)) in found]
    drawing, grid_of = grid(100, 2, 3)
    for axes in grid_of.flat[len(shown) :]:
        axes.remove()
    panels = grid_of.flat[: len(shown)]
    for axes, (name, scale, label) in zip(panels, shown, strict=True):
        for friction, colour, mark in ((subject.friction, style.WITH_CLEARANCE, "o"), (0.0, NO_FRICTION, "s")):
            row = [found[name, case_name(size, friction)] for size in SIZES_MM]
            rubbing = f"friction {friction:g}" if friction else "no friction"
            error_bars(
                axes, SIZES_MM, row, scale, color=colour, marker=mark, ms=3.5, capsize=2, lw=0.9, label=rubbing
            )
            printed = [scale * n.paper for n in row if n.paper is not None]
            if len(printed) == len(SIZES_MM):
                axes.plot(SIZES_MM, printed, "x", color=style.PAPER, ms=5, label="paper")
            ideal = scale * found[name, ideal_name(friction)].value
            axes.axhline(ideal, color=colour, lw=0.8, ls=DASHED, label=f"ideal, {rubbing}")
        axes.set(xticks=SIZES_MM, ylabel=label, xlabel="clearance [mm]")
        axes.margins(y=0.12)
        if name.startswith("rms_"):
            axes.set_ylim(0.0, None)
    return finish(drawing, panels, 3)
