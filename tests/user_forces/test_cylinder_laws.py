"""Line contact of cylinders, against depths as published; see also `test_normal_laws`."""

from __future__ import annotations

import math
from typing import Any

import pytest

from tests.cases.law_cases import BEARING, LENGTH, cylinder_law, kind_of
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


@pytest.mark.parametrize("name", DEPTHS)
def test_depth_is_that_of_the_table(name: str) -> None:
    law, printed = DEPTHS[name]
    for p, text in zip(LOADS, printed.split(), strict=False):  # Goldsmith's in mm ends early
        half_a_digit = 0.5 * 10.0 ** -len(text.split(".")[1])
        assert 1e6 * law.resting_depth(p * law.length) == pytest.approx(float(text), abs=1.001 * half_a_digit)


def test_a_width_factor_out_of_range_is_refused() -> None:
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
