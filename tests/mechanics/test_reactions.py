"""Joint forces and accelerations from motions, loads that are determined, contacts and drives at records."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.common.paper_machine import clearance_joint, oil_columns
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    Reciprocating,
    Scenario,
    SolverSettings,
    Steady,
    TableDrive,
    UniformSpeed,
    cylinders_and_rods,
    reference_support,
    simulate,
)
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.constraints import constraints_of, turning
from support_exudyn.mechanics.contact_places import RelativeMotion, series
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.reactions import accelerations
from tests.cases.run_cases import loose_support, paper_contact, support
from user_forces import Ambrosio, FrictionLaw, Frictionless, friction_law
from user_forces.contact import SlipHistory
from user_forces.contact_state import PinMemory


def heavy() -> Scenario:
    """With guides between bodies that turn."""
    return support(actuators=cylinders_and_rods(), duration=0.1)


def test_rows_turn_as_their_bodies_move() -> None:
    linkage = heavy().linkage
    random = np.random.default_rng(1)
    position, velocity = random.normal(scale=0.3, size=(2, 4, 3 * len(linkage.bodies)))
    motion = BodyMotion(linkage, position, velocity)
    kinetics, h = kinetics_of(linkage), 1e-6
    later, earlier = (
        np.array([kinetics.rows(q + s * h * v) for q, v in zip(position, velocity, strict=True)])
        for s in (1, -1)
    )
    changed = np.einsum("nrk,nk->nr", later - earlier, velocity) / (2.0 * h)
    np.testing.assert_allclose(turning(motion, constraints_of(linkage)), changed, atol=1e-7)


@pytest.mark.parametrize(
    "drive", [CubicStep(stroke=0.05, start=0.02, end=0.2), Reciprocating(stroke=0.02, period=0.1)]
)
def test_forces_are_those_of_free_coordinates_also_after_a_break(drive: Drive) -> None:
    scene = support(duration=0.1, drive=drive, step=1e-3)
    mine, other = simulate(scene), simulate(replace(scene, formulation="compiled"))
    for name in mine.channels:
        if name.endswith(".force"):
            # measured: 3e-6. Multipliers overshoot in the first steps after a jump of the drive's acceleration
            np.testing.assert_allclose(
                mine[name], other[name], atol=1e-5 * np.abs(other[name]).max(), rtol=0.0, err_msg=name
            )


@pytest.mark.parametrize("actuators", [{}, oil_columns(), cylinders_and_rods()])
def test_short_steps_show_no_rounding_in_forces(actuators: dict) -> None:  # type: ignore[type-arg]
    # the journal falls freely: nothing shakes. Multipliers scatter by 1e5 N at this step
    scene = loose_support(duration=1e-3, drive=Held(), step=5e-7, record_period=1e-4, actuators=actuators)
    result = simulate(replace(scene, solver=SolverSettings(impact_steps=64)))
    for name in ("pin.front_base.force", "pin.shield_canopy.force", "canopy.angular_acceleration"):
        values = result[name]
        smooth = np.polyval(np.polyfit(result.time, values, 4), result.time)
        assert np.abs(values - smooth).max() < 1e-5 * np.abs(values).max(), name


# --- which loads rigid bodies determine ---


RIGID = Scenario(
    machine=reference_support(),
    drive=CubicStep(stroke=0.001, start=0.0, end=0.02),
    duration=0.02,
    step=2e-3,
    record_period=4e-3,
    dimensions=3,
)
ON_OIL = replace(RIGID, actuators=oil_columns())
WITH_CLEARANCE = replace(ON_OIL, pins={"rear_base": clearance_joint(1.5, 0.0)})


def shares(scenario: Scenario) -> set[str]:
    """Forces and moments, by name, of which many shares balance."""
    return {
        name.removeprefix("pin.")
        for name, definition in scenario.channel_definitions.items()
        if "do not determine" in definition.meaning and (name.endswith(".force") or ".moment" in name)
    }


FRONT_LINKS = {f"{pin}_{side}.force" for pin in ("front_base", "front_shield") for side in ("left", "right")}
REAR_LINK = {f"{pin}.moment_{axis}" for pin in ("rear_base", "rear_shield") for axis in "xy"}


HINGE = {f"shield_canopy.moment_{axis}" for axis in "xy"}
COLUMNS = {f"{column}_{side}.force" for column in ("front_column", "rear_column") for side in ("left", "right")}


@pytest.mark.parametrize(
    ("scenario", "open_shares"),
    [
        # the two front links hold by their distance what the rear link holds by its pins
        (ON_OIL, FRONT_LINKS | REAR_LINK),
        # and so do four rigid actuators under a rigid canopy
        (RIGID, FRONT_LINKS | REAR_LINK | HINGE | COLUMNS),
        (WITH_CLEARANCE, set()),
    ],
)
def test_loads_that_are_not_determined(scenario: Scenario, open_shares: set[str]) -> None:
    assert shares(scenario) == open_shares


def test_numbers_leave_shares_out() -> None:
    result = simulate(ON_OIL, errors=True)
    assert not result.channels["pin.front_base_left.force"].is_determined
    found = result.numbers()
    assert "pin.front_base.force.mean" in found
    assert "pin.front_base_left.force.mean" not in found


# --- a contact at all records at once ---


BASE = paper_contact(1.5, 0.0)
NORMAL = replace(BASE.normal, restitution=0.5)  # asks for the mass that moves
CLEARANCE = BASE.bearing.clearance


@friction_law
def branching(slip: float, normal_force: float) -> float:
    """Coulomb's friction with an `if`."""
    if slip > 0.0:
        return -0.25 * normal_force
    return 0.25 * normal_force


speeds = st.floats(-1.0, 1.0)
records = st.lists(
    st.tuples(
        st.floats(0.0, 7.0),  # direction of the journal from the bore's centre
        st.floats(-1e-4, -1e-8) | st.floats(1e-8, 1e-4),  # depth
        speeds,
        speeds,
        speeds,
        speeds,
        st.floats(0.0, 0.05),  # speed of the impact, often less than what the depth stores
        st.booleans(),  # in contact
    ),
    min_size=1,
    max_size=6,
)


@pytest.mark.parametrize("friction", [Frictionless(), Ambrosio(sliding_coefficient=0.25), branching()])
@given(rows=records)
def test_all_at_once_is_one_by_one(friction: FrictionLaw, rows: list[tuple[float, ...]]) -> None:
    pin = ClearancePin(contact=replace(BASE, normal=NORMAL, friction=friction))
    angle, depth, vx, vy, bore_spin, journal_spin, impact, closed = np.array(rows, dtype=np.float64).T
    far = CLEARANCE + depth
    moving = RelativeMotion(
        far * np.cos(angle),
        far * np.sin(angle),
        vx,
        vy,
        bore_spin,
        journal_spin,
    )
    memories = [PinMemory(bool(c), v, 0.0, 0.0) for c, v in zip(closed, impact, strict=True)]
    found = series(pin.contact, moving, memories)
    for n, memory in enumerate(memories):
        x, y = moving.x[n], moving.y[n]
        known = memory.impact_velocity
        motion = x, y, vx[n], vy[n], bore_spin[n], journal_spin[n]
        want = pin.contact.force(*motion, known if memory.in_contact else None, SlipHistory(0.0, 0.0, 0.0))
        for name in ("force_x", "force_y", "normal_force", "friction_force", "depth", "slip"):
            got = getattr(found, name)[n]
            # a depth of 1e-8 is known to 1e-11 of itself; powers and quotients of it to a few times that
            assert got == pytest.approx(getattr(want, name), rel=1e-9, abs=1e-9 * (1.0 + want.normal_force)), (
                name
            )
        stored = pin.contact.normal.elastic_energy(depth[n]) if depth[n] > 0.0 else 0.0
        assert found.stored[n] == pytest.approx(stored, rel=1e-9)
        assert found.impact_velocity[n] == (memory.impact_velocity if memory.in_contact else 0.0)


# --- second derivatives of drives ---


def rate(drive: Drive, *times: float) -> list[float]:
    return accelerations(drive, np.array(times), 10.0).tolist()


def test_a_cubic_step_is_accelerated_along_a_straight_line() -> None:
    drive = CubicStep(stroke=0.5, start=3.0, end=5.0)
    wanted = [0.5 * (6.0 - 12.0 * x) / 4.0 for x in (0.25, 0.5, 0.9)]
    assert rate(drive, 3.5, 4.0, 4.8) == pytest.approx(wanted, abs=1e-9)
    assert rate(drive, 0.0, 1.0, 6.0) == pytest.approx([0.0] * 3, abs=1e-9)


def test_at_a_break_it_is_the_value_before() -> None:
    drive = CubicStep(stroke=0.5, start=3.0, end=5.0)
    last = -0.5 * 6.0 / 4.0
    assert rate(drive, 3.0, 5.0) == pytest.approx([0.0, last], abs=1e-9)
    # a record may miss a break by rounding
    assert rate(drive, 3.0 + 4e-16, 5.0 + 1e-15, 5.0 - 1e-15) == pytest.approx([0.0, last, last], abs=1e-9)
    # just after it
    assert rate(drive, 3.0 + 1e-7) == pytest.approx([-last], rel=1e-3)
    # what begins at the start has not begun there
    assert rate(CubicStep(start=0.0, end=1.0), 0.0) == [0.0]


@pytest.mark.parametrize(
    "drive", [UniformSpeed(), TableDrive(times=(0.0, 1.0), extensions=(0.0, 0.1), between="linear")]
)
def test_a_jump_of_the_speed_is_no_acceleration(drive: Drive) -> None:
    times = sorted({*drive.breaks, *(t + h for t in drive.breaks for h in (1e-8, 1e-5, 0.1)), 0.0})
    assert rate(drive, *times) == pytest.approx([0.0] * len(times), abs=1e-7)


def test_what_swings_is_accelerated_from_the_start_on() -> None:
    drive, w = Reciprocating(stroke=0.2, period=0.5), 4.0 * math.pi
    times = (0.01, 0.1, 0.3, 7.77)
    assert rate(drive, *times) == pytest.approx([0.1 * w * w * math.cos(w * t) for t in times], rel=1e-9)
    assert rate(Steady(rate=100.0), 0.0, 1.0) == pytest.approx([0.0, 0.0], abs=1e-7)
    assert rate(Held(), 0.0, 1.0) == [0.0, 0.0]
