"""The times that a scene's steps have to follow, against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import (
    ClearanceGuide,
    ClearancePin,
    CubicStep,
    Held,
    ImpactStand,
    Reciprocating,
    Scenario,
    Steady,
    UniformSpeed,
    machine,
)
from support_exudyn.mechanics.contact_places import contact_rate
from support_exudyn.scenario.timescales import timescales
from tests.cases.run_cases import (
    CRANK_SPEED,
    PIN,
    loose_slider_crank,
    loose_support,
    paper_contact,
    slider_crank,
    support,
)
from tests.cases.run_cases import SLIDER_PIN as SLIDER
from user_forces import (
    Ambrosio,
    Anagnostopoulos,
    Hertz,
    JournalContact,
    KelvinVoigt,
    LoadError,
    LuGre,
    NormalLaw,
    value,
)

CLEARANCE = 1.5e-3
RADIUS, ROD = 0.05, 0.12  # of the slider-crank [m]


def stand(normal: NormalLaw, gravity: tuple[float, float] = (0.0, 0.0), mass: float = 3.0) -> Scenario:
    """A journal in a bore of twice its mass; the reduced mass is two thirds of the journal's."""
    contact = JournalContact(bearing=paper_contact(1.5, 0.0).bearing, normal=normal)
    return Scenario(
        machine=ImpactStand(bore_mass=2.0 * mass, journal_mass=mass, speed=0.1),
        pins={"pin": ClearancePin(contact=contact)},
        duration=1.0,
        gravity=gravity,
    )


def spring(stiffness: float) -> NormalLaw:
    """A contact whose stiffness is the same at every depth."""
    return KelvinVoigt(stiffness=stiffness, damping=0.0)


# --- flight ---


def test_a_flight_is_a_fall_through_the_clearance() -> None:
    found = timescales(loose_support(drive=Held())).flight
    # exact
    assert found == pytest.approx(math.sqrt(2.0 * CLEARANCE / 9.81), rel=1e-12)


@pytest.mark.parametrize(("start_angle", "gravity"), [(0.0, 0.0), (0.5, 0.0), (0.5, 9.81)])
def test_in_a_running_machine_the_fastest_body_pulls(start_angle: float, gravity: float) -> None:
    scene = loose_slider_crank(1e-3, gravity=(0.0, -gravity))
    scene = replace(scene, machine=replace(scene.machine, start_angle=start_angle))
    found = timescales(scene).flight
    # centres of the rod and the slider, velocities of the ideal mechanism
    slider = abs(scene.machine.slider_speed(start_angle, CRANK_SPEED))
    height = RADIUS * math.sin(start_angle)
    bend = math.sqrt(ROD**2 - height**2)
    turn = -RADIUS * math.cos(start_angle) / bend  # of the rod, per turn of the crank
    rod = math.hypot(slider / CRANK_SPEED + 0.5 * turn * height, 0.5 * turn * bend) * CRANK_SPEED
    pull = CRANK_SPEED * max(slider, rod, 0.5 * RADIUS * CRANK_SPEED) + gravity
    assert found == pytest.approx(math.sqrt(2.0 * 5e-4 / pull), rel=1e-9)


# --- resting ---


@given(mass=st.floats(1e-2, 1e4), stiffness=st.floats(1e3, 1e10))
def test_a_contact_rests_on_its_stiffness(mass: float, stiffness: float) -> None:
    # nothing joins the two bodies to the ground, so no ideal pin carries a weight: the mass and the pull decide
    found = timescales(stand(spring(stiffness), (0.0, -9.81), mass)).resting
    # the slope is of a secant over a hundredth of the depth, of a line
    assert found == pytest.approx(math.sqrt(2.0 / 3.0 * mass / stiffness), rel=1e-6)


def test_without_weight_the_lightest_direction_decides() -> None:
    scene = loose_slider_crank(1e-3)  # crank and rod along x
    bearing = scene.clearance_pins[SLIDER].contact.bearing
    contact = JournalContact(bearing=bearing, normal=spring(1e8))
    found = timescales(replace(scene, pins={SLIDER: ClearancePin(contact=contact)})).resting
    m = scene.machine
    # along the rod the slider alone moves, across it the rod's end about the crank's
    end = m.rod_mass / 4.0 + m.rod_inertia / m.rod_length**2
    assert end < m.slider_mass
    # the slope is of a secant over a hundredth of the depth, of a line
    assert found == pytest.approx(math.sqrt(end / 1e8), rel=1e-6)


def test_on_the_support_the_load_is_that_of_the_ideal_pin() -> None:
    scene = loose_support(drive=Held())
    pin = scene.clearance_pins[PIN]
    slopes = [1e9, 4e9]
    times = [
        timescales(
            replace(
                scene,
                pins={PIN: replace(pin, contact=replace(pin.contact, normal=spring(k)))},
            )
        ).resting
        for k in slopes
    ]
    assert times[0] == pytest.approx(2.0 * times[1], rel=1e-6)
    # CHECK of `test_ideal_support`: 58 779 N. Hertz's slope there, with the mass that the springs tell
    mass = times[0] ** 2 * slopes[0]
    stiffness = pin.contact.normal.stiffness
    slope = 1.5 * stiffness ** (2.0 / 3.0) * 58778.944 ** (1.0 / 3.0)
    # the secant's 0.25 % of the slope
    assert timescales(scene).resting == pytest.approx(math.sqrt(mass / slope), rel=2e-3)


@value
class Weak(Hertz):
    """Is not valid below a micrometre."""

    @property
    def largest_depth(self) -> float:
        return 1e-6

    def resting_depth(self, force: float) -> float:
        raise LoadError(f"Weak: force = {force} N: allowed: less")


def test_a_law_that_cannot_hold_the_load_is_left_to_the_run() -> None:
    # that says when and where it is overloaded, or never is
    assert timescales(stand(Weak(stiffness=1e6), (0.0, -9.81))).resting == math.inf


# --- friction ---


def rubbed(static: float, dynamic: float, coefficient: float = 0.25) -> Scenario:
    """The stand under gravity, whose journal is pressed by the reduced mass times that."""
    scene = stand(spring(1e9), (0.0, -9.81))
    friction = Ambrosio(sliding_coefficient=coefficient, static_speed=static, dynamic_speed=dynamic)
    contact = replace(scene.clearance_pins["pin"].contact, friction=friction)
    return replace(scene, pins={"pin": ClearancePin(contact=contact)})


@pytest.mark.parametrize(
    ("static", "ramp"),
    [(0.0, 1e-2), (1e-4, 1e-2), (1e-7, 1e-7), (1e-4, 4e-6), (1e-2, 1e-4), (0.1, 1e-7), (0.0372, 3e-6)],
)
def test_friction_stops_in_the_mass_times_its_ramp_over_the_force(static: float, ramp: float) -> None:
    # the load is m g, and so the mass falls out of m (v_d - v_s) / (mu m g)
    expected = ramp / (0.25 * 9.81)
    # differences of slips of 0.1 m/s are rounded by 1e-17: the narrowest part divided is 1e-9 wide
    assert timescales(rubbed(static, static + ramp)).rubbing == pytest.approx(expected, rel=1e-5)


# --- drive ---


def test_the_drives_time_is_its_stroke_or_a_cranks_turn() -> None:
    assert timescales(support(drive=CubicStep(start=1.0, end=3.5))).drive == 2.5
    assert timescales(support(drive=UniformSpeed(start=0.0, end=0.5))).drive == 0.5
    assert timescales(slider_crank(1e-3)).drive == pytest.approx(1.0 / CRANK_SPEED)
    assert timescales(slider_crank(1e-3, drive=Steady(rate=-CRANK_SPEED))).drive == pytest.approx(
        1.0 / CRANK_SPEED
    )
    # one over its angular frequency
    rising = Reciprocating(stroke=0.1, period=math.pi)
    assert timescales(support(drive=rising)).drive == pytest.approx(0.5, rel=1e-15)
    # actuators that go on as they are have no time of their own
    assert timescales(support(drive=Steady(rate=0.05), duration=1.0)).drive == math.inf
    assert timescales(support(drive=Held())).drive == math.inf


# --- friction that holds ---


def test_what_friction_holds_swings_on_its_bristles() -> None:
    scene = stand(spring(1e6), (0.0, -9.81))
    friction = LuGre(
        static_coefficient=0.3, sliding_coefficient=0.2, bristle_stiffness=1e6, bristle_damping=0.0
    )
    contact = replace(scene.clearance_pins["pin"].contact, friction=friction)
    found = timescales(replace(scene, pins={"pin": ClearancePin(contact=contact)})).resting
    # the load is m g, and so the mass falls out of sqrt(m / (s0 m g)); the contact itself swings in 1.4 ms
    assert found == pytest.approx(1.0 / math.sqrt(1e6 * 9.81), rel=1e-6)


# --- masses of laws that need one ---


def test_the_mass_of_a_guide_is_that_along_the_normals_of_its_corners() -> None:
    law = Anagnostopoulos(stiffness=1e8, restitution=0.5)
    guide = ClearanceGuide(gaps=(1e-3, 1e-3), block=(0.1, 0.05), normal=law)
    scene = Scenario(machine=machine("slider_crank_guide"), guides={"slot": guide}, duration=0.01)
    places = scene.contact_places.values()
    masses = [place.contact.normal.mass for place in places]  # type: ignore[attr-defined]
    free, still = scene.open_kinetics, np.zeros(9)
    # of the four corners, by hand: the second row of each answer is that across a guide along x
    across = [free.inverse_mass(still, contact_rate(free.motion(still), place))[1, 1] for place in places]
    assert masses == [pytest.approx(1.0 / np.mean(across), rel=1e-12)] * 4
