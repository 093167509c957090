"""Valves of a hydraulic leg: one that holds, and one that yields."""

from __future__ import annotations

import math
from typing import ClassVar

from pydantic import model_validator

from support_exudyn.model.hydraulics.sharing import Shared
from user_forces.values.units import (
    CubicMetresPerSecond,
    Kilograms,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
    Pascals,
)
from user_forces.values.value import NonNegative, Positive, Value, value


@value
class CheckValve(Value):
    """A pilot-operated check valve on the piston side: oil flows in freely, and out only if it is released.

    Oil flows in while the supply has more than the chamber's pressure and the cracking pressure together. The
    pressure that the inlet connects the rod side to releases it: out flows

        s Q,   s = min(1, max(0, (r pilot - p) / range))

    where Q is what would flow without the valve, and p is the chamber's pressure.

    Arguments:
        pilot_ratio: r, area of the pilot piston over that of the seat [-], > 0.
        pilot_range: of the pressure between the first opening and the full one [Pa], > 0.
        cracking_pressure: that opens it inwards [Pa], >= 0.
    """

    pilot_ratio: Positive = 4.0
    pilot_range: Pascals[Positive] = 1e6
    cracking_pressure: Pascals[NonNegative] = 0.0


@value
class Poppet(Value):
    """The moving part of a yield valve, which takes its time.

        m s'' = k (p - p_open - s) - d s',   flow = slope max(0, s)

    s is its lift times k over the seat's area, a pressure: at rest it is that above the opening pressure, so
    that the valve at rest passes what it would without inertia. The seat is a hundred times as stiff as the
    spring, and critically damped. A poppet that is still open when the pressure has fallen below a tenth of
    p_open passes less in proportion, and nothing where there is no pressure above the tank's.

    Arguments:
        mass: m, of the poppet and a third of the spring [kg], > 0.
        stiffness: k, of the spring [N/m], > 0.
        damping: d [N s/m], >= 0.
    """

    mass: Kilograms[Positive]
    stiffness: NewtonsPerMetre[Positive]
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0

    @property
    def frequency(self) -> float:
        """Angular frequency of the undamped poppet [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def decay(self) -> float:
        """d/m [1/s]."""
        return self.damping / self.mass


@value
class YieldValve(Shared, Value):
    """A relief valve: it lets oil out to the tank above a pressure.

        flow = slope max(0, p - p_open),   slope = rated_flow / rated_overpressure

    With a closing pressure below it has hysteresis: once open, it passes slope (p - p_close) until the pressure
    has come down to p_close, so that the flow begins with a jump.

    Arguments:
        opening_pressure: p_open [Pa], > 0.
        rated_flow: at `rated_overpressure`, all valves of a pair of legs together [m^3/s], > 0.
        rated_overpressure: above the opening pressure [Pa], > 0.
        closing_pressure: p_close [Pa], > 0, at most the opening pressure; None: the same.
        poppet: what takes its time; None: nothing. Not together with a closing pressure of its own.
    """

    extensive: ClassVar[tuple[str, ...]] = ("rated_flow",)

    opening_pressure: Pascals[Positive]
    rated_flow: CubicMetresPerSecond[Positive]
    rated_overpressure: Pascals[Positive]
    closing_pressure: Pascals[Positive] | None = None
    poppet: Poppet | None = None

    @model_validator(mode="after")
    def _closes_below(self) -> YieldValve:
        if self.closing_pressure is None:
            return self
        if self.closing_pressure > self.opening_pressure:
            raise ValueError(
                f"closing_pressure = {self.closing_pressure} Pa: allowed: at most opening_pressure = "
                f"{self.opening_pressure} Pa"
            )
        if self.poppet is not None and self.closing_pressure < self.opening_pressure:
            raise ValueError(f"closing_pressure = {self.closing_pressure} Pa: allowed beside a poppet: none")
        return self

    @property
    def slope(self) -> float:
        """Flow over pressure [m^3/(s Pa)]."""
        return self.rated_flow / self.rated_overpressure

    @property
    def closes_at(self) -> float:
        """p_close [Pa]."""
        return self.opening_pressure if self.closing_pressure is None else self.closing_pressure
