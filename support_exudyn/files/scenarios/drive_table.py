"""Displacements over time from CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Literal, NamedTuple

from support_exudyn.files.toml.faults import nearest
from support_exudyn.files.whole_file import contents
from support_exudyn.model.drives.table_drive import MOST_POINTS, TableDrive
from user_forces.values.units import Metres, Radians, Seconds, Unit
from user_forces.values.value import LARGEST, InputError, short

TIME: Unit = Seconds[float].__metadata__[0]  # type: ignore[attr-defined]
LENGTH: Unit = Metres[float].__metadata__[0]  # type: ignore[attr-defined]
ANGLE: Unit = Radians[float].__metadata__[0]  # type: ignore[attr-defined]
SEPARATORS = {";": "semicolons", "\t": "tabs"}  # of other tables
LONGEST_NUMBER = 100  # characters
LARGEST_FILE = 200_000_000  # bytes
MOST_ITEMS = 20 * MOST_POINTS


Turns = Callable[[str], bool | None]


class _Column(NamedTuple):
    """name: without unit. title: as the file has it. place: which of a line."""

    name: str
    title: str
    unit: Unit
    ending: str
    place: int


def read_drives(
    path: Path, between: Literal["smooth", "linear"] = TableDrive.between, turns: Turns | None = None
) -> dict[str, TableDrive]:
    """The drives of a CSV file by the names of its columns.

    The first line names the columns with their units: one `time_s` or `time_ms`, the others NAME_mm, NAME_m,
    or for cranks NAME_deg, NAME_rad. Every further line is a point; numbers have a point for the
    decimals and are separated by commas. turns: of a name, whether it has to be an angle; None: it may be.

    Raises InputError that names file, line and column; OSError if the file cannot be read.
    """
    lines = _lines(path)
    if not lines:
        raise InputError(f"{path}: is empty; allowed: a first line such as time_s,extension_mm, and numbers")
    number, header = lines[0]
    if not _is_header(header):  # whatever file it is: nothing in it is repeated
        raise InputError(
            f"{path}: line {number}: names no time; allowed: a first line such as time_s,extension_mm"
            f"{_hint(lines)}"
        )
    columns = [_column(title, n, f"{path}: line {number}") for n, title in enumerate(header)]
    names = [one.name for one in columns]
    for one in columns:
        _check_unit(one, None if turns is None else turns(one.name), f"{path}: line {number}")
    if len(set(names)) < len(names) or names.count("time") != 1 or len(names) < 2:
        raise InputError(
            f"{path}: line {number}: {short(','.join(header))}: allowed: one time_s or time_ms, and a name "
            f"with unit for each other column, all different{_hint(lines)}"
        )
    if len(lines) - 1 > MOST_POINTS:
        raise InputError(f"{path}: has {len(lines) - 1} points; allowed: up to {MOST_POINTS}")
    for at, line in lines[1:]:
        if len(line) != len(columns):
            raise InputError(
                f"{path}: line {at}: has {len(line)} items; allowed: {len(columns)}, as the first line "
                "(decimals have a point, 12.5)"
            )
    values = {one.name: _values(lines[1:], one, path) for one in columns}
    times = values.pop("time")
    _check_times(times, lines[1:], columns[names.index("time")], path)
    at, line = lines[1]
    for one in columns:
        if one.name != "time" and values[one.name][0] != 0.0:
            raise InputError(
                f"{path}: line {at}, column {one.title}: {line[one.place]}: allowed: 0, for extension "
                "counts from the start posture"
            )
    return {
        name: _drive(times, found, between, f"{path}: column {columns[names.index(name)].title}")
        for name, found in values.items()
    }


def one_drive(
    path: Path, column: str | None, between: Literal["smooth", "linear"], turning: bool | None = None
) -> TableDrive:
    """The drive of a column of a file, or of the only one that it has. Raises as `read_drives` does.

    turning: whether it has to be an angle; None: it may be.
    """
    drives = read_drives(path, between, lambda name: turning if column in (None, name) else None)
    if column is None and len(drives) == 1:
        return next(iter(drives.values()))
    if column is None:
        raise InputError(
            f"{path}: has {len(drives)} columns; say which by column; allowed: {', '.join(drives)}"
        )
    if column not in drives:
        raise InputError(f"{path}: column = {short(column)}: no such column; {nearest(column, drives)}")
    return drives[column]


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """The lines of a file that are not empty, each with its number and its items."""
    found, items = [], 0
    try:
        reader = csv.reader(io.StringIO(contents(path, LARGEST_FILE).decode("utf-8-sig"), newline=""))
        for line in reader:
            items += len(line)
            if items > MOST_ITEMS:
                raise InputError(
                    f"{path}: line {reader.line_num}: the file has too many items; allowed: {MOST_ITEMS}"
                )
            if any(line):
                found.append((reader.line_num, [item.strip() for item in line]))
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: byte {error.start} is not UTF-8; allowed: text in UTF-8") from None
    except csv.Error as error:
        raise InputError(f"{path}: {error}; allowed: numbers separated by commas") from None
    return found


def _is_header(titles: Sequence[str]) -> bool:
    """Whether a line is meant for one that names columns."""
    endings = tuple(f"_{ending}" for unit in (TIME, LENGTH, ANGLE) for ending in unit.endings)
    return any(title.partition("_")[0] == "time" for title in titles) or all(
        title.endswith(endings) for title in titles
    )


def _column(title: str, place: int, where: str) -> _Column:
    name, _, ending = title.rpartition("_")
    units = (TIME,) if name == "time" else (LENGTH, ANGLE)
    for unit in units:
        if name and ending in unit.endings:
            return _Column(name, title, unit, ending, place)
    allowed = [f"_{ending}" for unit in units for ending in unit.endings]
    raise InputError(
        f"{where}: column {place + 1} = {short(title)}: has no unit at its end; allowed: time_s or time_ms, "
        f"and names that end by {', '.join(allowed)}"
    )


def _hint(lines: Sequence[tuple[int, list[str]]]) -> str:
    """What may be wrong with a first line that is no list of columns."""
    other = next((said for sign, said in SEPARATORS.items() if any(sign in item for item in lines[0][1])), "")
    return f"; they are separated by commas, not by {other}, and decimals have a point" if other else ""


def _check_unit(column: _Column, turning: bool | None, where: str) -> None:
    """Raise InputError if a column is an angle where a length is wanted, or the other way round."""
    if column.name == "time" or turning is None or turning is (column.unit is ANGLE):
        return
    driven, unit = ("cranks turn", ANGLE) if turning else ("columns of machines extend", LENGTH)
    raise InputError(
        f"{where}: column {column.place + 1} = {short(column.title)}: {driven}; allowed: names that end by "
        f"{', '.join(f'_{ending}' for ending in unit.endings)}"
    )


def _values(lines: Sequence[tuple[int, list[str]]], column: _Column, path: Path) -> tuple[float, ...]:
    return tuple(_number(line[column.place], column, f"{path}: line {at}") for at, line in lines)


def _number(text: str, column: _Column, where: str) -> float:
    """A number in SI, rounded once."""
    try:
        written = Decimal(text) if 0 < len(text) <= LONGEST_NUMBER else Decimal("nan")
    except InvalidOperation:
        written = Decimal("nan")
    if not written.is_finite() or abs(written.adjusted()) > 300:
        raise InputError(f"{where}, column {column.title}: {short(text)}: allowed: a number such as 12.5")
    number = column.unit.read(written, column.ending)
    if abs(number) > LARGEST:
        raise InputError(f"{where}, column {column.title}: {short(text)}: allowed: up to {LARGEST:g} in SI")
    return number


def _check_times(
    times: Sequence[float], lines: Sequence[tuple[int, list[str]]], column: _Column, path: Path
) -> None:
    if len(times) < 2:
        raise InputError(f"{path}: has {len(times)} points; allowed: two at least")
    before = -1.0
    for n, (time, (at, line)) in enumerate(zip(times, lines, strict=True)):
        if time <= before or time < 0.0:
            least = f"> {lines[n - 1][1][column.place]}, the time before" if n else ">= 0"
            raise InputError(
                f"{path}: line {at}, column {column.title}: {line[column.place]}: allowed: {least}"
            )
        before = time


def _drive(
    times: tuple[float, ...], extensions: tuple[float, ...], between: Literal["smooth", "linear"], where: str
) -> TableDrive:
    try:
        return TableDrive(times=times, extensions=extensions, between=between)
    except InputError as error:
        text = str(error).removeprefix("TableDrive").lstrip(".: ")
        raise InputError(f"{where}: {text}") from None
