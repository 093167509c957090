"""Pictures of which pin matters: shifts of the tip, forces, shaking, and the shift under other loads."""

from collections.abc import Mapping
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from studies.common.panels import error_bars, finish, forward_arrow, grid, heading, letters
from studies.which_pin.cases import SHAKING, SHIFT, PinCases
from studies.which_pin.closed_form import UnderLoad
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.postprocessing.figures import style

PLAIN = "#777777"  # without friction, as in the study of the clearance's size
HATCH = "///"
CLOSED_FORM = "closed_form_tip_shift_forward"
COLOURS = (style.WITH_CLEARANCE, style.SMOOTH, style.THIRD, "#CC79A7", style.IDEAL)
DASHES: tuple[style.Dashes, ...] = ("-", (0, (5, 1)), (0, (1, 1)), (0, (3, 1, 1, 1)), "-")
MARKS = dict(zip(PINS, "osD^x", strict=True))


def _cases(study: PinCases) -> dict[str, tuple[str, ...]]:
    """The clearance pins of what is drawn, each alone and all together, by their names in lines."""
    every = {pin: (pin,) for pin in study.pins} | {study.everything: study.pins}
    return {name.replace("_", "\n").replace(" ", "\n"): pins for name, pins in every.items()}


def _friction(friction: float) -> str:
    return f"friction {friction:g}" if friction else "no friction"


def shift_figure(study: PinCases) -> Figure:
    """Bars of the forward shift, and single shifts end to end in the plane."""
    drawing, ((bars, plane),) = grid(90, 1, 2, width_ratios=(1.2, 1.0))
    places = np.arange(len(study.pins) + 1)
    looks = ((-0.2, style.WITH_CLEARANCE, None), (0.2, "#cccccc", HATCH))
    for friction, (side, colour, hatch) in zip(study.frictions, looks, strict=True):
        row = [study.found[SHIFT, study.case_name(pins, friction)] for pins in _cases(study).values()]
        bars.barh(
            places + side, [n.value for n in row], 0.4, color=colour, hatch=hatch, edgecolor=style.IDEAL,
            xerr=[n.numerical_error for n in row], capsize=2, error_kw={"lw": 0.8}, lw=0.5,
            label=_friction(friction), zorder=3,
        )  # fmt: skip
        names = [(CLOSED_FORM, study.case_name(pins, friction)) for pins in _cases(study).values()]
        if names[0] in study.found:
            values, label = [study.found[name].value for name in names], "virtual work" if friction else None
            bars.plot(values, places + side, "x", color=style.IDEAL, ms=4, mew=1.0, label=label, zorder=4)
    bars.set_yticks(places, [*_cases(study)], fontsize=7)
    bars.invert_yaxis()
    bars.grid(visible=False, axis="y")
    bars.axvline(0.0, color=style.IDEAL, lw=0.6)
    bars.set_xlabel("mean shift of the tip forward [mm]")
    bars.xaxis.set_major_locator(MaxNLocator(5))
    _end_to_end(study, plane)
    plane.set(xlabel="forward [mm]", ylabel="up [mm]")
    forward_arrow(plane)
    letters([bars, plane])
    drawing.legend(*bars.get_legend_handles_labels(), loc="outside lower left", ncols=3)
    plane.legend(fontsize=7, loc="upper right", handlelength=2.6)
    return drawing


def _end_to_end(study: PinCases, axes: Axes) -> None:
    """Single shifts one after the other, and that of all together."""
    at, friction = np.zeros(2), study.frictions[0]

    def way_of(pins: tuple[str, ...]) -> np.ndarray:
        case = study.case_name(pins, friction)
        return np.array([study.found[f"mean_tip_shift_{axis}", case].value for axis in ("forward", "up")])

    for name, colour, dashes in zip(study.pins, cycle(COLOURS), cycle(DASHES), strict=False):
        way = way_of((name,))
        axes.plot(*np.array([at, at + way]).T, color=colour, ls=dashes, lw=1.6, label=name.replace("_", " "))
        axes.plot(*(at + way), "o", color=colour, ms=3)
        at = at + way
    whole = way_of(study.pins)
    together = f"{study.everything} together"
    axes.plot(*whole, "*", color=style.CONTACT, ms=9, ls="none", label=together, zorder=4)
    axes.plot(0.0, 0.0, "+", color=style.IDEAL, ms=9, ls="none", label="ideal pins")
    axes.margins(0.08)
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.1 * (high - low), high + 0.9 * (high - low))


def shaking_figure(study: PinCases) -> Figure:
    """RMS fluctuations with their errors, as points on logarithmic scales."""
    bodies = dict.fromkeys((study.subject.watched.body, study.shaken[-1]))
    shown = {SHAKING: (1e-3, "pin forces\n[kN]")} | {
        f"rms_{body}_angular_acceleration": (1.0, f"{body.replace('_', ' ')},\nacceleration\n[deg/s²]")
        for body in bodies
    }
    drawing, panels = grid(20 + 42 * len(shown), len(shown), 1, sharex=True)
    places = np.arange(len(study.pins) + 1)
    looks = ((-0.1, style.WITH_CLEARANCE, "o"), (0.1, PLAIN, "s"))
    for axes, (name, (scale, label)) in zip(panels.flat, shown.items(), strict=True):
        for friction, (side, colour, mark) in zip(study.frictions, looks, strict=True):
            row = [study.found[name, study.case_name(pins, friction)] for pins in _cases(study).values()]
            look: dict[str, Any] = {"fmt": mark, "color": colour, "ms": 5, "capsize": 3, "lw": 1.0}
            error_bars(axes, places + side, row, scale, label=_friction(friction), **look)
        ideal = scale * study.found[name, study.ideal_name(study.pins, study.frictions[0])].value
        axes.axhline(ideal, color=style.IDEAL, ls=(0, (4, 2)), label="ideal pins")
        axes.set_yscale("log")
        axes.set_ylabel(label)
        axes.set_xticks(places, [*_cases(study)], fontsize=7)
    drawing.align_ylabels(panels[:, 0])
    return finish(drawing, panels, 3)


def load_figure(under_loads: Mapping[str, UnderLoad]) -> Figure:
    """A panel for each load."""
    drawing, panels = grid(120, 2, 3, sharex=True, sharey=True)
    for axes, (name, under) in zip(panels.flat, under_loads.items(), strict=True):
        for pin, colour, dashes in zip(PINS, COLOURS, DASHES, strict=True):
            first = int(pin.endswith("_shield"))  # pins at both ends of a link have the same curve
            axes.plot(
                1e3 * under.extension, 1e3 * under.shift[pin], color=colour, ls=dashes, lw=1.2,
                marker=MARKS[pin], ms=4, markevery=(first, 2), label=pin.replace("_", " "),
            )  # fmt: skip
        axes.axhline(0.0, color=PLAIN, lw=0.5)
        heading(axes, name)
    for axes in panels[1]:
        axes.set_xlabel("extension [mm]")
    for axes in panels[:, 0]:
        axes.set_ylabel("tip forward [mm]")
    return finish(drawing, panels, 5)
