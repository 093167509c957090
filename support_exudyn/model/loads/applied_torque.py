"""A torque whose course over time is given."""

from __future__ import annotations

from functools import cached_property

from pydantic import model_validator

from support_exudyn.model.loads.course import Coming, LoadCourse
from support_exudyn.model.loads.load import TimeFunction
from support_exudyn.model.loads.moment_load import MomentLoad
from user_forces.kernel import kernel
from user_forces.values.units import NewtonMetres, Seconds
from user_forces.values.value import NonNegative, Real, value


@value
class AppliedTorque(MomentLoad):
    """A torque on a body, however it turns, and the opposite one on another, or on the ground.

    It comes on and stays as `AppliedForce` does, or has a course. All that it does counts as work.

    Arguments:
        body, other: see `MomentLoad`.
        full_torque: in the end, positive anticlockwise [N m].
        start, end: between which it comes on [s], 0 <= start < end; both 0: it acts from the start on.
        course: by which it is multiplied over time, in place of both.
    """

    full_torque: NewtonMetres[Real]
    start: Seconds[NonNegative] = 0.0
    end: Seconds[NonNegative] = 0.0
    course: LoadCourse | None = None

    @model_validator(mode="after")
    def _comes_on(self) -> AppliedTorque:
        self._coming.check()
        return self

    @cached_property
    def _coming(self) -> Coming:
        return Coming(self.start, self.end, self.course)

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """The share of the full torque that acts."""
        return (self._coming.share,)

    @staticmethod
    @kernel
    def action(t: float, turn: float, spin: float, share: float, full_torque: float) -> tuple[float, ...]:
        """The torque, all of whose power is work; see `ActingLoad`."""
        moment = full_torque * share
        return moment, 0.0, moment * spin, 0.0, moment

    @property
    def breaks(self) -> tuple[float, ...]:
        """Start and end of its rise, or the breaks of its course [s]."""
        return self._coming.breaks

    @property
    def shortest_time(self) -> float:
        """That of its course [s]."""
        return self._coming.shortest_time

    def largest(self, duration: float) -> tuple[float]:
        """The torque as far as it comes on in the run [N m]."""
        return (self.full_torque * self._coming.largest(duration),)
