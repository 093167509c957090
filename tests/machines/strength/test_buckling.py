"""Buckling of stepped columns: Euler's and Johnson's closed forms, and eigenvalues by finite elements."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from support_exudyn.machines.strength.parts import (
    Segment,
    buckling_loads,
    euler_load,
    johnson_load,
    seen_stages,
)
from support_exudyn.machines.strength.strength_data import CylinderStage, CylinderStrength
from user_forces import InputError

segments = st.lists(st.tuples(st.floats(0.05, 3.0), st.floats(1e4, 1e8)), min_size=1, max_size=4)


def by_finite_elements(parts: list[Segment], each: int = 12) -> float:
    """The least buckling load of pinned beams with cubic deflections, K w = P G w."""
    count = each * len(parts)
    stiff, stress = np.zeros((2, 2 * count + 2, 2 * count + 2))
    n = 0
    for length, stiffness in parts:
        h = length / each
        bending = [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h**2, -6 * h, 2 * h**2],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h**2, -6 * h, 4 * h**2],
        ]
        pressed = [
            [36, 3 * h, -36, 3 * h],
            [3 * h, 4 * h**2, -3 * h, -(h**2)],
            [-36, -3 * h, 36, -3 * h],
            [3 * h, -(h**2), -3 * h, 4 * h**2],
        ]
        for _ in range(each):
            at = slice(2 * n, 2 * n + 4)
            stiff[at, at] += stiffness / h**3 * np.array(bending)
            stress[at, at] += np.array(pressed) / (30.0 * h)
            n += 1
    free = np.delete(np.arange(2 * count + 2), [0, 2 * count])  # both ends are pinned
    # the largest of G w = (1/P) K w is told more exactly than the least of K w = P G w
    return float(1.0 / eigh(stress[np.ix_(free, free)], stiff[np.ix_(free, free)], eigvals_only=True)[-1])


@given(length=st.floats(0.1, 10.0), stiffness=st.floats(1e2, 1e9), cuts=st.integers(1, 5))
def test_a_uniform_column_is_eulers(length: float, stiffness: float, cuts: int) -> None:
    expected = math.pi**2 * stiffness / length**2
    assert euler_load([(length / cuts, stiffness)] * cuts) == pytest.approx(expected, rel=1e-12)


@settings(max_examples=25)
@given(parts=segments)
def test_a_stepped_column_is_that_of_finite_elements(parts: list[Segment]) -> None:
    assert euler_load(parts) == pytest.approx(by_finite_elements(parts), rel=2e-3)


@given(parts=segments, longer=st.floats(1.01, 3.0), scale=st.floats(0.1, 10.0))
def test_order_length_and_units(parts: list[Segment], longer: float, scale: float) -> None:
    load = euler_load(parts)
    assert euler_load(parts[::-1]) == pytest.approx(load, rel=1e-9)
    assert euler_load([(length * scale, stiffness) for length, stiffness in parts]) == pytest.approx(
        load / scale**2, rel=1e-9
    )
    (first, stiffness), *others = parts
    assert euler_load([(first * longer, stiffness), *others]) < load


def test_johnson_meets_euler_where_half_the_section_yields() -> None:
    squash = 3.0e6
    assert johnson_load(0.5 * squash, squash) == 0.5 * squash
    assert johnson_load(0.5 * squash * (1.0 + 1e-9), squash) == pytest.approx(0.5 * squash, rel=1e-8)
    assert johnson_load(1e3, squash) == 1e3  # slender
    assert johnson_load(1e15, squash) == pytest.approx(squash)  # stocky
    # of a uniform column: sigma_y (1 - sigma_y (l/r)^2 / (4 pi^2 E))
    stage = CylinderStage(outer_diameter=0.1, length=1.0)
    rod = CylinderStrength(bore=0.2, yield_pressure=1e6, stages=(stage,) * 2, yield_stress=4e8)
    euler, johnson = buckling_loads(rod, 1.5)
    slenderness = 1.5 / (0.1 / 4.0)
    assert euler == pytest.approx(math.pi**2 * 2.06e11 * stage.area / slenderness**2, rel=1e-12)
    assert johnson == pytest.approx(
        stage.area * 4e8 * (1.0 - 4e8 * slenderness**2 / (4.0 * math.pi**2 * 2.06e11)), rel=1e-12
    )


def test_stages_come_out_from_the_thickest_on() -> None:
    thick, middle, thin = (
        CylinderStage(outer_diameter=size, inner_diameter=0.5 * size, length=length)
        for size, length in ((0.4, 1.0), (0.3, 0.8), (0.2, 0.7))
    )
    leg = CylinderStrength(bore=0.35, yield_pressure=4e7, stages=(thick, middle, thin))
    assert seen_stages(leg, 1.5) == [(1.0, thick), (0.5, middle)]
    assert seen_stages(leg, 2.0) == [(1.0, thick), (0.8, middle), (pytest.approx(0.2), thin)]
    assert buckling_loads(leg, 2.0)[1] is None  # no yield stress
    with pytest.raises(InputError, match=r"together 2\.5 m long, and the cylinder has to be 2\.6 m"):
        seen_stages(leg, 2.6)
    with pytest.raises(InputError, match=r"stages\[0\]\.length = 1 m: the cylinder is 0\.9 m long there"):
        seen_stages(leg, 0.9)
