"""Units at the border: what a figure or a table shows for SI and radians inside."""

import math
from typing import NamedTuple


class DisplayUnit(NamedTuple):
    """A unit that is shown: its name, and how many of it one SI unit is."""

    name: str
    scale: float


ROUNDED = 1.0 - 1e-9  # so that a thousandth of something is read as that whichever way it was rounded
LITTLE = 1e-3  # share of a quantity, in whose unit a smaller change is told
DEGREES = 180.0 / math.pi
ANGLES = {
    "rad": DisplayUnit("deg", DEGREES),
    "rad/s": DisplayUnit("deg/s", DEGREES),
    "rad/s^2": DisplayUnit("deg/s²", DEGREES),
}
FLOW = DisplayUnit("l/min", 6e4)
QUANTITIES = {
    "s": "time", "m": "length", "m/s": "speed", "m/s^2": "acceleration", "kg": "mass",
    "N": "force", "N m": "moment", "J": "energy",
    "rad": "angle", "rad/s": "angular velocity", "rad/s^2": "angular acceleration",
    "Pa": "pressure", "m^3/s": "flow", "Hz": "frequency", "1": "share",
}  # fmt: skip
# for each unit: below which size what is shown, the smallest first
SIZES: dict[str, tuple[tuple[float, DisplayUnit], ...]] = {
    # of machines all in mm
    "m": ((1e-4, DisplayUnit("µm", 1e6)), (10.0, DisplayUnit("mm", 1e3)), (math.inf, DisplayUnit("m", 1.0))),
    "m/s": (
        (1e-4, DisplayUnit("µm/s", 1e6)),
        (0.3, DisplayUnit("mm/s", 1e3)),
        (math.inf, DisplayUnit("m/s", 1.0)),
    ),
    "N": ((0.1, DisplayUnit("mN", 1e3)), (1e3, DisplayUnit("N", 1.0)), (math.inf, DisplayUnit("kN", 1e-3))),
    "N m": (
        (0.1, DisplayUnit("mN m", 1e3)),
        (1e3, DisplayUnit("N m", 1.0)),
        (math.inf, DisplayUnit("kN m", 1e-3)),
    ),
    "J": (
        (1e-4, DisplayUnit("µJ", 1e6)),
        (0.1, DisplayUnit("mJ", 1e3)),
        (1e3, DisplayUnit("J", 1.0)),
        (math.inf, DisplayUnit("kJ", 1e-3)),
    ),
    "Pa": (
        (1e3, DisplayUnit("Pa", 1.0)),
        (1e5, DisplayUnit("kPa", 1e-3)),
        (math.inf, DisplayUnit("MPa", 1e-6)),
    ),
    "Hz": ((1e3, DisplayUnit("Hz", 1.0)), (math.inf, DisplayUnit("kHz", 1e-3))),
    "s": ((1e-3, DisplayUnit("µs", 1e6)), (0.1, DisplayUnit("ms", 1e3)), (math.inf, DisplayUnit("s", 1.0))),
}


def readable(unit: str, size: float) -> DisplayUnit:
    """The unit in which a quantity is read best.

    Degrees for radians, litres a minute; mm, kN and the like by the size of the quantity; others as they are.

    Arguments:
        unit: of a channel, such as "N".
        size: of the largest value in it, of either sign; zero is shown in the unit itself.
    """
    if unit in ANGLES:
        return ANGLES[unit]
    if unit == "m^3/s":
        return FLOW
    if size <= 0.0 or not math.isfinite(size):
        return DisplayUnit(unit, 1.0)
    return next(
        (shown for limit, shown in SIZES.get(unit, ()) if size < limit * ROUNDED), DisplayUnit(unit, 1.0)
    )


def readable_change(unit: str, size: float, change: float) -> DisplayUnit:
    """The unit in which changes of a quantity are read best, if they are not next to nothing of it.

    Arguments:
        unit: of a channel, such as "N".
        size: of its largest value, of either sign.
        change: of it.
    """
    return readable(unit, max(change, LITTLE * size) if change > 0.0 else size)


def said_beside(value: float, unit: str, largest: float) -> str:
    """A quantity to a tenth in the unit in which the largest one is read best, or in its own if that shows 0.0.

    So a number that changes over time keeps its unit: "12.3 kN" and "0.0 kN", but "40.0 N".

    Arguments:
        value: zero or more.
        unit: of both, such as "N".
        largest: that is shown in the same place.
    """
    shown = readable(unit, largest)
    if value > 0.0 and f"{shown.scale * value:.1f}" == "0.0":
        shown = readable(unit, value)
    return f"{shown.scale * value:.1f} {shown.name}"


def said(value: float, unit: str, digits: int = 3) -> str:
    """A quantity in words, in the unit in which it is read best: "0.26 ms" becomes "260 µs"."""
    shown = readable(unit, abs(value))
    number = f"{shown.scale * value:.{digits}g}"
    return number if shown.name == "1" else f"{number} {shown.name}"
