"""From a scenario to a spatial model: bodies with Euler parameters, bearings, actuators on spherical ends."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from exudyn.itemInterface import (
    MarkerBodyPosition,
    MarkerBodyRigid,
    NodeRigidBodyEP,
    ObjectJointGeneric,
    ObjectJointRevoluteZ,
    ObjectJointSpherical,
    ObjectRigidBody,
)

from support_exudyn.formulations.exudyn.scene.driven_parts import by_drive
from support_exudyn.formulations.exudyn.scene.engine_builder import EngineBuilder
from support_exudyn.formulations.exudyn.scene.engine_scene import BodyItem
from support_exudyn.formulations.exudyn.scene.load_item import add_load
from support_exudyn.formulations.exudyn.space.block_face import BlockFace, places
from support_exudyn.formulations.exudyn.space.scene import SpatialScene
from support_exudyn.formulations.exudyn.space.section_pin import SectionJournal, SectionPin, part_of
from support_exudyn.formulations.exudyn.space.sections import ends, marker_frame, sections
from support_exudyn.mechanics.body_motion import UNTURNED, SpatialMotion, parameter_rates
from support_exudyn.mechanics.constraints import (
    SHIFTS,
    Kind,
    constraints_in_space,
    frame_of,
    independent,
    matrix,
)
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg, preloaded_legs
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.loads.falling_block import FallingBlock
from support_exudyn.model.spatial_linkage import Bearing, BearingEnd, SpatialBody, SpatialLinkage
from support_exudyn.model.to_space import at
from support_exudyn.scenario.scenario import Scenario
from user_forces.connector.contact_connector import ContactConnector
from user_forces.connector.item import JointItem, Mount, frame
from user_forces.values.value import Vector2, Vector3

TILTS: tuple[Kind, ...] = ("tilt_1", "tilt_2")


class _SpaceBuilder(EngineBuilder):
    def __init__(self, scenario: Scenario, linkage: SpatialLinkage) -> None:
        super().__init__(scenario)
        self.linkage = linkage
        self.bodies = {name: self.add_body(body) for name, body in linkage.bodies.items()}

    def add_body(self, body: SpatialBody) -> BodyItem:
        rates = parameter_rates(UNTURNED, np.array(body.spin))
        node = self.mbs.AddNode(
            NodeRigidBodyEP(
                referenceCoordinates=[*body.centre, 1.0, 0.0, 0.0, 0.0],
                initialVelocities=[*body.velocity, *rates],
            )
        )
        item = self.mbs.AddObject(ObjectRigidBody(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        return BodyItem(body, node, item, first=-1)

    def centre(self, body: str) -> Vector3:
        return (0.0, 0.0, 0.0) if body == GROUND else self.linkage.bodies[body].centre

    def new_marker(self, body: str, point: Vector3) -> Any:
        """See `EngineBuilder`."""
        local = np.array(point) - np.array(self.centre(body))
        return MarkerBodyPosition(bodyNumber=self.item(body), localPosition=local)

    def place(self, point: Vector2, lateral: float) -> Vector3:
        """See `EngineBuilder`."""
        return at(point, lateral)

    def frame(self, body: str, point: Vector3 | None = None) -> Any:
        """See `EngineBuilder`."""
        local = (0.0, 0.0, 0.0) if point is None else self.local(body, point)
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.item(body), localPosition=local))

    def frame_marker(self, end: BearingEnd) -> Any:
        """A marker in the middle of a bore or journal, its z along the axis."""
        frame = marker_frame(end, 0.0, self.centre(end.body))
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.item(end.body), localHT=frame))

    def add_joint(self, bearing: Bearing, held: set[Kind]) -> Any:
        markers = [self.frame_marker(end) for end in ends(bearing, "first")]
        return self.mbs.AddObject(joint(bearing, held, markers))

    def mount(self, end: BearingEnd, place: float) -> Mount:
        """Where a section of a bore or a journal is."""
        frame = marker_frame(end, place, self.centre(end.body))
        return Mount(self.item(end.body), frame, end.body == GROUND)

    def add_connectors(self, bearing: Bearing) -> list[JointItem]:
        """The connectors of all sections of a bearing."""
        pin = self.scenario.clearance_pins[bearing.pin]
        bore, journal = ends(bearing, pin.bore)
        return [
            JointItem(
                self.mbs,
                part_of(pin.contact, section),
                self.mount(bore, section.place),
                self.mount(journal, section.place),
                0.0,
            )
            for section in sections(bearing, self.scenario.solver.sections)
        ]

    def section_pins(self, scene: SpatialScene, name: str, items: Sequence[JointItem]) -> list[SectionPin]:
        """The sections of a bearing in the whole scene."""
        bearing, solver = self.linkage.bearings[name], self.scenario.solver
        pin, both = self.scenario.clearance_pins[bearing.pin], scene.ends_of(name)
        whole = SectionJournal(partial(scene.inverse_mass, name), slides="along" not in bearing.holds)
        return [
            SectionPin(pin.contact, item, whole, section, both, solver)
            for section, item in zip(sections(bearing, solver.sections), items, strict=True)
        ]

    def add_face(self, name: str, block: FallingBlock) -> JointItem:
        """The connector of a block's face, which turns as little as the ground, and the point it falls on."""
        reference, point = places(block)
        face, plain = np.array(frame((0.0, 0.0), block.slope)), np.eye(4)
        face[:3, 3], plain[:3, 3] = self.local(name, reference), self.local(block.body, point)
        bore = Mount(self.item(name), face.tolist(), on_ground=True)
        journal = Mount(self.item(block.body), plain.tolist(), on_ground=False)
        return JointItem(self.mbs, block.contact, bore, journal, 0.0)

    def block_face(self, scene: SpatialScene, name: str, item: JointItem) -> BlockFace:
        """The face of a block in the whole scene."""
        solver, mass = self.scenario.solver, partial(scene.face_mass, name)
        contact = ContactConnector(item, mass, solver.impact_steps)
        return BlockFace(name, self.scenario.blocks[name], contact)

    def local(self, body: str, point: Vector3) -> Vector3:
        """A point of the start posture in a body's axes [m]."""
        x, y, z = (np.array(point) - np.array(self.centre(body))).tolist()
        return x, y, z

    def build(self) -> SpatialScene:
        scenario, linkage = self.scenario, self.linkage
        with_clearance = [
            name for name, bearing in linkage.bearings.items() if bearing.pin in scenario.clearance_pins
        ]
        actuators = linkage.actuators.items()
        held = [name for name, one in actuators if one.actuator not in scenario.compliant_actuators]
        candidates = constraints_in_space(linkage, scenario.clearance_pins, held)
        start = matrix(SpatialMotion.at_start(linkage), candidates)[0]
        rows = [candidates[n] for n in independent(start)]
        for name, bearing in linkage.bearings.items():
            kinds: set[Kind] = {row.kind for row in rows if row.name == name}
            if kinds:
                self.add_joint(bearing, kinds)
        rigid = {
            row.name: self.add_rigid_actuator(linkage.actuators[row.name])
            for row in rows
            if row.kind == "actuator"
        }
        legs = [self.add_leg(leg) for leg in self.legs()]
        connectors = {name: self.add_connectors(linkage.bearings[name]) for name in with_clearance}
        loads = {name: add_load(load, name, self) for name, load in scenario.elements.items()}
        faces = {name: self.add_face(name, block) for name, block in scenario.blocks.items()}
        heavy = linkage.bodies if any(scenario.gravity) else {}
        weights = {name: self.add_weight(name, body) for name, body in heavy.items()}
        self.mbs.Assemble()
        data = self.mbs.systemData
        bodies = {
            name: replace(item, first=int(data.GetNodeLTGODE2(item.node)[0]))
            for name, item in self.bodies.items()
        }
        rigid_items = self.held_items(linkage.actuators, rigid)
        scene = SpatialScene(
            scenario=scenario,
            linkage=linkage,
            container=self.container,
            mbs=self.mbs,
            bodies=bodies,
            rows=rows,
            all_rows=candidates,
            clearance_joints={},
            sections={},
            rigid_actuators=rigid_items,
            legs=self.join_legs(legs),
            driven=by_drive(self.mbs, scenario.drive_of, rigid_items, {}),
            loads=loads,
            weights=weights,
        )
        for name, group in connectors.items():
            scene.sections[name] = pins = self.section_pins(scene, name, group)
            scene.clearance_joints.update({f"{name}[{n}]": pin for n, pin in enumerate(pins)})
        for name, connector in faces.items():  # after all sections, as in `SpatialObservation`
            scene.faces[name] = self.block_face(scene, name, connector)
            scene.clearance_joints[name] = scene.faces[name].contact
        scene.drive_to(0.0)
        scene.start_moving()
        scene.legs.begin()
        scene.reset_memory()
        return scene

    def legs(self) -> list[PreloadedLeg]:
        """Hydraulic legs: those of the plane, each side with its share of them."""
        plane = preloaded_legs(self.scenario.linkage, self.scenario.legs, self.scenario.gravity)
        return [
            PreloadedLeg(name, one, whole.model.share(one.share), one.share * whole.load)
            for name, one in self.linkage.actuators.items()
            if (whole := plane.get(one.actuator)) is not None
        ]


def joint(bearing: Bearing, held: Collection[Kind], markers: list[Any]) -> Any:
    """The engine's joint with the fewest constraints that holds these.

    markers: of both bodies, their z along the bearing.
    """
    if all(kind in held for kind in SHIFTS + TILTS):
        return ObjectJointRevoluteZ(markerNumbers=markers)
    shifts = [int(kind in held) for kind in SHIFTS]
    tilts = [int(kind in held) for kind in TILTS]
    if not any(tilts) and _in_ground_axes(bearing, held):
        return ObjectJointSpherical(markerNumbers=markers, constrainedAxes=shifts)
    return ObjectJointGeneric(markerNumbers=markers, constrainedAxes=[*shifts, *tilts, int("turn" in held)])


def _in_ground_axes(bearing: Bearing, held: Collection[Kind]) -> bool:
    """Whether its directions may be those of the ground, in which the spherical joint counts.

    They are if the first body is the ground; if it turns, both directions across z span the same plane as long
    as it turns about z, which a body does whose bearing has nothing to hold along it.
    """
    if not np.array_equal(frame_of(bearing.first_axis), np.eye(3)):
        return False
    return bearing.first == GROUND or "along" not in held


def build(scenario: Scenario) -> SpatialScene:
    """The engine's model of a scenario in space at its start, before any settling."""
    return _SpaceBuilder(scenario, scenario.space).build()
