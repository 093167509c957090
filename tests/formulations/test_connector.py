"""The engine's connector of a contact: where it acts, what it conserves, and that all its ways act alike."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.often import often
from user_forces import (
    Ambrosio,
    FrictionLaw,
    Frictionless,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    LuGre,
    SlipHistory,
    Slot,
    SlotContact,
)
from user_forces.connector.attachment import SHARE, Attachment, attachment, compiled_kernel, connector_kernel
from user_forces.contact import Contact

BEARING = JournalBearing(bore_radius=0.02, clearance=0.001)
LAW = LankaraniNikravesh(stiffness=1e9, restitution=0.9)
NEARLY = Ambrosio(sliding_coefficient=1e-12)  # no friction, but the connector of one
BRISTLES = LuGre(static_coefficient=0.3, sliding_coefficient=0.2)


def contact(friction: FrictionLaw = Frictionless()) -> JournalContact:  # noqa: B008
    return JournalContact(bearing=BEARING, normal=LAW, friction=friction)


SLOT = SlotContact(bearing=Slot(clearance=0.001, radius=0.02), normal=LAW, friction=BRISTLES)
HALF_TURN = 0.3  # [rad], of the connector's axes against the bore's


@pytest.mark.parametrize(
    ("of", "ends", "expected"),
    [
        (contact(), (True, False), Attachment.CENTRES),
        (contact(), (False, False), Attachment.CENTRES),
        (contact(NEARLY), (True, False), Attachment.JOURNAL),
        (contact(NEARLY), (False, True), Attachment.BORE),
        (contact(NEARLY), (False, False), Attachment.MIDDLE),
        (replace(SLOT, friction=Frictionless()), (False, False), Attachment.MIDDLE),
    ],
)
def test_the_force_acts_where_friction_and_ground_let_it(
    of: Contact, ends: tuple[bool, bool], expected: Attachment
) -> None:
    assert attachment(of, *ends) is expected


@pytest.mark.parametrize("at", [Attachment.JOURNAL, Attachment.BORE, Attachment.MIDDLE])
@pytest.mark.parametrize("of", [contact(BRISTLES), SLOT], ids=["bore", "slot"])
@settings(max_examples=often(40), deadline=None)
@given(
    along=st.floats(-0.3, 0.3),
    across=st.floats(-1.2e-3, 1.2e-3),
    motion=st.tuples(*6 * (st.floats(-1.0, 1.0),)),
    deflection=st.floats(-2e-6, 2e-6),
)
def test_force_and_moment_are_those_of_the_contact_about_any_point(
    at: Attachment, of: Contact, along: float, across: float, motion: tuple[float, ...], deflection: float
) -> None:
    if not of.bearing.is_slot:
        along = math.copysign(1.05e-3, along)
    vx, vy, spin, bore_spin, turned, step = motion
    # the connector's axes lie half-way between both frames in the middle, else they are those of the bore
    middle, turn = at is Attachment.MIDDLE, 2.0 * HALF_TURN * turned if at is Attachment.MIDDLE else 0.0
    bore_spin = {Attachment.JOURNAL: 0.0, Attachment.BORE: bore_spin, Attachment.MIDDLE: bore_spin}[at]
    spin = 0.0 if at is Attachment.BORE else spin
    history = deflection, 0.1, abs(step) * 1e-4
    x, y = along, across
    walls = (0.0, y, vx, vy - bore_spin * x) if of.bearing.is_slot else (x, y, vx, vy)
    want = of.force(*walls, bore_spin, spin, 0.2, SlipHistory(*history))
    c, s = (math.cos(0.5 * turn), math.sin(0.5 * turn)) if of.bearing.is_slot and middle else (1.0, 0.0)
    stretch = 0.5 * turn / math.sin(0.5 * turn) if abs(turn) > 1e-100 else 1.0

    def seen(a: float, b: float) -> tuple[float, float]:
        return c * a + s * b, -s * a + c * b

    place, rate = seen(stretch * x, stretch * y), seen(vx, vy)
    numbers = *place, 0.0, *rate, 0.0, turn, spin - bore_spin, bore_spin, True, 0.2, *history
    fx, fy, fz, moment, *found = connector_kernel(of.force_kernel, at, of.bearing.is_slot)(
        *numbers, of.constants
    )
    # rounding of the series of sin(a/2)/(a/2) of a large turn, in depths of 1e-4 m
    assert found[3:7] == pytest.approx(want[3:7], rel=1e-6, abs=1e-6 * (1.0 + want.normal_force))
    on_journal = np.array([-c * fx + s * fy, -s * fx - c * fy])
    scale = 1.0 + float(np.hypot(*on_journal))
    np.testing.assert_allclose(on_journal, [want.force_x, want.force_y], rtol=0.0, atol=1e-6 * scale)
    assert fz == 0.0
    # the contact's force carried to the journal's centre
    lever = -SHARE[at] * np.array([x, y])
    about_journal = lever[0] * on_journal[1] - lever[1] * on_journal[0] - moment
    assert about_journal == pytest.approx(want.journal_moment, abs=1e-6 * scale * (0.02 + abs(x)))
    machine = compiled_kernel(of.force_kernel, at, of.bearing.is_slot)
    assert machine(*numbers, np.array(of.constants))[:4] == pytest.approx((fx, fy, fz, moment), rel=1e-14)
