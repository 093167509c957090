"""Pieces of a run between two times."""

from __future__ import annotations

import numpy as np
import pytest

from support_exudyn import Result
from support_exudyn.postprocessing.figures.selection import inside
from tests import synthetic
from tests.cases.run_cases import support
from user_forces import InputError


def run(time: np.ndarray) -> Result:
    return synthetic.result(support(), time, {})


def test_both_ends_lie_inside_though_times_were_summed_up() -> None:
    sums = run(np.cumsum(np.full(5, 0.1)))  # 0.1, 0.2, 0.30000000000000004, ...
    assert sums.time[2] > 0.3
    assert np.flatnonzero(inside(sums, 0.1, 0.3)).tolist() == [0, 1, 2]
    less = run(np.array([0.1, 0.3 - 1e-16 * 2, 0.5]))
    assert less.time[1] < 0.3
    assert np.flatnonzero(inside(less, 0.3, 0.5)).tolist() == [1, 2]
    with pytest.raises(InputError, match="1 records lie between"):
        inside(sums, 0.15, 0.25)
