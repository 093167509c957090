from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from user_forces import InputError, JournalBearing

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0015)
radii = st.floats(1e-3, 1.0)
shares = st.floats(1e-3, 0.5)  # clearance as a share of the bore's radius


def test_journal_is_smaller_than_the_bore_by_the_clearance() -> None:
    # one rounding of the difference
    assert BEARING.journal_radius == pytest.approx(0.064, rel=1e-15)


def test_depth_is_zero_where_the_surfaces_meet() -> None:
    assert BEARING.depth(0.0015) == 0.0


def test_depth_of_a_concentric_journal_is_minus_the_clearance() -> None:
    assert BEARING.depth(0.0) == -0.0015


def test_depth_is_positive_beyond_the_clearance() -> None:
    # one rounding of the difference of two lengths of 1.5 mm
    assert BEARING.depth(0.0016) == pytest.approx(0.0001, abs=1e-18)


def test_contact_arms_are_the_radii_at_zero_depth() -> None:
    assert BEARING.contact_arms(0.0) == (BEARING.bore_radius, BEARING.journal_radius)


@given(bore=radii, share=shares, beyond=st.floats(0.0, 0.3))
def test_contact_arms_end_at_one_point(bore: float, share: float, beyond: float) -> None:
    bearing = JournalBearing(bore_radius=bore, clearance=share * bore)
    eccentricity = bearing.clearance * (1.0 + beyond)
    from_bore, from_journal = bearing.contact_arms(bearing.depth(eccentricity))
    # from the bore's centre directly, or by way of the journal's centre; rounding of the radius
    assert from_bore == pytest.approx(eccentricity + from_journal, abs=4e-16 * bore)


@given(bore=radii, share=shares, beyond=st.floats(0.0, 0.3))
def test_contact_point_lies_between_both_surfaces(bore: float, share: float, beyond: float) -> None:
    bearing = JournalBearing(bore_radius=bore, clearance=share * bore)
    eccentricity = bearing.clearance * (1.0 + beyond)
    point, _ = bearing.contact_arms(bearing.depth(eccentricity))
    rounding = 4e-16 * bore
    assert bore - rounding <= point <= eccentricity + bearing.journal_radius + rounding


def test_contact_point_lies_midway_in_the_overlap() -> None:
    eccentricity = 0.0019
    from_bore, _ = BEARING.contact_arms(BEARING.depth(eccentricity))
    outermost = eccentricity + 0.0655 - 0.0015  # of the journal
    # rounding of lengths of 65 mm
    assert from_bore == pytest.approx((0.0655 + outermost) / 2.0, abs=3e-17)


@pytest.mark.parametrize("clearance", [0.0655, 0.07, 1.5])
def test_clearance_as_large_as_the_bore_is_refused(clearance: float) -> None:
    with pytest.raises(InputError, match=rf"clearance = {clearance} m.*allowed: > 0 and < 0\.0655"):
        JournalBearing(bore_radius=0.0655, clearance=clearance)


@pytest.mark.parametrize("clearance", [0.0, -0.001])
def test_clearance_of_zero_or_less_is_refused(clearance: float) -> None:
    with pytest.raises(InputError, match=rf"JournalBearing\.clearance = {clearance}: .*allowed: > 0"):
        JournalBearing(bore_radius=0.0655, clearance=clearance)


def test_negative_bore_is_refused() -> None:
    with pytest.raises(InputError, match=r"JournalBearing\.bore_radius = -0\.0655: .*allowed: > 0"):
        JournalBearing(bore_radius=-0.0655, clearance=0.001)
