"""Which pin's clearance matters? (The paper sets the question aside and lets one pin rattle.)

1.5 mm in each of the five pins of the reference support alone, in pairs, and in all together: what it does to
the tip's position, to the forces and to the shaking in the rise.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from studies import paper_machine, rise
from studies.reporting.chapter import Chapter, Sheet
from studies.reporting.wording import against, by_case, how_sure, said
from studies.study import (
    Number,
    Options,
    Pair,
    brief,
    options,
    run_main,
    run_pairs,
    save_figures,
    show_table,
    write_summary,
)
from studies.which_pin_figures import figures, pictures
from studies.which_pin_posture import UnderLoad, load_sheet, loads, posture_numbers
from support_exudyn import ClearancePin, Result, Scenario, SolverSettings
from support_exudyn.figures import style
from support_exudyn.linkages.four_bar_shield import PINS
from user_forces import DepthSpeed, LankaraniNikravesh

STUDY = "which_pin"
CLEARANCE_MM = 1.5
FRICTIONS = (paper_machine.SLIDING_COEFFICIENT, 0.0)
CONDITIONS = ((0.25, 1.5), (0.1, 1.5), (0.25, 0.5), (0.0, 1.5))  # friction and clearance [mm], single pins
ADDS_UP = 2.0  # [%]: shifts whose sum is off by less are said to add up; ten times that for shaking
ALIKE = 0.05  # pins whose effects differ by less of the larger are said to be alike
IDEAL = "ideal"
ALL = "all five"
COLUMNS = ("front_column", "rear_column")
FORCES = {**{f"pin.{name}.force": name for name in PINS}, **{f"{name}.force": name for name in COLUMNS}}
SHAKEN = ("rear_link", "shield", "canopy")  # bodies whose angular acceleration is looked at


def slack_pin(friction: float, clearance_mm: float = CLEARANCE_MM) -> ClearancePin:
    """The paper's pin, with a damping that forgets how its contact once began.

    With the textbook's, which remembers it, a pin that was settled gently shakes eight times as much in the
    same rise as one that was dropped: pins could not be compared.
    """
    pin = paper_machine.loose_pin(clearance_mm, friction)
    law = LankaraniNikravesh(
        stiffness=paper_machine.stiffness(clearance_mm),
        restitution=paper_machine.RESTITUTION,
        damping_speed=DepthSpeed(),
    )
    return replace(pin, contact=replace(pin.contact, normal=law))


def case_name(pins: Sequence[str], friction: float, clearance_mm: float = CLEARANCE_MM) -> str:
    """What a case is called: its slack pins, their friction, and their clearance if it is another one."""
    named = ALL if len(pins) == len(PINS) else " + ".join(pins)
    other = "" if clearance_mm == CLEARANCE_MM else f", {clearance_mm:g} mm"
    return f"{named}, mu_d = {friction:g}{other}"


def scenarios(quick: bool) -> dict[str, Scenario]:
    """The ideal support, each pin alone and all together with and without friction, and in the full form pairs.

    They start settled, as a support stands that waits to be raised. The full form also has the single pins with
    less friction and with less clearance.
    """
    settings = SolverSettings(
        impact_steps=16 if quick else 128, growth=8.0 if quick else 1.0, backend="symbolic"
    )
    ideal = replace(paper_machine.ideal_rise(1e-3), record_period=2e-3 if quick else 1e-3)

    def slack(pins: Sequence[str], friction: float, clearance_mm: float = CLEARANCE_MM) -> Scenario:
        loose = {name: slack_pin(friction, clearance_mm) for name in pins}
        return replace(ideal, pins=loose, step=2e-3 if quick else 5e-4, solver=settings, start="settled")

    conditions = [(friction, CLEARANCE_MM) for friction in FRICTIONS] if quick else CONDITIONS
    cases = {case_name(PINS, friction): slack(PINS, friction) for friction in FRICTIONS} | {IDEAL: ideal}
    cases |= {case_name((pin,), *how): slack((pin,), *how) for how in conditions for pin in PINS}
    if not quick:
        cases |= {case_name(pins, 0.0): slack(pins, 0.0) for pins in combinations(PINS, 2)}
    return cases


# --- measures ---

Get = Callable[[Result, Result], float]  # of a run and that of ideal pins


def _mean_shift(channel: str, scale: float) -> Get:
    return lambda run, ideal: scale * float(rise.departure(run, ideal, channel).mean())


def _largest_shift(run: Result, ideal: Result) -> float:
    along, up = (rise.departure(run, ideal, name) for name in ("tip.x", "tip.y"))
    return 1e3 * float(np.hypot(along, up).max())


def _mean(channel: str) -> Get:
    return lambda run, ideal: float(run[channel][rise.in_rise(run)].mean())


def _change(channel: str) -> Get:
    return lambda run, ideal: 100.0 * (_mean(channel)(run, ideal) / _mean(channel)(ideal, ideal) - 1.0)


def _largest(channel: str) -> Get:
    return lambda run, ideal: float(np.abs(run[channel][rise.in_rise(run)]).max())


def _ripple(channel: str, scale: float = 1.0) -> Get:
    return lambda run, ideal: scale * rise.ripple(run, run[channel])


def _pin_ripple(run: Result, ideal: Result) -> float:
    """Root mean square of the ripples of all five pin forces [N]."""
    return float(np.sqrt(np.mean([rise.ripple(run, run[f"pin.{name}.force"]) ** 2 for name in PINS])))


def _most_changed(run: Result, ideal: Result) -> float:
    return max(abs(_change(channel)(run, ideal)) for channel in FORCES)


def _peak_over_ideal(run: Result, ideal: Result) -> float:
    return max(_largest(channel)(run, ideal) / _largest(channel)(ideal, ideal) for channel in FORCES)


def _lost(run: Result, ideal: Result) -> float:
    inside = rise.in_rise(run)
    lost = (run["energy.damping_loss"] + run["energy.friction_loss"])[inside]
    return float(lost[-1] - lost[0])


MEASURES: dict[str, tuple[str, Get]] = {
    "mean_tip_shift_forward": ("mm", _mean_shift("tip.x", 1e3)),
    "mean_tip_shift_up": ("mm", _mean_shift("tip.y", 1e3)),
    "largest_tip_shift": ("mm", _largest_shift),
    "mean_canopy_tilt": ("deg", _mean_shift("canopy.angle", rise.DEGREES)),
    "largest_change_of_a_mean_force": ("%", _most_changed),
    "largest_peak_over_ideal": ("1", _peak_over_ideal),
    "ripple_pin_forces": ("N", _pin_ripple),
    **{
        f"ripple_{body}_angular_acceleration": (
            "deg/s^2",
            _ripple(f"{body}.angular_acceleration", rise.DEGREES),
        )
        for body in SHAKEN
    },
    "ripple_tip_forward": ("mm", _ripple("tip.x", 1e3)),
    "energy_lost_in_rise": ("J", _lost),
    **{f"mean_force_{name}": ("N", _mean(channel)) for channel, name in FORCES.items()},
    **{f"change_of_mean_force_{name}": ("%", _change(channel)) for channel, name in FORCES.items()},
    **{f"ripple_force_{name}": ("N", _ripple(channel)) for channel, name in FORCES.items()},
    **{f"largest_force_{name}": ("N", _largest(channel)) for channel, name in FORCES.items()},
}


def measure(pairs: Mapping[str, Pair]) -> list[Number]:
    """All numbers of the runs, and those of the closed form beside them."""
    ideal = pairs[IDEAL].fine
    numbers = [
        pair.number(name, case, unit, _against(get, ideal))
        for case, pair in pairs.items()
        for name, (unit, get) in MEASURES.items()
    ]
    for case, pair in pairs.items():
        if case != IDEAL:
            numbers += posture_numbers(case, pair.fine.scenario)
    return numbers


def _against(get: Get, ideal: Result) -> Callable[[Result], float]:
    return lambda result: get(result, ideal)


# --- tables ---

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


def _order(row: Mapping[str, Number]) -> str:
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
                order = _order(row)
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
        for title, add in (("mean_tip_shift_forward", _sum), ("ripple_pin_forces", _root_of_squares)):
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


def _sum(parts: Sequence[float]) -> float:
    return sum(parts)


def _root_of_squares(parts: Sequence[float]) -> float:
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


# --- words ---


def chapter(found: Found, under_loads: Mapping[str, UnderLoad], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="Which pin's clearance matters",
        question="Which of the five pins is to be kept tight, and do worn pins add up?",
        method=(
            f"The rise of the first study (mode 2, 500 mm from 3 to 5 s), with {CLEARANCE_MM} mm of radial "
            "clearance "
            f"{'in one pin' if quick else 'in one pin, in two'}, or in all five. All pins "
            "have the bore of 131 mm and the contact that the paper gives its one pin: assumed, the others are "
            "not known. The support starts settled, standing on its "
            "pins as one does that waits to be raised.",
            "The damping is that of `DepthSpeed`, which forgets how a contact once began, and not the "
            "textbook's, "
            "which would make the shaking depend on whether the pin was set down gently or dropped.",
            "Beside the runs stands a closed form: under its load a journal lies against its bore at "
            "clearance and "
            "depth; virtual work says how far that moves the tip. It is also what tells how the ranking "
            "depends "
            "on load and stroke.",
            how_sure(quick),
        ),
        findings=_findings(found, under_loads),
        pictures=pictures(),
        sheets=(
            *(ranking_sheet(found, title, friction) for title in RANKED for friction in FRICTIONS),
            together_sheet(found),
            posture_sheet(found),
            load_sheet(under_loads, in_order),
            condition_sheet(found),
            *(force_sheet(found, friction) for friction in FRICTIONS),
        ),
        quick=quick,
    )


def _findings(found: Found, under_loads: Mapping[str, UnderLoad]) -> tuple[str, ...]:
    return (
        *(_ranking(found, title, friction) for title in RANKED for friction in FRICTIONS),
        *(_together_said(found, friction) for friction in FRICTIONS),
        _closed_form_said(found),
        _loads_said(under_loads),
        _conditions_said(found),
        "Only the slack pins have friction. With it the mean forces change by what that friction carries as "
        "well as "
        "by the slack; without it, by the slack alone.",
    )


def _ranking(found: Found, title: str, friction: float) -> str:
    name = RANKED[title][0]
    rows = {pin: found[name, case_name((pin,), friction)] for pin in PINS}
    order = _order(rows)
    numbers = ", ".join(f"{pin} {said(rows[pin])}" for pin in ranked(found, name, friction))
    return (
        f"Pins {title}, friction {friction:g}: {order} ({name.replace('_', ' ')}: {numbers}; all five together "
        f"{said(found[name, case_name(PINS, friction)])})."
    )


def _together_said(found: Found, friction: float) -> str:
    shift = _excess(found, "mean_tip_shift_forward", friction, _sum)
    shaking = _excess(found, "ripple_pin_forces", friction, _root_of_squares)
    adds = "shifts add up" if abs(shift) < ADDS_UP else "shifts do not add up"
    told = "cannot be told" if abs(shaking) > 10.0 * ADDS_UP else "can be told"
    return (
        f"Friction {friction:g}: the tip's shift with all five is {shift:+.1f} % off the sum of the single "
        f"ones: {adds}. The ripple of the pin forces is {shaking:+.0f} % off what independent vibrations "
        f"would give (root of the sum of squares): shaking {told} from the single pins."
    )


def _closed_form_said(found: Found) -> str:
    off = {
        case: abs(found["mean_tip_shift_forward", case].value / number.value - 1.0)
        for (name, case), number in found.items()
        if name == "closed_form_tip_shift_forward"
    }
    worst = max(off, key=lambda case: off[case])
    return (
        f"Virtual work gives the mean shift forward of all {len(off)} cases within {100.0 * off[worst]:.1f} % "
        f"({worst}): where a "
        "worn support stands can be told without a run."
    )


def _loads_said(under_loads: Mapping[str, UnderLoad]) -> str:
    orders = {name: in_order({pin: one.mean(pin) for pin in PINS}) for name, one in under_loads.items()}
    whole = {name: 1e3 * sum(one.mean(pin) for pin in PINS) for name, one in under_loads.items()}
    first = next(iter(orders.values()))
    other = [f"{name} ({order})" for name, order in orders.items() if order != first]
    order = f"is another under {'; '.join(other)}" if other else "is the same under every load tried"
    shifts = "; ".join(f"{name} {shift:+.1f} mm" for name, shift in whole.items())
    return (
        f"The order by the tip's shift, {first} under the weight alone, {order}. The direction is the "
        "load's: all five "
        f"pins together move the tip forward by {shifts}."
    )


def _conditions_said(found: Found) -> str:
    rows = [row for row in condition_sheet(found).rows if row[0].startswith("ripple")]
    orders = "; ".join(f"{row[1]}: {row[-1]}" for row in rows)
    same = len({row[-1] for row in rows}) == 1
    depends = "is the same with every friction and clearance tried" if same else "depends on the conditions"
    return (
        f"The order by shaking {depends}. By the ripple of the pin forces (friction, clearance; ?: errors "
        f"leave it open): {orders}."
    )


def _excess(found: Found, name: str, friction: float, add: Callable[[Sequence[float]], float]) -> float:
    """By how many per cent all together are more than the single ones added."""
    parts = [found[name, case_name((pin,), friction)].value for pin in PINS]
    return 100.0 * (found[name, case_name(PINS, friction)].value / add(parts) - 1.0)


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    pairs = run_pairs(scenarios(chosen.quick), chosen.workers)
    for name, pair in pairs.items():
        pair.fine.save(chosen.out / "runs" / f"{_file_name(name)}.h5")
    under_loads = loads(slack_pin(0.0))
    numbers = measure(pairs)
    found = by_case(numbers)
    with style.look():
        drawings = figures(found, under_loads)
    save_figures(chosen, drawings)
    for title in RANKED:
        for friction in FRICTIONS:
            stem = f"table_{title.split()[-1]}_mu{friction:g}".replace(".", "p")
            show_table(chosen.out / f"{stem}.txt", ranking_sheet(found, title, friction))
    for friction in FRICTIONS:
        stem = f"table_all_forces_mu{friction:g}".replace(".", "p")
        show_table(chosen.out / f"{stem}.txt", force_sheet(found, friction), width=170)
    show_table(chosen.out / "table_together.txt", together_sheet(found))
    show_table(chosen.out / "table_closed_form.txt", posture_sheet(found))
    show_table(chosen.out / "table_loads.txt", load_sheet(under_loads, in_order), width=170)
    show_table(chosen.out / "table_conditions.txt", condition_sheet(found), width=170)
    chapter(found, under_loads, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers, time.perf_counter() - started)


def _file_name(case: str) -> str:
    named = case.replace(" + ", "+").replace(", mu_d = ", "_mu").replace(" ", "_")
    return named.replace(".", "p")


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.which_pin`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description))


if __name__ == "__main__":
    sys.exit(main())
