"""Forces and torques over time: by a table, by a sine, or such that come on and stay."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from functools import cached_property
from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator
from typing_extensions import Self

from support_exudyn.model.drives.table_drive import MOST_POINTS, TableDrive
from support_exudyn.model.loads.load import Load, LoadChannel, MomentLoad, TimeFunction
from user_forces.kernel import kernel, smooth_step
from user_forces.values.units import NewtonMetres, Newtons, Radians, Seconds
from user_forces.values.value import NonNegative, Positive, Real, Value, Vector2, value


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
        """There are no breaks."""
        return ()

    @property
    def shortest_time(self) -> float:
        """One over the angular frequency [s]."""
        return self.period / (2.0 * math.pi)


@value
class ComingOn(Value, ABC):
    """What comes on smoothly between two times and stays, or has a course.

        share = 3 x^2 - 2 x^3,   x = (t - start)/(end - start) from 0 to 1

    Arguments:
        start, end: between which it comes on [s], 0 <= start < end; both 0: it acts from the start on, and a
            start "settled" is settled under it.
        course: by which it is multiplied over time, in place of both.
    """

    start: Seconds[NonNegative] = 0.0
    end: Seconds[NonNegative] = 0.0
    course: LoadCourse | None = None

    @model_validator(mode="after")
    def _comes_on(self) -> Self:
        if self.course is not None and (self.start, self.end) != (0.0, 0.0):
            raise ValueError(
                f"start = {self.start} s, end = {self.end} s: the course says when; allowed beside it: none"
            )
        if self.end <= self.start and (self.start, self.end) != (0.0, 0.0):
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s, or both 0")
        return self

    def share(self, t: float) -> float:
        """Share of the full force at a time t [s]."""
        if self.course is not None:
            return self.course.share(t)
        if self.end == 0.0:
            return 1.0
        return smooth_step((t - self.start) / (self.end - self.start))

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """The share of the full force that acts."""
        return (self.share,)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Start and end of its rise, or the breaks of its course [s]."""
        if self.course is not None:
            return self.course.breaks
        return () if self.end == 0.0 else (self.start, self.end)

    @property
    def shortest_time(self) -> float:
        """Shortest time of its course [s]; infinite without one."""
        return math.inf if self.course is None else self.course.shortest_time


@value
class AppliedForce(ComingOn, Load):
    """A force that keeps its direction whatever the point does; it comes on smoothly and stays.

        F = force (3 x^2 - 2 x^3),   x = (t - start)/(end - start) from 0 to 1

    With a `course` it is force times that. It is what a roof that follows the machine puts on it, where `Roof`
    yields as the machine does. All that it does to the point counts as work; it stores nothing.

    Arguments:
        body, point: what it acts on, see `Load`; it stays with the point of the body.
        full_force: in the end, forward and up [N]; a roof presses down, (0, -1e6).
        start, end, course: see `ComingOn`.
    """

    full_force: Newtons[Vector2]

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

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "force_x": LoadChannel("N", "of the load, forward"),
        "force_y": LoadChannel("N", "of the load, up"),
    }


@value
class AppliedTorque(ComingOn, MomentLoad):
    """A torque on a body, however it turns, and the opposite one on another, or on the ground.

    It comes on and stays as `AppliedForce` does, or has a course. All that it does counts as work.

    Arguments:
        body, other: see `MomentLoad`.
        full_torque: in the end, positive anticlockwise [N m].
        start, end, course: see `ComingOn`.
    """

    full_torque: NewtonMetres[Real]

    @staticmethod
    @kernel
    def action(t: float, turn: float, spin: float, share: float, full_torque: float) -> tuple[float, ...]:
        """The torque, all of whose power is work; see `ActingLoad`."""
        moment = full_torque * share
        return moment, 0.0, moment * spin, 0.0, moment
