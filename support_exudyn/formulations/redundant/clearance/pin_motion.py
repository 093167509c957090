"""How a journal moves in its bore, from the engine's coordinates of both bodies."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

import exudyn

from support_exudyn.formulations.contact_events import DepthPath
from support_exudyn.formulations.redundant.clearance.connector_force import Relative
from user_forces.values.value import Vector2

# x, y, vx, vy [m], [m/s]; angle [rad] and spin [rad/s] of the body
Motion = tuple[float, float, float, float, float, float]


class Moving(Protocol):
    """How a journal moves in its bore."""

    def now(self) -> tuple[Motion, Motion]:
        """The present motions of bore and journal."""
        ...


class PinEnd(NamedTuple):
    """One centre of a pin on its body.

    first: the body's first coordinate in the vector of all (x, y, angle follow); None: the ground. centre,
    angle: of the body where its coordinates are zero [m], [rad]. arm: of the point in the body's axes [m]; of
    the ground from its origin.
    """

    first: int | None
    centre: Vector2
    angle: float
    arm: Vector2

    def motion(self, position: list[float], velocity: list[float]) -> Motion:
        """Motion of the point and its body."""
        first, centre, angle, (x, y) = self
        if first is None:
            return x, y, 0.0, 0.0, angle, 0.0
        qx, qy, turned = position[first : first + 3]
        vx, vy, spin = velocity[first : first + 3]
        angle += turned
        c, s = math.cos(angle), math.sin(angle)
        ax, ay = c * x - s * y, s * x + c * y
        return centre[0] + qx + ax, centre[1] + qy + ay, vx - spin * ay, vy + spin * ax, angle, spin


class PinMotion(NamedTuple):
    """The motion of a pin's journal in its bore. data: the engine's, once it is assembled."""

    data: Any
    bore: PinEnd
    journal: PinEnd

    def now(self, state: Any = exudyn.ConfigurationType.Current) -> tuple[Motion, Motion]:
        """The present motions of bore and journal; or those of another state of the engine."""
        position = self.data.GetODE2Coordinates(state).tolist()
        velocity = self.data.GetODE2Coordinates_t(state).tolist()
        return self.bore.motion(position, velocity), self.journal.motion(position, velocity)


def in_plane(displacement: Sequence[float], velocity: Sequence[float]) -> tuple[float, float, float, float]:
    """Displacement and velocity in space as ones across the bore's axis, with the same distance and rate.

    Sections of a tilted journal lie a little beside those of the bore, by less than the square of the tilt
    times the length; their distance is that of their centres.
    """
    x, y, z = displacement
    vx, vy, vz = velocity
    across = math.hypot(x, y)
    if across == 0.0:
        return x, y, vx, vy
    distance = math.hypot(across, z)
    rate = (x * vx + y * vy + z * vz) / distance - (x * vx + y * vy) / across
    run_of_steps = distance / across
    return run_of_steps * x, run_of_steps * y, vx + rate * x / across, vy + rate * y / across


class Course(NamedTuple):
    """How a journal moves in its bore within a step.

    path: its depth, a cubic. slip: at the start [m/s]. end: its motion at the end; slip_end: the slip there.
    clearance: [m].
    """

    path: DepthPath
    slip: float
    end: Relative
    slip_end: float
    clearance: float

    def at(self, x: float) -> Relative:
        """The motion at a fraction of the step: slip changes evenly, direction and spins are the last ones."""
        path, end = self.path, self.end
        size = math.hypot(end.x, end.y)
        c, s = (end.x / size, end.y / size) if size else (1.0, 0.0)
        across = c * end.vy - s * end.vx + (1.0 - x) * (self.slip - self.slip_end)
        away, rate = self.clearance + path.depth(x), path.rate(x)
        return Relative(away * c, away * s, rate * c - across * s, rate * s + across * c, end[4], end[5])
