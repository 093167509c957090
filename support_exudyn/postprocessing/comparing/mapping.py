"""What a user states of a comparison: which column of which file is which channel, and what is allowed.

The file of a comparison, compare.toml, names columns, units, shifts and tolerances; a command line names
tolerances alone.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Literal

import numpy as np

from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.units import converted, is_unit
from support_exudyn.files.toml.faults import Faults, Place, nearest
from support_exudyn.files.toml.reading import Reader
from support_exudyn.files.toml.shapes import GroupShape
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import missing_file
from support_exudyn.postprocessing.figures.selection import is_called
from user_forces.values.units import Seconds
from user_forces.values.value import InputError, Real, Value, short, value

WRITTEN = re.compile(r"\s*([+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*")
PERCENT = "%"
ALLOWED = "allowed: a share of the reference's range, '2 %', or an amount with its unit, '0.1 mm'"


@dataclass(frozen=True)
class Tolerance:
    """A tolerance bounds how much the channels that a pattern matches may differ.

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
        """The amount that is allowed of a channel.

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
    """A tolerance as people write it. Raises InputError if the text is none."""
    parts = WRITTEN.fullmatch(text)
    amount = float(parts[1]) if parts else math.nan
    if not pattern.strip() or parts is None or not parts[2] or not math.isfinite(amount):
        raise InputError(f"{short(pattern)} = {short(text)}: {ALLOWED}")
    return Tolerance(pattern.strip(), text.strip(), amount, parts[2])


def read_tolerances(text: str) -> list[Tolerance]:
    """The tolerances of a command line, 'pin.*.force=2%,tip.*=0.1mm'. Raises InputError if it holds none."""
    tolerances = []
    for part in filter(str.strip, text.split(",")):
        pattern, sign, amount = part.rpartition("=")
        if not sign:
            raise InputError(f"{short(part.strip())}: allowed: CHANNEL=AMOUNT, such as 'tip.*=0.1mm'")
        tolerances.append(tolerance(pattern, amount))
    if not tolerances:
        raise InputError(f"{short(text)}: allowed: CHANNEL=AMOUNT, such as 'pin.*.force=2%,tip.*=0.1mm'")
    return tolerances


def of_channel(tolerances: Sequence[Tolerance], channel: str) -> Tolerance | None:
    """The first tolerance whose pattern matches a channel; None if none does."""
    return next((each for each in tolerances if is_called(channel, each.pattern)), None)


# --- the file ---


@value
class MappedColumn(Value):
    """The column of a file that is a channel: the channel is sign times the column, plus the offset.

    Arguments:
        column: its name in the file, without unit.
        sign: -1 where the file counts the other way.
        offset: is added, in the unit of the column.
    """

    column: str
    sign: Literal[1, -1] = 1
    offset: Real = 0.0


@value
class MappedFile(Value):
    """What a mapping states of a file.

    Arguments:
        columns: channels, each with the column that it is; the column's name alone will do.
        units: of columns for which this file names none, by names or patterns of them.
        shift: is added to the times of the file [s].
        analysis: which of its analyses is read, where the file has several.
    """

    columns: Mapping[str, MappedColumn] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    shift: Seconds[Real] = 0.0
    analysis: str | None = None


@value
class CompareFile(Value):
    """The file of a comparison.

    Arguments:
        files: by their names, or patterns of them as in a shell, such as "measured*.csv".
        tolerances: of channels, by names or patterns: "2 %" of the range of the reference, or "0.1 mm".
    """

    files: Mapping[str, MappedFile] = field(default_factory=dict)
    tolerances: Mapping[str, str] = field(default_factory=dict)

    def of(self, path: Path) -> MappedFile:
        """The first entry whose name or pattern fits a file."""
        return next((each for name, each in self.files.items() if fits(path, name)), MappedFile())


def fits(path: Path, name: str) -> bool:
    """Whether a file is called so: by its name, its path, or a pattern of one of them."""
    return any(fnmatchcase(own, name) or own == name for own in (path.name, path.as_posix(), str(path)))


def read_compare_file(path: Path, files: Iterable[Path]) -> CompareFile:
    """The contents of a compare.toml for the files that are compared.

    Raises InputError with a line for all that is wrong: file, key, value, what is allowed; OSError if it cannot
    be read.
    """
    try:
        table = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of a comparison") from error
    faults = Faults(str(path))
    reader = Reader(faults, {MappedColumn: _named_alone})
    read = reader.item({"group": GroupShape((CompareFile,))}, table, ())
    given = list(files)
    for name, item in _items(table, "files"):
        if not any(fits(file, name) for file in given):
            names = list(dict.fromkeys(file.name for file in given))
            faults.add(("files", name), f"no file of this name is compared; {nearest(name, names)}")
        for column, text in _items(item, "units"):
            if isinstance(text, str) and not is_unit(text):
                allowed = 'a unit such as "mm", "kN", "deg" or "m/s^2"; "1" of none'
                faults.wrong(("files", name, "units", column), text, allowed)
    for pattern, text in _items(table, "tolerances"):
        if isinstance(text, str):
            try:
                tolerance(pattern, text)
            except InputError as error:
                faults.add(("tolerances",), str(error))
    faults.check()
    assert isinstance(read, CompareFile)
    return read


def tolerances_of(file: CompareFile) -> list[Tolerance]:
    """The tolerances of a file, in its order."""
    return [tolerance(pattern, text) for pattern, text in file.tolerances.items()]


def _named_alone(reader: Reader, item: Any, place: Place) -> MappedColumn | None:
    """The short form of a column: its name."""
    return MappedColumn(column=item) if isinstance(item, str) else None


def _items(table: Any, key: str) -> Iterable[tuple[str, Any]]:
    """Keys and values of a table in a table; none if there is no such table."""
    inner = table.get(key) if isinstance(table, dict) else None
    return inner.items() if isinstance(inner, dict) else ()
