"""Momenta and energy of users' own models with clearance joints, in the plane and in space."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from tests.user_forces.own_models import (
    GRAVITY,
    ORIGIN,
    OUTPUT,
    follow_energy,
    kinetic,
    model,
    output,
    rigid,
    settings,
)
from user_forces import Ambrosio, ClearanceGuide, ClearanceJoint, Hertz, LankaraniNikravesh


@pytest.mark.parametrize("is_slot", [False, True], ids=["bore", "slot"])
@pytest.mark.parametrize("planar", [True, False])
@pytest.mark.parametrize("friction", [None, Ambrosio(sliding_coefficient=0.2)], ids=["smooth", "friction"])
def test_two_free_bodies_keep_their_momenta_and_energy(planar: bool, friction: Any, is_slot: bool) -> None:
    mbs, _ = model()
    bore = rigid(
        mbs, 3.0, 0.02, [0, 0, 0], planar, initialVelocity=[0.3, 0, 0], initialAngularVelocity=[0, 0, 20]
    )
    journal = rigid(mbs, 1.0, 0.004, [0.1, 0, 0], planar, initialAngularVelocity=[0, 0, -35.0])
    law = LankaraniNikravesh(stiffness=1e9, restitution=0.8)
    given = {"clearance": 1e-3, "normal": law, "friction": friction, "impact_steps": 256}
    joint: ClearanceJoint | ClearanceGuide
    if is_slot:  # the pin is 30 mm along the slot
        ends = {"slot": (bore, [0.03, 0, 0]), "pin": (journal, [-0.04, 0, 0]), "direction": [1, 0, 0]}
        joint = ClearanceGuide(mbs, **ends, pin_radius=0.02, **given)  # type: ignore[arg-type]
    else:
        sides = {"bore": (bore, [0.06, 0, 0]), "journal": (journal, [-0.04, 0, 0])}
        joint = ClearanceJoint(mbs, **sides, bore_radius=0.02, **given)  # type: ignore[arg-type]
    mbs.Assemble()
    bodies = (bore, 3.0, 0.02), (journal, 1.0, 0.004)

    def momenta() -> list[float]:
        total = np.zeros(3)
        for body, mass, inertia in bodies:
            (x, y, _), (vx, vy, _) = output(mbs, body, OUTPUT.Position), output(mbs, body, OUTPUT.Velocity)
            spin = float(output(mbs, body, OUTPUT.AngularVelocity)[2])
            total += [mass * vx, mass * vy, mass * (x * vy - y * vx) + inertia * spin]
        return total.tolist()

    start = kinetic(mbs, bodies)
    balance, lost = follow_energy(mbs, [joint], lambda mbs: kinetic(mbs, bodies))
    mbs.SolveDynamic(settings(0.02, 1e-4))
    assert len(joint.impacts) > 1
    assert momenta() == pytest.approx([0.9, 0.0, 0.02 * 20 - 0.004 * 35], abs=1e-8)
    assert lost[-1] > 0.015
    assert np.ptp([start, *balance]) < 2e-3 * lost[-1]


def four_bar(planar: bool, tilt: float = 0.0) -> tuple[Any, ClearanceJoint, list[tuple[Any, float, float]]]:
    """A crank-rocker without gravity with a clearance at the rocker's foot, Hertz's law.

    tilt: of the rocker's axis about the line of the frame [rad]; if any, the coupler has balls at both ends.
    """
    mbs, ground = model()
    c, s = math.cos(tilt), math.sin(tilt)
    foot, top = np.array([0.3, 0.0, 0.0]), np.array([0.3, 0.2 * c, 0.2 * s])
    tip, axis = np.array([0.0, 0.1, 0.0]), [0.0, -s, c]
    places = 0.5 * tip, 0.5 * (tip + top), 0.5 * (foot + top)
    spin = 40.0
    crank = rigid(mbs, 1.0, 1e-3, places[0], planar, initialVelocity=[-0.05 * spin, 0, 0],
                  initialAngularVelocity=[0, 0, spin])  # fmt: skip
    # the rocker's rate keeps the coupler's length, and the coupler turns across itself
    along, arm = top - tip, top - foot
    across = np.cross(axis, arm)
    rate = float(np.dot([-0.1 * spin, 0, 0], along) / (across @ along))
    difference = rate * across - [-0.1 * spin, 0, 0]
    turning = np.cross(along, difference) / (along @ along)
    middle = np.array([-0.1 * spin, 0, 0]) + np.cross(turning, 0.5 * along)
    coupler = rigid(mbs, 0.8, 4e-3, places[1], planar, initialVelocity=middle, initialAngularVelocity=turning)
    rocker = rigid(mbs, 1.2, 5e-3, places[2], planar, initialVelocity=0.5 * rate * across,
                   initialAngularVelocity=rate * np.array(axis))  # fmt: skip
    flat = planar or tilt == 0.0
    level = [1, 1, 0, 0, 0, 0] if planar else [1, 1, 1, 1, 1, 0]
    mbs.CreateGenericJoint(itemNumbers=[ground, crank], position=ORIGIN, constrainedAxes=level)
    ends = (crank, coupler, tip), (coupler, rocker, top)
    for (one, other, place), kind in zip(ends, (level if flat else [1, 1, 1, 0, 0, 0],) * 2, strict=True):
        mbs.CreateGenericJoint(itemNumbers=[one, other], position=place, constrainedAxes=kind)
    if not flat:  # the rocker stays square to its axis, and in its place along it
        turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
        mbs.CreateGenericJoint(
            itemNumbers=[ground, rocker],
            position=foot,
            rotationMatrixAxes=turn,
            constrainedAxes=[0, 0, 1, 1, 1, 0],
        )
    joint = ClearanceJoint(
        mbs, bore=(ground, foot), journal=(rocker, foot - places[2]), bore_radius=0.02, clearance=1e-3,
        normal=Hertz(stiffness=1e9), axis=axis, impact_steps=256,
    )  # fmt: skip
    mbs.Assemble()
    return mbs, joint, [(crank, 1.0, 1e-3), (coupler, 0.8, 4e-3), (rocker, 1.2, 5e-3)]


@pytest.mark.parametrize("tilt", [0.0, 0.6])
def test_a_four_bar_in_space_keeps_its_energy(tilt: float) -> None:
    mbs, joint, bodies = four_bar(False, tilt)
    start = kinetic(mbs, bodies)
    balance, lost = follow_energy(mbs, [joint], lambda mbs: kinetic(mbs, bodies))
    mbs.SolveDynamic(settings(0.03, 1e-4))
    assert len(joint.impacts) > 1
    assert lost[-1] == pytest.approx(0.0, abs=1e-9)
    assert np.ptp([start, *balance]) < 1e-4 * start


def test_a_four_bar_in_space_moves_as_one_in_the_plane() -> None:
    runs = []
    for planar in (True, False):
        mbs, joint, _ = four_bar(planar)
        mbs.SolveDynamic(settings(0.02, 1e-4))
        runs.append(joint)
    flat, spatial = ([(onset.time, onset.speed) for onset in joint.impacts] for joint in runs)
    assert len(flat) > 2
    assert np.array(spatial) == pytest.approx(np.array(flat), rel=1e-5)
    assert runs[1].largest_force == pytest.approx(runs[0].largest_force, rel=1e-5)


def test_two_clearance_joints_in_a_chain_keep_the_energy() -> None:
    mbs, ground = model()
    upper = rigid(mbs, 1.0, 0.01, [0.1, 0, 0], gravity=[0, -GRAVITY, 0])
    lower = rigid(mbs, 2.0, 0.02, [0.3, 0, 0], gravity=[0, -GRAVITY, 0], initialVelocity=[0, 0.2, 0])
    law, size = Hertz(stiffness=1e8), {"bore_radius": 0.02, "impact_steps": 256}
    joints = [
        ClearanceJoint(
            mbs, bore=(ground, ORIGIN), journal=(upper, [-0.1, 0, 0]), clearance=1e-3, normal=law, **size
        ),
        ClearanceJoint(
            mbs, bore=(upper, [0.1, 0, 0]), journal=(lower, [-0.1, 0, 0]), clearance=5e-4, normal=law, **size
        ),
    ]
    mbs.Assemble()
    bodies = (upper, 1.0, 0.01), (lower, 2.0, 0.02)

    def energy(mbs: Any) -> float:
        heights = [mass * GRAVITY * output(mbs, body, OUTPUT.Position)[1] for body, mass, _ in bodies]
        return kinetic(mbs, bodies) + float(sum(heights))

    balance, _ = follow_energy(mbs, joints, energy)
    mbs.SolveDynamic(settings(0.05, 1e-4))
    assert min(len(joint.impacts) for joint in joints) > 1
    assert np.abs(np.array(balance) - 0.5 * 2.0 * 0.2**2).max() < 1e-3 * kinetic(mbs, bodies)
