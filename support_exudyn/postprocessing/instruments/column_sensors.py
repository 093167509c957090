"""Instruments on columns: pressure gauges, and sensors of the extension."""

import math
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.actuators import OilColumn
from support_exudyn.model.hydraulics.leg import HydraulicCylinder
from support_exudyn.postprocessing.instruments.instrument import Instrument
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.names import meant
from user_forces.values.units import Metres, Pascals
from user_forces.values.value import InputError, NonNegative, Positive, Whole, value


@value
class PressureGauge(Instrument):
    """A gauge of the pressure in a column, against the air.

    Of a hydraulic cylinder it is the recorded pressure of that side. Otherwise the side that the force F loads
    has |F| / A, and the other none: the piston side where the column is pressed together, the rod side where
    it is pulled apart. A is the area of that side, all cylinders of the column together. A column of oil says
    it in its scenario.

    Arguments:
        column: name of an actuator; in space also of one of a pair, such as front_column_left.
        side: "piston", by default, or "rod".
        bore: diameter of a cylinder's bore [m]; None: as the scenario says.
        rod: diameter of its rod [m], less than the bore; for the rod side.
        cylinders: number of cylinders that the column stands for, 1 by default.
        rate, low_pass, noise [Pa], resolution [Pa]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "Pa"

    column: str
    side: Literal["piston", "rod"] = "piston"
    bore: Metres[Positive] | None = None
    rod: Metres[Positive] | None = None
    cylinders: Annotated[Whole, Field(ge=1)] = 1
    noise: Pascals[NonNegative] = 0.0
    resolution: Pascals[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """The pressure (n, 1) [Pa]."""
        scenario = result.scenario
        whole, _ = column_of(scenario, self.column)
        area, leg = self.area(scenario), scenario.legs.get(whole)
        plain = isinstance(leg, OilColumn) and (self.side == "rod" or not leg.elements)
        if leg is not None and not plain:
            name = f"{self.column}.{'pressure' if self.side == 'piston' else 'rod_pressure'}"
            return result.recorded(name, "a gauge shows it")[:, None]
        force = result.recorded(f"{self.column}.force", "a pressure gauge needs it")
        pressure: Series = np.maximum(force if self.side == "piston" else -force, 0.0) / area
        return pressure[:, None]

    def area(self, scenario: Scenario) -> float:
        """Area on which the oil of its side presses [m^2], all cylinders together.

        That of the gauge goes before that of the scenario. Raises InputError if neither says it.
        """
        if self.bore is not None and (self.side == "piston" or self.rod is not None):
            rod = self.rod if self.side == "rod" and self.rod is not None else 0.0
            if rod >= self.bore:
                raise InputError(
                    f"gauge on {self.column}: rod = {1e3 * rod:g} mm: allowed: less than the bore, "
                    f"{1e3 * self.bore:g} mm"
                )
            return self.cylinders * math.pi / 4.0 * (self.bore**2 - rod**2)
        whole, share = column_of(scenario, self.column)
        leg = scenario.legs.get(whole)
        if isinstance(leg, HydraulicCylinder):
            return share * (leg.bore_area if self.side == "piston" else leg.rod_side_area)
        if isinstance(leg, OilColumn) and self.side == "piston":
            return share * leg.bore_area
        needed = "bore_mm" if self.side == "piston" else "bore_mm and rod_mm"
        raise InputError(
            f"gauge on {self.column}: the area on which the oil presses is not known; "
            f"allowed: {needed} of the gauge, diameters, with the number of cylinders; or a scenario "
            "whose column is a HydraulicCylinder, or on the piston side an OilColumn"
        )


@value
class ExtensionSensor(Instrument):
    """A sensor of a column's extension: its length less that at which the sensor shows 0.

    Arguments:
        column: name of an actuator.
        zero_length: distance of its ends at which it shows 0 [m]; None: that in the machine's start posture.
        rate, low_pass, noise [m], resolution [m]: see `Instrument`.
    """

    UNIT: ClassVar[str] = "m"

    column: str
    zero_length: Metres[NonNegative] | None = None
    noise: Metres[NonNegative] = 0.0
    resolution: Metres[NonNegative] = 0.0

    def signals(self, result: Result) -> Series:
        """The extension (n, 1) [m]."""
        whole, _ = column_of(result.scenario, self.column)
        zero = self.zero_length
        if zero is None:
            scenario = result.scenario
            ends = scenario.space.actuators if scenario.dimensions == 3 else scenario.linkage.actuators
            parts = [self.column] if self.column in ends else list(scenario.space.parts_of_actuator(whole))
            zero = float(np.mean([ends[part].start_length for part in parts]))
        return (result.recorded(f"{self.column}.length", "a sensor of extension shows it") - zero)[:, None]


def column_of(scenario: Scenario, name: str) -> tuple[str, float]:
    """The actuator of the plane that a column is or is a part of, and its share of the piston area.

    Raises InputError if there is none of this name.
    """
    if name in scenario.linkage.actuators:
        return name, 1.0
    if scenario.dimensions == 3 and name in scenario.space.actuators:
        one = scenario.space.actuators[name]
        return one.actuator, one.share
    known = [*scenario.linkage.actuators, *(scenario.space.actuators if scenario.dimensions == 3 else ())]
    raise InputError(f"column = {name!r}: the machine has no such actuator; {meant(name, known)}")
