"""Scenarios of any parts: refused in a sentence, or good for all that a run asks of them; and short runs."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import (
    ClearancePin,
    Drive,
    Held,
    IdealPin,
    ImpactStand,
    Machine,
    Pin,
    Scenario,
    SimulationError,
    SolverSettings,
    Steady,
    ravn_slider_crank,
    simulate,
)
from tests import strategies as some
from tests.sound import sensible, sound
from user_forces import (
    FrictionLaw,
    Frictionless,
    InputError,
    JournalBearing,
    JournalContact,
    LankaraniNikravesh,
    NormalLaw,
)


@given(scenario=some.values(Scenario))
@some.tried("scenarios")
def test_a_scenario_that_can_be_made_is_sound(scenario: Scenario) -> None:
    sound(scenario)


# --- runs ---

clearances = st.floats(1e-6, 2e-2)
stiffnesses = st.floats(3.0, 16.0).map(lambda power: 10.0**power)
weights = st.floats(-6.0, 9.0).map(lambda power: 10.0**power)


@st.composite
def contacts(draw: st.DrawFn) -> JournalContact:
    """What an engineer could want of a pin, and laws with any parameters."""
    bore = draw(st.floats(0.021, 0.2))
    normal = LankaraniNikravesh(stiffness=draw(stiffnesses), restitution=draw(st.floats(0.01, 1.0)))
    return JournalContact(
        bearing=JournalBearing(bore_radius=bore, clearance=draw(clearances)),
        normal=draw(some.values(NormalLaw)) if draw(st.booleans()) else normal,
        friction=draw(some.values(FrictionLaw)) if draw(st.booleans()) else Frictionless(),
    )


MOST_IMPACTS = 20.0  # that fit into a run, each of some 16 steps; hard laws have impacts of nanoseconds


@st.composite
def short_runs(draw: st.DrawFn) -> Scenario:
    """A stand or a slider-crank for some milliseconds, in few steps and impacts."""
    pin = ClearancePin(contact=draw(contacts()), bore=draw(st.sampled_from(("first", "second"))))
    clearance = pin.contact.bearing.clearance
    stand = draw(st.booleans())
    machine: Machine
    if stand:
        machine = ImpactStand(
            bore_mass=draw(weights),
            journal_mass=draw(weights),
            speed=draw(st.floats(0.0, 100.0)),
            eccentricity=clearance * draw(st.sampled_from((0.0, 0.9, 0.999999, 1.0, 1.001))),
        )
        impact, mass = machine.speed + 0.01, machine.reduced_mass
        pins: dict[str, Pin] = {"pin": pin}
    else:
        machine = dataclasses.replace(ravn_slider_crank(), start_angle=draw(st.floats(-4.0, 4.0)))
        impact, mass = 10.0, machine.slider_mass
        pins = {"slider_pin": IdealPin() if draw(st.booleans()) else pin}
    steps = draw(st.integers(1, 20))
    longest = MOST_IMPACTS * pin.contact.normal.impact_time(impact, mass)
    duration = min(draw(st.floats(1e-5, 5e-3)), longest)
    drive: Drive = Steady(rate=draw(st.floats(-1e3, 1e3))) if draw(st.booleans()) and not stand else Held()
    return Scenario(
        machine=machine,
        pins=pins,
        drive=drive,
        duration=duration,
        step=duration / steps,
        record_period=duration / draw(st.integers(1, steps)),
        gravity=draw(st.tuples(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))),
        formulation=draw(st.sampled_from(("auto", "exudyn", "compiled"))),
        start="concentric" if stand else draw(st.sampled_from(("concentric", "settled"))),
        solver=SolverSettings(
            impact_steps=16,
            tolerance=draw(st.sampled_from((1e-5, 1e-3))),
            newton=draw(st.sampled_from(("modified", "full"))),
        ),
    )


@given(data=st.data())
@some.tried("runs")
def test_a_short_run_ends_in_numbers_or_says_why_not(data: st.DataObject) -> None:
    try:
        result = simulate(data.draw(short_runs()))
    except (InputError, SimulationError) as error:
        sensible(error)
        return
    for name, channel in result.channels.items():
        assert np.isfinite(channel.values).all(), name
    for pin, force in result.largest_force.items():
        assert 0.0 <= force < math.inf, pin
    assert math.isfinite(result.energy_error)
    assert repr(result)
