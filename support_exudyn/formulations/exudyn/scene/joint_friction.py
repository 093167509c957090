"""Dry friction in ideal pins and guides: as large as the force that the joint carries allows.

    pin: moment = radius law(radius spin, pin force)
    guide: force = law(slip, force across), see `IdealGuide`

The engine's constraint gives the force, its spring-dampers take the friction. Newton's iterations solve for
both together as long as forces change smoothly. In the short steps of impacts, and after jumps of the drive,
the multipliers of its iterates are far off, and what depends on them throws it off for good: beside clearance
pins, and with drives that jump, the force is that at the end of the last step, an error of first order.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any

import numpy as np
from exudyn.itemInterface import (
    MarkerNodeCoordinate,
    NodePointGround,
    ObjectConnectorCartesianSpringDamper,
    ObjectConnectorCoordinateSpringDamper,
)

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.reactions import push, twist
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.guides import IdealGuide
from support_exudyn.model.linkage import PinPlace, Slide
from support_exudyn.model.pins import IdealPin
from support_exudyn.model.plane_geometry import minus
from user_forces.friction.law import FrictionLaw
from user_forces.lawful import PROBED, LawError

PATIENCE = 20  # steps
Carried = tuple[float, float]  # both multipliers of a joint; the second is 0 of a guide without a moment


class JointFriction(ABC):
    """Friction of one ideal joint in the engine.

    Arguments:
        mbs: the engine's system.
        law: of the friction.
        first, second: names of the bodies.
    """

    conditions = 2  # how many multipliers the joint has
    owner: tuple[str, str]  # of its rows, see `Kinetics.owners`
    sign = 1.0  # of the first multiplier of these rows against the engine's

    def __init__(self, mbs: Any, law: FrictionLaw, first: str, second: str) -> None:
        self._data = mbs.systemData
        self.law = law
        self.first, self.second = first, second
        self.calls = 0
        self.lagged = False  # whether the force is always that at the end of the last step,
        self._lags = False  # and whether in the step that is tried; for how many more steps it is,
        self._lagging, self._patience = 0, PATIENCE  # and will be after the next failure
        self.deflection = 0.0  # state of the law at the end of the last step [m]
        self._slip = self._step = 0.0  # slip then [m/s], length of the step that is tried [s]
        self._kept = 0.0, 0.0  # what the joint carried then
        self._multiplier = 0  # the first
        self._bodies: tuple[int | None, int | None] = None, None  # first coordinates of both bodies

    def assembled(self, multiplier: int, bodies: Mapping[str, Any]) -> None:
        """Set where the multipliers, and the coordinates of the bodies by name, stand in the engine."""
        self._multiplier = multiplier
        first, second = (bodies[name].first if name in bodies else None for name in (self.first, self.second))
        self._bodies = first, second

    @abstractmethod
    def slip(self, carried: Carried, position: Series, rates: Series) -> float:
        """The slip [m/s] for coordinates of all bodies and their rates (n,)."""

    @abstractmethod
    def size(self, carried: Carried, slip: float, deflection: float) -> float:
        """Friction force [N] on the second body along the slip."""

    @abstractmethod
    def add(self, forces: Series, carried: Carried, rates: Series) -> None:
        """Add friction in the start posture to the forces on all coordinates (n,), for their rates."""

    @abstractmethod
    def series(self, reactions: Series, motion: BodyMotion, deflection: Series) -> Series:
        """Friction force over time (n,) [N], from the multipliers (n, conditions) and the law's state (n,)."""

    @abstractmethod
    def apply(self, forces: Series, motion: BodyMotion, reactions: Series, friction: Series) -> None:
        """Add a friction force over time (n,) [N] to the forces on all coordinates (n, 3 b)."""

    def start(self, rates: Series) -> None:
        """Take the state of the law that belongs to steady slip in the start posture, for rates (n,)."""
        self._slip = self.slip((0.0, 0.0), 0.0 * rates, rates)
        self.deflection = self.law.steady_deflection(self._slip)

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
        return -self._now()[0] * self._now()[1]

    def probe(self, name: str) -> None:
        """Raise LawError if the friction is no number as it is now, or slipping a little faster."""
        carried = self._carried()
        for more in PROBED:
            slip = more * self._slip_now(carried)
            found = self.size(carried, slip, self.deflection)
            if all(map(math.isfinite, carried)) and not math.isfinite(found):
                raise LawError(
                    f"{name}: {type(self.law).__name__} gives a friction force of {found:g} N at {slip:.6g} "
                    f"m/s and {math.hypot(*carried):.6g} N"
                )

    def look(self, name: str) -> None:
        """Raise LawError, for what is dissipated now cannot be. A law with a state may give back energy."""
        force, slip = self._now()
        if not self.law.has_state or not math.isfinite(force):
            raise LawError(
                f"{name}: {type(self.law).__name__} gives a friction force of {force:.6g} N along the slip of "
                f"{slip:.6g} m/s, {math.hypot(*self._carried()):.6g} N carried"
            )

    def _now(self) -> tuple[float, float]:
        """Friction force [N] and slip [m/s] at the end of the step that is tried."""
        carried = self._carried()
        slip = self._slip_now(carried)
        return self.size(carried, slip, self._moved(slip)), slip

    def _slip_now(self, carried: Carried) -> float:
        return self.slip(carried, self._data.GetODE2Coordinates(), self._data.GetODE2Coordinates_t())

    def _moved(self, slip: float) -> float:
        """State of the law [m] at the end of the step that is tried."""
        if not self.law.has_state:
            return 0.0
        return float(self.law.next_deflection(self.deflection, 0.5 * (self._slip + slip), self._step))

    def _carried(self) -> Carried:
        return self._kept if self._lags else self._present()

    def _present(self) -> Carried:
        multipliers = self._data.GetAECoordinates()
        second = float(multipliers[self._multiplier + 1]) if self.conditions == 2 else 0.0
        return self.sign * float(multipliers[self._multiplier]), second

    def _spin(self, rates: Series) -> float:
        """The spin of the second body against the first [rad/s]."""
        first, second = (0.0 if n is None else float(rates[n + 2]) for n in self._bodies)
        return second - first


class PinFriction(JointFriction):
    """Friction of an ideal pin."""

    def __init__(self, mbs: Any, name: str, pin: IdealPin, place: PinPlace, nodes: list[Any]) -> None:
        assert pin.friction is not None  # the pins without are left out
        super().__init__(mbs, pin.friction, place.first, place.second)
        self.owner = "pins", name
        self.radius = pin.radius or 0.0  # goes with friction
        mbs.AddObject(
            ObjectConnectorCoordinateSpringDamper(
                markerNumbers=rotations(mbs, *nodes), springForceUserFunction=self._resistance
            )
        )

    def slip(self, carried: Carried, position: Series, rates: Series) -> float:
        """See `JointFriction`."""
        return self.radius * self._spin(rates)

    def size(self, carried: Carried, slip: float, deflection: float) -> float:
        """See `JointFriction`."""
        return float(self.law(slip, math.hypot(*carried), deflection))

    def add(self, forces: Series, carried: Carried, rates: Series) -> None:
        """See `JointFriction`."""
        moment = self.radius * self.size(carried, self.slip(carried, rates, rates), self.deflection)
        for first, sign in zip(self._bodies, (-1.0, 1.0), strict=True):
            if first is not None:
                forces[first + 2] += sign * moment

    def series(self, reactions: Series, motion: BodyMotion, deflection: Series) -> Series:
        """See `JointFriction`."""
        slips = self.radius * (motion.spin(self.second) - motion.spin(self.first))
        known = zip(reactions.tolist(), slips.tolist(), deflection.tolist(), strict=True)
        return np.array([self.size((x, y), slip, state) for (x, y), slip, state in known])

    def apply(self, forces: Series, motion: BodyMotion, reactions: Series, friction: Series) -> None:
        """See `JointFriction`."""
        twist(forces, motion, self.second, self.radius * friction)
        twist(forces, motion, self.first, -self.radius * friction)

    def _resistance(self, mbs: Any, t: float, item: int, turn: float, spin: float, *others: Any) -> float:
        """The engine's user function: as a spring's tension, so against the second body."""
        self.calls += 1
        slip = self.radius * spin
        return -self.radius * self.size(self._carried(), slip, self._moved(slip))


class GuideFriction(JointFriction):
    """Friction of an ideal guide, whose second body slides on the first.

    Arguments:
        points: markers of the guide's point on the first and on the second body. nodes: of both bodies.
    """

    def __init__(
        self, mbs: Any, name: str, guide: IdealGuide, slide: Slide, points: list[Any], nodes: list[Any]
    ) -> None:
        assert guide.friction is not None  # the guides without are left out
        super().__init__(mbs, guide.friction, slide.against, slide.body)
        self.owner = "slides", name
        self.guide, self.slide = guide, slide
        self.conditions, self.sign = slide.conditions, -1.0
        self._arms = (0.0, 0.0), (0.0, 0.0)  # of the point from the centres of both bodies at the start [m]
        self._force = 0.0  # as the engine last asked for it [N]
        mbs.AddObject(
            ObjectConnectorCartesianSpringDamper(markerNumbers=points, springForceUserFunction=self._resistance)
        )
        if guide.pin_radius is not None:
            mbs.AddObject(
                ObjectConnectorCoordinateSpringDamper(
                    markerNumbers=rotations(mbs, *nodes), springForceUserFunction=self._twist
                )
            )

    def slip(self, carried: Carried, position: Series, rates: Series) -> float:
        """See `JointFriction`."""
        ax, ay = self._along(position)
        speed = 0.0
        for n, (x, y), sign in zip(self._bodies, self._arms, (-1.0, 1.0), strict=True):
            if n is not None:
                c, s = math.cos(position[n + 2]), math.sin(position[n + 2])
                speed += sign * (ax * rates[n] + ay * rates[n + 1])
                speed += sign * rates[n + 2] * (ay * (c * x - s * y) - ax * (s * x + c * y))
        return float(speed + self.guide.lever(-carried[0]) * self._spin(rates))

    def size(self, carried: Carried, slip: float, deflection: float) -> float:
        """See `JointFriction`. The multipliers act against the second body."""
        return self.guide.friction_force(-carried[0], -carried[1], slip, deflection)

    def add(self, forces: Series, carried: Carried, rates: Series) -> None:
        """See `JointFriction`."""
        size = self.size(carried, self.slip(carried, 0.0 * rates, rates), self.deflection)
        ax, ay = math.cos(self.slide.direction), math.sin(self.slide.direction)
        moment = self.guide.lever(-carried[0]) * size
        for n, (x, y), sign in zip(self._bodies, self._arms, (-1.0, 1.0), strict=True):
            if n is not None:
                forces[n] += sign * size * ax
                forces[n + 1] += sign * size * ay
                forces[n + 2] += sign * (size * (x * ay - y * ax) + moment)

    def series(self, reactions: Series, motion: BodyMotion, deflection: Series) -> Series:
        """See `JointFriction`."""
        slips = motion.sliding(self.slide)[1]
        levers = np.array([self.guide.lever(-across) for across in reactions[:, 0].tolist()])
        slips = slips + levers * (motion.spin(self.second) - motion.spin(self.first))
        carried = np.zeros((len(slips), 2))
        carried[:, : reactions.shape[1]] = reactions
        known = zip(carried.tolist(), slips.tolist(), deflection.tolist(), strict=True)
        return np.array([self.size((x, y), slip, state) for (x, y), slip, state in known])

    def apply(self, forces: Series, motion: BodyMotion, reactions: Series, friction: Series) -> None:
        """See `JointFriction`."""
        along, point = motion.sliding(self.slide)[0], motion.place(self.slide.body, self.slide.point)
        levers = np.array([self.guide.lever(-across) for across in reactions[:, 0].tolist()])
        for body, sign in ((self.second, 1.0), (self.first, -1.0)):
            push(forces, motion, body, sign * friction[:, None] * along, point)
            twist(forces, motion, body, sign * levers * friction)

    def assembled(self, multiplier: int, bodies: Mapping[str, Any]) -> None:
        """See `JointFriction`."""
        super().assembled(multiplier, bodies)
        first, second = (
            minus(self.slide.point, bodies[name].body.centre) if name in bodies else (0.0, 0.0)
            for name in (self.first, self.second)
        )
        self._arms = first, second

    def _along(self, position: Series) -> tuple[float, float]:
        """Direction of the guide now."""
        carrier = self._bodies[0]
        angle = self.slide.direction + (0.0 if carrier is None else float(position[carrier + 2]))
        return math.cos(angle), math.sin(angle)

    def _resistance(
        self, mbs: Any, t: float, item: int, displacement: Any, velocity: Any, *others: Any
    ) -> list[float]:
        """The engine's user function: as a spring's tension, so against the second body."""
        self.calls += 1
        carried = self._carried()
        ax, ay = self._along(self._data.GetODE2Coordinates())
        lever = self.guide.lever(-carried[0])
        turning = lever * self._spin(self._data.GetODE2Coordinates_t()) if lever else 0.0
        slip = ax * velocity[0] + ay * velocity[1] + turning
        self._force = self.size(carried, slip, self._moved(slip))
        return [-self._force * ax, -self._force * ay, 0.0]

    def _twist(self, mbs: Any, t: float, item: int, turn: float, spin: float, *others: Any) -> float:
        """The engine's user function of the moment about the pin's centre."""
        return -self.guide.lever(-self._carried()[0]) * self._force


def rotations(mbs: Any, first: Any, second: Any) -> list[Any]:
    """Markers of the rotations of two bodies, given by the engine's nodes; None for the ground."""

    def marker(node: Any) -> Any:
        if node is None:
            return MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0)
        return MarkerNodeCoordinate(nodeNumber=node, coordinate=2)

    return [mbs.AddMarker(marker(node)) for node in (first, second)]
