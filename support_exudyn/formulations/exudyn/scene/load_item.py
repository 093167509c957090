"""Loads in the engine, in the plane and in space: a connector for each strain kind, which calls the action.

They are connectors and no loads of the engine's, for those have no Jacobian, without which Newton's method does
not get along with a stiff one. What a connector gives is what pulls its ends together: minus the force.
"""

import math
import sys
from abc import ABC, abstractmethod
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import ObjectConnectorCartesianSpringDamper, ObjectConnectorRigidBodySpringDamper

from support_exudyn.formulations.exudyn.scene.engine_builder import EngineBuilder
from support_exudyn.mechanics.acting_loads import turning_axis
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.load import (
    ActingLoad,
    Load,
    LoadAction,
    LoadedPoint,
    LoadedStretch,
    MomentLoad,
    StretchLoad,
    TurnedBody,
)
from user_forces.lawful import ROUNDING, LawError
from user_forces.values.value import Vector3

ROUNDINGS = 8.0  # of a point's coordinates, from which ways are computed
KNOWN = exudyn.OutputVariableType


class LoadItem(ABC):
    """A load in the engine: its data, its connector, and the connector's function, which must live as long."""

    def __init__(self, load: ActingLoad, builder: EngineBuilder) -> None:
        self.load, self.mbs = load, builder.mbs
        self.object: Any = None
        self.rounding = 0.0  # force by which rounding of positions lets it scatter [N]

    @abstractmethod
    def at(self, t: float) -> Any:
        """The motion that the load follows, at the end of a step, t [s]."""

    def acting(self, t: float) -> LoadAction:
        """What the load does at the end of a step, t [s]."""
        return self.load.acting(self.at(t))

    def probe(self, t: float, name: str) -> None:
        """Raise LawError if the load has no finite force at a time t [s] where its bodies are now."""
        forces = self.acting(t).forces
        if not all(map(math.isfinite, forces)):
            said = ", ".join(f"{force:g}" for force in forces)
            what, unit = ("moment", "N m") if isinstance(self.load, MomentLoad) else ("force", "N")
            raise LawError(f"{name}: {type(self.load).__name__} has a {what} of {said} {unit}")

    def look(self, t: float, name: str) -> None:
        """Raise LawError if the load gives at t [s] what it should lose, but for rounding, or no number."""
        at = self.at(t)
        now = self.load.acting(at)
        power = math.hypot(*now.forces) * math.hypot(*self.rates(at))
        if not now.loss >= -ROUNDING * (abs(now.work) + power):
            raise LawError(f"{name}: {type(self.load).__name__} loses {now.loss:.6g} W; allowed: >= 0")

    @abstractmethod
    def rates(self, at: Any) -> tuple[float, ...]:
        """The rates of the strain."""


class ForceItem(LoadItem):
    """A force on a point: a connector in the axes of the ground."""

    def __init__(self, load: Load, name: str, builder: EngineBuilder) -> None:
        super().__init__(load, builder)
        origin = builder.marker(load.against(name), builder.place(load.origin, load.origin_lateral))
        point = builder.marker(load.body, builder.place(load.point, load.lateral))
        self.object = self.mbs.AddObject(
            ObjectConnectorCartesianSpringDamper(
                markerNumbers=[origin, point], springForceUserFunction=self.pull
            )
        )
        farthest = max(map(abs, (*load.point, *load.origin)))
        self.rounding = ROUNDINGS * sys.float_info.epsilon * math.hypot(*load.steepness) * farthest

    def pull(self, mbs: Any, t: float, item: int, way: Any, velocity: Any, *others: Any) -> list[float]:
        """The engine's user function."""
        (x, y, z), (vx, vy, vz) = way, velocity
        return [-force for force in self.load.numbers(LoadedPoint(t, x, y, vx, vy, z, vz))[:3]]

    def at(self, t: float) -> LoadedPoint:
        """See `LoadItem`."""
        x, y, z = map(float, self.mbs.GetObjectOutput(self.object, KNOWN.Displacement))
        vx, vy, vz = map(float, self.mbs.GetObjectOutput(self.object, KNOWN.Velocity))
        return LoadedPoint(t, x, y, vx, vy, z, vz)

    def rates(self, at: LoadedPoint) -> tuple[float, ...]:
        """See `LoadItem`."""
        return at.vx, at.vy, at.vz


class MomentItem(LoadItem):
    """A moment on a body: a connector that knows all turns, in the other body's axes; it counts whole turns."""

    def __init__(self, load: MomentLoad, name: str, builder: EngineBuilder) -> None:
        super().__init__(load, builder)
        del name
        self._turn = 0.0  # [rad], the last
        self.object = self.mbs.AddObject(
            ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[builder.frame(body) for body in (load.other, load.body)],
                springForceTorqueUserFunction=self.pull,
            )
        )

    def pull(
        self, mbs: Any, t: float, item: int, shift: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        """The engine's user function."""
        at, axis = self._turned(t, angles, spin)
        moment = self.load.numbers(at)[0]
        return [0.0, 0.0, 0.0, *(-moment * k for k in axis)]

    def _turned(self, t: float, angles: Any, spin: Any) -> tuple[TurnedBody, Vector3]:
        """Turn and rate, and the axis by which a moment acts on them; angles, spin: in the other's axes."""
        x, y, z = _forward(*map(float, angles)).tolist()
        axis: Vector3 = turning_axis(x, y, z)
        self._turn += math.remainder(math.atan2(y, x) - self._turn, 2.0 * math.pi)
        rate = float(sum(k * w for k, w in zip(axis, spin, strict=True)))
        return TurnedBody(t, self._turn, rate), axis

    def at(self, t: float) -> TurnedBody:
        """See `LoadItem`."""
        angles, spin = (
            self.mbs.GetObjectOutput(self.object, what) for what in (KNOWN.Rotation, KNOWN.AngularVelocityLocal)
        )
        return self._turned(t, angles, spin)[0]

    def rates(self, at: TurnedBody) -> tuple[float, ...]:
        """See `LoadItem`."""
        return (at.spin,)


class StretchItem(LoadItem):
    """Forces over a stretch: a connector from the ground to its first point, with force and moment there."""

    load: StretchLoad

    def __init__(self, load: StretchLoad, name: str, builder: EngineBuilder) -> None:
        super().__init__(load, builder)
        places = [builder.place(point, load.lateral) for point in load.points]
        first = builder.frame(load.body, places[0])
        self.ends = first, builder.marker(load.body, places[1])
        self.object = self.mbs.AddObject(
            ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[builder.frame(load.against(name), places[0]), first],
                springForceTorqueUserFunction=self.pull,
            )
        )

    def pull(
        self, mbs: Any, t: float, item: int, way: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        """The engine's user function."""
        (x, y), (u, v) = self.load.points
        a, b, c = map(float, angles)
        arm = (u - x) * _forward(a, b, c) + (v - y) * _upward(a, b, c)
        rate = velocity[1] + spin[2] * arm[0] - spin[0] * arm[2]
        at = LoadedStretch(t, way[1], way[1] + arm[1] - (v - y), velocity[1], rate)
        first, second = self.load.numbers(at)[:2]
        return [0.0, -first - second, 0.0, arm[2] * second, 0.0, -arm[0] * second]

    def at(self, t: float) -> LoadedStretch:
        """See `LoadItem`."""
        heights, rates = (
            [float(self.mbs.GetMarkerOutput(end, what)[1]) for end in self.ends]
            for what in (KNOWN.Position, KNOWN.Velocity)
        )
        ways = [height - point[1] for height, point in zip(heights, self.load.points, strict=True)]
        return LoadedStretch(t, ways[0], ways[1], rates[0], rates[1])

    def rates(self, at: LoadedStretch) -> tuple[float, ...]:
        """See `LoadItem`."""
        return at.first_rate, at.second_rate


def _forward(a: float, b: float, c: float) -> Series:
    """A body's forward direction in the other's axes, by the engine's angles: R = R_x(a) R_y(b) R_z(c)."""
    sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    return np.array([cb * cc, ca * sc + sa * sb * cc, sa * sc - ca * sb * cc])


def _upward(a: float, b: float, c: float) -> Series:
    """A body's upward direction in the other's axes, see `_forward`."""
    sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    return np.array([-cb * sc, ca * cc - sa * sb * sc, sa * cc + ca * sb * sc])


def add_load(load: ActingLoad, name: str, builder: EngineBuilder) -> LoadItem:
    """Add what stands in the engine for a load of this name. Raises TypeError for one of no strain kind."""
    if isinstance(load, Load):
        return ForceItem(load, name, builder)
    if isinstance(load, MomentLoad):
        return MomentItem(load, name, builder)
    if isinstance(load, StretchLoad):
        return StretchItem(load, name, builder)
    raise TypeError(f"loads.{name} = {type(load).__name__}: is no Load, MomentLoad or StretchLoad")
