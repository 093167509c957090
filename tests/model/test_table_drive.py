"""A drive through given points: its contract, and what it is like for other drives."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from support_exudyn import TableDrive
from user_forces import InputError

lengths = st.lists(st.floats(1e-3, 3.0), min_size=1, max_size=8)
# to a nanometre: what scipy makes of the smallest numbers there are is not the question
height = st.floats(-2.0, 2.0).map(lambda x: round(x, 9)) | st.just(0.5)
heights = st.lists(height, min_size=8, max_size=8)
starts = st.just(0.0) | st.floats(0.01, 3.0)


def table(start: float, steps: list[float], values: list[float], between: str = "smooth") -> TableDrive:
    times = np.cumsum([start, *steps]).tolist()
    return TableDrive(times=times, extensions=[0.0, *values[: len(steps)]], between=between)


tables = st.builds(table, starts, lengths, heights, st.sampled_from(("smooth", "linear")))
smooth = st.builds(table, starts, lengths, heights)


@given(drive=tables)
def test_it_goes_through_its_points(drive: TableDrive) -> None:
    assert [drive.extension(t) for t in drive.times] == list(drive.extensions)


@given(drive=smooth)
def test_smooth_is_scipys_pchip_of_the_table_with_the_rest_around_it(drive: TableDrive) -> None:
    first, last = drive.times[0], drive.times[-1]
    times = [first - 1.0, *drive.times, last + 1.0]
    expected = PchipInterpolator(times, [0.0, *drive.extensions, drive.extensions[-1]])
    at = np.linspace(first, last, 57)
    found = [drive.extension(t) for t in at.tolist()]
    rate = [drive.speed(t) for t in at.tolist()]
    # rounding of 2 m, and of its rate over the shortest piece of 1 ms: 2e-16 times 4 m / 1 ms, some ten terms
    np.testing.assert_allclose(found, expected(at), rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(rate, expected(at, 1), rtol=0.0, atol=4e-11)


@given(drive=tables, share=st.floats(0.0, 1.0))
def test_speed_is_the_derivative(drive: TableDrive, share: float) -> None:
    t = drive.times[0] + share * (drive.times[-1] - drive.times[0])
    h = 1e-6
    assume(all(abs(t - one) > 2.0 * h for one in drive.times))
    slope = (drive.extension(t + h) - drive.extension(t - h)) / (2.0 * h)
    # third derivative: at most 6 (2 + 3 + 3) rise/length^3, slopes being at most 3 secants, times h^2/6;
    # rounding of 2 m over h
    steepest = max(
        abs(b - a) / (d - c) ** 3
        for (a, b), (c, d) in zip(pairwise(drive.extensions), pairwise(drive.times), strict=True)
    )
    assert drive.speed(t) == pytest.approx(slope, abs=8.0 * steepest * h * h + 1e-9, rel=1e-9)


@given(drive=st.builds(table, starts, lengths, heights, st.just("linear")))
def test_linear_speed_jumps_as_told(drive: TableDrive) -> None:
    assert set(drive.breaks) <= set(drive.times)
    for t in drive.times:
        after = drive.speed(math.nextafter(t, math.inf))
        # the same quotient on both sides
        assert drive.speed_jump(t) == after - drive.speed(t)
        assert (t in drive.breaks) == (drive.speed_jump(t) != 0.0)


@given(drive=tables, duration=st.floats(0.01, 20.0))
def test_the_span_is_what_it_reaches(drive: TableDrive, duration: float) -> None:
    low, high = drive.span(duration)
    at = sorted({*np.linspace(0.0, duration, 301).tolist(), *(t for t in drive.times if t <= duration)})
    reached = [drive.extension(t) for t in at]
    # rounding of 2 m inside of a piece
    assert low - 1e-15 <= min(reached)
    assert max(reached) <= high + 1e-15
    assert {low, high} <= set(reached)


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"times": (0.0, 1.0), "extensions": (0.0, float("inf"))}, "TableDrive.extensions.1 = inf"),
        ({"times": (-1.0, 1.0), "extensions": (0.0, 1.0)}, "TableDrive.times.0 = -1.0: allowed: >= 0"),
        ({"times": (0.0,), "extensions": (0.0, 1.0)}, "TableDrive.times = (0.0,): allowed: at least 2 items"),
        ({"times": range(1_000_001), "extensions": (0.0, 1.0)}, "TableDrive.times = range(0, 1000001)"),
    ],
)
def test_what_is_wrong_with_a_table_is_said_once(fields: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError) as caught:
        TableDrive(**fields)
    assert str(caught.value).startswith(said)
