"""Units at the border: what a figure or a table shows for SI and radians inside."""

import math
from typing import NamedTuple


class DisplayUnit(NamedTuple):
    """A unit that is shown: its name, and how many of it one SI unit is."""

    name: str
    scale: float


ROUNDED = 1.0 - 1e-9  # so that a thousandth of something is read as that whichever way it was rounded
LITTLE = 1e-3  # share of a quantity, in whose unit a smaller change is shown
DEGREES = 180.0 / math.pi
ALWAYS = {  # whatever the size
    "rad": DisplayUnit("deg", DEGREES),
    "rad/s": DisplayUnit("deg/s", DEGREES),
    "rad/s^2": DisplayUnit("deg/s²", DEGREES),
    "m^3/s": DisplayUnit("l/min", 6e4),
}
QUANTITIES = {
    "s": "time", "m": "position", "m/s": "velocity", "m/s^2": "acceleration", "kg": "mass",
    "N": "force", "N m": "moment", "J": "energy",
    "rad": "angle", "rad/s": "angular velocity", "rad/s^2": "angular acceleration",
    "Pa": "pressure", "m^3/s": "flow", "Hz": "frequency", "1": "share",
}  # fmt: skip
OTHERWISE = {  # last part of a channel's name: the quantity, where that of its unit would be wrong
    "depth": "depth", "length": "length", "gap": "gap", "eccentricity": "eccentricity", "slip": "slip velocity",
}  # fmt: skip
ANY = math.inf
# for each unit: below which size what is shown, the smallest first, and how many of it one SI unit is
SIZES: dict[str, tuple[tuple[float, str, float], ...]] = {
    "m": ((1e-4, "µm", 1e6), (10.0, "mm", 1e3), (ANY, "m", 1.0)),  # of machines all in mm
    "m/s": ((1e-4, "µm/s", 1e6), (0.3, "mm/s", 1e3), (ANY, "m/s", 1.0)),
    "N": ((0.1, "mN", 1e3), (1e3, "N", 1.0), (ANY, "kN", 1e-3)),
    "N m": ((0.1, "mN m", 1e3), (1e3, "N m", 1.0), (ANY, "kN m", 1e-3)),
    "J": ((1e-4, "µJ", 1e6), (0.1, "mJ", 1e3), (1e3, "J", 1.0), (ANY, "kJ", 1e-3)),
    "Pa": ((1e3, "Pa", 1.0), (1e5, "kPa", 1e-3), (ANY, "MPa", 1e-6)),
    "Hz": ((1e3, "Hz", 1.0), (ANY, "kHz", 1e-3)),
    "s": ((1e-3, "µs", 1e6), (0.1, "ms", 1e3), (ANY, "s", 1.0)),
}


def quantity(unit: str, names: tuple[str, ...] = ()) -> str:
    """What channels of a unit are: by their names if these agree, such as "depth", else by the unit."""
    ends = {name.rpartition(".")[2].partition("_")[0] for name in names}
    named = OTHERWISE.get(ends.pop()) if len(ends) == 1 else None
    return named or QUANTITIES.get(unit, "value")


def readable(unit: str, size: float) -> DisplayUnit:
    """The unit in which a quantity is read best.

    Degrees for radians, litres a minute; mm, kN and the like by the size of the quantity; others as they are.

    Arguments:
        unit: of a channel, such as "N".
        size: of the largest value in it, of either sign; zero is shown in the unit itself.
    """
    if unit in ALWAYS:
        return ALWAYS[unit]
    known = SIZES.get(unit, ()) if 0.0 < size < math.inf else ()
    shown = (DisplayUnit(name, scale) for limit, name, scale in known if size < limit * ROUNDED)
    return next(shown, DisplayUnit(unit, 1.0))


def readable_change(unit: str, size: float, change: float) -> DisplayUnit:
    """The unit in which changes of a quantity are read best, if they are not next to nothing of it.

    Arguments:
        unit: of a channel, such as "N".
        size: of its largest value, of either sign.
        change: of it.
    """
    return readable(unit, max(change, LITTLE * size) if change > 0.0 else size)


def amount(value: float, unit: str, digits: int = 3) -> str:
    """A quantity as text, in the unit in which it is read best: "0.26 ms" becomes "260 µs"."""
    shown = readable(unit, abs(value))
    number = f"{shown.scale * value:.{digits}g}"
    return number if shown.name == "1" else f"{number} {shown.name}"
