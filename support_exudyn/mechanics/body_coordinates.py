"""Where the parts of a linkage stand in the engine."""

from dataclasses import dataclass
from typing import Any, Protocol

from support_exudyn.model.linkage import Body, Crank
from support_exudyn.model.plane_geometry import minus, rotated
from user_forces.values.value import Vector2


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


class Strut(Protocol):
    """An actuator of the plane or of space."""

    @property
    def start_length(self) -> float:
        """Distance of its ends at the start [m]."""
        ...


@dataclass(frozen=True)
class ActuatorItem:
    """A rigid driven actuator in the engine: its object and its multiplier."""

    actuator: Strut
    object: Any
    multiplier: int


@dataclass(frozen=True)
class CrankItem:
    """A driven crank in the engine: its object and its multiplier."""

    crank: Crank
    object: Any
    multiplier: int


@dataclass(frozen=True)
class SlideItem:
    """A straight guide in the engine: its object and the first of its multipliers."""

    object: Any
    first: int
