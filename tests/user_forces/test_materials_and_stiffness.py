"""Stiffness of internal and external contact, and elastic data of two bodies."""

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
    effective_modulus,
    external_contact_stiffness,
    internal_contact_stiffness,
)

moduli = st.floats(1e9, 1e12)
ratios = st.floats(0.0, 0.5)
BOTH = (external_contact_stiffness, internal_contact_stiffness)


def material(modulus: float = 2.07e11, ratio: float = 0.3) -> Material:
    return Material(name="test", elastic_modulus=modulus, poisson_ratio=ratio, density=7800.0)


def bearing(bore_mm: float, clearance_mm: float) -> JournalBearing:
    return JournalBearing(bore_radius=bore_mm / 1e3, clearance=clearance_mm / 1e3)


# clearance [mm], K [N/mm^1.5] of external contact from Table 2 of "Dynamic Analysis of Hydraulic Support with
# Single Clearance", and of internal contact by hand, with half of its last printed digit
TABLE = [
    (0.5, 861300.557, 1.391e7, 5e3),
    (1.0, 859629.849, 9.801e6, 5e2),
    (1.5, 857942.947, 7.972e6, 5e2),
    (2.0, 856239.607, 6.877e6, 5e2),
]


@pytest.mark.parametrize(("clearance_mm", "external", "internal", "half"), TABLE)
def test_stiffness_of_the_supports_pins(
    clearance_mm: float, external: float, internal: float, half: float
) -> None:
    place = bearing(65.5, clearance_mm)
    found = [stiffness(place, STEEL, STEEL_35CRMO) / 1000.0**1.5 for stiffness in BOTH]
    assert found[0] == pytest.approx(external, abs=5e-4)  # to every printed digit
    assert found[1] == pytest.approx(internal, abs=half)


def test_internal_stiffness_of_the_slider_crank() -> None:
    # radii 10 and 9.5 mm, E = 207 GPa, nu = 0.3: half of the last printed digit
    found = internal_contact_stiffness(bearing(10.0, 0.5), material(), material())
    assert found == pytest.approx(6.610198e10, abs=5e3)


@given(e1=moduli, nu1=ratios, e2=moduli, nu2=ratios, bore=st.floats(1e-3, 1.0), share=st.floats(1e-3, 0.9))
def test_stiffness_and_modulus_are_those_of_hertzian_spheres(
    e1: float, nu1: float, e2: float, nu2: float, bore: float, share: float
) -> None:
    place = JournalBearing(bore_radius=bore, clearance=share * bore)
    journal, one, two = bore - share * bore, material(e1, nu1), material(e2, nu2)
    for stiffness, curvature in zip(
        BOTH, (1.0 / journal + 1.0 / bore, 1.0 / journal - 1.0 / bore), strict=True
    ):
        got = stiffness(place, one, two)
        # the same in another form: a difference of curvatures loses three digits at a clearance of R/1000
        assert got == pytest.approx(sphere_stiffness(e1, nu1, e2, nu2, 1.0 / curvature), rel=1e-12)
        assert stiffness(place, two, one) == pytest.approx(got, rel=1e-15)
    # springs in series; rounding
    expected = 1.0 / ((1.0 - nu1**2) / e1 + (1.0 - nu2**2) / e2)
    assert effective_modulus(one, two) == pytest.approx(expected, rel=1e-14)


def test_elastic_data_by_hand() -> None:
    # 210/(2 0.91) GPa: half of the last printed digit
    assert effective_modulus(*2 * (material(2.1e11),)) == pytest.approx(1.153846e11, abs=5e4)
    # Eq. 6 of the paper: (1 - 1/4)/(pi E); rounding
    assert material(1e9, 0.5).compliance == pytest.approx(0.75 / (math.pi * 1e9), rel=1e-15)


@pytest.mark.parametrize(
    ("field", "wrong", "allowed"),
    [
        ("poisson_ratio", -0.1, ">= 0 and <= 0.5"),
        ("poisson_ratio", 0.51, ">= 0 and <= 0.5"),
        ("elastic_modulus", 0.0, "> 0"),
    ],
)
def test_impossible_elastic_data_are_refused(field: str, wrong: float, allowed: str) -> None:
    fields = {"name": "test", "elastic_modulus": 2e11, "poisson_ratio": 0.3, "density": 7800.0}
    with pytest.raises(InputError, match=rf"Material\.{field} = {wrong}: .*allowed: {allowed}"):
        Material(**fields | {field: wrong})  # type: ignore[arg-type]
