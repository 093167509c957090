"""From a scenario to a model in the engine: bodies, pins, columns; nothing that was not asked for."""

from __future__ import annotations

import math
from functools import cached_property, partial, singledispatchmethod
from typing import Any

import exudyn
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    NodePointGround,
    NodeRigidBody2D,
    ObjectConnectorCoordinate,
    ObjectConnectorDistance,
    ObjectConnectorSpringDamper,
    ObjectGround,
    ObjectJointPrismatic2D,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
)

from support_exudyn.formulations.redundant.clearance.clearance_pin import LoosePin
from support_exudyn.formulations.redundant.clearance.connector import Mount, PinConnector, frame
from support_exudyn.formulations.redundant.scene.bushing import BushingItem
from support_exudyn.formulations.redundant.scene.cylinder_item import CylinderItem
from support_exudyn.formulations.redundant.scene.driven_parts import OilColumnItem, by_drive
from support_exudyn.formulations.redundant.scene.engine_scene import CompliantItem
from support_exudyn.formulations.redundant.scene.load_item import add_load
from support_exudyn.formulations.redundant.scene.pin_friction import PinFriction, rotations
from support_exudyn.formulations.redundant.scene.scene import Scene
from support_exudyn.mechanics.body_coordinates import BodyItem, ColumnItem, CrankItem, IdealItem, SlideItem
from support_exudyn.mechanics.cylinder_chambers import FilledCylinder, fill_cylinders
from support_exudyn.mechanics.oil_column import fill
from support_exudyn.model.bushing_pin import BushingPin
from support_exudyn.model.linkage import GROUND, Body, Column, Crank, Slide
from support_exudyn.model.pins import ClearancePin, IdealPin, Pin
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2


class _Builder:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.linkage = scenario.linkage
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self._markers: dict[tuple[str, Vector2], Any] = {}  # by body and point of the start posture
        self.ideal: dict[str, Any] = {}  # joints by name
        self.connectors: dict[str, PinConnector] = {}  # of clearance pins
        self.compliant: dict[str, CompliantItem] = {}
        self.bodies = {name: self.add_body(body) for name, body in self.linkage.bodies.items()}

    @cached_property
    def ground(self) -> Any:
        """The engine's body that does not move, made if something stands on it."""
        return self.mbs.AddObject(ObjectGround())

    @cached_property
    def fixed(self) -> Any:
        """A coordinate that stays zero, made if there is a crank."""
        return self.mbs.AddMarker(
            MarkerNodeCoordinate(nodeNumber=self.mbs.AddNode(NodePointGround()), coordinate=0)
        )

    def add_body(self, body: Body) -> BodyItem:
        node = self.mbs.AddNode(
            NodeRigidBody2D(
                referenceCoordinates=[*body.centre, body.angle],
                initialVelocities=[*body.velocity, body.spin],
            )
        )
        item = self.mbs.AddObject(ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        return BodyItem(body, node, item, first=-1)

    def add_weight(self, name: str, body: Body) -> Any:
        gx, gy = self.scenario.gravity
        weight = [body.mass * gx, body.mass * gy, 0.0]
        return self.mbs.AddLoad(LoadForceVector(markerNumber=self.marker(name, body.centre), loadVector=weight))

    def node(self, body: str) -> Any:
        """The engine's node of a body; None for the ground."""
        return None if body == GROUND else self.bodies[body].node

    def pin_markers(self, name: str) -> list[Any]:
        """The markers of a pin's points on its first and its second body."""
        place = self.linkage.pins[name]
        return [self.marker(place.first, place.first_point), self.marker(place.second, place.second_point)]

    def marker(self, body: str, point: Vector2) -> Any:
        """The marker on a body at a point of the start posture; parts that meet there share it."""
        if (body, point) not in self._markers:
            on_ground = body == GROUND
            item = self.ground if on_ground else self.bodies[body].object
            place = point if on_ground else self.bodies[body].local(point)
            marker = MarkerBodyRigid(bodyNumber=item, localPosition=[*place, 0.0])
            self._markers[body, point] = self.mbs.AddMarker(marker)
        return self._markers[body, point]

    @singledispatchmethod
    def add_pin(self, pin: Pin, name: str) -> None:
        """Add what stands in the engine for a pin of this name. A new kind of pin is registered below."""
        raise TypeError(f"pins.{name} = {type(pin).__name__}: has nothing that stands for it in the engine")

    @add_pin.register
    def _add_ideal(self, pin: IdealPin, name: str) -> None:
        joint = ObjectJointRevolute2D(markerNumbers=self.pin_markers(name))
        self.ideal[name] = self.mbs.AddObject(joint)

    @add_pin.register
    def _add_bushing(self, pin: BushingPin, name: str) -> None:
        place = self.linkage.pins[name]
        turns = rotations(self.mbs, self.node(place.first), self.node(place.second))
        self.compliant[name] = BushingItem(self.mbs, pin, place, self.pin_markers(name), turns)

    @add_pin.register
    def _add_clearance(self, pin: ClearancePin, name: str) -> None:
        place = self.linkage.pins[name]
        ends = [(place.first, place.first_point), (place.second, place.second_point)]
        if pin.bore == "second":
            ends.reverse()
        bore, journal = (self.mount(body, point) for body, point in ends)
        angles = [0.0 if body == GROUND else self.bodies[body].body.angle for body, _ in ends]
        self.connectors[name] = PinConnector(self.mbs, pin.contact, bore, journal, angles[1] - angles[0])

    def mount(self, body: str, point: Vector2) -> Mount:
        """Where a bore or a journal is, at a point of the start posture."""
        if body == GROUND:
            return Mount(self.ground, frame(point), True)
        item = self.bodies[body]
        return Mount(item.object, frame(item.local(point)), False)

    def clearance_pin(self, scene: Scene, name: str, connector: PinConnector) -> LoosePin:
        """The pin of a connector in the whole scene."""
        node = self.node(scene.ends(name)[0])

        def bore_spin() -> float:
            return float(self.mbs.GetNodeOutput(node, exudyn.OutputVariableType.Coordinates_t)[2])

        return LoosePin(
            self.scenario.clearance_pins[name].contact,
            connector,
            scene.pin_motion(name),
            bore_spin,
            partial(scene.mobilities, name),
            self.scenario.solver,
        )

    def add_friction(self, pin: IdealPin, name: str) -> PinFriction:
        assert pin.friction is not None  # the pins without are left out
        assert pin.radius is not None  # goes with it
        place = self.linkage.pins[name]
        ends = self.node(place.first), self.node(place.second)
        return PinFriction(self.mbs, pin.friction, pin.radius, *ends)

    def add_rigid_column(self, column: Column) -> Any:
        return self.mbs.AddObject(
            ObjectConnectorDistance(markerNumbers=self.ends(column), distance=column.start_length)
        )

    def add_oil_column(self, column: Column) -> Any:
        # what it carries and how stiff it is follows once the machine is whole
        return self.mbs.AddObject(
            ObjectConnectorSpringDamper(markerNumbers=self.ends(column), referenceLength=column.start_length)
        )

    def filled_cylinders(self) -> dict[str, FilledCylinder]:
        """Those that hold the machine at the start."""
        return fill_cylinders(self.linkage, self.scenario.cylinders, self.scenario.gravity)

    def add_cylinder(self, name: str, filled: FilledCylinder) -> CylinderItem:
        settles = self.scenario.start == "settled"
        return CylinderItem(self.mbs, filled, self.ends(self.linkage.columns[name]), settles)

    def ends(self, column: Column) -> list[Any]:
        """Markers of foot and head."""
        return [self.marker(column.foot, column.foot_point), self.marker(column.head, column.head_point)]

    def add_crank(self, crank: Crank) -> Any:
        markers = [
            self.fixed,
            self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=self.bodies[crank.body].node, coordinate=2)),
        ]
        return self.mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers))

    def add_slide(self, slide: Slide) -> Any:
        # the moment is about the first marker, which therefore is the body's; the normal is the second one's
        markers = [self.marker(slide.body, slide.point), self.marker(slide.against, slide.point)]
        carrier = 0.0 if slide.against == GROUND else self.bodies[slide.against].body.angle
        along = slide.direction - self.bodies[slide.body].body.angle
        across = slide.direction + 0.5 * math.pi - carrier
        return self.mbs.AddObject(
            ObjectJointPrismatic2D(
                markerNumbers=markers,
                axisMarker0=[math.cos(along), math.sin(along), 0.0],
                normalMarker1=[math.cos(across), math.sin(across), 0.0],
            )
        )

    def build(self) -> Scene:
        given = self.scenario.pins.items()
        for name in (*(name for name, pin in given if not pin.holds), *self.scenario.held_pins):
            self.add_pin(self.scenario.pin(name), name)
        frictions = {name: self.add_friction(pin, name) for name, pin in self.scenario.friction_pins.items()}
        oil = {name: self.add_oil_column(self.linkage.columns[name]) for name in self.scenario.oil_columns}
        rigid = {
            name: self.add_rigid_column(column)
            for name, column in self.linkage.columns.items()
            if name not in self.scenario.giving
        }
        cranks = {name: self.add_crank(crank) for name, crank in self.linkage.cranks.items()}
        slides = {name: self.add_slide(slide) for name, slide in self.linkage.slides.items()}
        loads = {
            name: add_load(
                self.mbs,
                load,
                self.marker(load.against(name), load.point),
                self.marker(load.body, load.point),
            )
            for name, load in self.scenario.loads.items()
        }
        cylinders = {name: self.add_cylinder(name, filled) for name, filled in self.filled_cylinders().items()}
        heavy = self.linkage.bodies if any(self.scenario.gravity) else {}
        weights = {name: self.add_weight(name, body) for name, body in heavy.items()}
        self.mbs.Assemble()
        data = self.mbs.systemData
        bodies = {
            name: BodyItem(item.body, item.node, item.object, int(data.GetNodeLTGODE2(item.node)[0]))
            for name, item in self.bodies.items()
        }
        filled = fill(self.linkage, self.scenario.oil_columns, self.scenario.gravity)
        rigid_columns = {
            name: ColumnItem(self.linkage.columns[name], o, int(data.GetObjectLTGAE(o)[0]))
            for name, o in rigid.items()
        }
        oil_columns = {name: OilColumnItem(filled[name], o) for name, o in oil.items()}
        crank_items = {
            name: CrankItem(self.linkage.cranks[name], o, int(data.GetObjectLTGAE(o)[0]))
            for name, o in cranks.items()
        }
        scene = Scene(
            scenario=self.scenario,
            linkage=self.linkage,
            container=self.container,
            mbs=self.mbs,
            bodies=bodies,
            ideal_pins={name: IdealItem(o, int(data.GetObjectLTGAE(o)[0])) for name, o in self.ideal.items()},
            frictions=frictions,
            loose_pins={},
            compliant_pins=self.compliant,
            rigid_columns=rigid_columns,
            oil_columns=oil_columns,
            cylinders=cylinders,
            cranks=crank_items,
            slides={name: SlideItem(o, int(data.GetObjectLTGAE(o)[0])) for name, o in slides.items()},
            loads=loads,
            weights=weights,
            driven=by_drive(self.mbs, self.scenario.drive_of, rigid_columns, oil_columns, crank_items),
        )
        for name, friction in frictions.items():
            place = self.linkage.pins[name]
            turns = (bodies[end].first + 2 if end != GROUND else None for end in (place.first, place.second))
            friction.assembled(scene.ideal_pins[name].first, *turns)
            friction.lagged = bool(self.connectors) or self.scenario.jumps
        for name, connector in self.connectors.items():
            scene.loose_pins[name] = self.clearance_pin(scene, name, connector)
        scene.drive_to(0.0)
        scene.start_moving()
        for cylinder in cylinders.values():
            cylinder.assembled()
        scene.start_rubbing()
        scene.reset_memory()
        return scene


def build(scenario: Scenario) -> Scene:
    """The engine's model of a scenario at its start, before any settling."""
    return _Builder(scenario).build()
