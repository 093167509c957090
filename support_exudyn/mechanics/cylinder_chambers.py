"""Hydraulic cylinders in their place: what they carry at the start, their pressures, energy and power."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.oil_column import static_loads
from support_exudyn.mechanics.trajectory import CylinderSeries, Series
from support_exudyn.model.actuators import Quantity
from support_exudyn.model.hydraulic_cylinder import HydraulicCylinder
from support_exudyn.model.linkage import LinearActuator, Linkage
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class PreloadedCylinder:
    """A cylinder in its place.

    actuator: that it is. model: of it. load: that it carries at the start, pushing its ends apart [N].
    """

    actuator: LinearActuator
    model: HydraulicCylinder
    load: float

    @property
    def start_pressures(self) -> tuple[float, float]:
        """Pressures of piston side and rod side [Pa] before the valve opens: one of them is the tank's."""
        model, tank = self.model, self.model.tank_pressure
        if self.load >= model.force(tank, tank, 0.0):
            return (self.load + tank * model.rod_side_area) / model.bore_area, tank
        return tank, (tank * model.bore_area - self.load) / model.rod_side_area

    def closed_pressures(self, length: float) -> tuple[float, float]:
        """Pressures [Pa] at another length [m], no oil having flowed since the start."""
        before = self.model.volumes(0.0)
        after = self.model.volumes(length - self.actuator.start_length)
        piston, rod = (
            pressure + self.model.bulk_modulus * math.log(one / other)
            for pressure, one, other in zip(self.start_pressures, before, after, strict=True)
        )
        return piston, rod

    def pressure_rates(
        self, length: float, rate: float, pressures: tuple[float, float], opening: float
    ) -> tuple[float, float]:
        """Rates of the pressures in both chambers [Pa/s]."""
        model = self.model
        volumes = model.volumes(length - self.actuator.start_length)
        flow, rod_flow = model.flows(*pressures, opening)
        return (
            float(model.bulk_modulus / volumes[0] * (flow - model.bore_area * rate)),
            float(model.bulk_modulus / volumes[1] * (rod_flow + model.rod_side_area * rate)),
        )

    def energy(self, length: Quantity, pressure: Quantity, rod_pressure: Quantity) -> Quantity:
        """Energy stored in the oil of both chambers [J]."""
        piston, rod = self.model.volumes(length - self.actuator.start_length)
        density = self.model.energy_density
        return piston * density(pressure) + rod * density(rod_pressure)

    def powers(self, rate: float, pressures: tuple[float, float], opening: float) -> tuple[float, float]:
        """Power of pump and tank, and what valve and seals dissipate [W].

            supply = sum Q (ps + u),   loss = sum Q (ps - p) + d v^2

        ps is the pressure that a chamber is connected to, u the energy density of its oil: oil that flows in
        brings what has been stored in it, oil that flows out takes it along.
        """
        model = self.model
        supply, loss = 0.0, model.damping * rate * rate
        if opening == 0.0:
            return supply, loss
        both = zip(model.flows(*pressures, opening), model.supplies(opening), pressures, strict=True)
        for flow, connected, pressure in both:
            supply += float(flow * (connected + model.energy_density(pressure)))
            loss += float(flow * (connected - pressure))
        return supply, loss

    def series(self, motion: BodyMotion, pressures: Series, opening: Series) -> CylinderSeries:
        """The actuator over time, with these pressures (n, 2) [Pa] and openings (n,)."""
        length, rate = motion.lengthening(self.actuator)
        model, (piston, rod) = self.model, pressures.T
        return CylinderSeries(
            model.force(piston, rod, rate),
            self.energy(length, piston, rod),
            piston,
            rod,
            opening,
            *model.flows(piston, rod, opening),
        )


def fill_cylinders(
    linkage: Linkage, models: Mapping[str, HydraulicCylinder], gravity: Vector2
) -> dict[str, PreloadedCylinder]:
    """Cylinders that hold the machine in its start posture, all pins ideal and the other actuators rigid."""
    if not models:
        return {}
    loads = static_loads(linkage, gravity)
    return {
        name: PreloadedCylinder(linkage.actuators[name], model, loads[name]) for name, model in models.items()
    }
