"""Roof forces that actuators hold: closed forms, virtual work, equilibrium of every body, limits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from support_exudyn.files.machines import shipped
from support_exudyn.machines.check.statics import GRAVITY
from support_exudyn.machines.check.statics import statics as check_statics
from support_exudyn.machines.strength.roof_forces import (
    Limits,
    RoofForce,
    RoofStatics,
    UsedPosture,
    used_postures,
)
from support_exudyn.mechanics.closing import Conditions, newton
from support_exudyn.model.linkage import GROUND, Body, LinearActuator, Linkage, TracePoint, pinned
from user_forces import InputError

G = -GRAVITY[1]
SHIELDS = ("reference", "zf18000", "two_leg_shield")
POSTURES: dict[str, list[UsedPosture]] = {}


def postures(name: str) -> list[UsedPosture]:
    if name not in POSTURES:
        POSTURES[name] = used_postures(shipped(name), 5)
    return POSTURES[name]


def beam(length: float, leg_at: float, mass: float, lean: float = 0.0) -> Linkage:
    """A level beam on a hinge at the origin, and one leg under it."""
    return Linkage(
        bodies={"canopy": Body(mass=mass, inertia=mass * length**2 / 12, centre=(0.5 * length, 0.0))},
        pins={"hinge": pinned(GROUND, "canopy", (0.0, 0.0))},
        actuators={
            "leg": LinearActuator(
                foot=GROUND, head="canopy", foot_point=(leg_at - lean, -1.0), head_point=(leg_at, 0.0)
            )
        },
        points={"tip": TracePoint(body="canopy", point=(length, 0.0))},
    )


def pushes_of(statics: RoofStatics, roof: RoofForce) -> dict[str, float]:
    """Pushes of the actuators under a roof force [N]: they stand behind two forces a pin."""
    pushes = statics.all_forces(roof)[2 * len(statics.linkage.pins) :].tolist()
    return dict(zip(statics.linkage.actuators, pushes, strict=True))


pushing = st.floats(1e3, 1e7)
shields = st.tuples(st.sampled_from(SHIELDS), st.integers(0, 4))
frictions = st.floats(-0.4, 0.4)


# --- closed forms ---


@given(
    length=st.floats(1.0, 6.0), share=st.floats(0.1, 0.9), mass=st.floats(1.0, 1e4), push=pushing,
    lean=st.floats(-0.5, 0.5), at=st.floats(0.05, 1.0),
)  # fmt: skip
def test_a_leg_under_a_beam(
    length: float, share: float, mass: float, push: float, lean: float, at: float
) -> None:
    leg_at, up = share * length, 1.0 / math.hypot(1.0, lean)
    statics = RoofStatics(beam(length, leg_at, mass, lean), "canopy")
    # moments about the hinge
    expected = (push * up * leg_at - mass * G * 0.5 * length) / (at * length)
    found = statics.largest_at(at * length, {"leg": Limits(0.0, push)})
    assert found == pytest.approx(max(expected, 0.0), rel=1e-9, abs=1e-9 * push)
    # the hinge presses the beam down by what the leg lifts more than weight and roof press
    hinge = statics.pins(RoofForce(expected, at * length))["hinge"]
    size = 1e-9 * (push + mass * G) / at
    assert hinge[1] == pytest.approx(expected + mass * G - push * up, abs=size)
    assert hinge[0] == pytest.approx(-push * up * lean, abs=size)


@given(
    which=shields,
    pushes=st.tuples(pushing, pushing),
    friction=frictions,
    way=st.tuples(*2 * [st.floats(-1, 1)]),
)
def test_the_work_of_actuators_is_that_against_roof_and_weight(
    which: tuple[str, int], pushes: tuple[float, float], friction: float, way: tuple[float, float]
) -> None:
    linkage = postures(which[0])[which[1]].linkage
    statics = RoofStatics(linkage, "canopy", friction)
    forces = dict(zip(linkage.actuators, pushes, strict=True))
    roof = statics.balancing(forces)
    assert roof is not None
    conditions = Conditions(linkage)
    closed = conditions.kinetics
    step = 1e-4
    there = []
    for sign in (1.0, -1.0):
        travels = {name: sign * step * part for name, part in zip(linkage.actuators, way, strict=True)}
        found = newton(conditions, conditions.still, conditions.targets(travels, {}), 1.0)
        assert found is not None
        there.append(found / conditions.arms)
    height = statics.contact.height
    spots = [closed.point(one, "canopy", (roof.x, height))[0] for one in there]
    moved = spots[0] - spots[1]
    against_roof = roof.force * (moved[1] - friction * moved[0])
    weights = np.array([body.mass * G for body in linkage.bodies.values()])
    against_weight = float(weights @ (there[0] - there[1])[1::3])
    done = sum(2.0 * step * part * push for part, push in zip(way, pushes, strict=True))
    size = step * (sum(pushes) + abs(roof.force) * (1.0 + abs(roof.x)) + weights.sum())
    assert done == pytest.approx(against_roof + against_weight, abs=1e-5 * size)


# --- equilibrium, body by body ---


@given(which=shields, force=st.floats(0, 1e7), share=st.floats(0, 1), friction=frictions)
def test_forces_on_every_body_add_up_to_nothing(
    which: tuple[str, int], force: float, share: float, friction: float
) -> None:
    linkage = postures(which[0])[which[1]].linkage
    statics = RoofStatics(linkage, "canopy", friction)
    contact = statics.contact
    roof = RoofForce(force, contact.rear + share * (contact.front - contact.rear))
    on: dict[str, list[tuple[np.ndarray, tuple[float, float]]]] = {
        name: [] for name in [*linkage.bodies, GROUND]
    }
    for name, pin in statics.pins(roof).items():
        place = linkage.pins[name]
        on[place.second].append((pin, place.second_point))
        on[place.first].append((-pin, place.first_point))
    for name, push in pushes_of(statics, roof).items():
        one = linkage.actuators[name]
        along = np.subtract(one.head_point, one.foot_point) / one.start_length
        on[one.head].append((push * along, one.head_point))
        on[one.foot].append((-push * along, one.foot_point))
    on["canopy"].append((np.array([friction * force, -force]), (roof.x, contact.height)))
    for name, body in linkage.bodies.items():
        on[name].append((np.array([0.0, -body.mass * G]), body.centre))
        forces = sum(part for part, _ in on[name])
        moment = sum(at[0] * part[1] - at[1] * part[0] for part, at in on[name])
        size = 1e-10 * sum(float(np.abs(part).sum()) for part, _ in on[name])
        assert np.abs(forces).max() <= size, name
        assert abs(moment) <= 10.0 * size, name
    # without a roof they are the static forces of a check, to rounding of 1e5 N
    held, bare = check_statics(linkage, np.zeros(3 * len(linkage.bodies))), RoofForce(0.0, contact.rear)
    assert held.error < 1e-6
    for name, pin in statics.pins(bare).items():
        assert held.pins[name] == pytest.approx(pin, abs=1e-6)
    assert held.actuators == pytest.approx(pushes_of(statics, bare), abs=1e-6)


# --- limits ---


@given(which=shields, highs=st.tuples(pushing, pushing), pull=st.floats(0, 1e6), share=st.floats(0.0, 1.0))
def test_the_largest_force_at_a_place_is_that_of_a_linear_programme(
    which: tuple[str, int], highs: tuple[float, float], pull: float, share: float
) -> None:
    linkage = postures(which[0])[which[1]].linkage
    statics = RoofStatics(linkage, "canopy")
    limits = {name: Limits(-pull, high) for name, high in zip(linkage.actuators, highs, strict=True)}
    x = statics.contact.rear + share * (statics.contact.front - statics.contact.rear)
    none, one = (np.array(list(pushes_of(statics, RoofForce(force, x)).values())) for force in (0.0, 1.0))
    if not all(limit.low <= push <= limit.high for limit, push in zip(limits.values(), none, strict=True)):
        return  # the weight alone is too much
    size = max(highs)
    rate = one - none
    found = linprog(
        [-1.0],
        A_ub=np.concatenate([rate, -rate])[:, None],
        b_ub=np.concatenate([np.array(highs) - none, none + pull]) / size,
    )
    assert statics.largest_at(x, limits) == pytest.approx(found.x[0] * size, rel=1e-6, abs=1e-6 * size)


@settings(max_examples=20)
@given(which=shields, highs=st.tuples(pushing, pushing), friction=frictions, seed=st.integers(0, 2**31))
def test_no_roof_force_within_the_limits_loads_a_pin_more_than_the_corners(
    which: tuple[str, int], highs: tuple[float, float], friction: float, seed: int
) -> None:
    linkage = postures(which[0])[which[1]].linkage
    statics = RoofStatics(linkage, "canopy", friction)
    limits = {name: Limits(0.0, 1e5 + high) for name, high in zip(linkage.actuators, highs, strict=True)}
    corners = statics.corners(limits)
    for corner in corners:
        slack = 1e-6 * max(limit.high for limit in limits.values())
        for name, push in pushes_of(statics, corner).items():
            assert -slack <= push <= limits[name].high + slack
    if not corners:
        return
    most = {pin: max(float(np.hypot(*statics.pins(corner)[pin])) for corner in corners) for pin in linkage.pins}
    random = np.random.default_rng(seed)
    contact = statics.contact
    for x in random.uniform(contact.rear, contact.front, 20).tolist():
        held = statics.largest_at(x, limits)
        roof = RoofForce(float(random.uniform()) * held, x)
        pushes = pushes_of(statics, roof)
        if any(not limits[name].low <= push <= limits[name].high for name, push in pushes.items()):
            continue  # the weight alone is too much
        for pin, force in statics.pins(roof).items():
            assert float(np.hypot(*force)) <= most[pin] * (1.0 + 1e-9)


# --- refusals ---


def test_what_statics_cannot_tell_is_refused() -> None:
    one = beam(4.0, 2.0, 100.0)
    with pytest.raises(InputError, match=r"strength\.canopy = 'roof': no such body; allowed: canopy"):
        RoofStatics(one, "roof")
    held = Linkage(bodies=one.bodies, pins=one.pins, points=one.points)
    with pytest.raises(InputError, match="2 conditions hold bodies that can move in 3 ways"):
        RoofStatics(held, "canopy")
    upright = Linkage(bodies=one.bodies, pins=one.pins)
    with pytest.raises(InputError, match="lie at one x"):
        RoofStatics(upright, "canopy")
    flat = LinearActuator(foot=GROUND, head="canopy", foot_point=(1.0, 0.0), head_point=(3.0, 0.0))
    dead = Linkage(bodies=one.bodies, pins=one.pins, points=one.points, actuators={"leg": flat})
    with pytest.raises(InputError, match="dead centre"):
        RoofStatics(dead, "canopy")
