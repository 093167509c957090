"""Rankings and tables of `which_pin`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from studies.common.chapter import Sheet
from studies.common.study import (
    Number,
    brief,
)
from studies.common.wording import against
from studies.which_pin.cases import ALIKE, CLEARANCE_MM, CONDITIONS, FORCES, FRICTIONS, IDEAL, SHAKEN, case_name
from support_exudyn.machines.four_bar_shield import PINS

RANKED = {  # title of a ranking: by what, and what else is shown
    "by the tip's position": (
        "mean_tip_shift_forward", "mean_tip_shift_up", "largest_tip_shift", "mean_canopy_tilt",
    ),
    "by the forces": ("largest_change_of_a_mean_force", "largest_peak_over_ideal"),
    "by the shaking": (
        "ripple_pin_forces", *(f"ripple_{body}_angular_acceleration" for body in SHAKEN), "energy_lost_in_rise",
    ),
}  # fmt: skip
Found = Mapping[tuple[str, str], Number]


def ranked(found: Found, name: str, friction: float) -> list[str]:
    """The pins, that with the largest effect alone first."""
    return sorted(PINS, key=lambda pin: -abs(found[name, case_name((pin,), friction)].value))


def ranking_sheet(found: Found, title: str, friction: float) -> Sheet:
    """Pins in the order of an effect, and all together last."""
    names = RANKED[title]
    rows = []
    for pins in [*((pin,) for pin in ranked(found, names[0], friction)), PINS]:
        case = case_name(pins, friction)
        rows.append((case.split(",")[0], *(_cell(found[name, case]) for name in names)))
    rows.append((IDEAL, *(_cell(found[name, IDEAL]) for name in names)))
    return Sheet(
        f"Pins {title}, friction {friction:g}",
        ("slack pin", *(f"{name.replace('_', ' ')} [{found[name, IDEAL].unit}]" for name in names)),
        tuple(rows),
        f"{CLEARANCE_MM} mm in the pin named, 3 to 5 s, the first column decides. Shift against ideal pins, "
        "minus to "
        "the rear. Force: of the five pins and two columns the one that changes most. Ripple: what is left "
        "when a "
        "moving mean of 0.1 s is taken away, of all five pin forces together.",
    )


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
        text += " = ".join(sorted(group, key=PINS.index))
    return text


def order_of(row: Mapping[str, Number]) -> str:
    """The order that numbers of pins make, by name of the pin."""
    effects = {pin: number.value for pin, number in row.items()}
    return in_order(effects, {pin: number.numerical_error for pin, number in row.items()})


def condition_sheet(found: Found) -> Sheet:
    """Orders by shift and by shaking under other frictions and clearances."""
    rows = []
    for name in ("mean_tip_shift_forward", "ripple_pin_forces"):
        for friction, size in CONDITIONS:
            cases = {pin: case_name((pin,), friction, size) for pin in PINS}
            if (name, cases[PINS[0]]) in found:
                row = {pin: found[name, case] for pin, case in cases.items()}
                order = order_of(row)
                what = f"{name.replace('_', ' ')} [{found[name, IDEAL].unit}]"
                rows.append(
                    (what, f"{friction:g}, {size:g} mm", *(f"{n.value:.4g}" for n in row.values()), order)
                )
    return Sheet(
        "Orders with other frictions and clearances, each pin alone",
        ("effect", "friction, clearance", *PINS, "order"),
        tuple(rows),
        f"Neighbours whose effects differ by less than {100.0 * ALIKE:g} % are joined by =; ? stands where "
        "numerical errors leave the order open.",
        left=2,
    )


def together_sheet(found: Found) -> Sheet:
    """Whether the whole is the sum of its parts."""
    rows = []
    for friction in FRICTIONS:
        for title, add in (("mean_tip_shift_forward", total), ("ripple_pin_forces", root_of_squares)):
            for pins in _together(found, friction):
                expected = add([found[title, case_name((pin,), friction)].value for pin in pins])
                whole = found[title, case_name(pins, friction)]
                rows.append((
                    case_name(pins, friction), title.replace("_", " "), whole.unit, f"{expected:.4g}",
                    _cell(whole), against(whole, replace(whole, value=expected)),
                ))  # fmt: skip
    return Sheet(
        "Alone and together",
        ("slack pins", "quantity", "unit", "of the single ones", "together", "difference"),
        tuple(rows),
        "Shifts are added; ripples are added as independent vibrations would, by their squares.",
        left=3,
    )


def _together(found: Found, friction: float) -> list[tuple[str, ...]]:
    sets = [PINS, *combinations(PINS, 2)]
    return [pins for pins in sets if ("ripple_pin_forces", case_name(pins, friction)) in found]


def total(parts: Sequence[float]) -> float:
    """What effects that add up come to."""
    return sum(parts)


def root_of_squares(parts: Sequence[float]) -> float:
    """What vibrations that know nothing of each other come to."""
    return float(np.sqrt(sum(part**2 for part in parts)))


def posture_sheet(found: Found) -> Sheet:
    """The simulated shift beside the closed form."""
    rows = []
    for name, case in found:
        if name != "closed_form_tip_shift_forward":
            continue
        run, form = found["mean_tip_shift_forward", case], found[name, case]
        off = 100.0 * (run.value / form.value - 1.0)
        rows.append((case, _cell(run), f"{form.value:.4f}", f"{off:+.2f} %"))
    return Sheet(
        "Shift of the tip from runs and from virtual work",
        ("case", "run [mm]", "closed form [mm]", "run is off by"),
        tuple(rows),
        "Forward, mean over the rise. Closed form: journals pressed along the loads of the ideal support by "
        "clearance "
        "and depth, turned by the angle of friction, first order; nothing is integrated.",
    )


def force_sheet(found: Found, friction: float) -> Sheet:
    """Mean forces with each slack pin."""
    cases = [IDEAL, *(case_name(pins, friction) for pins in [*((pin,) for pin in PINS), PINS])]
    rows = []
    for kind in ("mean_force", "ripple_force", "largest_force"):
        for name in FORCES.values():
            key = f"{kind}_{name}"
            rows.append((
                kind.replace("_", " "), name.replace("_", " "), *(_cell(found[key, case]) for case in cases),
            ))  # fmt: skip
    return Sheet(
        f"Forces in the rise, friction {friction:g} [N]",
        ("what", "where", *(case.split(",")[0] for case in cases)),
        tuple(rows),
        "Columns: thrust.",
        left=2,
    )


def _cell(number: Number) -> str:
    return brief(number.value, number.numerical_error)
