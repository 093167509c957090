"""From a scenario to a model in space: bodies with Euler parameters, bearings, columns with spherical ends."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import (
    LoadForceVector,
    MarkerBodyPosition,
    MarkerBodyRigid,
    NodeRigidBodyEP,
    ObjectConnectorDistance,
    ObjectConnectorSpringDamper,
    ObjectGround,
    ObjectRigidBody,
)

from support_exudyn.columns import OilColumn
from support_exudyn.driven_parts import DrivenParts, OilColumnItem
from support_exudyn.drives import Drive
from support_exudyn.engine_scene import CURRENT, INITIAL
from support_exudyn.impulse import Impulse
from support_exudyn.machine import GROUND
from support_exudyn.oil import FilledColumn, fill
from support_exudyn.onset import Mobility, PinMemory
from support_exudyn.pin_friction import PinFriction
from support_exudyn.scenario import Scenario
from support_exudyn.scene_items import ColumnItem
from support_exudyn.spatial.constraints import Kind, Row, all_rows, independent, matrix
from support_exudyn.spatial.joints import joint
from support_exudyn.spatial.kinetics import SpatialKinetics
from support_exudyn.spatial.layout import Bearing, SpatialBody, SpatialColumn, SpatialLinkage
from support_exudyn.spatial.motion import COORDINATES, SpatialMotion, motion_of, parameter_rates
from support_exudyn.spatial.reactions import reactions
from support_exudyn.spatial.section_pin import Journal, SectionEnd, SectionMover, SectionPin, marker_frame
from support_exudyn.spatial.sections import End, ends, sections
from support_exudyn.trajectory import Series
from user_forces.values import Vector3


@dataclass(frozen=True)
class BodyItem:
    """A moving body in the engine: its node, object and the first of its seven coordinates."""

    body: SpatialBody
    node: Any
    object: Any
    first: int


@dataclass(frozen=True)
class SpatialScene:
    """The model of one scenario in space, assembled and ready for the solver.

    rows: the constraints that are in the model. all_rows: those and the ones that repeat them.
    """

    scenario: Scenario
    linkage: SpatialLinkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    bodies: dict[str, BodyItem]
    rows: Sequence[Row]
    all_rows: Sequence[Row]
    loose_pins: dict[str, SectionPin]
    sections: dict[str, list[SectionPin]]  # of every loose bearing
    rigid_columns: dict[str, ColumnItem]
    oil_columns: dict[str, OilColumnItem]
    driven: tuple[DrivenParts, ...]  # all columns, by the drive that they follow
    frictions: dict[str, PinFriction] = field(default_factory=dict)  # of ideal pins: not covered

    def release(self) -> None:
        """Let go of the engine's model: what its user functions know would never be freed."""
        mbs: Any = self.mbs
        mbs.SetPreStepUserFunction(0)
        mbs.SetPostNewtonUserFunction(0)
        mbs.SetPostStepUserFunction(0)
        self.container.Reset()

    def drive_to(self, t: float) -> None:
        """Set every column to where its drive has it at time t [s]."""
        for parts in self.driven:
            parts.move_to(t)

    @property
    def gravity(self) -> Vector3:
        """Acceleration [m/s^2]."""
        return (*self.scenario.gravity, 0.0)

    def coordinate_masses(self) -> Series:
        """A mass for each of the engine's coordinates [kg], [kg m^2], by which accelerations are weighed."""
        found = np.zeros(COORDINATES * len(self.bodies))
        for item in self.bodies.values():
            found[item.first : item.first + 3] = item.body.mass
            # the spin is twice the rate of the Euler parameters
            found[item.first + 3 : item.first + COORDINATES] = 4.0 * sum(item.body.inertia[:3]) / 3.0
        return found

    def spins(self) -> dict[str, float]:
        """Angular velocity of every body [rad/s]."""
        motion = self.motion()
        return {name: float(np.linalg.norm(motion.spin[0, n])) for n, name in enumerate(self.bodies)}

    @cached_property
    def order(self) -> Series:
        """Places of the bodies' coordinates, in the order of the linkage, in the engine's vector."""
        return np.concatenate([np.arange(b.first, b.first + COORDINATES) for b in self.bodies.values()])

    def motion(self, state: Any = CURRENT) -> SpatialMotion:
        """Of all bodies now."""
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(state), data.GetODE2Coordinates_t(state)
        return motion_of(self.linkage, position[self.order], velocity[self.order])

    def kinetics(self, state: Any = CURRENT) -> SpatialKinetics:
        """Masses and the constraints of the model as matrices."""
        return SpatialKinetics(self.motion(state), self.rows)

    def mobility(self, name: str, state: Any = CURRENT) -> Mobility:
        """Mobility of the middle of a loose bearing's journal, in the axes of its bore."""
        found = self.kinetics(state).bearing_mobility(*self.ends_of(name))
        return Mobility(float(found[0, 0]), float(found[0, 1]), float(found[1, 1]))

    def ends_of(self, name: str) -> tuple[End, End]:
        """Bore and journal of a loose bearing."""
        bearing = self.linkage.bearings[name]
        return ends(bearing, self.scenario.clearance_pins[bearing.pin].bore)

    def set_velocities(self, velocity: Series, state: Any = CURRENT) -> None:
        """Give the bodies velocities v and omega, (6 bodies,)."""
        data = self.mbs.systemData
        position, rates = data.GetODE2Coordinates(state), data.GetODE2Coordinates_t(state)
        for item, (v, spin) in zip(self.bodies.values(), velocity.reshape(-1, 2, 3), strict=True):
            p = position[item.first + 3 : item.first + COORDINATES] + np.array([1.0, 0.0, 0.0, 0.0])
            rates[item.first : item.first + 3] = v
            rates[item.first + 3 : item.first + COORDINATES] = parameter_rates(p, spin)
        data.SetODE2Coordinates_t(rates, state)

    def start_moving(self) -> None:
        """Give the bodies the velocities that the drives have at the start, with ideal pins."""
        speeds = {name: self.scenario.drive_of(name).initial_speed for name in self.linkage.columns}
        if not any(speeds.values()):
            return
        motion = self.motion(INITIAL)
        held = all_rows(self.linkage, (), list(self.linkage.columns))
        closed = SpatialKinetics(motion, independent(held, matrix(motion, held)[0]))
        before = velocities(motion)
        wanted = rates(closed.rows, speeds) - matrix(motion, closed.rows)[0] @ before
        self.set_velocities(before + closed.respond(np.zeros_like(before), wanted)[0], INITIAL)

    def jump(self, time: float) -> Impulse | None:
        """Give the bodies the velocities that belong to drives whose speed has jumped at a break [s].

        None if nothing is struck, because all that jumps gives.
        """
        kinetics = self.kinetics()
        speeds = {name: self.scenario.drive_of(name).speed_jump(time) for name in self.rigid_columns}
        if not any(speeds.values()):
            return None
        before = velocities(kinetics.motion)
        change, _ = kinetics.respond(np.zeros_like(before), rates(self.rows, speeds))
        after, mass = before + change, kinetics.mass()
        self.set_velocities(after)
        struck = reactions(kinetics.motion, self.all_rows, (mass @ change).reshape(1, -1, 6))[0]
        return Impulse(
            time,
            {row.name: float(i) for row, i in zip(self.all_rows, struck, strict=True) if row.kind == "column"},
            float(0.5 * after @ mass @ after - 0.5 * before @ mass @ before),
            {},
        )

    def reset_memory(self) -> None:
        """Give every section the memory that belongs to the initial state of the bodies."""
        data = self.mbs.systemData
        at = data.GetODE2Coordinates(INITIAL).tolist(), data.GetODE2Coordinates_t(INITIAL).tolist()
        for name, group in self.sections.items():
            mobility = self.mobility(name, INITIAL)
            for pin in group:
                pin.look_beside(*at)
                force = self._force(pin, *at)
                touching = force.depth > 0.0
                memory = PinMemory(
                    in_contact=touching,
                    approach_speed=max(0.0, force.rate) if touching else 0.0,
                    depth=force.depth,
                    rate=force.rate,
                    slip=force.slip,
                ).with_mobility(mobility)
                bore, journal = pin.moving.when(*at)
                pin.start(memory, journal[4], (0.0, bore[5]))

    def refresh_memory(self) -> None:
        """Tell every section that velocities have jumped; contacts that go on go on."""
        data = self.mbs.systemData
        at = data.GetODE2Coordinates().tolist(), data.GetODE2Coordinates_t().tolist()
        for pin in self.loose_pins.values():
            force = self._force(pin, *at)
            pin.jumped(pin.kept._replace(depth=force.depth, rate=force.rate, slip=force.slip))

    def _force(self, pin: SectionPin, position: list[float], velocity: list[float]) -> Any:
        bore, (x, y, vx, vy, _, spin) = pin.moving.when(position, velocity)
        return pin.contact.force(x, y, vx, vy, bore[5], spin, None)


def rates(rows: Sequence[Row], speeds: Mapping[str, float]) -> Series:
    """Rates of all rows: of columns as told [m/s], else 0."""
    return np.array([speeds[row.name] if row.kind == "column" else 0.0 for row in rows])


def velocities(motion: SpatialMotion) -> Series:
    """v and omega of all bodies at the first instant, (6 bodies,)."""
    return np.concatenate([motion.velocity[0], motion.spin[0]], axis=1).ravel()


class _Builder:
    def __init__(self, scenario: Scenario, linkage: SpatialLinkage) -> None:
        self.scenario = scenario
        self.linkage = linkage
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self.ground = self.mbs.AddObject(ObjectGround())
        self.bodies = {name: self.add_body(body) for name, body in linkage.bodies.items()}

    def add_body(self, body: SpatialBody) -> BodyItem:
        rates = parameter_rates(np.array([1.0, 0.0, 0.0, 0.0]), np.array(body.spin))
        node = self.mbs.AddNode(
            NodeRigidBodyEP(
                referenceCoordinates=[*body.centre, 1.0, 0.0, 0.0, 0.0],
                initialVelocities=[*body.velocity, *rates],
            )
        )
        item = self.mbs.AddObject(ObjectRigidBody(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        gx, gy = self.scenario.gravity
        if gx or gy:
            centre = self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=item))
            load = [body.mass * gx, body.mass * gy, 0.0]
            self.mbs.AddLoad(LoadForceVector(markerNumber=centre, loadVector=load))
        return BodyItem(body, node, item, first=-1)

    def item(self, body: str) -> Any:
        return self.ground if body == GROUND else self.bodies[body].object

    def node(self, body: str) -> Any:
        return None if body == GROUND else self.bodies[body].node

    def centre(self, body: str) -> Vector3:
        return (0.0, 0.0, 0.0) if body == GROUND else self.linkage.bodies[body].centre

    def point_marker(self, body: str, point: Vector3) -> Any:
        """A marker at a point of the start posture."""
        local = np.array(point) - np.array(self.centre(body))
        return self.mbs.AddMarker(MarkerBodyPosition(bodyNumber=self.item(body), localPosition=local))

    def frame_marker(self, end: End) -> Any:
        """A marker in the middle of a bore or journal, its z along the axis."""
        frame = marker_frame(end, 0.0, self.centre(end.body))
        return self.mbs.AddMarker(MarkerBodyRigid(bodyNumber=self.item(end.body), localHT=frame))

    def add_joint(self, bearing: Bearing, held: set[Kind]) -> Any:
        markers = [self.frame_marker(end) for end in ends(bearing, "first")]
        return self.mbs.AddObject(joint(bearing, held, markers))

    def add_sections(self, bearing: Bearing) -> list[SectionPin]:
        pin = self.scenario.clearance_pins[bearing.pin]
        bore, journal = ends(bearing, pin.bore)
        settings = self.scenario.solver
        whole = Journal()
        return [
            SectionPin(
                self.mbs,
                pin.contact,
                whole,
                section,
                bore,
                journal,
                items=(self.item(bore.body), self.item(journal.body)),
                nodes=(self.node(bore.body), self.node(journal.body)),
                centres=(self.centre(bore.body), self.centre(journal.body)),
                slides="along" not in bearing.holds,
                symbolic=settings.backend == "symbolic",
                impact_steps=settings.impact_steps,
            )
            for section in sections(bearing, settings.sections)
        ]

    def add_rigid(self, column: SpatialColumn) -> Any:
        return self.mbs.AddObject(
            ObjectConnectorDistance(markerNumbers=self.column_ends(column), distance=column.start_length)
        )

    def add_oil(self, column: SpatialColumn) -> Any:
        return self.mbs.AddObject(
            ObjectConnectorSpringDamper(
                markerNumbers=self.column_ends(column), referenceLength=column.start_length
            )
        )

    def column_ends(self, column: SpatialColumn) -> list[Any]:
        """Markers of foot and head."""
        return [
            self.point_marker(column.foot, column.foot_point),
            self.point_marker(column.head, column.head_point),
        ]

    def build(self) -> SpatialScene:
        scenario, linkage = self.scenario, self.linkage
        loose = [name for name, bearing in linkage.bearings.items() if bearing.pin in scenario.clearance_pins]
        on_oil = [name for name, column in linkage.columns.items() if column.column in scenario.oil_columns]
        candidates = all_rows(
            linkage, list(scenario.clearance_pins), [name for name in linkage.columns if name not in on_oil]
        )
        still = np.zeros(COORDINATES * len(linkage.bodies))
        start = motion_of(linkage, still, still)
        rows = independent(candidates, matrix(start, candidates)[0])
        for name, bearing in linkage.bearings.items():
            held: set[Kind] = {row.kind for row in rows if row.name == name}
            if held:
                self.add_joint(bearing, held)
        rigid = {row.name: self.add_rigid(linkage.columns[row.name]) for row in rows if row.kind == "column"}
        oil = {name: self.add_oil(linkage.columns[name]) for name in on_oil}
        groups = {name: self.add_sections(linkage.bearings[name]) for name in loose}
        self.mbs.Assemble()
        data = self.mbs.systemData
        bodies = {
            name: replace(item, first=int(data.GetNodeLTGODE2(item.node)[0]))
            for name, item in self.bodies.items()
        }
        rigid_items: dict[str, ColumnItem] = {
            name: ColumnItem(linkage.columns[name], item, int(data.GetObjectLTGAE(item)[0]))
            for name, item in rigid.items()
        }
        oil_items = {name: OilColumnItem(filled, oil[name]) for name, filled in self.filled(oil).items()}
        scene = SpatialScene(
            scenario=scenario,
            linkage=linkage,
            container=self.container,
            mbs=self.mbs,
            bodies=bodies,
            rows=rows,
            all_rows=candidates,
            loose_pins={f"{name}[{n}]": pin for name, group in groups.items() for n, pin in enumerate(group)},
            sections=groups,
            rigid_columns=rigid_items,
            oil_columns=oil_items,
            driven=self.by_drive(rigid_items, oil_items),
        )
        for name, group in groups.items():
            whole = group[0].whole
            whole.sections = group
            whole.find_mobility = partial(scene.mobility, name)
            whole.mover = self.mover(scene, group[0], 0.0)
            for pin in group:
                pin.mover = self.mover(scene, pin, pin.section.place)
        scene.drive_to(0.0)
        scene.start_moving()
        scene.reset_memory()
        return scene

    def by_drive(self, rigid: dict[str, ColumnItem], oil: dict[str, OilColumnItem]) -> tuple[DrivenParts, ...]:
        """All columns, by drive."""
        drives: list[Drive] = []
        for name in (*rigid, *oil):
            if (drive := self.scenario.drive_of(name)) not in drives:
                drives.append(drive)

        def follows(name: str, drive: Drive) -> bool:
            return self.scenario.drive_of(name) == drive

        return tuple(
            DrivenParts(
                self.mbs,
                one,
                tuple(item for name, item in rigid.items() if follows(name, one)),
                tuple(item for name, item in oil.items() if follows(name, one)),
                (),
            )
            for one in drives
        )

    def filled(self, oil: dict[str, Any]) -> dict[str, FilledColumn]:
        """Oil columns that hold the machine: those of the plane, each side with its share of the area."""
        plane = fill(self.scenario.linkage, self.scenario.oil_columns, self.scenario.gravity)
        found = {}
        for name in oil:
            column = self.linkage.columns[name]
            whole = plane[column.column]
            model: OilColumn = replace(whole.model, bore_area=column.share * whole.model.bore_area)
            found[name] = replace(whole, model=model)
        return found

    def mover(self, scene: SpatialScene, pin: SectionPin, place: float) -> SectionMover:
        """How a section moves, from the engine's coordinates."""

        def end(of: End) -> SectionEnd:
            frame = np.array(marker_frame(of, place, self.centre(of.body)))
            first = None if of.body == GROUND else scene.bodies[of.body].first
            arm, *axes = (tuple(frame[:3, k].tolist()) for k in (3, 0, 1, 2))
            return SectionEnd(first, self.centre(of.body), arm, (axes[0], axes[1]), axes[2])

        bore, journal = pin.ends
        return SectionMover(self.mbs.systemData, end(bore), end(journal), pin.at)


def build(scenario: Scenario) -> SpatialScene:
    """The engine's model of a scenario in space at its start, before any settling."""
    return _Builder(scenario, scenario.space).build()
