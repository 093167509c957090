"""What `which_pin` says of its numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from studies.common.chapter import Chapter
from studies.common.wording import how_sure, said
from studies.which_pin.cases import ADDS_UP, CLEARANCE_MM, FRICTIONS, STUDY, case_name
from studies.which_pin.figures import pictures
from studies.which_pin.posture import UnderLoad, load_sheet
from studies.which_pin.tables import (
    RANKED,
    Found,
    condition_sheet,
    force_sheet,
    in_order,
    order_of,
    posture_sheet,
    ranked,
    ranking_sheet,
    root_of_squares,
    together_sheet,
    total,
)
from support_exudyn.machines.four_bar_shield import PINS


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
            "which would make the shaking depend on whether the pin was set down gently or dropped. It goes by "
            "the mass that moves with a journal while the other ones are pressed, each held along its normal: "
            "up to fifty times that with the others open.",
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
    order = order_of(rows)
    numbers = ", ".join(f"{pin} {said(rows[pin])}" for pin in ranked(found, name, friction))
    return (
        f"Pins {title}, friction {friction:g}: {order} ({name.replace('_', ' ')}: {numbers}; all five together "
        f"{said(found[name, case_name(PINS, friction)])})."
    )


def _together_said(found: Found, friction: float) -> str:
    shift = _excess(found, "mean_tip_shift_forward", friction, total)
    shaking = _excess(found, "ripple_pin_forces", friction, root_of_squares)
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
