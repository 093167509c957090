"""A free journal hits the wall of a free bore: what restitution the engine delivers."""

from __future__ import annotations

import pytest

from support_exudyn import Body, ClearancePin, Scenario, SolverSettings, simulate
from tests.analytic import delivered_restitution
from tests.cases.run_cases import Pair
from user_forces import JournalBearing, JournalContact, LankaraniNikravesh


@pytest.mark.parametrize("restitution", [0.3, 0.7, 0.9])
@pytest.mark.parametrize("step", [1e-3, 1e-4])
@pytest.mark.parametrize("impact_steps", [128, 512])
def test_restitution_is_the_closed_form_of_the_law(restitution: float, step: float, impact_steps: int) -> None:
    # centred bodies moving apart along x: 3 kg against 2 kg at 0.2 m/s; the contact lasts 20 to 25 ms
    law = LankaraniNikravesh(stiffness=1e6, restitution=restitution)
    machine = Pair(
        one=Body(mass=3.0, inertia=0.02, centre=(0.0, 0.0)),
        two=Body(mass=2.0, inertia=0.01, centre=(0.0, 0.0), velocity=(0.2, 0.0)),
        one_point=(0.0, 0.0),
        two_point=(0.0, 0.0),
    )
    contact = JournalContact(bearing=JournalBearing(bore_radius=0.02, clearance=0.001), normal=law)
    result = simulate(
        Scenario(
            machine=machine,
            pins={"pin": ClearancePin(contact=contact)},
            duration=0.032,
            step=step,
            gravity=(0.0, 0.0),
            solver=SolverSettings(impact_steps=impact_steps),
        )
    )
    assert len(result.onsets["pin"]) == 1
    assert result.onsets["pin"][0].speed == pytest.approx(0.2, rel=1e-9)  # free flight is exact
    assert result["pin.pin.depth"][-1] < 0.0  # they have separated
    rebound = result["one.velocity_x"][-1] - result["two.velocity_x"][-1]
    # second-order error of an impact in N steps, whatever the step of the flight: 1/N^2, 6e-5 and 4e-6
    assert rebound / 0.2 == pytest.approx(delivered_restitution(law.damping_factor), abs=impact_steps**-2.0)


def test_a_first_step_that_reaches_the_wall_gives_the_right_speed() -> None:
    # from the middle at 0.2 m/s the wall is 5 ms away; the step is longer
    contact = JournalContact(
        bearing=JournalBearing(bore_radius=0.02, clearance=0.001),
        normal=LankaraniNikravesh(stiffness=1e6, restitution=0.9),
    )
    machine = Pair(
        one=Body(mass=3.0, inertia=0.02, centre=(0.0, 0.0)),
        two=Body(mass=2.0, inertia=0.01, centre=(0.0, 0.0), velocity=(0.2, 0.0)),
        one_point=(0.0, 0.0),
        two_point=(0.0, 0.0),
    )
    step = 5.1e-3
    result = simulate(
        Scenario(
            machine=machine,
            pins={"pin": ClearancePin(contact=contact)},
            duration=2 * step,
            step=step,
            record_period=step,
            gravity=(0.0, 0.0),
        )
    )
    onset = result.onsets["pin"][0]
    assert onset.time == pytest.approx(5e-3, rel=1e-9)  # free flight is a straight line
    assert onset.speed == pytest.approx(0.2, rel=1e-9)
