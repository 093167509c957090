"""From a scenario to a model in the engine: bodies, pins, columns; nothing that was not asked for."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, TypeVar

import exudyn
import numpy as np
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

from support_exudyn.connector import frame
from support_exudyn.driven_parts import DrivenParts, OilColumnItem
from support_exudyn.drives import Drive
from support_exudyn.engine_scene import CURRENT, INITIAL
from support_exudyn.impulse import Impulse
from support_exudyn.kinetics import Kinetics, Matrix
from support_exudyn.loose_pin import LoosePin
from support_exudyn.machine import GROUND, Body, Column, Crank, Linkage, PinPlace, Slide
from support_exudyn.oil import fill
from support_exudyn.onset import Mobility, PinMemory
from support_exudyn.pin_friction import PinFriction
from support_exudyn.pin_motion import PinEnd, PinMotion
from support_exudyn.pins import ClearancePin, IdealPin
from support_exudyn.scenario import Scenario
from support_exudyn.scene_items import BodyItem, ColumnItem, CrankItem, IdealItem, SlideItem
from support_exudyn.velocity_jump import jump_velocities
from user_forces.contact import ContactForce
from user_forces.values import Vector2

FRICTION_ROUNDS = 4  # each with an error smaller by the coefficient of friction times radius over lever
Item = TypeVar("Item")


@dataclass(frozen=True)
class Scene:
    """The model of one scenario, assembled and ready for the solver."""

    scenario: Scenario
    linkage: Linkage
    container: Any  # owns the system: must live as long as it
    mbs: Any
    bodies: dict[str, BodyItem]
    ideal_pins: dict[str, IdealItem]
    frictions: dict[str, PinFriction]  # of ideal pins
    loose_pins: dict[str, LoosePin]
    rigid_columns: dict[str, ColumnItem]
    oil_columns: dict[str, OilColumnItem]
    cranks: dict[str, CrankItem]
    slides: dict[str, SlideItem]
    driven: tuple[DrivenParts, ...]  # all columns and cranks, by the drive that they follow

    def release(self) -> None:
        """Let go of the engine's model: what its user functions know would never be freed."""
        mbs: Any = self.mbs
        mbs.SetPreStepUserFunction(0)
        mbs.SetPostNewtonUserFunction(0)
        mbs.SetPostStepUserFunction(0)
        self.container.Reset()

    def drive_to(self, t: float) -> None:
        """Set every column and crank to where its drive has it at time t [s]."""
        for parts in self.driven:
            parts.move_to(t)

    @cached_property
    def kinetics(self) -> Kinetics:
        """Masses and constraints as matrices; clearance pins and oil columns are free."""
        return Kinetics(self.linkage, self.bodies, tuple(self.ideal_pins), tuple(self.rigid_columns))

    @cached_property
    def closed_kinetics(self) -> Kinetics:
        """The same with all pins ideal and all columns rigid."""
        return Kinetics(self.linkage, self.bodies, tuple(self.linkage.pins), tuple(self.linkage.columns))

    def mobility(self, name: str, state: Any = CURRENT) -> Mobility:
        """Mobility of a clearance pin's journal, in the axes of its bore; see `Kinetics.pin_mobility`."""
        position = self.mbs.systemData.GetODE2Coordinates(state)
        matrix = self.kinetics.pin_mobility(position, name)
        angle = self.bore_angle(name, position)
        axes = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
        turned = axes.T @ matrix @ axes
        return Mobility(float(turned[0, 0]), float(turned[0, 1]), float(turned[1, 1]))

    def bore_angle(self, name: str, position: Any) -> float:
        """Angle [rad] of the axes of the bore's body."""
        body = self._ends(name)[0]
        start = 0.0 if body == GROUND else self.bodies[body].body.angle
        return start + self._turn(body, position)

    def _ends(self, name: str) -> tuple[str, str]:
        """Bodies of the bore and of the journal of a clearance pin."""
        place = self.linkage.pins[name]
        bore_first = self.scenario.clearance_pins[name].bore == "first"
        return (place.first, place.second) if bore_first else (place.second, place.first)

    def _turn(self, body: str, coordinates: Any) -> float:
        """Rotation [rad] of a body since the start posture, or its rate, from the vector of all."""
        return 0.0 if body == GROUND else float(coordinates[self.bodies[body].first + 2])

    def start_moving(self) -> None:
        """Give the bodies the velocities that the drive has at the start, with ideal pins."""
        if all(drive.initial_speed == 0.0 for drive in self.scenario.drives_in_use):
            return
        closed = self.closed_kinetics
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(INITIAL), data.GetODE2Coordinates_t(INITIAL)
        rates = closed.rates(lambda name: self.scenario.drive_of(name).initial_speed)
        missing = rates - closed.rows(position) @ velocity
        change, _ = closed.respond(position, np.zeros_like(velocity), missing)
        data.SetODE2Coordinates_t(velocity + change, INITIAL)

    def jump(self, time: float) -> Impulse | None:
        """See `velocity_jump`."""
        return jump_velocities(self, time)

    def spins(self) -> dict[str, float]:
        """Angular velocity of every body [rad/s]."""
        velocity = self.mbs.systemData.GetODE2Coordinates_t()
        return {name: float(velocity[item.first + 2]) for name, item in self.bodies.items()}

    def coordinate_masses(self) -> Matrix:
        """Mass or inertia of every coordinate [kg], [kg m^2]."""
        return self.kinetics.mass()

    def start_rubbing(self) -> None:
        """Let friction of ideal pins know about their forces at the start, if it turns them then.

        The solver's first accelerations follow from forces of friction, which follow from those of the pins:
        without, the first step would be taken with none. Forces of loose pins and oil are left out of it.
        """
        data = self.mbs.systemData
        position, velocity = data.GetODE2Coordinates(INITIAL), data.GetODE2Coordinates_t(INITIAL)
        if not self.frictions or not velocity.any():
            return
        kinetics, small = self.kinetics, 1e-6 / np.abs(velocity).max()
        later, earlier = (kinetics.rows(position + h * velocity) for h in (small, -small))
        turning = (earlier - later) @ velocity / (2.0 * small)  # accelerations that the constraints ask for
        place = {name: 2 * n for n, name in enumerate(self.ideal_pins)}
        force = kinetics.weight(self.scenario.gravity)
        multipliers = data.GetAECoordinates(INITIAL)
        for _ in range(FRICTION_ROUNDS):
            _, reactions = kinetics.respond(position, force, turning)
            force = kinetics.weight(self.scenario.gravity)
            for name, friction in self.frictions.items():
                pin = reactions[place[name] : place[name] + 2]
                first = self.ideal_pins[name].first
                multipliers[first : first + 2] = pin
                friction.add_moment(force, float(np.hypot(*pin)), velocity)
        data.SetAECoordinates(multipliers, INITIAL)

    def reset_memory(self) -> None:
        """Give every clearance pin the memory that belongs to the initial state of the bodies."""
        data = self.mbs.systemData
        position, rates = data.GetODE2Coordinates(INITIAL), data.GetODE2Coordinates_t(INITIAL)
        for name, pin in self.loose_pins.items():
            state = self._contact_state(name, pin, INITIAL)
            touching = state.depth > 0.0
            memory = PinMemory(
                in_contact=touching,
                approach_speed=max(0.0, state.rate) if touching else 0.0,
                depth=state.depth,
                rate=state.rate,
                slip=state.slip,
            ).with_mobility(self.mobility(name, INITIAL))
            bore, journal = self._ends(name)
            turn = self._turn(journal, position) - self._turn(bore, position)
            pin.start(memory, turn, (self.bore_angle(name, position), self._turn(bore, rates)))

    def refresh_memory(self) -> None:
        """Tell every clearance pin that velocities have jumped; contacts that go on go on."""
        for name, pin in self.loose_pins.items():
            state = self._contact_state(name, pin, CURRENT)
            pin.jumped(pin.kept._replace(depth=state.depth, rate=state.rate, slip=state.slip))

    def pin_motion(self, name: str) -> PinMotion:
        """How the journal of a clearance pin moves in its bore."""
        place = self.linkage.pins[name]
        bore, journal = self._ends(name)
        points = {place.first: place.first_point, place.second: place.second_point}

        def end(body: str) -> PinEnd:
            if body == GROUND:
                return PinEnd(None, (0.0, 0.0), 0.0, points[body])
            item = self.bodies[body]
            return PinEnd(item.first, item.body.centre, item.body.angle, item.local(points[body]))

        return PinMotion(self.mbs.systemData, end(bore), end(journal))

    def _contact_state(self, name: str, pin: LoosePin, state: Any) -> ContactForce:
        def relative(what: Any) -> tuple[float, float]:
            journal = self.mbs.GetMarkerOutput(pin.connector.journal_marker, what, state)
            bore = self.mbs.GetMarkerOutput(pin.connector.bore_marker, what, state)
            return float(journal[0] - bore[0]), float(journal[1] - bore[1])

        output = exudyn.OutputVariableType
        rates = self.mbs.systemData.GetODE2Coordinates_t(state)
        bore_spin, journal_spin = (self._turn(body, rates) for body in self._ends(name))
        return pin.contact.force(
            *relative(output.Position), *relative(output.Velocity), bore_spin, journal_spin, None
        )


class _Builder:
    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.linkage = scenario.linkage
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self._markers: dict[tuple[str, Vector2], Any] = {}  # by body and point of the start posture
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

    def add_weight(self, name: str, body: Body) -> None:
        gx, gy = self.scenario.gravity
        weight = [body.mass * gx, body.mass * gy, 0.0]
        self.mbs.AddLoad(LoadForceVector(markerNumber=self.marker(name, body.centre), loadVector=weight))

    def marker(self, body: str, point: Vector2) -> Any:
        """The marker on a body at a point of the start posture; parts that meet there share it."""
        if (body, point) not in self._markers:
            on_ground = body == GROUND
            item = self.ground if on_ground else self.bodies[body].object
            place = point if on_ground else self.bodies[body].local(point)
            marker = MarkerBodyRigid(bodyNumber=item, localPosition=[*place, 0.0])
            self._markers[body, point] = self.mbs.AddMarker(marker)
        return self._markers[body, point]

    def add_ideal(self, place: PinPlace) -> Any:
        markers = [self.marker(place.first, place.first_point), self.marker(place.second, place.second_point)]
        return self.mbs.AddObject(ObjectJointRevolute2D(markerNumbers=markers))

    def add_friction(self, place: PinPlace, pin: IdealPin) -> PinFriction:
        assert pin.friction is not None  # the pins without are left out
        assert pin.radius is not None  # goes with it
        first, second = (
            self.bodies[name].node if name != GROUND else None for name in (place.first, place.second)
        )
        return PinFriction(self.mbs, pin.friction, pin.radius, first, second)

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

        def node(body: str) -> Any:
            return None if body == GROUND else self.bodies[body].node

        return LoosePin(
            self.mbs,
            pin.contact,
            bore=(item(bore), frame(local(bore, bore_point))),
            journal=(item(journal), frame(local(journal, journal_point))),
            turn=angle(journal) - angle(bore),
            bore_node=node(bore),
            journal_node=node(journal),
            symbolic=self.scenario.solver.backend == "symbolic",
            impact_steps=self.scenario.solver.impact_steps,
        )

    def add_rigid_column(self, column: Column) -> Any:
        return self.mbs.AddObject(
            ObjectConnectorDistance(markerNumbers=self.ends(column), distance=column.start_length)
        )

    def add_oil_column(self, column: Column) -> Any:
        # what it carries and how stiff it is follows once the machine is whole
        return self.mbs.AddObject(
            ObjectConnectorSpringDamper(markerNumbers=self.ends(column), referenceLength=column.start_length)
        )

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

    def by_drive(
        self, rigid: dict[str, ColumnItem], oil: dict[str, OilColumnItem], cranks: dict[str, CrankItem]
    ) -> tuple[DrivenParts, ...]:
        """All that can be driven, by drive."""
        drives: list[Drive] = []
        for name in (*rigid, *oil, *cranks):
            if (drive := self.scenario.drive_of(name)) not in drives:
                drives.append(drive)

        def of(drive: Drive, items: dict[str, Item]) -> tuple[Item, ...]:
            return tuple(item for name, item in items.items() if self.scenario.drive_of(name) == drive)

        return tuple(
            DrivenParts(self.mbs, one, of(one, rigid), of(one, oil), of(one, cranks)) for one in drives
        )

    def build(self) -> Scene:
        loose = {
            name: self.add_loose(self.linkage.pins[name], pin)
            for name, pin in self.scenario.clearance_pins.items()
        }
        ideal = {name: self.add_ideal(place) for name, place in self.linkage.pins.items() if name not in loose}
        frictions = {
            name: self.add_friction(self.linkage.pins[name], pin)
            for name, pin in self.scenario.friction_pins.items()
        }
        oil = {name: self.add_oil_column(self.linkage.columns[name]) for name in self.scenario.oil_columns}
        rigid = {
            name: self.add_rigid_column(column)
            for name, column in self.linkage.columns.items()
            if name not in oil
        }
        cranks = {name: self.add_crank(crank) for name, crank in self.linkage.cranks.items()}
        slides = {name: self.add_slide(slide) for name, slide in self.linkage.slides.items()}
        if any(self.scenario.gravity):
            for name, body in self.linkage.bodies.items():
                self.add_weight(name, body)
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
            ideal_pins={name: IdealItem(o, int(data.GetObjectLTGAE(o)[0])) for name, o in ideal.items()},
            frictions=frictions,
            loose_pins=loose,
            rigid_columns=rigid_columns,
            oil_columns=oil_columns,
            cranks=crank_items,
            slides={name: SlideItem(o, int(data.GetObjectLTGAE(o)[0])) for name, o in slides.items()},
            driven=self.by_drive(rigid_columns, oil_columns, crank_items),
        )
        for name, friction in frictions.items():
            place = self.linkage.pins[name]
            turns = (bodies[end].first + 2 if end != GROUND else None for end in (place.first, place.second))
            friction.assembled(scene.ideal_pins[name].first, *turns)
            friction.lagged = bool(loose) or self.scenario.jumps
        for name, pin in loose.items():
            pin.mobility = partial(scene.mobility, name)
            pin.motion = scene.pin_motion(name)
        scene.drive_to(0.0)
        scene.start_moving()
        scene.start_rubbing()
        scene.reset_memory()
        return scene


def build(scenario: Scenario) -> Scene:
    """The engine's model of a scenario at its start, before any settling."""
    return _Builder(scenario).build()
