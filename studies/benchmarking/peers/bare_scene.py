"""A machine in the engine's redundant coordinates, its clearance pin marked and nothing in it."""

import math
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyPosition,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodePointGround,
    NodeRigidBody2D,
    ObjectConnectorCoordinate,
    ObjectConnectorDistance,
    ObjectGround,
    ObjectJointPrismatic2D,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
)

from support_exudyn.machines.four_column_support import HydraulicSupport
from support_exudyn.machines.slider_crank import SliderCrank
from support_exudyn.model.drives.drive import Steady
from support_exudyn.model.linkage import GROUND, Body, Linkage, Slide
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact
from user_forces.friction.laws import Frictionless
from user_forces.values.value import InputError, Vector2


@dataclass
class BareScene:
    """The model without its contact; to be assembled once that has been added.

    container: owns the system, and must live as long as it. actuators: the engine's objects and their lengths
    at the start [m]. contact: of the clearance pin, if there is one; bore, journal: markers of both its
    centres; link: the body, not the ground or the slider, that it ends.
    """

    scenario: Scenario
    linkage: Linkage
    container: Any
    mbs: Any
    nodes: dict[str, Any]
    actuators: list[tuple[Any, float]]
    cranks: list[Any]
    contact: Any = None
    bore: Any = None
    journal: Any = None
    link: str = ""
    driven: float = 0.0  # extension that the engine has [m] or [rad]

    def drive_to(self, t: float) -> None:
        """Set actuators or cranks to where they are at time t [s]."""
        extension = self.scenario.drive.extension(t)
        if extension == self.driven:
            return
        self.driven = extension
        for item, length in self.actuators:
            self.mbs.SetObjectParameter(item, "distance", length + extension)
        for item in self.cranks:
            self.mbs.SetObjectParameter(item, "offset", extension)

    def first(self, body: str) -> int:
        """The place of a body's first coordinate in the vector of all."""
        return int(self.mbs.systemData.GetNodeLTGODE2(self.nodes[body])[0])

    def traced(self, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places x, y [m] of the machine's traced point from the vectors of coordinates, one a row."""
        (point,) = self.linkage.points.values()
        body, first = self.linkage.bodies[point.body], self.first(point.body)
        dx, dy = point.point[0] - body.centre[0], point.point[1] - body.centre[1]
        c, s = np.cos(positions[:, first + 2]), np.sin(positions[:, first + 2])
        x = body.centre[0] + positions[:, first] + c * dx - s * dy
        y = body.centre[1] + positions[:, first + 1] + s * dx + c * dy
        return x, y


def clearance_contact(scenario: Scenario) -> tuple[str, JournalContact, str]:
    """Name, contact and body of the bore ("first" or "second") of the one clearance pin, or InputError."""
    if not isinstance(scenario.machine, (HydraulicSupport, SliderCrank)):
        raise InputError(f"machine = {type(scenario.machine).__name__}: allowed: HydraulicSupport, SliderCrank")
    if (
        len(scenario.clearance_pins) != 1
        or scenario.actuators
        or scenario.drives
        or scenario.own_bodies
        or scenario.friction_pins
        or scenario.acting_loads
        or scenario.blocks
        or scenario.start != "concentric"
    ):
        raise InputError(
            "a competitor takes one clearance pin, rigid actuators, one drive, no loads, start = 'concentric'"
        )
    ((name, pin),) = scenario.clearance_pins.items()
    return name, pin.contact, pin.bore


def smooth_slider_crank(scenario: Scenario) -> tuple[SliderCrank, float, JournalContact]:
    """Machine, speed of its crank [rad/s] and contact of the slider-crank that some competitors take.

    Raises InputError unless it is a SliderCrank driven by Steady, with a clearance slider pin without friction
    and with its bore in the slider, no gravity, start "concentric".
    """
    machine, drive = scenario.machine, scenario.drive
    name, contact, bore = clearance_contact(scenario)
    if not isinstance(machine, SliderCrank) or not isinstance(drive, Steady):
        raise InputError("this takes a SliderCrank and a Steady drive")
    if name != "slider_pin" or bore != "first" or any(scenario.gravity):
        raise InputError("this takes a clearance slider_pin with its bore in the slider, and no gravity")
    if not isinstance(contact.friction, Frictionless):
        raise InputError("friction: allowed here: Frictionless")
    return machine, drive.rate, contact


def joint_start(machine: SliderCrank, speed: float) -> tuple[list[float], list[float]]:
    """Joint coordinates of crank, rod on the crank and slider at the start, [rad] and [m], and their rates."""
    a = machine.start_angle
    bx, by = machine.crank_length * math.cos(a), machine.crank_length * math.sin(a)
    along = machine.slider_position(a) - bx
    turn, spin = math.atan2(-by, along), -speed * bx / along
    return [a, turn - a, machine.slider_position(a)], [speed, spin - speed, machine.slider_speed(a, speed)]


def start_velocities(machine: Any, speed: float) -> dict[str, tuple[float, float, float]]:
    """Velocities of centres [m/s] and spins [rad/s] of a slider-crank whose crank turns at a speed [rad/s]."""
    if not isinstance(machine, SliderCrank) or speed == 0.0:
        return {}
    a = machine.start_angle
    bx, by = machine.crank_length * math.cos(a), machine.crank_length * math.sin(a)
    vx, vy = -speed * by, speed * bx
    slider = machine.slider_speed(a, speed)
    rod = -vy / (machine.slider_position(a) - bx)
    return {
        "crank": (0.5 * vx, 0.5 * vy, speed),
        "rod": (0.5 * (vx + slider), 0.5 * vy, rod),
        "slider": (slider, 0.0, 0.0),
    }


class _BareBuilder:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.linkage = scenario.machine.linkage()
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround())
        self.nodes: dict[str, Any] = {}
        self.objects: dict[str, Any] = {}
        moving = start_velocities(scenario.machine, scenario.drive.initial_speed)
        for name, body in self.linkage.bodies.items():
            self.add_body(name, body, moving.get(name, (0.0, 0.0, 0.0)))

    def add_body(self, name: str, body: Body, velocity: tuple[float, float, float]) -> None:
        node = self.mbs.AddNode(
            NodeRigidBody2D(referenceCoordinates=[*body.centre, body.angle], initialVelocities=[*velocity])
        )
        item = self.mbs.AddObject(ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        self.nodes[name], self.objects[name] = node, item
        gx, gy = self.scenario.gravity
        if gx or gy:
            centre = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=item, localPosition=[0, 0, 0]))
            weight = [body.mass * gx, body.mass * gy, 0.0]
            self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))

    def marker(self, body: str, point: Vector2) -> Any:
        if body == GROUND:
            return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.ground, localPosition=[*point, 0.0]))
        place = self.linkage.bodies[body]
        c, s = math.cos(place.angle), math.sin(place.angle)
        x, y = point[0] - place.centre[0], point[1] - place.centre[1]
        local = [c * x + s * y, c * y - s * x, 0.0]
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.objects[body], localPosition=local))

    def pair(self, first: str, first_point: Vector2, second: str, second_point: Vector2) -> list[Any]:
        return [self.marker(first, first_point), self.marker(second, second_point)]

    def add_crank(self, body: str) -> Any:
        fixed = self.mbs.AddNode(NodePointGround())
        markers = [
            self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=fixed, coordinate=0)),
            self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=self.nodes[body], coordinate=2)),
        ]
        return self.mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers))

    def add_slide(self, slide: Slide) -> None:
        along = slide.direction - self.linkage.bodies[slide.body].angle
        across = slide.direction + 0.5 * math.pi
        self.mbs.AddObject(
            ObjectJointPrismatic2D(
                markerNumbers=self.pair(slide.body, slide.point, GROUND, slide.point),
                axisMarker0=[math.cos(along), math.sin(along), 0.0],
                normalMarker1=[math.cos(across), math.sin(across), 0.0],
            )
        )

    def scene(self, with_clearance: str = "") -> BareScene:
        for name, pin in self.linkage.pins.items():
            if name != with_clearance:
                ends = self.pair(pin.first, pin.first_point, pin.second, pin.second_point)
                self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=ends))
        actuators = []
        for one in self.linkage.actuators.values():
            ends = self.pair(one.foot, one.foot_point, one.head, one.head_point)
            item = ObjectConnectorDistance(markerNumbers=ends, distance=one.start_length)
            actuators.append((self.mbs.AddObject(item), one.start_length))
        cranks = [self.add_crank(crank.body) for crank in self.linkage.cranks.values()]
        for slide in self.linkage.slides.values():
            self.add_slide(slide)
        return BareScene(self.scenario, self.linkage, self.container, self.mbs, self.nodes, actuators, cranks)


def bare_scene(scenario: Scenario, aside: float = 0.0) -> BareScene:
    """Bodies, weights, ideal pins, actuators, crank and guide of a scenario, and markers for its clearance pin.

    aside: of the bore's centre from where it belongs, along x [m].
    """
    name, contact, bore_on = clearance_contact(scenario)
    builder = _BareBuilder(scenario)
    scene = builder.scene(name)
    pin = scene.linkage.pins[name]
    sides = [(pin.first, pin.first_point), (pin.second, pin.second_point)]
    (bore_body, (x, y)), journal = sides if bore_on == "first" else sides[::-1]
    scene.contact, scene.link = contact, pin.second
    scene.bore, scene.journal = builder.marker(bore_body, (x + aside, y)), builder.marker(*journal)
    return scene


def ideal_scene(scenario: Scenario) -> BareScene:
    """The model of a scenario without clearance pins; raises InputError if it is not covered."""
    loaded = scenario.acting_loads or scenario.blocks
    if scenario.clearance_pins or scenario.actuators or scenario.friction_pins or loaded:
        raise InputError("a competitor with ideal pins takes rigid actuators, no loads and no friction")
    return _BareBuilder(scenario).scene()
