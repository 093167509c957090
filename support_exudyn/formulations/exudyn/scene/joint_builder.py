"""Bodies and joints in the engine, in the plane and in space; nothing is made that was not asked for.

Plane and space differ by the items of the engine that stand for bodies and joints. Joints follow from the rows
of constraints that they hold.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
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

from support_exudyn.formulations.exudyn.scene.driven_parts import DrivenPart
from support_exudyn.formulations.exudyn.scene.joint_friction import JointFriction
from support_exudyn.formulations.exudyn.scene.sections import ends as bearing_ends
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
from support_exudyn.mechanics.joint_friction import FrictionJoint
from support_exudyn.mechanics.kinetics import Matrix, kinetics_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.to_space import at
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2

TURN = np.array([0.0, 0.0, 1.0])  # takes the angle out of a body's coordinates
TILTS: tuple[Kind, ...] = ("tilt_1", "tilt_2")


@dataclass(frozen=True)
class BodyItem:
    """A moving body in the engine: its data, node, object and first coordinate."""

    body: Any
    node: Any
    object: Any
    first: int


class JointBuilder:
    """Builds the bodies of a scenario in the engine, and the joints between them.

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

    def add_weight(self, name: str, body: Any) -> None:
        """Let gravity act on a body."""
        gx, gy = self.scenario.gravity
        weight = [body.mass * gx, body.mass * gy, 0.0]
        self.mbs.AddLoad(LoadForceVector(markerNumber=self.marker(name, body.centre), loadVector=weight))

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
        kinds: dict[tuple[str, str], set[Kind]] = {}
        for row in rows:
            kinds.setdefault((row.part, row.name), set()).add(row.kind)
        for (part, name), held in kinds.items():
            joint = self._joint(part, getattr(self.linkage, part)[name], held)
            self.joints[part, name] = self.mbs.AddObject(joint)

    def _joint(self, part: str, one: Any, held: Collection[Kind]) -> Any:
        """The engine's joint of a part of the linkage that holds these kinds of rows."""
        if part == "pins":
            ends = self.marker(one.first, one.first_point), self.marker(one.second, one.second_point)
            return ObjectJointRevolute2D(markerNumbers=[*ends])
        if part == "actuators":
            return ObjectConnectorDistance(markerNumbers=self.ends(one), distance=one.start_length)
        if part == "cranks":
            return ObjectConnectorCoordinate(markerNumbers=[self.fixed, self.turn(one.body)])
        if part == "slides":
            # the moment is about the first marker, which is the body's; the normal is the second one's
            c, s = math.cos(one.direction), math.sin(one.direction)
            return ObjectJointPrismatic2D(
                markerNumbers=[self.marker(one.body, one.point), self.marker(one.against, one.point)],
                axisMarker0=[c, s, 0.0],
                normalMarker1=[-s, c, 0.0],
                constrainRotation=not one.turns,
            )
        if part == "gears":
            return self._gear(one)
        # the joint of space with the fewest constraints
        markers = [self.frame(end.body, end.point, frame_of(end.axis)) for end in bearing_ends(one, "first")]
        if all(kind in held for kind in SHIFTS + TILTS):
            return ObjectJointRevoluteZ(markerNumbers=markers)
        shifts, tilts = ([int(kind in held) for kind in some] for some in (SHIFTS, TILTS))
        # A spherical joint counts in the directions of the ground. If the first body turns, both directions
        # across z span the same plane as long as it turns about z: nothing is held along its bearing.
        in_ground_axes = np.array_equal(frame_of(one.first_axis), np.eye(3)) and (
            one.first == GROUND or "along" not in held
        )
        if not any(tilts) and in_ground_axes:
            return ObjectJointSpherical(markerNumbers=markers, constrainedAxes=shifts)
        return ObjectJointGeneric(markerNumbers=markers, constrainedAxes=[*shifts, *tilts, int("turn" in held)])

    def _gear(self, gear: Any) -> Any:
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

    def ends(self, actuator: Any) -> list[Any]:
        """The markers of foot and head."""
        return [
            self.marker(actuator.foot, actuator.foot_point),
            self.marker(actuator.head, actuator.head_point),
        ]

    def driven_parts(self) -> Iterator[DrivenPart]:
        """Rigid actuators and cranks that follow drives, once all is assembled."""
        for (part, name), item in self.joints.items():
            if part in ("actuators", "cranks"):
                start = self.linkage.actuators[name].start_length if part == "actuators" else 0.0
                parameter = "distance" if part == "actuators" else "offset"
                drive, multiplier = self.scenario.drive_of(name), self.multiplier((part, name))
                yield DrivenPart(self.mbs, drive, item, parameter, start, multiplier)

    def multiplier(self, owner: tuple[str, str]) -> int:
        """The first multiplier of a joint, once all is assembled."""
        return int(self.mbs.systemData.GetObjectLTGAE(self.joints[owner])[0])

    def add_friction(self, joint: FrictionJoint) -> JointFriction:
        """Add the friction of an ideal pin or guide."""
        bodies = joint.first, joint.second
        points = [] if joint.slide is None else [self.marker(body, joint.slide.point) for body in bodies]
        turns = [self.turn(body) for body in bodies] if joint.lever((0.0, 0.0)) else []
        return JointFriction(self.mbs, joint, points, turns)


def placed(axes: Matrix, place: Series) -> list[list[float]]:
    """A frame of the engine (4 x 4) with axes in columns (3, 3) at a place (3,) [m]."""
    found = np.eye(4)
    found[:3, :3], found[:3, 3] = axes, place
    rows: list[list[float]] = found.tolist()
    return rows
