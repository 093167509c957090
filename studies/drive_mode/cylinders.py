"""What is measured on hydraulic cylinders only: motion, pressures, flow and losses."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from studies.common import rise
from support_exudyn import Result

LATE = 5.2  # from here on it is taken as settled in the mean [s]
MIDDLE = (3.6, 4.4)  # of the rise, ramps of mode 2 excluded [s]

Get = Callable[[Result], float]


def extension(result: Result, column: str) -> np.ndarray:
    """Of a column since the start (n,) [m]."""
    length = result[f"{column}.length"]
    return np.asarray(length - length[0])


def _after(result: Result, time: float = rise.START) -> np.ndarray:
    return np.asarray(result.time >= time - 1e-9)


def _of_column(column: str) -> dict[str, tuple[str, Get]]:
    short, pressure = column.partition("_")[0], f"{column}.pressure"

    def speed(r: Result) -> float:
        begin, end = np.searchsorted(r.time, np.array(MIDDLE) - 1e-9)
        moved = extension(r, column)
        return float(1e3 * (moved[end] - moved[begin]) / (r.time[end] - r.time[begin]))

    def settled(r: Result) -> float:
        return float(1e3 * extension(r, column)[_after(r, LATE)].mean())

    return {
        f"speed_in_mid_rise_{short}": ("mm/s", speed),
        f"extension_at_5s_{short}": (
            "mm",
            lambda r: float(1e3 * np.interp(rise.END, r.time, extension(r, column))),
        ),
        f"settled_extension_{short}": ("mm", settled),
        f"overshoot_{short}": ("mm", lambda r: float(1e3 * extension(r, column).max()) - settled(r)),
        f"largest_pressure_{short}": ("MPa", rise.Peak(pressure, 1e-6, end=math.inf, extreme="max")),
        f"least_pressure_{short}": ("MPa", rise.Peak(pressure, 1e-6, end=math.inf, extreme="min")),
        f"pressure_after_{short}": (
            "MPa",
            lambda r: float(1e-6 * r[f"{column}.pressure"][_after(r, LATE)].mean()),
        ),
        f"largest_flow_{short}": ("l/min", rise.Peak(f"{column}.flow", 6e4, begin=0.0, end=math.inf)),
    }


MEASURES: dict[str, tuple[str, Get]] = {
    **_of_column("front_column"),
    **_of_column("rear_column"),
    "largest_pin_force_after_closing": ("N", rise.Peak(rise.FORCE, begin=rise.END, end=math.inf)),
    "loss_in_valves": ("kJ", lambda r: float(1e-3 * r["energy.damping_loss"][-1])),
    "work_of_pumps": ("kJ", lambda r: float(1e-3 * r["energy.work"][-1])),
}
