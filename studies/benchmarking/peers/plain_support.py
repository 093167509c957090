"""The support as programs of others take it: the machine's data, and the law of its contact in plain floats.

Four links as a tree, two driven columns, a pin in its bore. The tree begins at the front base pin: front
link, shield, canopy on the shield, rear link on the shield. Its last link ends in the journal, whose bore is
fixed to the base. All frames lie as the ground does in the start posture, so that joint angles begin at zero.
Nothing here comes from the package but the machine's data and the law's constants.
"""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.model.drives.drive import CubicStep, Held
from support_exudyn.model.linkage import GROUND, LinearActuator
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.single_run import paused_collector
from user_forces.contact import JournalContact
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.normal.power_laws import LankaraniNikravesh
from user_forces.values.value import InputError, Vector2

PIN = "rear_base"
# links of the tree with their parents and the pins between both
TREE = (
    ("front_link", GROUND, "front_base"),
    ("shield", "front_link", "front_shield"),
    ("canopy", "shield", "shield_canopy"),
    ("rear_link", "shield", "rear_shield"),
)
COLUMN_LINK, JOURNAL_LINK = 2, 3  # places in the tree of the canopy and of the rear link
Series = npt.NDArray[np.float64]
# force on the journal from its place, velocity, spin in the bore and initial impact velocity (0: not known):
# two components [N], moment about its centre [N m]
JournalForce = Callable[[float, float, float, float, float, float], tuple[float, float, float]]


class Link(NamedTuple):
    """A link: place of its parent in the tree, -1 for the ground; its pin there and its centre of mass [m].

    Mass in kg, inertia about the centre of mass in kg m^2.
    """

    parent: int
    pin: Vector2
    centre: Vector2
    mass: float
    inertia: float


class PeerRun(NamedTuple):
    """Time [s] and magnitude of the force in the clearance pin [N] at the ends of all steps."""

    time: Series
    force: Series


@dataclass(frozen=True)
class PlainSupport:
    """The machine in its start posture; x forward, y up.

    links: in the order of TREE. columns: from the ground to the canopy. bore: centre of the bore and of the
    journal [m]. clearance: radial [m]. force: of the bore on the journal. drive: of both columns. gravity:
    [m/s^2].
    """

    links: tuple[Link, ...]
    columns: tuple[LinearActuator, ...]
    bore: Vector2
    clearance: float
    force: JournalForce
    drive: CubicStep | Held
    gravity: Vector2


def journal_force(contact: JournalContact) -> JournalForce:
    """The law of the contact in plain floats, as a user of any program writes it.

    N = K depth^1.5 (1 + chi rate / v0) along the line of centres, not less than zero; v0 is the initial
    impact velocity, not less than the law's rest velocity. Friction by Ambrosio acts at the contact point.
    Raises InputError for other laws.
    """
    law, friction = contact.normal, contact.friction
    if not isinstance(law, LankaraniNikravesh) or law.exponent != 1.5:
        raise InputError(f"normal = {law}: allowed here: LankaraniNikravesh with exponent 1.5")
    if not isinstance(friction, (Ambrosio, Frictionless)):
        raise InputError(f"friction = {friction}: allowed here: Ambrosio, Frictionless")
    stiffness, factor, floor = law.stiffness, law.damping_factor, law.rest_velocity
    clearance, bore_radius = contact.bearing.clearance, contact.bearing.bore_radius
    coefficient, static, ramp = 0.0, 0.0, 1.0
    if isinstance(friction, Ambrosio):
        coefficient, static = friction.sliding_coefficient, friction.static_speed
        ramp = friction.dynamic_speed - static

    def force(
        x: float, y: float, vx: float, vy: float, spin: float, speed: float
    ) -> tuple[float, float, float]:
        eccentricity = math.hypot(x, y)
        depth = eccentricity - clearance
        if depth <= 0.0:
            return 0.0, 0.0, 0.0
        nx, ny = x / eccentricity, y / eccentricity
        rate = nx * vx + ny * vy
        damping = 1.0 + factor * rate / max(speed or rate, floor)
        normal = max(0.0, stiffness * depth * math.sqrt(depth) * damping)
        if not coefficient:
            return -normal * nx, -normal * ny, 0.0
        arm = bore_radius + 0.5 * depth - eccentricity
        slip = nx * vy - ny * vx + arm * spin
        sliding = -math.copysign(coefficient * min(1.0, max(0.0, (abs(slip) - static) / ramp)) * normal, slip)
        return -normal * nx - sliding * ny, -normal * ny + sliding * nx, arm * sliding

    return force


def plain_support(scenario: Scenario) -> PlainSupport:
    """The data of a scenario.

    Arguments:
        scenario: HydraulicSupport in the plane, rigid columns, rear-link pin with clearance and its bore in
            the base, LankaraniNikravesh with exponent 1.5, no friction or Ambrosio's, start "concentric".

    Raises InputError if the scenario is not covered.
    """
    machine, drive = scenario.machine, scenario.drive
    if not isinstance(machine, HydraulicSupport) or scenario.dimensions != 2:
        raise InputError("machine: allowed here: HydraulicSupport, in the plane")
    if not isinstance(drive, (CubicStep, Held)):
        raise InputError("drive: allowed here: CubicStep, Held")
    others = (scenario.actuators, scenario.drives, scenario.own_bodies, scenario.friction_pins)
    if any(others) or scenario.acting_loads or scenario.blocks or scenario.start != "concentric":
        raise InputError("allowed here: rigid columns, one drive, no loads and start = 'concentric'")
    if tuple(scenario.clearance_pins) != (PIN,) or scenario.clearance_pins[PIN].bore != "first":
        raise InputError(f"allowed here: one clearance pin, {PIN}, with its bore in the base")
    contact = scenario.clearance_pins[PIN].contact
    linkage = machine.linkage()
    places = {name: n for n, (name, _, _) in enumerate(TREE)}
    links = []
    for name, parent, pin in TREE:
        body, point = linkage.bodies[name], linkage.pins[pin].first_point
        links.append(Link(places.get(parent, -1), point, body.centre, body.mass, body.inertia))
    return PlainSupport(
        links=tuple(links),
        columns=tuple(linkage.actuators.values()),
        bore=linkage.pins[PIN].first_point,
        clearance=contact.bearing.clearance,
        force=journal_force(contact),
        drive=drive,
        gravity=(scenario.gravity[0], scenario.gravity[1]),
    )


@contextmanager
def undisturbed() -> Iterator[None]:
    """The engine is silent and garbage is not collected: neither is part of what is measured."""
    with quiet_engine(), paused_collector():
        yield
