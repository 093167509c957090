"""Channels of hydraulic legs with elements, and of the pump that they share, by name."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from support_exudyn.mechanics.channels import OIL, ChannelDefinitions, named, table
from support_exudyn.mechanics.trajectory import LegSeries, Series
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg
from support_exudyn.model.hydraulics.valves import LegChannel

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
