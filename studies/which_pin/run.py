"""Which pin's clearance matters?

1.5 mm in each of the five pins of the reference support alone, in pairs, and in all together: what it does to
the tip's position, to the forces and to the shaking in the rise.
"""

import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from studies.common.numbers import Found, Number, against, cell
from studies.common.study import Study
from studies.common.words import text_table
from studies.which_pin import cases
from studies.which_pin.cases import ALIKE, FORCES, IDEAL, OVER_IDEAL, SHAKING, SHIFT, PinPlan
from studies.which_pin.closed_form import UnderLoad, loads
from studies.which_pin.figures import CLOSED_FORM, figures
from support_exudyn import Result, Scenario
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.postprocessing.page.pieces import Sheet

# --- tables and sentences ---


def ranked(plan: PinPlan, found: Found, name: str, friction: float) -> list[str]:
    """The pins, that with the largest effect alone first."""
    effects = plan.alone(found, name, friction)
    return sorted(plan.pins, key=lambda pin: -abs(effects[pin].value))


def in_order(effects: Mapping[str, float], errors: Mapping[str, float] | None = None) -> str:
    """Pins by the size of their effects, the largest first; those that are alike joined by =.

    errors: of the effects, zero by default. Between two groups stands > where every pin before is beyond the
    errors larger than every pin after, else ?.
    """
    errors = errors or dict.fromkeys(effects, 0.0)
    first, *rest = sorted(effects, key=lambda name: -abs(effects[name]))
    groups = [[first]]
    for name in rest:
        if abs(effects[name]) > (1.0 - ALIKE) * abs(effects[groups[-1][-1]]):
            groups[-1].append(name)
        else:
            groups.append([name])
    text = ""
    for n, group in enumerate(groups):
        if n > 0:
            before = [name for one in groups[:n] for name in one]
            after = [name for one in groups[n:] for name in one]
            least = min(abs(effects[name]) - errors[name] for name in before)
            most = max(abs(effects[name]) + errors[name] for name in after)
            text += " > " if least > most else " ? "
        text += " = ".join(sorted(group, key=list(effects).index))
    return text


def order_of(row: Mapping[str, Number]) -> str:
    """The order that numbers of pins make, by name of the pin."""
    effects = {pin: number.value for pin, number in row.items()}
    return in_order(effects, {pin: number.numerical_error for pin, number in row.items()})


def _effects(plan: PinPlan) -> list[str]:
    """By what the pins of a machine are put in order: the tip's shift, if it has one, and the shaking."""
    return [name for name in plan.rankings.values() if name != FORCES]


def condition_table(plan: PinPlan, found: Found) -> Sheet:
    """Orders by shift and by shaking under other frictions and clearances."""
    rows = []
    for name in _effects(plan):
        what = f"{name.replace('_', ' ')} [{found[name, IDEAL].unit}]"
        for friction, size in plan.conditions:
            if (name, plan.case_name(plan.pins[:1], friction, size)) in found:
                row = plan.alone(found, name, friction, size)
                numbers = (cell(n) for n in row.values())
                rows.append((what, f"{friction:g}, {size:g} mm", *numbers, order_of(row)))
    return text_table(("effect", "friction, clearance", *plan.pins, "order"), rows, left=2)


def together_table(plan: PinPlan, found: Found) -> Sheet:
    """Whether the whole is the sum of its parts."""
    rows = []
    for friction in plan.frictions:
        for name in _effects(plan):
            for pins in _together(plan, found, friction):
                case = plan.case_name(pins, friction)
                whole, expected = found[name, case], _expected(plan, found, name, pins, friction)
                both = cell(expected), cell(whole), against(whole, expected)
                rows.append((case, name.replace("_", " "), whole.unit, *both))
    header = ("clearance pins", "quantity", "unit", "of the single ones", "together", "difference")
    return text_table(header, rows, left=3)


def _together(plan: PinPlan, found: Found, friction: float) -> list[tuple[str, ...]]:
    sets = [plan.pins, *combinations(plan.pins, 2)]
    return [pins for pins in sets if (SHAKING, plan.case_name(pins, friction)) in found]


# how effects of single pins make that of several: shifts add up, independent vibrations by their squares
ADD: dict[str, Callable[[Sequence[float]], float]] = {
    SHIFT: sum,
    SHAKING: lambda parts: float(np.sqrt(np.sum(np.square(parts)))),
}


def _expected(plan: PinPlan, found: Found, name: str, pins: Sequence[str], friction: float) -> Number:
    """What the effects of pins alone make together, with what their errors make of it."""
    alone, add = plan.alone(found, name, friction), ADD[name]
    values = {pin: alone[pin].value for pin in pins}
    whole = add([*values.values()])
    raised = (values | {pin: values[pin] + alone[pin].numerical_error} for pin in pins)
    error = sum(abs(add([*one.values()]) - whole) for one in raised)
    return Number(name, plan.case_name(pins, friction), whole, alone[pins[0]].unit, error)


class Sum(NamedTuple):
    """How far some pins together are off what the single ones make.

    pins: what they are called. text: in words, to its error. off: in per cent of that.
    """

    pins: str
    text: str
    off: float


def sums(plan: PinPlan, found: Found, name: str, friction: float) -> list[Sum]:
    """All pins together against the single ones, and then every pair that was run."""
    result = []
    for pins in _together(plan, found, friction):
        whole = found[name, plan.case_name(pins, friction)]
        expected = _expected(plan, found, name, pins, friction)
        off = 100.0 * abs(whole.value / expected.value - 1.0)
        result.append(Sum(" + ".join(pins), against(whole, expected), off))
    return result


def off_closed_form(found: Found) -> list[tuple[str, float, Number, Number]]:
    """Each case, the share by which its shift is off the closed form, and both numbers."""
    pairs = [(case, found[SHIFT, case], form) for (name, case), form in found.items() if name == CLOSED_FORM]
    return [(case, abs(run.value / form.value - 1.0), run, form) for case, run, form in pairs]


def closed_form_tables(found: Found, under_loads: Mapping[str, UnderLoad]) -> dict[str, Sheet]:
    """The simulated shift with that of the closed form; shift of the tip by pin and load, and its order."""
    shifts = [
        (case, cell(run), f"{form.value:.4f}", f"{100.0 * (run.value / form.value - 1.0):+.2f} %")
        for case, _, run, form in off_closed_form(found)
    ]
    rows = []
    for name, under in under_loads.items():
        cells = (f"{1e3 * mean:.2f}" for mean in under.means().values())
        rows.append((name, *cells, f"{under.thrust / 1e3:.0f}", in_order(under.means())))
    header = ("load besides the weight", *PINS, "least column thrust [kN]", "order")
    return {
        "table_closed_form": text_table(("case", "run [mm]", "closed form [mm]", "run is off by"), shifts),
        "table_loads": text_table(header, rows),
    }


def key_table(plan: PinPlan, found: Found) -> Sheet:
    """The effects of each pin with friction, the largest first; then all pins together, and ideal pins."""
    friction = plan.frictions[0]
    wanted = SHIFT, "mean_canopy_tilt", FORCES, OVER_IDEAL, SHAKING
    names = [name for name in wanted if (name, IDEAL) in found]
    cases = [plan.case_name((pin,), friction) for pin in ranked(plan, found, names[0], friction)]
    cases.append(plan.case_name(plan.pins, friction))
    rows = [(case.split(",")[0], *(cell(found[name, case]) for name in names)) for case in cases]
    rows.append((IDEAL, *(cell(found[name, plan.ideal_name(plan.pins, friction)]) for name in names)))
    header = ("clearance pin", *(f"{name.replace('_', ' ')} [{found[name, IDEAL].unit}]" for name in names))
    return text_table(header, rows)


# --- the study ---


class WhichPin(Study):
    """Which pin's clearance matters?"""

    name, seconds, own_machine = "which_pin", 70.0, True

    @cached_property
    def plan(self) -> PinPlan:
        """The cases of the machine."""
        return PinPlan(self.subject)

    @cached_property
    def under_loads(self) -> Mapping[str, UnderLoad]:
        """The closed form under other loads, of the paper's support."""
        subject = self.subject
        return loads(subject.clearance_pin(subject.clearance_mm, 0.0)) if subject.is_paper else {}

    def cases(self) -> dict[str, Scenario]:
        """The motion with clearance pins and with ideal ones."""
        return self.plan.scenarios

    def measure(self, runs: Mapping[str, Result]) -> list[Number]:
        """Numbers of runs and closed form."""
        return self.plan.numbers(runs)

    def figures(self) -> dict[str, Figure]:
        """All figures."""
        return figures(self.plan, self.found, self.under_loads)

    def tables(self) -> dict[str, Sheet]:
        """All tables."""
        return {
            "which_pin": key_table(self.plan, self.found),
            "table_together": together_table(self.plan, self.found),
            **(closed_form_tables(self.found, self.under_loads) if self.subject.is_paper else {}),
            "table_conditions": condition_table(self.plan, self.found),
        }

    def words(self) -> dict[str, object]:
        """Orders, and sums of shifts."""
        means = {name: under.means() for name, under in self.under_loads.items()}
        conditions = condition_table(self.plan, self.found)
        return {
            "cases": cases,
            "plan": self.plan,
            "window": f"{self.plan.watched.window:g} s",
            "tables": sys.modules[__name__],
            "orders": {name: in_order(shifts) for name, shifts in means.items()},
            "shifts": {name: sum(shifts.values()) for name, shifts in means.items()},
            "rms_orders": [row for row in conditions.rows if row[0].startswith("rms")],
        }
