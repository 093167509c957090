"""From legs in their place, and the pump, to records."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.mechanics.hydraulic_legs import PreloadedLeg, StartPressures
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.hydraulics.elements import EndStops, PumpStation, SecondStage, TrappedAir
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg
from support_exudyn.scene.hydraulics.flows import SEAT
from support_exudyn.scene.hydraulics.gaps import ABSENT, MET_PRESSURE
from support_exudyn.scene.hydraulics.records import (
    GAPS,
    INTEGRALS,
    LEG,
    LET_IN,
    LINE_LOSS,
    LINEAR,
    LOG,
    PUMP,
    RELIEVED,
    SEAL_LOSS,
    STAGE_LOSS,
    STOP_LOSS,
    VALVE_LOSS,
    VISCOUS_LOSS,
    YIELD_LOSS,
    YIELDED,
    Records,
)

SMOOTH = 1e-3  # share of the nominal drop below which flow is laminar
SMALLEST_STRAIN = 1e-5  # of the oil, by which errors of legs are weighed that nothing presses
SMALLEST_SPEED = 1e-3  # [m/s], of the tube of two stages, by which errors are weighed


@dataclass(frozen=True)
class Legs:
    """Legs of a scene as records.

    records: one a leg, in the order of names. pumps: one, or none. gaps: of each leg, see `records`, with room.
    first, states: where their states begin, and how many they have. start: their values.
    """

    names: tuple[str, ...]
    records: Records
    pumps: Records
    gaps: Series
    first: int
    states: int
    start: Series


class _Leg:
    """A record that is being filled, and the places in y that are handed out for its states."""

    def __init__(self, record: Any, first: int) -> None:
        self.record, self.next = record, first
        for place in ("foot", "head", "course", "state", "rod", "stage", "line", "poppet"):
            record[place] = -1
        record["integrals"] = -1

    def take(self, number: int = 1) -> int:
        """The first of so many places for states."""
        self.next += number
        return self.next - number

    def integrate(self, *what: int) -> None:
        """Let these be integrated over time, if they are not yet."""
        for one in what:
            if self.record["integrals"][one] < 0:
                self.record["integrals"][one] = self.take()

    def put(self, **numbers: float) -> None:
        """Write numbers into the record, by their names."""
        for name, number in numbers.items():
            self.record[name] = number

    def fill(self, leg: PreloadedLeg) -> None:
        """Write all that is known of a leg before the run."""
        model, start = leg.model, leg.start_pressures
        cylinder = model if isinstance(model, HydraulicCylinder) else None
        law, hose = (LINEAR, 0.0) if cylinder is None else (LOG, cylinder.hose_volume)
        if cylinder or model.line or model.yield_valve or model.second_stage:
            self.record["state"] = self.take()  # oil that only a drive lets in needs no state
        volume, air = model.bore_area * model.oil_length + hose, model.trapped_air
        modulus = model.bulk_modulus
        self.put(law=law, driven=cylinder is None, length0=leg.actuator.start_length, modulus=modulus)
        self.put(vapour=-math.inf if model.vapour_pressure is None else model.vapour_pressure)
        self.put(bore=model.bore_area, oil_length=model.oil_length, hose=hose)
        self.put(oil0=oil_of(law, start.piston, volume, modulus, air), scale=volume / modulus)
        if air is not None:
            self.put(air=air.volume, air_exponent=air.exponent)
        if cylinder is not None:
            self._cylinder(cylinder, start.rod)
        if model.second_stage is not None:
            self._stage(model.second_stage, start.tube)
        if (line := model.line) is not None:
            self.integrate(LINE_LOSS)
            self.put(line=self.take(), line_volume=line.volume, line_resistance=line.resistance)
            self.put(
                line_oil0=oil_of(law, start.piston, line.volume, modulus), line_scale=line.volume / modulus
            )
        self._relief_valves(model, start)
        self._stops(model.end_stops, "")
        if (seals := model.seal_friction) is not None:
            self.integrate(SEAL_LOSS)
            self.put(coulomb=seals.coulomb, static=seals.static)
            self.put(stribeck=seals.stribeck_speed, transition=seals.transition_speed)

    def _cylinder(self, model: HydraulicCylinder, rod_pressure: float) -> None:
        volume = model.rod_side_area * model.rod_side_length + model.rod_side_hose_volume
        if (stage := model.second_stage) is not None:
            volume += stage.rod_side_area * stage.rod_side_length
        self.put(rod=self.take(), rod_area=model.rod_side_area, rod_length=model.rod_side_length)
        self.put(rod_hose=model.rod_side_hose_volume, rod_scale=volume / model.bulk_modulus)
        self.put(rod_oil0=oil_of(LOG, rod_pressure, volume, model.bulk_modulus))
        self.put(supply=model.system_pressure, tank=model.tank_pressure, damping=model.damping)
        self.put(flow_factor=model.nominal_flow / math.sqrt(model.nominal_drop))
        self.put(smooth=SMOOTH * model.nominal_drop)
        if (check := model.check_valve) is not None:
            self.put(check=1, pilot_ratio=check.pilot_ratio, pilot_range=check.pilot_range)
            self.put(cracking=check.cracking_pressure)
        self.integrate(LET_IN, VALVE_LOSS, VISCOUS_LOSS)

    def _stage(self, stage: SecondStage, pressure: float) -> None:
        law, modulus = int(self.record["law"]), float(self.record["modulus"])
        volume = stage.bore_area * stage.oil_length
        self.put(stage=self.take(3), bore2=stage.bore_area, oil_length2=stage.oil_length)
        self.put(rod_area2=stage.rod_side_area, rod_length2=stage.rod_side_length)
        self.put(oil02=oil_of(law, pressure, volume, modulus), scale2=volume / modulus)
        self.put(tube_mass=stage.tube_mass, tube_damping=stage.damping, release=stage.release)
        self.put(foot_factor=stage.nominal_flow / math.sqrt(stage.nominal_drop))
        self.put(foot_smooth=SMOOTH * stage.nominal_drop)
        self._stops(stage.stops, "2")
        self.integrate(STAGE_LOSS)

    def _relief_valves(self, model: HydraulicLeg, start: StartPressures) -> None:
        if (valve := model.yield_valve) is not None:
            self.put(opens=valve.opening_pressure, closes=valve.closes_at, slope=valve.slope)
            self.put(jumps=valve.closes_at < valve.opening_pressure)
            self.put(open=start.piston > valve.opening_pressure + MET_PRESSURE)
            if (poppet := valve.poppet) is not None:
                self.put(poppet=self.take(2), poppet_rate=poppet.frequency, poppet_decay=poppet.decay)
            self.integrate(YIELDED, YIELD_LOSS)
        if isinstance(model, HydraulicCylinder) and (valve := model.rod_relief) is not None:
            self.put(rod_opens=valve.opening_pressure, rod_closes=valve.closes_at, rod_slope=valve.slope)
            self.put(rod_jumps=valve.closes_at < valve.opening_pressure)
            self.put(rod_open=start.rod > valve.opening_pressure + MET_PRESSURE)
            self.integrate(RELIEVED, YIELD_LOSS)

    def _stops(self, stops: EndStops | None, stage: str) -> None:
        lowest, highest = (-math.inf, math.inf) if stops is None else (stops.lowest, stops.highest)
        self.put(**{f"lowest{stage}": lowest, f"highest{stage}": highest})
        if stops is not None:
            self.put(**{f"stop{stage}": stops.stiffness, f"stop_damping{stage}": stops.damping})
            self.integrate(STOP_LOSS)


def fill_legs(legs: Sequence[PreloadedLeg], pump: PumpStation | None, first: int) -> Legs:
    """Records of legs whose states begin at a place of y."""
    records, place = np.zeros(len(legs), LEG), first
    for record, leg in zip(records, legs, strict=True):
        filling = _Leg(record, place)
        filling.fill(leg)
        place = filling.next
    pumps = np.zeros(int(pump is not None and bool(legs)), PUMP)
    for record in pumps:
        assert pump is not None  # there is a record for one
        record["state"] = place
        place += 2
        record["flow"], record["pressure"], record["range"] = pump.flow, pump.pressure, pump.pressure_range
        record["volume"], record["modulus"] = pump.line_volume, pump.bulk_modulus
        record["scale"] = pump.line_volume / pump.bulk_modulus
        record["oil0"] = pump.line_volume + pump.pressure * record["scale"]
    start = np.zeros(place - first)
    for record, leg in zip(records, legs, strict=True):
        if record["poppet"] >= 0:  # it rests on its seat, or on its spring
            above = leg.start_pressures.piston - record["opens"]
            start[record["poppet"] - first] = above if above > 0.0 else above / SEAT
    gaps = np.full((len(legs), GAPS), ABSENT)
    return Legs(tuple(leg.name for leg in legs), records, pumps, gaps, first, start.size, start)


def oil_of(law: int, pressure: float, volume: float, modulus: float, air: TrappedAir | None = None) -> float:
    """Oil [m^3], as volume without pressure, that has a pressure [Pa] in a volume [m^3], with air if any."""
    of_air = 0.0 if air is None else air.at(pressure)
    if law == LOG:
        return (volume - of_air) * math.exp(pressure / modulus)
    return volume * (1.0 + pressure / modulus) - of_air


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
        for n in range(INTEGRALS):
            if (at := int(leg["integrals"][n])) >= 0:
                of_oil = n in (YIELDED, RELIEVED, LET_IN)
                weights[at] = 1.0 / (float(leg["scale"]) * size if of_oil else energy)
    for pump in legs.pumps:
        weights[pump["state"]] = 1.0 / float(pump["pressure"])
        weights[pump["state"] + 1] = 1.0 / (float(pump["scale"]) * float(pump["pressure"]))
