"""A free journal hits the wall of a free bore: the restitution that each formulation delivers."""

from __future__ import annotations

import pytest

from support_exudyn import Body, ClearancePin, Result, Scenario, SolverSettings, simulate
from tests.analytic import delivered_restitution
from tests.cases.run_cases import Pair
from user_forces import JournalBearing, JournalContact, LankaraniNikravesh

SPEED = 0.2  # [m/s]
FLIGHT = 5e-3  # [s]


def struck(restitution: float, **changes: object) -> Result:
    """Centred bodies of 3 kg and 2 kg that move apart along x; the contact lasts 20 to 25 ms."""
    machine = Pair(
        one=Body(mass=3.0, inertia=0.02, centre=(0.0, 0.0)),
        two=Body(mass=2.0, inertia=0.01, centre=(0.0, 0.0), velocity=(SPEED, 0.0)),
        one_point=(0.0, 0.0),
        two_point=(0.0, 0.0),
    )
    law = LankaraniNikravesh(stiffness=1e6, restitution=restitution)
    contact = JournalContact(bearing=JournalBearing(bore_radius=0.02, clearance=0.001), normal=law)
    fields: dict[str, object] = {
        "machine": machine,
        "pins": {"pin": ClearancePin(contact=contact)},
        "duration": 0.032,
        "gravity": (0.0, 0.0),
    }
    return simulate(Scenario(**fields | changes))


# second-order error of an impact in N steps, whatever the step of the flight: 1/N^2. The last step is longer
# than the flight
WAYS = {
    "compiled": ({"formulation": "compiled", "solver": SolverSettings(tolerance=1e-9)}, 1e-8),
    "engine, 128 steps": ({"step": 1e-3, "solver": SolverSettings(impact_steps=128)}, 128.0**-2),
    "engine, 512 steps": ({"step": 1e-4, "solver": SolverSettings(impact_steps=512)}, 512.0**-2),
    "engine, a long step": ({"step": 5.1e-3, "solver": SolverSettings(impact_steps=512)}, 512.0**-2),
}


@pytest.mark.parametrize("restitution", [0.3, 0.7, 0.9])
@pytest.mark.parametrize("way", WAYS)
def test_restitution_is_the_closed_form_of_the_law(way: str, restitution: float) -> None:
    settings, close = WAYS[way]
    result = struck(restitution, **settings)
    (onset,) = result.onsets["pin"]
    assert onset.time == pytest.approx(FLIGHT, rel=1e-9)  # free flight is exact
    assert onset.speed == pytest.approx(SPEED, rel=1e-9)
    assert result["pin.pin.depth"][-1] < 0.0
    rebound = (result["one.velocity_x"][-1] - result["two.velocity_x"][-1]) / SPEED
    law = result.scenario.clearance_pins["pin"].contact.normal
    assert rebound == pytest.approx(delivered_restitution(law.damping_factor), abs=close)
    assert onset.separation_velocity / SPEED == pytest.approx(rebound, abs=close)
