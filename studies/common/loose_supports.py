"""Four-column supports that come with the package, with clearance and friction in any of their pins."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from studies.common.subject import without_clearance
from support_exudyn import ClearancePin, IdealPin
from support_exudyn.files.machines.read import read_machine
from support_exudyn.files.scenarios.short_joints import ShortPin, pin_in_machine
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.machine_data import MachineData


@cache
def machine_data(name: str) -> MachineData:
    """A machine that comes with the package, and the bores of its pins."""
    return read_machine(name)


def support(name: str) -> HydraulicSupport:
    """A four-column support that comes with the package."""
    machine = machine_data(name).machine
    assert isinstance(machine, HydraulicSupport)
    return machine


def loose_pins(
    machine: str, clearance_mm: float, friction: float, pins: Iterable[str]
) -> dict[str, ClearancePin]:
    """These pins with this radial clearance, > 0, along their length in bores of the machine."""
    data = machine_data(machine)
    short = ShortPin(clearance=clearance_mm / 1e3, friction=friction)
    return {name: pin_in_machine(short, data.machine, name, data.bore_radii[name]) for name in pins}


def tight_pins(machine: str, friction: float, pins: Iterable[str]) -> dict[str, IdealPin]:
    """These pins ideal, with the friction that they have with clearance."""
    return {name: without_clearance(pin) for name, pin in loose_pins(machine, 1.0, friction, pins).items()}
