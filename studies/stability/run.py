"""Can friction-induced vibration of a loaded pin be predicted without a simulation?

The growth rate of small motions of a pin's journal, from inverse effective mass, contact law, load and friction
of a posture, beside the growth of a small motion in a run: four pins of the reference support in mid-rise, four
stiffnesses, three coefficients of friction. Maps of the growth rate over stroke and friction.
"""

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.common.numbers import Number
from studies.common.panels import finish, grid
from studies.common.paper_machine import clearance_rise
from studies.common.runs import run_cases
from studies.common.study import Study
from studies.common.words import text_table
from studies.stability.motions import (
    CASES,
    CLEARANCE,
    PINS,
    STIFFNESSES,
    Growth,
    PinCase,
    Prepared,
    all_scenarios,
    difference,
    growth,
    prepared,
    run_name,
)
from support_exudyn import Result, UniformSpeed
from support_exudyn.mechanics.pin_stability import PRECISE, critical_friction, painleve_friction
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.stability_map import draw_map
from support_exudyn.postprocessing.figures.stability_map import finish as colour_bar
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.scenario.pin_stability import PinOutlook, pin_outlooks

SHOWN = PinCase("rear_base", "cylinders", 0.1)  # whose motion is drawn
MAPPED = [(pin, stiffness) for stiffness in ("Eq. 5", "cylinders") for pin in ("rear_base", "rear_shield")]
STATIONS, EVERY = 21, 5  # of the stroke in a map, and which of them are asked for critical frictions
RISE = UniformSpeed(stroke=0.5, start=0.0, end=2.0)  # of which the maps are


class WholeStroke(NamedTuple):
    """A pin over the whole rise at a friction of 0.25.

    outlook: at all stations. critical, undamped, painleve: the smallest critical friction of the stroke, the
    same without damping, and the smallest Painleve threshold; infinite: none up to 1.
    """

    outlook: PinOutlook
    critical: float
    undamped: float
    painleve: float


def whole_stroke(case: PinCase) -> WholeStroke:
    """The pin of a case over the whole rise at constant speed; it slides all the way."""
    rise = clearance_rise(1e3 * CLEARANCE, case.friction, 1e-3)
    scenario = replace(rise, drive=RISE, duration=RISE.end, pins={case.pin: case.clearance_pin()})
    times = ((np.arange(STATIONS) + 0.5) / STATIONS * RISE.end).tolist()
    outlook = pin_outlooks(scenario, times, (case.pin,))[0]
    some, contact = outlook.journals[::EVERY], outlook.contact
    normal: Any = contact.normal
    undamped = replace(contact, normal=replace(normal, restitution=1.0))
    return WholeStroke(
        outlook,
        min(critical_friction(one, contact) for one in some),
        min(critical_friction(one, undamped) for one in some),
        min(painleve_friction(one, contact) for one in some),
    )


# --- figures ---

COLOURS = dict(zip(PINS, (style.WITH_CLEARANCE, style.THIRD, style.SMOOTH, style.PAPER), strict=True))
MARKERS = dict(zip(STIFFNESSES, ("o", "s", "D", "^"), strict=True))
LINEAR = 0.1  # [1/s] up to which the axes of growth rates are linear


def answer_figure(found: Sequence[Growth], shown: Prepared, runs: Mapping[str, Result]) -> Figure:
    """Measured over predicted growth rates (a), and the small motion of one case with what is predicted (b)."""
    drawing, panels = grid(88, 1, 2, width_ratios=(1.0, 1.15))
    rates, motion = panels.flat
    for one in found:
        case = one.prepared.case
        look = {"color": COLOURS[case.pin], "ms": 4, "mfc": "none", "mew": 0.9}
        rates.plot(one.predicted, one.measured, MARKERS[case.stiffness], **look)
    ends = (1.5 * min(one.predicted for one in found), 1.5 * max(one.predicted for one in found))
    rates.plot(ends, ends, color="#999999", lw=0.8, zorder=0.5)
    ticks = [-1.0, 0.0, 1.0, 10.0, 100.0]
    for name, axis in (("x", rates.xaxis), ("y", rates.yaxis)):
        getattr(rates, f"set_{name}scale")("symlog", linthresh=LINEAR)
        axis.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
        axis.set_ticks([], minor=True)
    rates.set(xlim=ends, ylim=ends, xlabel="predicted growth rate [1/s]", ylabel="in a run [1/s]")
    for pin, colour in COLOURS.items():
        rates.plot([], [], "o", color=colour, ms=4, label=pin)
    for name, marker in MARKERS.items():
        rates.plot([], [], marker, color="black", ms=4, mfc="none", label=name)
    drawing.legend(*rates.get_legend_handles_labels(), loc="outside lower left", ncols=4, fontsize=7)
    _motion(motion, shown, runs)
    return finish(drawing, panels)


def _motion(axes: Axes, shown: Prepared, runs: Mapping[str, Result]) -> None:
    """The difference of both runs of a case along the wall, between the curves of its predicted growth."""
    time, motion = difference(shown, runs, fine=True)
    normal = shown.predicted.place / np.linalg.norm(shown.predicted.place)
    across = motion @ np.array([-normal[1], normal[0]])
    growth = shown.predicted.growth
    axes.plot(1e3 * time, 1e9 * across, color=COLOURS[shown.case.pin], label="difference of two runs")
    size = np.max(np.abs(across) * np.exp(-growth * time))
    for sign in (1.0, -1.0):
        label = f"exp({growth:.3g}/s t), predicted" if sign > 0 else None
        axes.plot(
            1e3 * time, sign * 1e9 * size * np.exp(growth * time), "--", color="black", lw=0.8, label=label
        )
    axes.set(xlim=(0, 1e3 * time[-1]), xlabel="time [ms]", ylabel="motion along the wall [nm]")
    axes.legend(fontsize=7, loc="upper left")


# --- the study ---


class Stability(Study):
    """Can friction-induced vibration of a loaded pin be predicted without a simulation?"""

    name, seconds = "stability", 25.0

    def work(self) -> None:
        """Every case predicted and run, and the whole stroke predicted."""
        self.ready = {case.name: prepared(case) for case in CASES}
        self.runs = run_cases(all_scenarios(self.ready), self.chosen)
        self.growths = [growth(one, self.runs) for one in self.ready.values()]
        self.strokes = {
            (pin, stiffness): whole_stroke(PinCase(pin, stiffness, 0.25))
            for stiffness in STIFFNESSES
            for pin in PINS
        }
        self.numbers = [number for one in self.growths for number in one.numbers()]
        for (pin, stiffness), stroke in self.strokes.items():
            limits = {
                "critical_friction": stroke.critical,
                "critical_friction_undamped": stroke.undamped,
                "painleve_friction": stroke.painleve,
            }
            self.numbers += [  # that there is none is not a number of the summary
                Number(name, f"{pin}, {stiffness}", limit, "1", PRECISE)
                for name, limit in limits.items()
                if math.isfinite(limit)
            ]

    def saved(self) -> dict[str, Result]:
        return {SHOWN.name: self.runs[run_name(SHOWN.name, 0, fine=True)]}

    def figures(self) -> dict[str, Figure]:
        """The answer, and growth rates over stroke and friction for pins and stiffnesses."""
        drawing, panels = grid(120, 2, 2, sharex=True, sharey=True)
        for axes, (pin, stiffness) in zip(panels.flat, MAPPED, strict=True):
            colours = draw_map(axes, self.strokes[pin, stiffness].outlook)
            axes.set_title(f"{pin}, {stiffness}", fontsize=8)
        colour_bar(drawing, list(panels.flat), colours)
        answer = answer_figure(self.growths, self.ready[SHOWN.name], self.runs)
        return {"stability": answer, "map": finish(drawing, panels)}

    def tables(self) -> dict[str, Sheet]:
        """What is predicted over the whole stroke at a friction of 0.25."""
        rows = []
        for (pin, stiffness), stroke in self.strokes.items():
            outlook, worst = stroke.outlook, stroke.outlook.worst
            assert worst is not None
            fastest = outlook.found[worst]
            assert fastest is not None
            limits = (stroke.critical, stroke.undamped, stroke.painleve)
            rows.append((
                pin, stiffness, "stable" if outlook.stable else "shakes", f"{fastest.growth:.2f}",
                f"{fastest.frequency:.1f}", f"{1e3 * outlook.travels[worst]:.0f}", f"{1e6 * fastest.depth:.3g}",
                *(f"{limit:.3f}" if limit <= 1.0 else "none" for limit in limits),
            ))  # fmt: skip
        header = (
            "pin", "stiffness", "verdict", "fastest growth [1/s]", "at [Hz]", "at stroke [mm]", "depth [µm]",
            "critical friction", "without damping", "Painlevé's threshold",
        )  # fmt: skip
        return {"table_stroke": text_table(header, rows, left=3)}

    def words(self) -> dict[str, object]:
        shaking = {pin for (pin, _), stroke in self.strokes.items() if not stroke.outlook.stable}
        return {
            "run": sys.modules[__name__],
            "growths": self.growths,
            "by_name": {one.case: one for one in self.growths},
            "strokes": self.strokes,
            "shaking": [pin for pin in PINS if pin in shaking],
        }
