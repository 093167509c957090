"""By how much a channel may differ: a share of the reference's range, or an amount with its unit."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.units import converted
from support_exudyn.postprocessing.figures.selection import is_called, matching
from user_forces.values.value import InputError, short

WRITTEN = re.compile(r"\s*([+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*")
PERCENT = "%"
ALLOWED = "allowed: a share of the reference's range, '2 %', or an amount with its unit, '0.1 mm'"


@dataclass(frozen=True)
class Tolerance:
    """What is allowed: by how much the channels that a pattern matches may differ.

    pattern: name of a channel, or a pattern as in a shell. text: as it was written. amount: number of `unit`,
    which is "%" of the reference's range or a unit of the channel.
    """

    pattern: str
    text: str
    amount: float
    unit: str

    @property
    def is_relative(self) -> bool:
        """Whether it is a share of the reference's range."""
        return self.unit == PERCENT

    def in_si(self, channel: str, unit: str, extent: float) -> float:
        """What is allowed of a channel.

        Arguments:
            channel: its name.
            unit: of it, in SI.
            extent: the range of the reference: its largest less its least value, in SI.

        Raises InputError if it is an amount of another kind.
        """
        if not self.is_relative:
            amount = NamedSeries(f"tolerance of {channel}", self.unit, np.zeros(1), np.array([self.amount]))
            return float(converted(amount, unit)[0])
        return self.amount / 100.0 * extent


def tolerance(pattern: str, text: str) -> Tolerance:
    """A tolerance as people write it. Raises InputError if it is none."""
    found = WRITTEN.fullmatch(text)
    amount = float(found[1]) if found else math.nan
    if not pattern.strip() or found is None or not found[2] or not math.isfinite(amount):
        raise InputError(f"{short(pattern)} = {short(text)}: {ALLOWED}")
    return Tolerance(pattern.strip(), text.strip(), amount, found[2])


def read_tolerances(text: str) -> list[Tolerance]:
    """The tolerances of a command line, 'pin.*.force=2%,tip.*=0.1mm'. Raises InputError if it holds none."""
    found = []
    for part in filter(str.strip, text.split(",")):
        pattern, sign, amount = part.rpartition("=")
        if not sign:
            raise InputError(f"{short(part.strip())}: allowed: CHANNEL=AMOUNT, such as 'tip.*=0.1mm'")
        found.append(tolerance(pattern, amount))
    if not found:
        raise InputError(f"{short(text)}: allowed: CHANNEL=AMOUNT, such as 'pin.*.force=2%,tip.*=0.1mm'")
    return found


def of_channel(tolerances: Sequence[Tolerance], channel: str) -> Tolerance | None:
    """The first tolerance whose pattern matches a channel; None if none does."""
    return next((one for one in tolerances if is_called(channel, one.pattern)), None)


def check_patterns(tolerances: Sequence[Tolerance], channels: Collection[str]) -> None:
    """Raise InputError for a tolerance of no channel that is compared."""
    for one in tolerances:
        matching(channels, [one.pattern], f"channel is compared, tolerance {one.text}")
