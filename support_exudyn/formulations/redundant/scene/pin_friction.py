"""Dry friction in an ideal pin: a moment against its turning, as large as the force in the pin allows.

    moment = radius law(radius spin, pin force)

The engine's constraint gives the force, its spring-damper between two rotations takes the moment. Newton's
iterations find both together as long as forces change smoothly. In the short steps of impacts, and after jumps
of the drive, the multipliers of its iterates are far off, and what depends on them throws it off for good:
beside clearance pins, and with drives that jump, the force is that at the end of the last step, an error of
first order.
"""

import math
from typing import Any

import numpy as np
from exudyn.itemInterface import MarkerNodeCoordinate, NodePointGround, ObjectConnectorCoordinateSpringDamper

from support_exudyn.mechanics.trajectory import Series
from user_forces.friction.law import FrictionLaw
from user_forces.lawful import PROBED, LawError


class PinFriction:
    """Friction of one ideal pin in the engine.

    Arguments:
        mbs: the engine's system.
        law: without a state.
        radius: of the pin [m].
        first, second: the engine's nodes of both bodies; None for the ground.
    """

    def __init__(self, mbs: Any, law: FrictionLaw, radius: float, first: Any, second: Any) -> None:
        self._data = mbs.systemData
        self.law = law
        self.radius = radius
        self.calls = 0
        self.lagged = False  # whether the force is that at the end of the last step
        self._kept = 0.0  # that force [N]
        self._multiplier = 0  # the first of the pin's two
        self._coordinates: tuple[int | None, int | None] = None, None  # turns of first and second
        markers = rotations(mbs, first, second)
        mbs.AddObject(
            ObjectConnectorCoordinateSpringDamper(
                markerNumbers=markers, springForceUserFunction=self._resistance
            )
        )

    def assembled(self, multiplier: int, first: int | None, second: int | None) -> None:
        """Tell where the pin's multipliers and both bodies' turns stand; None for the ground."""
        self._multiplier = multiplier
        self._coordinates = first, second

    def moment(self, force: float, spin: float) -> float:
        """On the second body [N m], for a pin force [N] and its spin against the first [rad/s]."""
        return self.radius * float(self.law(self.radius * spin, force))

    def power(self) -> float:
        """What is dissipated now [W]."""
        spin = self._spin(self._data.GetODE2Coordinates_t())
        return -self.moment(self._force(), spin) * spin

    def probe(self, name: str) -> None:
        """Raise LawError if the moment is no number as it is now, or turning a little faster."""
        spin, force = self._spin(self._data.GetODE2Coordinates_t()), self._force()
        for more in PROBED:
            moment = self.moment(force, more * spin)
            if math.isfinite(force) and not math.isfinite(moment):
                raise LawError(
                    f"{name}: {type(self.law).__name__} gives a moment of {moment:g} N m at "
                    f"{more * spin:.6g} rad/s and {force:.6g} N"
                )

    def look(self, name: str) -> None:
        """Raise LawError, for what is dissipated now cannot be."""
        spin, force = self._spin(self._data.GetODE2Coordinates_t()), self._force()
        raise LawError(
            f"{name}: {type(self.law).__name__} gives a moment of {self.moment(force, spin):.6g} N m along the "
            f"turning at {spin:.6g} rad/s and {force:.6g} N"
        )

    def add_moment(self, forces: Series, force: float, rates: Series) -> None:
        """Add the moment for a pin force [N] and rates of all coordinates (n,) to the forces on them (n,)."""
        moment = self.moment(force, self._spin(rates))
        for number, sign in zip(self._coordinates, (-1.0, 1.0), strict=True):
            if number is not None:
                forces[number] += sign * moment

    def _spin(self, rates: Series) -> float:
        """The spin of the second body against the first [rad/s]."""
        first, second = (0.0 if n is None else float(rates[n]) for n in self._coordinates)
        return second - first

    def series(self, force: Series, first: Series, second: Series) -> Series:
        """Moment on the second body over time [N m], from the pin's force (n, 2) and both spins (n,)."""
        pairs = zip(np.hypot(*force.T).tolist(), (second - first).tolist(), strict=True)
        return np.array([self.moment(size, spin) for size, spin in pairs])

    def accept(self) -> None:
        """Remember the force in the pin at the end of a step."""
        self._kept = self._present()

    def _force(self) -> float:
        return self._kept if self.lagged else self._present()

    def _present(self) -> float:
        multipliers = self._data.GetAECoordinates()
        x, y = multipliers[self._multiplier], multipliers[self._multiplier + 1]
        return math.hypot(x, y)

    def _resistance(self, mbs: Any, t: float, item: int, turn: float, spin: float, *others: Any) -> float:
        """The engine's user function: as a spring's tension, so against the second body."""
        self.calls += 1
        return -self.moment(self._force(), spin)


def rotations(mbs: Any, first: Any, second: Any) -> list[Any]:
    """Markers of the rotations of two bodies, given by the engine's nodes; None for the ground."""

    def marker(node: Any) -> Any:
        if node is None:
            return MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0)
        return MarkerNodeCoordinate(nodeNumber=node, coordinate=2)

    return [mbs.AddMarker(marker(node)) for node in (first, second)]
