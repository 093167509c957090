"""What is measured of a rise by valves."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from studies.common import rise
from studies.common.numbers import Number, measured_all
from studies.valve_modes.cases import START
from support_exudyn import Result

Get = Callable[[Result], float]
ROWS = ("front", "rear")
MIDDLE = (0.3, 0.7)  # of the time that the valve is open


def extension(result: Result, row: str) -> np.ndarray:
    """The extension of a row of columns since the start (n,) [m]."""
    length = result[f"{row}_column.length"]
    return np.asarray(length - length[0])


def _closes(result: Result) -> float:
    return max(result.scenario.breaks)


def _speed(row: str) -> Get:
    def measure(result: Result) -> float:
        span = _closes(result) - START
        begin, end = (START + share * span for share in MIDDLE)
        moved = np.interp([begin, end], result.time, extension(result, row))
        return float(1e3 * (moved[1] - moved[0]) / (end - begin))

    return measure


def _at_end(row: str) -> Get:
    return lambda r: float(1e3 * np.interp(_closes(r), r.time, extension(r, row)))


def _boils(result: Result) -> float:
    """For how long any chamber of either row has a cavity [ms], by the instants at which it begins and ends."""
    changes: list[tuple[float, int]] = []
    for events in result.oil_events.values():
        changes += [
            (event.time, -1 if event.begins else 1) for event in events if event.what.endswith("filled")
        ]
    open_now, since, total = 0, 0.0, 0.0
    for time, change in sorted(changes):
        if open_now == 0 and change > 0:
            since = time
        open_now += change
        if open_now == 0 and change < 0:
            total += time - since
    return 1e3 * (total + (result.scenario.duration - since if open_now > 0 else 0.0))


def measures(result: Result) -> dict[str, tuple[str, Get]]:
    """Unit and measure of every number of a case, by name."""
    ends = {"begin": 0.0, "end": math.inf}
    found: dict[str, tuple[str, Get]] = {
        "largest_pin_force_at_start": ("kN", rise.Crest(rise.FORCE, 1e-3, START, START + 1.0)),
        "largest_pin_force_at_end": (
            "kN",
            lambda r: rise.Crest(rise.FORCE, 1e-3, _closes(r), math.inf)(r),
        ),
    }
    for row in ROWS:
        name = f"{row}_column"
        found[f"least_pressure_{row}"] = (
            "MPa",
            rise.Crest(f"{name}.pressure", 1e-6, extreme="min", **ends),
        )
        found[f"largest_pressure_{row}"] = (
            "MPa",
            rise.Crest(f"{name}.pressure", 1e-6, extreme="max", **ends),
        )
        found[f"least_force_{row}"] = ("kN", rise.Crest(f"{name}.force", 1e-3, extreme="min", **ends))
        found[f"speed_in_mid_rise_{row}"] = ("mm/s", _speed(row))
        found[f"extension_at_end_{row}"] = ("mm", _at_end(row))
        if result.scenario.legs[name].vapour_pressure is not None:
            found[f"largest_cavity_{row}"] = (
                "ml",
                rise.Crest(f"{name}.cavity", 1e6, extreme="max", **ends),
            )
    if result.scenario.legs["front_column"].vapour_pressure is not None:
        found["time_with_cavity"] = ("ms", _boils)
    if result.scenario.pump is not None:
        found["least_pump_pressure"] = ("MPa", rise.Crest("pump.pressure", 1e-6, extreme="min", **ends))
    return found


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study."""
    return [
        number for case, result in results.items() for number in measured_all({case: result}, measures(result))
    ]
