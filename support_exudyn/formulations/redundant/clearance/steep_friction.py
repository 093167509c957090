"""The engine's force of a pin, in which a straight line may stand for a law of friction that is too steep.

See `friction_line`. The line is laid when Newton's method has failed, and stands until the surfaces part.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from support_exudyn.formulations.redundant.clearance.friction_line import FrictionLine
from support_exudyn.formulations.redundant.clearance.python_force import PythonForce
from support_exudyn.formulations.redundant.clearance.symbolic_force import SymbolicForce
from user_forces.contact import ContactForce
from user_forces.friction.frictionless import Frictionless
from user_forces.friction.law import FrictionLaw

EngineForce = SymbolicForce | PythonForce


class SteepFriction:
    """Which force acts: that of the pin's laws, or one with a line in place of friction.

    Arguments:
        law: of friction. One with a state is never replaced.
        force: makes the engine's force, with the law (False) or with a line (True).
    """

    def __init__(self, law: FrictionLaw, force: Callable[[bool], EngineForce]) -> None:
        self._law = law
        self._make = force
        self._plain = force(False)
        self._straight: EngineForce | None = None
        self._line: FrictionLine | None = None
        self._replaceable = not law.has_state and not isinstance(law, Frictionless)

    @property
    def acting(self) -> EngineForce:
        """The engine uses this force now."""
        return self._plain if self._line is None or self._straight is None else self._straight

    @property
    def calls(self) -> int:
        """Python was called so often."""
        return self._plain.calls + (self._straight.calls if self._straight else 0)

    def begin(self) -> None:
        """Begin to try a step from its start."""
        if self._line is not None:
            self._line.begin()

    def straighten(self, slip: float, normal_force: float) -> bool:
        """Let a line act, at first the tangent at a slip [m/s] under a force [N]; whether that is new."""
        if self._line is not None or not self._replaceable:
            return False
        if self._straight is None:
            self._straight = self._make(True)
        self._line = FrictionLine(self._law)
        self._line.lay(slip, normal_force)
        return True

    def part(self) -> bool:
        """Let the law act again, for the surfaces have parted; return whether a line acted."""
        straight, self._line = self._line is not None, None
        return straight

    def lay(self) -> None:
        """Tell the engine's force the line."""
        if self._line is not None and self._straight is not None:
            self._straight.lay(self._line.offset, self._line.slope)

    def after_newton(self, force: ContactForce, step: float, mass: float) -> float | None:
        """A step has been solved: None if the force was that of the law, which is given.

        Else with which length [s] it is to be repeated; infinite: with the same and another line.

        Arguments:
            force: of the laws. step: length [s]. mass: that moves along the surface, about [kg].
        """
        line, softness = self._line, force.normal_force * step / mass
        if line is None or line.meets(force.slip, force.normal_force, softness):
            return None
        return 0.5 * step if line.exhausted else math.inf

    def rounding(self, normal_force: float, size: float, step: float) -> float:
        """Return by how much a line scatters, see `FrictionLine.rounding`; 0 without one."""
        return 0.0 if self._line is None else self._line.rounding(normal_force, size, step)
