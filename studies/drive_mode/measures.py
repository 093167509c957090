"""What is measured of the drive modes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal

from studies.common import rise
from studies.common.numbers import Number, measured
from studies.drive_mode import cylinders
from support_exudyn import Result

Get = Callable[[Result], float]
EXTREMES: tuple[Literal["largest", "max", "min"], ...] = ("largest", "max", "min")


def _ripple(channel: str, scale: float = 1.0) -> Get:
    # from the very start on, which is where mode 1 strikes
    return lambda r: scale * rise.ripple(r, r[channel], rise.START)


MEASURES: dict[str, tuple[str, Get]] = {
    "mean_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].mean())),
    "std_pin_force": ("N", lambda r: float(r[rise.FORCE][rise.in_rise(r)].std())),
    "ripple_pin_force": ("N", _ripple(rise.FORCE)),
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
    "ripple_angular_velocity": ("deg/s", _ripple(rise.SPEED, rise.DEGREES)),
}


def _impulse(column: str, place: int) -> Get:
    return lambda r: r.impulses[place].columns[column]


IMPULSES: dict[str, Get] = {
    f"impulse_{column}_{end}": _impulse(column, place)
    for place, end in enumerate(("start", "end"))
    for column in ("front_column", "rear_column")
}


def measure(results: Mapping[str, Result]) -> list[Number]:
    """All numbers of the study, but for those that are none."""
    numbers = []
    for case, result in results.items():
        for name, (unit, get) in measures_of(result).items():
            numbers.append(measured(name, case, unit, result, get))
    return numbers


def measures_of(result: Result) -> dict[str, tuple[str, Get]]:
    """Unit and measure of every number of a case, by name."""
    impulses = {name: ("N s", get) for name, get in IMPULSES.items()} if result.impulses else {}
    return MEASURES | impulses | (cylinders.MEASURES if result.scenario.cylinders else {})
