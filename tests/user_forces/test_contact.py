"""Geometry of journals, slots and faces, and the force of a contact: by hand, and what it conserves."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.cases.law_cases import BEARING, cylinder_law
from tests.cases.machine_cases import contact
from user_forces import (
    Ambrosio,
    ContactForce,
    Face,
    FaceContact,
    Frictionless,
    InputError,
    Johnson,
    JournalBearing,
    JournalContact,
    LuGre,
    SlipHistory,
    Slot,
    SlotContact,
)

CONTACT = contact()
CLEARANCE = CONTACT.bearing.clearance
BORE, JOURNAL = CONTACT.bearing.bore_radius, CONTACT.bearing.journal_radius
LAW = CONTACT.normal
RUBBING = Ambrosio(sliding_coefficient=0.25)
BRISTLES = replace(CONTACT, friction=LuGre(static_coefficient=0.3, sliding_coefficient=0.2))
IMPACT = 0.1

angles = st.floats(-math.pi, math.pi)
speeds = st.floats(-2.0, 2.0)
spins = st.floats(-50.0, 50.0)
depths = st.floats(1e-6, 5e-4)
pairs = st.tuples(speeds, speeds)
both_spins = st.tuples(spins, spins)


def pushed(
    depth: float = 1e-4,
    angle: float = 0.0,
    velocity: tuple[float, float] = (0.0, 0.0),
    spin: tuple[float, float] = (0.0, 0.0),
    impact: float | None = IMPACT,
    law: JournalContact = CONTACT,
    **history: SlipHistory,
) -> ContactForce:
    """A journal so deep in the bore's wall, in the direction of the angle; spins of bore and journal."""
    e = CLEARANCE + depth
    return law.force(e * math.cos(angle), e * math.sin(angle), *velocity, *spin, impact, **history)


# --- geometry by hand ---

PIN_IN_SLOT = Slot(clearance=0.01, radius=0.02)
CORNER = Slot(clearance=0.01)
FACE = Face(clearance=0.5)
# geometry, motion (x, y, vx, vy, spins of bore and journal), then depth, rate, slip, n and the journal's arm
GEOMETRY: list[tuple[Any, tuple[float, ...], tuple[float, ...]]] = [
    # a journal of 64 mm in a bore of 65.5 mm; 0.2 mm deep on the right, up, and concentric
    (BEARING, (1.7e-3, 0, 0.3, 0.4, 0, 0), (2e-4, 0.3, 0.4, 1, 0, 0.0639)),
    (BEARING, (0, 1.7e-3, 0.3, 0.4, 0, 0), (2e-4, 0.4, -0.3, 0, 1, 0.0639)),
    # the contact point lies half a depth inside the journal and outside the bore
    (BEARING, (1.7e-3, 0, 0, 0, 0, 3.0), (2e-4, 0, 3.0 * 0.0639, 1, 0, 0.0639)),
    (BEARING, (1.7e-3, 0, 0, 0, 3.0, 0), (2e-4, 0, -3.0 * 0.0656, 1, 0, 0.0639)),
    (BEARING, (0, 0, 0.3, 0.4, 0, 0), (-1.5e-3, 0.5, 0, 0, 0, 0.06475)),
    # a pin of 20 mm in a slot of 60 mm, at the upper and at the lower wall, whose walls turn with the slot
    (PIN_IN_SLOT, (5.0, 0.011, 0.2, 0.1, 0, 0), (1e-3, 0.1, -0.2, 0, 1, 0.02)),
    (PIN_IN_SLOT, (5.0, -0.011, 0.2, 0.1, 0, 0), (1e-3, -0.1, 0.2, 0, -1, 0.02)),
    (PIN_IN_SLOT, (5.0, 0.011, 0, 0, 2.0, 4.0), (1e-3, 0, 4.0 * 0.02 - 2.0 * 0.031, 0, 1, 0.02)),
    (CORNER, (0, 0.004, 0.2, 0.1, 0, 9.0), (-6e-3, 0.1, -0.2, 0, 1, 0)),
    # a face of which one side alone is met
    (FACE, (0, 0.501, 0.2, 0.1, 2.0, 9.0), (1e-3, 0.1, -0.2 - 2.0 * 0.501, 0, 1, 0)),
    (FACE, (0, -3.0, 0.2, 0.1, 0, 0), (-3.5, 0.1, -0.2, 0, 1, 0)),
]


@pytest.mark.parametrize(("bearing", "motion", "expected"), GEOMETRY)
def test_kinematics_by_hand(bearing: Any, motion: tuple[float, ...], expected: tuple[float, ...]) -> None:
    found = bearing.kinematics(*motion, *bearing.constants)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-16)  # rounding
    depth = found[0]
    bore_arm, journal_arm = bearing.contact_arms(depth)
    assert journal_arm == pytest.approx(found[5], abs=1e-16)
    # one point serves both bodies
    away = math.hypot(*motion[:2]) if bearing is BEARING else abs(motion[1])
    if depth > 0.0:
        assert bore_arm - journal_arm == pytest.approx(away, rel=1e-14)


@pytest.mark.parametrize("bearing", [BEARING, PIN_IN_SLOT, CORNER, FACE])
@given(depth=st.floats(-1e-3, 1e-3), rate=speeds, slip=speeds)
def test_a_motion_that_is_placed_has_its_depth_rate_and_slip(
    bearing: Any, depth: float, rate: float, slip: float
) -> None:
    found = bearing.kinematics(*bearing.placed(depth, rate, slip), *bearing.constants)
    assert found[:3] == pytest.approx((depth, rate, slip), rel=1e-12, abs=1e-16)


@pytest.mark.parametrize(
    ("kind", "fields", "said"),
    [
        (JournalBearing, {"bore_radius": 0.07, "clearance": 0.07}, r"clearance = 0\.07 m.*allowed: > 0 and"),
        (JournalBearing, {"bore_radius": 0.07, "clearance": 0.0}, r"clearance = 0\.0: .*allowed: > 0"),
        (JournalBearing, {"bore_radius": -0.07, "clearance": 0.1}, r"bore_radius = -0\.07: .*allowed: > 0"),
        (Slot, {"clearance": 0.0}, r"clearance = 0\.0: .*allowed: > 0"),
        (Slot, {"clearance": 0.1, "radius": -0.1}, r"radius = -0\.1: .*allowed: >= 0"),
        (JournalContact, {"bearing": BEARING, "normal": Frictionless()}, r"Frictionless\(\): .*NormalLaw"),
        (JournalContact, {"bearing": BEARING, "normal": LAW, "friction": LAW}, r"friction = Lank.*FrictionLaw"),
        (
            JournalContact,
            {"bearing": replace(BEARING, clearance=1e-3), "normal": cylinder_law(Johnson)},
            r"normal.bearing = \(0.0655, 0.0015\) m .*; allowed: \(0.0655, 0.001\) m",
        ),
        (SlotContact, {"bearing": CORNER, "normal": cylinder_law(Johnson)}, "Johnson: is of a pin in its bore"),
        (FaceContact, {"bearing": FACE, "normal": cylinder_law(Johnson)}, "Johnson: is of a pin in its bore"),
        (FaceContact, {"bearing": FACE, "normal": LAW, "friction": RUBBING}, "Ambrosio.*Frictionless"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused(kind: type[Any], fields: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        kind(**fields)


# --- the force ---


@pytest.mark.parametrize(
    "place", [{"depth": -CLEARANCE}, {"depth": -1e-6}, {"impact": None}, {"velocity": (-0.8, 0.3)}]
)
@pytest.mark.parametrize("law", [CONTACT, BRISTLES], ids=["Ambrosio", "LuGre"])
def test_nothing_acts_apart_before_an_impact_or_under_tension(law: JournalContact, place: Any) -> None:
    got = pushed(**{"velocity": (0.3, 0.2), "spin": (0.0, 5.0), "law": law} | place)
    assert (got.force_x, got.force_y, got.normal_force, got.friction_force) == (0.0, 0.0, 0.0, 0.0)
    # chi = 0.1425 at restitution 0.9: tension below rate = -7.02 v0
    assert got.clamped == ("velocity" in place)
    assert not pushed(velocity=(-0.5, 0.3)).clamped


@given(depth=depths, angle=angles, along=speeds, across=speeds, spin=both_spins)
def test_force_is_that_of_the_laws_for_depth_rate_and_slip(
    depth: float, angle: float, along: float, across: float, spin: tuple[float, float]
) -> None:
    c, s = math.cos(angle), math.sin(angle)
    got = pushed(depth, angle, (along * c - across * s, along * s + across * c), spin)
    # rounding: of lengths of 2 mm, of products of 2 m/s, of speeds of 50 rad/s times 65 mm
    assert got.depth == pytest.approx(depth, abs=1e-17)
    assert got.rate == pytest.approx(along, abs=1e-14)
    slip = across + spin[1] * got.journal_arm - spin[0] * (BORE + 0.5 * got.depth)
    assert got.slip == pytest.approx(slip, abs=2e-14)
    assert got.normal_force == max(0.0, LAW(got.depth, got.rate, IMPACT))
    assert got.friction_force == CONTACT.friction(got.slip, got.normal_force)
    n, f = got.normal_force, got.friction_force
    assert (got.force_x, got.force_y) == pytest.approx((-n * c - f * s, -n * s + f * c), abs=1e-11 * (1.0 + n))
    apart = pushed(depth, angle, (along * c - across * s, along * s + across * c), spin, None)
    assert (apart[:3], apart.journal_arm) == (got[:3], got.journal_arm)


@given(angle=angles, depth=depths, velocity=pairs, spin=both_spins, common=spins)
def test_the_pair_of_forces_conserves_momentum_and_takes_energy(
    angle: float, depth: float, velocity: tuple[float, float], spin: tuple[float, float], common: float
) -> None:
    got = pushed(depth, angle, velocity, spin)
    bore_arm, _ = CONTACT.bearing.contact_arms(got.depth)
    e, n = CLEARANCE + depth, (math.cos(angle), math.sin(angle))
    # about the bore's centre: the force carried to the journal's centre with its moment, and the
    # reaction at the bore's own arm; rounding of the force times the bore's radius
    scale = math.hypot(got.force_x, got.force_y)
    turn = n[0] * got.force_y - n[1] * got.force_x
    assert got.journal_moment + e * turn - bore_arm * turn == pytest.approx(0.0, abs=1e-14 * scale * BORE)
    power = got.force_x * velocity[0] + got.force_y * velocity[1] + got.journal_moment * spin[1]
    power -= bore_arm * got.friction_force * spin[0]
    expected = -got.normal_force * got.rate + got.friction_force * got.slip
    assert power == pytest.approx(expected, abs=9e-14 * scale)
    assert got.friction_force * got.slip <= 0.0
    # whatever turns with both bodies sees the same
    turned = (velocity[0] - common * e * n[1], velocity[1] + common * e * n[0])
    seen = pushed(depth, angle, turned, (spin[0] + common, spin[1] + common))
    assert (seen.rate, seen.slip) == pytest.approx((got.rate, got.slip), abs=1e-13)
    mirrored = pushed(depth, -angle, (velocity[0], -velocity[1]), (-spin[0], -spin[1]))
    assert (mirrored.force_x, mirrored.force_y, mirrored.slip) == (got.force_x, -got.force_y, -got.slip)


@pytest.mark.parametrize("radius", [0.0, 0.02])
@given(y=st.floats(1.0001e-2, 1.05e-2), side=st.sampled_from([-1.0, 1.0]), velocity=pairs, spin=both_spins)
def test_a_slot_pushes_across_and_rubs_along_and_takes_energy(
    radius: float, y: float, side: float, velocity: tuple[float, float], spin: tuple[float, float]
) -> None:
    slot = SlotContact(bearing=Slot(clearance=0.01, radius=radius), normal=LAW, friction=RUBBING)
    got = slot.force(0.0, side * y, *velocity, *spin, IMPACT)
    assert got.normal_force == max(0.0, LAW(got.depth, got.rate, IMPACT))
    assert got.force_y == pytest.approx(-side * got.normal_force)
    assert got.force_x == pytest.approx(-side * got.friction_force)
    # power of the pair, the walls' point being at the corner or the pin's surface
    bore_arm, journal_arm = slot.bearing.contact_arms(got.depth)
    power = got.force_x * velocity[0] + got.force_y * velocity[1]
    power += got.friction_force * (journal_arm * spin[1] - bore_arm * spin[0])
    expected = -got.normal_force * got.rate + got.friction_force * got.slip
    assert power == pytest.approx(expected, abs=1e-12 * (1.0 + got.normal_force))
    assert got.friction_force * got.slip <= 0.0


def test_a_face_pushes_from_one_side_and_does_not_rub() -> None:
    face = FaceContact(bearing=FACE, normal=LAW)
    got = face.force(0.0, 0.5 + 1e-4, 3.0, 0.0, 0.0, 0.0, IMPACT)
    assert (got.force_x, got.force_y) == (0.0, -LAW.elastic_force(got.depth))
    assert face.force(0.0, -7.0, 3.0, 0.0, 0.0, 0.0, IMPACT).force_y == 0.0


# --- friction with a state, and another clearance ---

histories = st.builds(
    SlipHistory, deflection=st.floats(-3e-6, 3e-6), slip=st.floats(-0.1, 0.1), step=st.floats(0.0, 1e-4)
)


@given(velocity=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.1, 0.1)), history=histories)
def test_state_of_friction_is_carried_over_the_step_with_the_mean_slip(
    velocity: tuple[float, float], history: SlipHistory
) -> None:
    got = pushed(velocity=velocity, law=BRISTLES, history=history)
    mean = 0.5 * (history.slip + got.slip)
    bent = BRISTLES.friction.next_deflection(history.deflection, mean, history.step)
    assert got.deflection == bent
    assert got.friction_force == BRISTLES.friction(got.slip, got.normal_force, got.deflection)
    # a step without history begins with straight bristles, and other laws have none
    assert pushed(velocity=velocity, law=BRISTLES).deflection == 0.0
    assert pushed(velocity=velocity, history=history).deflection == 0.0


def test_bristles_hold_a_journal_that_does_not_slip_and_are_straight_elsewhere() -> None:
    history = SlipHistory(1e-6, 0.0, 1e-4)
    got = pushed(law=BRISTLES, history=history)
    # sigma_0 z of the normal force, 1e5/m times 1 micrometre; rounding
    assert got.friction_force == pytest.approx(-0.1 * got.normal_force, rel=1e-14)
    assert pushed(depth=-1e-6, law=BRISTLES, history=history).deflection == 0.0
    assert pushed(impact=None, law=BRISTLES, history=history).deflection == 0.0
