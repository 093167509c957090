"""Pictures of which pin matters: shifts of the tip, forces, shaking, and the shift under other loads."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common import paper_machine
from studies.common.numbers import Found
from studies.common.panels import legend
from studies.which_pin.cases import ALL
from studies.which_pin.posture import UnderLoad
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.postprocessing.figures import style

MU = paper_machine.SLIDING_COEFFICIENT
PLAIN = "#777777"  # without friction, as in the study of the clearance's size
HATCH = "///"
CASES = (*PINS, ALL)
MEMBERS = (*PINS, "front_column", "rear_column")
COLOURS = dict(
    zip(PINS, (style.WITH_CLEARANCE, style.SMOOTH, style.THIRD, "#CC79A7", style.IDEAL), strict=True)
)
DASHES = dict(zip(PINS, ("-", (0, (5, 1)), (0, (1, 1)), (0, (3, 1, 1, 1)), "-"), strict=True))
MARKS = dict(zip(PINS, "osD^x", strict=True))


def figures(found: Found, under_loads: Mapping[str, UnderLoad]) -> dict[str, Figure]:
    """All figures, by file name."""
    return {
        "tip_shift": shift_figure(found),
        "forces": force_figure(found),
        "shaking": shaking_figure(found),
        "other_loads": load_figure(under_loads),
    }


def _case(pins: str, friction: float) -> str:
    return f"{pins}, mu_d = {friction:g}"


def shift_figure(found: Found) -> Figure:
    """Bars of the forward shift, and single shifts end to end in the plane."""
    drawing = Figure(figsize=style.size(170, 85))
    bars, plane = drawing.subplots(1, 2, width_ratios=(1.2, 1.0))
    _bars(bars, found, "mean_tip_shift_forward", 1.0)
    places = np.arange(len(CASES))
    for friction, side in ((MU, -0.2), (0.0, 0.2)):
        values = [found["closed_form_tip_shift_forward", _case(name, friction)].value for name in CASES]
        label = "virtual work" if friction else None
        bars.plot(places + side, values, "x", color=style.IDEAL, ms=4, mew=1.0, label=label, zorder=4)
    bars.set(title="a) forward (minus: to the rear)", ylabel="mean shift of the tip [mm]")
    _end_to_end(plane, found)
    plane.set(title=f"b) end to end, friction {MU}", xlabel="forward [mm]", ylabel="up [mm]")
    drawing.legend(*bars.get_legend_handles_labels(), loc="outside lower left", ncols=3)
    plane.legend(fontsize=7, loc="upper right", handlelength=2.6)
    drawing.suptitle("What 1.5 mm in a pin moves the tip of the canopy by")
    return drawing


def _end_to_end(axes: Axes, found: Found) -> None:
    """Arrows of single shifts one after the other, and that of all together."""
    at = np.zeros(2)
    for name in PINS:
        way = np.array([found[f"mean_tip_shift_{axis}", _case(name, MU)].value for axis in ("forward", "up")])
        axes.plot(*np.array([at, at + way]).T, color=COLOURS[name], ls=DASHES[name], lw=1.6, label=name)
        axes.plot(*(at + way), "o", color=COLOURS[name], ms=3)
        at = at + way
    whole = [found[f"mean_tip_shift_{axis}", _case(ALL, MU)].value for axis in ("forward", "up")]
    axes.plot(*whole, "*", color=style.CONTACT, ms=9, ls="none", label="all five together", zorder=4)
    axes.plot(0.0, 0.0, "+", color=style.IDEAL, ms=9, ls="none", label="ideal pins")
    axes.margins(0.08)
    axes.set_ylim(top=1.9 * whole[1])


def _bars(axes: Axes, found: Found, name: str, scale: float) -> None:
    """A pair of bars for each clearance pin, with and without friction."""
    places = np.arange(len(CASES))
    for friction, side, colour, hatch in ((MU, -0.2, style.WITH_CLEARANCE, None), (0.0, 0.2, "#cccccc", HATCH)):
        row = [found[name, _case(case, friction)] for case in CASES]
        axes.bar(
            places + side, [scale * n.value for n in row], 0.4, color=colour, hatch=hatch,
            edgecolor=style.IDEAL,
            yerr=[scale * n.numerical_error for n in row], capsize=2, error_kw={"lw": 0.8}, lw=0.5,
            label=f"friction {friction:g}" if friction else "no friction", zorder=3,
        )  # fmt: skip
    axes.set_xticks(places, [_broken(case) for case in CASES], fontsize=7)
    axes.grid(visible=False, axis="x")


def _broken(name: str) -> str:
    return name.replace("_", "\n").replace(" ", "\n")


def force_figure(found: Found) -> Figure:
    """Two tables in shades: change of means, and peaks over those of ideal pins."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, 1)
    changes = np.array(
        [
            [found[f"change_of_mean_force_{member}", _case(case, MU)].value for member in MEMBERS]
            for case in CASES
        ]
    )
    peaks = np.array([
        [
            100.0 * (found[f"largest_force_{member}", _case(case, MU)].value
            / found[f"largest_force_{member}", "ideal"].value - 1.0)
            for member in MEMBERS
        ]
        for case in CASES
    ])  # fmt: skip
    for axes, values, title in (
        (panels[0], changes, "a) change of the mean force [%]"),
        (panels[1], peaks, "b) largest force in the rise against ideal pins [%]"),
    ):
        _shades(axes, values)
        axes.set_title(title)
        axes.set_ylabel("clearance pin")
    panels[1].set_xlabel("force in")
    drawing.suptitle(f"Forces in the rise with 1.5 mm in a pin, friction {MU}")
    return drawing


def _shades(axes: Axes, values: np.ndarray) -> None:
    """Numbers on squares that are the darker the larger they are."""
    sizes = np.log10(np.maximum(np.abs(values), 0.1))
    axes.imshow(sizes, cmap="Blues", vmin=-1.0, vmax=max(2.0, float(sizes.max())) + 0.5, aspect="auto")
    for row, column in np.ndindex(values.shape):
        number = values[row, column]
        text = f"{number:+.1f}" if abs(number) < 100.0 else f"{number:+.0f}"
        dark = sizes[row, column] > 1.3
        axes.text(
            column, row, text, ha="center", va="center", fontsize=8, color="white" if dark else style.IDEAL
        )
    axes.set_xticks(range(len(MEMBERS)), [_broken(name) for name in MEMBERS], fontsize=7)
    axes.set_yticks(range(len(CASES)), [name.replace("_", " ") for name in CASES], fontsize=8)
    axes.grid(visible=False)
    axes.spines[:].set_visible(False)


def shaking_figure(found: Found) -> Figure:
    """RMS fluctuations on logarithmic scales."""
    drawing = Figure(figsize=style.size(170, 150))
    panels = drawing.subplots(3, 1, sharex=True)
    shown = (
        ("rms_pin_forces", 1e-3, "a) pin forces [kN]"),
        ("rms_rear_link_angular_acceleration", 1.0, "b) angular acceleration of the rear link [deg/s²]"),
        ("rms_canopy_angular_acceleration", 1.0, "c) angular acceleration of the canopy [deg/s²]"),
    )
    for axes, (name, scale, title) in zip(panels, shown, strict=True):
        _bars(axes, found, name, scale)
        axes.axhline(scale * found[name, "ideal"].value, color=style.IDEAL, ls=(0, (4, 2)), label="ideal pins")
        axes.set_yscale("log")
        axes.set_title(title)
    legend(drawing, panels[0], 3)
    drawing.suptitle("RMS fluctuation in the rise with 1.5 mm in a pin")
    return drawing


def load_figure(under_loads: Mapping[str, UnderLoad]) -> Figure:
    """A panel for each load."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, 3, sharex=True, sharey=True)
    for axes, letter, (name, under) in zip(panels.flat, "abcdef", under_loads.items(), strict=True):
        for pin in PINS:
            axes.plot(
                1e3 * under.extension, 1e3 * under.shift[pin], color=COLOURS[pin], ls=DASHES[pin], lw=1.2,
                marker=MARKS[pin], ms=3, markevery=2, label=pin,
            )  # fmt: skip
        axes.axhline(0.0, color=PLAIN, lw=0.5)
        axes.set_title(f"{letter}) {name}", fontsize=8)
    for axes in panels[1]:
        axes.set_xlabel("extension [mm]")
    drawing.supylabel("tip forward [mm]", fontsize=9)
    legend(drawing, panels[0, 0], 5)
    drawing.suptitle("Shift of the tip by 1.5 mm in a pin under other loads (virtual work)")
    return drawing
