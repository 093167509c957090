"""A settled start with pins as stiff as steel: the equilibrium is found, and it is that of the ideal pin."""

from __future__ import annotations

from dataclasses import replace

import pytest

from studies.common.paper_machine import oil_columns
from support_exudyn import Scenario, simple_scenario, simulate

WEIGHT_ON_PIN = 58.98e3  # of the reference support in its start posture [N]


def settled(clearance_mm: float, formulation: str = "exudyn", **pin: object) -> Scenario:
    return simple_scenario(
        "reference",
        duration_s=1e-3,
        drive={"mode": 2},
        pins={"rear_base": {"clearance_mm": clearance_mm, **pin}},
        start="settled",
        step_s=1e-4,
        formulation=formulation,
    )


@pytest.mark.parametrize("clearance_mm", [0.001, 0.2, 1.5, 5.0])
@pytest.mark.parametrize("backing", ["rigid", "estimated"])
def test_the_equilibrium_is_found(clearance_mm: float, backing: str) -> None:
    result = simulate(settled(clearance_mm, backing_stiffness=backing))
    force, depth = result["pin.rear_base.force"][0], result["pin.rear_base.depth"][0]
    assert force == pytest.approx(WEIGHT_ON_PIN, rel=0.01)
    law = result.scenario.clearance_pins["rear_base"].contact.normal
    assert depth == pytest.approx(law.resting_depth(force), rel=1e-5)


@pytest.mark.parametrize("backing", ["rigid", "estimated"])
@pytest.mark.parametrize("on_oil", [False, True])
def test_the_compiled_formulation_finds_it_too(backing: str, on_oil: bool) -> None:
    scenario = settled(1.5, backing_stiffness=backing)
    scenario = replace(scenario, actuators=oil_columns() if on_oil else {})
    one, other = (
        simulate(replace(scenario, formulation=name))["pin.rear_base.force"][0]
        for name in ("exudyn", "compiled")
    )
    assert other == pytest.approx(WEIGHT_ON_PIN, rel=0.01)
    assert other == pytest.approx(one, rel=1e-6)  # both by Newton's method
