"""By how much a file lags behind the reference, found by the curve that tells it best."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.shift import TimeShift, time_shift
from user_forces.values.value import InputError


class FoundShift(NamedTuple):
    """A shift in time, and the channel by which it was found."""

    channel: str
    found: TimeShift


def found_shift(reference: ComparedFile, other: ComparedFile, units: Mapping[str, str]) -> FoundShift:
    """The shift of the channel that is sure of it and has the smallest error.

    units: of the channels that are looked at, in SI.

    Raises InputError if no channel is sure: the curves are not alike, or alike at several shifts.
    """
    tried, reasons = [], []
    for name, unit in units.items():
        try:
            found = time_shift(
                reference.time(name), reference.values(name, unit), other.time(name), other.values(name, unit)
            )
        except InputError as error:
            reasons.append(f"{name}: {error}")
            continue
        tried.append(FoundShift(name, found))
    sure = [one for one in tried if one.found.is_sure]
    if sure:
        return min(sure, key=lambda one: one.found.error)
    if tried:
        best = max(tried, key=lambda one: one.found.correlation)
        reasons = [
            f"the best is {best.found.shift:.4g} s by {best.channel}, correlation "
            f"{best.found.correlation:.2f}, and {best.found.next_best:.2f} at another shift"
        ]
    raise InputError(
        f"--shift: {other.name} and {reference.name}: no shift in time is sure ({'; '.join(reasons[:3])}); "
        "allowed: "
        f'a channel with one clear event, or shift_s of [files."{other.path.name}"] in compare.toml'
    )
