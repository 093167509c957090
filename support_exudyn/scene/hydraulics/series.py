"""Legs over time, from their states at the records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from support_exudyn.mechanics.leg_channels import PUMP
from support_exudyn.mechanics.trajectory import LegSeries, OilEvent, Series
from support_exudyn.scene.hydraulics.fill import Legs
from support_exudyn.scene.hydraulics.gaps import MET_PRESSURE
from support_exudyn.scene.hydraulics.leg import evaluate_legs
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

TOLD = ("length", "rate", "inflow", "inflow_rate", "opening")  # of records, at an instant
FIELDS = {  # of records, by the name of the value
    "pressure": "pressure",
    "flow": "flow",
    "rod_pressure": "rod_pressure",
    "opening": "opening",
    "rod_flow": "rod_flow",
    "relief_flow": "relief_flow",
    "line_pressure": "line_pressure",
    "yield_flow": "yield_flow",
    "stage_pressure": "pressure2",
}
BOOKED = {  # of states, by the name of the value
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
OILS = ("oil", "rod_oil", "oil2", "line_oil")
CAVITIES = ("cavity", "rod_cavity", "cavity2", "line_cavity")


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
        told: for each leg what its record is told, by `TOLD` (n,).
        states: of the whole scene, shape (n, states), in which the legs' stand at their places.
        events: what happened in each leg, by which valves with hysteresis are open.
    """
    if not legs.names:
        return {}
    one, pumps, gaps = legs.records.copy(), legs.pumps.copy(), legs.gaps.copy()
    states, slope, stored = np.ascontiguousarray(states), np.empty(states.shape[1]), np.empty(time.size)
    inputs = {name: np.column_stack([told[leg][name] for leg in legs.names]) for name in TOLD}
    for name, values in inputs.items():
        one[name] = values[0]
    evaluate_legs(one, pumps, gaps, states[0], slope)
    # all at once: to fill a record field by field takes longer than to evaluate it
    found: Records = np.empty((time.size, len(legs.names)), one.dtype)
    pumped: Records = np.empty((time.size, legs.pumps.size), legs.pumps.dtype)
    found[:], pumped[:] = one, pumps
    for name, values in inputs.items():
        found[name] = values
    opened = _opened(legs.names, one, time, events)
    found["open"], found["rod_open"] = opened[..., 0], opened[..., 1]
    for i in range(time.size):
        stored[i] = evaluate_legs(found[i], pumped[i], gaps, states[i], slope)
    series = {
        name: _of_leg(found[:, n], states, one[n], stored if n == 0 else np.zeros_like(stored))
        for n, name in enumerate(legs.names)
    }
    if legs.pumps.size:
        pump = legs.pumps[0]
        oil = pump["oil0"] + pump["scale"] * states[:, pump["state"]]
        known: dict[str, Series] = {
            "pressure": pumped[:, 0]["now"],
            "flow": pumped[:, 0]["given"],
            "given": states[:, pump["state"] + 1],
            "oil": oil,
        }
        series[PUMP] = LegSeries(np.zeros_like(stored), np.zeros_like(stored), known)
    return series


def _opened(
    names: Sequence[str], start: Records, time: Series, events: Mapping[str, Sequence[OilEvent]]
) -> Matrix:
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


def _of_leg(records: Records, states: Matrix, leg: Records, stored: Series) -> LegSeries:
    """One leg; stored: energy that is told of it [J], of all legs with the first."""
    there = [
        place for place, name in zip(OILS, ("state", "rod", "stage", "line"), strict=True) if leg[name] >= 0
    ]
    values = {name: records[field].copy() for name, field in FIELDS.items()}
    values |= {name: states[:, leg["booked"] + place].copy() for name, place in BOOKED.items()}
    values["oil"] = sum((records[name] for name in there), np.zeros(len(records)))
    values["cavity"] = sum((records[name] for name in CAVITIES), np.zeros(len(records)))
    values["cavity_energy"] = (
        -leg["vapour"] * values["cavity"] if np.isfinite(leg["vapour"]) else values["cavity"]
    )
    if leg["stage"] >= 0:
        values["stage_extension"] = states[:, leg["stage"] + 1].copy()
    return LegSeries(records["force"].copy(), stored, values)
