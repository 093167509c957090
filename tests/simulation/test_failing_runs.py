"""Failures are clear, and can be had as a value."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import (
    ClearancePin,
    Failure,
    Held,
    Result,
    Scenario,
    SimulationError,
    SolverSettings,
    simulate,
)
from tests.cases.run_cases import Pair, loose_support, paper_contact
from tests.formulations.test_momentum import ONE, TWO
from user_forces import friction_law
from user_forces.lawful import UNLAWFUL


def nan(slip: float, normal_force: float) -> float:
    """Works until it is pressed with 10 kN, more than laws are called with before a run."""
    return math.nan if normal_force > 1e4 else 0.0


def overflow(slip: float, normal_force: float) -> float:
    if normal_force > 1e4:
        raise OverflowError("force out of range")
    return 0.0


def bug(slip: float, normal_force: float) -> float:
    if normal_force > 1e4:
        raise LookupError("a bug in the law")
    return 0.0


LAWS = {function.__name__: friction_law(function) for function in (nan, overflow, bug)}


def breaking(kind: str) -> Scenario:
    good = paper_contact(1.5, 0.0)
    return _with(type(good)(bearing=good.bearing, normal=good.normal, friction=LAWS[kind]()))


def _with(contact: object) -> Scenario:
    scenario = loose_support(drive=Held(), duration=0.05)
    return replace(scenario, pins={"rear_base": ClearancePin(contact=contact)})


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("nan", "rear_base: Nan gives a force of nan N at a slip of "),  # no step mends it
        ("overflow", "Try a smaller step"),
    ],
)
def test_a_failure_says_when_and_in_what_state(kind: str, words: str) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate(breaking(kind))
    failure = caught.value.failure
    assert 0.017 < failure.time < 0.05  # the first impact is at 17.4 ms
    assert failure.state["pin.rear_base.impact_velocity"] == pytest.approx(0.17, abs=0.01)
    assert "step" in failure.state
    assert words in str(caught.value)
    assert (UNLAWFUL in str(caught.value)) == (kind == "nan")


def test_a_bug_in_a_law_is_not_taken_for_a_failed_run() -> None:
    with pytest.raises(LookupError, match="a bug in the law"):
        simulate(breaking("bug"), throw=False)


# --- as many steps as the settings allow, in every formulation ---


def held(formulation: str, **changes: Any) -> Scenario:
    """The drop of the support."""
    return loose_support(1.5, 0.25, drive=Held(), duration=0.03, step=1e-4, formulation=formulation, **changes)


def limited(scenario: Scenario, steps: int) -> Result | Failure:
    """The run, with so many steps allowed."""
    return simulate(replace(scenario, solver=replace(scenario.solver, most_steps=steps)), throw=False)


CASES = {
    "exudyn": held("exudyn"),
    "compiled": held("compiled", actuators=oil_columns()),
    "space": replace(held("exudyn"), dimensions=3),
    "growing": replace(held("exudyn"), solver=SolverSettings(growth=4.0)),
}


@pytest.mark.parametrize("case", CASES)
def test_a_run_is_given_up_after_so_many_steps(case: str) -> None:
    scenario = CASES[case]
    whole = simulate(scenario)
    # what counts: steps, and those that were repeated; of the compiled formulation's the latter are not told
    most = whole.counts.steps + whole.counts.cut_steps + whole.counts.failed_newton
    half = whole.counts.steps // 2
    failure = limited(scenario, half)
    assert isinstance(failure, Failure)
    assert failure.reason == f"more than {half} steps"
    assert "solver.most_steps" in failure.advice
    assert 0.0 < failure.time < scenario.duration
    assert isinstance(limited(scenario, 2 * most), Result)


def test_steps_that_the_engine_makes_by_itself_are_limited_too() -> None:
    machine = Pair(one=ONE, two=TWO, one_point=(0.2, 0.25), two_point=(0.2, 0.25))
    swinging = Scenario(machine=machine, duration=0.1, step=1e-3)
    failure = limited(swinging, 20)
    assert isinstance(failure, Failure)
    assert failure.reason == "more than 20 steps"
    assert isinstance(limited(swinging, 200), Result)
