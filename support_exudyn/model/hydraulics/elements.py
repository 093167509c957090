"""Elements of hydraulic legs: valves, line and pump, trapped air, seals, ends of the stroke, a second stage."""

from __future__ import annotations

import math
from dataclasses import fields, replace
from typing import Any, ClassVar, TypeVar

from pydantic import model_validator

from user_forces.values.units import (
    CubicMetres,
    CubicMetresPerSecond,
    Kilograms,
    Metres,
    MetresPerSecond,
    Newtons,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
    Pascals,
    SecondsPerMetre,
    SquareMetres,
)
from user_forces.values.value import NonNegative, Positive, Real, Value, value

ATMOSPHERE = 101325.0  # [Pa]; pressures of the program are those above it
Whole = TypeVar("Whole", bound="Shared")


class Shared:
    """A value that counts all legs of a pair together.

    extensive: names of what it has of them all, such as areas and flows; the others are alike for each, such as
    lengths and pressures.
    """

    extensive: ClassVar[tuple[str, ...]] = ()

    def share(self: Whole, fraction: float) -> Whole:
        """What a fraction of all legs is, > 0, at most 1; so of all its parts."""
        made: Any = self
        changes = {name: fraction * getattr(self, name) for name in self.extensive}
        for field in fields(made):
            if isinstance(part := getattr(self, field.name), Shared):
                changes[field.name] = part.share(fraction)
        shared: Whole = replace(made, **changes)
        return shared


# --- oil, and what lets it in and out ---


@value
class TrappedAir(Shared, Value):
    """Air that stays in the chamber of a leg, and makes its oil softer the lower the pressure is.

        V_air = V0 (p_a / (p + p_a))^(1/n)

    p_a is the pressure of the atmosphere, p that above it. Together with a liquid of bulk modulus B the
    effective modulus is that of Merritt (Hydraulic Control Systems, Wiley 1967, section 2.2),

        1/B_e = 1/B + V_air / (V n (p + p_a))

    The air is not dissolved. Real oil dissolves it at some 10 MPa, and is then stiffer.

    Arguments:
        volume: V0, of the air at the pressure of the atmosphere, all legs of a pair together [m^3], > 0.
        exponent: n [-], > 0; 1: slow changes that keep the temperature, 1.4: fast ones.
    """

    extensive: ClassVar[tuple[str, ...]] = ("volume",)

    volume: CubicMetres[Positive]
    exponent: Positive = 1.4

    def at(self, pressure: float) -> float:
        """V_air [m^3] at a pressure [Pa], > -p_a."""
        volume: float = self.volume * (ATMOSPHERE / (pressure + ATMOSPHERE)) ** (1.0 / self.exponent)
        return volume


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


@value
class Line(Shared, Value):
    """A hose between the inlet and the piston side: it holds oil, and resists its flow.

        flow = (p_line - p) / R,   R = nominal_drop / nominal_flow

    The resistance is laminar. What a check valve holds back is between line and leg. Waves in the hose are left
    out: a sudden stop of a flow at c m/s would raise its pressure by density * sound speed * c, some 1.4 MPa
    for 1 m/s.

    Arguments:
        volume: of the oil in it, all legs of a pair together [m^3], > 0.
        nominal_flow: at `nominal_drop`, all together [m^3/s], > 0.
        nominal_drop: of the pressure, at which that flows [Pa], > 0.
    """

    extensive: ClassVar[tuple[str, ...]] = ("volume", "nominal_flow")

    volume: CubicMetres[Positive]
    nominal_flow: CubicMetresPerSecond[Positive]
    nominal_drop: Pascals[Positive]

    @property
    def resistance(self) -> float:
        """R [Pa s/m^3]."""
        return self.nominal_drop / self.nominal_flow


@value
class PumpStation(Value):
    """A pump with its supply line, which all hydraulic cylinders of a machine share.

        flow = Q min(1, max(0, (p_max - p) / range))

    It holds the pressure at p_max while nothing is drawn, and gives no more than Q. The line's pressure follows
    from the oil in it, p = p_max + B (in - out)/V. What cylinders push back stays in the line.

    Arguments:
        flow: Q, the largest [m^3/s], > 0; 450 l/min, 7.5e-3 m^3/s, is that of a usual station.
        pressure: p_max [Pa], > 0.
        pressure_range: over which the flow falls to zero [Pa], > 0, less than `pressure`.
        line_volume: of the oil between pump and valves [m^3], > 0.
        bulk_modulus: of it, with what the hose gives [Pa], > 0.
    """

    flow: CubicMetresPerSecond[Positive]
    pressure: Pascals[Positive]
    pressure_range: Pascals[Positive] = 1e6
    line_volume: CubicMetres[Positive] = 0.02
    bulk_modulus: Pascals[Positive] = 1e9

    @model_validator(mode="after")
    def _has_a_range_below_its_pressure(self) -> PumpStation:
        if self.pressure_range >= self.pressure:
            raise ValueError(
                f"pressure_range = {self.pressure_range} Pa: allowed: < pressure = {self.pressure} Pa"
            )
        return self


# --- motion ---


@value
class SealFriction(Shared, Value):
    """Friction of seals and guide rings, by Stribeck's curve.

        F = (F_c + (F_s - F_c) exp(-(v/v_s)^2)) tanh(v/v_t)

    F resists the rate v of the length. The last factor stands for stiction: a leg that carries less than F_s
    creeps at up to v_t. Source of the curve: Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30
    (1994) 1083-1138, section 3.

    Arguments:
        coulomb: F_c, all legs of a pair together [N], >= 0.
        static: F_s [N], >= coulomb.
        stribeck_speed: v_s [m/s], > 0.
        transition_speed: v_t [m/s], > 0, less than v_s.
    """

    extensive: ClassVar[tuple[str, ...]] = ("coulomb", "static")

    coulomb: Newtons[NonNegative]
    static: Newtons[NonNegative]
    stribeck_speed: MetresPerSecond[Positive] = 0.01
    transition_speed: MetresPerSecond[Positive] = 0.001

    @model_validator(mode="after")
    def _is_a_curve(self) -> SealFriction:
        if self.static < self.coulomb:
            raise ValueError(f"static = {self.static} N: allowed: >= coulomb = {self.coulomb} N")
        if self.transition_speed >= self.stribeck_speed:
            raise ValueError(
                f"transition_speed = {self.transition_speed} m/s: allowed: < stribeck_speed = "
                f"{self.stribeck_speed} m/s"
            )
        return self


@value
class EndStops(Shared, Value):
    """Where the stroke ends: steel meets steel.

        F = k depth max(0, 1 + b rate)

    depth is by how far the extension is beyond the end, rate that of the depth.

    Arguments:
        lowest: extension since the start at which the piston meets the foot [m], <= 0.
        highest: extension since the start at which it meets the gland [m], >= 0, more than lowest.
        stiffness: k [N/m], > 0.
        damping: b [s/m], >= 0.
    """

    extensive: ClassVar[tuple[str, ...]] = ("stiffness",)

    lowest: Metres[Real]
    highest: Metres[Real]
    stiffness: NewtonsPerMetre[Positive] = 1e9
    damping: SecondsPerMetre[NonNegative] = 1.0

    @model_validator(mode="after")
    def _starts_between(self) -> EndStops:
        if not self.lowest <= 0.0 <= self.highest or self.lowest == self.highest:
            raise ValueError(
                f"lowest = {self.lowest} m, highest = {self.highest} m: allowed: lowest <= 0 <= highest, and "
                "not both 0"
            )
        return self


@value
class SecondStage(Shared, Value):
    """The inner stage of a telescopic leg, and the tube between both stages, which moves by pressure and area.

        m s'' = p A - p_r A_r - (p2 A2 - p_r A2r) - d s' + stops + friction of the seals of both

    s is the extension of the outer stage since the start, p the pressure under the tube, p2 that inside it, p_r
    that of the rod sides of both stages, which are joined. A foot valve lets oil into the tube freely, and out
    of it only where the tube stands near the bottom of its stroke, by the share (lowest + release - s)/release,
    cut at 0 and 1. The leg's own `bore_area`, `oil_length`, `end_stops` are those of the outer stage; its seals
    and its `damping` act on the rate of each stage. The tube's inertia is seen from the foot.

    Arguments:
        bore_area: A2 of the inner piston, all legs of a pair together [m^2], > 0.
        oil_length: of the oil in the tube at the start [m], > 0.
        stops: ends of the stroke of the inner stage, by its own extension since the start.
        tube_mass: m, all together [kg], > 0.
        nominal_flow: through the foot valve at `nominal_drop` [m^3/s], > 0.
        nominal_drop: of the pressure, at which that flows [Pa], > 0.
        rod_side_area: A2r, the annulus of the inner stage, all together [m^2], >= 0.
        rod_side_length: of the oil around it at the start [m], >= 0.
        damping: d, viscous, of the tube [N s/m], >= 0.
        release: [m], > 0.
    """

    extensive: ClassVar[tuple[str, ...]] = (
        "bore_area",
        "rod_side_area",
        "tube_mass",
        "nominal_flow",
        "damping",
    )

    bore_area: SquareMetres[Positive]
    oil_length: Metres[Positive]
    stops: EndStops
    tube_mass: Kilograms[Positive]
    nominal_flow: CubicMetresPerSecond[Positive]
    nominal_drop: Pascals[Positive] = 1e6
    rod_side_area: SquareMetres[NonNegative] = 0.0
    rod_side_length: Metres[NonNegative] = 0.0
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0
    release: Metres[Positive] = 1e-3
