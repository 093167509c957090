"""Momenta and energy of users' own models with clearance joints, in the plane and in space."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tests.user_forces.own_models import (
    OUTPUT,
    follow_energy,
    kinetic,
    model,
    output,
    rigid,
    settings,
)
from user_forces import Ambrosio, ClearanceGuide, ClearanceJoint, LankaraniNikravesh


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
