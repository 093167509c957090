"""What is measured of the drive modes; on hydraulic cylinders also motion, pressures, flow and losses."""

import math
from collections.abc import Callable, Mapping
from typing import Literal

import numpy as np

from studies.common import rise
from studies.common.numbers import Number, measured_all
from support_exudyn import Result

Get = Callable[[Result], float]
EXTREMES: tuple[Literal["largest", "max", "min"], ...] = ("largest", "max", "min")


def _rms_fluctuation(channel: str, scale: float = 1.0) -> Get:
    # from the very start on, which is where mode 1 strikes
    return lambda r: scale * rise.rms_fluctuation(r, r[channel], rise.START)


MEASURES: dict[str, tuple[str, Get]] = {
    "mean_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean())),
    "std_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].std())),
    "rms_pin_force": ("N", _rms_fluctuation(rise.FORCE)),
    "largest_pin_force_in_rise": ("N", rise.Peak(rise.FORCE)),
    # the largest is of the magnitude; a push is positive, a pull negative
    **{
        f"{extreme}_{column}_force": ("N", rise.Peak(f"{column}.force", extreme=extreme))
        for column in ("front_column", "rear_column")
        for extreme in EXTREMES
    },
    "largest_angular_acceleration": ("deg/s^2", rise.Peak(rise.ACCELERATION, rise.DEGREES)),
    "std_angular_acceleration": (
        "deg/s^2",
        lambda r: rise.DEGREES * float(r[rise.ACCELERATION][rise.in_rise(r)].std()),
    ),
    "rms_angular_velocity": ("deg/s", _rms_fluctuation(rise.SPEED, rise.DEGREES)),
}


def _impulse(column: str, place: int) -> Get:
    return lambda r: r.impulses[place].actuators[column]


IMPULSES: dict[str, Get] = {
    f"impulse_{column}_{end}": _impulse(column, place)
    for place, end in enumerate(("start", "end"))
    for column in ("front_column", "rear_column")
}


# --- on hydraulic cylinders ---

LATE = 5.2  # from here on it is taken as settled in the mean [s]
MIDDLE = (3.6, 4.4)  # of the rise, ramps of mode 2 excluded [s]


def extension(result: Result, column: str) -> np.ndarray:
    """The extension of a column since the start (n,) [m]."""
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


ON_CYLINDERS: dict[str, tuple[str, Get]] = {
    **_of_column("front_column"),
    **_of_column("rear_column"),
    "largest_pin_force_after_closing": ("N", rise.Peak(rise.FORCE, begin=rise.END, end=math.inf)),
    "loss_in_valves": ("kJ", lambda r: float(1e-3 * r["energy.damping_loss"][-1])),
    "work_of_pumps": ("kJ", lambda r: float(1e-3 * r["energy.work"][-1])),
}


# --- all ---


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study, but for those that are none."""
    return [n for case, result in results.items() for n in measured_all({case: result}, measures_of(result))]


def measures_of(result: Result) -> dict[str, tuple[str, Get]]:
    """Unit and measure of every number of a case, by name."""
    impulses = {name: ("N s", get) for name, get in IMPULSES.items()} if result.impulses else {}
    return MEASURES | impulses | (ON_CYLINDERS if result.scenario.cylinders else {})
