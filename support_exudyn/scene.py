"""From a scenario to a model in the engine: bodies, pins, columns; nothing that was not asked for."""

from __future__ import annotations

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

from support_exudyn.loose_pin import LoosePin, recalled
from support_exudyn.machine import GROUND, Body, Column, Linkage, PinPlace
from support_exudyn.onset import PinMemory
from support_exudyn.pins import ClearancePin
from support_exudyn.plane import minus, rotated
from support_exudyn.scenario import Scenario
from user_forces.values import Vector2

INITIAL = exudyn.ConfigurationType.Initial
CURRENT = exudyn.ConfigurationType.Current


@dataclass(frozen=True)
class BodyItem:
    """A moving body in the engine: its node, object and first coordinate (x, y, angle follow)."""

    body: Body
    node: Any
    object: Any
    first: int

    def local(self, point: Vector2) -> Vector2:
        """A point of the start posture in the body's own axes, from its centre of mass [m]."""
        return rotated(minus(point, self.body.centre), -self.body.angle)


@dataclass(frozen=True)
class IdealItem:
    """An ideal pin in the engine: its object and the first of its two multipliers."""

    object: Any
    first: int


@dataclass(frozen=True)
class ColumnItem:
    """A driven column in the engine: its object and its multiplier."""

    column: Column
    object: Any
    multiplier: int


@dataclass(frozen=True)
class Scene:
    """The model of one scenario, assembled and ready for the solver."""

    scenario: Scenario
    linkage: Linkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    bodies: dict[str, BodyItem]
    ideal_pins: dict[str, IdealItem]
    loose_pins: dict[str, LoosePin]
    columns: dict[str, ColumnItem]

    def extend_columns(self, extension: float) -> None:
        """Make the columns longer than at the start by so much [m]."""
        for item in self.columns.values():
            self.mbs.SetObjectParameter(item.object, "distance", item.column.start_length + extension)

    def reset_memory(self) -> None:
        """Give every clearance pin the memory that belongs to the initial state of the bodies."""
        data = self.mbs.systemData.GetDataCoordinates(INITIAL)
        for pin in self.loose_pins.values():
            depth, rate = self._depth_and_rate(pin, INITIAL)
            touching = depth > 0.0
            data[pin.slots] = PinMemory(touching, max(0.0, rate) if touching else 0.0, depth, rate)
        self.mbs.systemData.SetDataCoordinates(data, INITIAL)

    def refresh_memory(self) -> None:
        """Tell every clearance pin that velocities have jumped; contacts that go on go on."""
        data = self.mbs.systemData.GetDataCoordinates()
        for pin in self.loose_pins.values():
            memory = recalled(data[pin.slots].tolist())
            depth, rate = self._depth_and_rate(pin, CURRENT)
            data[pin.slots] = memory._replace(depth=depth, rate=rate)
        self.mbs.systemData.SetDataCoordinates(data)

    def _depth_and_rate(self, pin: LoosePin, state: Any) -> tuple[float, float]:
        def relative(what: Any) -> tuple[float, float]:
            journal = self.mbs.GetMarkerOutput(pin.journal_marker, what, state)
            bore = self.mbs.GetMarkerOutput(pin.bore_marker, what, state)
            return float(journal[0] - bore[0]), float(journal[1] - bore[1])

        output = exudyn.OutputVariableType
        return pin.contact.gap_state(*relative(output.Position), *relative(output.Velocity))


class _Builder:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.linkage = scenario.machine.linkage()
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround())
        self.bodies = {name: self.add_body(body) for name, body in self.linkage.bodies.items()}

    def add_body(self, body: Body) -> BodyItem:
        node = self.mbs.AddNode(
            NodeRigidBody2D(
                referenceCoordinates=[*body.centre, body.angle],
                initialVelocities=[*body.velocity, body.spin],
            )
        )
        item = self.mbs.AddObject(ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        gx, gy = self.scenario.gravity
        if gx or gy:
            centre = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=item, localPosition=[0, 0, 0]))
            weight = [body.mass * gx, body.mass * gy, 0.0]
            self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=weight))
        return BodyItem(body, node, item, first=-1)

    def marker(self, body: str, point: Vector2) -> Any:
        """A marker on a body at a point of the start posture."""
        if body == GROUND:
            return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.ground, localPosition=[*point, 0.0]))
        item = self.bodies[body]
        return self.mbs.AddMarker(
            MarkerBodyRigid(bodyNumber=item.object, localPosition=[*item.local(point), 0.0])
        )

    def add_ideal(self, place: PinPlace) -> Any:
        markers = [self.marker(place.first, place.first_point), self.marker(place.second, place.second_point)]
        return self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=markers))

    def add_loose(self, place: PinPlace, pin: ClearancePin) -> LoosePin:
        ends = [(place.first, place.first_point), (place.second, place.second_point)]
        if pin.bore == "second":
            ends.reverse()
        (bore, bore_point), (journal, journal_point) = ends

        def local(body: str, point: Vector2) -> Vector2:
            return point if body == GROUND else self.bodies[body].local(point)

        def item(body: str) -> Any:
            return self.ground if body == GROUND else self.bodies[body].object

        def angle(body: str) -> float:
            return 0.0 if body == GROUND else self.bodies[body].body.angle

        both_move = GROUND not in (bore, journal)
        return LoosePin.add(
            self.mbs,
            pin.contact,
            bore=(item(bore), local(bore, bore_point)),
            journal=(item(journal), local(journal, journal_point)),
            turn=angle(journal) - angle(bore),
            bore_node=self.bodies[bore].node if both_move else None,
            bore_on_ground=bore == GROUND,
        )

    def add_column(self, column: Column) -> Any:
        markers = [self.marker(column.foot, column.foot_point), self.marker(column.head, column.head_point)]
        return self.mbs.AddObject(ObjectConnectorDistance(markerNumbers=markers, distance=column.start_length))

    def build(self) -> Scene:
        loose = {
            name: self.add_loose(self.linkage.pins[name], pin)
            for name, pin in self.scenario.clearance_pins.items()
        }
        ideal = {name: self.add_ideal(place) for name, place in self.linkage.pins.items() if name not in loose}
        columns = {name: self.add_column(column) for name, column in self.linkage.columns.items()}
        self.mbs.Assemble()
        data = self.mbs.systemData
        scene = Scene(
            scenario=self.scenario,
            linkage=self.linkage,
            container=self.container,
            mbs=self.mbs,
            bodies={
                name: BodyItem(item.body, item.node, item.object, int(data.GetNodeLTGODE2(item.node)[0]))
                for name, item in self.bodies.items()
            },
            ideal_pins={name: IdealItem(o, int(data.GetObjectLTGAE(o)[0])) for name, o in ideal.items()},
            loose_pins=loose,
            columns={
                name: ColumnItem(self.linkage.columns[name], o, int(data.GetObjectLTGAE(o)[0]))
                for name, o in columns.items()
            },
        )
        scene.reset_memory()
        return scene


def build(scenario: Scenario) -> Scene:
    """The engine's model of a scenario at its start, before any settling."""
    return _Builder(scenario).build()
