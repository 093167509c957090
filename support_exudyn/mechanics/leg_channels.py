"""Channels of hydraulic legs with elements, and of the pump that they share, by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from support_exudyn.mechanics.channels import OIL, ChannelDefinitions, named, table
from support_exudyn.mechanics.trajectory import LegSeries, Series
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg

PUMP = "pump"  # the name of the pump's channels


class LegValue(NamedTuple):
    """A number that is known of a leg at every instant: its name, unit and meaning."""

    name: str
    unit: str
    meaning: str


def leg_values(model: HydraulicLeg) -> Iterator[LegValue]:
    """What is known of a leg with the elements that it has."""
    yield LegValue("pressure", "Pa", "of the piston side")
    yield LegValue("flow", "m^3/s", "into the piston side, of inlet, line or drive")
    yield LegValue("oil", "m^3", "in all its chambers and its line, as volume without pressure")
    if isinstance(model, HydraulicCylinder):
        yield LegValue("rod_pressure", "Pa", "of the rod side")
        yield LegValue("opening", "1", "of the valve; positive: pump to the piston side")
        yield LegValue("rod_flow", "m^3/s", "into the rod side")
        yield LegValue("let_in", "m^3", "oil that inlets have let in so far, as volume without pressure")
        yield LegValue("viscous_loss", "J", "taken by the viscous damping of its seals so far")
        yield LegValue("valve_loss", "J", "taken by the inlet and the check valve so far")
        if model.rod_relief is not None:
            yield LegValue("relief_flow", "m^3/s", "out of the rod side by its relief valve")
            yield LegValue("relieved", "m^3", "oil that has left by it so far, as volume without pressure")
    if model.line is not None:
        yield LegValue("line_pressure", "Pa", "of the line")
        yield LegValue("line_loss", "J", "taken by the line so far")
    if model.yield_valve is not None:
        yield LegValue("yield_flow", "m^3/s", "out of the piston side by the yield valve")
        yield LegValue("yielded", "m^3", "oil that has left by it so far, as volume without pressure")
    if model.yield_valve is not None or getattr(model, "rod_relief", None) is not None:
        yield LegValue("yield_loss", "J", "taken by relief valves so far")
    if model.vapour_pressure is not None:
        yield LegValue("cavity", "m^3", "volume of vapour in all its chambers and its line")
        yield LegValue("cavity_energy", "J", "stored in it, which the atmosphere gives back as it is filled")
    if model.seal_friction is not None:
        yield LegValue("seal_loss", "J", "taken by the seals so far")
    if model.end_stops is not None or model.second_stage is not None:
        yield LegValue("stop_loss", "J", "taken by the stops so far")
    if model.second_stage is not None:
        yield LegValue("stage_pressure", "Pa", "inside the tube of both stages")
        yield LegValue("stage_extension", "m", "of the outer stage since the start")
        yield LegValue("stage_loss", "J", "taken by the foot valve and the tube's damping so far")


PUMP_VALUES = (
    LegValue("pressure", "Pa", "of the pump's line"),
    LegValue("flow", "m^3/s", "that the pump gives"),
    LegValue("given", "m^3", "oil that it has given so far, as volume without pressure"),
    LegValue("oil", "m^3", "in its line, as volume without pressure"),
)


def leg_channels(legs: Mapping[str, HydraulicLeg], pump: bool) -> ChannelDefinitions:
    """The channels of legs by name; pump: whether they share one."""
    known: dict[str, Iterable[LegValue]] = {name: leg_values(model) for name, model in legs.items()}
    known |= {PUMP: PUMP_VALUES} if pump and legs else {}
    found: ChannelDefinitions = {}
    for name, values in known.items():
        rows = [(one.name, one.unit, one.meaning, _value(one.name)) for one in values]
        found |= table(name, OIL, named("legs", name), rows)
    return found


def _value(name: str) -> Callable[[LegSeries], Series]:
    return lambda leg: leg.values[name]
