"""How a tree starts: its rates, its static equilibrium, and what its clearance pins remember."""

import math

import numpy as np
from scipy.optimize import root

from support_exudyn.formulations.contract import Failure, SimulationError
from support_exudyn.formulations.limits import CENTRING
from support_exudyn.formulations.tree.branches import Matrix, Tree
from support_exudyn.formulations.tree.dynamics import TreePosture, mass_moment
from support_exudyn.formulations.tree.forces import Forces, TreeClearanceJoint
from support_exudyn.formulations.tree.loads import push
from support_exudyn.mechanics.contact_state import PinMemory
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.pressed_pins import EffectiveMasses
from support_exudyn.scenario.scenario import Scenario
from user_forces.normal.law import LoadError
from user_forces.values.value import InputError

STILL = 1e-9  # [m/s] by which velocities of a machine may differ from those that its ideal pins allow
BALANCED = 1e-9  # moment that may be left in equilibrium, as a share of the weight times 1 m
UNSETTLED = "Is every body held by pins and actuators, and does gravity press the pins? Else start concentric."


def rates(tree: Tree, scenario: Scenario) -> Matrix:
    """Rates of the coordinates at the start [rad/s], shape (n,).

    Raises InputError if the machine's velocities tear its ideal pins.
    """
    velocity = _body_velocities(tree, scenario).reshape(-1, 3)[tree.order_of_links]
    spins = [*velocity[:, 2].tolist(), 0.0]  # the last one: the ground's, number -1
    found = np.array([spins[n] - spins[link.carrier] for n, link in enumerate(tree.links)])
    moving = TreePosture(tree, np.zeros((1, found.size)), found[None]).centre_velocity[0]
    for n, link in enumerate(tree.links):
        apart = math.dist(moving[n], velocity[n, :2])
        if apart > STILL:
            raise InputError(
                f"bodies.{link.name}.velocity: {apart:.3g} m/s off what ideal pins allow; allowed: 0"
            )
    return found


def _body_velocities(tree: Tree, scenario: Scenario) -> Matrix:
    """Velocities of all bodies at the start, (3 b,) in the order of the linkage, with the drive's."""
    linkage = tree.linkage
    velocity = np.concatenate([[*body.velocity, body.spin] for body in linkage.bodies.values()])
    if all(drive.initial_speed == 0.0 for drive in scenario.drives_in_use):
        return velocity
    closed = kinetics_of(linkage)
    position = np.zeros_like(velocity)
    wanted = closed.rates(lambda name: scenario.drive_of(name).initial_speed)
    missing = wanted - closed.rows(position) @ velocity
    change, _ = closed.respond(position, np.zeros_like(velocity), missing)
    return np.asarray(velocity + change)


def settled(tree: Tree, scenario: Scenario, forces: Forces) -> Matrix:
    """Coordinates at rest under gravity [rad], shape (n,): elastic contacts without friction.

    Raises SimulationError if there is no such equilibrium or it is not found.
    """
    weight = sum(link.body.mass for link in tree.links) * math.hypot(*scenario.gravity)
    position = np.zeros(len(tree.links))

    def left(trial: Matrix, share: float) -> Matrix:
        forces(None, 0.0, 0, trial.tolist(), [0.0] * trial.size)
        for pin in forces.pins.values():
            _press(forces, pin, weight, share)
        still = TreePosture(tree, trial[None], 0.0 * trial[None])
        return np.asarray(forces.moments() + mass_moment(still, scenario.gravity)[0])

    try:
        for share in CENTRING:
            position = root(left, position, args=(share,), tol=1e-13).x
        balanced = np.abs(left(position, 0.0)).max(initial=0.0) <= BALANCED * max(weight, 1.0)
    except LoadError:
        balanced = False
    if not balanced:
        raise SimulationError(Failure("no static equilibrium was found", UNSETTLED, 0.0))
    return position


def _press(forces: Forces, pin: TreeClearanceJoint, load: float, share: float) -> None:
    """Add the elastic force of a clearance pin and that of a spring to its middle.

    load: that is to be held [N]. share: of the clearance by which the load may press the contact, and of the
    load that the spring holds at the wall.
    """
    place = pin.place()
    pull = share * load / pin.clearance
    if place.depth > 0.0:
        pressed = pin.contact.normal.force_in_search(place.depth, load, share * pin.clearance)
        pull += pressed / (place.depth + pin.clearance)
    x, y = pin.bore_centre()
    push(forces.links, forces.points, forces.work, pin.pair, x, y, -pull * place.x, -pull * place.y)


def first_memory(pin: TreeClearanceJoint, inverse_masses: EffectiveMasses) -> PinMemory:
    """What a clearance pin remembers at the start, at the stage evaluated last."""
    place = pin.place()
    closed = place.depth > 0.0
    speed = max(0.0, place.rate) if closed else 0.0
    return PinMemory(closed, speed, place.depth, place.rate).with_inverse_mass(inverse_masses.held)
