"""The file of a comparison, compare.toml: which column of which file is which channel, and what is allowed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from support_exudyn.files.series.units import is_unit, scaled
from support_exudyn.files.toml.faults import Faults, Place
from support_exudyn.files.toml.reading import Reader, read_value
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import missing_file
from user_forces.values.names import nearest
from user_forces.values.units import Hertz, Seconds
from user_forces.values.value import InputError, Positive, Real, Value, short, value

WRITTEN = re.compile(r"\s*([+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*?)?\s*")
PERCENT, ERRORS = "%", "errors"


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
        sheet: which of its sheets, of a workbook.
        rate: rows per second of a file without times [Hz], > 0.
    """

    columns: Mapping[str, MappedColumn] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    shift: Seconds[Real] = 0.0
    analysis: str | None = None
    sheet: str | None = None
    rate: Hertz[Positive] | None = None


@value
class CompareFile(Value):
    """The file of a comparison.

    Arguments:
        files: by their names, or patterns of them as in a shell, such as "measured*.csv".
        tolerances: of channels, by names or patterns: "2 %" of the range of the reference, or "0.1 mm".
        rate: of files without times for which none is given, rows per second [Hz], > 0.
    """

    files: Mapping[str, MappedFile] = field(default_factory=dict)
    tolerances: Mapping[str, str] = field(default_factory=dict)
    rate: Hertz[Positive] | None = None

    def of(self, path: Path) -> MappedFile:
        """The first entry whose name or pattern fits a file."""
        entry = next((each for name, each in self.files.items() if _fits(path, name)), MappedFile())
        return entry if entry.rate else replace(entry, rate=self.rate)


def _fits(path: Path, name: str) -> bool:
    """Whether a file is called so: by its name, its path, or a pattern of one of them."""
    return any(fnmatchcase(own, name) or own == name for own in (path.name, path.as_posix(), str(path)))


def read_compare_file(path: Path, files: Iterable[Path]) -> CompareFile:
    """The contents of a compare.toml for the files that are compared.

    Raises InputError with a line for each wrong item: file, key, value, what is allowed; OSError if it cannot
    be read.
    """

    def name_alone(reader: Reader, item: Any, place: Place) -> MappedColumn | None:
        return MappedColumn(column=item) if isinstance(item, str) else None

    try:
        table = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of a comparison") from error
    file = read_value(CompareFile, table, str(path), {MappedColumn: name_alone})
    faults, compared = Faults(str(path)), list(files)
    for name, mapped in file.files.items():
        if not any(_fits(each, name) for each in compared):
            names = list(dict.fromkeys(each.name for each in compared))
            faults.add(("files", name), f"no file of this name is compared; {nearest(name, names)}")
        for column, unit in mapped.units.items():
            if not is_unit(unit):
                allowed = 'a unit such as "mm", "kN", "deg" or "m/s^2"; "1" of none'
                faults.wrong(("files", name, "units", column), unit, allowed)
    faults.check()
    try:
        tolerances_of(file)
    except InputError as error:
        raise InputError(f"{path}: tolerances: {error}") from None
    return file


# --- tolerances ---


class Tolerance(NamedTuple):
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

    def in_si(self, channel: str, unit: str, extent: float) -> float:
        """The amount that is allowed of a channel in SI; NaN if the errors are allowed.

        Arguments:
            channel: its name. unit: of it, in SI.
            extent: the range of the reference: its largest less its least value, in SI.

        Raises InputError if it is an amount of another kind.
        """
        if self.unit in (PERCENT, ERRORS):
            return self.amount / 100.0 * extent
        return float(scaled(np.array([self.amount]), self.unit, unit, f"tolerance of {channel}")[0])


BOTH_ERRORS = Tolerance("*", "both errors", math.nan, ERRORS)


def tolerance(pattern: str, text: str) -> Tolerance:
    """A tolerance as people write it. Raises InputError if the text is none."""
    parts = WRITTEN.fullmatch(text)
    amount = float(parts[1]) if parts else math.nan
    if not pattern.strip() or parts is None or not parts[2] or not math.isfinite(amount):
        allowed = "a share of the reference's range, '2 %', or an amount with its unit, '0.1 mm'"
        raise InputError(f"{short(pattern)} = {short(text)}: allowed: {allowed}")
    return Tolerance(pattern.strip(), text.strip(), amount, parts[2])


def read_tolerances(text: str) -> list[Tolerance]:
    """The tolerances of a command line, 'pin.*.force=2%,tip.*=0.1mm'. Raises InputError if it holds none."""
    parts = [part.rpartition("=") for part in text.split(",") if part.strip()]
    if not parts or not all(sign for _, sign, _ in parts):
        raise InputError(f"{short(text)}: allowed: CHANNEL=AMOUNT, such as 'pin.*.force=2%,tip.*=0.1mm'")
    return [tolerance(pattern, amount) for pattern, _, amount in parts]


def tolerances_of(file: CompareFile) -> list[Tolerance]:
    """The tolerances of a file, in its order. Raises InputError if one is none."""
    return [tolerance(pattern, text) for pattern, text in file.tolerances.items()]
