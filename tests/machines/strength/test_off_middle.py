"""Roof forces beside the middle: closed forms, equilibrium in space, the plane as a limit."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn.files.machines import shipped
from support_exudyn.machines.check.statics import GRAVITY
from support_exudyn.machines.strength.off_middle import SpatialStatics
from support_exudyn.machines.strength.roof_forces import Limits, RoofForce, RoofStatics
from support_exudyn.machines.strength.used_postures import used_postures
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.to_space import Width, lift
from tests.machines.strength.test_roof_forces import beam
from user_forces import InputError

LEAST: tuple[Literal["forces", "moments"], ...] = ("forces", "moments")
NAMES = ("reference", "two_leg_shield")
MIDDLE: dict[str, tuple[RoofStatics, SpatialStatics, Linkage]] = {}


def middle(name: str) -> tuple[RoofStatics, SpatialStatics, Linkage]:
    """A shipped support in the middle of its height, in the plane and in space."""
    if name not in MIDDLE:
        data = shipped(name)
        linkage = used_postures(data, 3)[1].linkage
        flat = RoofStatics(linkage, "canopy")
        space = SpatialStatics(data.machine.in_space(linkage), "canopy", flat.contact.height)
        MIDDLE[name] = flat, space, linkage
    return MIDDLE[name]


@given(aside=st.floats(0.0, 0.6), half=st.floats(0.2, 1.0), at=st.floats(0.5, 4.0))
def test_two_legs_under_a_beam_share_by_the_lever(aside: float, half: float, at: float) -> None:
    flat, high = beam(4.0, 2.0, 100.0), 1e6
    width = Width(spreads={"canopy": 0.5}, actuators={"leg": half}, lengths={"hinge": 0.2})
    space = SpatialStatics(lift(flat, width), "canopy", 0.0)
    weight, roll = 100.0 * 9.81, aside / half
    # the nearer leg yields: (Q at/2 + W)/2 + Q roll/2 = high/2; or the other lifts off: Q (roll - at/2) = W
    expected = (high - weight) / (0.5 * at + roll)
    if expected * (roll - 0.5 * at) > weight:
        expected = weight / (roll - 0.5 * at)
    assert space.legs_alone(at, aside, {"leg": Limits(0.0, high)}) == pytest.approx(expected, rel=1e-6, abs=0.1)


@pytest.mark.parametrize("name", NAMES)
def test_in_the_middle_legs_alone_carry_what_they_carry_in_the_plane(name: str) -> None:
    flat, space, _ = middle(name)
    limits = {one: Limits(0.0, 3e6) for one in flat.actuators}
    for x in np.linspace(flat.contact.rear, flat.contact.front, 5).tolist():
        expected = flat.largest_at(x, limits)
        assert space.legs_alone(x, 0.0, limits) == pytest.approx(expected, rel=1e-6, abs=1.0)


def test_four_columns_at_one_distance_share_by_the_lever() -> None:
    flat, space, _ = middle("reference")
    high = 3.8e6
    roof = flat.balancing(dict.fromkeys(flat.actuators, high))
    assert roof is not None
    half = {abs(one.foot_point[2]) for one in space.linkage.actuators.values()}
    assert len(half) == 1
    limits = {one: Limits(0.0, high) for one in flat.actuators}
    for aside in (0.05, 0.15, 0.25):
        # the nearer side yields; a little is left to weight, which is not aside, and to what the links carry
        expected = roof.force / (1.0 + aside / half.copy().pop())
        assert space.legs_alone(roof.x, aside, limits) == pytest.approx(expected, rel=0.01)


@settings(max_examples=15)
@given(
    name=st.sampled_from(NAMES),
    force=st.floats(1e5, 1e7),
    aside=st.floats(-0.5, 0.5),
    least=st.sampled_from(LEAST),
)
def test_what_the_joints_carry_balances_the_canopy(
    name: str, force: float, aside: float, least: Literal["forces", "moments"]
) -> None:
    flat, space, linkage = middle(name)
    roof = RoofForce(force, 0.4 * flat.contact.rear + 0.6 * flat.contact.front)
    found = space.twist(roof, aside, flat.pushes(roof), least)
    canopy = space.linkage.bodies["canopy"]
    at = np.array([roof.x, flat.contact.height, aside])
    loads = [(np.array([0.0, -force, 0.0]), at)]
    loads.append((canopy.mass * np.array([*GRAVITY, 0.0]), np.array(canopy.centre)))
    for one in space.linkage.actuators.values():
        push = one.share * flat.pushes(roof)[one.actuator]
        along = np.subtract(one.head_point, one.foot_point) / one.start_length
        loads.append((push * along, np.array(one.head_point)))
    moment = np.zeros(3)
    for hinge, bearing in space.linkage.bearings.items():
        if bearing.second == "canopy":
            loads.append((found.bearings[hinge], np.array(bearing.second_point)))
            moment += found.moments[hinge]
    size = sum(float(np.linalg.norm(part)) for part, _ in loads)
    assert np.abs(sum(part for part, _ in loads)).max() < 1e-8 * size
    assert np.abs(moment + sum(np.cross(place, part) for part, place in loads)).max() < 1e-7 * size
    # legs that push alike leave all of the roll to the hinge
    assert moment[0] == pytest.approx(-force * aside, abs=1e-8 * size)
    # together the bearings of a pin carry what it does in the plane
    for pin, expected in flat.pins(roof).items():
        both = sum(found.bearings[part] for part in space.linkage.parts_of_pin(pin))
        assert both[:2] == pytest.approx(expected, abs=1e-6 * size)
    assert set(linkage.pins) == {one.pin for one in space.linkage.bearings.values()}


def test_the_two_shares_are_the_least_of_their_kind() -> None:
    flat, space, _ = middle("reference")
    roof = RoofForce(7e6, flat.contact.rear + 1.0)
    by_forces, by_moments = (space.twist(roof, 0.3, flat.pushes(roof), least) for least in LEAST)

    def squares(loads: dict[str, np.ndarray]) -> float:
        return sum(float(load @ load) for load in loads.values())

    assert squares(by_forces.bearings) < squares(by_moments.bearings)
    assert squares(by_moments.moments) < squares(by_forces.moments)
    # with the least forces both front links carry the same: moments do all of it
    left, right = (by_forces.bearings[f"front_base_{side}"] for side in ("left", "right"))
    assert left == pytest.approx(right, rel=1e-6, abs=1.0)


def test_a_push_that_does_not_hold_is_refused() -> None:
    flat, space, _ = middle("reference")
    roof = RoofForce(7e6, flat.contact.rear + 1.0)
    wrong = {name: 1.001 * push for name, push in flat.pushes(roof).items()}
    with pytest.raises(InputError, match="N of the roof force 7e\\+06 N are not balanced"):
        space.twist(roof, 0.0, wrong, "forces")
