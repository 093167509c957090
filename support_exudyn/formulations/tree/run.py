"""The run of the tree formulation: scenario in, outcome out; what is not covered is refused with what to do."""

import math
from typing import NoReturn

import numpy as np

from support_exudyn.formulations.contract import Progress
from support_exudyn.formulations.tree.branches import ClearanceError, LoopError, Tree, branches
from support_exudyn.formulations.tree.drive_pieces import pieces
from support_exudyn.formulations.tree.dynamics import TreePosture, pin_inverse_mass
from support_exudyn.formulations.tree.engine import Engine
from support_exudyn.formulations.tree.forces import Forces
from support_exudyn.formulations.tree.integration import Integration
from support_exudyn.formulations.tree.outcome import EvaluatedRun
from support_exudyn.formulations.tree.start import first_memory, rates, settled
from support_exudyn.mechanics.oil_column import fill
from support_exudyn.mechanics.pressed_pins import EffectiveMasses, inverse_masses
from support_exudyn.mechanics.trajectory import Outcome
from support_exudyn.model.actuators import CylinderAndRod
from support_exudyn.model.hydraulic_cylinder import HydraulicCylinder
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

INSTEAD = "formulation = 'redundant' covers it."


def check(scenario: Scenario) -> None:
    """Raise InputError if the tree formulation does not cover the scenario."""
    if scenario.dimensions == 3:
        _refuse("dimensions", "3", "2")
    if scenario.solver.backend in ("symbolic", "compiled"):
        # setting the variables of an expression and asking for it takes longer than calling the law
        _refuse("solver.backend", repr(scenario.solver.backend), "'auto', 'python'")
    for name, actuator in scenario.actuators.items():
        if isinstance(actuator, HydraulicCylinder):
            _refuse(f"actuators.{name}", "HydraulicCylinder, whose pressures are coordinates too", "OilColumn")
        if isinstance(actuator, CylinderAndRod):
            _refuse(f"actuators.{name}", "CylinderAndRod, whose slide closes a loop", "OilColumn")
    for name, load in scenario.acting_loads.items():
        _refuse(f"loads.{name}", type(load).__name__, "no loads")
    for name, pin in scenario.pins.items():
        if refused := pin.refused_by("tree"):
            _refuse(f"pins.{name}{refused.part}", refused.what, refused.allowed)
    for name, guide in scenario.guides.items():
        if refused := guide.refused_by("tree"):
            _refuse(f"guides.{name}{refused.part}", refused.what, refused.allowed)
    for name, part in scenario.own_bodies.items():
        if part.jack.oil is None:
            _refuse(f"parts.{name}.jack", "rigid, a constraint that closes a loop", "OilColumn")
    linkage = scenario.linkage
    for kind, items in (("slides", linkage.slides), ("cranks", linkage.cranks), ("gears", linkage.gears)):
        for name in items:
            _refuse(f"{kind}.{name}", "a constraint that ties a branch to the ground", f"no {kind}")
    for name in linkage.actuators:
        if name not in scenario.oil_columns:
            _refuse(f"actuators.{name}", "rigid, a constraint that closes a loop", "OilColumn")
    try:
        branches(linkage, scenario.clearance_pins)
    except LoopError as loop:
        _refuse(f"pins.{loop}", "ideal, which closes a loop", "clearance in one pin of every loop")
    except ClearanceError as with_clearance:
        _refuse(f"bodies.{with_clearance}", "no chain of ideal pins to the ground", "exactly one")


def _refuse(where: str, what: str, allowed: str) -> NoReturn:
    raise InputError(f"{where} = {what}: not covered by formulation = 'tree'; allowed: {allowed}. {INSTEAD}")


CLEARANCE = 1e-3  # [m], stands for that of a machine without any
SLOWEST_FALL = 1e-3  # [m/s], for scenes without gravity
OF_THE_DRIVE = 1e-3  # share of the error that the drive's cubics may have


def run(scenario: Scenario, progress: Progress) -> Outcome:
    """Run a scenario. Raises SimulationError if it cannot be finished."""
    linkage, with_clearance = scenario.linkage, scenario.clearance_pins
    tree = branches(linkage, with_clearance)
    preloaded = fill(linkage, scenario.oil_columns, scenario.gravity)
    forces = Forces(tree, scenario, preloaded)
    smallest = min((pin.contact.bearing.clearance for pin in with_clearance.values()), default=CLEARANCE)
    drives = [scenario.drive_of(name) for name in preloaded]
    drive = pieces(drives, scenario.duration, OF_THE_DRIVE * scenario.solver.tolerance * smallest)
    forces.cubic[:] = drive[0].cubic
    velocity = rates(tree, scenario)
    position = np.zeros_like(velocity)
    if scenario.start == "settled":
        position, velocity = settled(tree, scenario, forces), 0.0 * velocity
    forces(None, 0.0, 0, position.tolist(), velocity.tolist())

    def find_inverse_masses(name: str) -> EffectiveMasses:
        now = TreePosture(tree, np.array([forces.position]), np.array([forces.velocity]))
        normals = [(linkage.pins[other], pin.normal()) for other, pin in forces.pins.items() if other != name]
        pressed = [(place, along) for place, along in normals if along is not None]
        answers = pin_inverse_mass(now, linkage.pins[name], pressed)
        return inverse_masses(answers, forces.pins[name].frame())

    for name, pin in forces.pins.items():
        pin.start = pin.place()
        pin.remember(first_memory(pin, find_inverse_masses(name)))
    engine = Engine(tree, forces, scenario.gravity, position, velocity)
    error, most_steps = largest_error(tree, scenario), scenario.solver.most_steps
    integration = Integration(engine, forces, find_inverse_masses, drive, error, most_steps, progress)
    integration.go()
    return EvaluatedRun(tree, scenario, preloaded, integration).outcome()


def largest_error(tree: Tree, scenario: Scenario) -> float:
    """Root mean square error that a step may have [rad], [rad/s].

    No coordinate alone moves a clearance pin's journal by more than `solver.tolerance` times the speed of a
    fall through half its clearance. Within a step that moves it by far less than so much of the clearance: it
    is the speed that counts.
    """
    weight = math.hypot(*scenario.gravity)
    allowed = []
    for name, pin in scenario.clearance_pins.items():
        speed = max(math.sqrt(weight * pin.contact.bearing.clearance), SLOWEST_FALL)
        place = tree.linkage.pins[name]
        movers = {n for body in (place.first, place.second) for n in tree.movers(body)}
        levers = [math.hypot(*tree.arm(n, place.second_point)) for n in movers]
        allowed.append(speed / max(levers, default=1.0))
    lever = max(math.hypot(*tree.arm(n, link.body.centre)) for n, link in enumerate(tree.links))
    everywhere = max(math.sqrt(weight * CLEARANCE), SLOWEST_FALL) / max(lever, CLEARANCE)
    return scenario.solver.tolerance * min(allowed, default=everywhere) / math.sqrt(2.0 * len(tree.links))
