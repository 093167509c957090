"""Loads over a stretch of a body in the engine: a force and a moment at its first point."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import exudyn
from exudyn.itemInterface import ObjectConnectorRigidBodySpringDamper

from support_exudyn.formulations.exudyn.scene.load_item import LoadItem
from support_exudyn.model.loads.stretch_load import LoadedStretch, StretchLoad

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


def add_stretch(mbs: Any, load: StretchLoad, origin: Any, first: Any, second: Any) -> StretchItem:
    """Let a load act between a marker on the ground and the first of two on the body."""
    connector = mbs.AddObject(ObjectConnectorRigidBodySpringDamper(markerNumbers=[origin, first]))
    function = _force(load)
    mbs.SetObjectParameter(connector, NAME, function)
    return StretchItem(mbs, load, connector, function, (first, second))


def _force(load: StretchLoad) -> Callable[..., list[float]]:
    """Force up [N] and moment [N m] with which the connector pulls its ends together at the first point."""
    (x, y), (u, v) = load.points
    along, up = u - x, v - y

    def force(
        mbs: Any, t: float, item: int, way: Any, rotation: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        c, s = math.cos(rotation[2]), math.sin(rotation[2])
        arm, rise = along * c - up * s, along * s + up * (c - 1.0)
        first, second = load.forces(
            LoadedStretch(t, way[1], way[1] + rise, velocity[1], velocity[1] + spin[2] * arm)
        )
        return [0.0, -first - second, 0.0, 0.0, 0.0, -arm * second]

    return force
