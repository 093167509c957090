"""Can it be told without a run whether a loaded pin that slides shakes?

The growth rate of small motions of a pin's journal, from inverse effective mass, contact law, load and friction
of a posture, beside the growth of a small motion in a run: four pins of the reference support in mid-rise, four
stiffnesses, three coefficients of friction. Maps of the growth rate over stroke and friction.
"""

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.paper_machine import clearance_rise
from studies.common.runs import run_cases
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.stability.cases import (
    CASES,
    CLEARANCE,
    PINS,
    STIFFNESSES,
    PinCase,
    all_scenarios,
    prepared,
    run_name,
)
from studies.stability.figures import answer_figure, map_figure
from studies.stability.measures import Growth, growth, numbers
from support_exudyn import UniformSpeed
from support_exudyn.mechanics.pin_stability import PRECISE, critical_friction, painleve_friction
from support_exudyn.scenario.pin_stability import PinOutlook, pin_outlooks

SHOWN = PinCase("rear_base", "cylinders", 0.1)  # whose motion is drawn
MAPPED = [(pin, stiffness) for stiffness in ("Eq. 5", "cylinders") for pin in ("rear_base", "rear_shield")]
STATIONS, EVERY = 21, 5  # of the stroke in a map, and which of them are asked for critical frictions
RISE = UniformSpeed(stroke=0.5, start=0.0, end=2.0)  # of which the maps are


@dataclass(frozen=True)
class WholeStroke:
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


def growth_table(found: Sequence[Growth]) -> TextTable:
    """Predicted and measured growth of every case."""
    rows = [
        (
            one.pin,
            one.stiffness,
            f"{one.friction:g}",
            f"{one.predicted:.2f}",
            f"{one.halved:.2f}",
            f"{100.0 * one.off:.1f} %",
            f"{one.frequency_predicted:.2f}",
            f"{one.frequency_measured:.2f}",
            "yes" if one.painleve else "",
        )
        for one in found
    ]
    header = (
        "pin",
        "stiffness",
        "friction",
        "growth rate, predicted [1/s]",
        "in a run [1/s]",
        "off",
        "frequency, predicted [Hz]",
        "in a run [Hz]",
        "beyond Painlevé",
    )
    return TextTable(header, tuple(rows), left=2, width=150)


def stroke_table(strokes: Mapping[tuple[str, str], WholeStroke]) -> TextTable:
    """What is predicted over the whole stroke at a friction of 0.25."""
    rows = []
    for (pin, stiffness), stroke in strokes.items():
        outlook = stroke.outlook
        worst = outlook.worst
        assert worst is not None
        told = outlook.found[worst]
        assert told is not None
        limits = [
            f"{limit:.3f}" if limit <= 1.0 else "none"
            for limit in (stroke.critical, stroke.undamped, stroke.painleve)
        ]
        rows.append(
            (
                pin,
                stiffness,
                "stable" if outlook.stable else "shakes",
                f"{told.growth:.2f}",
                f"{told.frequency:.1f}",
                f"{1e3 * outlook.travels[worst]:.0f}",
                f"{1e6 * told.depth:.3g}",
                *limits,
            )
        )
    header = (
        "pin",
        "stiffness",
        "verdict",
        "fastest growth [1/s]",
        "at [Hz]",
        "at stroke [mm]",
        "depth [µm]",
        "critical friction",
        "without damping",
        "Painlevé's threshold",
    )
    return TextTable(header, tuple(rows), left=3, width=150)


def stroke_numbers(strokes: Mapping[tuple[str, str], WholeStroke]) -> list[Number]:
    """Critical friction and threshold of every pin; that there is none is not a number of the summary."""
    told = []
    for (pin, stiffness), stroke in strokes.items():
        limits = {
            "critical_friction": stroke.critical,
            "critical_friction_undamped": stroke.undamped,
            "painleve_friction": stroke.painleve,
        }
        told += [
            Number(name, f"{pin}, {stiffness}", limit, "1", PRECISE)
            for name, limit in limits.items()
            if math.isfinite(limit)
        ]
    return told


def work(chosen: Options) -> StudyOutcome:
    """Every case predicted and run, and the whole stroke predicted."""
    ready = {case.name: prepared(case) for case in CASES}
    runs = run_cases(all_scenarios(ready), chosen)
    found = [growth(one, runs) for one in ready.values()]
    strokes = {
        (pin, stiffness): whole_stroke(PinCase(pin, stiffness, 0.25))
        for stiffness in STIFFNESSES
        for pin in PINS
    }
    reported = numbers(found) + stroke_numbers(strokes)
    words = {
        "run": sys.modules[__name__],
        "found": found,
        "by_name": {one.case: one for one in found},
        "strokes": strokes,
        "numbers": {(one.name, one.case): one for one in reported},
        "shaking": [pin for pin in PINS if any(not strokes[pin, name].outlook.stable for name in STIFFNESSES)],
    }
    drawings = {
        "stability": answer_figure(found, ready[SHOWN.name], runs),
        "map": map_figure({f"{pin}, {name}": strokes[pin, name].outlook for pin, name in MAPPED}),
    }
    tables = {"table_stroke": stroke_table(strokes), "table": growth_table(found)}
    kept = {SHOWN.name: runs[run_name(SHOWN.name, 0, fine=True)]}
    return StudyOutcome(reported, words, drawings, tables, kept)


study = Study("stability", __doc__, work, seconds=25.0)
main = study.main
