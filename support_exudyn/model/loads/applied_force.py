"""A force whose course over time is given."""

from __future__ import annotations

from functools import cached_property

from pydantic import model_validator

from support_exudyn.model.loads.course import Coming, LoadCourse
from support_exudyn.model.loads.load import Load, LoadChannel, TimeFunction
from user_forces.kernel import kernel
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

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """The share of the full force that acts."""
        return (self._coming.share,)

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
        share: float,
        *full_force: float,
    ) -> tuple[float, ...]:
        """The force, all of whose power is work; see `ActingLoad`."""
        along, up = full_force[0] * share, full_force[1] * share
        return along, up, 0.0, 0.0, along * vx + up * vy, 0.0, along, up

    @property
    def channels(self) -> dict[str, LoadChannel]:
        """The channels are the force's two components."""
        return {
            "force_x": LoadChannel("N", "of the load, forward"),
            "force_y": LoadChannel("N", "of the load, up"),
        }

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
