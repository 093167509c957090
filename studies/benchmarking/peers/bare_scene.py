"""The support as rigid bodies of the engine with constraints, its clearance pin marked and nothing in it."""

import math
from dataclasses import dataclass
from typing import Any

import exudyn
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyPosition,
    MarkerBodyRigid,
    NodeRigidBody2D,
    ObjectConnectorDistance,
    ObjectGround,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
)

from studies.benchmarking.peers.plain_support import PIN, plain_support
from support_exudyn.model.linkage import GROUND, Body
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError, Vector2


@dataclass
class BareScene:
    """The model without its contact; to be assembled once that has been added.

    container: owns the system, and must live as long as it. actuators: the engine's objects and their lengths
    at the start [m]. contact: of the clearance pin, if there is one; bore, journal: markers of both its
    centres. ends: of bore and journal, the body's number and the centre's place in its frame [m]. driven:
    extension that the engine has [m].
    """

    scenario: Scenario
    container: Any
    mbs: Any
    nodes: dict[str, Any]
    actuators: list[tuple[Any, float]]
    contact: Any = None
    bore: Any = None
    journal: Any = None
    ends: Any = ()
    driven: float = 0.0

    def drive_to(self, t: float) -> None:
        """Set actuators to where they are at time t [s]."""
        extension = self.scenario.drive.extension(t)
        if extension == self.driven:
            return
        self.driven = extension
        for item, length in self.actuators:
            self.mbs.SetObjectParameter(item, "distance", length + extension)


class _BareBuilder:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.linkage = scenario.machine.linkage()
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround())
        self.nodes: dict[str, Any] = {}
        self.objects: dict[str, Any] = {}
        for name, body in self.linkage.bodies.items():
            self.add_body(name, body)

    def add_body(self, name: str, body: Body) -> None:
        node = self.mbs.AddNode(NodeRigidBody2D(referenceCoordinates=[*body.centre, body.angle]))
        item = self.mbs.AddObject(ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        self.nodes[name], self.objects[name] = node, item
        gx, gy = self.scenario.gravity
        if gx or gy:
            centre = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=item, localPosition=[0, 0, 0]))
            weight = [body.mass * gx, body.mass * gy, 0.0]
            self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))

    def end(self, body: str, point: Vector2) -> tuple[Any, list[float]]:
        """The engine's number of a body and the place of a point in its frame [m]."""
        if body == GROUND:
            return self.ground, [*point, 0.0]
        place = self.linkage.bodies[body]
        c, s = math.cos(place.angle), math.sin(place.angle)
        x, y = point[0] - place.centre[0], point[1] - place.centre[1]
        return self.objects[body], [c * x + s * y, c * y - s * x, 0.0]

    def marker(self, body: str, point: Vector2) -> Any:
        number, local = self.end(body, point)
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=number, localPosition=local))

    def pair(self, first: str, first_point: Vector2, second: str, second_point: Vector2) -> list[Any]:
        return [self.marker(first, first_point), self.marker(second, second_point)]

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
        return BareScene(self.scenario, self.container, self.mbs, self.nodes, actuators)


def bare_scene(scenario: Scenario, aside: float = 0.0) -> BareScene:
    """Bodies, weights, ideal pins, actuators of a scenario, and markers for its clearance pin.

    Arguments:
        scenario: see `plain_support`.
        aside: of the bore's centre from where it belongs, along x [m].

    Raises InputError if the scenario is not covered.
    """
    support = plain_support(scenario)
    builder = _BareBuilder(scenario)
    scene = builder.scene(PIN)
    pin, (x, y) = builder.linkage.pins[PIN], support.bore
    scene.contact = support.contact
    scene.ends = builder.end(pin.first, support.bore), builder.end(pin.second, support.bore)
    scene.bore = builder.marker(pin.first, (x + aside, y))
    scene.journal = builder.marker(pin.second, support.bore)
    return scene


def ideal_scene(scenario: Scenario) -> BareScene:
    """The model of a scenario without clearance pins; raises InputError if it is not covered."""
    loaded = scenario.acting_loads or scenario.blocks
    if scenario.clearance_pins or scenario.actuators or scenario.friction_pins or loaded:
        raise InputError("a competitor with ideal pins takes rigid actuators, no loads and no friction")
    return _BareBuilder(scenario).scene()
