"""What the reduced formulation covers; everything else is refused with what to do instead."""

from typing import NoReturn, cast

from support_exudyn.formulations.reduced import slider_crank, support_model
from support_exudyn.formulations.reduced.machine_model import Model
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.actuators import RigidActuator
from support_exudyn.model.machine import Machine
from support_exudyn.scenario.scenario import Scenario
from user_forces.compilation.flat import UnwrittenLawError, law_source
from user_forces.values.value import InputError

# the machines that are covered; a new one is a file with its formulas and its model, and a line here
MODELS: dict[type[Machine], Model] = {
    HydraulicSupport: cast(Model, support_model),
    SliderCrank: cast(Model, slider_crank),
}
WRITTEN = "laws written with the functions of user_forces.expressions.scalar, with `where` in place of `if`"


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
    for name, actuator in scenario.actuators.items():
        if not isinstance(actuator, RigidActuator):
            _refuse(
                f"actuators.{name}",
                type(actuator).__name__,
                "RigidActuator, whose length is no free coordinate",
            )
    for name, load in scenario.acting_loads.items():
        _refuse(f"loads.{name}", type(load).__name__, "no loads")
    for name, pin in scenario.pins.items():
        if refused := pin.refused_by("reduced"):
            _refuse(f"pins.{name}{refused.part}", refused.what, refused.allowed)
    for name, guide in scenario.guides.items():
        if refused := guide.refused_by("reduced"):
            _refuse(f"guides.{name}{refused.part}", refused.what, refused.allowed)
    for name, part in scenario.own_bodies.items():
        _refuse(f"parts.{name}", type(part).__name__, "Lumped")
    for name in scenario.clearance_pins:
        if name != model.PIN:
            _refuse(f"pins.{name}", "ClearancePin", f"clearance in {model.PIN} only")
    try:
        for clearance_pin in scenario.clearance_pins.values():
            law_source(clearance_pin.contact)
    except UnwrittenLawError as error:
        _refuse(f"pins.{model.PIN}.contact", str(error), WRITTEN)
    if scenario.solver.backend not in ("auto", "compiled"):
        _refuse("solver.backend", repr(scenario.solver.backend), "'auto', 'compiled'")
    if scenario.linkage.cranks and model.PIN not in scenario.clearance_pins:
        _refuse(f"pins.{model.PIN}", "IdealPin", "a clearance pin: otherwise nothing is free to move")


def _refuse(where: str, what: str, allowed: str) -> NoReturn:
    raise InputError(
        f"{where} = {what}: not covered by formulation = 'reduced'; allowed: {allowed}. "
        "formulation = 'redundant' covers it."
    )
