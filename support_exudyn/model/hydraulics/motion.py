"""What limits or resists the motion of a leg: its seals, the ends of its stroke, a second stage."""

from __future__ import annotations

from typing import ClassVar

from pydantic import model_validator

from support_exudyn.model.hydraulics.sharing import Shared
from user_forces.values.units import (
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
