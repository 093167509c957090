"""Between pump and leg: the line to it, and the pump that all legs share."""

from __future__ import annotations

from typing import ClassVar

from pydantic import model_validator

from support_exudyn.model.hydraulics.sharing import Shared
from user_forces.values.units import CubicMetres, CubicMetresPerSecond, Pascals
from user_forces.values.value import Positive, Value, value


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
