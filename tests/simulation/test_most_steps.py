"""A run is given up after as many steps as its settings say, in every formulation."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import Failure, Held, Result, Scenario, SolverSettings, simulate
from tests.cases.run_cases import Pair, loose_support
from tests.formulations.test_momentum import ONE, TWO


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
