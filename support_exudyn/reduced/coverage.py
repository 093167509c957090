"""What the reduced formulation covers; everything else is refused with what to do instead."""

from __future__ import annotations

from typing import NoReturn

from support_exudyn.drives import CubicStep, Held, UniformSpeed
from support_exudyn.linkages.hydraulic_support import HydraulicSupport
from support_exudyn.scenario import Scenario
from user_forces.contact import JournalContact
from user_forces.friction.ambrosio import Ambrosio
from user_forces.friction.frictionless import Frictionless
from user_forces.normal.damping_speed import DepthSpeed, TouchSpeed
from user_forces.normal.hertz import Hertz
from user_forces.normal.hysteresis import Hysteresis
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_law import ElasticPower, PowerLaw
from user_forces.values import InputError

PIN = "rear_base"
DRIVES = (Held, CubicStep, UniformSpeed)


def check(scenario: Scenario) -> HydraulicSupport:
    """The scenario's machine. Raises InputError if the reduced formulation does not cover the scenario."""
    machine = scenario.machine
    if not isinstance(machine, HydraulicSupport):
        _refuse("machine", type(machine).__name__, HydraulicSupport.__name__)
    if type(scenario.drive) not in DRIVES:
        _refuse("drive", type(scenario.drive).__name__, ", ".join(drive.__name__ for drive in DRIVES))
    if scenario.start != "concentric":
        _refuse("start", repr(scenario.start), "'concentric'")
    for name, pin in scenario.clearance_pins.items():
        if name != PIN:
            _refuse(f"pins.{name}", type(pin).__name__, f"clearance in {PIN} only")
        _check_contact(pin.contact)
    return machine


def _check_contact(contact: JournalContact) -> None:
    where = f"pins.{PIN}.contact"
    if not has_power_form(contact.normal):
        allowed = (
            f"{Hertz.__name__} and laws derived from {PowerLaw.__name__}, F = K depth^n (1 + chi rate / w)"
        )
        _refuse(f"{where}.normal", type(contact.normal).__name__, allowed)
    if type(contact.friction) not in (Frictionless, Ambrosio):
        allowed = f"{Frictionless.__name__}, {Ambrosio.__name__}"
        _refuse(f"{where}.friction", type(contact.friction).__name__, allowed)


def has_power_form(law: NormalLaw) -> bool:
    """Whether a law's force is K depth^n (1 + chi rate / w), or K depth^n, and nothing changes that."""
    kind = type(law)
    elastic = isinstance(law, ElasticPower) and all(
        getattr(kind, name) is getattr(ElasticPower, name)
        for name in ("elastic_force", "elastic_energy", "largest_depth")
    )
    if not elastic or kind.__call__ is Hertz.__call__:
        return elastic
    damped = isinstance(law, PowerLaw) and type(law.damping_speed) in (TouchSpeed, DepthSpeed)
    return damped and kind.__call__ is Hysteresis.__call__ and kind.forgets is Hysteresis.forgets


def _refuse(where: str, what: str, allowed: str) -> NoReturn:
    raise InputError(
        f"{where} = {what}: not covered by the reduced formulation; allowed: {allowed}. "
        "The redundant formulation, support_exudyn.simulate, covers it."
    )
