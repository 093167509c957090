"""Oil is conserved."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from support_exudyn import HydraulicCylinder, Result, SolverSettings, simulate
from tests.formulations.hydraulics.leg_cases import CASES

SHARE = 1e-10  # of the oil


@cache
def run(name: str) -> Result:
    return simulate(replace(CASES[name], formulation="compiled", solver=SolverSettings(tolerance=1e-7)))


def channel(result: Result, name: str) -> np.ndarray:
    """A channel, or nothing where a leg has none."""
    return result[name] if name in result.channels else np.zeros(result.time.size)


def let_in(result: Result, leg: str) -> np.ndarray:
    """What a leg has got so far, by its inlets or its drive."""
    model = result.scenario.actuators[leg]
    if isinstance(model, HydraulicCylinder):
        return result[f"{leg}.let_in"]
    drive = result.scenario.drive_of(leg)
    return model.bore_area * np.array([drive.extension(t) for t in result.time.tolist()])


def lost(result: Result, leg: str) -> np.ndarray:
    return channel(result, f"{leg}.yielded") + channel(result, f"{leg}.relieved")


@pytest.mark.parametrize("name", CASES)
def test_what_a_leg_holds_is_what_it_had_and_got_less_what_it_lost(name: str) -> None:
    result = run(name)
    for leg in result.scenario.actuators:
        oil = result[f"{leg}.oil"]
        open_by = oil - oil[0] - let_in(result, leg) + lost(result, leg)
        assert np.abs(open_by).max() < SHARE * oil[0]
