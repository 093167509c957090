"""Elements of hydraulic legs: trapped air and pump, seals, ends of the stroke, a second stage."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any, ClassVar, TypeVar

from pydantic import model_validator

from user_forces.kernel import kernel
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
            elif isinstance(part, Mapping):
                changes[field.name] = {name: one.share(fraction) for name, one in part.items()}
        shared: Whole = replace(made, **changes)
        return shared


# --- oil ---


@kernel
def air_volume(air: float, exponent: float, pressure: float) -> float:
    """The volume [m^3] at a pressure [Pa] of air that has a volume `air` at the pressure of the atmosphere."""
    if air == 0.0:
        return 0.0
    return float(air * (ATMOSPHERE / (pressure + ATMOSPHERE)) ** (1.0 / exponent))


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
        return air_volume(self.volume, self.exponent, pressure)


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
