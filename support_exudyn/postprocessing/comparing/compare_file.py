"""The file of a comparison, compare.toml: which column of which file is which channel, and what is allowed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Literal

from pydantic import model_validator

from support_exudyn.files.series.units import is_unit
from support_exudyn.files.toml.faults import Faults, Place, nearest
from support_exudyn.files.toml.reading import Reader
from support_exudyn.files.toml.shapes import GroupShape
from support_exudyn.files.toml.text import load_toml
from support_exudyn.files.whole_file import missing_file
from support_exudyn.postprocessing.comparing.tolerances import Tolerance, tolerance
from user_forces.values.units import Hertz, Seconds
from user_forces.values.value import InputError, NonNegative, Real, Value, value


@value
class MappedColumn(Value):
    """The column of a file that is a channel: the channel is sign times the column, plus the offset.

    Arguments:
        column: its name in the file, without unit.
        sign: -1 where the file counts the other way.
        offset: what is added, in the unit of the column.
    """

    column: str
    sign: Literal[1, -1] = 1
    offset: Real = 0.0


@value
class MappedFile(Value):
    """What is said of a file.

    Arguments:
        columns: channels, each with the column that it is; the column's name alone will do.
        units: of columns for which this file names none, by names or patterns of them; before those for all.
        shift: what is added to the times of the file [s].
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
        units: of columns for which any of the files names none, by names or patterns of them: "Force" = "kN".
        tolerances: of channels, by names or patterns: "2 %" of the range of the reference, or "0.1 mm".
        bands: edges of the bands in which spectra are compared [Hz], increasing.
        confirmed: false in what `--propose` has written, until somebody has looked at it.
    """

    files: Mapping[str, MappedFile] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    tolerances: Mapping[str, str] = field(default_factory=dict)
    bands: Hertz[tuple[NonNegative, ...]] = ()
    confirmed: bool = True

    @model_validator(mode="after")
    def _bands_increase(self) -> CompareFile:
        if len(self.bands) == 1 or any(b <= a for a, b in zip(self.bands, self.bands[1:], strict=False)):
            raise ValueError(f"bands = {list(self.bands)} Hz: allowed: two edges or more that increase")
        return self

    def of(self, path: Path) -> MappedFile:
        """What is said of a file, by the first name or pattern that fits it; with the units of all files."""
        found = next((one for name, one in self.files.items() if fits(path, name)), MappedFile())
        return replace(
            found, units={**found.units, **{k: v for k, v in self.units.items() if k not in found.units}}
        )


def fits(path: Path, name: str) -> bool:
    """Whether a file is called so: by its name, its path, or a pattern of one of them."""
    return any(fnmatchcase(one, name) or one == name for one in (path.name, path.as_posix(), str(path)))


def read_compare_file(path: Path, files: Iterable[Path]) -> CompareFile:
    """What a compare.toml says of the files that are compared.

    Raises InputError with a line for all that is wrong: file, key, value, what is allowed; OSError if it cannot
    be read.
    """
    try:
        table = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of a comparison") from error
    faults = Faults(str(path))
    reader = Reader(faults, {MappedColumn: _named_alone})
    found = reader.item({"group": GroupShape((CompareFile,))}, table, ())
    given = list(files)
    named = table.get("files")
    for name, item in named.items() if isinstance(named, dict) else ():
        if not any(fits(one, name) for one in given):
            faults.add(("files", name), f"no file of this name is compared; {nearest(name, _names(given))}")
        _check_units(item, ("files", name), faults)
    _check_units(table, (), faults)
    tolerances = table.get("tolerances")
    for pattern, text in tolerances.items() if isinstance(tolerances, dict) else ():
        if isinstance(text, str) and (said := _no_tolerance(pattern, text)):
            faults.add(("tolerances",), said)
    if table.get("confirmed") is False:
        faults.wrong(("confirmed",), False, "true, once somebody has looked whether the proposals are right")
    faults.check()
    assert isinstance(found, CompareFile)
    return found


def tolerances_of(file: CompareFile) -> list[Tolerance]:
    """The tolerances of a file, in its order."""
    return [tolerance(pattern, text) for pattern, text in file.tolerances.items()]


def _no_tolerance(pattern: str, text: str) -> str:
    """Why a text is no tolerance; empty if it is one."""
    try:
        tolerance(pattern, text)
    except InputError as error:
        return str(error)
    return ""


def _named_alone(reader: Reader, item: Any, place: Place) -> MappedColumn | None:
    """The short form of a column: its name."""
    return MappedColumn(column=item) if isinstance(item, str) else None


def _names(paths: Iterable[Path]) -> list[str]:
    return list(dict.fromkeys(path.name for path in paths))


def _check_units(table: Any, place: Place, faults: Faults) -> None:
    """Note what is no unit, also what a proposal has left open."""
    units = table.get("units") if isinstance(table, dict) else None
    for name, text in units.items() if isinstance(units, dict) else ():
        if isinstance(text, str) and not is_unit(text):
            faults.wrong(
                (*place, "units", name), text, 'a unit such as "mm", "kN", "deg" or "m/s^2"; "1" of none'
            )
