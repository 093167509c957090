"""Rankings and tables of `which_pin`."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from studies.common.numbers import Found, Number, against, cell
from studies.common.words import TextTable
from studies.which_pin.cases import ALIKE, IDEAL, SHAKEN, PinPlan
from studies.which_pin.posture import UnderLoad
from support_exudyn.machines.four_bar_shield import PINS

SHIFT, SHAKING = "mean_tip_shift_forward", "rms_pin_forces"
RANKED = {  # title of a ranking: by what, and what else is shown
    "by the tip's position": (
        "mean_tip_shift_forward", "mean_tip_shift_up", "largest_tip_shift", "mean_canopy_tilt",
    ),
    "by the forces": ("largest_change_of_a_mean_force", "largest_peak_over_ideal"),
    "by the shaking": (
        "rms_pin_forces", *(f"rms_{body}_angular_acceleration" for body in SHAKEN), "energy_lost_in_rise",
    ),
}  # fmt: skip


def rankings(plan: PinPlan) -> dict[str, tuple[str, ...]]:
    """The rankings of a machine: of what it has."""
    if plan.subject.is_paper:
        return RANKED
    of_bodies = (f"rms_{body}_angular_acceleration" for body in plan.shaken)
    own = RANKED | {"by the shaking": (SHAKING, *of_bodies, "energy_lost_in_rise")}
    return {title: names for title, names in own.items() if plan.has_tip or "tip" not in title}


def effects_of(plan: PinPlan) -> tuple[str, ...]:
    """By what the pins of a machine are put in order: the tip's shift, if it has one, and the shaking."""
    return (SHIFT, SHAKING) if plan.has_tip else (SHAKING,)


def ranked(plan: PinPlan, found: Found, name: str, friction: float) -> list[str]:
    """The pins, that with the largest effect alone first."""
    effects = plan.alone(found, name, friction)
    return sorted(plan.pins, key=lambda pin: -abs(effects[pin].value))


def ranking_table(plan: PinPlan, found: Found, title: str, friction: float) -> TextTable:
    """Pins in the order of an effect, and all together last."""
    return _pins_in_order(plan, found, rankings(plan)[title], friction)


def _pins_in_order(plan: PinPlan, found: Found, names: Sequence[str], friction: float) -> TextTable:
    rows = []
    for pins in [*((pin,) for pin in ranked(plan, found, names[0], friction)), plan.pins]:
        case = plan.case_name(pins, friction)
        rows.append((case.split(",")[0], *(cell(found[name, case]) for name in names)))
    rows.append((IDEAL, *(cell(found[name, plan.ideal_name(plan.pins, friction)]) for name in names)))
    header = ("clearance pin", *(f"{name.replace('_', ' ')} [{found[name, IDEAL].unit}]" for name in names))
    return TextTable(header, tuple(rows))


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


def condition_table(plan: PinPlan, found: Found) -> TextTable:
    """Orders by shift and by shaking under other frictions and clearances."""
    rows = []
    for name in effects_of(plan):
        what = f"{name.replace('_', ' ')} [{found[name, IDEAL].unit}]"
        for friction, size in plan.conditions:
            if (name, plan.case_name(plan.pins[:1], friction, size)) in found:
                row = plan.alone(found, name, friction, size)
                numbers = (cell(n) for n in row.values())
                rows.append((what, f"{friction:g}, {size:g} mm", *numbers, order_of(row)))
    return TextTable(("effect", "friction, clearance", *plan.pins, "order"), tuple(rows), left=2, width=250)


def together_table(plan: PinPlan, found: Found) -> TextTable:
    """Whether the whole is the sum of its parts."""
    rows = []
    for friction in plan.frictions:
        for name in effects_of(plan):
            for pins in _together(plan, found, friction):
                whole, expected = (
                    found[name, plan.case_name(pins, friction)],
                    _expected(plan, found, name, pins, friction),
                )
                rows.append(
                    (
                        plan.case_name(pins, friction),
                        name.replace("_", " "),
                        whole.unit,
                        cell(expected),
                        cell(whole),
                        against(whole, expected),
                    )
                )
    header = ("clearance pins", "quantity", "unit", "of the single ones", "together", "difference")
    return TextTable(header, tuple(rows), left=3)


def _together(plan: PinPlan, found: Found, friction: float) -> list[tuple[str, ...]]:
    sets = [plan.pins, *combinations(plan.pins, 2)]
    return [pins for pins in sets if ("rms_pin_forces", plan.case_name(pins, friction)) in found]


def total(parts: Sequence[float]) -> float:
    """What effects that add up come to."""
    return sum(parts)


def root_of_squares(parts: Sequence[float]) -> float:
    """What vibrations that know nothing of each other come to."""
    return float(np.sqrt(sum(part**2 for part in parts)))


# how effects of single pins make that of several
ADD: dict[str, Callable[[Sequence[float]], float]] = {
    "mean_tip_shift_forward": total,
    "rms_pin_forces": root_of_squares,
}


def _expected(plan: PinPlan, found: Found, name: str, pins: Sequence[str], friction: float) -> Number:
    """What the effects of pins alone make together, with what their errors make of it."""
    alone, add = plan.alone(found, name, friction), ADD[name]
    values = {pin: alone[pin].value for pin in pins}
    whole = add([*values.values()])
    raised = (values | {pin: values[pin] + alone[pin].numerical_error} for pin in pins)
    error = sum(abs(add([*one.values()]) - whole) for one in raised)
    return Number(name, plan.case_name(pins, friction), whole, alone[pins[0]].unit, error)


@dataclass(frozen=True)
class Sum:
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


def posture_table(found: Found) -> TextTable:
    """The simulated shift beside the closed form."""
    rows = []
    for case, (run, form) in _closed_forms(found).items():
        rows.append((case, cell(run), f"{form.value:.4f}", f"{100.0 * (run.value / form.value - 1.0):+.2f} %"))
    return TextTable(("case", "run [mm]", "closed form [mm]", "run is off by"), tuple(rows))


def off_closed_form(found: Found) -> list[tuple[str, float]]:
    """Each case, and the share by which its shift is off the closed form."""
    return [(case, abs(run.value / form.value - 1.0)) for case, (run, form) in _closed_forms(found).items()]


def _closed_forms(found: Found) -> dict[str, tuple[Number, Number]]:
    """The simulated shift forward and that of the closed form, by case."""
    return {
        case: (found["mean_tip_shift_forward", case], form)
        for (name, case), form in found.items()
        if name == "closed_form_tip_shift_forward"
    }


def load_table(under_loads: Mapping[str, UnderLoad]) -> TextTable:
    """Shift of the tip by pin and load, and the order that it makes."""
    rows = []
    for name, under in under_loads.items():
        means = {pin: under.mean(pin) for pin in PINS}
        cells = (f"{1e3 * mean:.2f}" for mean in means.values())
        rows.append((name, *cells, f"{under.thrust / 1e3:.0f}", in_order(means)))
    return TextTable(
        ("load besides the weight", *PINS, "least column thrust [kN]", "order"), tuple(rows), width=170
    )


def key_table(plan: PinPlan, found: Found) -> TextTable:
    """What each pin does, with friction, the one that moves or shakes most first, and all together last."""
    friction = plan.frictions[0]
    wanted = (
        SHIFT, "mean_canopy_tilt", "largest_change_of_a_mean_force", "largest_peak_over_ideal", SHAKING,
    )  # fmt: skip
    return _pins_in_order(plan, found, [name for name in wanted if (name, IDEAL) in found], friction)


def force_table(plan: PinPlan, found: Found, friction: float) -> TextTable:
    """Mean forces with each clearance pin, with all of them, and with all ideal and the same friction."""
    sets = [*((pin,) for pin in plan.pins), plan.pins]
    cases = [*(plan.case_name(pins, friction) for pins in sets), plan.ideal_name(plan.pins, friction)]
    rows = []
    for kind in ("mean_force", "rms_force", "largest_force"):
        for name in plan.forces.values():
            cells = (cell(found[f"{kind}_{name}", case]) for case in cases)
            rows.append((kind.replace("_", " "), name.replace("_", " "), *cells))
    return TextTable(("what", "where", *(case.split(",")[0] for case in cases)), tuple(rows), left=2, width=170)
