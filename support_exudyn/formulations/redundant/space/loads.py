"""Loads in the engine in space: forces by the connector of the plane, moments by one that knows all turns."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import singledispatch
from typing import Any

import exudyn
from exudyn.itemInterface import MarkerBodyRigid, ObjectConnectorRigidBodySpringDamper

from support_exudyn.formulations.redundant.scene.engine_builder import EngineBuilder
from support_exudyn.formulations.redundant.scene.load_item import LoadItem, MomentItem, add_force
from support_exudyn.mechanics.space.acting_loads import turning_axis
from support_exudyn.model.loads.load import ActingLoad, Load
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from support_exudyn.model.to_space import at
from user_forces.values.value import Vector3


class LateralTurn:
    """How a body has turned about the lateral axis, from the engine's three angles; it counts whole turns.

    The engine tells the turn of a body in another's axes as R = R_x(a) R_y(b) R_z(c).
    """

    def __init__(self) -> None:
        self.last = 0.0  # [rad]

    def look(self, angles: Any, spin: Any) -> tuple[float, float, Vector3]:
        """Turn [rad], its rate [rad/s], and the axis by which a moment acts on it, see `turning_axis`.

        spin: angular velocity of the body in the other's axes [rad/s].
        """
        a, b, c = (float(angle) for angle in angles)
        x, y, z = (
            math.cos(b) * math.cos(c),
            math.cos(a) * math.sin(c) + math.sin(a) * math.sin(b) * math.cos(c),
            math.sin(a) * math.sin(c) - math.cos(a) * math.sin(b) * math.cos(c),
        )
        axis: Vector3 = turning_axis(x, y, z)
        self.last += math.remainder(math.atan2(y, x) - self.last, 2.0 * math.pi)
        return self.last, float(sum(k * w for k, w in zip(axis, spin, strict=True))), axis


@dataclass(frozen=True)
class SpatialMomentItem(MomentItem):
    """A moment on a body in space."""

    turning: LateralTurn

    def at(self, t: float) -> TurnedBody:
        """See `LoadItem`."""
        output = exudyn.OutputVariableType
        angles = self.mbs.GetObjectOutput(self.object, output.Rotation)
        turn, rate, _ = self.turning.look(
            angles, self.mbs.GetObjectOutput(self.object, output.AngularVelocityLocal)
        )
        return TurnedBody(t, turn, rate)


@singledispatch
def add_load(load: ActingLoad, name: str, builder: EngineBuilder) -> LoadItem:
    """Add what stands in the engine for a load of this name."""
    raise TypeError(f"loads.{name} = {type(load).__name__}: is neither a Load nor a MomentLoad")


@add_load.register
def _add_force(load: Load, name: str, builder: EngineBuilder) -> LoadItem:
    origin = builder.marker(load.against(name), at(load.origin, load.origin_lateral))
    return add_force(builder.mbs, load, origin, builder.marker(load.body, at(load.point, load.lateral)))


@add_load.register
def _add_moment(load: MomentLoad, name: str, builder: EngineBuilder) -> LoadItem:
    del name
    mbs, turning = builder.mbs, LateralTurn()
    markers = [
        mbs.AddMarker(MarkerBodyRigid(bodyNumber=builder.item(body))) for body in (load.other, load.body)
    ]
    function = _twist(load, turning)
    connector = mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(markerNumbers=markers, springForceTorqueUserFunction=function)
    )
    return SpatialMomentItem(mbs, load, connector, function, turning)


def _twist(load: MomentLoad, turning: LateralTurn) -> Callable[..., list[float]]:
    """Force and moment on the first body, in its axes, of the engine's signature."""

    def twist(
        mbs: Any, t: float, item: int, shift: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        turn, rate, axis = turning.look(angles, spin)
        moment = load.moment(TurnedBody(t, turn, rate))
        return [0.0, 0.0, 0.0, *(-moment * k for k in axis)]

    return twist
