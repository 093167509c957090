"""What the reduced formulation covers; everything else is refused with what to do instead."""

from __future__ import annotations

from typing import NoReturn

from support_exudyn.formulations.compiled import is_compiling
from support_exudyn.formulations.reduced.models import MODELS, Model
from support_exudyn.model.columns import RigidColumn
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact
from user_forces.friction.ambrosio import Ambrosio
from user_forces.friction.frictionless import Frictionless
from user_forces.normal.damping_speed import DepthSpeed, TouchSpeed
from user_forces.normal.hertz import Hertz
from user_forces.normal.hysteresis import Hysteresis
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_law import ElasticPower, PowerLaw
from user_forces.values.value import InputError


def model_of(scenario: Scenario) -> Model:
    """The scenario's machine. Raises InputError if it is not covered."""
    model = MODELS.get(type(scenario.machine))
    if model is None:
        allowed = ", ".join(machine.__name__ for machine in MODELS)
        _refuse("machine", type(scenario.machine).__name__, allowed)
    return model


def check(scenario: Scenario) -> None:
    """Raise InputError if the reduced formulation does not cover the scenario."""
    if scenario.dimensions == 3:
        _refuse("dimensions", "3", "2")
    model = model_of(scenario)
    if type(scenario.drive) not in model.DRIVES:
        allowed = ", ".join(drive.__name__ for drive in model.DRIVES)
        _refuse("drive", type(scenario.drive).__name__, allowed)
    for name, drive in scenario.drives.items():
        if drive != scenario.drive:
            _refuse(f"drives.{name}", type(drive).__name__, "one drive for all parts")
    if scenario.start != "concentric":
        _refuse("start", repr(scenario.start), "'concentric'")
    for name, column in scenario.columns.items():
        if not isinstance(column, RigidColumn):
            _refuse(f"columns.{name}", type(column).__name__, "RigidColumn, whose length is no free coordinate")
    for name, load in scenario.loads.items():
        _refuse(f"loads.{name}", type(load).__name__, "no loads")
    for name, pin in scenario.pins.items():
        if refused := pin.refused_by("reduced"):
            _refuse(f"pins.{name}{refused.part}", refused.what, refused.allowed)
    for name, part in scenario.own_bodies.items():
        _refuse(f"parts.{name}", type(part).__name__, "Lumped")
    for name in scenario.clearance_pins:
        if name != model.PIN:
            _refuse(f"pins.{name}", "ClearancePin", f"clearance in {model.PIN} only")
    _check_backend(scenario, model)
    if scenario.linkage.cranks and model.PIN not in scenario.clearance_pins:
        _refuse(f"pins.{model.PIN}", "IdealPin", "a loose pin: otherwise nothing is free to move")


def _check_backend(scenario: Scenario, model: Model) -> None:
    """Raise InputError if what is to evaluate the contact cannot."""
    backend = scenario.solver.backend
    if backend == "symbolic":
        _refuse("solver.backend", "'symbolic'", "'auto', 'python', 'compiled'")
    pin = scenario.clearance_pins.get(model.PIN)
    if backend == "compiled" and not is_compiling():
        raise InputError(
            "solver.backend = 'compiled': numba is not installed; allowed: 'auto', 'python', or install the "
            "extra: pip install 'support-exudyn[fast]'"
        )
    if backend == "compiled" and pin and not can_be_compiled(pin.contact):
        laws = f"{type(pin.contact.normal).__name__}, {type(pin.contact.friction).__name__}"
        _refuse(
            "solver.backend",
            f"'compiled' with the laws {laws}",
            "'auto', 'python', or laws derived from ElasticPower with Frictionless or Ambrosio",
        )


def can_be_compiled(contact: JournalContact) -> bool:
    """Whether the compiled functions know the laws of a contact, and there are compiled functions."""
    return (
        is_compiling() and has_power_form(contact.normal) and type(contact.friction) in (Frictionless, Ambrosio)
    )


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
        f"{where} = {what}: not covered by formulation = 'reduced'; allowed: {allowed}. "
        "formulation = 'redundant' covers it."
    )
