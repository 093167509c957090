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

from studies.blow import cases as plan
from studies.blow.cases import MIDDLE, PINS, PLACES, Blow, cases, rated_flow, yield_pressure
from studies.blow.figures import OVERLOAD, clearance_figure, course_figure, peak_figure
from studies.blow.measures import MEASURES, Ran, numbers, ratios, strongest_pin
from studies.common.numbers import Found, by_case, cell
from studies.common.options import Options
from studies.common.runs import run_cases
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable


def key_table(found: Found, machine: str) -> TextTable:
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
    return TextTable(header, tuple(rows), wide=True, width=200)


def all_table(found: Found, blows: Sequence[Blow]) -> TextTable:
    """All measures of all blows."""
    rows = [(one.name, *(cell(found.get((name, one.name))) for name in MEASURES)) for one in blows]
    header = ("blow", *(f"{name.replace('_', ' ')} [{unit}]" for name, (unit, _) in MEASURES.items()))
    return TextTable(header, tuple(rows), in_chapter=False, width=240)


def clearance_table(found: Found, blows: Sequence[Blow]) -> TextTable:
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
    return TextTable(header, tuple(rows))


def with_ideal_pins(blow: Blow) -> Blow:
    """Give the same blow ideal pins, to compare with."""
    return replace(blow, pins="ideal")


def without_valves(blow: Blow) -> Blow:
    """Take the yield valves from the legs of a blow, to compare with."""
    return replace(blow, valve=False)


def overloaded(found: Found, blows: Sequence[Blow], *, valve: bool) -> tuple[int, int]:
    """How many blows raise a leg beyond 1.2 times its yield pressure, of how many."""
    chosen = [one for one in blows if one.valve is valve]
    limits = (1e-6 * OVERLOAD * yield_pressure(one.machine) for one in chosen)
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
        "rated": 6e4 * rated_flow(machines[0]),
        "places": by_place(found, machines[0]),
        "tail": tail_pins(ran),
        "shown": shown,
    }  # fmt: skip
    sheets = {
        "middle_blow": key_table(found, machines[0]),
        "clearance": clearance_table(found, blows),
        **({"middle_blow_zf18000": key_table(found, machines[1])} if len(machines) > 1 else {}),
        "all": all_table(found, blows),
    }
    drawings = {
        "peaks": peak_figure(found, machines),
        "courses": course_figure(ran, machines[0], *hard),
        "clearance_ratio": clearance_figure(found, blows),
    }
    kept = {name: runs[name] for name in (shown.name, with_ideal_pins(shown).name)}
    return StudyOutcome(reported, words, drawings, sheets, kept)


study = Study("blow", __doc__, work, seconds=340.0)
main = study.main
