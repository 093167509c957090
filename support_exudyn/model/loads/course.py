"""The course of a force or a moment over time: a table, a harmonic one, or one that comes on and stays."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from functools import cached_property
from typing import Annotated, Literal, NamedTuple

from pydantic import Field, model_validator

from support_exudyn.model.drives.table_drive import MOST_POINTS, TableDrive
from user_forces.kernel import smooth_step
from user_forces.values.units import Radians, Seconds
from user_forces.values.value import NonNegative, Positive, Real, Value, value


class LoadCourse(Value, ABC):
    """A number over time by which a full force or a full torque is multiplied.

    The contract: `share` is continuous, and smooth between two neighbouring `breaks`, on which the solver
    lands.
    """

    @abstractmethod
    def share(self, t: float) -> float:
        """Share of the full force at a time t [s]."""

    @property
    @abstractmethod
    def breaks(self) -> tuple[float, ...]:
        """Times [s] at which a derivative jumps."""

    @abstractmethod
    def largest(self, duration: float) -> float:
        """The share of the largest magnitude within a duration [s]."""

    @property
    @abstractmethod
    def shortest_time(self) -> float:
        """Shortest time of it that steps have to follow [s]."""


@value
class TableCourse(LoadCourse):
    """Through given points, constant before the first and after the last.

    Between them it is what `TableDrive` makes of its points: "smooth" cubics that overshoot none of them, or
    "linear" pieces.

    Arguments:
        times: of the points [s], >= 0, each later than the one before; two at least.
        shares: of the full force at these times.
        between: how the points are joined.
    """

    times: Seconds[Annotated[tuple[NonNegative, ...], Field(min_length=2, max_length=MOST_POINTS)]]
    shares: Annotated[tuple[Real, ...], Field(min_length=2, max_length=MOST_POINTS)]
    between: Literal["smooth", "linear"] = "smooth"

    @model_validator(mode="after")
    def _is_a_table(self) -> TableCourse:
        if len(self.times) != len(self.shares):
            raise ValueError(f"{len(self.times)} times and {len(self.shares)} shares: allowed: as many of both")
        self._rise  # noqa: B018 - are times in order?
        return self

    @cached_property
    def _rise(self) -> TableDrive:
        """What is added to the first share."""
        first = self.shares[0]
        rises = tuple(one - first for one in self.shares)
        return TableDrive(times=self.times, extensions=rises, between=self.between)

    def share(self, t: float) -> float:
        """Share at a time t [s]."""
        return self.shares[0] + self._rise.extension(t)

    @property
    def breaks(self) -> tuple[float, ...]:
        """The points [s]; where they are joined by lines, those at which the slope jumps."""
        return self._rise.breaks

    def largest(self, duration: float) -> float:
        """The share of the largest magnitude within a duration [s]."""
        return max((self.shares[0] + rise for rise in self._rise.span(duration)), key=abs)

    @property
    def shortest_time(self) -> float:
        """The time from the first point to the last [s], as of a drive."""
        return self.times[-1] - self.times[0]


@value
class HarmonicCourse(LoadCourse):
    """A sine about a mean.

        share = mean + sin(2 pi t/period + phase)

    Arguments:
        period: [s], > 0.
        phase: at the start [rad].
        mean: share about which it swings.
    """

    period: Seconds[Positive]
    phase: Radians[Real] = 0.0
    mean: Real = 0.0

    def share(self, t: float) -> float:
        """Share at a time t [s]."""
        # whole periods are left out, which is exact, so that long runs do not round the angle
        since = math.fmod(t, self.period)
        return self.mean + math.sin(2.0 * math.pi / self.period * since + self.phase)

    @property
    def breaks(self) -> tuple[float, ...]:
        """There are none."""
        return ()

    def largest(self, duration: float) -> float:
        """Mean and amplitude together, which a duration of a period reaches."""
        del duration
        return self.mean + math.copysign(1.0, self.mean)

    @property
    def shortest_time(self) -> float:
        """One over the angular frequency [s]."""
        return self.period / (2.0 * math.pi)


class Coming(NamedTuple):
    """How a load comes on: by a course, or smoothly between two times, and stays; both 0: it is there at once.

    course: None: between `start` and `end` [s].
    """

    start: float
    end: float
    course: LoadCourse | None

    def check(self) -> None:
        """Raise ValueError unless the times are in order, or a course is given in their place."""
        if self.course is not None and (self.start, self.end) != (0.0, 0.0):
            raise ValueError(
                f"start = {self.start} s, end = {self.end} s: the course says when; allowed beside it: none"
            )
        if self.end <= self.start and (self.start, self.end) != (0.0, 0.0):
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s, or both 0")

    def share(self, t: float) -> float:
        """Share of the full force at a time t [s]."""
        if self.course is not None:
            return self.course.share(t)
        if self.end == 0.0:
            return 1.0
        return smooth_step((t - self.start) / (self.end - self.start))

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times [s] at which a derivative jumps."""
        if self.course is not None:
            return self.course.breaks
        return () if self.end == 0.0 else (self.start, self.end)

    def largest(self, duration: float) -> float:
        """The share of the largest magnitude within a duration [s]."""
        return self.share(duration) if self.course is None else self.course.largest(duration)

    @property
    def shortest_time(self) -> float:
        """Shortest time of a course [s]; infinite without one."""
        return math.inf if self.course is None else self.course.shortest_time
