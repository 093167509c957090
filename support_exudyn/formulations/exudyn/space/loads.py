"""Loads in the engine in space: forces by the connector of the plane, moments by one that knows all turns."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import singledispatch
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import MarkerBodyRigid, ObjectConnectorRigidBodySpringDamper

from support_exudyn.formulations.exudyn.scene.engine_builder import EngineBuilder
from support_exudyn.formulations.exudyn.scene.load_item import LoadItem, MomentItem, add_force
from support_exudyn.formulations.exudyn.scene.stretch_item import StretchItem
from support_exudyn.mechanics.space.acting_loads import turning_axis
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.load import ActingLoad, Load
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from support_exudyn.model.loads.stretch_load import LoadedStretch, StretchLoad
from support_exudyn.model.to_space import at
from user_forces.values.value import Vector3


class LateralTurn:
    """How a body has turned about the lateral axis, from the engine's three angles; it counts whole turns."""

    def __init__(self) -> None:
        self.last = 0.0  # [rad]

    def look(self, angles: Any, spin: Any) -> tuple[float, float, Vector3]:
        """Turn [rad], its rate [rad/s], and the axis by which a moment acts on it, see `turning_axis`.

        spin: angular velocity of the body in the other's axes [rad/s].
        """
        x, y, z = _forward(*(float(angle) for angle in angles)).tolist()
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
    raise TypeError(f"loads.{name} = {type(load).__name__}: is no Load, MomentLoad or StretchLoad")


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


@add_load.register
def _add_stretch(load: StretchLoad, name: str, builder: EngineBuilder) -> LoadItem:
    mbs, places = builder.mbs, [at(point, load.lateral) for point in load.points]
    origin, first = (_with_axes(builder, body, places[0]) for body in (load.against(name), load.body))
    function = _spread(load)
    connector = mbs.AddObject(
        ObjectConnectorRigidBodySpringDamper(
            markerNumbers=[origin, first], springForceTorqueUserFunction=function
        )
    )
    return StretchItem(mbs, load, connector, function, (first, builder.marker(load.body, places[1])))


def _with_axes(builder: EngineBuilder, body: str, point: Vector3) -> Any:
    """A marker that has axes, too, at a point of the start posture."""
    plain = builder.new_marker(body, point)
    return builder.mbs.AddMarker(
        MarkerBodyRigid(bodyNumber=plain.bodyNumber, localPosition=plain.localPosition)
    )


def _spread(load: StretchLoad) -> Callable[..., list[float]]:
    """Force and moment of a stretch, with which the connector pulls its ends together at the first point."""
    (x, y), (u, v) = load.points
    along, up = u - x, v - y

    def spread(
        mbs: Any, t: float, item: int, way: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        a, b, c = (float(angle) for angle in angles)
        arm = along * _forward(a, b, c) + up * _upward(a, b, c)
        rate = velocity[1] + spin[2] * arm[0] - spin[0] * arm[2]
        first, second = load.forces(LoadedStretch(t, way[1], way[1] + arm[1] - up, velocity[1], rate))
        return [0.0, -first - second, 0.0, arm[2] * second, 0.0, -arm[0] * second]

    return spread


def _forward(a: float, b: float, c: float) -> Series:
    """A body's forward direction in the other's axes, by the engine's angles: R = R_x(a) R_y(b) R_z(c)."""
    sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    return np.array([cb * cc, ca * sc + sa * sb * cc, sa * sc - ca * sb * cc])


def _upward(a: float, b: float, c: float) -> Series:
    """A body's upward direction in the other's axes, see `_forward`."""
    sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    return np.array([-cb * sc, ca * cc - sa * sb * sc, sa * cc + ca * sb * sc])


def _twist(load: MomentLoad, turning: LateralTurn) -> Callable[..., list[float]]:
    """Force and moment on the first body, in its axes, of the engine's signature."""

    def twist(
        mbs: Any, t: float, item: int, shift: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        turn, rate, axis = turning.look(angles, spin)
        moment = load.moment(TurnedBody(t, turn, rate))
        return [0.0, 0.0, 0.0, *(-moment * k for k in axis)]

    return twist
