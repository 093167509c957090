"""What builders of models in the engine share, in the plane and in space."""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import exudyn
from exudyn.itemInterface import (
    LoadForceVector,
    ObjectConnectorDistance,
    ObjectConnectorSpringDamper,
    ObjectGround,
)

from support_exudyn.formulations.exudyn.scene.driven_parts import HeldItem
from support_exudyn.formulations.exudyn.scene.engine_legs import EngineLegs
from support_exudyn.formulations.exudyn.scene.leg_circuit import LegItem
from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.model.linkage import GROUND
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector2


class EngineBuilder(ABC):
    """Nothing is made in the engine that was not asked for. bodies: items of all that move, by name."""

    bodies: Mapping[str, Any]

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.container = exudyn.SystemContainer()
        self.mbs = self.container.AddSystem()
        self._markers: dict[tuple[str, Any], Any] = {}  # by body and point of the start posture

    @cached_property
    def ground(self) -> Any:
        """The engine's body that does not move, made if something stands on it."""
        return self.mbs.AddObject(ObjectGround())

    def item(self, body: str) -> Any:
        """The engine's object of a body."""
        return self.ground if body == GROUND else self.bodies[body].object

    def node(self, body: str) -> Any:
        """The engine's node of a body; None for the ground."""
        return None if body == GROUND else self.bodies[body].node

    def marker(self, body: str, point: Any) -> Any:
        """The marker on a body at a point of the start posture; parts that meet there share it."""
        if (body, point) not in self._markers:
            self._markers[body, point] = self.mbs.AddMarker(self.new_marker(body, point))
        return self._markers[body, point]

    @abstractmethod
    def new_marker(self, body: str, point: Any) -> Any:
        """A marker on a body at a point of the start posture, not yet in the engine."""

    @abstractmethod
    def place(self, point: Vector2, lateral: float) -> Any:
        """A point of the plane's start posture, so far to the right [m], as markers take points."""

    @abstractmethod
    def frame(self, body: str, point: Any = None) -> Any:
        """A marker on a body with the axes of the ground at the start, at a point; None: at its centre."""

    def add_weight(self, name: str, body: Any) -> Any:
        """Let gravity act on a body."""
        gx, gy = self.scenario.gravity
        weight = [body.mass * gx, body.mass * gy, 0.0]
        return self.mbs.AddLoad(LoadForceVector(markerNumber=self.marker(name, body.centre), loadVector=weight))

    def add_rigid_actuator(self, actuator: Any) -> Any:
        """Hold the ends of an actuator apart."""
        ends = self.ends(actuator)
        return self.mbs.AddObject(ObjectConnectorDistance(markerNumbers=ends, distance=actuator.start_length))

    def add_leg(self, leg: PreloadedLeg) -> LegItem:
        """Put a hydraulic leg in place of an actuator; its force follows when all is there."""
        ends, model = self.ends(leg.actuator), leg.model
        spring = ObjectConnectorSpringDamper(markerNumbers=ends, referenceLength=leg.actuator.start_length)
        drive = self.scenario.drive_of(leg.name)
        source = model.inlet if isinstance(model, HydraulicCylinder) else drive
        return LegItem(self.mbs, leg, ends, self.mbs.AddObject(spring), source)

    def join_legs(self, items: Iterable[LegItem]) -> EngineLegs:
        """All legs, and the pump that they share."""
        scenario = self.scenario
        mass = sum(body.mass for body in scenario.linkage.bodies.values())
        weight = mass * math.hypot(*scenario.gravity)
        return EngineLegs(tuple(items), scenario.pump, weight)

    def ends(self, actuator: Any) -> list[Any]:
        """The markers of foot and head."""
        return [
            self.marker(actuator.foot, actuator.foot_point),
            self.marker(actuator.head, actuator.head_point),
        ]

    def held_items(self, parts: Mapping[str, Any], objects: Mapping[str, Any]) -> dict[str, HeldItem]:
        """Items of constraints, from parts of the linkage and objects of the engine by name."""
        return {name: HeldItem(parts[name], item, self.multiplier(item)) for name, item in objects.items()}

    def multiplier(self, item: Any) -> int:
        """The first multiplier of a constraint, once all is assembled."""
        return int(self.mbs.systemData.GetObjectLTGAE(item)[0])
