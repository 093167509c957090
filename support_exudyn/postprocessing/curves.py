"""Curves from CSV, measured or of another program, to be drawn beside a run's."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from support_exudyn.files.whole_file import contents
from support_exudyn.mechanics.trajectory import Series
from user_forces.values import units
from user_forces.values.value import InputError, short

SEPARATORS = {";": "';'", "\t": "tab"}  # of other tables
LARGEST = 200_000_000  # bytes
UNITS = {
    "s": units.Seconds, "m": units.Metres, "m/s": units.MetresPerSecond, "m/s^2": units.MetresPerSecondSquared,
    "N": units.Newtons, "rad": units.Radians, "rad/s": units.RadiansPerSecond, "Pa": units.Pascals,
    "m^3/s": units.CubicMetresPerSecond,
}  # fmt: skip


@dataclass(frozen=True)
class Curves:
    """Columns of a CSV file by their titles, each of as many numbers, NaN where there is none."""

    path: Path
    columns: Mapping[str, Series]

    def of(self, channel: str, unit: str) -> Series | None:
        """The column of a channel of this unit in SI: NAME_mm or NAME [mm]; None if there is none."""
        for title, values in self.columns.items():
            name, _, ending = title.partition(" [") if title.endswith("]") else title.rpartition("_")
            for one, scale in _endings(unit).items():
                if title in (f"{channel}_{one}", f"{channel} [{one}]") or (
                    name == channel and _written(ending.rstrip("]")) == one
                ):
                    return values * scale
        return None

    @property
    def time(self) -> Series:
        """The times [s]. Raises InputError if there are none, or if they do not increase."""
        found = self.of("time", "s")
        if found is None:
            raise InputError(f"{self.path}: has no times; allowed: a column time_s, time_ms or time [s]")
        if not (np.isfinite(found).all() and (np.diff(found) > 0.0).all()):
            raise InputError(f"{self.path}: time: allowed: numbers that increase")
        return found


def _endings(unit: str) -> dict[str, float]:
    """Endings of titles for a unit, and what one of each is in SI."""
    found = {_written(unit): 1.0}
    for kind in (UNITS[unit],) if unit in UNITS else ():
        written: units.Unit = kind[float].__metadata__[0]
        found |= {ending: float(scale) for ending, scale in written.endings.items()}
    return found | ({"deg_per_s2": math.pi / 180.0} if unit == "rad/s^2" else {})


def _written(unit: str) -> str:
    return unit.replace("/", "_per_").replace("^", "").replace("²", "2")


def _number(cell: str, where: str) -> float:
    try:
        return float(cell) if cell.strip() else math.nan
    except ValueError:
        raise InputError(f"{where}: {short(cell)}: allowed: a number such as 12.5") from None


def _check_separator(path: Path, title: str) -> None:
    """Raise InputError for a first line that something else than commas separates."""
    for sign, said in SEPARATORS.items():
        if sign in title:
            raise InputError(
                f"{path}: line 1: separator {said} found; allowed: commas between items, and decimals with a "
                "point, 12.5"
            )


def read_curves(path: Path) -> Curves:
    """The curves of a CSV file: a line of titles with units, such as `time_s,tip.x_mm`, then numbers.

    What `export --to csv` writes is one. Raises InputError for what is no such table; OSError if it cannot be
    read.
    """
    try:
        text = contents(path, LARGEST).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(f"{path}: is no text; allowed: CSV in UTF-8") from None
    rows = [row for row in csv.reader(io.StringIO(text, newline="")) if any(cell.strip() for cell in row)]
    if len(rows) < 2:
        raise InputError(
            f"{path}: is empty; allowed: titles such as time_s,tip.x_mm, and a line of numbers or more"
        )
    titles = [cell.strip() for cell in rows[0]]
    if len(titles) == 1:
        _check_separator(path, titles[0])
    columns: dict[str, list[float]] = {title: [] for title in titles}
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(titles):
            raise InputError(
                f"{path}: line {number}: has {len(row)} items; allowed: {len(titles)}, as the first"
            )
        for title, cell in zip(titles, row, strict=True):
            columns[title].append(_number(cell, f"{path}: line {number}, column {title}"))
    return Curves(path, {title: np.array(values) for title, values in columns.items()})
