"""Curves at different times are laid on each other; what interpolation adds is told."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.postprocessing.comparing.common_times import interpolated, on_common_times
from support_exudyn.postprocessing.comparing.even_times import even_samples
from user_forces import InputError

FINE, COARSE = np.linspace(0.0, 1.0, 1001), np.linspace(-0.05, 0.95, 42)


def test_equal_times_are_used_as_they_are() -> None:
    random = np.random.default_rng(1)
    one, other = random.normal(size=(2, FINE.size))
    found = on_common_times(FINE, one, FINE + 3e-10, other)
    assert found.interpolated == 0
    np.testing.assert_array_equal(found.reference, one)
    np.testing.assert_array_equal(found.other, other)
    assert not found.interpolation_error.any()


@pytest.mark.parametrize("swapped", [False, True])
def test_the_times_are_those_of_the_coarser(swapped: bool) -> None:
    fine, coarse = (FINE, np.cos(9.0 * FINE)), (COARSE, np.sin(9.0 * COARSE))
    found = on_common_times(*coarse, *fine) if swapped else on_common_times(*fine, *coarse)
    np.testing.assert_array_equal(found.time, COARSE[COARSE >= 0.0])
    mine, its = (found.other, found.reference) if swapped else (found.reference, found.other)
    np.testing.assert_array_equal(its, np.sin(9.0 * found.time))
    wrong = np.abs(mine - np.cos(9.0 * found.time))
    assert wrong.max() > 1e-6
    # a straight line errs by h^2 f''/8 = 1e-5 at most; f'' changes by 0.7 from record to record
    assert (wrong <= found.interpolation_error + 1e-6 * 0.729 / 8.0).all()
    assert found.interpolation_error.max() < 2e-5


def test_a_jump_is_told_by_its_size() -> None:
    time = np.arange(10.0)
    values, error, count = interpolated(time, np.where(time > 4.5, 8.0, 0.0), np.array([4.5, 7.5]))
    assert count == 2
    np.testing.assert_allclose(values, [4.0, 8.0])
    assert error[0] == pytest.approx(1.0)  # of a jump of 8 per interval twice, half of the second difference
    assert error[1] == 0.0


def test_what_is_not_known_stays_so() -> None:
    values, error, _ = interpolated(
        np.arange(4.0), np.array([0.0, np.nan, 2.0, 3.0]), np.array([0.5, 2.0, 2.5])
    )
    np.testing.assert_array_equal(np.isnan(values), [True, False, False])
    assert np.isnan(error[0])
    assert error[1] == 0.0


def test_curves_that_do_not_overlap_are_refused() -> None:
    with pytest.raises(InputError, match="s: none lies where both"):
        on_common_times(FINE, FINE, FINE + 5.0, FINE)
    with pytest.raises(InputError, match="none lies between 2 and 3 s"):
        on_common_times(FINE, FINE, FINE, FINE, 2.0, 3.0)
    with pytest.raises(InputError, match=r"\(none\)"):
        on_common_times(FINE, FINE, FINE[:0], FINE[:0])


def test_of_a_coarse_curve_without_a_time_there_the_finer_ones_count() -> None:
    found = on_common_times(np.array([0.0, 1.0]), np.array([0.0, 2.0]), FINE[300:400], FINE[300:400])
    np.testing.assert_allclose(found.reference, 2.0 * found.other)
    assert found.interpolated == 100


@given(
    times=st.lists(st.floats(0.0, 100.0), min_size=2, max_size=30, unique=True),
    others=st.lists(st.floats(0.0, 100.0), min_size=2, max_size=30, unique=True),
)
def test_straight_lines_stay_straight(times: list[float], others: list[float]) -> None:
    one, other = np.sort(times), np.sort(others)
    if max(one[0], other[0]) > min(one[-1], other[-1]):
        return
    try:
        found = on_common_times(one, 2.0 * one - 1.0, other, 5.0 * other)
    except InputError:
        assert not ((one >= other[0]) & (one <= other[-1])).any()
        return
    np.testing.assert_allclose(found.reference, 2.0 * found.time - 1.0, atol=1e-8)
    np.testing.assert_allclose(found.other, 5.0 * found.time, atol=1e-8)


def test_even_samples() -> None:
    even = even_samples(FINE, FINE**2)
    assert (even.start, even.resampled) == (0.0, False)
    np.testing.assert_array_equal(even.values, FINE**2)
    uneven = even_samples(np.array([0.0, 1.0, 3.0, 4.0]), np.array([0.0, 1.0, 3.0, 4.0]))
    assert uneven.resampled
    np.testing.assert_allclose(uneven.values, np.arange(5.0))
    with pytest.raises(InputError, match="1 known values"):
        even_samples(np.arange(3.0), np.array([np.nan, 1.0, np.nan]))
    with pytest.raises(InputError, match="at most"):
        even_samples(np.array([0.0, 1e-9, 1e9]), np.zeros(3), 1e-9)
