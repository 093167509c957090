"""What does a block do that falls on a set support, and what does clearance do to it?

The reference support and a ZF18000 at setting pressure under a roof load, struck at five places by blocks of
0.5 to 5 t from 0.2 to 2 m, with ideal pins and with 1.5 mm in one and in all of them, with yield valves and
without: pressures, flow, pin forces, tilt.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies.blow import blows as plan
from studies.blow.blows import (
    MIDDLE,
    PINS,
    PLACES,
    Blow,
    Ran,
    Struck,
    cases,
    numbers,
    ratios,
    strongest_pin,
    yield_valve,
)
from studies.common.numbers import Found, by_case, cell
from studies.common.options import Options
from studies.common.panels import finish
from studies.common.rise import DEGREES
from studies.common.runs import run_cases
from studies.common.study import Study, StudyOutcome
from studies.common.words import text_table
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet


def key_table(found: Found, machine: str) -> Sheet:
    """The middle blow on a machine with valves, a row a place."""
    rows = []
    for place in PLACES:
        blows = {pins: Blow(machine, place, *MIDDLE, pins, valve=True).name for pins in PINS}
        bare = Blow(machine, place, *MIDDLE, "ideal", valve=False).name
        pressures = [cell(found["pressure", name]) for name in (bare, blows["ideal"], blows["all"])]
        forces = [cell(found["pin_force", blows[pins]]) for pins in PINS]
        rows.append(
            (place, *pressures, cell(found["flow", blows["ideal"]]), *forces, cell(found["tilt", blows["all"]]))
        )
    header = (
        "place", "no valves, ideal [MPa]", "ideal [MPa]", "all loose [MPa]", "flow, ideal [l/min]",
        "pin, ideal [kN]", "pin, one loose [kN]", "pin, all loose [kN]", "tilt, all loose [deg]",
    )  # fmt: skip
    return text_table(header, rows, wide=True)


def clearance_table(found: Found, blows: Sequence[Blow]) -> Sheet:
    """Peaks with clearance over those with ideal pins: least, median, largest, by place."""
    rows = []
    for place in PLACES:
        row = [place]
        for measure in ("rise", "pin_force"):
            for pins in ("one", "all"):
                chosen = [one for one in blows if one.place == place and one.pins == pins and one.valve]
                values = ratios(found, measure, chosen, with_ideal_pins)
                row.append(f"{min(values):.2f}, {np.median(values):.2f}, {max(values):.2f}")
        rows.append(tuple(row))
    header = (
        "place", "rise of pressure, one loose", "rise of pressure, all loose", "pin force, one loose",
        "pin force, all loose",
    )  # fmt: skip
    return text_table(header, rows)


def with_ideal_pins(blow: Blow) -> Blow:
    """Give the same blow ideal pins, to compare with."""
    return replace(blow, pins="ideal")


def without_valves(blow: Blow) -> Blow:
    """Take the yield valves from the legs of a blow, to compare with."""
    return replace(blow, valve=False)


def overloaded(found: Found, blows: Sequence[Blow], *, valve: bool) -> tuple[int, int]:
    """How many blows raise a leg beyond 1.2 times its yield pressure, of how many."""
    chosen = [one for one in blows if one.valve is valve]
    limits = (1e-6 * OVERLOAD * yield_valve(one.machine).opening_pressure for one in chosen)
    over = sum(found["pressure", one.name].value > limit for one, limit in zip(chosen, limits, strict=True))
    return over, len(chosen)


def spread(
    found: Found, measure: str, blows: Sequence[Blow], change: Callable[[Blow], Blow]
) -> tuple[float, ...]:
    """Least, median and largest ratio of a measure to that of changed blows."""
    values = ratios(found, measure, list(blows), change)
    return min(values), float(np.median(values)), max(values)


def by_place(found: Found, machine: str) -> dict[str, float]:
    """Largest pin force of the middle blow with ideal pins and valves, by place [kN]."""
    return {
        place: found["pin_force", Blow(machine, place, *MIDDLE, "ideal", valve=True).name].value
        for place in PLACES
    }


def tail_pins(ran: Ran) -> list[tuple[str, int]]:
    """Which pin has the largest force in blows on the tail beam, and in how many; the most frequent first."""
    struck = [strongest_pin(blow, run) for blow, run in ran.values() if blow.place == "tail beam"]
    return Counter(struck).most_common()


# --- figures ---

OVERLOAD = 1.2  # of the yield force, up to which no part may fail (EN 1804-1, 4.3.2)
LOOKS = dict(zip(PINS, (style.CURVES[3], style.CURVES[1], style.CURVES[0]), strict=True))
TITLES = {"ideal": "ideal pins", "one": "1.5 mm in one pin", "all": "1.5 mm in all pins"}


def peak_figure(found: Found, machines: Sequence[str]) -> Figure:
    """Largest leg pressure and pin force of the middle blow, by place, a column for each machine."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = drawing.subplots(2, len(machines), sharex=True, squeeze=False)
    for column, machine in enumerate(machines):
        for row, (measure, label) in enumerate(
            (("pressure", "largest leg pressure [MPa]"), ("pin_force", "largest pin force [kN]"))
        ):
            axes = panels[row, column]
            for n, pins in enumerate(PINS):
                for valve in (True, False):
                    _points(axes, found, measure, machine, pins, valve=valve, shift=0.22 * (n - 1))
            axes.set_ylabel(label)
        limit = 1e-6 * yield_valve(machine).opening_pressure
        panels[0, column].axhline(limit, color="#777777", lw=0.8)
        panels[0, column].axhline(OVERLOAD * limit, color="#777777", lw=0.8, ls=(0, (4, 2)))
        panels[0, column].set_title(machine)
        for axes in panels[:, column]:
            axes.set_ylim(0.0, 1.05 * axes.get_ylim()[1])  # of all that is drawn
        panels[1, column].set_xticks(range(len(PLACES)), [place.replace(" ", "\n", 1) for place in PLACES])
    drawing.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=7)
    return finish(drawing, panels)


def _points(
    axes: Axes, found: Found, measure: str, machine: str, pins: str, *, valve: bool, shift: float
) -> None:
    colour, _ = LOOKS[pins]
    values = [found[measure, Blow(machine, place, *MIDDLE, pins, valve).name].value for place in PLACES]
    axes.plot(
        np.arange(len(PLACES)) + shift, values, "o" if valve else "^", color=colour, ms=4.5,
        mfc=colour if valve else "none", label=f"{TITLES[pins]}{'' if valve else ', no valves'}",
    )  # fmt: skip


def course_figure(ran: Ran, machine: str, mass: float, height: float) -> Figure:
    """Courses of a blow on the tip: pressure of the front legs, flow, force of a pin, turn of the canopy."""
    drawing = Figure(figsize=style.size(170, 120))
    panels = list(drawing.subplots(2, 2, sharex=True).flat)
    blow = Blow(machine, "tip", mass, height, "ideal", valve=True)
    for pins, (colour, dashes) in LOOKS.items():
        here, run = ran[replace(blow, pins=pins).name]
        struck = Struck(here, run)
        time = 1e3 * (struck.of("time") - here.strike)
        look = {"color": colour, "ls": dashes, "label": TITLES[pins]}
        panels[0].plot(time, 1e-6 * struck.of("front_column.pressure"), **look)
        panels[1].plot(time, 6e4 * struck.of("front_column.yield_flow"), **look)
        panels[2].plot(time, 1e-3 * struck.of("pin.front_base.force"), **look)
        panels[3].plot(time, DEGREES * struck.of("canopy.angle"), **look)
    bare, run = ran[replace(blow, valve=False).name]
    struck = Struck(bare, run)
    time = 1e3 * (struck.of("time") - bare.strike)
    panels[0].plot(
        time, 1e-6 * struck.of("front_column.pressure"), color=style.THIRD, lw=0.8, label="ideal, no valves"
    )
    for axes, label in zip(
        panels,
        ("front legs [MPa]", "flow of a pair's valves [l/min]", "pin front_base [kN]", "canopy [deg]"),
        strict=True,
    ):
        axes.set(ylabel=label, xlim=(0.0, 120.0))
    for axes in panels[2:]:
        axes.set_xlabel("time after the strike [ms]")
    return finish(drawing, panels, 4)


def clearance_figure(found: Found, blows: Sequence[Blow]) -> Figure:
    """Peaks with clearance over those with ideal pins: rise of the leg pressure (a), pin force (b)."""
    drawing = Figure(figsize=style.size(170, 80))
    panels = list(drawing.subplots(1, 2))
    for axes, measure, title in zip(
        panels, ("rise", "pin_force"), ("rise of the pressure", "pin force"), strict=True
    ):
        for pins in ("one", "all"):
            chosen = [one for one in blows if one.pins == pins and one.valve]
            ideal = [found[measure, replace(one, pins="ideal").name].value for one in chosen]
            loose = [found[measure, one.name].value for one in chosen]
            axes.plot(
                [1e-3 * one.energy for one in chosen], np.divide(loose, ideal), "o" if pins == "all" else "s",
                color=LOOKS[pins][0], mfc="none", ms=4.5, ls="none", label=TITLES[pins],
            )  # fmt: skip
        axes.axhline(1.0, color="#777777", lw=0.8)
        axes.set(xscale="log", xlabel="energy of the block [kJ]", ylabel=f"{title}, over ideal pins")
    return finish(drawing, panels, 2)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """All blows, their numbers, figures and tables; with a number of runs the small form."""
    blows = cases(small=chosen.runs is not None)
    runs = run_cases({one.name: one.scenario() for one in blows}, chosen)
    ran = {one.name: (one, runs[one.name]) for one in blows}
    machines = list(dict.fromkeys(one.machine for one in blows))
    reported = numbers(ran)
    found = by_case(reported)
    loose = {pins: [one for one in blows if one.pins == pins] for pins in ("one", "all")}
    valved = [one for one in blows if one.valve]
    largest = max(valved, key=lambda one: found["flow", one.name].value)
    hard = max({(one.mass, one.height) for one in blows}, key=lambda one: one[0] * one[1])
    shown = Blow(machines[0], "tip", *hard, "all", valve=True)
    words = {
        "plan": plan,
        "found": found,
        "count": len(blows),
        "compared": {pins: len(ratios(found, "rise", group, with_ideal_pins)) for pins, group in loose.items()},
        "machines": machines,
        "middle": {
            pins: Blow(machines[0], "tip", *MIDDLE, pins, valve=True).name for pins in PINS
        },
        "bare": Blow(machines[0], "tip", *MIDDLE, "ideal", valve=False).name,
        "on_pressure": {pins: spread(found, "rise", group, with_ideal_pins) for pins, group in loose.items()},
        "on_pins": {pins: spread(found, "pin_force", group, with_ideal_pins) for pins, group in loose.items()},
        "saved": spread(
            found, "pressure",
            [one for one in valved if found["flow", one.name].value > 0.0], without_valves,
        ),
        "opened": sum(found["flow", one.name].value > 0.0 for one in valved),
        "valved": len(valved),
        "over": {valve: overloaded(found, blows, valve=valve) for valve in (True, False)},
        "largest": largest.name,
        "rated": 6e4 * yield_valve(machines[0]).rated_flow,
        "places": by_place(found, machines[0]),
        "tail": tail_pins(ran),
        "shown": shown,
    }  # fmt: skip
    sheets = {
        "middle_blow": key_table(found, machines[0]),
        "clearance": clearance_table(found, blows),
        **({"middle_blow_zf18000": key_table(found, machines[1])} if len(machines) > 1 else {}),
    }
    drawings = {
        "peaks": peak_figure(found, machines),
        "courses": course_figure(ran, machines[0], *hard),
        "clearance_ratio": clearance_figure(found, blows),
    }
    kept = {name: runs[name] for name in (shown.name, with_ideal_pins(shown).name)}
    return StudyOutcome(reported, words, drawings, sheets, kept)


study = Study("blow", __doc__, work, seconds=340.0)
