"""Legs of the reference support and of a ZF18000: bores, pressures, valves, each with source and range."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from typing import Annotated

from pydantic import Field

from studies.common.subject import without_clearance
from support_exudyn import ClearancePin, HydraulicCylinder, IdealPin
from support_exudyn.files.machines.read import read_machine
from support_exudyn.files.scenarios.short_joints import ShortPin, pin_in_machine
from support_exudyn.files.toml.reading import read_value
from support_exudyn.files.toml.text import parsed
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.actuators import bore_area
from support_exudyn.model.hydraulics.elements import PumpStation
from user_forces.values.sourced import SourcedNumber
from user_forces.values.units import Metres, Newtons, Pascals
from user_forces.values.value import Positive, Value, value

FILE = "support_legs.toml"
PAIRS = ("front_column", "rear_column")


@value
class PublishedForces(Value):
    """Printed forces of a support, and the bore of its legs that they imply.

    Arguments:
        model: name of the support.
        rated: force at which its legs yield [N], > 0.
        setting: with which they are set [N], > 0.
        legs: number, >= 1.
        pressure: of the pump that sets them [Pa], > 0, assumed among the usual ones.
        bore: [m], > 0, of which legs at that pressure give the setting force.
    """

    model: str
    rated: Newtons[Positive]
    setting: Newtons[Positive]
    legs: Annotated[int, Field(ge=1)]
    pressure: Pascals[Positive]
    bore: Metres[Positive]

    @property
    def yield_pressure(self) -> float:
        """Pressure at which legs of this bore carry the rated force [Pa]."""
        return self.rated / bore_area(self.bore, self.legs)


@value
class SupportLegs(Value):
    """A pair of legs of a support, and the station that feeds all of them.

    Arguments:
        cylinder: both legs of a pair together, the front pair and the rear pair alike.
        pump: of the face.
    """

    cylinder: HydraulicCylinder
    pump: PumpStation


@value
class LegsFile(Value):
    """The file of legs: sources by their names, legs by machine, and what is published of others."""

    sources: Mapping[str, str]
    reference: SupportLegs
    zf18000: SupportLegs
    published: tuple[PublishedForces, ...]


@dataclass(frozen=True)
class SourcedLegs:
    """What the file says, with range and source of every number by its key."""

    file: LegsFile
    sourced: Mapping[str, SourcedNumber]

    def of(self, machine: str) -> SupportLegs:
        """The legs of "reference" or "zf18000", machines that come with the package."""
        found: SupportLegs = getattr(self.file, machine)
        return found

    def about(self, machine: str) -> dict[str, SourcedNumber]:
        """Range and source of every number of a machine's legs, by its key within the machine."""
        stem = f"{machine}."
        return {key.removeprefix(stem): one for key, one in self.sourced.items() if key.startswith(stem)}


@cache
def legs_data() -> SourcedLegs:
    """The file of legs, read once."""
    text = (resources.files("studies.common") / FILE).read_text("utf-8")
    sourced: dict[str, SourcedNumber] = {}
    file = read_value(LegsFile, parsed(text, FILE), FILE, sourced=sourced)
    named = {key: replace(one, source=file.sources.get(one.source, one.source)) for key, one in sourced.items()}
    return SourcedLegs(file, named)


def support_legs(machine: str, *, valve: bool = True) -> dict[str, HydraulicCylinder]:
    """Both pairs of legs of a machine, set and closed: check valves hold what oil is in them.

    What only matters where oil is let in, check valve and line, is left out.

    Arguments:
        machine: "reference" or "zf18000".
        valve: whether they have yield valves.
    """
    full = legs_data().of(machine).cylinder
    held = replace(full, check_valve=None, line=None, end_stops=None)
    leg = held if valve else replace(held, yield_valve=None)
    return dict.fromkeys(PAIRS, leg)


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
