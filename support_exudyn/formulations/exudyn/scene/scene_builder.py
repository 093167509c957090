"""From a scenario to a model in the engine: bodies, pins, actuators; nothing that was not asked for."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cached_property, partial, singledispatchmethod
from typing import Any

import numpy as np
from exudyn.itemInterface import (
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    MarkerNodeCoordinates,
    MarkerObjectODE2Coordinates,
    NodePointGround,
    NodeRigidBody2D,
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateVector,
    ObjectGenericODE2,
    ObjectJointPrismatic2D,
    ObjectJointRevolute2D,
    ObjectRigidBody2D,
)

from support_exudyn.formulations.exudyn.scene.driven_parts import by_drive
from support_exudyn.formulations.exudyn.scene.engine_builder import EngineBuilder
from support_exudyn.formulations.exudyn.scene.engine_scene import BodyItem
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.load_item import add_load
from support_exudyn.formulations.exudyn.scene.scene import Scene
from support_exudyn.mechanics.hydraulic_legs import preloaded_legs
from support_exudyn.mechanics.joint_friction import FrictionJoint, friction_joints
from support_exudyn.model.linkage import GROUND, Body, Crank, Gear, Slide
from support_exudyn.model.pins import ClearancePin, CompliantPin, IdealPin, Pin
from support_exudyn.model.plane_geometry import minus, rotated
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.connector.item import JointItem, Mount, frame
from user_forces.contact import Contact
from user_forces.values.value import Vector2

TURN = np.array([0.0, 0.0, 1.0])  # takes the angle out of a body's coordinates


class PlaneBuilder(EngineBuilder):
    """Builds the engine's model of a scenario in the plane."""

    def __init__(self, scenario: Scenario) -> None:
        super().__init__(scenario)
        self.linkage = scenario.linkage
        self.ideal: dict[str, Any] = {}  # joints by name
        self.connectors: dict[str, JointItem] = {}  # of all that may make contact
        self.bodies = {name: self.add_body(body) for name, body in self.linkage.bodies.items()}

    @cached_property
    def fixed(self) -> Any:
        """A coordinate that stays zero, made if there is a crank."""
        return self.mbs.AddMarker(
            MarkerNodeCoordinate(nodeNumber=self.mbs.AddNode(NodePointGround()), coordinate=0)
        )

    def add_body(self, body: Body) -> BodyItem:
        """Add a body."""
        node = self.mbs.AddNode(
            NodeRigidBody2D(
                referenceCoordinates=[*body.centre, body.angle],
                initialVelocities=[*body.velocity, body.spin],
            )
        )
        item = self.mbs.AddObject(ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        return BodyItem(body, node, item, first=-1)

    def pin_markers(self, name: str) -> list[Any]:
        """The markers of a pin's points on its first and its second body."""
        place = self.linkage.pins[name]
        return [self.marker(place.first, place.first_point), self.marker(place.second, place.second_point)]

    def local(self, body: str, point: Vector2) -> Vector2:
        """A point of the start posture in a body's own axes, from its centre of mass [m]."""
        if body == GROUND:
            return point
        data = self.linkage.bodies[body]
        return rotated(minus(point, data.centre), -data.angle)

    def new_marker(self, body: str, point: Vector2) -> Any:
        """See `EngineBuilder`."""
        place = self.local(body, point)
        return MarkerBodyRigid(bodyNumber=self.item(body), localPosition=[*place, 0.0])

    def place(self, point: Vector2, lateral: float) -> Vector2:
        """See `EngineBuilder`."""
        del lateral  # both sides are lumped
        return point

    def frame(self, body: str, point: Vector2 | None = None) -> Any:
        """See `EngineBuilder`."""
        local, turn = point or (0.0, 0.0), 0.0
        if body != GROUND:
            data = self.linkage.bodies[body]
            local, turn = self.local(body, point or data.centre), -data.angle
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.item(body), localHT=frame(local, turn)))

    @singledispatchmethod
    def add_pin(self, pin: Pin, name: str) -> None:
        """Add what stands in the engine for a pin of this name. A new kind of pin is registered below."""
        raise TypeError(f"pins.{name} = {type(pin).__name__}: has nothing that stands for it in the engine")

    @add_pin.register
    def _add_ideal(self, pin: IdealPin, name: str) -> None:
        joint = ObjectJointRevolute2D(markerNumbers=self.pin_markers(name))
        self.ideal[name] = self.mbs.AddObject(joint)

    @add_pin.register
    def _add_compliant(self, pin: CompliantPin, name: str) -> None:
        """Nothing: its loads stand for it, see `ScenarioData.elements`."""

    @add_pin.register
    def _add_clearance(self, pin: ClearancePin, name: str) -> None:
        self.add_contact(self.scenario.contact_places[name].contact, name)  # with the mass of its law

    def add_contact(self, contact: Contact, name: str) -> None:
        """Add the connector of a contact: of a clearance pin, a corner in a slot, or a block's face."""
        self.connectors[name] = JointItem(self.mbs, contact, *self.mounts(name))

    def mounts(self, name: str) -> tuple[Mount, Mount, float]:
        """Where bore and journal of a contact are, and by what angle the journal's body is turned [rad]."""
        place = self.scenario.contact_places[name]
        axes = place.axes(self.linkage)
        journal = 0.0 if place.journal == GROUND else self.bodies[place.journal].body.angle
        return (
            self.mount(place.bore, place.bore_point, axes),
            self.mount(place.journal, place.journal_point, journal),
            journal - axes,
        )

    def mount(self, body: str, point: Vector2, axes: float) -> Mount:
        """Where a bore or a journal is, at a point of the start posture, with axes at an angle [rad]."""
        ground = body == GROUND
        place = self.local(body, point)
        turn = axes if ground else axes - self.bodies[body].body.angle
        return Mount(self.item(body), frame(place, turn), ground)

    def contact_connector(self, scene: Scene, name: str, item: JointItem) -> ContactConnector:
        """The contact of a connector in the whole scene."""
        solver = self.scenario.solver
        mass = partial(scene.inverse_mass, name)
        return ContactConnector(item, mass, solver.impact_steps)

    def add_friction(self, joint: FrictionJoint) -> JointFriction:
        """Add the friction of an ideal pin or guide."""
        bodies = joint.first, joint.second
        points = [] if joint.slide is None else [self.marker(body, joint.slide.point) for body in bodies]
        return JointFriction(self.mbs, joint, [self.node(body) for body in bodies], points)

    def add_crank(self, crank: Crank) -> Any:
        """Add what holds a crank's angle; returns its number in the engine."""
        markers = [
            self.fixed,
            self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=self.bodies[crank.body].node, coordinate=2)),
        ]
        return self.mbs.AddObject(ObjectConnectorCoordinate(markerNumbers=markers))

    def add_slide(self, slide: Slide) -> Any:
        """Add a guide; returns its number in the engine."""
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
                constrainRotation=not slide.turns,
            )
        )

    def add_gear(self, gear: Gear) -> None:
        """Add what holds the turns of two bodies against their carrier in proportion."""
        shares = {gear.first: gear.ratio, gear.carrier or GROUND: 1.0 - gear.ratio}
        turning = {body: share for body, share in shares.items() if body in self.bodies}
        start = sum(share * self.bodies[body].body.angle for body, share in turning.items())
        # an object without mass gathers both coordinates, for a connector takes those of two objects
        massless = np.zeros((3 * len(turning), 3 * len(turning)))
        nodes = [self.bodies[body].node for body in turning]
        gathered = self.mbs.AddObject(ObjectGenericODE2(nodeNumbers=nodes, massMatrix=massless))
        second = MarkerNodeCoordinates(nodeNumber=self.bodies[gear.second].node)
        self.mbs.AddObject(
            ObjectConnectorCoordinateVector(
                markerNumbers=[
                    self.mbs.AddMarker(MarkerObjectODE2Coordinates(objectNumber=gathered)),
                    self.mbs.AddMarker(second),
                ],
                scalingMarker0=np.kron([*turning.values()], TURN)[None],
                scalingMarker1=TURN[None],
                offset=[self.bodies[gear.second].body.angle - start],  # the engine counts angles from +x
            )
        )

    def build(self) -> Scene:
        """The whole scene."""
        scenario, linkage, mbs = self.scenario, self.linkage, self.mbs
        given = scenario.pins.items()
        for name in (*(name for name, pin in given if not pin.holds), *scenario.held_pins):
            self.add_pin(scenario.pin(name), name)
        rubbing = friction_joints(scenario).items()
        frictions = {name: self.add_friction(joint) for name, joint in rubbing}
        rigid = {
            name: self.add_rigid_actuator(actuator)
            for name, actuator in linkage.actuators.items()
            if name not in scenario.compliant_actuators
        }
        cranks = {name: self.add_crank(crank) for name, crank in linkage.cranks.items()}
        slides = {name: self.add_slide(slide) for name, slide in scenario.guided_linkage.slides.items()}
        for name, guide in scenario.guides.items():
            for part in guide.contacts():
                self.add_contact(scenario.contact_places[f"{name}.{part}"].contact, f"{name}.{part}")
        for name, block in scenario.blocks.items():
            self.add_contact(block.contact, name)
        for gear in linkage.gears.values():
            self.add_gear(gear)
        loads = {name: add_load(load, name, self) for name, load in scenario.elements.items()}
        legs = [self.add_leg(one) for one in preloaded_legs(linkage, scenario.legs, scenario.gravity).values()]
        heavy = linkage.bodies if any(scenario.gravity) else {}
        weights = {name: self.add_weight(name, body) for name, body in heavy.items()}
        mbs.Assemble()
        data, held = mbs.systemData, self.held_items
        bodies = {
            name: replace(item, first=int(data.GetNodeLTGODE2(item.node)[0]))
            for name, item in self.bodies.items()
        }
        rigid_actuators = held(linkage.actuators, rigid)
        crank_items = held(linkage.cranks, cranks)
        scene = Scene(
            scenario=scenario,
            linkage=linkage,
            container=self.container,
            mbs=mbs,
            bodies=bodies,
            ideal_pins=held(linkage.pins, self.ideal),
            frictions=frictions,
            clearance_joints={},
            rigid_actuators=rigid_actuators,
            legs=self.join_legs(legs),
            cranks=crank_items,
            slides=held(linkage.slides, slides),
            gears=tuple(linkage.gears),
            loads=loads,
            weights=weights,
            driven=by_drive(mbs, scenario.drive_of, rigid_actuators, crank_items),
        )
        for friction in frictions.values():
            friction.assembled(scene.multiplier_of(friction), bodies)
            friction.lagged = bool(self.connectors) or scenario.jumps
        for name, connector in self.connectors.items():
            scene.clearance_joints[name] = self.contact_connector(scene, name, connector)
        scene.drive_to(0.0)
        scene.start_moving()
        scene.legs.begin()
        scene.start_rubbing()
        scene.reset_memory()
        return scene


def build(scenario: Scenario) -> Scene:
    """The engine's model of a scenario at its start, before any settling."""
    return PlaneBuilder(scenario).build()
