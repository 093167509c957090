"""Hydraulic legs in their place: what they carry, and with what pressures they start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.model.hydraulics.elements import ATMOSPHERE
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg
from support_exudyn.model.linkage import LinearActuator, Linkage
from support_exudyn.model.spatial_linkage import SpatialActuator
from user_forces.values.value import InputError, Vector2

SIDES = {"piston": "piston side", "rod": "rod side"}


@dataclass(frozen=True)
class PreloadedLeg:
    """A leg in its place.

    name, actuator: which it is. model: of it. load: that it carries at the start, pushing its ends apart, if
    no setting pressure is asked for [N].
    """

    name: str
    actuator: LinearActuator | SpatialActuator
    model: HydraulicLeg
    load: float

    @property
    def pressures(self) -> dict[str, float]:
        """Pressures [Pa] of all rooms at the start, that carry the load, or those of setting.

        The room that a valve brings has the pressure of the room behind or before the valve. Raises InputError
        if no pressures can carry the load.
        """
        model = self.model
        tank = model.sources["tank"]
        rod_area = model.rod_side_area if isinstance(model, HydraulicCylinder) else 0.0
        piston, rod = model.setting_pressure or 0.0, tank
        if model.setting_pressure is None:
            piston = (self.load + tank * rod_area) / model.bore_area
            if piston < tank and rod_area > 0.0:
                piston, rod = tank, (tank * model.bore_area - self.load) / rod_area
        found = {"piston": piston, "rod": rod}
        if (stage := model.second_stage) is not None:
            pushes = model.bore_area * piston - rod_area * rod
            found["tube"] = (pushes + stage.rod_side_area * rod) / stage.bore_area
        found = {name: found[name] for name in model.rooms if name in found}
        known = found | model.sources
        for name, path in model.paths.items():
            if name in model.rooms:
                found[name] = known[path.after if path.before == name else path.before]
        lowest, air, least = model.vapour_pressure, model.trapped_air, min(found, key=found.__getitem__)
        if lowest is not None and found[least] < lowest:  # oil would boil
            raise InputError(
                f"actuators.{self.name}.vapour_pressure = {lowest} Pa: in the start posture the leg pushes "
                f"with {self.load:.4g} N, for which its {SIDES.get(least, least)} would have "
                f"{found[least]:.4g} Pa; allowed: less than that, or a setting_pressure with a load that "
                "balances it"
            )
        room = model.rooms["piston"].volume
        if air is not None and (piston <= -ATMOSPHERE or not air.at(piston) < room):
            raise InputError(
                f"actuators.{self.name}.trapped_air.volume = {air.volume} m^3: at the {piston:.4g} Pa of the "
                f"start no room for oil is left in {room:.4g} m^3; allowed: less air, or a leg that is pressed"
            )
        return found


def static_loads(linkage: Linkage, gravity: Vector2) -> dict[str, float]:
    """What every actuator carries in the start posture, all pins ideal [N]; positive pushes its ends apart."""
    closed = kinetics_of(linkage)
    weight = closed.weight(gravity)
    tensions = closed.respond(np.zeros(weight.size), weight, 0.0)[1][closed.driven()]
    return {name: -float(tension) for name, tension in zip(linkage.actuators, tensions, strict=False)}


def preloaded_legs(
    linkage: Linkage, models: Mapping[str, HydraulicLeg], gravity: Vector2
) -> dict[str, PreloadedLeg]:
    """Legs that hold the machine in its start posture, all pins ideal and the other actuators rigid."""
    if not models:
        return {}
    loads = static_loads(linkage, gravity)
    return {
        name: PreloadedLeg(name, linkage.actuators[name], model, loads[name]) for name, model in models.items()
    }
