"""Beside every largest force stands when it was, with an error that says if another time could be meant."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from support_exudyn import Held, Result
from tests import synthetic
from tests.cases.run_cases import FORCE, SLIDER_PIN, loose_slider_crank, support
from tests.compiled_runs import simulate_compiled, simulate_on_exudyn

TIME = np.linspace(0.0, 1.0, 101)
PERIOD = 0.01


def bumps(second: float) -> np.ndarray:
    """A force with a top of 2 at 0.2 s and one of another height at 0.7 s."""
    tops = 2.0 * np.exp(-(((TIME - 0.2) / 0.05) ** 2)), second * np.exp(-(((TIME - 0.7) / 0.05) ** 2))
    return np.asarray(-tops[0] + tops[1])


def three(*forces: np.ndarray) -> Result:
    """Runs with these forces of a pin, the last the finest."""
    scenario = replace(support(drive=Held(), duration=1.0), record_period=PERIOD)
    found: Result | None = None
    for force in forces:
        found = replace(synthetic.result(scenario, TIME, {FORCE: (force, "N")}), coarser=found)
    assert found is not None
    return found


def test_where_another_time_could_be_meant_the_error_reaches_there() -> None:
    # the runs differ by 0.01 N, and the tops by half of that
    when = three(*(bumps(second) for second in (1.985, 1.985, 1.995))).numbers()[f"{FORCE}.largest_time"]
    assert when.value == pytest.approx(0.2)
    assert when.error >= 0.5


DURATION = 0.004


@pytest.mark.parametrize("run", [simulate_compiled, simulate_on_exudyn])
def test_the_largest_force_at_any_step_is_there_at_its_time_and_not_before(
    run: Callable[..., Result], tmp_path: Path
) -> None:
    scenario = replace(loose_slider_crank(DURATION), record_period=2e-5)
    found = run(scenario)
    largest, when = found.largest_force[SLIDER_PIN], found.largest_force_time[SLIDER_PIN]
    contacts = [(one.time, one.separation_time) for one in found.onsets[SLIDER_PIN]]
    contact = next(n for n, (onset, separation) in enumerate(contacts) if onset < when <= separation)
    records = 2e-5 * np.floor(np.array(contacts[contact]) / 2e-5 + [0, 1])
    before, after = (run(replace(scenario, duration=float(end))) for end in records)
    assert before.largest_force[SLIDER_PIN] < largest
    assert after.largest_force[SLIDER_PIN] == pytest.approx(largest, rel=1e-3)
    assert after.largest_force_time[SLIDER_PIN] == pytest.approx(when, abs=2e-6)
    again = Result.load(found.save(tmp_path / "run.h5"))
    assert again.largest_force_time == found.largest_force_time
