"""Channels that something cannot do without."""

from __future__ import annotations

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError


def recorded(result: Result, name: str, why: str) -> Series:
    """Values of a channel, shape (n,), in SI.

    why: what it is needed for, a sentence's end such as "pictures show it".

    Raises InputError if the run has not recorded it.
    """
    if name not in result.channels:
        raise InputError(
            f"channel {name!r}: was not recorded, and {why}; allowed: runs of a scenario with channels = ('*',)"
        )
    return result[name]
