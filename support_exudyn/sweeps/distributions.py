"""Numbers that are not known exactly: how likely which is, as a sweep's file says it."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.sweeps.plan import DIGITS, Range
from user_forces.values.value import InputError, short

KINDS: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {  # keys that a kind needs, and may have besides
    "uniform": (("from", "to"), ()),
    "log_uniform": (("from", "to"), ()),
    "normal": (("mean", "std"), ("from", "to")),
    "file": (("file",), ("column",)),
}
KEYS = {"distribution", *(key for needed, more in KINDS.values() for key in (*needed, *more))}
FARTHEST = 1e-12  # share of all numbers beyond which none is drawn, so that all are finite


@dataclass(frozen=True)
class NormalNumbers:
    """Numbers of a normal distribution; of those between two bounds alone, if there are any."""

    mean: float
    std: float
    low: float = -math.inf
    high: float = math.inf

    def at(self, share: float) -> Decimal:
        """The number that a share of all is below, 0 to 1, in twelve digits."""
        from scipy.stats import truncnorm  # takes a second, and a grid has no use for it

        ends = (self.low - self.mean) / self.std, (self.high - self.mean) / self.std
        inside = min(max(share, FARTHEST), 1.0 - FARTHEST)
        return _decimal(float(truncnorm.ppf(inside, *ends, loc=self.mean, scale=self.std)))


@dataclass(frozen=True)
class MeasuredNumbers:
    """Numbers that were measured, in order: all are equally likely, and so is all between two neighbours."""

    values: tuple[float, ...]

    def at(self, share: float) -> Decimal:
        """The number that a share of all is below, 0 to 1, in twelve digits."""
        return _decimal(float(np.quantile(self.values, share)))


def _decimal(number: float) -> Decimal:
    return DIGITS.create_decimal_from_float(number).normalize()


Distribution = Range | NormalNumbers | MeasuredNumbers


def distribution_of(item: Mapping[str, Any], where: str, folder: Path) -> Distribution:
    """The distribution that a table of a sweep's file describes.

    where: what errors call it. folder: from which its file lies.

    Raises InputError for unknown keys, for numbers out of their range, and for a file without numbers; OSError
    if the file cannot be read.
    """
    kind = item["distribution"]
    if not isinstance(kind, str) or kind not in KINDS:
        raise InputError(f"{where}.distribution = {short(kind)}: allowed: {', '.join(map(repr, KINDS))}")
    needed, more = KINDS[kind]
    for key in item.keys() - {"distribution", *needed, *more}:
        allowed = ", ".join((*needed, *more))
        raise InputError(f"{where}.{key}: unknown key of distribution = {kind!r}; allowed: {allowed}")
    for key in needed:
        if key not in item:
            raise InputError(f"{where}.{key}: missing; distribution = {kind!r} has no default for it")
    if kind == "file":
        return _measured(item, where, folder)
    given = {key: _number(item[key], f"{where}.{key}") for key in (*needed, *more) if key in item}
    low, high = given.get("from", -math.inf), given.get("to", math.inf)
    if not low < high:
        raise InputError(f"{where}: from = {low:g}, to = {high:g}: allowed: from < to")
    if kind == "normal":
        if not given["std"] > 0.0:
            raise InputError(f"{where}.std = {given['std']:g}: allowed: > 0")
        return NormalNumbers(given["mean"], given["std"], low, high)
    if kind == "log_uniform" and not low > 0.0:
        raise InputError(f"{where}.from = {low:g}: allowed with distribution = 'log_uniform': > 0")
    return Range(Decimal(item["from"]), Decimal(item["to"]), scale="log" if kind == "log_uniform" else "linear")


def _number(item: Any, where: str) -> float:
    if isinstance(item, bool) or not isinstance(item, (int, Decimal)) or not math.isfinite(item):
        raise InputError(f"{where} = {short(item)}: allowed: a number")
    return float(item)


def _measured(item: Mapping[str, Any], where: str, folder: Path) -> MeasuredNumbers:
    """Numbers of a column of a CSV file, whose first line names the columns."""
    file, column = item["file"], item.get("column")
    if not isinstance(file, str) or not file:
        raise InputError(f"{where}.file = {short(file)}: allowed: the name of a CSV file")
    path = folder / file
    with path.open(encoding="utf-8-sig", newline="") as opened:
        rows = [row for row in csv.reader(opened) if any(cell.strip() for cell in row)]
    head = [cell.strip() for cell in rows[0]] if rows else []
    if column is None and len(head) == 1:
        column = head[0]
    if column not in head:
        raise InputError(f"{where}.column = {short(column)}: allowed: a column of {path}: {', '.join(head)}")
    try:
        values = sorted(float(row[head.index(column)]) for row in rows[1:])
    except (ValueError, IndexError):
        raise InputError(f"{path}: column {column!r}: allowed: a number in every line") from None
    if len(values) < 2 or not all(map(math.isfinite, values)):
        raise InputError(f"{path}: column {column!r}: {len(values)} numbers; allowed: two or more, all finite")
    return MeasuredNumbers(tuple(values))
