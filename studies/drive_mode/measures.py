"""What is measured of the drive modes; on hydraulic cylinders also motion, pressures, flow and losses."""

import math
from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from studies.common import rise
from studies.drive_mode.cases import ModePlan
from support_exudyn import Result
from support_exudyn.simulation.impulses import impulses_of

Get = Callable[[Result], float]
START, STOP = "largest_pin_force_in_motion", "largest_pin_force_after_stop"  # from the stop to the run's end
# what squares or extremes make endless where there is an impulse: of the pin, and of the body's velocity
OF_PIN = (START, STOP, "std_pin_force", "rms_pin_force")
OF_BODY = ("largest_angular_acceleration", "std_angular_acceleration")
EXTREMES: tuple[Literal["largest", "max", "min"], ...] = ("largest", "max", "min")


def _of_motion(watched: rise.Watched) -> dict[str, tuple[str, Get]]:
    def mean(channel: str) -> Get:
        return lambda r: watched.mean(r, channel)

    def spread(channel: str, scale: float = 1.0) -> Get:
        return lambda r: scale * watched.spread(r, channel)

    def fluctuation(channel: str, scale: float = 1.0) -> Get:
        # from the very start on, which is where mode 1 strikes
        return lambda r: scale * watched.rms_fluctuation(r, r[channel], watched.start)

    return {
        "mean_pin_force": ("N", mean(watched.force)),
        "std_pin_force": ("N", spread(watched.force)),
        "rms_pin_force": ("N", fluctuation(watched.force)),
        START: ("N", watched.peak(watched.force)),
        STOP: ("N", rise.Crest(watched.force, begin=watched.end, end=math.inf)),
        "largest_angular_acceleration": ("deg/s^2", watched.peak(watched.acceleration, rise.DEGREES)),
        "std_angular_acceleration": ("deg/s^2", spread(watched.acceleration, rise.DEGREES)),
        "rms_angular_velocity": ("deg/s", fluctuation(watched.speed, rise.DEGREES)),
    }


def _of_forces(watched: rise.Watched, actuators: Sequence[str]) -> dict[str, tuple[str, Get]]:
    """Extremes of what actuators carry: largest is of the magnitude; a push is positive, a pull negative."""
    return {
        f"{extreme}_{name}_force": (
            "N",
            rise.Crest(f"{name}.force", 1.0, watched.start, watched.end, extreme),
        )
        for name in actuators
        for extreme in EXTREMES
    }


def _of_jumps(watched: rise.Watched, actuators: Sequence[str]) -> dict[str, tuple[str, Get]]:
    """Impulses of the sudden start and end; that of the pin is a magnitude."""
    channels = {name: f"{name}.force" for name in actuators} | {"pin": watched.force}

    def impulse(channel: str, place: int) -> Get:
        return lambda r: impulses_of(r, channel, 0.0, math.inf)[place]

    ends = enumerate(("start", "end"))
    return {
        f"impulse_{name}_{end}": ("N s", impulse(channel, place))
        for place, end in ends
        for name, channel in channels.items()
    }


# --- on hydraulic cylinders ---

LATE = 5.2  # from here on it is taken as settled in the mean [s]
MIDDLE = (3.6, 4.4)  # of the rise, ramps of mode 2 excluded [s]


def extension(result: Result, column: str) -> np.ndarray:
    """The extension of a column since the start (n,) [m]."""
    length = result[f"{column}.length"]
    return np.asarray(length - length[0])


def _mean_after(result: Result, values: np.ndarray) -> float:
    after = result.time >= LATE - 1e-9
    return rise.mean(result.time[after], values[after])


def _of_column(column: str) -> dict[str, tuple[str, Get]]:
    short, pressure = column.partition("_")[0], f"{column}.pressure"

    def speed(r: Result) -> float:
        begin, end = np.searchsorted(r.time, np.array(MIDDLE) - 1e-9)
        moved = extension(r, column)
        return float(1e3 * (moved[end] - moved[begin]) / (r.time[end] - r.time[begin]))

    def settled(r: Result) -> float:
        return 1e3 * _mean_after(r, extension(r, column))

    return {
        f"speed_in_mid_rise_{short}": ("mm/s", speed),
        f"extension_at_5s_{short}": (
            "mm",
            lambda r: float(1e3 * np.interp(rise.END, r.time, extension(r, column))),
        ),
        f"settled_extension_{short}": ("mm", settled),
        f"overshoot_{short}": ("mm", lambda r: float(1e3 * extension(r, column).max()) - settled(r)),
        f"largest_pressure_{short}": ("MPa", rise.Crest(pressure, 1e-6, end=math.inf, extreme="max")),
        f"least_pressure_{short}": ("MPa", rise.Crest(pressure, 1e-6, end=math.inf, extreme="min")),
        f"pressure_after_{short}": (
            "MPa",
            lambda r: 1e-6 * _mean_after(r, r[f"{column}.pressure"]),
        ),
        f"largest_flow_{short}": ("l/min", rise.Crest(f"{column}.flow", 6e4, begin=0.0, end=math.inf)),
    }


ON_CYLINDERS: dict[str, tuple[str, Get]] = {
    **_of_column("front_column"),
    **_of_column("rear_column"),
    "loss_in_valves": ("kJ", lambda r: float(1e-3 * r["energy.damping_loss"][-1])),
    "work_of_pumps": ("kJ", lambda r: float(1e-3 * r["energy.work"][-1])),
}


# --- all ---


def measures_of(plan: ModePlan, result: Result) -> dict[str, tuple[str, Get]]:
    """Unit and measure of every number of a case that has a limit, by name."""
    watched = plan.subject.watched
    of_forces = {watched.force: (OF_PIN, "impulse_pin")} | {
        f"{name}.force": ([f"{extreme}_{name}_force" for extreme in EXTREMES], f"impulse_{name}")
        for name in plan.actuators
    }
    without = set(OF_BODY if result.impulses else ())
    for channel, (endless, impulse) in of_forces.items():
        struck = len(impulses_of(result, channel, 0.0, math.inf)) == 2  # at the start and at the end
        without |= set(endless) if struck else {f"{impulse}_start", f"{impulse}_end"}
    found = {name: what for name, what in all_measures(plan).items() if name not in without}
    return found | (ON_CYLINDERS if result.scenario.valved else {})


def all_measures(plan: ModePlan) -> dict[str, tuple[str, Get]]:
    """Unit and measure of every number but those of cylinders, by name."""
    watched = plan.subject.watched
    return _of_motion(watched) | _of_forces(watched, plan.actuators) | _of_jumps(watched, plan.actuators)
