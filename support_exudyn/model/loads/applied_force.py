"""A force whose course over time is given."""

from __future__ import annotations

from pydantic import model_validator

from support_exudyn.model.loads.load import Load, LoadChannel, LoadedPoint, Powers
from user_forces.expressions.scalar import step
from user_forces.values.units import Newtons, Seconds
from user_forces.values.value import NonNegative, Vector2, value


@value
class AppliedForce(Load):
    """A force that keeps its direction, comes on smoothly and stays, whatever the point does.

        F = force (3 x^2 - 2 x^3),   x = (t - start)/(end - start) from 0 to 1

    It is what a roof that follows the machine puts on it, where `Roof` yields as the machine does. All
    that it does to the point counts as work; it stores nothing.

    Arguments:
        body, point: what it acts on, see `Load`; it stays with the point of the body.
        full_force: in the end, forward and up [N]; a roof presses down, (0, -1e6).
        start, end: between which it comes on [s], 0 <= start < end; both 0: it acts from the start on, and a
            start "settled" is settled under it.
    """

    full_force: Newtons[Vector2]
    start: Seconds[NonNegative] = 0.0
    end: Seconds[NonNegative] = 0.0

    @model_validator(mode="after")
    def _ends_after_it_starts(self) -> AppliedForce:
        if self.end <= self.start and (self.start, self.end) != (0.0, 0.0):
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s, or both 0")
        return self

    def _share(self, t: float) -> float:
        """Share of the force that has come on, from 0 to 1."""
        if self.end == 0.0:
            return 1.0
        return step((t - self.start) / (self.end - self.start))

    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point, forward and up [N]."""
        share = self._share(at.time)
        return self.full_force[0] * share, self.full_force[1] * share

    def stored(self, at: LoadedPoint) -> float:
        """Stored energy, which is 0 J."""
        return 0.0

    def powers(self, at: LoadedPoint) -> Powers:
        """Power [W] of the force on the point, and no loss."""
        along, up = self.force(at)
        return Powers(along * at.vx + up * at.vy, 0.0)

    @property
    def channels(self) -> dict[str, LoadChannel]:
        """The channels are the force's two components."""
        return {
            "force_x": LoadChannel("N", "of the load, forward"),
            "force_y": LoadChannel("N", "of the load, up"),
        }

    def observed(self, at: LoadedPoint) -> dict[str, float]:
        """Both components [N]."""
        along, up = self.force(at)
        return {"force_x": along, "force_y": up}

    @property
    def breaks(self) -> tuple[float, ...]:
        """Start and end of its rise [s]."""
        return () if self.end == 0.0 else (self.start, self.end)

    def largest(self, duration: float) -> Vector2:
        """The force as far as it comes on in the run [N]."""
        share = self._share(duration)
        return self.full_force[0] * share, self.full_force[1] * share
