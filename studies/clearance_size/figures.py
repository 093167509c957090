"""Counterparts of Fig. 6 to 11 of the paper."""

from collections.abc import Callable, Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import rise
from studies.common.numbers import Found
from studies.common.panels import WINDOWS, finish, fit_height, forward_arrow, grid, time_ticks
from studies.common.paper_machine import SIZES_MM, case_name, ideal_name
from studies.common.study import LivePanels
from studies.common.subject import Subject
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

COLUMNS = ("front_column", "rear_column")
COLOURS = {0.5: "#009E73", 1.0: "#E69F00", 1.5: "#0072B2", 2.0: "#CC79A7"}  # Okabe and Ito
DASHES: dict[float, style.Dashes] = {
    0.5: "-",
    1.0: (0, (5, 1)),
    1.5: (0, (3, 1, 1, 1)),
    2.0: (0, (1, 1)),
}  # for grey prints
NO_FRICTION = "#777777"
DASHED: style.Dashes = (0, (4, 2))  # of ideal pins
Results = Mapping[str, Result]
Curve = Callable[[Result], rise.Series]  # of a run, at all records


def figures(subject: Subject, results: Results, found: Found) -> dict[str, Figure]:
    """All figures that this machine has something for, by file name; the names are those of the paper's."""
    watched, degrees = subject.watched, rise.DEGREES
    acceleration = "angular acceleration [deg/s²]"
    drawings = {
        "trends_with_clearance": trend_figure(subject, found),
        "fig6_angular_velocity": velocity_figure(subject, results),
        "fig7_angular_acceleration": panel_figure(
            subject, results, watched.acceleration, degrees, acceleration
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
    """Which panels of those figures are time series that readers can zoom."""
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


def _looks(subject: Subject) -> list[tuple[str, str, style.Dashes, str]]:
    """Case, colour, dashes and label of the curves, the largest clearance undermost."""
    loose = [
        (case_name(size, subject.friction), COLOURS[size], DASHES[size], f"{size:.1f} mm")
        for size in reversed(SIZES_MM)
    ]
    return [*loose, (ideal_name(subject.friction), style.IDEAL, DASHED, "ideal pin")]


def _draw(axes: Axes, subject: Subject, results: Results, curve: Curve, along: Curve | None = None) -> None:
    """A curve of every clearance in the motion, over time or along another one."""
    for case, colour, dashes, label in _looks(subject):
        run = results[case]
        inside = subject.watched.in_rise(run)
        x = run.time if along is None else along(run)
        axes.plot(x[inside], curve(run)[inside], color=colour, ls=dashes, lw=0.9, label=label)
    if along is None:
        axes.set(xlim=(subject.watched.start, subject.watched.end), xlabel="time [s]")
        time_ticks(axes, subject.watched)


def _of(channel: str, scale: float) -> Curve:
    return lambda run: scale * run[channel]


def velocity_figure(subject: Subject, results: Results) -> Figure:
    """The motion and three windows of it; in the first panel the curves lie upon each other."""
    drawing, grid_of = grid(115, 2, 2)
    panels = grid_of.ravel()
    watched = subject.watched
    scale = (watched.end - watched.start) / (rise.END - rise.START)
    windows = [tuple(watched.start + scale * (end - rise.START) for end in one) for one in WINDOWS.values()]
    curve = _of(watched.speed, rise.DEGREES)
    for axes, span in zip(panels, [(watched.start, watched.end), *windows], strict=True):
        _draw(axes, subject, results, curve)
        axes.set(ylabel="angular velocity\n[deg/s]", xlim=span)
        fit_height(axes, (curve(run)[rise.between(run, *span)] for run in results.values()))
        time_ticks(axes, watched)
    top = panels[0].get_ylim()[1]
    for letter, span in zip("bcd", windows, strict=True):
        panels[0].axvspan(*span, color="#dddddd", zorder=0)
        panels[0].text(sum(span) / 2.0, top, letter, ha="center", va="top", fontsize=7)
    return finish(drawing, panels, 5)


def panel_figure(subject: Subject, results: Results, channel: str, scale: float, label: str) -> Figure:
    """A panel for each clearance, the largest first as in the paper, on one scale."""
    drawing, panels = grid(120, 2, 2, sharex=True, sharey=True)
    watched, friction = subject.watched, f"friction {subject.friction:g}"
    edge = 1e-3 * (watched.end - watched.start)  # the jumps at both ends would set the scale
    for axes, size in zip(panels.flat, reversed(SIZES_MM), strict=True):
        for case, colour, dashes, name in (
            (case_name(size, subject.friction), style.WITH_CLEARANCE, "-", friction),
            (case_name(size, 0.0), style.SMOOTH, "-", "no friction"),
            (ideal_name(subject.friction), style.IDEAL, (0, (1, 1)), f"ideal, {friction}"),
            (ideal_name(0.0), style.IDEAL, DASHED, "ideal, no friction"),
        ):
            run = results[case]
            inside = rise.between(run, watched.start + edge, watched.end - edge)
            values = scale * run[channel][inside]
            axes.plot(run.time[inside], values, color=colour, lw=0.8, ls=dashes, label=name)
        axes.set(xlim=(watched.start, watched.end), xlabel="time [s]", ylabel=label)
        axes.annotate(
            f"{size:.1f} mm", (0.5, 1.0), (0.0, 3.0), "axes fraction", "offset points", ha="center", fontsize=8
        )
        time_ticks(axes, watched)
        axes.label_outer()
    return finish(drawing, panels, 2)


def tip_path_figure(subject: Subject, results: Results) -> Figure:
    """Height over horizontal position; and a tenth of it, in mid-motion, enlarged."""
    drawing, ((whole, near),) = grid(85, 1, 2)
    watched = subject.watched
    for axes in (whole, near):
        _draw(axes, subject, results, _of("tip.y", 1e3), _of("tip.x", 1e3))
        axes.set(xlabel="tip, horizontal [mm]", ylabel="tip, height [mm]")
    forward_arrow(whole)
    middle, half = 0.5 * (watched.start + watched.end), 0.05 * (watched.end - watched.start)
    shown = [results[case] for case, *_ in _looks(subject)]
    cuts = [(run, rise.between(run, middle - half, middle + half)) for run in shown]
    x, y = ([1e3 * run[f"tip.{axis}"][inside] for run, inside in cuts] for axis in "xy")
    near.set(xlim=(min(map(min, x)) - 1.0, max(map(max, x)) + 1.0), ylim=(min(map(min, y)), max(map(max, y))))
    return finish(drawing, [whole, near], 5)


def tip_shift_figure(subject: Subject, results: Results) -> Figure:
    """Horizontal position over time, and its distance from that with the ideal pin."""
    drawing, ((place,), (shift,)) = grid(115, 2, 1, sharex=True)
    ideal = results[ideal_name(subject.friction)]
    _draw(place, subject, results, _of("tip.x", 1e3))
    _draw(shift, subject, results, lambda run: 1e3 * (run["tip.x"] - ideal["tip.x"]))
    place.set(ylabel="tip, horizontal [mm]")
    shift.set(ylabel="shift of the tip [mm]")
    for axes in (place, shift):
        axes.label_outer()
    return finish(drawing, [place, shift], 5)


def angle_figure(subject: Subject, results: Results) -> Figure:
    """Angles of both columns, and their change."""
    drawing, panels = grid(120, 2, 2, sharex=True)
    tight = results[ideal_name(subject.friction)]
    for column, (whole, change) in zip(COLUMNS, panels.T, strict=True):
        ideal = rise.DEGREES * rise.rearward_angle(tight, column)

        def angle(run: Result, column: str = column) -> rise.Series:
            return rise.DEGREES * rise.rearward_angle(run, column)

        _draw(whole, subject, results, angle)
        _draw(change, subject, results, lambda run, angle=angle, ideal=ideal: angle(run) - ideal)  # type: ignore[misc]
        name = column.replace("_", " ")
        whole.set(ylabel=f"{name} [deg]", xlabel="")
        change.set(ylabel=f"{name}, change [deg]")
    return finish(drawing, panels, 5)


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
    drawing, grid_of = grid(100, 2, 3)
    panels = grid_of.ravel()
    for axes in panels[len(shown) :]:
        axes.remove()
    for axes, (name, scale, label) in zip(panels, shown, strict=False):
        for friction, colour, mark in ((subject.friction, style.WITH_CLEARANCE, "o"), (0.0, NO_FRICTION, "s")):
            row = [found[name, case_name(size, friction)] for size in SIZES_MM]
            rubbing = f"friction {friction:g}" if friction else "no friction"
            axes.errorbar(
                SIZES_MM, [scale * n.value for n in row], yerr=[scale * n.numerical_error for n in row],
                color=colour, marker=mark, ms=3.5, capsize=2, lw=0.9, label=rubbing,
            )  # fmt: skip
            printed = [scale * n.paper for n in row if n.paper is not None]
            if len(printed) == len(SIZES_MM):
                axes.plot(SIZES_MM, printed, "x", color=style.PAPER, ms=5, label="paper")
            ideal = scale * found[name, ideal_name(friction)].value
            axes.axhline(ideal, color=colour, lw=0.8, ls=DASHED, label=f"ideal, {rubbing}")
        axes.set(xticks=SIZES_MM, ylabel=label, xlabel="clearance [mm]")
        axes.margins(y=0.12)
        if name.startswith(FROM_ZERO):
            axes.set_ylim(0.0, None)
    return finish(drawing, panels[: len(shown)], 3)
