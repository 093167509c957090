"""From legs in their place, and the pump, to records."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from support_exudyn.mechanics.hydraulic_legs import SIDES, PreloadedLeg
from support_exudyn.model.hydraulics.elements import EndStops, PumpStation, TrappedAir
from support_exudyn.model.hydraulics.leg import HydraulicCylinder, HydraulicLeg
from support_exudyn.model.hydraulics.valves import Path, Room
from support_exudyn.scene.compilation import NUMBERS, UncompiledLawError, action_law, address_of
from support_exudyn.scene.hydraulics.records import (
    CHAMBER,
    CONSTANT,
    GAP,
    LEG,
    LINEAR,
    LOG,
    PUMP,
    STATES,
    STOPS,
    VALVE,
    LegArrays,
    Records,
    Vector,
)
from user_forces.values.value import InputError

SMALLEST_STRAIN = 1e-5  # of the oil, by which errors of legs are weighed that nothing presses
SMALLEST_SPEED = 1e-3  # [m/s], of the tube of two stages, by which errors are weighed
MET_PRESSURE, MET_LENGTH = 0.01, 1e-13  # [Pa], [m] from zero at which a gap is met
FILLED = {"piston": "piston side filled", "rod": "rod side filled"}  # while the gap of a chamber is positive
STOPPED = (
    "lower stop met",
    "upper stop met",
    "lower stop of the tube met",
    "upper stop of the tube met",
)

Row = dict[str, Any]  # numbers of a record by name


class LegPlaces(NamedTuple):
    """Where a leg stands: its chambers and valves among the records, by name, and integrals among the states.

    oil, losses: places of integrals of oil and of energy, by the names of channels.
    """

    model: HydraulicLeg
    chambers: Mapping[str, int]
    valves: Mapping[str, int]
    oil: Mapping[str, int]
    losses: Mapping[str, int]


@dataclass(frozen=True)
class Legs:
    """Legs of a scene as records.

    arrays: the records. places: of each leg, in the order of names. gaps: what begins where each gap becomes
    positive. first, states: where their states begin, and how many they have. start: their values.
    """

    names: tuple[str, ...]
    arrays: LegArrays
    places: tuple[LegPlaces, ...]
    gaps: tuple[str, ...]
    first: int
    states: int
    start: Vector

    @property
    def records(self) -> Records:
        """One record a leg, in the order of names."""
        return self.arrays.records


class _Filling:
    """Records as rows of numbers by name, and the places in y that are handed out for states."""

    def __init__(self, first: int, most_states: int) -> None:
        self.next = first
        self.legs: list[Row] = []
        self.chambers: list[Row] = []  # rows of chambers and valves say their leg, and the event of their gap
        self.valves: list[Row] = []
        self.pumps: list[Row] = []
        self.places: list[LegPlaces] = []
        self.oil: dict[str, int] = {}  # of the leg that is being filled
        self.losses: dict[str, int] = {}
        self.numbers = [0.0] * (STATES + 2 * most_states)
        self.start: dict[int, float] = {}

    def take(self, number: int = 1) -> int:
        """The first of so many places for states."""
        self.next += number
        return self.next - number

    def integral(self, known: dict[str, int], name: str) -> int:
        """The place of an integral of oil or losses; -1 without a name."""
        if name and name not in known:
            known[name] = self.take()
        return known.get(name, -1)

    def loss(self, name: str) -> int:
        """The place of an integral of a loss."""
        return self.integral(self.losses, name)

    def source(self, pressure: float) -> int:
        """A chamber of constant pressure [Pa]."""
        self.chambers.append({"law": CONSTANT, "source": 1, "pressure": pressure, "weight": 1.0})
        return len(self.chambers) - 1

    def pump(self, pump: PumpStation) -> None:
        """The pump, and its line, which is the first chamber."""
        volume, scale = pump.line_volume, pump.line_volume / pump.bulk_modulus
        line = {"law": LINEAR, "source": 1, "weight": 1.0, "state": self.take(), "scale": scale}
        line |= {
            "modulus": pump.bulk_modulus,
            "oil0": volume + pump.pressure * scale,
            "pressure": pump.pressure,
        }
        line |= dict.fromkeys(("room", "volume", "reference", "span"), volume)
        self.chambers.append(line)
        given = {"flow": pump.flow, "pressure": pump.pressure, "range": pump.pressure_range}
        self.pumps.append({"chamber": 0, "given": self.take(), **given})

    def leg(self, leg: PreloadedLeg) -> None:
        """All that is known of a leg before the run."""
        model, first, chamber, valve = leg.model, self.next, len(self.chambers), len(self.valves)
        self.oil, self.losses = {}, {}
        pressures = leg.pressures | model.sources
        places = {name: self.source(pressure) for name, pressure in model.sources.items()}
        if self.pumps:
            places["supply"] = 0
        paths = model.paths
        touched = {end for path in paths.values() for end in (path.before, path.after)}
        for name, room in model.rooms.items():
            places[name] = self._room(model, name, room, pressures[name], name in touched)
        valves = {
            name: self._valve(
                f"actuators.{leg.name}.valves.{name}",
                path,
                places,
                pressures[path.before],
                pressures[path.after],
            )
            for name, path in paths.items()
        }
        damping = model.damping if isinstance(model, HydraulicCylinder) else 0.0
        record: Row = {
            "driven": not isinstance(model, HydraulicCylinder), "bore": model.bore_area,
            "length0": leg.actuator.start_length, "damping": damping,
            "tank": places["tank"], "supply": places.get("supply", places["tank"]),
        }  # fmt: skip
        if isinstance(model, HydraulicCylinder):
            record["viscous_loss"] = self.loss("viscous_loss")
        if (seals := model.seal_friction) is not None:
            record |= {"coulomb": seals.coulomb, "static": seals.static, "stribeck": seals.stribeck_speed}
            record |= {"transition": seals.transition_speed, "seal_loss": self.loss("seal_loss")}
        stage = model.second_stage
        if stage is not None:
            record |= {"stage": self.take(2), "tube_mass": stage.tube_mass, "tube_damping": stage.damping}
            record["stage_loss"] = self.loss("stage_loss")
        stops = model.end_stops, None if stage is None else stage.stops
        if any(stops):
            record |= {"stop_loss": self.loss("stop_loss"), **_stops(stops)}
        record |= {"chamber": chamber, "chambers": len(self.chambers) - chamber}
        record |= {"valve": valve, "valves": len(self.valves) - valve}
        self.legs.append({**record, "first": first, "states": self.next - first})
        rooms = {name: places[name] for name in model.rooms}
        self.places.append(LegPlaces(model, rooms, valves, self.oil, self.losses))

    def _room(self, model: HydraulicLeg, name: str, room: Room, pressure: float, has_state: bool) -> int:
        """A chamber, by its pressure at the start [Pa]; oil that only a drive lets in needs no state."""
        driven, modulus, volume = not isinstance(model, HydraulicCylinder), model.bulk_modulus, room.volume
        law = LINEAR if driven else LOG
        chamber: Row = {
            "leg": len(self.legs), "event": FILLED.get(name, f"{name} filled"),
            "law": law, "source": 0, "weight": 1.0, "modulus": modulus, "room": volume, "reference": volume,
            "vapour": -math.inf if model.vapour_pressure is None else model.vapour_pressure,
            "by_travel": room.by_travel, "by_length": room.by_length,
            "oil0": oil_of(law, pressure, volume, modulus, room.air), "scale": volume / modulus,
        }  # fmt: skip
        if room.air is not None:
            chamber |= {"air": room.air.volume, "air_exponent": room.air.exponent}
        if driven:
            chamber["grown"] = model.bore_area if name == "piston" else 0.0
            chamber["fed"] = model.bore_area if name == ("line" if model.line else "piston") else 0.0
        if has_state:
            chamber["state"] = self.take()
        self.chambers.append(chamber)
        return len(self.chambers) - 1

    def _valve(self, where: str, path: Path, places: Mapping[str, int], before: float, after: float) -> int:
        """A valve; where: its path; before, after: pressures at the start [Pa]."""
        states = len(path.states)
        still = path.formula(before, after, 0.0, 0.0, 0.0, 0.0, *(0.0,) * states)
        try:
            count = len(path.formula.parameters)
            law = address_of(action_law(path.formula.function, NUMBERS, 1 + states, count, 1 + 2 * states))
        except UncompiledLawError as error:
            raise InputError(
                f"{where}: {error}; allowed: an action of numbers, with `if` and `math`"
            ) from error
        valve: Row = {
            "leg": len(self.legs), "event": path.event, "states": states,
            "before": places[path.before], "back": places[path.back or path.before],
            "after": places[path.after],
            "jumps": path.remembers, "memory": path.remembers and still[1] > MET_PRESSURE,
            "joins": path.joins, "passed": self.integral(self.oil, path.passed),
            "loss": self.loss(path.loss), "constants": len(self.numbers),
            "law": float(law),
        }  # fmt: skip
        self.numbers += path.formula.parameters
        if states:
            valve["state"] = self.take(states)
            self.start |= {valve["state"] + i: value for i, value in enumerate(still[2 + states :])}
        self.valves.append(valve)
        return len(self.valves) - 1

    def gaps(self) -> list[Row]:
        """Of all chambers, valves and stops; those of chambers are positive where nothing happens."""
        found = [{"leg": row.get("leg", -1), "near": MET_PRESSURE, "rest": 1.0} for row in self.chambers]
        found += [
            {"leg": row["leg"], "valve": k, "near": MET_PRESSURE, "rest": -1.0}
            for k, row in enumerate(self.valves)
        ]
        found += [
            {"leg": n, "near": MET_LENGTH, "rest": -1.0} for n in range(len(self.legs)) for _ in range(STOPS)
        ]
        return [{"now": math.nan, **one} for one in found]


def _stops(stops: Sequence[EndStops | None]) -> dict[str, tuple[float, ...]]:
    there = [one or EndStops(lowest=-1.0, highest=1.0) for one in stops]
    return {
        "lowest": tuple(one.lowest for one in there),
        "highest": tuple(one.highest for one in there),
        "stop": tuple(0.0 if stops[k] is None else one.stiffness for k, one in enumerate(there)),
        "stop_damping": tuple(one.damping for one in there),
    }


def _records(rows: Sequence[Row], kind: np.dtype[np.void]) -> Records:
    """Records from rows; whole numbers that a row does not have are -1, others 0."""
    names = kind.names or ()
    missing = {name: -1 if kind[name] == np.int64 else np.zeros(kind[name].shape) for name in names}
    return np.array([tuple(row.get(name, missing[name]) for name in names) for row in rows], kind)


def fill_legs(legs: Sequence[PreloadedLeg], pump: PumpStation | None, first: int) -> Legs:
    """Records of legs whose states begin at a place of y."""
    states = (len(path.states) for leg in legs for path in leg.model.paths.values())
    filling = _Filling(first, max(states, default=0))
    if pump is not None and legs:
        filling.pump(pump)
    for leg in legs:
        filling.leg(leg)
    start = np.zeros(filling.next - first)
    for place, number in filling.start.items():
        start[place - first] = number
    return Legs(
        names=tuple(leg.name for leg in legs),
        arrays=LegArrays(
            records=_records(filling.legs, LEG),
            chambers=_records(filling.chambers, CHAMBER),
            valves=_records(filling.valves, VALVE),
            pumps=_records(filling.pumps, PUMP),
            gaps=_records(filling.gaps(), GAP),
            numbers=np.array(filling.numbers),
        ),
        places=tuple(filling.places),
        gaps=(*(row.get("event", "") for row in filling.chambers + filling.valves), *STOPPED * len(legs)),
        first=first,
        states=start.size,
        start=start,
    )


def oil_of(law: int, pressure: float, volume: float, modulus: float, air: TrappedAir | None = None) -> float:
    """Oil [m^3], as volume without pressure, that has a pressure [Pa] in a volume [m^3], with air if any."""
    of_air = 0.0 if air is None else air.at(pressure)
    if law == LOG:
        return (volume - of_air) * math.exp(pressure / modulus)
    return volume * (1.0 + pressure / modulus) - of_air


def empty_legs(legs: Legs, arrays: LegArrays) -> str:
    """Which leg of records as they stand has no room, or no oil, left in a chamber; empty if none."""
    for name, places in zip(legs.names, legs.places, strict=True):
        for room, c in places.chambers.items():
            chamber, main = arrays.chambers[c], room in ("piston", "tube")
            if not chamber["volume"] > 0.0:
                drawn = "drawn in until no room is left under its piston"
                return f"{name} is {drawn if main else 'extended until no room is left around its rod'}"
            if not chamber["oil"] > 0.0:
                drained = f"more oil is drawn out of the {SIDES.get(room, room)} of {name} than it holds"
                return f"{name} has lost all its oil" if main else drained
    return ""


def weigh_states(legs: Legs, weights: Vector, pressure: float, energy: float, play: float) -> None:
    """Write one over what each state of legs is of, into `weights`.

    Arguments:
        pressure: that carries the machine [Pa], of legs with less than that of their supply or valves.
        energy: of losses [J]. play: of lengths [m].
    """
    arrays = legs.arrays
    for leg, places in zip(arrays.records, legs.places, strict=True):
        model = places.model
        supply = model.sources.get("supply", 0.0)
        opens = model.yield_valve.opening_pressure if model.yield_valve else 0.0
        size = max(pressure, supply, opens, SMALLEST_STRAIN * model.bulk_modulus)
        speed = max(math.sqrt(play * 10.0), SMALLEST_SPEED)
        for c in places.chambers.values():
            if (state := arrays.chambers[c]["state"]) >= 0:
                weights[state] = 1.0 / size
        if leg["stage"] >= 0:
            weights[leg["stage"]], weights[leg["stage"] + 1] = 1.0 / play, 1.0 / speed
        for name, k in places.valves.items():
            for i, of_state in enumerate(model.paths[name].sizes):
                weights[arrays.valves[k]["state"] + i] = 1.0 / (size * of_state)
        scale = float(arrays.chambers[places.chambers["piston"]]["scale"])
        weights[[*places.oil.values()]] = 1.0 / (scale * size)
        weights[[*places.losses.values()]] = 1.0 / energy
    for pump in arrays.pumps:
        line = arrays.chambers[pump["chamber"]]
        weights[line["state"]] = 1.0 / float(pump["pressure"])
        weights[pump["given"]] = 1.0 / (float(line["scale"]) * float(pump["pressure"]))
