"""Displacements over time from tables, for drives."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path
from typing import Literal

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.read import read_series
from support_exudyn.model.drives.table_drive import TableDrive
from user_forces.values.names import nearest
from user_forces.values.units import Metres, Radians, Unit
from user_forces.values.value import InputError, short

LENGTH: Unit = Metres[float].__metadata__[0]  # type: ignore[attr-defined]
ANGLE: Unit = Radians[float].__metadata__[0]  # type: ignore[attr-defined]
UNITS = {  # by whether a driven part turns: its units, and the words for it
    True: ((ANGLE,), "cranks turn; "),
    False: ((LENGTH,), "linear actuators extend; "),
    None: ((LENGTH, ANGLE), ""),
}

Between = Literal["smooth", "linear"]
Turns = Callable[[str], bool | None]


def read_drives(
    path: Path,
    between: Between = TableDrive.between,
    turns: Turns | None = None,
    rate: float | None = None,
) -> dict[str, TableDrive]:
    """The drives of a table by the names of its columns.

    A first line such as `time_s,front_column_mm` names the columns with their units, lengths, or angles for
    cranks; every further line is a point. It is read as any table is, see `read_series`, but its times have to
    increase, and each column has a number at every time, 0 at the first. turns: of a name, whether the driven
    part turns; None: it is not known. rate: samples per second [Hz] of a table without times. What was assumed
    of the table is warned of.

    Raises InputError that names file and column; OSError if the file cannot be read.
    """
    file = read_series(path, rate=rate)
    if file.changes:
        raise InputError(f"{path}: {file.changes[0]} Allowed: increasing times")
    for note in file.notes:
        warnings.warn(f"{path}: {note}", stacklevel=2)
    return {
        name: _drive(path, one, between, None if turns is None else turns(name))
        for name, one in file.series.items()
    }


def one_drive(
    path: Path,
    column: str | None,
    between: Between,
    turning: bool | None = None,
    rate: float | None = None,
) -> TableDrive:
    """The drive of a column of a file, or of the only one that it has. Raises as `read_drives` does.

    turning: whether it has to be an angle; None: it may be. rate: as of `read_drives`.
    """
    drives = read_drives(path, between, lambda name: turning if column in (None, name) else None, rate)
    if column is None and len(drives) == 1:
        return next(iter(drives.values()))
    if column is None:
        raise InputError(
            f"{path}: has {len(drives)} columns; say which by column; allowed: {', '.join(drives)}"
        )
    if column not in drives:
        raise InputError(f"{path}: column = {short(column)}: no such column; {nearest(column, drives)}")
    return drives[column]


def _drive(path: Path, one: NamedSeries, between: Between, turning: bool | None) -> TableDrive:
    where = f"{path}: column {one.name}"
    units, why = UNITS[turning]
    unit = next((unit for unit in units if one.unit in unit.endings), None)
    if unit is None or one.unit is None:
        endings = ", ".join(f"_{ending}" for known in units for ending in known.endings)
        raise InputError(f"{where}: is in {one.unit or 'no unit'}; {why}allowed: titles that end by {endings}")
    for time, number in zip(one.time.tolist(), one.values.tolist(), strict=True):
        if not np.isfinite(number):
            raise InputError(f"{where}: has no number at {time:g} s; allowed: one at every time")
    extensions = tuple(unit.read(Decimal(repr(number)), one.unit) for number in one.values.tolist())
    if extensions[0] != 0.0:
        raise InputError(
            f"{where}: begins with {one.values[0]:g} {one.unit}; allowed: 0, for extension counts from the "
            "start posture"
        )
    try:
        return TableDrive(times=tuple(one.time.tolist()), extensions=extensions, between=between)
    except InputError as error:
        lines = (line.removeprefix("TableDrive").lstrip(".: ") for line in str(error).splitlines())
        raise InputError("\n".join(f"{where}: {line}" for line in lines)) from None
