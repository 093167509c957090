"""Which loads rigid bodies determine, against what can be counted by hand."""

from __future__ import annotations

from dataclasses import replace

from studies.common.paper_machine import clearance_joint, oil_columns
from support_exudyn import CubicStep, Scenario, reference_support, simulate

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


def test_ideal_pins_share_tilting_at_will() -> None:
    # the two front links hold by their distance what the rear link holds by its pins
    assert shares(ON_OIL) == FRONT_LINKS | REAR_LINK


def test_four_rigid_actuators_under_a_rigid_canopy_do_too() -> None:
    pairs = [(actuator, side) for actuator in ("front_column", "rear_column") for side in ("left", "right")]
    hinge = {f"shield_canopy.moment_{axis}" for axis in "xy"}
    assert shares(RIGID) == FRONT_LINKS | REAR_LINK | hinge | {
        f"{actuator}_{side}.force" for actuator, side in pairs
    }


def test_a_loose_pin_leaves_nothing_open() -> None:
    assert shares(WITH_CLEARANCE) == set()


def test_numbers_leave_shares_out() -> None:
    result = simulate(ON_OIL, errors=True)
    assert not result.channels["pin.front_base_left.force"].is_determined
    found = result.numbers()
    assert "pin.front_base.force.mean" in found
    assert "pin.front_base_left.force.mean" not in found
