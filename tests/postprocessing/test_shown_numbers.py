"""Which pin hits hardest is told by the largest force at any step, the same wherever runs are printed."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
import pytest

from support_exudyn.postprocessing.shown_numbers import hardest_first, shown
from support_exudyn.simulation.estimate import Estimate
from tests import synthetic
from tests.cases.run_cases import loose_support

TIME = np.arange(11) * 0.1
RUN = synthetic.journal(loose_support(1.5, 0.25), TIME, 0.0 * TIME, 0.0 * TIME, [])


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
    (found,) = shown([RUN], [TWO], 0.0, math.inf)
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
    (found,) = shown([RUN], [{name: Estimate(0.6, error, "s")}], after, math.inf)
    assert (name in found) == stays
