"""What the closed forms cover: a support or a slider-crank with one clearance pin, driven from its start."""

from typing import cast

from support_exudyn.formulations.compiled.closed_forms import slider_crank, support_model
from support_exudyn.formulations.compiled.closed_forms.machine_model import MachineModel
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.actuators import RigidActuator
from support_exudyn.model.machine import Machine
from support_exudyn.scenario.scenario import Scenario

# the machines that are covered; a new one is a file with its formulas and its model, and a line here
MODELS: dict[type[Machine], MachineModel] = {
    HydraulicSupport: cast(MachineModel, support_model),
    SliderCrank: cast(MachineModel, slider_crank),
}


def model_of(scenario: Scenario) -> MachineModel:
    """The scenario's machine, one of `MODELS`."""
    return MODELS[type(scenario.machine)]


def covers(scenario: Scenario) -> bool:
    """Whether the closed forms cover a scenario that the compiled formulation does."""
    model = MODELS.get(type(scenario.machine))
    if model is None or type(scenario.drive) not in model.DRIVES or scenario.start != "concentric":
        return False
    one_drive = all(drive == scenario.drive for drive in scenario.drives.values())
    rigid = all(isinstance(actuator, RigidActuator) for actuator in scenario.actuators.values())
    rubs = scenario.friction_pins or scenario.friction_guides
    plain = not (scenario.acting_loads or scenario.blocks or scenario.own_bodies or rubs)
    held = all(guide.holds for guide in scenario.guides.values())
    loose = [name for name, pin in scenario.pins.items() if not pin.holds]
    clearance = scenario.clearance_pins
    one_pin = all(name == model.PIN and name in clearance for name in loose)
    stateless = not any(pin.contact.friction.has_state for pin in clearance.values())
    moves = model.PIN in clearance or not scenario.linkage.cranks  # else nothing is free to move
    return one_drive and rigid and plain and held and one_pin and stateless and moves
