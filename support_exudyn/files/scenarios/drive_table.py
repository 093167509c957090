"""Displacements over time from CSV."""

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Literal

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
Line = tuple[int, list[str]]  # its number in the file, its items


@dataclass(frozen=True)
class _FileColumn:
    """A column of a file: its name without unit, the title as it stands there, its unit, its place."""

    name: str
    title: str
    unit: Unit
    ending: str
    place: int

    def number(self, line: Line, path: Path) -> float:
        """The number in a line, in SI, rounded once. Raises InputError if there is none."""
        text = line[1][self.place]
        try:
            written = Decimal(text) if 0 < len(text) <= LONGEST_NUMBER else Decimal("nan")
        except InvalidOperation:
            written = Decimal("nan")
        if not written.is_finite() or abs(written.adjusted()) > 300:
            raise self.refusal(line, path, short(text), "a number such as 12.5")
        number = self.unit.read(written, self.ending)
        if abs(number) > LARGEST:
            raise self.refusal(line, path, short(text), f"up to {LARGEST:g} in SI")
        return number

    def refusal(self, line: Line, path: Path, said: str, allowed: str) -> InputError:
        """The error that names file, line and column."""
        return InputError(f"{path}: line {line[0]}, column {self.title}: {said}: allowed: {allowed}")


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
    columns = _columns(lines, path, turns)
    if len(lines) - 1 > MOST_POINTS:
        raise InputError(f"{path}: has {len(lines) - 1} points; allowed: up to {MOST_POINTS}")
    for at, line in lines[1:]:
        if len(line) != len(columns):
            raise InputError(
                f"{path}: line {at}: has {len(line)} items; allowed: {len(columns)}, as the first line "
                "(decimals have a point, 12.5)"
            )
    values = {one.name: tuple(one.number(line, path) for line in lines[1:]) for one in columns.values()}
    times = values.pop("time")
    _check_times(times, lines[1:], columns["time"], path)
    for name, found in values.items():
        if found[0] != 0.0:
            said = "0, for extension counts from the start posture"
            raise columns[name].refusal(lines[1], path, lines[1][1][columns[name].place], said)
    return {
        name: _drive(times, found, between, f"{path}: column {columns[name].title}")
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


def _lines(path: Path) -> list[Line]:
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


def _columns(lines: Sequence[Line], path: Path, turns: Turns | None) -> dict[str, _FileColumn]:
    """The columns by name, from the first line."""
    number, titles = lines[0]
    where = f"{path}: line {number}"
    other = next((said for sign, said in SEPARATORS.items() if any(sign in item for item in titles)), "")
    hint = f"; they are separated by commas, not by {other}, and decimals have a point" if other else ""
    endings = tuple(f"_{ending}" for unit in (TIME, LENGTH, ANGLE) for ending in unit.endings)
    named = any(title.partition("_")[0] == "time" for title in titles)
    if not named and not all(title.endswith(endings) for title in titles):
        # whatever file it is: nothing in it is repeated
        raise InputError(f"{where}: names no time; allowed: a first line such as time_s,extension_mm{hint}")
    columns = [_column(title, n, where) for n, title in enumerate(titles)]
    for one in columns:
        turning = None if turns is None or one.name == "time" else turns(one.name)
        if turning is not None and turning is not (one.unit is ANGLE):
            driven, unit = ("cranks turn", ANGLE) if turning else ("linear actuators extend", LENGTH)
            raise InputError(
                f"{where}: column {one.place + 1} = {short(one.title)}: {driven}; allowed: names that end by "
                f"{', '.join(f'_{ending}' for ending in unit.endings)}"
            )
    found = {one.name: one for one in columns}
    if len(found) < len(columns) or "time" not in found or len(found) < 2:
        raise InputError(
            f"{where}: {short(','.join(titles))}: allowed: one time_s or time_ms, and a name "
            f"with unit for each other column, all different{hint}"
        )
    return found


def _column(title: str, place: int, where: str) -> _FileColumn:
    name, _, ending = title.rpartition("_")
    units = (TIME,) if name == "time" else (LENGTH, ANGLE)
    for unit in units:
        if name and ending in unit.endings:
            return _FileColumn(name, title, unit, ending, place)
    allowed = [f"_{ending}" for unit in units for ending in unit.endings]
    raise InputError(
        f"{where}: column {place + 1} = {short(title)}: has no unit at its end; allowed: time_s or time_ms, "
        f"and names that end by {', '.join(allowed)}"
    )


def _check_times(times: Sequence[float], lines: Sequence[Line], column: _FileColumn, path: Path) -> None:
    if len(times) < 2:
        raise InputError(f"{path}: has {len(times)} points; allowed: two at least")
    for n, time in enumerate(times):
        if time < 0.0 or (n and time <= times[n - 1]):
            least = f"> {lines[n - 1][1][column.place]}, the time before" if n else ">= 0"
            raise column.refusal(lines[n], path, lines[n][1][column.place], least)


def _drive(
    times: tuple[float, ...], extensions: tuple[float, ...], between: Literal["smooth", "linear"], where: str
) -> TableDrive:
    try:
        return TableDrive(times=times, extensions=extensions, between=between)
    except InputError as error:
        text = str(error).removeprefix("TableDrive").lstrip(".: ")
        raise InputError(f"{where}: {text}") from None
