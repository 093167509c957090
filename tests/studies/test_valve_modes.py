"""The drive modes by valves and a pump."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from studies.common.options import Options
from studies.drive_mode.valves import PINS, PUMP, PUMPS, START, ValveModes, case_name
from support_exudyn import Result, simulate


@cache
def _begin(mode: str, oil: str = "boils") -> Result:
    """The first half second after the valve opens, on the limited pump."""
    case = ValveModes(Options(Path())).cases()[case_name(mode, PUMPS[0], PINS[0], oil)]
    return simulate(replace(case, duration=START + 0.5))


def test_a_sudden_valve_boils_the_oil_unless_it_pulls_and_a_ramp_does_not() -> None:
    sudden, gentle, pulls = _begin("mode 1"), _begin("mode 2"), _begin("mode 1", "pulls")
    assert sudden["front_column.cavity"].max() > 5e-5  # 50 ml
    assert sudden["front_column.pressure"].min() == -99e3
    assert gentle["front_column.cavity"].max() == 0.0
    assert gentle["front_column.pressure"].min() > 0.0
    assert pulls["front_column.pressure"].min() < -1e6
    assert pulls["front_column.force"].min() < -1e5


def test_the_pump_gives_no_more_than_it_can_and_its_oil_adds_up() -> None:
    run = _begin("mode 1")
    legs, let_in, yielded = (
        run[f"front_column.{name}"] + run[f"rear_column.{name}"] for name in ("oil", "let_in", "yielded")
    )
    assert run["pump.flow"].max() <= PUMP.flow * (1.0 + 1e-12)
    assert yielded.max() == 0.0
    # what is in all chambers and lines comes from the pump but for what rod sides gave to the tank
    assert np.abs(legs - legs[0] - let_in).max() < 1e-10 * legs[0]
    held = run["pump.oil"] + legs
    assert held[-1] - held[0] <= run["pump.given"][-1] + 1e-12


@pytest.mark.slow
def test_the_study_runs_and_finds_that_oil_boils(tmp_path: Path) -> None:
    answer = ValveModes(Options(tmp_path)).write().answer
    assert "the oil boils" in answer
    assert "Along a ramp nothing boils" in answer
