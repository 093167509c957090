from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.analytic import sphere_stiffness
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    InputError,
    JournalBearing,
    Material,
    external_contact_stiffness,
)

# Table 2 of "Dynamic Analysis of Hydraulic Support with Single Clearance": clearance [mm], K [N/mm^1.5]
TABLE_2 = {0.5: 861300.557, 1.0: 859629.849, 1.5: 857942.947, 2.0: 856239.607}

moduli = st.floats(1e9, 1e12)
ratios = st.floats(0.0, 0.5)


def material(modulus: float = 2e11, ratio: float = 0.3) -> Material:
    return Material(name="test", elastic_modulus=modulus, poisson_ratio=ratio, density=7800.0)


def paper_bearing(clearance_mm: float) -> JournalBearing:
    return JournalBearing(bore_radius=0.0655, clearance=clearance_mm / 1e3)


@pytest.mark.parametrize("clearance_mm", TABLE_2)
def test_table_2_comes_out_to_every_printed_digit(clearance_mm: float) -> None:
    si = external_contact_stiffness(paper_bearing(clearance_mm), STEEL, STEEL_35CRMO)
    # half of the last printed digit; 1 N/mm^1.5 is 1000^1.5 N/m^1.5
    assert si / 1000.0**1.5 == pytest.approx(TABLE_2[clearance_mm], abs=5e-4)


@given(e1=moduli, nu1=ratios, e2=moduli, nu2=ratios, bore=st.floats(1e-3, 1.0), share=st.floats(1e-3, 0.9))
def test_stiffness_is_that_of_two_hertzian_spheres(
    e1: float, nu1: float, e2: float, nu2: float, bore: float, share: float
) -> None:
    bearing = JournalBearing(bore_radius=bore, clearance=share * bore)
    journal = bore - share * bore
    relative_radius = 1.0 / (1.0 / journal + 1.0 / bore)
    got = external_contact_stiffness(bearing, material(e1, nu1), material(e2, nu2))
    # the same formula in another form: rounding
    assert got == pytest.approx(sphere_stiffness(e1, nu1, e2, nu2, relative_radius), rel=1e-13)


def test_exchanging_the_materials_changes_nothing() -> None:
    bearing = paper_bearing(1.0)
    one = external_contact_stiffness(bearing, STEEL, STEEL_35CRMO)
    # order of a sum: rounding
    assert external_contact_stiffness(bearing, STEEL_35CRMO, STEEL) == pytest.approx(one, rel=1e-15)


def test_stiffness_grows_with_the_square_root_of_the_size() -> None:
    small = JournalBearing(bore_radius=0.05, clearance=0.001)
    large = JournalBearing(bore_radius=0.2, clearance=0.004)
    ratio = external_contact_stiffness(large, STEEL, STEEL) / external_contact_stiffness(small, STEEL, STEEL)
    # rounding
    assert ratio == pytest.approx(2.0, rel=1e-14)


def test_compliance_of_an_incompressible_material() -> None:
    # Eq. 6 by hand: (1 - 1/4)/(pi E); rounding
    assert material(1e9, 0.5).compliance == pytest.approx(0.75 / (math.pi * 1e9), rel=1e-15)


def test_a_material_that_cannot_shrink_sideways_is_stiffer() -> None:
    assert material(ratio=0.3).compliance < material(ratio=0.0).compliance


@pytest.mark.parametrize("ratio", [-0.1, 0.51])
def test_impossible_poisson_ratio_is_refused(ratio: float) -> None:
    with pytest.raises(InputError, match=rf"Material\.poisson_ratio = {ratio}: .*allowed: >= 0 and <= 0\.5"):
        material(ratio=ratio)


def test_modulus_of_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"Material\.elastic_modulus = 0\.0: .*allowed: > 0"):
        material(modulus=0.0)
