"""A machine in the engine's redundant coordinates, its loose pin's centres marked and nothing between them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
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
from support_exudyn.model.linkage import GROUND, Body, Column, Linkage, Slide
from support_exudyn.scenario.scenario import Scenario
from user_forces.contact import JournalContact
from user_forces.values.value import InputError, Vector2


@dataclass
class Frame:
    """Bodies, weights, ideal pins, columns, cranks and guides; to be assembled."""

    scenario: Scenario
    linkage: Linkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    nodes: dict[str, Any]
    columns: list[tuple[Any, float]]  # the engine's object and its length at the start [m]
    cranks: list[Any]
    driven: float = field(default=0.0, kw_only=True)  # extension that the engine has [m] or [rad]

    def drive_to(self, t: float) -> None:
        """Set columns or cranks to where they are at time t [s]."""
        extension = self.scenario.drive.extension(t)
        if extension == self.driven:
            return
        self.driven = extension
        for item, length in self.columns:
            self.mbs.SetObjectParameter(item, "distance", length + extension)
        for item in self.cranks:
            self.mbs.SetObjectParameter(item, "offset", extension)

    def first(self, body: str) -> int:
        """Where a body's coordinates begin in the vector of all."""
        return int(self.mbs.systemData.GetNodeLTGODE2(self.nodes[body])[0])


@dataclass
class BareScene(Frame):
    """The model without its contact; to be assembled once that has been added.

    bore, journal: markers of both centres. link: the body, not the ground or the slider, that the pin ends.
    """

    contact: JournalContact
    bore: Any
    journal: Any
    link: str

    @property
    def bore_on_ground(self) -> bool:
        """Whether the bore's body is the ground."""
        ((name, pin),) = self.scenario.clearance_pins.items()
        place = self.linkage.pins[name]
        return (place.first if pin.bore == "first" else place.second) == GROUND


def loose_contact(scenario: Scenario) -> tuple[str, JournalContact, str]:
    """Name, contact and body of the bore ("first" or "second") of the one loose pin; InputError otherwise."""
    if not isinstance(scenario.machine, (HydraulicSupport, SliderCrank)):
        raise InputError(f"machine = {type(scenario.machine).__name__}: allowed: HydraulicSupport, SliderCrank")
    if (
        len(scenario.clearance_pins) != 1
        or scenario.columns
        or scenario.drives
        or scenario.own_bodies
        or scenario.friction_pins
        or scenario.loads
        or scenario.start != "concentric"
    ):
        raise InputError(
            "a competitor takes one loose pin, rigid columns, one drive, no loads and start = 'concentric'"
        )
    ((name, pin),) = scenario.clearance_pins.items()
    return name, pin.contact, pin.bore


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


def bare_scene(scenario: Scenario, aside: float = 0.0) -> BareScene:
    """Bodies, weights, ideal pins, columns, crank and guide of a scenario, and markers for its loose pin.

    aside: of the bore's centre from where it belongs, along x [m].
    """
    name, contact, bore_on = loose_contact(scenario)
    return _Builder(scenario).build(name, contact, bore_on, aside)


def ideal_frame(scenario: Scenario) -> Frame:
    """The same of a scenario without loose pins."""
    if scenario.clearance_pins or scenario.columns or scenario.loads or scenario.friction_pins:
        raise InputError("a competitor with ideal pins takes rigid columns, no loads and no friction")
    return _Builder(scenario).frame(None)


class _Builder:
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

    def add_column(self, column: Column) -> tuple[Any, float]:
        ends = [
            self.marker(column.foot, column.foot_point),
            self.marker(column.head, column.head_point),
        ]
        item = self.mbs.AddObject(ObjectConnectorDistance(markerNumbers=ends, distance=column.start_length))
        return item, column.start_length

    def add_crank(self, body: str) -> Any:
        fixed = self.mbs.AddNode(NodePointGround())
        markers = [
            self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=fixed, coordinate=0)),
            self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=self.nodes[body], coordinate=2)),
        ]
        return self.mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers))

    def add_slide(self, slide: Slide) -> None:
        markers = [self.marker(slide.body, slide.point), self.marker(GROUND, slide.point)]
        along = slide.direction - self.linkage.bodies[slide.body].angle
        across = slide.direction + 0.5 * math.pi
        self.mbs.AddObject(
            ObjectJointPrismatic2D(
                markerNumbers=markers,
                axisMarker0=[math.cos(along), math.sin(along), 0.0],
                normalMarker1=[math.cos(across), math.sin(across), 0.0],
            )
        )

    def frame(self, loose: str | None) -> Frame:
        for name, place in self.linkage.pins.items():
            if name != loose:
                ends = [
                    self.marker(place.first, place.first_point),
                    self.marker(place.second, place.second_point),
                ]
                self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=ends))
        columns = [self.add_column(column) for column in self.linkage.columns.values()]
        cranks = [self.add_crank(crank.body) for crank in self.linkage.cranks.values()]
        for slide in self.linkage.slides.values():
            self.add_slide(slide)
        return Frame(self.scenario, self.linkage, self.container, self.mbs, self.nodes, columns, cranks)

    def build(self, loose: str, contact: JournalContact, bore_on: str, aside: float) -> BareScene:
        frame = self.frame(loose)
        place = self.linkage.pins[loose]
        sides = [(place.first, place.first_point), (place.second, place.second_point)]
        (bore_body, bore_point), (journal_body, journal_point) = sides if bore_on == "first" else sides[::-1]
        return BareScene(
            **vars(frame),
            contact=contact,
            bore=self.marker(bore_body, (bore_point[0] + aside, bore_point[1])),
            journal=self.marker(journal_body, journal_point),
            link=place.second,
        )


def traced(scene: BareScene, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """x, y [m] of the machine's traced point from the vectors of coordinates, one a row."""
    (point,) = scene.linkage.points.values()
    body, first = scene.linkage.bodies[point.body], scene.first(point.body)
    dx, dy = point.point[0] - body.centre[0], point.point[1] - body.centre[1]
    c, s = np.cos(positions[:, first + 2]), np.sin(positions[:, first + 2])
    x = body.centre[0] + positions[:, first] + c * dx - s * dy
    y = body.centre[1] + positions[:, first + 1] + s * dx + c * dy
    return x, y
