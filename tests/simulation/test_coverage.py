"""Errors that runs to an accuracy report cover those that they have, on scenes that are drawn from a seed.

A scene's truth is a run of the compiled formulation at a tolerance of 1e-12; a number is judged where a run at
1e-11 differs from that by a tenth at most of the error that is reported, or found.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from support_exudyn import Result, Scenario, SimulationError, SolverSettings, simulate
from support_exudyn.formulations.registry import formulation
from support_exudyn.simulation.reported_numbers import measures
from tests.drawn.fresh_scenes import MACHINES, RECORDS, fresh

SEED = 7
TIGHTER = 10.0  # times closer than the error that it judges must a tight run be


class Check(NamedTuple):
    """True and reported errors of the numbers of a run that can be judged, and how many cannot."""

    true: np.ndarray
    reported: np.ndarray
    left_out: int


def tight(scenario: Scenario, tolerance: float) -> Result:
    return simulate(replace(scenario, formulation="compiled", solver=SolverSettings(tolerance=tolerance)))


def numbers(run: Result) -> dict[str, float]:
    """The usual numbers of a run that has no estimate."""
    return {name: kind.measure(run) for name, kind in measures(run, 0.0, float("inf")).items()}


def checked(number: int) -> Iterator[Check]:
    """The checks of a drawn scene; none if the compiled formulation does not cover it or a run is refused."""
    scene = fresh(SEED, number)
    scenario = scene.scenario
    if scenario.dimensions == 3 or not formulation("compiled").covers(
        replace(scenario, formulation="compiled")
    ):
        return
    records = 2000 if scene.kind in MACHINES else 10 * RECORDS
    many = replace(scenario, record_period=scenario.duration / records)
    try:
        truth, looser = (numbers(tight(many, tolerance)) for tolerance in (1e-12, 1e-11))
        runs = [simulate(scenario, accuracy="draft"), simulate(scenario, accuracy="standard")]
    except SimulationError:
        return
    for run in runs:
        reported = run.numbers()
        names = truth.keys() & looser.keys() & reported.keys()
        off = {name: abs(reported[name].value - truth[name]) for name in names}
        judged = [
            name
            for name in names
            if TIGHTER * abs(truth[name] - looser[name]) <= max(reported[name].error, off[name])
        ]
        true = np.array([off[name] for name in judged])
        yield Check(true, np.array([reported[name].error for name in judged]), len(names) - len(judged))


@pytest.mark.slow
def test_reported_errors_cover_true_ones() -> None:
    judged = [one for number in range(24) for one in checked(number) if one.true.size > one.left_out]
    assert len(judged) > 24
    true, reported = (
        np.concatenate(errors) for errors in zip(*((c.true, c.reported) for c in judged), strict=True)
    )
    covered = float(np.mean(true <= reported))
    some = true > 0.0
    ratio = float(np.median(reported[some] / true[some]))
    print(f"{covered:.4f} of {true.size} numbers of {len(judged)} runs, {ratio:.1f}")
    assert covered >= 0.97  # measured: see accuracy.md
    print(f"worst true over reported error {float(np.max(true[some] / reported[some])):.1f}")
