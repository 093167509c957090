"""Stiffness of internal contact and the modulus of two bodies."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.analytic import sphere_stiffness
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    JournalBearing,
    Material,
    effective_modulus,
    external_contact_stiffness,
    internal_contact_stiffness,
)

moduli = st.floats(1e9, 1e12)
ratios = st.floats(0.0, 0.5)


def material(modulus: float = 2.07e11, ratio: float = 0.3) -> Material:
    return Material(name="test", elastic_modulus=modulus, poisson_ratio=ratio, density=7800.0)


def bearing(bore_mm: float, clearance_mm: float) -> JournalBearing:
    return JournalBearing(bore_radius=bore_mm / 1e3, clearance=clearance_mm / 1e3)


# From contact_laws.md: clearance [mm], K [N/mm^1.5], half of the last printed digit
@pytest.mark.parametrize(
    ("clearance_mm", "stiffness", "half"),
    [(0.5, 1.391e7, 5e3), (1.0, 9.801e6, 5e2), (1.5, 7.972e6, 5e2), (2.0, 6.877e6, 5e2)],
)
def test_internal_stiffness_of_the_supports_pins(clearance_mm: float, stiffness: float, half: float) -> None:
    si = internal_contact_stiffness(bearing(65.5, clearance_mm), STEEL, STEEL_35CRMO)
    # 1 N/mm^1.5 is 1000^1.5 N/m^1.5
    assert si / 1000.0**1.5 == pytest.approx(stiffness, abs=half)


def test_internal_stiffness_of_the_slider_crank() -> None:
    # radii 10 and 9.5 mm, E = 207 GPa, nu = 0.3: half of the last printed digit
    assert internal_contact_stiffness(bearing(10.0, 0.5), material(), material()) == pytest.approx(
        6.610198e10, abs=5e3
    )


@given(e1=moduli, nu1=ratios, e2=moduli, nu2=ratios, bore=st.floats(1e-3, 1.0), share=st.floats(1e-3, 0.9))
def test_internal_stiffness_is_that_of_a_sphere_in_a_hollow_one(
    e1: float, nu1: float, e2: float, nu2: float, bore: float, share: float
) -> None:
    place = JournalBearing(bore_radius=bore, clearance=share * bore)
    journal = bore - share * bore
    relative_radius = 1.0 / (1.0 / journal - 1.0 / bore)
    got = internal_contact_stiffness(place, material(e1, nu1), material(e2, nu2))
    # the same in another form: the difference of curvatures loses three digits at a clearance of R/1000
    assert got == pytest.approx(sphere_stiffness(e1, nu1, e2, nu2, relative_radius), rel=1e-12)


@given(bore=st.floats(1e-3, 1.0), share=st.floats(1e-3, 0.9))
def test_internal_contact_is_stiffer_by_the_root_of_sum_over_difference(bore: float, share: float) -> None:
    place = JournalBearing(bore_radius=bore, clearance=share * bore)
    ratio = internal_contact_stiffness(place, STEEL, STEEL) / external_contact_stiffness(place, STEEL, STEEL)
    # (R1 + R2)/(R2 - R1) = 2/share - 1: rounding, of the product share * bore too
    assert ratio == pytest.approx(math.sqrt(2.0 / share - 1.0), rel=1e-12)


def test_exchanging_the_materials_changes_nothing() -> None:
    one = internal_contact_stiffness(bearing(65.5, 1.5), STEEL, STEEL_35CRMO)
    # order of a sum: rounding
    assert internal_contact_stiffness(bearing(65.5, 1.5), STEEL_35CRMO, STEEL) == pytest.approx(one, rel=1e-15)


# --- effective modulus ---


@given(e1=moduli, nu1=ratios, e2=moduli, nu2=ratios)
def test_effective_modulus_is_that_of_springs_in_series(e1: float, nu1: float, e2: float, nu2: float) -> None:
    expected = 1.0 / ((1.0 - nu1**2) / e1 + (1.0 - nu2**2) / e2)
    # the same in another order: rounding
    assert effective_modulus(material(e1, nu1), material(e2, nu2)) == pytest.approx(expected, rel=1e-14)


def test_effective_modulus_of_steel_on_steel() -> None:
    steel = material(2.1e11, 0.3)
    # from notes.md, 210/(2 0.91) GPa: half of the last printed digit
    assert effective_modulus(steel, steel) == pytest.approx(1.153846e11, abs=5e4)


def test_effective_modulus_against_a_rigid_body_is_that_of_the_soft_one() -> None:
    # (1 - 1/4) 1e9/1e30 is below rounding
    assert effective_modulus(material(1e9, 0.5), material(1e30, 0.0)) == pytest.approx(1e9 / 0.75, rel=1e-15)
