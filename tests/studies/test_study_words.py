"""What studies say of made-up numbers: orders that errors leave open, sums, convergence."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from studies.common.numbers import Number, by_case
from studies.common.subject import paper_subject
from studies.common.words import Words
from studies.drive_mode.cases import PINS as CASES
from studies.drive_mode.cases import case_name
from studies.drive_mode.tables import VELOCITY, velocity_converges
from studies.which_pin import cases as which_pin_cases
from studies.which_pin import measures as which_pin_measures
from studies.which_pin import tables as which_pin_tables
from studies.which_pin.figures import change_text
from studies.which_pin.tables import condition_table, together_table
from support_exudyn.machines.four_bar_shield import PINS

A, B, C, D, E = PINS
PLAN = which_pin_cases.PinPlan(paper_subject())
SHIFT, RIPPLE = "mean_tip_shift_forward", "rms_pin_forces"


def said(macro: str, *args: object, study: str = "which_pin") -> str:
    """What a study says, in one line."""
    told = {"cases": which_pin_cases, "tables": which_pin_tables, "plan": PLAN}
    sentences = Words(study).templates.get_template("sentences.md.j2").make_module(told)
    return " ".join(getattr(sentences, macro)(*args).split())


def made_up(errors: float = 0.0) -> dict[tuple[str, str], Number]:
    """Each pin has its own effect, and all five what they should together."""
    numbers = []
    for name, (unit, _) in which_pin_measures.measures(PLAN).items():
        for friction in PLAN.frictions:
            singles = [10.0 * 2.0**n for n in range(len(PINS))]
            numbers += [
                Number(name, which_pin_cases.case_name((pin,), friction), value, unit, errors * value)
                for pin, value in zip(PINS, singles, strict=True)
            ]
            whole = which_pin_tables.root_of_squares(singles) if name == RIPPLE else sum(singles)
            numbers.append(Number(name, which_pin_cases.case_name(PINS, friction), whole, unit, 0.0))
            numbers.append(Number(name, PLAN.ideal_name(PINS, friction), 1.0, unit, 0.0))
    return by_case(numbers)


def test_an_order_is_open_where_errors_reach_over_it() -> None:
    effects = {A: 100.0, B: -50.0, C: 20.0, D: 19.5, E: 1.0}
    assert which_pin_tables.in_order(effects) == f"{A} > {B} > {C} = {D} > {E}"
    errors = dict.fromkeys(PINS, 0.0)
    assert which_pin_tables.in_order(effects, errors | {A: 60.0}) == f"{A} ? {B} > {C} = {D} > {E}"
    # the first reaches down to the third
    assert which_pin_tables.in_order(effects, errors | {A: 85.0}) == f"{A} ? {B} ? {C} = {D} > {E}"
    assert which_pin_tables.in_order(effects, errors | {E: 40.0}) == f"{A} > {B} > {C} = {D} ? {E}"


@pytest.mark.parametrize(("errors", "sign"), [(0.0, " > "), (0.4, " ? ")])
def test_rankings_know_the_errors(errors: float, sign: str) -> None:
    found = made_up(errors)
    order = sign.join(reversed(PINS))
    assert order.replace("_", " ") in said("ranking", found, "by the shaking", 0.25)
    rows = condition_table(PLAN, found).rows
    assert {row[-1] for row in rows} == {order}
    assert [row[0] for row in which_pin_tables.ranking_table(PLAN, found, "by the shaking", 0.25).rows] == [
        *reversed(PINS), which_pin_cases.ALL, which_pin_cases.IDEAL,
    ]  # fmt: skip
    assert "is the same with every" in said("conditions", [row for row in rows if row[0].startswith("rms")])


def test_sums_are_said_to_add_up_if_they_do() -> None:
    found = made_up()
    text = said("together", found, 0.25)
    assert "the tip's shift the same (their sum), so shifts add up" in text
    assert "so shaking can be told" in text
    assert {row[-1] for row in together_table(PLAN, found).rows} == {"the same"}
    whole = which_pin_cases.case_name(PINS, 0.25)
    for name in (SHIFT, RIPPLE):
        found[name, whole] = replace(found[name, whole], value=3.0 * found[name, whole].value)
    text = said("together", found, 0.25)
    assert "the tip's shift +200 % (their sum), so shifts do not add up" in text
    assert "the RMS fluctuation of the pin forces +200 %" in text
    assert "so shaking cannot be told" in text
    assert [row[-1] for row in together_table(PLAN, found).rows] == [
        "+200 %",
        "+200 %",
        "the same",
        "the same",
    ]


def test_two_pins_can_shake_otherwise_than_all_of_them() -> None:
    found = made_up(errors=0.1)
    pair = which_pin_cases.case_name((A, B), 0.0)
    for name, value in ((SHIFT, 30.0), (RIPPLE, 2.0 * float(np.hypot(10.0, 20.0)))):
        found[name, pair] = Number(name, pair, value, "N", 0.0)
    text = said("together", found, 0.0)
    assert f"of two pins up to +100 % ({A} + {B})".replace("_", " ") in text
    assert "so shaking cannot be told" in text
    row = together_table(PLAN, found).rows[-1]
    # a tenth of each: hypot(10, 20) grows by 10/hypot and 40/hypot of it
    assert row[3] == "22.4 ± 2.3"
    assert row[5] == "+100 %"


def test_a_change_is_drawn_to_its_error() -> None:
    assert change_text(5.06, 0.01) == "+5.1"
    assert change_text(-5.06, 0.3) == "\N{MINUS SIGN}5.1 ± 0.3"
    assert change_text(5.06, 2.7) == "+5 ± 3"
    assert change_text(179.06, 0.3) == "+179"
    assert change_text(-2.0, 8.2) == "±10"
    assert change_text(-0.02, 0.001) == "0.0"


def test_the_worst_case_of_the_closed_form_is_told() -> None:
    found = made_up()
    for pin, off in ((A, 1.02), (B, 0.96)):
        case = which_pin_cases.case_name((pin,), 0.0)
        form = found[SHIFT, case].value / off
        found["closed_form_tip_shift_forward", case] = Number("form", case, form, "mm", 0.0)
    assert f"all 2 cases within 4.0 % ({B}, mu_d = 0)" in said("closed_form", found)
    assert [row[-1] for row in which_pin_tables.posture_table(found).rows] == ["+2.00 %", "-4.00 %"]


def test_a_velocity_has_a_limit_if_its_errors_are_small() -> None:
    cases = [case_name("mode 1", pin, "rigid") for pin in CASES]
    for errors, converges in (((0.01, 0.01), True), ((0.01, 0.03), False)):
        numbers = zip(cases, errors, strict=True)
        found = {(VELOCITY, case): Number(VELOCITY, case, 2.0, "deg/s", error) for case, error in numbers}
        assert velocity_converges(found) == converges
    assert said("velocity", True, study="drive_mode") == "Angular velocities as in Fig. 13 b converge."
    assert said("velocity", False, study="drive_mode").endswith("are not shown to converge here.")


def test_what_clearance_does_to_the_peak_follows_from_both_contacts() -> None:
    assert said("worse", 0.9, 1.2, study="drive_mode") == (
        "Whether clearance raises the peak of the sudden start depends on the contact."
    )
    assert said("worse", 1.1, 1.2, study="drive_mode").startswith("Clearance raises the peak")
    assert said("worse", 0.9, 0.8, study="drive_mode").startswith("Clearance lowers the peak")
