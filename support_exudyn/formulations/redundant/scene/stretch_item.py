# ruff: noqa: N803 - the engine goes by the names of arguments
"""Loads over a stretch of a body in the engine: a force and a moment at its first point."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import exudyn
from exudyn.advancedUtilities import CreateSymbolicUserFunction
from exudyn.itemInterface import ObjectConnectorRigidBodySpringDamper
from user_forces.expressions.scalar import cos, sin

from support_exudyn.formulations.redundant.clearance.symbolic_force import engine, is_formula, real, unknown
from support_exudyn.formulations.redundant.scene.load_item import LoadItem
from support_exudyn.model.loads.stretch_load import LoadedStretch, StretchLoad
from user_forces.values.value import Vector2

NAME = "springForceTorqueUserFunction"  # the engine's, of its rigid-body connector


@dataclass(frozen=True)
class StretchItem(LoadItem):
    """Forces over a stretch in the engine; ends: markers of its first and its second point."""

    load: StretchLoad
    ends: tuple[Any, Any]

    def at(self, t: float) -> LoadedStretch:
        """See `LoadItem`."""
        output = exudyn.OutputVariableType
        places, rates = (
            [float(self.mbs.GetMarkerOutput(end, what)[1]) for end in self.ends]
            for what in (output.Position, output.Velocity)
        )
        ways = [place - point[1] for place, point in zip(places, self.load.points, strict=True)]
        return LoadedStretch(t, ways[0], ways[1], rates[0], rates[1])

    def said(self, at: LoadedStretch) -> tuple[str, float, float]:
        """See `LoadItem`."""
        first, second = self.load.forces(at)
        size = math.hypot(first, second)
        return f"force of {first:g}, {second:g} N", size, size * math.hypot(at.first_rate, at.second_rate)


class FirstPoint(NamedTuple):
    """What the connector tells: time [s], way up [m], its rate [m/s], turn [rad] and its rate [rad/s]."""

    time: float
    way: float
    rate: float
    turn: float
    spin: float


def pull(load: StretchLoad, at: FirstPoint) -> Vector2:
    """With what the connector pulls its ends together: force up [N] and moment [N m] about the first point."""
    (x, y), (u, v) = load.points
    along, up = u - x, v - y
    c, s = cos(at.turn), sin(at.turn)
    arm, rise = along * c - up * s, along * s + up * (c - 1.0)
    stretch = LoadedStretch(at.time, at.way, at.way + rise, at.rate, at.rate + at.spin * arm)
    first, second = load.forces(stretch)
    return -first - second, -arm * second


def add_stretch(mbs: Any, load: StretchLoad, origin: Any, first: Any, second: Any) -> StretchItem:
    """Let a load act between a marker on the ground and the first of two on the body."""
    connector = mbs.AddObject(ObjectConnectorRigidBodySpringDamper(markerNumbers=[origin, first]))
    function: Any = _force(load)
    if is_formula(lambda *known: pull(load, FirstPoint(*known)), len(FirstPoint._fields)):
        function = CreateSymbolicUserFunction(mbs, _expression(load), NAME, connector)
    mbs.SetObjectParameter(connector, NAME, function)
    return StretchItem(mbs, load, connector, function, (first, second))


def _force(load: StretchLoad) -> Callable[..., list[float]]:
    """Force and moment of the connector, of the engine's signature, in Python."""

    def force(
        mbs: Any, t: float, item: int, way: Any, rotation: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        up, moment = pull(load, FirstPoint(t, way[1], velocity[1], rotation[2], spin[2]))
        return [0.0, up, 0.0, 0.0, 0.0, moment]

    return force


def _expression(load: StretchLoad) -> Callable[..., Any]:
    """The force of `_force` as a function that the engine calls once, with symbols, by names of arguments."""

    def force(*known: Any) -> Any:
        up, moment = pull(load, FirstPoint(*map(unknown, known)))
        zero = engine.Real(0.0)
        return engine.Vector([zero, real(up), zero, zero, zero, real(moment)])

    def rigid(  # type: ignore[no-untyped-def]
        mbs,
        t,
        itemNumber,
        displacement,
        rotation,
        velocity,
        angularVelocity,
        stiffness,
        damping,
        rotJ0,
        rotJ1,
        offset,
    ):
        return force(t, displacement[1], velocity[1], rotation[2], angularVelocity[2])

    return rigid
