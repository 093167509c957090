"""A force whose course over time is given."""

from __future__ import annotations

from functools import cached_property

from pydantic import model_validator

from support_exudyn.model.loads.course import Coming, LoadCourse
from support_exudyn.model.loads.load import Load, LoadChannel, LoadedPoint, Powers
from user_forces.values.units import Newtons, Seconds
from user_forces.values.value import NonNegative, Vector2, value


@value
class AppliedForce(Load):
    """A force that keeps its direction whatever the point does; it comes on smoothly and stays.

        F = force (3 x^2 - 2 x^3),   x = (t - start)/(end - start) from 0 to 1

    With a `course` it is force times that. It is what a roof that follows the machine puts on it, where `Roof`
    yields as the machine does. All that it does to the point counts as work; it stores nothing.

    Arguments:
        body, point: what it acts on, see `Load`; it stays with the point of the body.
        full_force: in the end, forward and up [N]; a roof presses down, (0, -1e6).
        start, end: between which it comes on [s], 0 <= start < end; both 0: it acts from the start on, and a
            start "settled" is settled under it.
        course: by which it is multiplied over time, in place of both.
    """

    full_force: Newtons[Vector2]
    start: Seconds[NonNegative] = 0.0
    end: Seconds[NonNegative] = 0.0
    course: LoadCourse | None = None

    @model_validator(mode="after")
    def _comes_on(self) -> AppliedForce:
        self._coming.check()
        return self

    @cached_property
    def _coming(self) -> Coming:
        return Coming(self.start, self.end, self.course)

    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point, forward and up [N]."""
        share = self._coming.share(at.time)
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
        """Start and end of its rise, or the breaks of its course [s]."""
        return self._coming.breaks

    @property
    def shortest_time(self) -> float:
        """That of its course [s]."""
        return self._coming.shortest_time

    def largest(self, duration: float) -> Vector2:
        """The force as far as it comes on in the run [N]."""
        share = self._coming.largest(duration)
        return self.full_force[0] * share, self.full_force[1] * share
