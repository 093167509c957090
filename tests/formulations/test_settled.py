"""A start in static equilibrium, so that the dwell need not be simulated."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import (
    AppliedForce,
    ClearancePin,
    CubicStep,
    Held,
    Load,
    OilColumn,
    Roof,
    Scenario,
    SimulationError,
    reference_support,
    simple_scenario,
    simulate,
)
from tests.cases.run_cases import FORCE, PIN, Pair, loose_support, paper_contact
from tests.formulations.test_momentum import ONE, TWO


def settled(clearance_mm: float = 1.5, friction: float = 0.0, **changes: object) -> Scenario:
    fields = {"drive": Held(), "duration": 0.05, "start": "settled"} | changes
    return loose_support(clearance_mm, friction, **fields)


def test_a_settled_support_stays_at_rest() -> None:
    result = simulate(settled())
    # a contact this stiff turns the Newton residual of 1e-8 into speeds of 1e-9 m/s
    assert np.abs(result["rear_link.angular_velocity"]).max() < 1e-8
    np.testing.assert_allclose(result[FORCE], result[FORCE][0], rtol=1e-7)
    assert result.onsets[PIN] == ()
    # the journal lies at the depth of Hertz
    normal = result.scenario.clearance_pins[PIN].contact.normal
    expected = (result[FORCE][0] / normal.stiffness) ** (2.0 / 3.0)  # F = K depth^1.5
    assert result[f"pin.{PIN}.depth"][0] == pytest.approx(expected, rel=1e-9)  # rounding


def test_bodies_that_nothing_holds_have_no_equilibrium() -> None:
    machine = Pair(one=ONE, two=TWO, one_point=(0.2, 0.25), two_point=(0.2, 0.25))
    pin = ClearancePin(contact=paper_contact(1.5, 0.0))
    with pytest.raises(SimulationError, match="no static equilibrium"):
        simulate(Scenario(machine=machine, pins={"pin": pin}, duration=1.0, start="settled"))


@pytest.mark.parametrize("kind", ["force", "roof"])
def test_what_presses_later_has_no_part_in_the_start(kind: str) -> None:
    on_canopy = {"body": "canopy", "point": reference_support().linkage().points["tip"].point}
    loads: dict[str, Load] = {
        "force": AppliedForce(full_force=(0.0, -5e5), start=0.03, end=0.9, **on_canopy),
        "roof": Roof(descent=CubicStep(stroke=0.05, start=0.03, end=0.9), stiffness=1e7, gap=5e-3, **on_canopy),
    }
    still = simulate(settled(actuators=oil_columns(), duration=0.03))
    pressed = simulate(settled(actuators=oil_columns(), duration=0.03, loads={kind: loads[kind]}))
    for name in ("tip.y", "front_column.force", FORCE):  # Newton's tolerance, as above
        np.testing.assert_allclose(pressed[name], still[name], rtol=1e-6, err_msg=name)


# --- pins as stiff as steel ---

WEIGHT_ON_PIN = 58.98e3  # of the reference support in its start posture [N]


@pytest.mark.parametrize(
    ("clearance_mm", "actuators"), [(0.001, {}), (0.2, {}), (1.5, {}), (1.5, oil_columns()), (5.0, {})]
)
@pytest.mark.parametrize("backing", ["rigid", "estimated"])
def test_the_equilibrium_of_a_stiff_pin_is_found(
    clearance_mm: float, actuators: dict[str, OilColumn], backing: str
) -> None:
    scene = simple_scenario(
        "reference",
        duration_s=1e-3,
        drive={"mode": 2},
        pins={PIN: {"clearance_mm": clearance_mm, "backing_stiffness": backing}},
        start="settled",
        step_s=1e-4,
    )
    one, other = (
        simulate(replace(scene, actuators=actuators, formulation=name)) for name in ("exudyn", "compiled")
    )
    force, depth = one[FORCE][0], one[f"pin.{PIN}.depth"][0]
    assert force == pytest.approx(WEIGHT_ON_PIN, rel=0.01)
    law = one.scenario.clearance_pins[PIN].contact.normal
    assert depth == pytest.approx(law.resting_depth(force), rel=1e-5)
    assert other[FORCE][0] == pytest.approx(force, rel=1e-6)  # both by Newton's method
