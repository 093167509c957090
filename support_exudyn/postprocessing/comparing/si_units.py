"""The unit in SI in which a quantity is compared."""

from __future__ import annotations

import re
from functools import cache

import numpy as np

from support_exudyn.files.series.units import scaled, unit_checked
from user_forces.values.value import InputError

# the house's units, each of another kind; of a work and a moment the words decide
UNITS = (
    "s", "m", "m/s", "m/s^2", "N", "N m", "rad", "rad/s", "rad/s^2", "Pa", "m^3/s", "kg", "Hz", "W", "N/m",
    "N s", "m^2", "m^3", "1",
)  # fmt: skip
WORK = re.compile(r"joule|J|Wh")


@cache
def si_unit(unit: str) -> str:
    """The house's unit of the kind of a unit: "N" of kN, "m" of inch; itself if it is of no kind of the house.

    Raises InputError if it is no unit.
    """
    known = ("J", *UNITS) if WORK.search(unit) else (*UNITS, "J")
    unit_checked(unit, "unit")
    return next((one for one in known if of_a_kind(unit, one)), unit)


@cache
def of_a_kind(one: str, other: str) -> bool:
    """Whether quantities in one unit can be given in another."""
    try:
        scaled(np.ones(1), one, other, "unit")
    except InputError:
        return False
    return True
