"""Numbers that are not known exactly: how likely which is, as a sweep's file says it."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fnmatch import fnmatchcase
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.machines.read import read_machine
from support_exudyn.files.scenarios.scenario_file import scenario_file_of
from support_exudyn.sweeps.plan import DIGITS, Range
from user_forces.values.names import nearest
from user_forces.values.sourced import SourcedNumber
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
class Quantiles:
    """Numbers of which some are more likely than others; quantile: gives that which a share of all is below."""

    quantile: Callable[[float], float]

    def at(self, share: float) -> Decimal:
        """The number that a share of all is below, 0 to 1, in twelve digits."""
        number = float(self.quantile(min(max(share, FARTHEST), 1.0 - FARTHEST)))
        return DIGITS.create_decimal_from_float(number).normalize()


def distribution_of(item: Mapping[str, Any], where: str, folder: Path) -> Range | Quantiles:
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
        from scipy.stats import truncnorm  # takes a second, and a grid has no use for it

        mean, std = given["mean"], given["std"]
        return Quantiles(truncnorm((low - mean) / std, (high - mean) / std, loc=mean, scale=std).ppf)
    if kind == "log_uniform" and not low > 0.0:
        raise InputError(f"{where}.from = {low:g}: allowed with distribution = 'log_uniform': > 0")
    return Range(Decimal(item["from"]), Decimal(item["to"]), scale="log" if kind == "log_uniform" else "linear")


def _number(item: Any, where: str) -> float:
    if isinstance(item, bool) or not isinstance(item, (int, Decimal)) or not math.isfinite(item):
        raise InputError(f"{where} = {short(item)}: allowed: a number")
    return float(item)


def _measured(item: Mapping[str, Any], where: str, folder: Path) -> Quantiles:
    """Numbers of a column of a CSV file, whose first line names the columns.

    All are equally likely, and so is all between two neighbours.
    """
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
    return Quantiles(partial(np.quantile, values))


# --- ranges that files state for their numbers, from which a sweep draws ---

MACHINE = "machine"
STATED = "stated range"  # in place of a range: that which the file of scenario or machine states
STRENGTH = "strength"  # section of a machine's file that `stand` alone reads, and no run
RANGED = "{value = 1960, from = 1500, to = 2200}"


def stated_ranges(
    patterns: list[str], method: Any, table: Mapping[str, Any], where: str, folder: Path
) -> dict[str, Range]:
    """The ranges that are stated for numbers, by their keys as far as these fit one of some patterns.

    Numbers of [strength] are left out, for no run depends on them.

    Arguments:
        patterns: as in a shell, at least one.
        method: of the sweep.
        table: of the scenario file. where: what errors call it. folder: from which paths in it go on.

    Raises InputError for another method than a Latin hypercube, and for a pattern that no number fits, or those
    of [strength] alone; OSError if the machine's file cannot be read.
    """
    if method != "latin_hypercube":
        raise InputError(f"vary.{patterns[0]!r} = {STATED!r}: allowed with method = 'latin_hypercube'")
    given = table.get(MACHINE)
    numbers: dict[str, SourcedNumber] = {}
    fault: InputError | None = None
    try:
        scenario_file_of(table, where, folder, numbers)
    except InputError as error:  # also of what is missing because it varies
        fault = error
    if isinstance(given, str):
        numbers |= {f"{MACHINE}.{key}": one for key, one in read_machine(given, folder).sourced.items()}
    ranges = {
        key: Range(one.low, one.high)
        for key, one in numbers.items()
        if one.low is not None and one.high is not None
    }
    drawn = {key: one for key, one in ranges.items() if not key.startswith(f"{MACHINE}.{STRENGTH}.")}
    for pattern in patterns:
        if any(fnmatchcase(key, pattern) for key in drawn):
            continue
        if any(fnmatchcase(key, pattern) for key in ranges):
            raise of_strength(pattern)
        if pattern.startswith(f"{MACHINE}.") and not isinstance(given, str):
            raise InputError(f"vary.{pattern!r} = {STATED!r}: allowed where the machine is named by its file")
        if fault is not None:
            raise fault
        files = f"{where} and {given}" if isinstance(given, str) else where
        raise InputError(
            f"vary.{pattern!r} = {STATED!r}: no range is stated for such a number in {files}; "
            f"{nearest(pattern, drawn)}; a number there states one as {RANGED}"
        )
    return {key: one for key, one in drawn.items() if any(fnmatchcase(key, pattern) for pattern in patterns)}


def of_strength(name: str) -> InputError:
    """The refusal of numbers on which no run depends."""
    return InputError(
        f"vary.{name!r}: no run depends on [{STRENGTH}], which `support-exudyn stand` alone reads; "
        "allowed: other numbers of the machine's file"
    )
