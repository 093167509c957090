"""A roof that comes down on a machine."""

import math
from collections.abc import Mapping

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.loads.load import Load, LoadChannel, TimeFunction
from user_forces.kernel import kernel, limited
from user_forces.values.units import Metres, NewtonsPerMetre, SecondsPerMetre
from user_forces.values.value import NonNegative, Positive, Vector2, value


@value
class Roof(Load):
    """A rigid, level face of rock above a point of a body, cushioned by what lies between both.

        depth = way down + way up of the point - gap,   where it is > 0
        F = k depth max(0, 1 + b rate),   rate = d depth/dt

    The force pushes the point down, never up, and there is no friction along the face. Crushed rock and timber
    take up and give back k depth^2/2; the term with b is lost, and as it grows from zero with the depth the
    force begins and ends without a jump. k is the stiffness of the cushion alone; nothing limits its force, and
    nothing in it stays deformed. A face that is to press with F on a machine that does not give has to come
    down by gap + F/k.

    Arguments:
        body, point: what it presses on, see `Load`.
        descent: how far the face has come down [m] over time.
        stiffness: k [N/m], > 0.
        gap: between face and point in the start posture [m], >= 0.
        damping: b [s/m], >= 0; a closing speed of 1/b doubles the force.
    """

    descent: Drive
    stiffness: NewtonsPerMetre[Positive]
    gap: Metres[NonNegative] = 0.0
    damping: SecondsPerMetre[NonNegative] = 0.0

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """Way down [m] and speed [m/s] of the face."""
        return self.descent.extension, self.descent.speed

    @staticmethod
    @kernel
    def action(
        t: float,
        x: float,
        y: float,
        vx: float,
        vy: float,
        z: float,
        vz: float,
        down: float,
        speed: float,
        stiffness: float,
        gap: float,
        damping: float,
    ) -> tuple[float, ...]:
        """The force, k depth^2/2, power of the descent and loss (F - k depth) rate; see `ActingLoad`."""
        closed, rate = down + y - gap, speed + vy
        depth = limited(closed, 0.0, math.inf)
        elastic = push = stiffness * depth
        if damping > 0.0:
            push = elastic * limited(1.0 + damping * rate, 0.0, math.inf)
        stored, loss = 0.5 * stiffness * depth * depth, (push - elastic) * rate
        return 0.0, -push, 0.0, stored, push * speed, loss, push, -closed

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """The channels are the roof's force and its gap."""
        return {
            "force": LoadChannel("N", "of the roof, downward"),
            "gap": LoadChannel("m", "between roof and point; negative: depth"),
        }

    @property
    def drives(self) -> tuple[Drive, ...]:
        """The only drive is the descent."""
        return (self.descent,)

    @property
    def steepness(self) -> Vector2:
        """Steepness [N/m]: none along the face, k against it."""
        return 0.0, self.stiffness

    def largest(self, duration: float) -> Vector2:
        """k times the depth at the lowest place of the face, down [N]."""
        depth = max(0.0, self.descent.span(duration)[1] - self.gap)
        return 0.0, -self.stiffness * depth
