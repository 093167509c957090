"""Hydraulic legs in their place: what they carry, with what pressures they start, and their channels."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from support_exudyn.mechanics.channels import OIL, ChannelDefinitions, named, table
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.trajectory import LegSeries, Series
from support_exudyn.model.hydraulics.elements import ATMOSPHERE
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg
from support_exudyn.model.hydraulics.valves import LegChannel
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


# --- channels ---


PUMP = "pump"  # the name of the pump's channels
# channels of pressures by the names of rooms; of a room that a valve brings it is "VALVE.pressure"
PRESSURES = {"piston": "pressure", "rod": "rod_pressure", "line": "line_pressure", "tube": "stage_pressure"}
CHANNELS = {
    "pressure": LegChannel("Pa", "of the piston side"),
    "flow": LegChannel("m^3/s", "into the piston side, of inlet, line or drive"),
    "oil": LegChannel("m^3", "in all its chambers and its line, as volume without pressure"),
    "rod_pressure": LegChannel("Pa", "of the rod side"),
    "opening": LegChannel("1", "of the valve; positive: pump to the piston side"),
    "rod_flow": LegChannel("m^3/s", "into the rod side"),
    "let_in": LegChannel("m^3", "oil that inlets have let in so far, as volume without pressure"),
    "viscous_loss": LegChannel("J", "taken by the viscous damping of its seals so far"),
    "valve_loss": LegChannel("J", "taken by the inlet and the check valve so far"),
    "relief_flow": LegChannel("m^3/s", "out of the rod side by its relief valve"),
    "relieved": LegChannel("m^3", "oil that has left by it so far, as volume without pressure"),
    "line_pressure": LegChannel("Pa", "of the line"),
    "line_loss": LegChannel("J", "taken by the line so far"),
    "yield_flow": LegChannel("m^3/s", "out of the piston side by the yield valve"),
    "yielded": LegChannel("m^3", "oil that has left by it so far, as volume without pressure"),
    "yield_loss": LegChannel("J", "taken by relief valves so far"),
    "cavity": LegChannel("m^3", "volume of vapour in all its chambers and its line"),
    "cavity_energy": LegChannel("J", "stored in it, which the atmosphere gives back as it is filled"),
    "seal_loss": LegChannel("J", "taken by the seals so far"),
    "stop_loss": LegChannel("J", "taken by the stops so far"),
    "stage_pressure": LegChannel("Pa", "inside the tube of both stages"),
    "stage_extension": LegChannel("m", "of the outer stage since the start"),
    "stage_loss": LegChannel("J", "taken by the foot valve and the tube's damping so far"),
}
PUMP_CHANNELS = {
    "pressure": LegChannel("Pa", "of the pump's line"),
    "flow": LegChannel("m^3/s", "that the pump gives"),
    "given": LegChannel("m^3", "oil that it has given so far, as volume without pressure"),
    "oil": LegChannel("m^3", "in its line, as volume without pressure"),
}


def _channels_of(model: HydraulicLeg) -> dict[str, LegChannel]:
    """What is recorded of a leg with the elements that it has, by name."""
    stops = model.end_stops is not None or model.second_stage is not None
    optional = (
        (isinstance(model, HydraulicCylinder), ("opening", "viscous_loss")),
        (model.vapour_pressure is not None, ("cavity", "cavity_energy")),
        (model.seal_friction is not None, ("seal_loss",)),
        (stops, ("stop_loss",)),
        (model.second_stage is not None, ("stage_extension",)),
    )
    names = {"pressure", "flow", "oil", *(PRESSURES.get(room, "") for room in model.rooms)}
    names |= {name for path in model.paths.values() for name in (path.flow, path.passed, path.loss)}
    names |= {name for there, some in optional if there for name in some}
    found = {name: channel for name, channel in CHANNELS.items() if name in names}
    for name, valve in model.valves.items():
        path = valve.path(name)
        found[path.flow] = LegChannel("m^3/s", f"from {path.before} to {path.after}")
        found[path.passed] = LegChannel("m^3", "oil that has passed so far, as volume without pressure")
        found[path.loss] = LegChannel("J", "taken by it so far")
        found |= path.states
        if valve.room is not None:
            found[f"{name}.pressure"] = LegChannel("Pa", "of its room")
    return found


def leg_channels(legs: Mapping[str, HydraulicLeg], pump: bool) -> ChannelDefinitions:
    """The channels of legs by name; pump: whether they share one."""
    known = {name: _channels_of(model) for name, model in legs.items()}
    known |= {PUMP: PUMP_CHANNELS} if pump and legs else {}
    found: ChannelDefinitions = {}
    for name, channels in known.items():
        rows = [(one, *channel, _value(one)) for one, channel in channels.items()]
        found |= table(name, OIL, named("legs", name), rows)
    return found


def _value(name: str) -> Callable[[LegSeries], Series]:
    return lambda leg: leg.values[name]
