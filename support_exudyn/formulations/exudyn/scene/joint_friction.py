"""Dry friction of ideal pins and guides in the engine, by spring-dampers beside its constraint.

Newton's iterations solve for both together as long as forces change smoothly. In the short steps of impacts,
and after jumps of the drive, the multipliers of its iterates are far off, and what depends on them throws it
off for good: beside clearance pins, and with drives that jump, the force is that at the end of the last step,
an error of first order.
"""

import math
from collections.abc import Mapping
from typing import Any, NoReturn

import exudyn
import numpy as np
from exudyn.itemInterface import ObjectConnectorCartesianSpringDamper, ObjectConnectorCoordinateSpringDamper

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.joint_friction import Carried, FrictionJoint
from support_exudyn.mechanics.trajectory import Series
from user_forces.lawful import PROBED, LawError

PATIENCE = 20  # steps


class JointFriction:
    """Friction of one ideal joint in the engine.

    Arguments:
        mbs: the engine's system.
        joint: its data.
        points: markers of a guide's point on both bodies; none of a pin.
        turns: markers of the turns of both bodies; none where friction has no moment.
    """

    def __init__(self, mbs: Any, joint: FrictionJoint, points: list[Any], turns: list[Any]) -> None:
        self._mbs, self._data = mbs, mbs.systemData
        self.joint, self.law = joint, joint.law
        self.calls = 0
        self.lagged = False  # whether the force is always that at the end of the last step,
        self._lags = False  # and whether in the step that is tried; for how many more steps it is,
        self._lagging, self._patience = 0, PATIENCE  # and will be after the next failure
        self.deflection = 0.0  # state of the law at the end of the last step [m]
        self._slip = self._step = 0.0  # slip then [m/s], length of the step that is tried [s]
        self._kept = 0.0, 0.0  # what the joint carried then
        self._multiplier = 0  # the first
        self._bodies: tuple[int | None, int | None] = None, None  # first coordinates of both bodies
        self._force = 0.0  # of a guide, as the engine last asked for it [N]
        self._slider: Any = None
        if points:
            self._slider = mbs.AddObject(
                ObjectConnectorCartesianSpringDamper(markerNumbers=points, springForceUserFunction=self._resist)
            )
        if turns:
            mbs.AddObject(
                ObjectConnectorCoordinateSpringDamper(markerNumbers=turns, springForceUserFunction=self._twist)
            )

    def assembled(self, multiplier: int, bodies: Mapping[str, Any]) -> None:
        """Set where the multipliers, and the coordinates of the bodies by name, stand in the engine."""
        self._multiplier = multiplier
        both = (self.joint.first, self.joint.second)
        first, second = (bodies[name].first if name in bodies else None for name in both)
        self._bodies = first, second

    def start(self, motion: BodyMotion) -> None:
        """Take the state of the law that belongs to steady slip in the start posture."""
        self._slip = float(self.joint.slips(motion, np.zeros((1, 2)))[0])
        self.deflection = self.law.steady_deflection(self._slip)

    def guess(self, total: Series, motion: BodyMotion, carried: Series, multipliers: Series) -> None:
        """Add friction in the start posture to the forces on all coordinates (1, 3 b).

        carried: multipliers of the joint's rows (conditions,), which are written into the engine's.
        """
        first = self._multiplier
        multipliers[first : first + carried.size] = carried
        multipliers[first] *= self._sign
        friction = self.joint.forces(motion, carried[None], np.array([self.deflection]))
        self.joint.apply(total, motion, carried[None], friction)

    def begin_try(self, step: float, repeated: bool) -> None:
        """A step of this length [s] is tried; for a while after a failure with the force of the last step."""
        self._step = step
        if repeated and not self._lagging:
            self._lagging = self._patience
            self._patience *= 2
        self._lags = self.lagged or self._lagging > 0

    def accept(self) -> None:
        """Keep what the joint carries, its slip and the state of the law at the end of a step."""
        self._kept = self._present()
        self._lags, self._lagging = self.lagged, max(0, self._lagging - 1)
        slip = self._slip_now(self._kept)
        self.deflection = self._moved(slip)
        self._slip, self._step = slip, 0.0

    def power(self) -> float:
        """What is dissipated now [W]."""
        force, slip = self._now()
        return -force * slip

    def probe(self, name: str) -> None:
        """Raise LawError if the friction is no number as it is now, or slipping a little faster."""
        carried = self._carried()
        for more in PROBED:
            slip = more * self._slip_now(carried)
            found = self.joint.force(carried, slip, self.deflection)
            if all(map(math.isfinite, carried)) and not math.isfinite(found):
                self._refuse(name, found, slip)

    def look(self, name: str) -> None:
        """Raise LawError, for what is dissipated now cannot be. A law with a state may give back energy."""
        force, slip = self._now()
        if not self.law.has_state or not math.isfinite(force):
            self._refuse(name, force, slip)

    def _refuse(self, name: str, force: float, slip: float) -> NoReturn:
        raise LawError(
            f"{name}: {type(self.law).__name__} gives a friction force of {force:.6g} N along the slip of "
            f"{slip:.6g} m/s, {math.hypot(*self._carried()):.6g} N carried"
        )

    def _now(self) -> tuple[float, float]:
        """Friction force [N] and slip [m/s] at the end of the step that is tried."""
        carried = self._carried()
        slip = self._slip_now(carried)
        return self.joint.force(carried, slip, self._moved(slip)), slip

    def _slip_now(self, carried: Carried) -> float:
        velocity: Any = 0.0, 0.0
        if self._slider is not None:
            velocity = self._mbs.GetObjectOutput(self._slider, exudyn.OutputVariableType.Velocity)
        return self._sliding(carried, velocity)

    def _sliding(self, carried: Carried, velocity: Any) -> float:
        """The slip [m/s]; velocity: of a guide's point on the second body against that on the first [m/s]."""
        ax, ay = self._along()
        lever = self.joint.lever(carried)
        return float(ax * velocity[0] + ay * velocity[1]) + (lever * self._spin() if lever else 0.0)

    def _moved(self, slip: float) -> float:
        """State of the law [m] at the end of the step that is tried."""
        if not self.law.has_state:
            return 0.0
        return float(self.law.next_deflection(self.deflection, 0.5 * (self._slip + slip), self._step))

    def _carried(self) -> Carried:
        return self._kept if self._lags else self._present()

    @property
    def _sign(self) -> float:
        """Of the first multiplier of the joint's rows against the engine's."""
        return 1.0 if self.joint.slide is None else -1.0

    def _present(self) -> Carried:
        multipliers = self._data.GetAECoordinates()
        second = float(multipliers[self._multiplier + 1]) if self.joint.conditions == 2 else 0.0
        return self._sign * float(multipliers[self._multiplier]), second

    def _spin(self) -> float:
        """The spin of the second body against the first [rad/s]."""
        rates = self._data.GetODE2Coordinates_t()
        first, second = (0.0 if n is None else float(rates[n + 2]) for n in self._bodies)
        return second - first

    def _along(self) -> tuple[float, float]:
        """Direction of a guide now; of a pin none."""
        if self.joint.slide is None:
            return 0.0, 0.0
        carrier = self._bodies[0]
        angle = self.joint.slide.direction
        if carrier is not None:
            angle += float(self._data.GetODE2Coordinates()[carrier + 2])
        return math.cos(angle), math.sin(angle)

    def _resist(self, mbs: Any, t: float, item: int, way: Any, velocity: Any, *others: Any) -> list[float]:
        """The engine's user function of the force along a guide, a tension: against the second body."""
        self.calls += 1
        carried = self._carried()
        slip = self._sliding(carried, velocity)
        self._force = self.joint.force(carried, slip, self._moved(slip))
        ax, ay = self._along()
        return [-self._force * ax, -self._force * ay, 0.0]

    def _twist(self, mbs: Any, t: float, item: int, turn: float, spin: float, *others: Any) -> float:
        """The engine's user function of the moment about the joint's point, a tension, too."""
        carried = self._carried()
        lever = self.joint.lever(carried)
        if self._slider is not None:
            return -lever * self._force
        self.calls += 1
        slip = lever * spin
        return -lever * self.joint.force(carried, slip, self._moved(slip))
