"""Loads in the engine, in the plane and in space: connectors whose user functions call the action.

They are connectors and no loads of the engine's, for those have no Jacobian, without which Newton's method does
not get along with a stiff one. What a connector gives is what pulls its ends together: minus the force.
"""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING, Any

import numpy as np
from exudyn.itemInterface import ObjectConnectorCartesianSpringDamper, ObjectConnectorRigidBodySpringDamper

from support_exudyn.mechanics.acting_loads import strain_of, turning_axis
from support_exudyn.mechanics.body_motion import Motion
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.load import (
    ActingLoad,
    Load,
    LoadedPoint,
    LoadedStretch,
    MomentLoad,
    StretchLoad,
    TurnedBody,
)
from user_forces.lawful import ROUNDING, LawError

if TYPE_CHECKING:
    from support_exudyn.formulations.exudyn.scene.joint_builder import JointBuilder

ROUNDINGS = 8.0  # of a point's coordinates, from which ways are computed


class LoadItem:
    """A load in the engine: its data, its connector, and the connector's function, which must live as long.

    What the action gave last is what it gives at the end of a step that has been solved: with that Newton's
    method has ended.

    Arguments:
        load: its data. name: of it.
        builder: of the scene, which gets the connector.

    Raises TypeError if the load is of no strain kind.
    """

    def __init__(self, load: ActingLoad, name: str, builder: JointBuilder) -> None:
        self.load: Any = load
        self.name = name
        self.rounding = 0.0  # force by which rounding of positions lets it scatter [N]
        self._turn = 0.0  # [rad], the last of a moment's, which counts whole turns
        self._at: Any = None  # the motion that the action was given last,
        self._numbers: tuple[float, ...] = ()  # and what it gave
        connector: Any
        if isinstance(load, Load):
            origin = builder.marker(load.against(name), builder.place(load.origin, load.origin_lateral))
            point = builder.marker(load.body, builder.place(load.point, load.lateral))
            connector = ObjectConnectorCartesianSpringDamper(
                markerNumbers=[origin, point], springForceUserFunction=self._pull
            )
            farthest = max(map(abs, (*load.point, *load.origin)))
            self.rounding = ROUNDINGS * sys.float_info.epsilon * math.hypot(*load.steepness) * farthest
        elif isinstance(load, MomentLoad):
            connector = ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[builder.frame(body) for body in (load.other, load.body)],
                springForceTorqueUserFunction=self._twist,
            )
        elif isinstance(load, StretchLoad):
            first = builder.place(load.points[0], load.lateral)
            connector = ObjectConnectorRigidBodySpringDamper(
                markerNumbers=[builder.frame(body, first) for body in (load.against(name), load.body)],
                springForceTorqueUserFunction=self._press,
            )
        else:
            raise TypeError(f"loads.{name} = {type(load).__name__}: is no Load, MomentLoad or StretchLoad")
        builder.mbs.AddObject(connector)

    def _act(self, at: Any) -> tuple[float, ...]:
        """What the action gives for a motion."""
        self._at, self._numbers = at, self.load.numbers(at)
        return self._numbers

    def _pull(self, mbs: Any, t: float, item: int, way: Any, velocity: Any, *others: Any) -> list[float]:
        """The engine's user function of a force, in the axes of the ground."""
        (x, y, z), (vx, vy, vz) = way, velocity
        return [-force for force in self._act(LoadedPoint(t, x, y, vx, vy, z, vz))[:3]]

    def _twist(
        self, mbs: Any, t: float, item: int, shift: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        """The engine's user function of a moment; angles, spin: in the other body's axes."""
        x, y, z = _forward(*map(float, angles)).tolist()
        axis = turning_axis(x, y, z)
        self._turn += math.remainder(math.atan2(y, x) - self._turn, 2.0 * math.pi)
        rate = float(sum(k * w for k, w in zip(axis, spin, strict=True)))
        moment = self._act(TurnedBody(t, self._turn, rate))[0]
        return [0.0, 0.0, 0.0, *(-moment * k for k in axis)]

    def _press(
        self, mbs: Any, t: float, item: int, way: Any, angles: Any, velocity: Any, spin: Any, *others: Any
    ) -> list[float]:
        """The engine's user function of forces over a stretch: as force and moment at its first point."""
        (x, y), (u, v) = self.load.points
        a, b, c = map(float, angles)
        arm = (u - x) * _forward(a, b, c) + (v - y) * _upward(a, b, c)
        rate = velocity[1] + spin[2] * arm[0] - spin[0] * arm[2]
        at = LoadedStretch(t, way[1], way[1] + arm[1] - (v - y), velocity[1], rate)
        first, second = self._act(at)[:2]
        return [0.0, -first - second, 0.0, arm[2] * second, 0.0, -arm[0] * second]

    def powers(self) -> tuple[float, float]:
        """Power of what moves the load, and power that is lost in it, at the end of the last step [W]."""
        count = self.load.FORCES
        return self._numbers[count + 1], self._numbers[count + 2]

    def probe(self, t: float, motion: Motion) -> None:
        """Raise LawError if the load has no finite force at a time t [s] for the motion of all bodies now."""
        load = self.load
        at = load.MOTION(t, *strain_of(load, self.name, motion).numbers[0].tolist())
        forces = load.numbers(at)[: load.FORCES]
        if not all(map(math.isfinite, forces)):
            said = ", ".join(f"{force:g}" for force in forces)
            what, unit = ("moment", "N m") if isinstance(load, MomentLoad) else ("force", "N")
            raise LawError(f"{self.name}: {type(load).__name__} has a {what} of {said} {unit}")

    def look(self) -> None:
        """Raise LawError if the load gives what it should lose, but for rounding, or no number."""
        work, loss = self.powers()
        rates = [getattr(self._at, rate) for rate in self.load.RATES]
        power = math.hypot(*self._numbers[: self.load.FORCES]) * math.hypot(*rates)
        if not loss >= -ROUNDING * (abs(work) + power):
            raise LawError(f"{self.name}: {type(self.load).__name__} loses {loss:.6g} W; allowed: >= 0")


def _forward(a: float, b: float, c: float) -> Series:
    """A body's forward direction in the other's axes, by the engine's angles: R = R_x(a) R_y(b) R_z(c)."""
    sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    return np.array([cb * cc, ca * sc + sa * sb * cc, sa * sc - ca * sb * cc])


def _upward(a: float, b: float, c: float) -> Series:
    """A body's upward direction in the other's axes, see `_forward`."""
    sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    return np.array([-cb * sc, ca * cc - sa * sb * sc, sa * cc + ca * sb * sc])
