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

from studies.common.numbers import Number, against, cell
from studies.common.words import text_table
from studies.which_pin import cases
from studies.which_pin.cases import ALIKE, FORCES, IDEAL, OVER_IDEAL, SHAKING, SHIFT, PinCases
from studies.which_pin.closed_form import UnderLoad, loads
from studies.which_pin.figures import CLOSED_FORM, load_figure, shaking_figure, shift_figure
from support_exudyn.machines.four_bar_shield import PINS
from support_exudyn.postprocessing.page.pieces import Sheet

# how effects of single pins make that of several: shifts add up, independent vibrations by their squares
ADD: dict[str, Callable[[Sequence[float]], float]] = {
    SHIFT: sum,
    SHAKING: lambda parts: float(np.sqrt(np.sum(np.square(parts)))),
}


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


class Sum(NamedTuple):
    """How far some pins together are off what the single ones make.

    case, pins: what they are called. whole: their number. expected: by the single ones. text: by how much the
    whole is off, in words to its error. off: in per cent of the expected one.
    """

    case: str
    pins: str
    whole: Number
    expected: Number
    text: str
    off: float


class WhichPin(PinCases):
    """Which pin's clearance matters?"""

    name, seconds = "which_pin", 70.0

    @cached_property
    def under_loads(self) -> Mapping[str, UnderLoad]:
        """The closed form under other loads, of the paper's support."""
        subject = self.subject
        return loads(subject.clearance_pin(subject.clearance_mm, 0.0)) if subject.is_paper else {}

    def ranked(self, name: str, friction: float) -> list[str]:
        """The pins, that with the largest effect alone first."""
        effects = self.alone(name, friction)
        return sorted(self.pins, key=lambda pin: -abs(effects[pin].value))

    def sums(self, name: str, friction: float) -> list[Sum]:
        """All pins together against the single ones, and then every pair that was run."""
        alone, add, result = self.alone(name, friction), ADD[name], []
        for pins in [self.pins, *combinations(self.pins, 2)]:
            case = self.case_name(pins, friction)
            if (name, case) not in self.found:
                continue
            values = {pin: alone[pin].value for pin in pins}
            value, whole = add([*values.values()]), self.found[name, case]
            raised = (values | {pin: values[pin] + alone[pin].numerical_error} for pin in pins)
            error = sum(abs(add([*one.values()]) - value) for one in raised)
            expected = Number(name, case, value, whole.unit, error)
            off = 100.0 * abs(whole.value / value - 1.0)
            result.append(Sum(case, " + ".join(pins), whole, expected, against(whole, expected), off))
        return result

    @cached_property
    def off_closed_form(self) -> list[tuple[str, float, Number, Number]]:
        """Each case, the share by which its shift is off the closed form, and both numbers."""
        pairs = [
            (case, self.found[SHIFT, case], form)
            for (name, case), form in self.found.items()
            if name == CLOSED_FORM
        ]
        return [(case, abs(run.value / form.value - 1.0), run, form) for case, run, form in pairs]

    def figures(self) -> dict[str, Figure]:
        return {
            **({"tip_shift": shift_figure(self)} if self.has_tip else {}),
            "shaking": shaking_figure(self),
            **({"other_loads": load_figure(self.under_loads)} if self.under_loads else {}),
        }

    def tables(self) -> dict[str, Sheet]:
        """Effects of each pin, alone and together, closed forms, and orders under other conditions."""
        effects = [name for name in self.rankings.values() if name != FORCES]
        together = [
            (one.case, name.replace("_", " "), one.whole.unit, cell(one.expected), cell(one.whole), one.text)
            for friction in self.frictions
            for name in effects
            for one in self.sums(name, friction)
        ]
        header = ("clearance pins", "quantity", "unit", "of the single ones", "together", "difference")
        return {
            "which_pin": self._key_table(),
            "table_together": text_table(header, together, left=3),
            **(self._closed_forms() if self.subject.is_paper else {}),
            "table_conditions": self.conditions_table,
        }

    def _key_table(self) -> Sheet:
        """The effects of each pin with friction, the largest first; then all pins together, and ideal pins."""
        friction = self.frictions[0]
        wanted = SHIFT, "mean_canopy_tilt", FORCES, OVER_IDEAL, SHAKING
        names = [name for name in wanted if (name, IDEAL) in self.found]
        sets = [*((pin,) for pin in self.ranked(names[0], friction)), self.pins]
        rows = {(case := self.case_name(pins, friction)).split(",")[0]: case for pins in sets}
        rows[IDEAL] = self.ideal_name(self.pins, friction)
        header = (f"{name.replace('_', ' ')} [{self.found[name, IDEAL].unit}]" for name in names)
        return text_table(
            ("clearance pin", *header),
            [(label, *(cell(self.found[name, case]) for name in names)) for label, case in rows.items()],
        )

    def _closed_forms(self) -> dict[str, Sheet]:
        """The simulated shift with that of the closed form; shift of the tip by pin and load, and its order."""
        shifts = [
            (case, cell(run), f"{form.value:.4f}", f"{100.0 * (run.value / form.value - 1.0):+.2f} %")
            for case, _, run, form in self.off_closed_form
        ]
        rows = []
        for name, under in self.under_loads.items():
            cells = (f"{1e3 * mean:.2f}" for mean in under.means().values())
            rows.append((name, *cells, f"{under.thrust / 1e3:.0f}", in_order(under.means())))
        header = ("load besides the weight", *PINS, "least column thrust [kN]", "order")
        return {
            "table_closed_form": text_table(("case", "run [mm]", "closed form [mm]", "run is off by"), shifts),
            "table_loads": text_table(header, rows),
        }

    @cached_property
    def conditions_table(self) -> Sheet:
        """Orders by shift and by shaking under other frictions and clearances."""
        rows = []
        for name in (name for name in self.rankings.values() if name != FORCES):
            what = f"{name.replace('_', ' ')} [{self.found[name, IDEAL].unit}]"
            for friction, size in self.conditions:
                row = self.alone(name, friction, size)
                rows.append((what, f"{friction:g}, {size:g} mm", *map(cell, row.values()), order_of(row)))
        return text_table(("effect", "friction, clearance", *self.pins, "order"), rows, left=2)

    def words(self) -> dict[str, object]:
        means = {name: under.means() for name, under in self.under_loads.items()}
        return {
            "cases": cases,
            "window": f"{self.watched.window:g} s",
            "tables": sys.modules[__name__],
            "orders": {name: in_order(shifts) for name, shifts in means.items()},
            "shifts": {name: sum(shifts.values()) for name, shifts in means.items()},
            "rms_orders": [row for row in self.conditions_table.rows if row[0].startswith("rms")],
        }
