"""Legs over time, from their states at the records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.hydraulic_legs import PRESSURES, PUMP
from support_exudyn.mechanics.trajectory import LegSeries, OilEvent, Series
from support_exudyn.scene.compilation import entry
from support_exudyn.scene.hydraulics.fill import MET_PRESSURE, Legs
from support_exudyn.scene.hydraulics.leg import press_all, stored_by
from support_exudyn.scene.hydraulics.oil import stored_in
from support_exudyn.scene.hydraulics.records import LegArrays, Matrix

Cube = npt.NDArray[np.float64]  # by record, leg, and what is known of it
INPUTS = ("length", "rate", "inflow", "inflow_rate", "opening")  # of a leg, that it does not compute


@entry
def evaluate_series(
    legs: LegArrays,
    inputs: Cube,
    memories: Matrix,
    states: Matrix,
    slope: Series,
    computed: Cube,
    chambers: Cube,
    flows: Matrix,
) -> None:
    """Evaluate all legs at all records.

    Arguments:
        legs: see `press_all`; are overwritten. inputs: shape (n, legs, INPUTS). memories: (n, valves).
        states: (n, states). slope: room for their rates.
        computed: shape (n, legs, 2), is filled: force and stored energy.
        chambers: shape (n, chambers, 4), is filled: pressure, oil, cavity, stored energy.
        flows: shape (n, valves), is filled.
    """
    for i in range(states.shape[0]):
        for n in range(legs.records.size):
            leg, now = legs.records[n], inputs[i, n]
            leg.length, leg.rate, leg.inflow, leg.inflow_rate = now[0], now[1], now[2], now[3]
            leg.opening = now[4]
        for k in range(legs.valves.size):
            legs.valves[k].memory = memories[i, k]
        press_all(legs, states[i], slope)
        for n in range(legs.records.size):
            computed[i, n, 0], computed[i, n, 1] = legs.records[n].force, stored_by(legs, n)
        for c in range(legs.chambers.size):
            chamber, row = legs.chambers[c], chambers[i, c]
            row[0], row[1], row[2] = chamber.pressure, chamber.oil, chamber.cavity
            if chamber.source != 0 and chamber.state >= 0:
                row[3] = stored_in(legs.chambers, c)
        for k in range(legs.valves.size):
            flows[i, k] = legs.valves[k].flow


def leg_series(
    legs: Legs,
    time: Series,
    told: Mapping[str, Mapping[str, Series]],
    states: Matrix,
    events: Mapping[str, Sequence[OilEvent]],
) -> dict[str, LegSeries]:
    """All legs, and the pump under its name, at the records.

    Arguments:
        legs: records as they were at the start.
        time: of the records (n,) [s].
        told: for each leg its `INPUTS` (n,).
        states: of the whole scene, shape (n, states), in which the legs' stand at their places.
        events: what happened in each leg, by which valves with hysteresis are open.
    """
    if not legs.names:
        return {}
    count, states = time.size, np.ascontiguousarray(states)
    arrays = legs.arrays.copies()
    inputs = np.stack([np.column_stack([told[name][what] for what in INPUTS]) for name in legs.names], axis=1)
    memories, slope = np.zeros((count, arrays.valves.size)), np.empty(states.shape[1])
    computed, chambers = np.zeros((count, len(legs.names), 2)), np.zeros((count, arrays.chambers.size, 4))
    flows = np.zeros((count, arrays.valves.size))
    filled = computed, chambers, flows
    evaluate_series(arrays, inputs[:1], memories[:1], states[:1], slope, *(one[:1] for one in filled))
    _remember(legs, arrays, time, events, memories)
    evaluate_series(arrays, inputs, memories, states, slope, *filled)
    series = {}
    for n, (name, places) in enumerate(zip(legs.names, legs.places, strict=True)):
        values = {"opening": told[name]["opening"]}
        model, record = places.model, legs.records[n]
        for room, c in places.chambers.items():
            values[PRESSURES.get(room, f"{room}.pressure")] = chambers[:, c, 0].copy()
        if record["driven"]:
            values["flow"] = record["bore"] * told[name]["inflow_rate"]
        for way, k in places.valves.items():
            path, first = model.paths[way], int(arrays.valves[k]["state"])
            values[path.flow] = flows[:, k].copy()
            values |= {state: states[:, first + i].copy() for i, state in enumerate(path.states)}
        for integral, place in (*places.oil.items(), *places.losses.items()):
            values[integral] = states[:, place].copy()
        own = [*places.chambers.values()]
        values["oil"], values["cavity"] = chambers[:, own, 1].sum(axis=1), chambers[:, own, 2].sum(axis=1)
        values["cavity_energy"] = -(model.vapour_pressure or 0.0) * values["cavity"]
        if record["stage"] >= 0:
            values["stage_extension"] = states[:, record["stage"]].copy()
        series[name] = LegSeries(computed[:, n, 0].copy(), computed[:, n, 1].copy(), values)
    for pump in arrays.pumps:
        pressure, oil, _, energy = chambers[:, pump["chamber"]].T.copy()
        flow = pump["flow"] * np.clip((pump["pressure"] - pressure) / pump["range"], 0.0, 1.0)
        values = {"pressure": pressure, "flow": flow, "given": states[:, pump["given"]].copy(), "oil": oil}
        series[PUMP] = LegSeries(np.zeros(count), energy, values)
    return series


def _remember(
    legs: Legs, start: LegArrays, time: Series, events: Mapping[str, Sequence[OilEvent]], memories: Matrix
) -> None:
    """Write whether valves with hysteresis are open at the records, by the start and by events from then on."""
    for name, places in zip(legs.names, legs.places, strict=True):
        for way, k in places.valves.items():
            if start.valves[k]["jumps"]:
                memories[:, k] = float(start.gaps[start.chambers.size + k]["now"] > MET_PRESSURE)
                for event in events.get(name, ()):
                    if event.what == places.model.paths[way].event:
                        memories[time >= event.time, k] = float(event.begins)
