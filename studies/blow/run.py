"""What does a block do that falls on a set support, and what does clearance do to it?

The reference support and a ZF18000 at setting pressure under a roof load, struck at five places by blocks of
0.5 to 5 t from 0.2 to 2 m, with ideal pins and with 1.5 mm in one and in all of them, with yield valves and
without: pressures, flow, pin forces, tilt.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from studies.blow import blows as plan
from studies.blow.blows import BEFORE, MACHINES, PINS, PLACES, STRIKE, Blow, all_blows, middle, yield_valve
from studies.common.numbers import Found, Measures, cell
from studies.common.panels import finish, grid
from studies.common.rise import DEGREES, Series, between
from studies.common.study import Study
from studies.common.support_legs import PAIRS
from studies.common.words import text_table
from support_exudyn import Result, Scenario
from support_exudyn.machines.four_bar_shield import PINS as ALL_PINS
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet

OVERLOAD = 1.2  # of the yield force, up to which no part may fail (EN 1804-1, 4.3.2)


# --- measures ---


def struck(run: Result, channel: str) -> Series:
    """A channel from just before the blow on, shape (n,)."""
    values: Series = run[channel][between(run, STRIKE - BEFORE, float(run.time[-1]))]
    return values


def most(run: Result, channel: str, names: Iterable[str]) -> float:
    """The largest value of a channel of any of some members."""
    return max(float(struck(run, channel.format(name)).max()) for name in names)


def tilt(run: Result) -> float:
    """Largest turn of the canopy from its start, with its sign [rad]; negative: its tip goes down."""
    turn = struck(run, "canopy.angle") - struck(run, "canopy.angle")[0]
    return float(turn[np.argmax(np.abs(turn))])


def rise(run: Result) -> float:
    """Largest rise of the pressure of any leg above that before the blow [Pa]."""
    courses = [struck(run, f"{name}.pressure") for name in PAIRS]
    return max(float((course - course[0]).max()) for course in courses)


MEASURES: Measures = {
    "pressure": ("MPa", lambda run: 1e-6 * most(run, "{}.pressure", PAIRS)),
    "rise": ("MPa", lambda run: 1e-6 * rise(run)),
    "least_pressure": (
        "MPa", lambda run: 1e-6 * min(float(struck(run, f"{name}.pressure").min()) for name in PAIRS)
    ),
    "flow": ("l/min", lambda run: 6e4 * most(run, "{}.yield_flow", PAIRS)),
    "volume": ("l", lambda run: 1e3 * sum(float(struck(run, f"{name}.yielded")[-1]) for name in PAIRS)),
    "pin_force": ("kN", lambda run: 1e-3 * most(run, "pin.{}.force", ALL_PINS)),
    "tilt": ("deg", lambda run: DEGREES * tilt(run)),
    "block_force": ("kN", lambda run: 1e-3 * most(run, "{}.force", ("block",))),
}  # fmt: skip
OF_VALVES = ("flow", "volume")


# --- the study ---


class BlowStudy(Study):
    """What does a block do that falls on a set support, and what does clearance do to it?"""

    name, seconds = "blow", 340.0

    @cached_property
    def blows(self) -> list[Blow]:
        """All blows; with a number of runs those of the small form."""
        return all_blows(small=self.chosen.runs is not None)

    @cached_property
    def valved(self) -> list[Blow]:
        """The blows on legs with yield valves."""
        return [one for one in self.blows if one.valve]

    @property
    def shown(self) -> Blow:
        """The hardest blow on the tip, whose course is drawn."""
        hard = max({(one.mass, one.height) for one in self.blows}, key=lambda one: one[0] * one[1])
        return Blow(MACHINES[0], "tip", *hard, "all", valve=True)

    def cases(self) -> dict[str, Scenario]:
        return {one.name: one.scenario() for one in self.blows}

    def measures(self, run: Result) -> Measures:
        valved = "front_column.yield_flow" in run.channels
        return {name: about for name, about in MEASURES.items() if valved or name not in OF_VALVES}

    def saved(self) -> dict[str, Result]:
        return {name: self.runs[name] for name in (self.shown.name, replace(self.shown, pins="ideal").name)}

    def ratios(self, measure: str, blows: Iterable[Blow], **change: Any) -> list[float]:
        """A measure of blows over that of the same blows with other fields, where both were run."""
        pairs = [((measure, blow.name), (measure, replace(blow, **change).name)) for blow in blows]
        found = self.found
        return [
            found[one].value / found[other].value
            for one, other in pairs
            if one != other and one in found and other in found
        ]

    @staticmethod
    def spread(values: Sequence[float]) -> tuple[float, ...]:
        """Least, median and largest of some values."""
        return min(values), float(np.median(values)), max(values)

    def overloaded(self, blows: Iterable[Blow]) -> int:
        """How many blows raise a leg beyond 1.2 times its yield pressure."""
        limits = {machine: 1e-6 * OVERLOAD * yield_valve(machine).opening_pressure for machine in MACHINES}
        return sum(self.found["pressure", one.name].value > limits[one.machine] for one in blows)

    def tables(self) -> dict[str, Sheet]:
        """The middle blow on each machine with valves, a row a place; peaks over those with ideal pins."""
        columns: dict[str, tuple[str, str, bool]] = {  # measure, pins, valve
            "no valves, ideal [MPa]": ("pressure", "ideal", False),
            "ideal [MPa]": ("pressure", "ideal", True),
            "all loose [MPa]": ("pressure", "all", True),
            "flow, ideal [l/min]": ("flow", "ideal", True),
            "pin, ideal [kN]": ("pin_force", "ideal", True),
            "pin, one loose [kN]": ("pin_force", "one", True),
            "pin, all loose [kN]": ("pin_force", "all", True),
            "tilt, all loose [deg]": ("tilt", "all", True),
        }
        sheets, names_of = {}, {"reference": "middle_blow", "zf18000": "middle_blow_zf18000"}
        for machine in dict.fromkeys(one.machine for one in self.blows):
            rows = []
            for place in PLACES:
                names = ((name, middle(machine, place, pins, valve=v)) for name, pins, v in columns.values())
                rows.append((place, *(cell(self.found[name]) for name in names)))
            sheets[names_of[machine]] = text_table(("place", *columns), rows, wide=True)
        ratios: dict[str, tuple[str, str]] = {
            f"{title}, {pins} loose": (measure, pins)
            for measure, title in (("rise", "rise of pressure"), ("pin_force", "pin force"))
            for pins in ("one", "all")
        }

        def text(place: str, measure: str, pins: str) -> str:
            chosen = [one for one in self.valved if (one.place, one.pins) == (place, pins)]
            return ", ".join(
                f"{value:.2f}" for value in self.spread(self.ratios(measure, chosen, pins="ideal"))
            )

        by_place = [(place, *(text(place, *column) for column in ratios.values())) for place in PLACES]
        return {**sheets, "clearance": text_table(("place", *ratios), by_place)}

    def figures(self) -> dict[str, Figure]:
        return {
            "peaks": peak_figure(self.found, list(dict.fromkeys(one.machine for one in self.blows))),
            "courses": course_figure(self.runs, self.shown),
            "clearance_ratio": clearance_figure(self),
        }

    def words(self) -> dict[str, object]:
        on_tail = [self.runs[one.name] for one in self.blows if one.place == "tail beam"]
        tail = Counter(max(ALL_PINS, key=lambda pin: most(run, "pin.{}.force", (pin,))) for run in on_tail)
        return {
            "plan": plan,
            "opened": [one for one in self.valved if self.found["flow", one.name].value > 0.0],
            "first": MACHINES[0],
            "loose": {pins: [one for one in self.blows if one.pins == pins] for pins in ("one", "all")},
            "largest": max(self.valved, key=lambda one: self.found["flow", one.name].value).name,
            "tail": tail.most_common(),
        }


# --- figures ---

LOOKS = dict(zip(PINS, (style.CURVES[3], style.CURVES[1], style.CURVES[0]), strict=True))
TITLES = {"ideal": "ideal pins", "one": "1.5 mm in one pin", "all": "1.5 mm in all pins"}


def peak_figure(found: Found, machines: Sequence[str]) -> Figure:
    """Largest leg pressure and pin force of the middle blow, by place, a column for each machine."""
    drawing, panels = grid(120, 2, len(machines), sharex=True)
    labels = {"pressure": "largest leg pressure [MPa]", "pin_force": "largest pin force [kN]"}
    for column, machine in enumerate(machines):
        for axes, (measure, label) in zip(panels[:, column], labels.items(), strict=True):
            for n, (pins, (colour, _)) in enumerate(LOOKS.items()):
                for valve in (True, False):
                    names = [middle(machine, place, pins, valve=valve) for place in PLACES]
                    axes.plot(
                        np.arange(len(PLACES)) + 0.22 * (n - 1), [found[measure, name].value for name in names],
                        "o" if valve else "^", color=colour, ms=4.5, mfc=colour if valve else "none",
                        label=f"{TITLES[pins]}{'' if valve else ', no valves'}",
                    )  # fmt: skip
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


def course_figure(runs: Mapping[str, Result], shown: Blow) -> Figure:
    """Courses of a blow: pressure of the front legs, flow, force of a pin, turn of the canopy."""
    drawing, panels = grid(120, 2, 2, sharex=True)
    courses = {  # channel and scale, by label
        "front legs [MPa]": ("front_column.pressure", 1e-6),
        "flow of a pair's valves [l/min]": ("front_column.yield_flow", 6e4),
        "pin front_base [kN]": ("pin.front_base.force", 1e-3),
        "canopy [deg]": ("canopy.angle", DEGREES),
    }
    bare = runs[replace(shown, pins="ideal", valve=False).name]
    for axes, (label, (channel, scale)) in zip(panels.flat, courses.items(), strict=True):
        for pins, (colour, dashes) in LOOKS.items():
            run = runs[replace(shown, pins=pins).name]
            time = 1e3 * (struck(run, "time") - STRIKE)
            axes.plot(time, scale * struck(run, channel), color=colour, ls=dashes, label=TITLES[pins])
        axes.set(ylabel=label, xlim=(0.0, 120.0))
    time = 1e3 * (struck(bare, "time") - STRIKE)
    panels[0, 0].plot(
        time, 1e-6 * struck(bare, "front_column.pressure"), color=style.THIRD, lw=0.8, label="ideal, no valves"
    )
    for axes in panels[1]:
        axes.set_xlabel("time after the strike [ms]")
    return finish(drawing, panels, 4)


def clearance_figure(study: BlowStudy) -> Figure:
    """Peaks with clearance over those with ideal pins: rise of the leg pressure (a), pin force (b)."""
    drawing, panels = grid(80, 1, 2)
    titles = {"rise": "rise of the pressure", "pin_force": "pin force"}
    for axes, (measure, title) in zip(panels.flat, titles.items(), strict=True):
        for pins, mark in (("one", "s"), ("all", "o")):
            chosen = [one for one in study.valved if one.pins == pins]
            axes.plot(
                [1e-3 * one.energy for one in chosen], study.ratios(measure, chosen, pins="ideal"), mark,
                color=LOOKS[pins][0], mfc="none", ms=4.5, ls="none", label=TITLES[pins],
            )  # fmt: skip
        axes.axhline(1.0, color="#777777", lw=0.8)
        axes.set(xscale="log", xlabel="energy of the block [kJ]", ylabel=f"{title}, over ideal pins")
    return finish(drawing, panels, 2)
