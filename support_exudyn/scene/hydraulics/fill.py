"""From legs in their place, and the pump, to records."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.actuators import OilColumn
from support_exudyn.model.hydraulic_cylinder import HydraulicCylinder
from support_exudyn.model.hydraulics.leg import HydraulicLeg
from support_exudyn.model.hydraulics.lines import PumpStation
from support_exudyn.model.hydraulics.motion import EndStops
from support_exudyn.model.hydraulics.oil import TrappedAir
from support_exudyn.scene.hydraulics.gaps import ABSENT, MET_PRESSURE
from support_exudyn.scene.hydraulics.leg import SEAT
from support_exudyn.scene.hydraulics.records import BOOKED, GAPS, LEG, LINEAR, LOG, PUMP, Records

SMOOTH = 1e-3  # share of the nominal drop below which flow is laminar
SMALLEST_STRAIN = 1e-5  # of the oil, by which errors of legs are weighed that nothing presses
SMALLEST_SPEED = 1e-3  # [m/s], of the tube of two stages, by which errors are weighed


@dataclass(frozen=True)
class Legs:
    """Legs of a scene as records.

    records: one a leg, in the order of names. pumps: one, or none. gaps: of each leg, see `records`, with room.
    states: how many states they have, which begin at the first place that was free. start: their values.
    """

    names: tuple[str, ...]
    records: Records
    pumps: Records
    gaps: Series
    states: int
    start: Series


class _States:
    """Places in y that are handed out."""

    def __init__(self, first: int) -> None:
        self.next = first

    def take(self, number: int = 1) -> int:
        first = self.next
        self.next += number
        return first


def fill_legs(legs: Sequence[PreloadedLeg], pump: PumpStation | None, first: int) -> Legs:
    """Records of legs whose states begin at a place of y."""
    records = np.zeros(len(legs), LEG)
    states = _States(first)
    for record, leg in zip(records, legs, strict=True):
        _leg(record, leg, states)
    pumps = np.zeros(int(pump is not None and bool(legs)), PUMP)
    for record in pumps:
        assert pump is not None  # there is a record for one
        record["state"] = states.take(2)
        record["flow"], record["pressure"], record["range"] = pump.flow, pump.pressure, pump.pressure_range
        record["volume"], record["modulus"] = pump.line_volume, pump.bulk_modulus
        record["scale"] = pump.line_volume / pump.bulk_modulus
        record["oil0"] = pump.line_volume + pump.pressure * record["scale"]
    start = np.zeros(states.next - first)
    for record, leg in zip(records, legs, strict=True):
        if record["poppet"] >= 0:  # it rests on its seat, or on its spring
            above = leg.start_pressures.piston - record["opens"]
            start[record["poppet"] - first] = above if above > 0.0 else above / SEAT
    gaps = np.full((len(legs), GAPS), ABSENT)
    return Legs(tuple(leg.name for leg in legs), records, pumps, gaps, start.size, start)


def empty_legs(names: Sequence[str], records: Records) -> str:
    """Which leg of records as they stand has no room, or no oil, left in a chamber; empty if none."""
    for name, leg in zip(names, records, strict=True):
        if not leg["volume"] > 0.0 or (leg["stage"] >= 0 and not leg["volume2"] > 0.0):
            return f"{name} is drawn in until no room is left under its piston"
        if leg["rod"] >= 0 and not leg["rod_volume"] > 0.0:
            return f"{name} is extended until no room is left around its rod"
        if not leg["oil"] > 0.0 or (leg["stage"] >= 0 and not leg["oil2"] > 0.0):
            return f"{name} has lost all its oil"
        if leg["line"] >= 0 and not leg["line_oil"] > 0.0:
            return f"more oil is drawn out of the line of {name} than it holds"
    return ""


def _leg(record: Any, leg: PreloadedLeg, states: _States) -> None:
    model, start = leg.model, leg.start_pressures
    for place in ("foot", "head", "course", "rod", "stage", "line", "poppet"):
        record[place] = -1
    record["state"] = states.take()
    record["length0"] = leg.actuator.start_length
    record["vapour"] = -math.inf if model.vapour_pressure is None else model.vapour_pressure
    assert isinstance(model, OilColumn | HydraulicCylinder)  # PreloadedLeg has looked
    record["bore"], record["oil_length"], record["modulus"] = (
        model.bore_area,
        model.oil_length,
        model.bulk_modulus,
    )
    record["law"] = LOG if isinstance(model, HydraulicCylinder) else LINEAR
    record["hose"] = model.hose_volume if isinstance(model, HydraulicCylinder) else 0.0
    if model.trapped_air is not None:
        record["air"], record["air_exponent"] = model.trapped_air.volume, model.trapped_air.exponent
    law, modulus = int(record["law"]), model.bulk_modulus
    volume = model.bore_area * model.oil_length + float(record["hose"])
    record["oil0"] = oil_of(law, start.piston, volume, modulus, model.trapped_air)
    record["scale"] = volume / modulus
    if isinstance(model, HydraulicCylinder):
        _cylinder(record, model, start.rod, states)
    else:
        record["driven"] = 1
    _stage(record, model, start.tube, states)
    if model.line is not None:
        room = model.line.volume
        record["line"] = states.take()
        record["line_volume"], record["line_resistance"] = room, model.line.resistance
        record["line_oil0"] = oil_of(law, start.piston, room, modulus, None)
        record["line_scale"] = room / modulus
    _relief_valves(record, model, start.piston, start.rod, states)
    _stops(record, model.end_stops, "")
    if (seals := model.seal_friction) is not None:
        record["coulomb"], record["static"] = seals.coulomb, seals.static
        record["stribeck"], record["transition"] = seals.stribeck_speed, seals.transition_speed
    record["booked"] = states.take(BOOKED)


def oil_of(law: int, pressure: float, volume: float, modulus: float, air: TrappedAir | None) -> float:
    """Oil [m^3], as its volume without pressure, that has a pressure [Pa] in a volume [m^3] with air."""
    if air is not None:
        volume_of_air = air.at(pressure)
        if law == LOG:
            return (volume - volume_of_air) * math.exp(pressure / modulus)
        return volume * (1.0 + pressure / modulus) - volume_of_air
    return volume * (math.exp(pressure / modulus) if law == LOG else 1.0 + pressure / modulus)


def _cylinder(record: Any, model: HydraulicCylinder, rod_pressure: float, states: _States) -> None:
    record["rod"] = states.take()
    record["rod_area"], record["rod_length"] = model.rod_side_area, model.rod_side_length
    record["rod_hose"] = model.rod_side_hose_volume
    volume = model.rod_side_area * model.rod_side_length + model.rod_side_hose_volume
    if (stage := model.second_stage) is not None:
        volume += stage.rod_side_area * stage.rod_side_length
    record["rod_oil0"] = oil_of(LOG, rod_pressure, volume, model.bulk_modulus, None)
    record["rod_scale"] = volume / model.bulk_modulus
    record["supply"], record["tank"] = model.system_pressure, model.tank_pressure
    record["flow_factor"], record["smooth"] = model.flow_factor, SMOOTH * model.nominal_drop
    record["damping"] = model.damping
    if (check := model.check_valve) is not None:
        record["check"] = 1
        record["pilot_ratio"], record["pilot_range"] = check.pilot_ratio, check.pilot_range
        record["cracking"] = check.cracking_pressure


def _stage(record: Any, model: HydraulicLeg, pressure: float, states: _States) -> None:
    if (stage := model.second_stage) is None:
        return
    record["stage"] = states.take(3)
    record["bore2"], record["oil_length2"] = stage.bore_area, stage.oil_length
    record["rod_area2"], record["rod_length2"] = stage.rod_side_area, stage.rod_side_length
    volume = stage.bore_area * stage.oil_length
    record["oil02"] = oil_of(int(record["law"]), pressure, volume, float(record["modulus"]), None)
    record["scale2"] = volume / record["modulus"]
    record["tube_mass"], record["tube_damping"] = stage.tube_mass, stage.damping
    record["foot_factor"] = stage.nominal_flow / math.sqrt(stage.nominal_drop)
    record["foot_smooth"], record["release"] = SMOOTH * stage.nominal_drop, stage.release
    _stops(record, stage.stops, "2")


def _relief_valves(record: Any, model: HydraulicLeg, piston: float, rod: float, states: _States) -> None:
    if (valve := model.yield_valve) is not None:
        record["opens"], record["closes"], record["slope"] = (
            valve.opening_pressure,
            valve.closes_at,
            valve.slope,
        )
        record["jumps"] = valve.closes_at < valve.opening_pressure
        record["open"] = float(piston > valve.opening_pressure + MET_PRESSURE)
        if (poppet := valve.poppet) is not None:
            record["poppet"] = states.take(2)
            record["poppet_rate"], record["poppet_decay"] = poppet.frequency, poppet.decay
    if isinstance(model, HydraulicCylinder) and (valve := model.rod_relief) is not None:
        record["rod_opens"], record["rod_closes"] = valve.opening_pressure, valve.closes_at
        record["rod_slope"], record["rod_jumps"] = valve.slope, valve.closes_at < valve.opening_pressure
        record["rod_open"] = float(rod > valve.opening_pressure + MET_PRESSURE)


def _stops(record: Any, stops: EndStops | None, stage: str) -> None:
    if stops is None:
        record[f"lowest{stage}"], record[f"highest{stage}"] = -math.inf, math.inf
        return
    record[f"lowest{stage}"], record[f"highest{stage}"] = stops.lowest, stops.highest
    record[f"stop{stage}"], record[f"stop_damping{stage}"] = stops.stiffness, stops.damping


def weigh_states(legs: Legs, weights: Series, pressure: float, energy: float, play: float) -> None:
    """Write one over what each state of legs is of, into `weights`.

    Arguments:
        pressure: that carries the machine [Pa], of legs with less than that of their supply or valves.
        energy: of losses [J]. play: of lengths [m].
    """
    for leg in legs.records:
        size = max(pressure, float(leg["supply"]), float(leg["opens"]), SMALLEST_STRAIN * float(leg["modulus"]))
        speed = max(math.sqrt(play * 10.0), SMALLEST_SPEED)
        for place in ("state", "rod", "line", "stage"):
            if leg[place] >= 0:
                weights[leg[place]] = 1.0 / size
        if leg["stage"] >= 0:
            weights[leg["stage"] + 1], weights[leg["stage"] + 2] = 1.0 / play, 1.0 / speed
        if leg["poppet"] >= 0:
            weights[leg["poppet"]] = 1.0 / size
            weights[leg["poppet"] + 1] = 1.0 / (size * leg["poppet_rate"])
        first = int(leg["booked"])
        weights[first : first + BOOKED] = 1.0 / energy
        for n in range(BOOKED - 3, BOOKED):
            weights[first + n] = 1.0 / (float(leg["scale"]) * size)
    for pump in legs.pumps:
        weights[pump["state"]] = 1.0 / float(pump["pressure"])
        weights[pump["state"] + 1] = 1.0 / (float(pump["scale"]) * float(pump["pressure"]))
