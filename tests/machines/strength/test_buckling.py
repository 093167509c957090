"""Buckling of stepped columns, stresses of pins and tipping, against closed forms and finite elements."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from support_exudyn.files.machines import shipped
from support_exudyn.machines.strength.parts import (
    Segment,
    buckling_loads,
    euler_load,
    pin_data,
    seen_stages,
    stresses,
    tipping_of,
)
from support_exudyn.machines.strength.strength_data import (
    BaseFrame,
    CylinderStage,
    CylinderStrength,
    PinStrength,
)
from support_exudyn.model.linkage import Body, Linkage
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
    # of a uniform column: sigma_y (1 - sigma_y (l/r)^2 / (4 pi^2 E))
    stage = CylinderStage(outer_diameter=0.1, length=1.0)
    rod = CylinderStrength(bore=0.2, yield_pressure=1e6, stages=(stage,) * 2, yield_stress=4e8)
    euler, johnson = buckling_loads(rod, 1.5)
    slenderness = 1.5 / (0.1 / 4.0)
    assert euler == pytest.approx(math.pi**2 * 2.06e11 * stage.area / slenderness**2, rel=1e-12)
    assert johnson == pytest.approx(
        stage.area * 4e8 * (1.0 - 4e8 * slenderness**2 / (4.0 * math.pi**2 * 2.06e11)), rel=1e-12
    )
    # a slender one of which half of the section yields is Euler's
    meeting = 2.0 * euler / stage.area
    for share in (0.9999, 1.0, 2.0):
        euler, johnson = buckling_loads(replace(rod, yield_stress=share * meeting), 1.5)
        assert johnson == pytest.approx(euler, rel=1e-7)


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


# --- pins and tipping ---


sizes = st.floats(0.02, 0.5)


@given(
    force=st.floats(1e3, 1e7),
    middle=sizes,
    outer=sizes,
    gap=st.floats(1e-3, 0.1) | st.just(0.0),
    diameter=sizes,
    count=st.integers(1, 4),
)
def test_a_pin_is_a_beam_under_even_pressure(
    force: float, middle: float, outer: float, gap: float, diameter: float, count: int
) -> None:
    pin = PinStrength(middle=middle, outer=outer, gap=gap, count=count)
    found = stresses(pin, diameter, force)
    # pressure along the pin, integrated twice from its free end
    half = 0.5 * middle + gap + outer
    edges = np.array([0.0, outer, outer + gap, half])
    loads = np.array([0.5 / outer, 0.0, -1.0 / middle]) * force / count
    shear = np.concatenate([[0.0], np.cumsum(loads * np.diff(edges))])
    moment = np.concatenate([[0.0], np.cumsum(0.5 * (shear[1:] + shear[:-1]) * np.diff(edges))])
    radius = 0.5 * diameter
    assert shear[-1] == pytest.approx(0.0, abs=1e-9 * force)  # symmetric
    second = math.pi / 4.0 * radius**4
    assert found.bending == pytest.approx(moment[-1] * radius / second, rel=1e-9)
    assert found.shear == pytest.approx(np.abs(shear).max() / (math.pi * radius**2), rel=1e-9)
    pressures = [force / count / (diameter * middle), 0.5 * force / count / (diameter * outer)]
    assert found.bearing == pytest.approx(max(pressures), rel=1e-9)
    assert found.safeties["shear"] == pytest.approx(8.35e8 / math.sqrt(3.0) / found.shear)
    assert found.least[1] == min(found.safeties.values())


def test_eyes_of_which_only_the_pin_is_known_are_assumed() -> None:
    data = replace(shipped("two_leg_shield"), strength=None)
    eyes, diameter, assumed = pin_data(data, "front_base") or pytest.fail("is known")
    assert (eyes.count, eyes.middle, eyes.outer, diameter, assumed) == (2, 0.08, 0.04, 0.15, True)
    eyes, _, _ = pin_data(data, "rear_base") or pytest.fail("is known")
    assert (eyes.count, eyes.middle) == (1, 0.5)
    bare = replace(data, bore_radii={})
    assert pin_data(bare, "rear_base") is None
    assert pin_data(bare, "hinge") is None


# --- tipping ---


def box(length: float, height: float) -> tuple[Linkage, BaseFrame]:
    """A uniform box, its upper half a body and its lower half the base."""
    upper = Body(mass=500.0, inertia=10.0, centre=(0.5 * length, 0.75 * height))
    base = BaseFrame(
        rear=0.0, front=length, width=1.5 * length, mass=500.0, centre=(0.5 * length, 0.25 * height)
    )
    return Linkage(bodies={"upper": upper}), base


@given(length=st.floats(0.1, 5.0), height=st.floats(0.1, 5.0))
def test_a_box_tips_when_its_diagonal_is_upright(length: float, height: float) -> None:
    found = tipping_of(*box(length, height))
    assert found.mass == 1000.0
    assert found.angles["forward"] == pytest.approx(math.atan2(length, height))
    assert found.angles["rearward"] == pytest.approx(math.atan2(length, height))
    assert found.angles["sideways"] == pytest.approx(math.atan2(1.5 * length, height))


@given(x=st.floats(-1.0, 2.0), height=st.floats(0.1, 3.0), by=st.floats(0.01, 0.2))
def test_on_a_floor_inclined_by_more_its_centre_is_beyond_the_edge(x: float, height: float, by: float) -> None:
    linkage = Linkage(bodies={"one": Body(mass=3.0, inertia=1.0, centre=(x, height))})
    base = BaseFrame(rear=0.0, front=1.0, width=1.0, mass=1.0, centre=(0.5, 0.1))
    found = tipping_of(linkage, base)
    for angle, sign, beyond in (
        (found.angles["forward"] + by, -1.0, lambda over: over > 1.0),
        (-found.angles["rearward"] - by, -1.0, lambda over: over < 0.0),
    ):
        # where the line of gravity meets the floor
        over = found.centre[0] - sign * found.centre[1] * math.tan(angle)
        assert beyond(over) or abs(angle) > 0.5 * math.pi


def test_a_floor_above_the_centre_is_refused() -> None:
    linkage, base = box(1.0, 1.0)
    with pytest.raises(InputError, match=r"centre of mass is 0\.5 m high; allowed: a floor below it"):
        tipping_of(linkage, replace(base, floor=2.0))


# --- values ---


def test_values_that_cannot_be_are_refused() -> None:
    with pytest.raises(InputError, match=r"inner_diameter = 0\.2 m: allowed: below outer_diameter = 0\.1 m"):
        CylinderStage(outer_diameter=0.1, inner_diameter=0.2, length=1.0)
    with pytest.raises(InputError, match=r"rod = 0\.3 m: allowed: below bore = 0\.2 m"):
        CylinderStrength(bore=0.2, rod=0.3, yield_pressure=1e6)
    with pytest.raises(InputError, match=r"setting_pressure = 2 MPa: allowed: at most yield_pressure = 1 MPa"):
        CylinderStrength(bore=0.2, yield_pressure=1e6, setting_pressure=2e6)
    with pytest.raises(InputError, match="front = 0 m: allowed: > rear = 1 m"):
        BaseFrame(rear=1.0, front=0.0, width=1.0, mass=1.0, centre=(0.0, 0.0))
