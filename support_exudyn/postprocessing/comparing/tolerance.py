"""Tolerances as users write them, and the verdict on a difference that has an error."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from support_exudyn.files.series.units import scaled
from support_exudyn.postprocessing.figures.selection import is_called
from user_forces.values.value import InputError, short

ToleranceVerdict = Literal["within", "not within", "not decided", "no tolerance"]
WORST_FIRST: tuple[ToleranceVerdict, ...] = ("not within", "not decided", "within", "no tolerance")
ROUNDING = 1e-9  # share of what is allowed: 1.1 - 1.0 is 0.1, in whatever digits
WRITTEN = re.compile(r"\s*([+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*")
PERCENT, ERRORS = "%", "errors"
ALLOWED = "allowed: a share of the reference's range, '2 %', or an amount with its unit, '0.1 mm'"


@dataclass(frozen=True)
class Tolerance:
    """A tolerance bounds how much the channels that a pattern matches may differ.

    pattern: name of a channel, or a pattern as in a shell. text: as it was written. amount: number of `unit`,
    which is "%" of the reference's range, a unit of the channel, or "errors": the numerical errors of both
    sides are allowed, record by record.
    """

    pattern: str
    text: str
    amount: float
    unit: str

    @property
    def is_errors(self) -> bool:
        """Whether the numerical errors of both sides are allowed."""
        return self.unit == ERRORS

    @property
    def is_relative(self) -> bool:
        """Whether it is a share of the reference's range."""
        return self.unit == PERCENT

    def in_si(self, channel: str, unit: str, extent: float) -> float:
        """The amount that is allowed of a channel in SI; NaN if the errors are allowed.

        Arguments:
            channel: its name. unit: of it, in SI.
            extent: the range of the reference: its largest less its least value, in SI.

        Raises InputError if it is an amount of another kind.
        """
        if self.is_relative or self.is_errors:
            return self.amount / 100.0 * extent
        return float(scaled(np.array([self.amount]), self.unit, unit, f"tolerance of {channel}")[0])


BOTH_ERRORS = Tolerance("*", "both errors", math.nan, ERRORS)


def tolerance(pattern: str, text: str) -> Tolerance:
    """A tolerance as people write it. Raises InputError if the text is none."""
    parts = WRITTEN.fullmatch(text)
    amount = float(parts[1]) if parts else math.nan
    if not pattern.strip() or parts is None or not parts[2] or not math.isfinite(amount):
        raise InputError(f"{short(pattern)} = {short(text)}: {ALLOWED}")
    return Tolerance(pattern.strip(), text.strip(), amount, parts[2])


def read_tolerances(text: str) -> list[Tolerance]:
    """The tolerances of a command line, 'pin.*.force=2%,tip.*=0.1mm'. Raises InputError if it holds none."""
    parts = [part.rpartition("=") for part in text.split(",") if part.strip()]
    if not parts or not all(sign for _, sign, _ in parts):
        raise InputError(f"{short(text)}: allowed: CHANNEL=AMOUNT, such as 'pin.*.force=2%,tip.*=0.1mm'")
    return [tolerance(pattern, amount) for pattern, _, amount in parts]


def of_channel(tolerances: Sequence[Tolerance], channel: str) -> Tolerance | None:
    """The first tolerance whose pattern matches a channel; None if none does."""
    return next((each for each in tolerances if is_called(channel, each.pattern)), None)


# --- the verdict ---


class JudgedDifference(NamedTuple):
    """A difference against what is allowed.

    what: of which number, such as "largest difference". value: magnitude of the difference. error: of the
    difference, infinite if it is not known. allowed: magnitude; NaN: no tolerance is given. All in SI.
    """

    what: str
    value: float
    error: float
    allowed: float

    @property
    def verdict(self) -> ToleranceVerdict:
        """Within, or not; not decided if the error is larger than what is allowed and could turn the answer.

        A difference that is no number is not decided: it could not be computed.
        """
        if math.isnan(self.allowed):
            return "no tolerance"
        unsure = self.error > self.allowed and self.value - self.error <= self.allowed
        if math.isnan(self.value) or math.isinf(self.error) or unsure:
            return "not decided"
        return "within" if self.value <= self.allowed * (1.0 + ROUNDING) else "not within"

    @property
    def ratio(self) -> float:
        """The difference over what is allowed; infinite if nothing is allowed, NaN if one is not known."""
        if self.allowed > 0.0 or math.isnan(self.allowed):
            return self.value / self.allowed
        return math.inf if self.value > 0.0 else 0.0


def worst(verdicts: Iterable[ToleranceVerdict]) -> ToleranceVerdict:
    """The verdict on all: the worst of those on each."""
    given = set(verdicts)
    return next((verdict for verdict in WORST_FIRST if verdict in given), "no tolerance")
