"""Numbers of known runs: their window, their digits, and their order, the hardest hit pin first."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from support_exudyn import Onset, Result
from support_exudyn.postprocessing.shown_numbers import hardest_first, shown, side_by_side
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
        (Estimate(12345.6, 78.0, "N"), ("kN", "12.346 ± 0.078")),
        (Estimate(1.5e-3, 2e-9, "m"), ("mm", "1.50000")),
        (Estimate(20.0, 300.0, "N"), ("N", "20 ± 300")),
        (Estimate(2.0, 0.0, "N"), ("N", "2")),
        (Estimate(2.0, math.inf, "N"), ("N", "2 ± not known")),
        (Estimate(math.nan, 0.1, "N"), ("N", "nan")),
    ],
)
def test_a_number_has_the_digits_of_its_error(found: Estimate, row: tuple[str, ...]) -> None:
    assert side_by_side([found]) == row


# --- order ---


def of_pins(**pins: tuple[float, float]) -> Mapping[str, Estimate]:
    """Numbers of pins: the largest force over a window, and over the whole run."""
    found: dict[str, Estimate] = {}
    for pin, (at_records, _) in pins.items():
        found[f"pin.{pin}.force.mean"] = Estimate(1.0, 0.1, "N")
        found[f"pin.{pin}.force.largest"] = Estimate(at_records, 500.0, "N")
        found[f"pin.{pin}.force.largest_time"] = Estimate(0.5, 0.01, "s")
    for pin, (_, at_any_step) in pins.items():
        if not math.isnan(at_any_step):
            found[f"pin.{pin}.largest_force"] = Estimate(at_any_step, 1.0, "N")
            found[f"pin.{pin}.largest_force_time"] = Estimate(0.51, 0.001, "s")
    return found


# by its records the first one hits harder, which it does not
TWO = of_pins(a=(90e3, 100e3), b=(80e3, 130e3))


def test_the_hardest_hit_pin_comes_first_and_its_records_do_not_contradict() -> None:
    (found,) = shown([run()], [TWO], 0.0, math.inf)
    assert hardest_first(TWO) == ["pin.b", "pin.a"]
    assert [*found][:4] == [f"pin.{pin}.largest_force{end}" for pin in "ba" for end in ("", "_time")]
    assert not [name for name in found if ".force.largest" in name]
    assert "pin.a.force.mean" in found


@pytest.mark.parametrize(
    ("error", "after", "stays"),
    [(0.09, 0.0, True), (0.11, 0.0, False), (0.09, 0.5, False), (math.inf, 0.0, False), (math.nan, 0.0, True)],
)
def test_a_time_that_may_be_of_another_peak_is_not_printed(error: float, after: float, stays: bool) -> None:
    name = "front_column.force.largest_time"
    (found,) = shown([run()], [{name: Estimate(0.6, error, "s")}], after, math.inf)
    assert (name in found) == stays
