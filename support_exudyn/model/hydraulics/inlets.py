"""How the valve of a hydraulic cylinder opens over time: closed, at once, or along ramps."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import Annotated

from pydantic import Field, model_validator

from user_forces.values.units import Seconds
from user_forces.values.value import NonNegative, Positive, Real, Value, value

Opening = Annotated[Real, Field(ge=-1.0, le=1.0)]


class Inlet(Value, ABC):
    """Opening of a cylinder's valve, from -1 to 1, over time.

    Positive: the pump is connected to the piston side and the tank to the rod side, so that the actuator
        extends.
    Negative: the other way round. Zero: both sides are closed. The contract is that of a drive's speed: between
    two neighbouring `breaks` the opening is smooth; at a break it may jump by `opening_jump`. The solver lands
    on every break.
    """

    @abstractmethod
    def opening(self, t: float) -> float:
        """Share of the full opening at time t [s]; at a jump the value before it."""

    def opening_jump(self, t: float) -> float:
        """Jump of the opening at a break t [s]; 0 by default."""
        del t
        return 0.0

    @property
    @abstractmethod
    def breaks(self) -> tuple[float, ...]:
        """Times [s] at which the opening or its rate jumps."""

    @property
    @abstractmethod
    def shortest_time(self) -> float:
        """Time [s] in which the opening changes, or stays, whichever is shorter."""


@value
class ClosedInlet(Inlet):
    """A valve that stays closed: the oil in both chambers carries the load."""

    def opening(self, t: float) -> float:
        """The opening is 0 at any time."""
        return 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        """There are no breaks."""
        return ()

    @property
    def shortest_time(self) -> float:
        """The time is infinite [s]."""
        return math.inf


@value
class TimedInlet(Inlet, ABC):
    """A valve that is open between two times.

    Arguments:
        start, end: when it begins to open and is closed again [s], 3 and 5 by default; end > start >= 0.
        extent: of the opening, from -1 to 1, 1 by default: fully open so that the actuator extends.
    """

    start: Seconds[NonNegative] = 3.0
    end: Seconds[Positive] = 5.0
    extent: Opening = 1.0

    @model_validator(mode="after")
    def _closes_after_it_opens(self) -> TimedInlet:
        if self.end <= self.start:
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s")
        return self


@value
class SuddenOpening(TimedInlet):
    """Direct inlet, drive mode 1 of the paper: the valve opens and closes at once.

    Arguments: those of `TimedInlet`.
    """

    def opening(self, t: float) -> float:
        """Share of the full opening at time t [s]; at the jumps the value before."""
        return self.extent if self.start < t <= self.end else 0.0

    def opening_jump(self, t: float) -> float:
        """Jump of the opening: up at the start, down at the end."""
        return {self.start: self.extent, self.end: -self.extent}.get(t, 0.0)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Start and end [s]."""
        return self.start, self.end

    @property
    def shortest_time(self) -> float:
        """Time for which the valve is open [s]."""
        return self.end - self.start


@value
class RampedOpening(TimedInlet):
    """Smooth inlet, drive mode 2 of the paper: the valve opens and closes along straight ramps.

    Arguments: those of `TimedInlet`, and
        ramp: how long it takes to open, and to close [s], 0.5 by default; > 0, at most half of end - start.
    """

    ramp: Seconds[Positive] = 0.5

    @model_validator(mode="after")
    def _ramps_fit(self) -> RampedOpening:
        if 2.0 * self.ramp > (self.end - self.start) * (1.0 + 1e-12):
            raise ValueError(
                f"ramp = {self.ramp} s: allowed: at most half of end - start, {0.5 * (self.end - self.start)} s"
            )
        return self

    def opening(self, t: float) -> float:
        """Share of the full opening at time t [s]."""
        share = min((t - self.start) / self.ramp, 1.0, (self.end - t) / self.ramp)
        return self.extent * max(0.0, share)

    @property
    def breaks(self) -> tuple[float, ...]:
        """Ends of the ramps [s]."""
        return tuple(sorted({self.start, self.start + self.ramp, self.end - self.ramp, self.end}))

    @property
    def shortest_time(self) -> float:
        """Time of a ramp [s]."""
        return self.ramp
