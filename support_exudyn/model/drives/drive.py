"""How the driven parts of a machine move over time: actuators extend, cranks turn."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod

from pydantic import model_validator

from user_forces.values.units import Seconds, Travel, TravelRate
from user_forces.values.value import NonNegative, Positive, Real, Value, value


class Drive(Value, ABC):
    """Extension of an actuator from its start length [m], or of a crank from its start angle [rad], over time.

    The contract: `extension` is continuous; `speed` is its derivative; between two neighbouring `breaks`
    both are smooth; at a break the speed may jump by `speed_jump`. The solver lands on every break.
    """

    @abstractmethod
    def extension(self, t: float) -> float:
        """Extension [m] at time t [s]."""

    @abstractmethod
    def speed(self, t: float) -> float:
        """Rate of the extension [m/s] at time t [s]; at a jump the value before it."""

    def speed_jump(self, t: float) -> float:
        """Jump of the speed [m/s] at a break t [s]; 0 by default."""
        del t
        return 0.0

    @property
    def initial_speed(self) -> float:
        """Speed just after the start [m/s]; the machine starts with velocities that belong to it."""
        return 0.0

    @property
    @abstractmethod
    def breaks(self) -> tuple[float, ...]:
        """Times [s] at which a derivative jumps."""

    @abstractmethod
    def span(self, duration: float) -> tuple[float, float]:
        """Smallest and largest extension [m] within this time [s]."""


@value
class Held(Drive):
    """Actuators of constant length."""

    def extension(self, t: float) -> float:
        """The extension is 0 m at any time."""
        return 0.0

    def speed(self, t: float) -> float:
        """The speed is 0 m/s at any time."""
        return 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        """There are no breaks."""
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        """The span is (0, 0) m."""
        return 0.0, 0.0


@value
class Stroke(Drive, ABC):
    """A stroke between two times, at rest before and after.

    Arguments:
        stroke: [m], 0.5 by default, or the angle of a crank [rad]; negative to lower.
        start, end: [s], 3 and 5 by default; end > start >= 0.
    """

    stroke: Travel[Real] = 0.5
    start: Seconds[NonNegative] = 3.0
    end: Seconds[Positive] = 5.0

    @model_validator(mode="after")
    def _ends_after_it_starts(self) -> Stroke:
        if self.end <= self.start:
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s")
        return self

    @property
    def breaks(self) -> tuple[float, ...]:
        """Start and end of the stroke [s]."""
        return self.start, self.end

    def span(self, duration: float) -> tuple[float, float]:
        """The span from 0 to the stroke [m], in order."""
        return min(0.0, self.stroke), max(0.0, self.stroke)

    def phase(self, t: float) -> float:
        """Share of the stroke's time that is over at t [s]: 0 before its start, 1 after its end."""
        x = (t - self.start) / (self.end - self.start)
        return 0.0 if x <= 0.0 else 1.0 if x >= 1.0 else x


@value
class CubicStep(Stroke):
    """Smooth inlet, drive mode 2 of the paper.

        extension = stroke (3 x^2 - 2 x^3), x = (t - start)/(end - start) from 0 to 1

    The cubic STEP function of multibody programs: speed is continuous, acceleration jumps at both ends.
    The paper's STEP(TIME,0,0,3,0)+STEP(TIME,3,0,5,500), in mm, is the default.

    Arguments: those of `Stroke`.
    """

    def extension(self, t: float) -> float:
        """Extension [m] at time t [s]."""
        x = self.phase(t)
        return self.stroke * x * x * (3.0 - 2.0 * x)

    def speed(self, t: float) -> float:
        """Speed [m/s] at time t [s]."""
        x = self.phase(t)
        return self.stroke * 6.0 * x * (1.0 - x) / (self.end - self.start)


@value
class UniformSpeed(Stroke):
    """Direct inlet (drive mode 1 of the paper): constant speed from rest, without transition.

    The speed jumps at both ends. With rigid actuators that is an impulse, and the bodies' velocities jump with
    it; the impulse is reported in N s (`Result.impulses`). A force and an acceleration at that instant do not
    exist; just before and just after they do.

    Arguments: those of `Stroke`.
    """

    def extension(self, t: float) -> float:
        """Extension [m] at time t [s]."""
        return self.stroke * self.phase(t)

    def speed(self, t: float) -> float:
        """Speed [m/s] at time t [s]; at the jumps the value before."""
        return self.stroke / (self.end - self.start) if self.start < t <= self.end else 0.0

    def speed_jump(self, t: float) -> float:
        """Jump of the speed [m/s]: up at the start, down at the end."""
        speed = self.stroke / (self.end - self.start)
        return {self.start: speed, self.end: -speed}.get(t, 0.0)


@value
class Steady(Drive):
    """Constant speed from the start on, for a crank that has been turning for long.

    Arguments:
        rate: speed [rad/s] of cranks, [m/s] of actuators.
    """

    rate: TravelRate[Real]

    def extension(self, t: float) -> float:
        """The angle, rate t [rad]."""
        return self.rate * t

    def speed(self, t: float) -> float:
        """rate [rad/s]."""
        return self.rate

    @property
    def initial_speed(self) -> float:
        """rate [rad/s]."""
        return self.rate

    @property
    def breaks(self) -> tuple[float, ...]:
        """There are no breaks: the crank has been turning for long."""
        return ()

    def span(self, duration: float) -> tuple[float, float]:
        """The span from 0 to rate times duration [rad], in order."""
        return min(0.0, self.rate * duration), max(0.0, self.rate * duration)


@value
class Reciprocating(Drive):
    """Raised and lowered over and over, from rest and smoothly.

        extension = stroke (1 - cos(2 pi t / period)) / 2

    Arguments:
        stroke: between lowest and highest [m], 0.5 by default, or the angle of a crank [rad]; negative to
            lower first.
        period: of raising and lowering once [s], > 0.
    """

    stroke: Travel[Real] = 0.5
    period: Seconds[Positive]

    @property
    def frequency(self) -> float:
        """Angular frequency [rad/s]."""
        return 2.0 * math.pi / self.period

    def _phase(self, t: float) -> float:
        """Angle [rad] of the cosine.

        Whole periods are left out, which is exact. With them the angle would be rounded the more the longer
        the run: after 1000 s positions by 1e-14 m, and accelerations by that over the step squared.
        """
        return self.frequency * math.fmod(t, self.period)

    def extension(self, t: float) -> float:
        """Extension [m] at time t [s]."""
        return 0.5 * self.stroke * (1.0 - math.cos(self._phase(t)))

    def speed(self, t: float) -> float:
        """Speed [m/s] at time t [s]."""
        return 0.5 * self.stroke * self.frequency * math.sin(self._phase(t))

    @property
    def breaks(self) -> tuple[float, ...]:
        """The start [s], where the acceleration jumps; it is smooth from then on."""
        return (0.0,)

    def span(self, duration: float) -> tuple[float, float]:
        """The span from 0 to the farthest extension within this time [m], in order."""
        farthest = self.stroke if duration >= 0.5 * self.period else self.extension(duration)
        return min(0.0, farthest), max(0.0, farthest)
