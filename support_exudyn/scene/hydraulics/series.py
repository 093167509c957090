"""Legs over time, from their states at the records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.leg_channels import PUMP
from support_exudyn.mechanics.trajectory import LegSeries, OilEvent, Series
from support_exudyn.scene.compilation import entry
from support_exudyn.scene.hydraulics.fill import Legs
from support_exudyn.scene.hydraulics.gaps import MET_PRESSURE
from support_exudyn.scene.hydraulics.leg import press_all, stored_by, stored_by_pump
from support_exudyn.scene.hydraulics.records import (
    GAP_NAMES,
    LET_IN,
    LINE_LOSS,
    RELIEF,
    RELIEVED,
    SEAL_LOSS,
    STAGE_LOSS,
    STOP_LOSS,
    VALVE_LOSS,
    VISCOUS_LOSS,
    YIELD,
    YIELD_LOSS,
    YIELDED,
    Matrix,
    Records,
)

Cube = npt.NDArray[np.float64]  # by record, leg, and what is known of it
INPUTS = (
    "length",
    "rate",
    "inflow",
    "inflow_rate",
    "opening",
)  # of a leg at an instant, that it does not compute
OPEN, ROD_OPEN, KNOWN = len(INPUTS), len(INPUTS) + 1, len(INPUTS) + 2
# what is computed of a leg at an instant, in the order of `evaluate_series`
COMPUTED = (
    "force",
    "energy",
    "pressure",
    "flow",
    "rod_pressure",
    "rod_flow",
    "relief_flow",
    "line_pressure",
    "yield_flow",
    "stage_pressure",
    "oil",
    "cavity",
)
INTEGRATED = {  # places among the integrals, by the name of the value
    "let_in": LET_IN,
    "valve_loss": VALVE_LOSS,
    "relieved": RELIEVED,
    "line_loss": LINE_LOSS,
    "yielded": YIELDED,
    "yield_loss": YIELD_LOSS,
    "seal_loss": SEAL_LOSS,
    "stop_loss": STOP_LOSS,
    "stage_loss": STAGE_LOSS,
    "viscous_loss": VISCOUS_LOSS,
}


@entry
def evaluate_series(
    legs: Records, pumps: Records, gaps: Matrix, known: Cube, states: Matrix, slope: Series, found: Cube
) -> None:
    """Evaluate all legs at all records.

    Arguments:
        legs, pumps, gaps: see `press_all`; are overwritten. known: shape (n, legs, KNOWN): `INPUTS` and both
            relief valves' memory. states: (n, states). slope: room for their rates.
        found: shape (n, legs + 1, COMPUTED), is filled; last of the pump: its pressure, flow and energy.
    """
    for i in range(states.shape[0]):
        for n in range(legs.size):
            leg, now = legs[n], known[i, n]
            leg.length, leg.rate, leg.inflow, leg.inflow_rate, leg.opening = (
                now[0],
                now[1],
                now[2],
                now[3],
                now[4],
            )
            leg.open, leg.rod_open = now[OPEN], now[ROD_OPEN]
        press_all(legs, pumps, gaps, states[i], slope)
        for n in range(legs.size):
            leg, row = legs[n], found[i, n]
            row[0], row[1], row[2], row[3] = leg.force, stored_by(legs, n), leg.pressure, leg.flow
            row[4], row[5], row[6] = leg.rod_pressure, leg.rod_flow, leg.relief_flow
            row[7], row[8], row[9] = leg.line_pressure, leg.yield_flow, leg.pressure2
            row[10] = leg.oil + leg.rod_oil + leg.oil2 + leg.line_oil
            row[11] = leg.cavity + leg.rod_cavity + leg.cavity2 + leg.line_cavity
        if pumps.size > 0:
            row = found[i, legs.size]
            row[0], row[1], row[2] = pumps[0].now, pumps[0].given, stored_by_pump(pumps)


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
    count, states = len(legs.names), np.ascontiguousarray(states)
    known, found = np.empty((time.size, count, KNOWN)), np.zeros((time.size, count + 1, len(COMPUTED)))
    records, pumps, slope = legs.records.copy(), legs.pumps.copy(), np.empty(states.shape[1])
    for n, name in enumerate(legs.names):
        known[:, n, :OPEN] = np.column_stack([told[name][what] for what in INPUTS])
    for name, values in zip(INPUTS, known[0].T, strict=False):
        records[name] = values
    evaluate_series(records, pumps, legs.gaps.copy(), known[:1], states[:1], slope, found[:1])
    known[..., OPEN:] = _opened(legs.names, records, time, events)
    evaluate_series(records, pumps, legs.gaps.copy(), known, states, slope, found)
    series = {}
    for n, (name, leg) in enumerate(zip(legs.names, legs.records, strict=True)):
        values = dict(zip(COMPUTED, found[:, n].T.copy(), strict=True))
        values["opening"] = told[name]["opening"]
        for integral, place in INTEGRATED.items():
            at = int(leg["integrals"][place])
            values[integral] = states[:, at].copy() if at >= 0 else np.zeros(time.size)
        values["cavity_energy"] = (-leg["vapour"] if np.isfinite(leg["vapour"]) else 0.0) * values["cavity"]
        if leg["stage"] >= 0:
            values["stage_extension"] = states[:, leg["stage"] + 1].copy()
        series[name] = LegSeries(values.pop("force"), values.pop("energy"), values)
    if pumps.size:
        pump, (pressure, flow, energy) = pumps[0], found[:, count, :3].T.copy()
        oil = pump["oil0"] + pump["scale"] * states[:, pump["state"]]
        given = states[:, pump["state"] + 1].copy()
        known_of_pump = {"pressure": pressure, "flow": flow, "given": given, "oil": oil}
        series[PUMP] = LegSeries(np.zeros(time.size), energy, known_of_pump)
    return series


def _opened(
    names: Sequence[str], start: Records, time: Series, events: Mapping[str, Sequence[OilEvent]]
) -> Cube:
    """Whether both relief valves of each leg are open at the records, shape (n, legs, 2).

    By the pressures that they start with, and by events from then on.
    """
    found = np.empty((time.size, len(names), 2))
    valves = ("pressure", "opens", YIELD), ("rod_pressure", "rod_opens", RELIEF)
    for n, name in enumerate(names):
        for k, (pressure, opens, gap) in enumerate(valves):
            found[:, n, k] = float(start[n][pressure] > start[n][opens] + MET_PRESSURE)
            for event in events.get(name, ()):
                if event.what == GAP_NAMES[gap]:
                    found[time >= event.time, n, k] = float(event.begins)
    return found
