"""From a scenario to a model in the engine, in the plane or in space; nothing is made that was not asked for.

Both have the same parts: bodies, joints from the rows that they hold, contacts, loads, legs, weights. What
differs is which items of the engine stand for bodies and joints.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from functools import cached_property, partial
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyPosition,
    MarkerBodyRigid,
    MarkerNodeCoordinate,
    MarkerNodeCoordinates,
    MarkerObjectODE2Coordinates,
    NodePointGround,
    NodeRigidBody2D,
    NodeRigidBodyEP,
    ObjectConnectorCoordinate,
    ObjectConnectorCoordinateVector,
    ObjectConnectorDistance,
    ObjectConnectorSpringDamper,
    ObjectGenericODE2,
    ObjectGround,
    ObjectJointGeneric,
    ObjectJointPrismatic2D,
    ObjectJointRevolute2D,
    ObjectJointRevoluteZ,
    ObjectJointSpherical,
    ObjectRigidBody,
    ObjectRigidBody2D,
)

from support_exudyn.formulations.exudyn.scene.driven_parts import HeldItem, by_drive
from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs
from support_exudyn.formulations.exudyn.scene.engine_scene import BodyItem, EngineScene, SceneContact
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.leg_circuit import LegItem
from support_exudyn.formulations.exudyn.scene.load_item import add_load
from support_exudyn.formulations.exudyn.scene.section_pin import SectionJournal, SectionPin
from support_exudyn.formulations.exudyn.scene.sections import SectionPlace, ends, section_places
from support_exudyn.mechanics.body_motion import COORDINATES, UNTURNED, SpatialMotion, parameter_rates
from support_exudyn.mechanics.constraints import (
    SHIFTS,
    Constraint,
    Kind,
    constraints_in_space,
    frame_of,
    independent,
    matrix,
)
from support_exudyn.mechanics.contact_places import BlockContactPlace, ContactPlace
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg, preloaded_legs
from support_exudyn.mechanics.joint_friction import FrictionJoint, friction_joints
from support_exudyn.mechanics.kinetics import Matrix, kinetics_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import Bearing
from support_exudyn.model.to_space import at
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.connector.item import JointItem, Mount, frame
from user_forces.values.value import Vector2

TURN = np.array([0.0, 0.0, 1.0])  # takes the angle out of a body's coordinates
TILTS: tuple[Kind, ...] = ("tilt_1", "tilt_2")


class SceneBuilder:
    """Builds the engine's model of a scenario.

    All bodies have the axes of the ground at the start. joints: objects of the engine, by the field of the
    linkage and the name.
    """

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.linkage: Any = scenario.space if scenario.dimensions == 3 else scenario.linkage
        self.in_space = scenario.dimensions == 3
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self._markers: dict[tuple[str, Any], Any] = {}  # by body and point of the start posture
        self.joints: dict[tuple[str, str], Any] = {}
        self.bodies: dict[str, BodyItem] = {}
        for name, body in self.linkage.bodies.items():
            self.bodies[name] = self.add_body(body, len(self.bodies))

    # --- bodies and markers ---

    def add_body(self, body: Any, number: int) -> BodyItem:
        """Add a body with all its coordinates behind those of the bodies before."""
        if self.in_space:
            coordinates = [*body.centre, *UNTURNED]
            velocities = [*body.velocity, *parameter_rates(UNTURNED, np.array(body.spin))]
            node_of, object_of, count = NodeRigidBodyEP, ObjectRigidBody, COORDINATES
        else:
            coordinates, velocities = [*body.centre, 0.0], [*body.velocity, body.spin]
            node_of, object_of, count = NodeRigidBody2D, ObjectRigidBody2D, 3
        node = self.mbs.AddNode(node_of(referenceCoordinates=coordinates, initialVelocities=velocities))
        item = self.mbs.AddObject(object_of(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        return BodyItem(body, node, item, count * number)

    @cached_property
    def ground(self) -> Any:
        """The engine's body that does not move, made if something stands on it."""
        return self.mbs.AddObject(ObjectGround())

    def item(self, body: str) -> Any:
        """The engine's object of a body."""
        return self.ground if body == GROUND else self.bodies[body].object

    def local(self, body: str, point: Any) -> Series:
        """A point of the start posture in a body's own axes, from its centre of mass (3,) [m]."""
        found = np.zeros(3)
        found[: len(point)] = point if body == GROUND else np.subtract(point, self.linkage.bodies[body].centre)
        return found

    def place(self, point: Vector2, lateral: float) -> Any:
        """A point of the plane's start posture, so far to the right [m]; in the plane both sides are lumped."""
        return at(point, lateral) if self.in_space else point

    def marker(self, body: str, point: Any) -> Any:
        """The marker on a body at a point of the start posture; parts that meet there share it."""
        if (body, point) not in self._markers:
            kind = MarkerBodyPosition if self.in_space else MarkerBodyRigid
            made = kind(bodyNumber=self.item(body), localPosition=self.local(body, point))
            self._markers[body, point] = self.mbs.AddMarker(made)
        return self._markers[body, point]

    def frame(self, body: str, point: Any = None, axes: Matrix | None = None) -> Any:
        """A marker on a body at a point, by default its centre, with axes of the start posture (3, 3).

        The default axes are those of the ground.
        """
        place = np.zeros(3) if point is None else self.local(body, point)
        pose = placed(np.eye(3) if axes is None else axes, place)
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.item(body), localHT=pose))

    @cached_property
    def fixed(self) -> Any:
        """A coordinate that stays zero, made if something turns against the ground."""
        return self.mbs.AddMarker(
            MarkerNodeCoordinate(nodeNumber=self.mbs.AddNode(NodePointGround()), coordinate=0)
        )

    def turn(self, body: str) -> Any:
        """The marker of a body's turn in the plane."""
        if body == GROUND:
            return self.fixed
        return self.mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=self.bodies[body].node, coordinate=2))

    def add_weight(self, name: str, body: Any) -> Any:
        """Let gravity act on a body."""
        gx, gy = self.scenario.gravity
        weight = [body.mass * gx, body.mass * gy, 0.0]
        return self.mbs.AddLoad(LoadForceVector(markerNumber=self.marker(name, body.centre), loadVector=weight))

    # --- joints ---

    def constraints(self) -> tuple[Sequence[Constraint], Sequence[Constraint], float]:
        """Rows of the model, all that is held, and the length [m] by which turns count, see `EngineScene`."""
        scenario, oil = self.scenario, self.scenario.compliant_actuators
        actuators = self.linkage.actuators.items()
        rigid = [name for name, one in actuators if getattr(one, "actuator", name) not in oil]
        if not self.in_space:
            kinetics = kinetics_of(scenario.guided_linkage, scenario.held_pins, rigid)
            return kinetics.constraints, kinetics.constraints, kinetics.size
        held = constraints_in_space(self.linkage, scenario.clearance_pins, rigid)
        start = matrix(SpatialMotion.at_start(self.linkage), held)[0]
        return [held[n] for n in independent(start)], held, 1.0

    def add_joints(self, rows: Iterable[Constraint]) -> None:
        """Add the joints that hold these rows."""
        adders: dict[str, Any] = {
            "pins": self.add_pin,
            "actuators": self.add_rigid_actuator,
            "cranks": self.add_crank,
            "slides": self.add_slide,
            "gears": self.add_gear,
            "bearings": self.add_bearing,
        }
        kinds: dict[tuple[str, str], set[Kind]] = {}
        for row in rows:
            kinds.setdefault((row.part, row.name), set()).add(row.kind)
        for (part, name), held in kinds.items():
            joint = adders[part](getattr(self.linkage, part)[name], held)
            self.joints[part, name] = self.mbs.AddObject(joint)

    def add_pin(self, pin: Any, held: Collection[Kind]) -> Any:
        """An ideal pin of the plane."""
        ends = self.marker(pin.first, pin.first_point), self.marker(pin.second, pin.second_point)
        return ObjectJointRevolute2D(markerNumbers=[*ends])

    def add_rigid_actuator(self, actuator: Any, held: Collection[Kind]) -> Any:
        """What holds the ends of an actuator apart."""
        return ObjectConnectorDistance(markerNumbers=self.ends(actuator), distance=actuator.start_length)

    def add_crank(self, crank: Any, held: Collection[Kind]) -> Any:
        """What holds a crank's angle."""
        return ObjectConnectorCoordinate(markerNumbers=[self.fixed, self.turn(crank.body)])

    def add_slide(self, slide: Any, held: Collection[Kind]) -> Any:
        """A guide of the plane."""
        # the moment is about the first marker, which therefore is the body's; the normal is the second one's
        c, s = math.cos(slide.direction), math.sin(slide.direction)
        return ObjectJointPrismatic2D(
            markerNumbers=[self.marker(slide.body, slide.point), self.marker(slide.against, slide.point)],
            axisMarker0=[c, s, 0.0],
            normalMarker1=[-s, c, 0.0],
            constrainRotation=not slide.turns,
        )

    def add_gear(self, gear: Any, held: Collection[Kind]) -> Any:
        """What holds the turns of two bodies against their carrier in proportion."""
        shares = {gear.first: gear.ratio, gear.carrier or GROUND: 1.0 - gear.ratio}
        turning = {body: share for body, share in shares.items() if body in self.bodies}
        # an object without mass gathers both coordinates, for a connector takes those of two objects
        massless = np.zeros((3 * len(turning), 3 * len(turning)))
        nodes = [self.bodies[body].node for body in turning]
        gathered = self.mbs.AddObject(ObjectGenericODE2(nodeNumbers=nodes, massMatrix=massless))
        second = MarkerNodeCoordinates(nodeNumber=self.bodies[gear.second].node)
        return ObjectConnectorCoordinateVector(
            markerNumbers=[
                self.mbs.AddMarker(MarkerObjectODE2Coordinates(objectNumber=gathered)),
                self.mbs.AddMarker(second),
            ],
            scalingMarker0=np.kron([*turning.values()], TURN)[None],
            scalingMarker1=TURN[None],
        )

    def add_bearing(self, bearing: Bearing, held: Collection[Kind]) -> Any:
        """The joint of space with the fewest constraints that holds these."""
        markers = [self.frame(end.body, end.point, frame_of(end.axis)) for end in ends(bearing, "first")]
        if all(kind in held for kind in SHIFTS + TILTS):
            return ObjectJointRevoluteZ(markerNumbers=markers)
        shifts = [int(kind in held) for kind in SHIFTS]
        tilts = [int(kind in held) for kind in TILTS]
        if not any(tilts) and _in_ground_axes(bearing, held):
            return ObjectJointSpherical(markerNumbers=markers, constrainedAxes=shifts)
        return ObjectJointGeneric(markerNumbers=markers, constrainedAxes=[*shifts, *tilts, int("turn" in held)])

    def ends(self, actuator: Any) -> list[Any]:
        """The markers of foot and head."""
        return [
            self.marker(actuator.foot, actuator.foot_point),
            self.marker(actuator.head, actuator.head_point),
        ]

    def held_items(self, part: str) -> dict[str, HeldItem]:
        """The joints of a field of the linkage, once all is assembled."""
        return {
            name: HeldItem(getattr(self.linkage, part)[name], item, self.multiplier((part, name)))
            for (of, name), item in self.joints.items()
            if of == part
        }

    def multiplier(self, owner: tuple[str, str]) -> int:
        """The first multiplier of a joint, once all is assembled."""
        return int(self.mbs.systemData.GetObjectLTGAE(self.joints[owner])[0])

    def add_friction(self, joint: FrictionJoint) -> JointFriction:
        """Add the friction of an ideal pin or guide."""
        bodies = joint.first, joint.second
        points = [] if joint.slide is None else [self.marker(body, joint.slide.point) for body in bodies]
        turns = [self.turn(body) for body in bodies] if joint.lever((0.0, 0.0)) else []
        return JointFriction(self.mbs, joint, points, turns)

    # --- contacts ---

    def contact_places(self) -> dict[str, list[Any]]:
        """Places of all contacts by name: each as a whole, then its sections."""
        scenario = self.scenario
        if not self.in_space:
            return {name: [place, place] for name, place in scenario.contact_places.items()}
        found: dict[str, list[Any]] = {}
        for name, bearing in self.linkage.bearings.items():
            if (pin := scenario.clearance_pins.get(bearing.pin)) is not None:
                found[name] = [*section_places(bearing, pin.contact, pin.bore, scenario.solver.sections)]
        for name, block in scenario.blocks.items():
            place = scenario.contact_places[name]
            assert isinstance(place, BlockContactPlace)
            found[name] = 2 * [place.in_space(block.lateral)]
        return found

    def add_contact(self, place: ContactPlace | SectionPlace) -> JointItem:
        """Add the connector of a contact."""
        bore, journal = self.frames(place)
        block = isinstance(place, BlockContactPlace)  # its face turns as little as the ground
        return JointItem(
            self.mbs,
            place.contact,
            self.mount(place.bore, place.bore_point, bore, still=block),
            self.mount(place.journal, place.journal_point, journal),
            0.0,
        )

    def frames(self, place: ContactPlace | SectionPlace) -> tuple[Matrix, Matrix]:
        """Axes of bore and journal in the start posture, in columns (3, 3)."""
        if isinstance(place, SectionPlace):
            return frame_of(place.bore_end.axis), frame_of(place.journal_end.axis)
        axes = np.array(frame((0.0, 0.0), place.axes(self.scenario.linkage)))[:3, :3]
        return axes, axes

    def mount(self, body: str, point: Any, axes: Matrix, still: bool = False) -> Mount:
        """Where a bore or a journal is."""
        return Mount(self.item(body), placed(axes, self.local(body, point)), still or body == GROUND)

    def contact(self, scene: EngineScene, name: str, places: list[Any], items: list[JointItem]) -> SceneContact:
        """The contact of connectors in the whole scene."""
        (middle, *parts), steps = places, self.scenario.solver.impact_steps
        mass, axes = partial(scene.inverse_mass, name), self.frames(middle)[0]
        if not isinstance(middle, SectionPlace):
            pins = [ContactConnector(item, mass, steps) for item in items]
            return SceneContact(middle, axes, 1.0, parts, pins)
        whole = SectionJournal(mass, slides=middle.slides)
        sections: list[ContactConnector] = [
            SectionPin(middle.contact, item, whole, part.section.share, steps)
            for part, item in zip(parts, items, strict=True)
        ]
        return SceneContact(middle, axes, middle.section.share, parts, sections)

    # --- hydraulics ---

    def add_leg(self, leg: PreloadedLeg) -> LegItem:
        """Put a hydraulic leg in place of an actuator; its force follows when all is there."""
        ends, model = self.ends(leg.actuator), leg.model
        spring = ObjectConnectorSpringDamper(markerNumbers=ends, referenceLength=leg.actuator.start_length)
        drive = self.scenario.drive_of(leg.name)
        source = model.inlet if isinstance(model, HydraulicCylinder) else drive
        return LegItem(self.mbs, leg, ends, self.mbs.AddObject(spring), source)

    def legs(self) -> list[PreloadedLeg]:
        """Hydraulic legs: those of the plane, in space each side with its share of them."""
        plane = preloaded_legs(self.scenario.linkage, self.scenario.legs, self.scenario.gravity)
        if not self.in_space:
            return [*plane.values()]
        return [
            PreloadedLeg(name, one, whole.model.share(one.share), one.share * whole.load)
            for name, one in self.linkage.actuators.items()
            if (whole := plane.get(one.actuator)) is not None
        ]

    def join_legs(self, items: Iterable[LegItem]) -> EngineLegs:
        """All legs, and the pump that they share."""
        scenario = self.scenario
        mass = sum(body.mass for body in scenario.linkage.bodies.values())
        weight = mass * math.hypot(*scenario.gravity)
        return EngineLegs(tuple(items), scenario.pump, weight)

    # --- the whole ---

    def build(self) -> EngineScene:
        """The whole scene."""
        scenario, linkage, mbs = self.scenario, self.linkage, self.mbs
        rows, held, size = self.constraints()
        self.add_joints(rows)
        frictions = {name: self.add_friction(joint) for name, joint in friction_joints(scenario).items()}
        legs = [self.add_leg(leg) for leg in self.legs()]
        places = self.contact_places()
        connectors = {name: [self.add_contact(part) for part in parts[1:]] for name, parts in places.items()}
        loads = {name: add_load(load, name, self) for name, load in scenario.elements.items()}
        heavy = linkage.bodies if any(scenario.gravity) else {}
        weights = {name: self.add_weight(name, body) for name, body in heavy.items()}
        mbs.Assemble()
        for friction in frictions.values():
            friction.assembled(self.multiplier(friction.joint.owner), self.bodies)
            friction.lagged = bool(connectors) or scenario.jumps
        scene = EngineScene(
            scenario=scenario,
            linkage=linkage,
            container=self.container,
            mbs=mbs,
            bodies=self.bodies,
            rows=rows,
            held=held,
            size=size,
            contacts={},
            frictions=frictions,
            loads=loads,
            weights=weights,
            driven=by_drive(mbs, scenario.drive_of, self.held_items("actuators"), self.held_items("cranks")),
            legs=self.join_legs(legs),
        )
        for name, items in connectors.items():
            scene.contacts[name] = self.contact(scene, name, places[name], items)
        scene.drive_to(0.0)
        scene.start_moving()
        scene.legs.begin()
        scene.start_rubbing()
        scene.reset_memory()
        return scene


def placed(axes: Matrix, place: Series) -> list[list[float]]:
    """A frame of the engine (4 x 4) with axes in columns (3, 3) at a place (3,) [m]."""
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = axes, place
    rows: list[list[float]] = found.tolist()
    return rows


def _in_ground_axes(bearing: Bearing, held: Collection[Kind]) -> bool:
    """Whether its directions may be those of the ground, in which the spherical joint counts.

    They are if the first body is the ground; if it turns, both directions across z span the same plane as long
    as it turns about z, which a body does whose bearing has nothing to hold along it.
    """
    if not np.array_equal(frame_of(bearing.first_axis), np.eye(3)):
        return False
    return bearing.first == GROUND or "along" not in held


def build(scenario: Scenario) -> EngineScene:
    """The engine's model of a scenario at its start, before any settling, whatever its formulation is.

    Who asks for it releases it, see `EngineScene.release`.
    """
    return SceneBuilder(scenario).build()
