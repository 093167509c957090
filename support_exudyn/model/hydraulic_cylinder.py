"""An actuator that is a hydraulic cylinder: two chambers of oil behind a valve, and how the valve opens.

    dp0/dt = B / V0 (Q0 - A0 v),    V0 = A0 (h0 + e) + H0      piston side
    dp1/dt = B / V1 (Q1 + A1 v),    V1 = A1 (h1 - e) + H1      rod side
    F = p0 A0 - p1 A1 - d v

e is the extension since the start, v its rate; F pushes the ends apart. Flows follow from the opening o:

    Q = o Qn sqrt(|dp| / dpn) sign(dp),   dp: pump less chamber, or chamber less tank

They are those of the engine's ObjectConnectorHydraulicActuatorSimple with `useChamberVolumeChange`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import field
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field, model_validator

from support_exudyn.model.actuator_model import Quantity
from support_exudyn.model.hydraulics.leg import HydraulicLeg
from support_exudyn.model.hydraulics.valves import CheckValve, YieldValve
from user_forces.values.units import (
    CubicMetres,
    CubicMetresPerSecond,
    Metres,
    NewtonSecondsPerMetre,
    Pascals,
    Seconds,
    SquareMetres,
)
from user_forces.values.value import InputError, NonNegative, Positive, Real, Value, value

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
        return float("inf")


@value
class SuddenOpening(Inlet):
    """Direct inlet, drive mode 1 of the paper: the valve opens and closes at once.

    Arguments:
        start, end: when it opens and closes [s], 3 and 5 by default; end > start >= 0.
        extent: of the opening, from -1 to 1, 1 by default: fully open so that the actuator extends.
    """

    start: Seconds[NonNegative] = 3.0
    end: Seconds[Positive] = 5.0
    extent: Opening = 1.0

    @model_validator(mode="after")
    def _closes_after_it_opens(self) -> SuddenOpening:
        if self.end <= self.start:
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s")
        return self

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
class RampedOpening(Inlet):
    """Smooth inlet, drive mode 2 of the paper: the valve opens and closes along straight ramps.

    Arguments:
        start, end: when it begins to open and is closed again [s], 3 and 5 by default; end > start >= 0.
        ramp: how long it takes to open, and to close [s], 0.5 by default; > 0, at most half of end - start.
        extent: of the opening between the ramps, from -1 to 1, 1 by default: fully open so that the actuator
            extends.
    """

    start: Seconds[NonNegative] = 3.0
    end: Seconds[Positive] = 5.0
    ramp: Seconds[Positive] = 0.5
    extent: Opening = 1.0

    @model_validator(mode="after")
    def _ramps_fit(self) -> RampedOpening:
        if self.end <= self.start:
            raise ValueError(f"end = {self.end} s: allowed: > start = {self.start} s")
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


@value
class HydraulicCylinder(HydraulicLeg):
    """A massless actuator that is a hydraulic cylinder: it moves by the oil that its valve lets in.

    No drive moves it. Until the valve opens, the oil in both chambers carries the static load of the start
    posture with ideal pins: the chamber that the load presses has the pressure for it, the other one that of
    the tank. Pipe, valve and fittings are one resistance. Without a check valve oil flows back where a
    chamber has more pressure than the pump. Oil pulls as well as it pushes unless a `vapour_pressure` says
    where it boils. A run in which the piston comes to an end of its cylinder is refused.

    Arguments:
        bore_area: of the piston, all cylinders of a pair together [m^2], > 0.
        rod_side_area: the annulus around the rod, all together [m^2], > 0.
        oil_length: length of the oil under the piston at the start [m], > 0, less than the actuator.
        rod_side_length: length of the oil around the rod at the start [m], > 0: by so much it can extend.
        bulk_modulus: of the oil or emulsion, with what hoses and cylinders give [Pa], > 0.
        system_pressure: of the pump [Pa], > tank_pressure.
        nominal_flow: through the fully open valve at `nominal_drop`, all cylinders together, either side
            [m^3/s], > 0.
        nominal_drop: of the pressure, at which that flows [Pa], > 0, 1 MPa by default.
        tank_pressure: [Pa], >= 0, 0 by default.
        hose_volume: between valve and piston side, all together [m^3], > 0, 1 litre by default.
        rod_side_hose_volume: between valve and rod side, all together [m^3], > 0, 1 litre by default.
        damping: viscous, of the seals, all together [N s/m], >= 0, 0 by default.
        inlet: how the valve opens over time; closed by default.
        check_valve: holds the oil of the piston side; None: where it has more pressure than the pump, oil flows
            back.
        rod_relief: lets oil out of the rod side above a pressure; None: nothing does.
        The others are those of `HydraulicLeg`.
    """

    extensive: ClassVar[tuple[str, ...]] = (
        "bore_area",
        "rod_side_area",
        "nominal_flow",
        "hose_volume",
        "rod_side_hose_volume",
        "damping",
    )

    bore_area: SquareMetres[Positive]
    rod_side_area: SquareMetres[Positive]
    oil_length: Metres[Positive]
    rod_side_length: Metres[Positive]
    bulk_modulus: Pascals[Positive]
    system_pressure: Pascals[Positive]
    nominal_flow: CubicMetresPerSecond[Positive]
    nominal_drop: Pascals[Positive] = 1e6
    tank_pressure: Pascals[NonNegative] = 0.0
    hose_volume: CubicMetres[Positive] = 1e-3
    rod_side_hose_volume: CubicMetres[Positive] = 1e-3
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0
    inlet: Inlet = field(default_factory=ClosedInlet)
    check_valve: CheckValve | None = None
    rod_relief: YieldValve | None = None

    def check_length(self, length: float, name: str) -> None:
        """Raise InputError if the cylinder does not fit into an actuator of this length [m] at the start."""
        if self.oil_length >= length:
            raise InputError(
                f"actuators.{name}.oil_length = {self.oil_length} m: the actuator is {length:.4g} m long at "
                "the start; allowed: less than that"
            )
        if self.system_pressure <= self.tank_pressure:
            raise InputError(
                f"actuators.{name}.system_pressure = {self.system_pressure} Pa: allowed: > tank_pressure = "
                f"{self.tank_pressure} Pa"
            )

    def past_end(self, extension: float, name: str) -> str:
        """The message that an extension since the start [m] is beyond an end of the cylinder; empty: it is not.

        A second stage has stops of its own.
        """
        low, high = -self.oil_length, self.rod_side_length
        if self.second_stage is not None or low <= extension <= high:
            return ""
        return (
            f"{name} is {'drawn in' if extension < low else 'extended'} by {abs(extension):.4g} m, beyond its "
            f"cylinder's end; allowed: {low:.4g} to {high:.4g} m from the start"
        )

    def check_elements(self, where: str) -> None:
        """Raise InputError if elements do not go together; where: path of the cylinder."""
        super().check_elements(where)
        if self.rod_relief is not None and self.rod_relief.poppet is not None:
            raise InputError(f"{where}.rod_relief.poppet: allowed: none; the rod side's valve opens at once")
        for name, valve in (("yield_valve", self.yield_valve), ("rod_relief", self.rod_relief)):
            if valve is not None and valve.closes_at < self.tank_pressure:
                raise InputError(
                    f"{where}.tank_pressure = {self.tank_pressure} Pa: oil would come in through {name}, which "
                    f"is open down to {valve.closes_at} Pa; allowed: at most that"
                )

    @property
    def flow_factor(self) -> float:
        """Flow through the open valve over the root of the pressure drop [m^3/(s Pa^0.5)]."""
        return self.nominal_flow / math.sqrt(self.nominal_drop)

    def volumes(self, extension: Quantity) -> tuple[Quantity, Quantity]:
        """Volumes of both chambers, hoses included [m^3], at an extension since the start [m]."""
        piston = self.bore_area * (self.oil_length + extension) + self.hose_volume
        rod = self.rod_side_area * (self.rod_side_length - extension) + self.rod_side_hose_volume
        return piston, rod

    def force(self, pressure: Quantity, rod_pressure: Quantity, rate: Quantity) -> Quantity:
        """Force that pushes the ends apart [N], at pressures [Pa] and a rate of the length [m/s]."""
        return self.bore_area * pressure - self.rod_side_area * rod_pressure - self.damping * rate

    def stiffness(self, extension: float) -> float:
        """Stiffness of the closed chambers [N/m] at an extension since the start [m]."""
        piston, rod = self.volumes(extension)
        return self.bulk_modulus * (self.bore_area**2 / piston + self.rod_side_area**2 / rod)

    def supplies(self, opening: Quantity) -> tuple[Quantity, Quantity]:
        """Pressures [Pa] that the valve connects the piston side and the rod side to."""
        if isinstance(opening, float):  # asked for in every step
            pump, tank = self.system_pressure, self.tank_pressure
            return (pump, tank) if opening >= 0.0 else (tank, pump)
        forward = opening >= 0.0
        piston = np.where(forward, self.system_pressure, self.tank_pressure)
        rod = np.where(forward, self.tank_pressure, self.system_pressure)
        return piston, rod

    def flows(self, pressure: Quantity, rod_pressure: Quantity, opening: Quantity) -> tuple[Quantity, Quantity]:
        """Flows into the piston side and into the rod side [m^3/s], at pressures [Pa] and an opening."""
        piston, rod = self.supplies(opening)
        wide = self.flow_factor * np.abs(opening)
        into: tuple[Quantity, Quantity] = (wide * _root(piston - pressure), wide * _root(rod - rod_pressure))
        return into

    def energy_density(self, pressure: Quantity) -> Quantity:
        """Energy of compressed oil [J/m^3] at a pressure [Pa]: B (exp(p/B) - 1 - p/B), about p^2 / 2 B."""
        strain = pressure / self.bulk_modulus
        density: Quantity = self.bulk_modulus * (np.expm1(strain) - strain)
        return density


def _root(drop: Quantity) -> Quantity:
    """Square root of the size, with the sign."""
    found: Quantity = np.sign(drop) * np.sqrt(np.abs(drop))
    return found
