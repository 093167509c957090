"""A roof that comes down on a machine."""

from collections.abc import Mapping

from user_forces.expressions.scalar import maximum

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.loads.load import Load, LoadChannel, LoadedPoint, Powers
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

    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point: nothing forward, and down [N]."""
        return 0.0, -self._push(at)

    def _push(self, at: LoadedPoint) -> float:
        """F [N]."""
        elastic = self.stiffness * maximum(0.0, self._closed(at))
        if self.damping == 0.0:  # then the descent need not know its speed
            return elastic
        return elastic * maximum(0.0, 1.0 + self.damping * self._rate(at))

    def _closed(self, at: LoadedPoint) -> float:
        """The depth, negative while there is a gap [m]."""
        return self.descent.extension(at.time) + at.y - self.gap

    def _rate(self, at: LoadedPoint) -> float:
        """Rate of the depth [m/s]."""
        return self.descent.speed(at.time) + at.vy

    def stored(self, at: LoadedPoint) -> float:
        """k depth^2/2 [J]."""
        depth = maximum(0.0, self._closed(at))
        return 0.5 * self.stiffness * depth * depth

    def powers(self, at: LoadedPoint) -> Powers:
        """F times the speed of the descent, and (F - k depth) rate [W]."""
        push = self._push(at)
        elastic = self.stiffness * maximum(0.0, self._closed(at))
        return Powers(push * self.descent.speed(at.time), (push - elastic) * self._rate(at))

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """The channels are the roof's force and its gap."""
        return {
            "force": LoadChannel("N", "of the roof, downward"),
            "gap": LoadChannel("m", "between roof and point; negative: depth"),
        }

    def observed(self, at: LoadedPoint) -> Mapping[str, float]:
        """Force [N] and gap [m]."""
        return {"force": self._push(at), "gap": -self._closed(at)}

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
