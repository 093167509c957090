"""Two free bodies joined only by the clearance pin keep their momentum; the connector that joins them."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from support_exudyn import Body, ClearancePin, Result, Scenario, SolverSettings, simulate
from tests.cases.run_cases import Pair, paper_contact
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
from user_forces.connector.item import SHARE, Attachment, compiled_kernel, connector_kernel
from user_forces.contact import Contact

Bore = Literal["first", "second"]
ONE = Body(mass=3.0, inertia=0.02, centre=(0.1, 0.2), angle=0.3, velocity=(0.1, 0.3), spin=3.0)
TWO = Body(mass=2.0, inertia=0.01, centre=(0.3, 0.1), angle=-1.0, velocity=(-0.4, 0.2), spin=-5.0)


def contact(friction: float) -> JournalContact:
    return JournalContact(
        bearing=JournalBearing(bore_radius=0.02, clearance=0.001),
        normal=LankaraniNikravesh(stiffness=1e9, restitution=0.9),
        friction=Ambrosio(sliding_coefficient=friction),
    )


def fly(one: Body, two: Body, bore: Bore, formulation: str = "exudyn") -> Result:
    scenario = Scenario(
        machine=Pair(one=one, two=two, one_point=(0.2, 0.25), two_point=(0.2, 0.25)),
        pins={"pin": ClearancePin(contact=contact(0.3), bore=bore)},
        duration=0.03,
        step=2e-5,
        gravity=(0.0, 0.0),
        formulation=formulation,
        solver=SolverSettings(impact_steps=512, tolerance=1e-9),
    )
    return simulate(scenario)


def velocity(result: Result, name: str) -> np.ndarray:
    # centres move smoothly between records only in flight, so take the bodies' own velocities
    return np.column_stack([result[f"{name}.velocity_x"], result[f"{name}.velocity_y"]])


def momenta(result: Result, one: Body, two: Body) -> tuple[np.ndarray, np.ndarray]:
    linear = one.mass * velocity(result, "one") + two.mass * velocity(result, "two")
    angular = np.zeros_like(result.time)
    for name, body in (("one", one), ("two", two)):
        v = velocity(result, name)
        x, y = result[f"{name}.x"], result[f"{name}.y"]
        angular += body.mass * (x * v[:, 1] - y * v[:, 0])
        angular += body.inertia * result[f"{name}.angular_velocity"]
    return linear, angular


# what steps leave of the angular momentum, as a share; a force pair that does not act at one point gives 1e-3
FORMULATIONS = {"exudyn": 1e-6, "compiled": 1e-8}


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize(("turn", "bore"), [(0.0, "first"), (3.0, "second")])
def test_momentum_is_kept_whichever_body_carries_the_bore(formulation: str, bore: Bore, turn: float) -> None:
    two = replace(TWO, angle=TWO.angle + turn)
    result = fly(ONE, two, bore, formulation)
    assert len(result.onsets["pin"]) >= 3  # else the test says nothing
    assert result["energy.friction_loss"][-1] > 0.0
    linear, angular = momenta(result, ONE, two)
    # rounding of some thousand steps
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-12)
    np.testing.assert_allclose(angular, angular[0], rtol=FORMULATIONS[formulation])
    assert result.energy_error < 10.0 * FORMULATIONS[formulation] * result.dissipated


def test_momentum_is_kept_while_the_bodies_turn_against_each_other() -> None:
    # two links as heavy as the support's, which turn by 2 rad against each other in half a second: with
    # marker frames that stay behind, 1e-4 of the angular momentum is lost
    one = Body(mass=500.0, inertia=44.7, centre=(-0.4, 0.6), angle=0.3, velocity=(0.1, 0.2), spin=4.0)
    two = Body(mass=400.0, inertia=51.3, centre=(-0.7, 1.0), angle=1.0, velocity=(-0.1, 0.1), spin=-4.5)
    machine = Pair(one=one, two=two, one_point=(-0.8, 0.94), two_point=(-0.8, 0.94))
    pin = ClearancePin(contact=paper_contact(1.5, 0.25))
    scenario = Scenario(
        machine=machine,
        pins={"pin": pin},
        duration=0.5,
        step=5e-5,
        gravity=(0.0, 0.0),
        solver=SolverSettings(impact_steps=128),
    )
    result = simulate(scenario)
    turned = result["one.angle"] - result["two.angle"]
    assert turned[-1] - turned[0] > 1.9
    linear, angular = momenta(result, one, two)
    # rounding of 1e4 steps on momenta of 100 kg m/s
    np.testing.assert_allclose(linear, np.broadcast_to(linear[0], linear.shape), atol=1e-10)
    # asked for; measured 2e-7 with the bore on the first body, a quarter of that at half the step
    np.testing.assert_allclose(angular, angular[0], rtol=1e-6)


# --- the engine's connector of a contact ---


BEARING = JournalBearing(bore_radius=0.02, clearance=0.001)
BOUNCY = LankaraniNikravesh(stiffness=1e9, restitution=0.9)
BRISTLES = LuGre(static_coefficient=0.3, sliding_coefficient=0.2)


def of_friction(friction: FrictionLaw = Frictionless()) -> JournalContact:  # noqa: B008
    return JournalContact(bearing=BEARING, normal=BOUNCY, friction=friction)


SLOT = SlotContact(bearing=Slot(clearance=0.001, radius=0.02), normal=BOUNCY, friction=BRISTLES)
HALF_TURN = 0.3  # [rad], of the connector's axes against the bore's


@pytest.mark.parametrize("at", [Attachment.JOURNAL, Attachment.BORE, Attachment.MIDDLE])
@pytest.mark.parametrize("of", [of_friction(BRISTLES), SLOT], ids=["bore", "slot"])
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
