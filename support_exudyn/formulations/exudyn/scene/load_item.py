"""Loads in the engine: a connector between the loaded point or body and what it is loaded from.

They are connectors and no loads of the engine's, for those have no Jacobian, without which Newton's method does
not get along with a stiff one.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import exudyn
from exudyn.itemInterface import ObjectConnectorCartesianSpringDamper, ObjectConnectorCoordinateSpringDamper

from support_exudyn.model.loads.load import ActingLoad, Load, LoadedPoint, Powers
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from user_forces.lawful import ROUNDING, LawError

NAME = "springForceUserFunction"  # the engine's, of its springs


@dataclass(frozen=True)
class LoadItem(ABC):
    """A load in the engine: its data, its connector, and the force, which must live as long as it."""

    mbs: Any
    load: ActingLoad
    object: Any
    function: Any

    @abstractmethod
    def at(self, t: float) -> Any:
        """What the load is told of the motion at the end of a step, t [s]."""

    @abstractmethod
    def said(self, at: Any) -> tuple[str, float, float]:
        """Its force [N] or moment [N m] in words, its size, and the size of its power [W]."""

    def powers(self, t: float) -> Powers:
        """Powers [W] at the end of a step, t [s]."""
        return self.load.powers(self.at(t))

    def probe(self, t: float, name: str) -> None:
        """Raise LawError if the load has no finite force at a time t [s] where the point is now."""
        said, size, _ = self.said(self.at(t))
        if not math.isfinite(size):
            raise LawError(f"{name}: {type(self.load).__name__} has a {said}")

    def look(self, t: float, name: str) -> None:
        """Raise LawError if the load gives at t [s] what it should lose, but for rounding, or no number."""
        at = self.at(t)
        work, loss = self.load.powers(at)
        _, _, power = self.said(at)
        if not loss >= -ROUNDING * (abs(work) + power):
            raise LawError(f"{name}: {type(self.load).__name__} loses {loss:.6g} W; allowed: >= 0")


@dataclass(frozen=True)
class ForceItem(LoadItem):
    """A force on a point in the engine."""

    load: Load

    def at(self, t: float) -> LoadedPoint:
        """See `LoadItem`."""
        output = exudyn.OutputVariableType
        x, y, z = self.mbs.GetObjectOutput(self.object, output.Displacement)
        vx, vy, vz = self.mbs.GetObjectOutput(self.object, output.Velocity)
        return LoadedPoint(t, float(x), float(y), float(vx), float(vy), float(z), float(vz))

    def said(self, at: LoadedPoint) -> tuple[str, float, float]:
        """See `LoadItem`."""
        along, up, aside = self.load.pushes(at)
        size = math.hypot(along, up, aside)
        said = f"force of {along:g}, {up:g}" + f", {aside:g}" * (aside != 0.0)
        return f"{said} N", size, size * math.hypot(at.vx, at.vy, at.vz)


@dataclass(frozen=True)
class MomentItem(LoadItem):
    """A moment on a body in the engine."""

    load: MomentLoad

    def at(self, t: float) -> TurnedBody:
        """See `LoadItem`."""
        output = exudyn.OutputVariableType
        turn = self.mbs.GetObjectOutput(self.object, output.Displacement)
        return TurnedBody(t, float(turn), float(self.mbs.GetObjectOutput(self.object, output.Velocity)))

    def said(self, at: TurnedBody) -> tuple[str, float, float]:
        """See `LoadItem`."""
        moment = self.load.moment(at)
        return f"moment of {moment:g} N m", abs(moment), abs(moment * at.spin)


def add_force(mbs: Any, load: Load, origin: Any, point: Any) -> ForceItem:
    """Let a force act between a marker on what it acts against and one on the body."""
    connector = mbs.AddObject(ObjectConnectorCartesianSpringDamper(markerNumbers=[origin, point]))
    function = _pull(load)
    mbs.SetObjectParameter(connector, NAME, function)
    return ForceItem(mbs, load, connector, function)


def add_moment(mbs: Any, load: MomentLoad, rotations: list[Any]) -> MomentItem:
    """Let a moment act between markers of the rotations of what it acts against and of the body."""
    connector = mbs.AddObject(ObjectConnectorCoordinateSpringDamper(markerNumbers=rotations))
    function = _twist(load)
    mbs.SetObjectParameter(connector, NAME, function)
    return MomentItem(mbs, load, connector, function)


def _pull(load: Load) -> Callable[..., list[float]]:
    """The force with which the connector pulls its ends together, of the engine's signature."""

    def pull(mbs: Any, t: float, item: int, displacement: Any, velocity: Any, *others: Any) -> list[float]:
        (x, y, z), (vx, vy, vz) = displacement, velocity
        return [-push for push in load.pushes(LoadedPoint(t, x, y, vx, vy, z, vz))]

    return pull


def _twist(load: MomentLoad) -> Callable[..., float]:
    """The moment with which the connector turns its ends together, of the engine's signature."""

    def twist(mbs: Any, t: float, item: int, displacement: Any, velocity: Any, *others: Any) -> float:
        return -load.moment(TurnedBody(t, displacement, velocity))

    return twist
