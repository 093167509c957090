"""Line contact of cylinders, against the formulas and depths as published; see also `test_normal_laws`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import lambertw

from tests.cases.law_cases import (
    BEARING,
    LENGTH,
    LOGARITHMIC_LAWS,
    MODULUS,
    cylinder_law,
    kind_of,
)
from user_forces import (
    CylinderLaw,
    DubowskyFreudenstein,
    Esdu78035,
    Goldsmith,
    InputError,
    Johnson,
    JournalBearing,
    Liu,
    Pereira,
    Radzimovsky,
)

R1, R2, DR = BEARING.journal_radius, BEARING.bore_radius, BEARING.clearance
H = 1.0 / (math.pi * MODULUS)  # h1 + h2, h = (1 - nu^2)/(pi E) [m^2/N]

# --- depth under a load per length, as published ---


def johnson(p: float) -> float:
    """Johnson, Contact Mechanics, section 5.6."""
    return p / (math.pi * MODULUS) * (math.log(4.0 * math.pi * MODULUS * DR / p) - 1.0)


def radzimovsky(p: float, width: float = 1.6) -> float:
    """As Pereira, Ramalho and Ambrosio print it."""
    b = width * math.sqrt(p * R1 * R2 / (MODULUS * DR))
    return p / (math.pi * MODULUS) * (2.0 / 3.0 + math.log(4.0 * R1 / b) + math.log(4.0 * R2 / b))


def goldsmith(p: float, unit: float) -> float:
    """Printed with L^m, m = 1; the unit of length [m] makes the argument of the logarithm a number."""
    force = p * LENGTH
    return force * H / LENGTH * (math.log(unit**2 * LENGTH * DR / (force * R1 * R2 * H)) + 1.0)


def dubowsky_freudenstein(p: float, length: float = LENGTH) -> float:
    """Printed with L^m, m = 3."""
    force = p * length
    return force * H / length * (math.log(length**3 * DR / (force * R1 * R2 * H)) + 1.0)


def esdu(p: float) -> float:
    """ESDU 78035."""
    return p * H * (math.log(4.0 * DR / (p * H)) + 1.0)


IMPLICIT: dict[type[CylinderLaw], Callable[[float], float]] = {
    Johnson: johnson,
    Radzimovsky: radzimovsky,
    Goldsmith: lambda p: goldsmith(p, 2.0 * math.sqrt(R1 * R2)),
    DubowskyFreudenstein: dubowsky_freudenstein,
    Esdu78035: esdu,
}
# A [N/m] and c of the common form depth = p H (ln(A/p) + c), from the table in notes.md
COMMON: dict[type[CylinderLaw], tuple[float, float]] = {
    Johnson: (4.0 * math.pi * MODULUS * DR, -1.0),
    Radzimovsky: (6.25 * MODULUS * DR, 2.0 / 3.0),
    Goldsmith: (4.0 * math.pi * MODULUS * DR, 1.0),
    DubowskyFreudenstein: (math.pi * MODULUS * DR * LENGTH**2 / (R1 * R2), 1.0),
    Esdu78035: (4.0 * math.pi * MODULUS * DR, 1.0),
}


def liu(depth: float) -> float:
    """Force [N]; Liu, Zhang and Yang."""
    return 0.5 * math.pi * depth * MODULUS * LENGTH * math.sqrt(depth / (2.0 * (DR + depth)))


def pereira(depth: float) -> float:
    """Force [N]; Pereira, Ramalho and Ambrosio, in mm and N/mm^2."""
    gap, deep, length, modulus = 1e3 * DR, 1e3 * depth, 1e3 * LENGTH, 1e-6 * MODULUS
    n = (0.0151 * gap + 1.151) * gap**-0.005
    return (0.965 * gap + 0.0965) * length * modulus / gap * deep**n


EXPLICIT: dict[type[CylinderLaw], Callable[[float], float]] = {Liu: liu, Pereira: pereira}

# Depth [um] at p = 1e2, 1e3, 1e4, 1e5, 1e6 N/m, from the table in notes.md
LOADS = (1e2, 1e3, 1e4, 1e5, 1e6)
MILLIMETRE, METRE = 1e-3, 1.0
DEPTHS: dict[str, tuple[CylinderLaw, str]] = {
    "Johnson": (cylinder_law(Johnson), ".0043850 .037497 .31145 2.4793 18.441"),
    "Radzimovsky": (cylinder_law(Radzimovsky), ".0046521 .040169 .33816 2.7464 21.112"),
    "Radzimovsky, half width": (
        cylinder_law(Radzimovsky, width_factor=2.0 / math.sqrt(math.pi)),
        ".0048447 .042095 .35743 2.9391 23.039",
    ),
    "Roark": (
        cylinder_law(Radzimovsky, width_factor=4.0 / math.sqrt(math.pi)),
        ".0044623 .038271 .31919 2.5567 19.215",
    ),
    "ESDU": (cylinder_law(Esdu78035), ".0049367 .043015 .36663 3.0311 23.959"),
    "Goldsmith": (cylinder_law(Goldsmith), ".0049367 .043015 .36663 3.0311 23.959"),
    "Dubowsky, mean diameter": (
        cylinder_law(DubowskyFreudenstein, length=2.0 * math.sqrt(R1 * R2)),
        ".0049367 .043015 .36663 3.0311 23.959",
    ),
    "Dubowsky, 50 mm": (
        cylinder_law(DubowskyFreudenstein, length=0.05),
        ".0044117 .037765 .31412 2.5060 18.708",
    ),
    "Dubowsky, 1 m": (cylinder_law(DubowskyFreudenstein, length=1.0), ".0060645 .054293 .47941 4.1589 35.237"),
    "Goldsmith in m": (
        cylinder_law(Goldsmith, reference_length=METRE),
        ".0060645 .054293 .47941 4.1589 35.237",
    ),
    # at 1e6 N/m the formula gives a negative depth: no load is that large, see below
    "Goldsmith in mm": (
        cylinder_law(Goldsmith, reference_length=MILLIMETRE),
        ".0022533 .016180 .098284 .34763",
    ),
    # the table has .0065102, where its search for the root stopped early
    "Pereira": (cylinder_law(Pereira), ".0065101 .046490 .33200 2.3709 16.931"),
    "Liu": (cylinder_law(Liu), ".097022 .45037 2.0912 9.7229 45.483"),
}

powers = st.floats(-12.0, -0.1).map(lambda power: 10.0**power)  # shares of a range
logarithmic = pytest.mark.parametrize("kind", LOGARITHMIC_LAWS, ids=kind_of)


@logarithmic
@given(share=powers)
def test_load_and_depth_are_those_of_the_published_formula(kind: type[CylinderLaw], share: float) -> None:
    scale, offset = COMMON[kind]
    law: Any = cylinder_law(kind)
    p = share * scale * math.exp(offset - 1.0)
    # at 0.8 of the largest load the force is 5 times as sensitive as the depth, which is rounded
    assert law.elastic_force(IMPLICIT[kind](p)) == pytest.approx(p * LENGTH, rel=1e-12)


@pytest.mark.parametrize("kind", EXPLICIT, ids=kind_of)
@given(share=powers)
def test_explicit_law_is_the_published_formula(kind: type[CylinderLaw], share: float) -> None:
    depth = share * cylinder_law(kind).largest_depth
    # the same in another order: rounding, in Pereira's law of a power of numbers down to 1e-12
    assert cylinder_law(kind).elastic_force(depth) == pytest.approx(EXPLICIT[kind](depth), rel=1e-13)


@pytest.mark.parametrize("name", DEPTHS)
def test_depth_is_that_of_the_table(name: str) -> None:
    law, printed = DEPTHS[name]
    for p, text in zip(LOADS, printed.split(), strict=False):  # Goldsmith's in mm ends early
        half_a_digit = 0.5 * 10.0 ** -len(text.split(".")[1])
        assert 1e6 * law.resting_depth(p * law.length) == pytest.approx(float(text), abs=1.001 * half_a_digit)


def test_width_factor_of_radzimovsky() -> None:
    law = cylinder_law(Radzimovsky, width_factor=2.0)
    # the published formula the other way round: rounding
    assert law.elastic_force(radzimovsky(1e5, width=2.0)) == pytest.approx(1e5 * LENGTH, rel=1e-12)
    with pytest.raises(InputError, match=r"Radzimovsky\.width_factor = 0\.9: .*allowed: >= 1 and <= 2\.5"):
        cylinder_law(Radzimovsky, width_factor=0.9)


# e is Euler's number
@pytest.mark.parametrize(
    ("kind", "limit"),
    [
        (Johnson, 4.0 * DR / math.e**2),
        (Radzimovsky, 1.4255 * DR),
        (Goldsmith, 4.0 * DR),
        (DubowskyFreudenstein, DR * LENGTH**2 / (R1 * R2)),
        (Esdu78035, 4.0 * DR),
        (Liu, R1),
        (Pereira, 4.0 * DR / math.e**2),
    ],
    ids=kind_of,
)
def test_largest_depth(kind: type[CylinderLaw], limit: float) -> None:
    # half of the last printed digit of 1.4255
    assert cylinder_law(kind).largest_depth == pytest.approx(limit, rel=4e-5 if kind is Radzimovsky else 1e-14)


# --- Liu and Pereira ---


def gap(millimetres: float) -> Pereira:
    bearing = JournalBearing(bore_radius=0.0655, clearance=1e-3 * millimetres)
    return cylinder_law(Pereira, bearing=bearing)  # type: ignore[return-value]


def test_range_of_pereira_and_what_it_delivers() -> None:
    for mm in (0.005, 10.0):
        assert gap(mm).elastic_force(1e-7) > 0.0
    for mm in (0.00499, 10.01):
        with pytest.raises(InputError, match=r"Pereira: bearing\.clearance = .* m: allowed .*5e-06 to 0\.01 m"):
            gap(mm)
    law: Any = cylinder_law(Pereira, restitution=0.9)
    # 3/4 (1 - 0.81) by hand: rounding; and half of the last digit of the docstring
    assert law.damping_factor == pytest.approx(0.1425, rel=1e-14)
    assert law.delivered_restitution == pytest.approx(0.913, abs=5e-4)


@logarithmic
@given(share=st.floats(-250.0, -0.05).map(lambda power: 10.0**power))
def test_load_at_a_depth_is_the_branch_of_lambert(kind: type[CylinderLaw], share: float) -> None:
    scale, offset = COMMON[kind]
    depth = share * H * scale * math.exp(offset - 1.0)
    y = -float(lambertw(-share / math.e, -1).real)
    # at 0.9 of the largest depth the argument, rounded, is as far from its branching as 0.1
    assert cylinder_law(kind).elastic_force(depth) == pytest.approx(LENGTH * depth / (H * y), rel=1e-12)


@given(mm=st.floats(0.005, 0.3495))
def test_exponent_of_pereira(mm: float) -> None:
    y = 1.51 * math.log(1000.0 * mm) ** -0.151
    # the same formula: rounding, of the clearance in m too
    assert gap(mm).exponent == pytest.approx(y * mm**-0.005, rel=1e-14)
    assert gap(1.5).exponent == pytest.approx(1.17127, abs=5e-6)  # half of the last printed digit
    below, above = gap(0.34954 * (1.0 - 1e-12)).exponent, gap(0.34954 * (1.0 + 1e-12)).exponent
    # 1.156278008 and 1.156278054 by hand, times 0.34954^-0.005 = 1.005: both branches meet
    assert above - below == pytest.approx(1.005 * 4.6e-8, abs=1e-9)
