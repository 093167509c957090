"""What is told of runs that are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import Onset, Result
from support_exudyn.postprocessing.shown_numbers import with_error
from support_exudyn.postprocessing.summary import numbers_table
from support_exudyn.simulation.estimate import Estimate
from tests import synthetic
from tests.cases.run_cases import FORCE, PIN, loose_support
from user_forces import InputError

TIME = np.arange(11) * 0.1
SCENARIO = loose_support(1.5, 0.25)
# an impact that parts, one that goes on into the next, one that goes on to the end
IMPACTS = [
    Onset(0.1, 0.2, 0.1025, 0.18),
    Onset(0.3, 0.05, math.inf, math.nan),
    Onset(0.6, 2.0, math.inf, math.nan),
]


def run(**channels: tuple[np.ndarray, str]) -> Result:
    """A force of 1 kN up to 0.5 s, and of 4 kN afterwards."""
    found = synthetic.journal(SCENARIO, TIME, 0.0 * TIME, 0.0 * TIME, IMPACTS, **channels)
    force = replace(found.channels[FORCE], values=np.where(TIME < 0.55, 1e3, 4e3))
    return replace(found, channels={**found.channels, FORCE: force}, largest_force={PIN: 9e4})


def test_numbers_are_of_the_piece_that_was_asked_for() -> None:
    rows = {row[0]: row[1:] for row in numbers_table(run(), (0.4, 0.7)).rows}
    assert rows[f"{FORCE}.mean"] == ("2.5", "kN")
    assert rows[f"{FORCE}.std"] == ("1.32288", "kN")  # of the line between records
    assert rows[f"{FORCE}.largest"] == ("4", "kN")
    assert rows[f"pin.{PIN}.largest_force, whole run"] == ("90", "kN")
    assert {row[0]: row[1] for row in numbers_table(run(), (0.0, 0.5)).rows}[f"{FORCE}.mean"] == "1"
    with pytest.raises(InputError, match="does not last between them"):
        numbers_table(run(), (7.0, 8.0))


@pytest.mark.parametrize(
    ("found", "row"),
    [
        (Estimate(12345.6, 78.0, "N"), ("12.346", "7.8e-02", "kN")),
        (Estimate(1.5e-3, 2e-9, "m"), ("1.5000000", "2.0e-06", "mm")),
        (Estimate(20.0, 300.0, "N"), ("20", "3.0e+02", "N")),
        (Estimate(2.0, 0.0, "N"), ("2", "0", "N")),
        (Estimate(2.0, math.inf, "N"), ("2", "not known", "N")),
    ],
)
def test_a_number_has_the_digits_of_its_error(found: Estimate, row: tuple[str, ...]) -> None:
    assert with_error(found) == row
