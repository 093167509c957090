"""Stresses of pins by integration along them; tipping of boxes, also by turning them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn.files.machines import shipped
from support_exudyn.machines.strength.parts import pin_data, stresses, tipping_of
from support_exudyn.machines.strength.strength_data import (
    BaseFrame,
    CylinderStage,
    CylinderStrength,
    PinStrength,
)
from support_exudyn.model.linkage import Body, Linkage
from user_forces import InputError

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
