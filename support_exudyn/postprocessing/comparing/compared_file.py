"""A file that is compared: a run with its numerical errors, or series of another program or a measurement."""

from __future__ import annotations

import glob
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path

import numpy as np

from support_exudyn.files.series.named_series import Progress, SeriesFile, silent
from support_exudyn.files.series.own_runs import is_run
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import scaled, unit_checked
from support_exudyn.files.toml.faults import nearest
from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn
from support_exudyn.postprocessing.comparing.mapping import MappedFile
from support_exudyn.postprocessing.comparing.with_errors import recorded_columns
from support_exudyn.postprocessing.figures.units import QUANTITIES
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

ENDING = ".h5"  # of runs
HEAD = 64  # bytes by which a run is recognised
WORK = re.compile(r"joule|J|Wh")  # of a work and a moment, which have one unit, the words decide


@dataclass(frozen=True)
class ComparedFile:
    """A file that is compared.

    name: by which tables and figures call it. path: of it. kind: of file, in words.
    columns: by the names of channels, at shifted times: those that are mapped first.
    run: with its errors, if it is a run of this program. mapped: the columns of channels that a mapping names.
    shift: was added to the times [s]. notes: what a reader of the numbers has to know.
    """

    name: str
    path: Path
    kind: str
    columns: Mapping[str, ComparedColumn]
    run: Result | None = None
    mapped: Mapping[str, str] = field(default_factory=dict)
    shift: float = 0.0
    notes: tuple[str, ...] = ()

    @property
    def has_errors(self) -> bool:
        """Whether its numerical errors are known."""
        return self.run is not None and self.run.coarser is not None

    @property
    def horizon(self) -> float:
        """The time from which on shorter steps change its impacts [s]; infinite if none is known."""
        return self.run.horizon + self.shift if self.run is not None and self.has_errors else math.inf

    def mean(self, channel: str, unit: str, after: float, until: float) -> Estimate | None:
        """The mean of a channel over time with its error, from every step of a run between two times [s].

        None if this is no run, or has the channel mapped or in another unit.
        """
        run, ends = self.run, (channel, after - self.shift, until - self.shift)
        if run is None or channel in self.mapped or self.columns[channel].unit != unit:
            return None
        window = run.window(*ends)
        error = run.estimate(lambda run: run.window(*ends).mean).error if self.has_errors else math.nan
        return Estimate(window.mean, error + window.mean_doubt, unit)

    def shifted(self, seconds: float) -> ComparedFile:
        """The file with a time [s] added to all of its times."""
        columns = {name: one._replace(time=one.time + seconds) for name, one in self.columns.items()}
        return replace(self, columns=columns, shift=self.shift + seconds)


def run_or_series(
    path: Path, mapped: MappedFile | None = None, names: Sequence[str] = (), progress: Progress = silent
) -> Result | SeriesFile:
    """The contents of a file: a run of this program with its errors, or the series of any other.

    Raises InputError if it cannot be read; OSError if it is not there.
    """
    if not path.is_file():
        is_own = path.suffix.lower() == ENDING
    else:
        with path.open("rb") as file:
            is_own = is_run(file.read(HEAD))
    if is_own:
        return Result.load(path)
    mapped = mapped or MappedFile()
    return read_series(path, units=mapped.units, analysis=mapped.analysis, names=names, progress=progress)


def compared_file(
    path: Path,
    mapped: MappedFile,
    name: str = "",
    channels: Sequence[str] = (),
    progress: Progress = silent,
) -> ComparedFile:
    """Read a file that is compared.

    Arguments:
        path: of a run, or of whatever `read_series` reads.
        mapped: what a mapping states of its columns.
        name: by which tables and figures call it; its file name if it is empty.
        channels: patterns of those that are wanted, all if there are none: others take no memory.
        progress: receives the share that is read.

    Raises InputError if it cannot be read, or lacks a column that `mapped` names; OSError if it is not there.
    """
    columns = [glob.escape(column.column) for column in mapped.columns.values()]  # needed, wanted or not
    names = [*channels, *columns] if channels else []
    try:
        read = run_or_series(path, mapped, names, progress)
    except InputError:
        if not names:
            raise
        read = run_or_series(path, mapped, (), progress)  # all, so that an error can name the columns
    if isinstance(read, Result):
        return _mapped(of_run(read, path, name or path.name), mapped)
    series = {column: ComparedColumn.of_series(one) for column, one in read.series.items()}
    return _mapped(ComparedFile(name or path.name, path, read.kind, series, notes=read.notes), mapped)


def of_run(run: Result, path: Path, name: str) -> ComparedFile:
    """A run as a file that is compared."""
    return ComparedFile(name, path, "run of this program", recorded_columns(run), run)


def _mapped(file: ComparedFile, mapped: MappedFile) -> ComparedFile:
    """The file with the channels of a mapping, which take the place of the columns of others' files."""
    lacking = [
        f"{file.path}: has no column {one.column!r}, which is to be {channel}; "
        f"{nearest(one.column, list(file.columns))}"
        for channel, one in mapped.columns.items()
        if one.column not in file.columns
    ]
    if lacking:
        raise InputError("\n".join(lacking))
    sources = {channel: one.column for channel, one in mapped.columns.items()}
    columns = {}
    for channel, one in mapped.columns.items():
        column = file.columns[one.column]
        columns[channel] = column._replace(values=one.sign * column.values + one.offset)
    for name, column in file.columns.items():
        if file.run is not None or name not in sources.values():
            columns.setdefault(name, column)
    return replace(file, columns=columns, mapped=sources).shifted(mapped.shift)


# --- the unit in SI in which a quantity is compared ---


def channel_unit(reference: ComparedFile, other: ComparedFile, channel: str) -> str:
    """The unit in which a channel is compared: that of a run, else the SI unit of what the files name.

    Raises InputError if a file names none, or if both are of two kinds.
    """
    files, units = (reference, other), []
    for file in files:
        if (unit := file.columns[channel].unit) is None:
            column = file.mapped.get(channel, channel)
            raise InputError(
                f"{file.path}: {column}: its file gives no unit; allowed: one in the column's title, such as "
                f'\'{column} [mm]\', or in compare.toml, [files."{file.path.name}".units] "{column}" = "mm"'
            )
        units.append(unit)
    runs = [unit for file, unit in zip(files, units, strict=True) if file.run is not None]
    for unit in runs[:1] or [_si_unit(unit) for unit in units]:  # g may be of an acceleration, not where kg are
        if all(_of_a_kind(each, unit) for each in units):
            return unit
    mine, its = (unit or "pure numbers" for unit in units)
    raise InputError(
        f"{channel}: is in {mine} in {reference.name}, and in {its} in {other.name}; allowed: units of one kind"
    )


@cache
def _si_unit(unit: str) -> str:
    """The SI unit of the kind of a unit: "N" of kN, "m" of inch; the unit itself if no channel is of its kind.

    Raises InputError if it is no unit.
    """
    unit_checked(unit, "unit")
    kinds = [each for each in QUANTITIES if _of_a_kind(unit, each)]
    return "J" if "J" in kinds and WORK.search(unit) else next(iter(kinds), unit)


@cache
def _of_a_kind(first: str, second: str) -> bool:
    """Whether quantities in the first unit can be given in the second."""
    try:
        scaled(np.ones(1), first, second, "unit")
    except InputError:
        return False
    return True
