from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.cases.machine_cases import contact
from user_forces import (
    ContactForce,
    Frictionless,
    InputError,
    JournalContact,
    LankaraniNikravesh,
    LuGre,
    SlipHistory,
)

CONTACT = contact()
CLEARANCE = CONTACT.bearing.clearance
BORE, JOURNAL = CONTACT.bearing.bore_radius, CONTACT.bearing.journal_radius
IMPACT = 0.1

angles = st.floats(-math.pi, math.pi)
speeds = st.floats(-2.0, 2.0)
spins = st.floats(-50.0, 50.0)
depths = st.floats(1e-6, 5e-4)
approaches = st.floats(0.01, 1.0)


def pushed(
    depth: float = 1e-4,
    angle: float = 0.0,
    velocity: tuple[float, float] = (0.0, 0.0),
    bore_spin: float = 0.0,
    journal_spin: float = 0.0,
    impact: float | None = IMPACT,
    law: JournalContact = CONTACT,
    history: SlipHistory | None = None,
) -> ContactForce:
    """A journal so deep in the bore's wall, in the direction of the angle."""
    e = CLEARANCE + depth
    x, y = e * math.cos(angle), e * math.sin(angle)
    past = () if history is None else (history,)
    return law.force(x, y, *velocity, bore_spin, journal_spin, impact, *past)


# --- geometry and normal force ---


def test_force_is_zero_when_concentric() -> None:
    got = CONTACT.force(0.0, 0.0, 0.3, -0.2, 5.0, 7.0, IMPACT)
    assert (got.force_x, got.force_y, got.normal_force, got.friction_force) == (0.0, 0.0, 0.0, 0.0)
    assert got.depth == -CLEARANCE


def test_force_is_zero_in_the_gap() -> None:
    got = pushed(depth=-1e-6, velocity=(0.3, 0.2), journal_spin=5.0)
    assert (got.force_x, got.force_y, got.normal_force, got.friction_force) == (0.0, 0.0, 0.0, 0.0)


def test_force_is_zero_until_contact_has_begun() -> None:
    got = pushed(depth=1e-4, velocity=(0.3, 0.2), journal_spin=5.0, impact=None)
    assert (got.force_x, got.force_y, got.normal_force, got.friction_force) == (0.0, 0.0, 0.0, 0.0)
    assert not got.clamped


@pytest.mark.parametrize(("angle", "expected"), [(0.0, (-1, 0)), (math.pi / 2, (0, -1)), (math.pi, (1, 0))])
def test_force_pushes_the_journal_back_to_the_middle(angle: float, expected: tuple[int, int]) -> None:
    got = pushed(angle=angle)
    force = CONTACT.normal.elastic_force(got.depth)
    # cos(pi/2) is 6e-17
    assert (got.force_x / force, got.force_y / force) == pytest.approx(expected, abs=1e-15)


@given(depth=depths, angle=angles)
def test_force_at_rest_is_the_elastic_force(depth: float, angle: float) -> None:
    got = pushed(depth=depth, angle=angle)
    # the depth is a difference of lengths of 2 mm: 1e-18/1e-6 relative, times the exponent
    assert got.normal_force == pytest.approx(CONTACT.normal.elastic_force(depth), rel=1e-11)


@given(angle=angles, along=speeds, across=speeds)
def test_rate_is_the_speed_towards_the_wall(angle: float, along: float, across: float) -> None:
    c, s = math.cos(angle), math.sin(angle)
    got = pushed(angle=angle, velocity=(along * c - across * s, along * s + across * c))
    # rounding of a sum of products of 2 m/s
    assert got.rate == pytest.approx(along, abs=1e-14)


@given(angle=angles, velocity=st.tuples(speeds, speeds))
def test_rate_is_the_change_of_depth(angle: float, velocity: tuple[float, float]) -> None:
    dt = 1e-8
    e = CLEARANCE + 1e-4
    x, y = e * math.cos(angle), e * math.sin(angle)
    vx, vy = velocity
    before = CONTACT.force(x - dt * vx, y - dt * vy, vx, vy, 0.0, 0.0, None).depth
    after = CONTACT.force(x + dt * vx, y + dt * vy, vx, vy, 0.0, 0.0, None).depth
    # central difference: rounding of 1e-18 m over 2e-8 s
    assert pushed(angle=angle, velocity=velocity).rate == pytest.approx((after - before) / (2 * dt), abs=1e-9)


@given(
    x=st.floats(-2e-3, 2e-3),
    y=st.floats(-2e-3, 2e-3),
    velocity=st.tuples(speeds, speeds),
    spins=st.tuples(spins, spins),
)
def test_depth_rate_and_slip_are_the_same_whether_contact_has_begun_or_not(
    x: float, y: float, velocity: tuple[float, float], spins: tuple[float, float]
) -> None:
    apart = CONTACT.force(x, y, *velocity, *spins, None)
    begun = CONTACT.force(x, y, *velocity, *spins, IMPACT)
    assert apart[:3] == begun[:3]
    assert apart.journal_arm == begun.journal_arm


def test_closing_pushes_harder_than_opening() -> None:
    closing, opening = pushed(velocity=(0.05, 0.0)), pushed(velocity=(-0.05, 0.0))
    assert closing.normal_force > pushed().normal_force > opening.normal_force > 0.0


def test_tension_is_cut_to_zero_and_reported() -> None:
    # chi = 0.1425 at restitution 0.9: tension below rate = -7.02 v0
    got = pushed(velocity=(-0.8, 0.3))
    assert got.clamped
    assert (got.force_x, got.force_y, got.normal_force, got.friction_force) == (0.0, 0.0, 0.0, 0.0)


def test_pressure_is_not_reported_as_clamped() -> None:
    assert not pushed(velocity=(-0.5, 0.3)).clamped


# --- slip and friction ---


def test_rolling_journal_rubs_against_its_own_spin() -> None:
    # at the wall on the right a journal spinning counter-clockwise moves up on the bore
    got = pushed(journal_spin=3.0)
    assert got.slip > 0.0
    assert got.force_y < 0.0


def test_spin_of_the_journal_enters_the_slip_with_its_arm() -> None:
    got = pushed(depth=2e-4, journal_spin=3.0)
    # the contact point is half a depth inside the journal; rounding
    assert got.slip == pytest.approx(3.0 * (JOURNAL - 1e-4), rel=1e-12)


def test_spin_of_the_bore_enters_the_slip_with_its_arm_reversed() -> None:
    got = pushed(depth=2e-4, bore_spin=3.0)
    # the contact point is half a depth outside the bore; rounding
    assert got.slip == pytest.approx(-3.0 * (BORE + 1e-4), rel=1e-12)


def test_speed_along_the_wall_enters_the_slip() -> None:
    # on the wall at the top, counter-clockwise is to the left
    got = pushed(angle=math.pi / 2, velocity=(-0.4, 0.0))
    # cos(pi/2) is 6e-17
    assert got.slip == pytest.approx(0.4, rel=1e-14)


@given(angle=angles, spin=spins, depth=depths)
def test_turning_as_one_body_is_neither_slip_nor_approach(angle: float, spin: float, depth: float) -> None:
    e = CLEARANCE + depth
    velocity = (-spin * e * math.sin(angle), spin * e * math.cos(angle))
    got = pushed(depth, angle, velocity, bore_spin=spin, journal_spin=spin)
    # rounding of speeds of 50 rad/s times 65 mm
    assert got.slip == pytest.approx(0.0, abs=1e-14)
    assert got.rate == pytest.approx(0.0, abs=1e-14)
    assert got.friction_force == 0.0


@given(angle=angles, velocity=st.tuples(speeds, speeds), bore_spin=spins, journal_spin=spins, common=spins)
def test_a_common_rotation_does_not_change_slip_and_rate(
    angle: float, velocity: tuple[float, float], bore_spin: float, journal_spin: float, common: float
) -> None:
    e = CLEARANCE + 1e-4
    turned = (velocity[0] - common * e * math.sin(angle), velocity[1] + common * e * math.cos(angle))
    one = pushed(angle=angle, velocity=velocity, bore_spin=bore_spin, journal_spin=journal_spin)
    two = pushed(angle=angle, velocity=turned, bore_spin=bore_spin + common, journal_spin=journal_spin + common)
    # rounding of speeds of 100 rad/s times 65 mm
    assert two.slip == pytest.approx(one.slip, abs=1e-13)
    assert two.rate == pytest.approx(one.rate, abs=1e-13)


@given(angle=angles, bore_spin=spins, journal_spin=spins, velocity=st.tuples(speeds, speeds), depth=depths)
def test_slip_is_the_difference_of_the_velocities_of_both_bodies_at_the_contact(
    angle: float, bore_spin: float, journal_spin: float, velocity: tuple[float, float], depth: float
) -> None:
    got = pushed(depth, angle, velocity, bore_spin, journal_spin)
    e, n = CLEARANCE + depth, (math.cos(angle), math.sin(angle))
    arm = got.journal_arm
    on_journal = (velocity[0] - journal_spin * arm * n[1], velocity[1] + journal_spin * arm * n[0])
    on_bore = (-bore_spin * (e + arm) * n[1], bore_spin * (e + arm) * n[0])
    along_wall = (on_journal[0] - on_bore[0]) * -n[1] + (on_journal[1] - on_bore[1]) * n[0]
    # rounding of speeds of 50 rad/s times 65 mm
    assert got.slip == pytest.approx(along_wall, abs=1e-14)


# --- both bodies together ---


@given(angle=angles, depth=depths, velocity=st.tuples(speeds, speeds), bore_spin=spins, journal_spin=spins)
def test_force_and_reaction_act_at_one_point(
    angle: float, depth: float, velocity: tuple[float, float], bore_spin: float, journal_spin: float
) -> None:
    got = pushed(depth, angle, velocity, bore_spin, journal_spin)
    bore_arm, _ = CONTACT.bearing.contact_arms(got.depth)
    e, n = CLEARANCE + depth, (math.cos(angle), math.sin(angle))
    # about the bore's centre: the force carried to the journal's centre with its moment, and the
    # reaction at the bore's own arm
    action = got.journal_moment + e * (n[0] * got.force_y - n[1] * got.force_x)
    reaction = -bore_arm * (n[0] * got.force_y - n[1] * got.force_x)
    # rounding of the force times the bore's radius
    scale = math.hypot(got.force_x, got.force_y) * BORE
    assert action + reaction == pytest.approx(0.0, abs=1e-14 * scale)


def test_moment_on_the_journal_brakes_its_spin() -> None:
    assert pushed(journal_spin=3.0).journal_moment < 0.0


@given(angle=angles, depth=depths, velocity=st.tuples(speeds, speeds), bore_spin=spins, journal_spin=spins)
def test_power_of_the_pair_is_that_of_normal_and_friction_force(
    angle: float, depth: float, velocity: tuple[float, float], bore_spin: float, journal_spin: float
) -> None:
    got = pushed(depth, angle, velocity, bore_spin, journal_spin)
    bore_arm, _ = CONTACT.bearing.contact_arms(got.depth)
    power = (
        got.force_x * velocity[0]
        + got.force_y * velocity[1]
        + got.journal_moment * journal_spin
        - bore_arm * got.friction_force * bore_spin
    )
    expected = -got.normal_force * got.rate + got.friction_force * got.slip
    # rounding of the largest of these products: force times (2 m/s + 50 rad/s times 66 mm, twice)
    scale = math.hypot(got.force_x, got.force_y) * 9.0
    assert power == pytest.approx(expected, abs=1e-14 * scale)


@given(angle=angles, depth=depths, velocity=st.tuples(speeds, speeds), spins=st.tuples(spins, spins))
def test_friction_of_the_pair_never_gives_energy(
    angle: float, depth: float, velocity: tuple[float, float], spins: tuple[float, float]
) -> None:
    got = pushed(depth, angle, velocity, *spins)
    assert got.friction_force * got.slip <= 0.0


@given(
    angle=angles,
    turn=angles,
    velocity=st.tuples(speeds, speeds),
    spins=st.tuples(spins, spins),
    impact_velocity=approaches,
)
def test_force_turns_with_the_axes(
    angle: float, turn: float, velocity: tuple[float, float], spins: tuple[float, float], impact_velocity: float
) -> None:
    c, s = math.cos(turn), math.sin(turn)

    def turned(x: float, y: float) -> tuple[float, float]:
        return c * x - s * y, s * x + c * y

    impact = impact_velocity
    one = pushed(1e-4, angle, velocity, *spins, impact)
    two = pushed(1e-4, angle + turn, turned(*velocity), *spins, impact)
    # rounding of depth and slip: 1e-18 m of 1e-4 m, and 1e-15 m/s on a ramp of 1e-2 m/s
    scale = (
        1.0
        + math.hypot(one.force_x, one.force_y)
        + abs(one.rate / impact_velocity) * CONTACT.normal.elastic_force(1e-4)
    )
    assert (two.force_x, two.force_y) == pytest.approx(turned(one.force_x, one.force_y), abs=1e-11 * scale)


@given(angle=angles, velocity=st.tuples(speeds, speeds), spins=st.tuples(spins, spins))
def test_mirror_image_has_the_mirrored_force(
    angle: float, velocity: tuple[float, float], spins: tuple[float, float]
) -> None:
    one = pushed(1e-4, angle, velocity, *spins)
    two = pushed(1e-4, -angle, (velocity[0], -velocity[1]), -spins[0], -spins[1])
    assert (two.force_x, two.force_y, two.slip) == (one.force_x, -one.force_y, -one.slip)


def test_friction_is_the_sliding_coefficient_times_the_normal_force() -> None:
    got = pushed(velocity=(0.0, 1.0))  # far above the ramp
    assert got.friction_force == -0.25 * got.normal_force


def test_friction_is_that_of_the_law_for_slip_and_normal_force() -> None:
    got = pushed(velocity=(0.02, 0.004), journal_spin=0.01)  # on the ramp
    assert got.friction_force == CONTACT.friction(got.slip, got.normal_force)
    assert 0.0 < -got.friction_force < 0.25 * got.normal_force


def test_there_is_no_friction_by_default() -> None:
    plain = JournalContact(bearing=CONTACT.bearing, normal=CONTACT.normal)
    assert plain.friction == Frictionless()
    assert pushed(velocity=(0.0, 1.0), law=plain).force_y == 0.0


def test_approach_speed_is_handed_to_the_law() -> None:
    soft, hard = (pushed(velocity=(0.05, 0.0), impact=v) for v in (0.1, 0.2))
    elastic = CONTACT.normal.elastic_force(soft.depth)
    # textbook damping is inverse to it; rounding of the difference
    assert soft.normal_force - elastic == pytest.approx(2.0 * (hard.normal_force - elastic), rel=1e-11)


# --- friction with a state ---

BRISTLES = replace(CONTACT, friction=LuGre(static_coefficient=0.3, sliding_coefficient=0.2))
histories = st.builds(
    SlipHistory, deflection=st.floats(-3e-6, 3e-6), slip=st.floats(-0.1, 0.1), step=st.floats(0.0, 1e-4)
)


@given(velocity=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.1, 0.1)), history=histories)
def test_state_of_friction_is_carried_over_the_step_with_the_mean_slip(
    velocity: tuple[float, float], history: SlipHistory
) -> None:
    got = pushed(velocity=velocity, law=BRISTLES, history=history)
    mean = 0.5 * (history.slip + got.slip)
    assert got.deflection == BRISTLES.friction.next_deflection(history.deflection, mean, history.step)
    assert got.friction_force == BRISTLES.friction(got.slip, got.normal_force, got.deflection)


def test_a_bristle_holds_a_journal_that_does_not_slip() -> None:
    got = pushed(law=BRISTLES, history=SlipHistory(1e-6, 0.0, 1e-4))
    # sigma_0 z of the normal force, 1e5/m times 1 micrometre; rounding
    assert got.friction_force == pytest.approx(-0.1 * got.normal_force, rel=1e-14)
    assert got.deflection == 1e-6


def test_a_step_without_history_begins_with_straight_bristles() -> None:
    got = pushed(velocity=(0.0, 0.01), law=BRISTLES)
    assert got.deflection == 0.0


@pytest.mark.parametrize("place", [{"depth": -1e-6}, {"impact": None}])
def test_bristles_are_straight_where_there_is_no_contact(place: dict[str, object]) -> None:
    got = pushed(velocity=(0.0, 0.01), law=BRISTLES, history=SlipHistory(1e-6, 0.01, 1e-4), **place)
    assert (got.deflection, got.friction_force) == (0.0, 0.0)


def test_a_friction_law_without_a_state_has_no_deflection() -> None:
    assert pushed(velocity=(0.0, 0.01), history=SlipHistory(1e-6, 0.01, 1e-4)).deflection == 0.0


# --- wrong laws ---


def test_a_friction_law_in_place_of_a_normal_law_is_refused() -> None:
    with pytest.raises(InputError, match=r"JournalContact\.normal = Frictionless\(\): .*NormalLaw"):
        replace(CONTACT, normal=Frictionless())


def test_a_normal_law_in_place_of_a_friction_law_is_refused() -> None:
    law = LankaraniNikravesh(stiffness=1e9, restitution=0.9)
    with pytest.raises(InputError, match=r"JournalContact\.friction = LankaraniNikravesh.*FrictionLaw"):
        replace(CONTACT, friction=law)


@pytest.mark.parametrize("impact", [None, IMPACT])
def test_from_the_middle_every_way_leads_outwards(impact: float | None) -> None:
    got = CONTACT.force(0.0, 0.0, 0.3, -0.4, 0.0, 0.0, impact)
    assert got.depth == -CONTACT.bearing.clearance
    assert got.rate == 0.5
