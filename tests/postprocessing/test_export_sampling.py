"""Which records an export writes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.postprocessing.export.sampling import Sampling
from user_forces import InputError

TIME = np.arange(101) * 0.01  # 100 records a second


def test_one_in_so_many_from_the_first_that_lies_inside() -> None:
    assert Sampling(every=40).records(TIME) == [0, 40, 80]
    assert Sampling(every=40, after=0.095).records(TIME) == [10, 50, 90]


times = st.lists(st.floats(0.0, 10.0, width=32), min_size=1, max_size=50, unique=True).map(sorted)


@given(times, st.floats(0.01, 100.0))
def test_no_record_lies_nearer_to_a_frame_than_the_one_that_is_written(times: list[float], rate: float) -> None:
    time = np.array(times)
    records = Sampling(frames_per_second=rate).records(time)
    assert records == sorted(set(records))
    for frame in np.arange(time[0], time[-1], 1.0 / rate):
        # the grids of this test and of the program differ by rounding of sums: 1000 steps of 1e-15
        assert np.abs(time[records] - frame).min() <= np.abs(time - frame).min() + 1e-11


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"every": 0}, "every"),
        ({"every": 1.5}, "whole number"),
        ({"frames_per_second": 0.0}, "frames_per_second"),
        ({"frames_per_second": math.nan}, "frames_per_second"),
        ({"every": 2, "frames_per_second": 25.0}, "one of them"),
        ({"after": -1.0}, "after"),
        ({"after": 0.5, "until": 0.4}, "until >= after"),
    ],
)
def test_what_cannot_be_is_refused(fields: dict[str, float], said: str) -> None:
    with pytest.raises(InputError, match=said):
        Sampling(**fields)  # type: ignore[arg-type]
