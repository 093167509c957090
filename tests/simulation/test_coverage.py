"""Errors that runs to an accuracy report cover those that they have, on scenes that are drawn from a seed.

A scene's truth is a run of the compiled formulation at a tolerance of 1e-12; a number is judged where a run at
1e-11 differs from that by a tenth at most of the error that is reported, or found.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from studies.benchmarking.estimates import Check, Truth, check, coverage, overstatement
from studies.benchmarking.scenes import BenchmarkScene
from support_exudyn import Result, Scenario, SimulationError, SolverSettings, simulate
from support_exudyn.formulations.registry import formulation
from tests.drawn.fresh_scenes import MACHINES, RECORDS, fresh

SEED = 7
FIRST_FLIGHT = 49  # a scene whose journal begins in free flight


def tight(scenario: Scenario, tolerance: float) -> Result:
    return simulate(replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=tolerance)))


def checked(number: int, accuracies: tuple[str, ...] = ("draft", "standard")) -> list[Check]:
    """The checks of a drawn scene; none if the compiled formulation does not cover it or a run is refused."""
    scene = fresh(SEED, number)
    scenario = scene.scenario
    if scenario.dimensions == 3 or not formulation("compiled").covers(
        replace(scenario, formulation="compiled")
    ):
        return []
    looked_at = BenchmarkScene(scene.kind, scenario, "", 0.0, 0.0)
    many = replace(
        scenario, record_period=scenario.duration / (2000 if scene.kind in MACHINES else 10 * RECORDS)
    )
    try:
        truth = Truth.of(0.0, tight(many, 1e-12), tight(many, 1e-11))
        return [check(scene.kind, looked_at, replace(scenario, accuracy=one), truth) for one in accuracies]  # type: ignore[arg-type]
    except SimulationError:
        return []


def test_the_first_impact_after_a_free_flight_is_covered() -> None:
    scene = fresh(SEED, FIRST_FLIGHT).scenario
    first = simulate(scene, accuracy="draft").numbers()["pin.O.onset_1.time"]
    assert abs(first.value - tight(scene, 1e-12).onsets["O"][0].time) <= first.error


@pytest.mark.slow
def test_reported_errors_cover_true_ones() -> None:
    runs = [one for number in range(24) for one in checked(number)]
    judged = [one for one in runs if one.is_judged]
    assert len(judged) > 24
    found, ratio = coverage(judged), overstatement(judged)
    numbers = sum(one.true.size for one in judged)
    print(f"{found.value:.4f} of {numbers} numbers of {len(judged)} runs, {ratio.value:.1f}")
    assert found.value >= 0.97  # measured: see accuracy.md
    worst = max(float(np.max(one.true / one.estimated, initial=0.0)) for one in judged)
    print(f"worst true over reported error {worst:.1f}")
