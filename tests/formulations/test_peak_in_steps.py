"""The largest force of a clearance pin is that inside steps, where a law may have a corner."""

from __future__ import annotations

import pytest

from user_forces.roots import has_a_top, peak


@pytest.mark.parametrize("top", [0.01, 0.3, 0.5, 0.93, 0.99])
def test_a_corner_is_found_wherever_it_lies_in_a_step(top: float) -> None:
    assert peak(lambda x: 1.0 - abs(x - top), 0.0) == pytest.approx(1.0, abs=1e-4)
    assert peak(lambda x: 1.0 - abs(x - top), 10.0) == 10.0
    assert has_a_top(lambda x: 1.0 - abs(x - top), 1.0 - top, top)


@pytest.mark.parametrize("slope", [-1.0, 0.0, 1.0])
def test_a_force_that_rises_or_falls_throughout_has_no_top_inside(slope: float) -> None:
    assert not has_a_top(lambda x: 5.0 + slope * x, 5.0, 5.0 + slope)
