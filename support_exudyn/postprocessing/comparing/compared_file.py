"""A file that is compared: a run with its numerical errors, or series of another program or a measurement."""

from __future__ import annotations

import glob
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial
from pathlib import Path

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.asked import Progress, silent
from support_exudyn.files.series.named_series import NamedSeries
from support_exudyn.files.series.own_runs import is_run
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted, scaled, unit_checked
from support_exudyn.files.toml.faults import nearest
from support_exudyn.postprocessing.comparing.common_times import ComparedColumn
from support_exudyn.postprocessing.comparing.compared_channel import ANGLE, TURN
from support_exudyn.postprocessing.comparing.mapping import MappedColumn, MappedFile
from support_exudyn.postprocessing.comparing.with_errors import curve_errors
from support_exudyn.postprocessing.figures.units import QUANTITIES
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
ENDING = ".h5"  # of runs
HEAD = 64  # bytes by which a run is recognised
ROUNDING = 1e-6  # of a turn, by which a file's digits may leave the range of a wrapped angle
WORK = re.compile(r"joule|J|Wh")  # of a work and a moment, which have one unit, the words decide


@dataclass(frozen=True)
class ComparedFile:
    """A file that is compared.

    name: by which tables and figures call it. path: of it. kind: of file, in words.
    run: with its errors, if it is a run of this program. series: of it, by the names of the file.
    mapped: what a mapping states of its columns; `shift` is added to its times [s].
    notes: what a reader of the numbers has to know.
    """

    name: str
    path: Path
    kind: str
    run: Result | None
    series: Mapping[str, NamedSeries]
    mapped: MappedFile = field(default_factory=MappedFile)
    notes: tuple[str, ...] = ()

    @property
    def has_errors(self) -> bool:
        """Whether its numerical errors are known."""
        return self.run is not None and self.run.coarser is not None

    @property
    def channels(self) -> list[str]:
        """Names of the channels: those that are mapped first, then columns under their own names."""
        return list(dict.fromkeys([*self.mapped.columns, *self.series]))

    @property
    def horizon(self) -> float:
        """The time from which on shorter steps change its impacts [s]; infinite if none is known."""
        return self.run.horizon + self.mapped.shift if self.run is not None and self.has_errors else math.inf

    def mapped_column(self, channel: str) -> MappedColumn:
        """The column that is a channel. Raises InputError if there is none."""
        if column := self.mapped.columns.get(channel):
            return column
        if channel not in self.series:
            raise InputError(
                f"{channel}: {self.name} has no such channel; {nearest(channel, self.channels[:12])}"
            )
        return MappedColumn(column=channel)

    def unit(self, channel: str) -> str | None:
        """Unit of a channel in the file; None if it names none."""
        return self.series[self.mapped_column(channel).column].unit

    def column(self, channel: str, unit: str) -> ComparedColumn:
        """A channel in a unit, at its shifted times, with its numerical errors; wrapped angles are unwrapped.

        Raises InputError if the file's own unit is not known or of another kind.
        """
        mapped = self.mapped_column(channel)
        series = self.series[mapped.column]
        if mapped.sign != 1 or mapped.offset:
            series = replace(series, values=mapped.sign * series.values + mapped.offset)
        try:
            values = series.values if series.unit == unit else converted(series, unit)
        except InputError as error:
            raise InputError(f"{self.path}: {error}") from None
        if unit == ANGLE and self.run is None:
            values = unwrapped(values)
        errors = self._errors.get(mapped.column, np.full(values.size, math.nan))
        return ComparedColumn(unit, series.time + self.mapped.shift, values, errors)

    def mean(self, channel: str, unit: str, after: float, until: float) -> Estimate | None:
        """The mean of a channel over time with its error, from every step of a run between two times [s].

        None if this is no run, or has the channel in another unit.
        """
        column, run, shift = self.mapped_column(channel), self.run, self.mapped.shift
        if run is None or self.series[column.column].unit != unit:
            return None
        ends = column.column, after - shift, until - shift
        window = run.window(*ends)
        error = run.estimate(lambda run: run.window(*ends).mean).error if self.has_errors else math.nan
        return Estimate(column.sign * window.mean + column.offset, error + window.mean_doubt, unit)

    @cached_property
    def _errors(self) -> Mapping[str, Values]:
        """Numerical errors of all channels of a run at once, as they share most of the work."""
        return {} if self.run is None else curve_errors(self.run, self.series)

    def shifted(self, seconds: float) -> ComparedFile:
        """The file with a time [s] added to all of its times."""
        return replace(self, mapped=replace(self.mapped, shift=self.mapped.shift + seconds))


def is_own(path: Path) -> bool:
    """Whether a file is a run of this program, or is called as one and not there."""
    if not path.is_file():
        return path.suffix.lower() == ENDING
    with path.open("rb") as file:
        return is_run(file.read(HEAD))


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
    name = name or path.name
    if is_own(path):
        file = of_run(Result.load(path), path, name)
    else:
        columns = [column.column for column in mapped.columns.values()]  # they have to be there, wanted or not
        names = [*channels, *map(glob.escape, columns)] if channels else []
        read_names = partial(read_series, path, units=mapped.units, analysis=mapped.analysis, progress=progress)
        try:
            read = read_names(names=names)
        except InputError:
            if not names:
                raise
            read = read_names()  # all, so that an error can name the columns that there are
        file = ComparedFile(name, path, read.kind, None, read.series, notes=read.notes)
    lacking = [
        f"{path}: has no column {column.column!r}, which is to be {channel}; "
        f"{nearest(column.column, list(file.series))}"
        for channel, column in mapped.columns.items()
        if column.column not in file.series
    ]
    if lacking:
        raise InputError("\n".join(lacking))
    return replace(file, mapped=mapped)


def of_run(run: Result, path: Path, name: str) -> ComparedFile:
    """A run as a file that is compared."""
    series = {
        channel: NamedSeries(channel, recorded.unit, run.time, recorded.values)
        for channel, recorded in run.channels.items()
        if channel != "time"
    }
    return ComparedFile(name, path, "run of this program", run, series)


def unwrapped(angle: Values) -> Values:
    """A continuous angle [rad] from one that a file has wrapped into a single turn; others stay as they are.

    An angle was wrapped if all values lie within a turn and neighbours are more than half a turn apart.
    """
    known = np.isfinite(angle)
    values = angle[known]
    jumps = np.abs(np.diff(values)).max(initial=0.0) > 0.5 * TURN
    if not jumps or np.ptp(values) > (1.0 + ROUNDING) * TURN:
        return angle
    continuous = angle.copy()
    continuous[known] = np.unwrap(values)
    return continuous


# --- the unit in SI in which a quantity is compared ---


@cache
def si_unit(unit: str) -> str:
    """The SI unit of the kind of a unit: "N" of kN, "m" of inch; the unit itself if no channel is of its kind.

    Raises InputError if it is no unit.
    """
    unit_checked(unit, "unit")
    kinds = [each for each in QUANTITIES if of_a_kind(unit, each)]
    return "J" if "J" in kinds and WORK.search(unit) else next(iter(kinds), unit)


@cache
def of_a_kind(first: str, second: str) -> bool:
    """Whether quantities in the first unit can be given in the second."""
    try:
        scaled(np.ones(1), first, second, "unit")
    except InputError:
        return False
    return True


def channel_unit(reference: ComparedFile, other: ComparedFile, channel: str) -> str:
    """The unit in which a channel is compared: that of a run, else the SI unit of what the files name.

    Raises InputError if a file names none, or if both are of two kinds.
    """
    files, units = (reference, other), []
    for file in files:
        if (unit := file.unit(channel)) is None:
            column = file.mapped_column(channel).column
            raise InputError(
                f"{file.path}: {column}: its file gives no unit; allowed: one in the column's title, such as "
                f'\'{column} [mm]\', or in compare.toml, [files."{file.path.name}".units] "{column}" = "mm"'
            )
        units.append(unit)
    runs = [unit for file, unit in zip(files, units, strict=True) if file.run is not None]
    for unit in runs[:1] or [si_unit(unit) for unit in units]:  # g may be of an acceleration, not where kg are
        if all(of_a_kind(each, unit) for each in units):
            return unit
    mine, its = (unit or "pure numbers" for unit in units)
    raise InputError(
        f"{channel}: is in {mine} in {reference.name}, and in {its} in {other.name}; allowed: units of one kind"
    )
