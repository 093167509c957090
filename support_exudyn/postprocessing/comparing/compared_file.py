"""A file that is compared: a run with its numerical errors, or series of another program or a measurement."""

from __future__ import annotations

import glob
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt

from support_exudyn.files.series.asked import Progress, silent
from support_exudyn.files.series.named_series import NamedSeries, SeriesFile
from support_exudyn.files.series.own_runs import is_run
from support_exudyn.files.series.read import read_series
from support_exudyn.files.series.units import converted
from support_exudyn.files.toml.faults import nearest
from support_exudyn.postprocessing.comparing.compare_file import MappedColumn, MappedFile
from support_exudyn.postprocessing.comparing.whole_turns import ANGLE, unwrapped
from support_exudyn.postprocessing.comparing.with_errors import curve_errors
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
ENDING = ".h5"  # of runs
HEAD = 64  # bytes by which a run is told
AS_IT_IS = MappedFile()


@dataclass(frozen=True)
class ComparedFile:
    """A file that is compared.

    name: by which tables and figures call it. path: of it. kind: what it is, in words.
    run: with its errors, if it is one of this program. series: of it, by the names of the file.
    mapped: what is said of its columns; `shift` is added to its times [s].
    notes: what a reader of the numbers has to know. turns: full turns that are taken off angles [rad], by
        channel.
    """

    name: str
    path: Path
    kind: str
    run: Result | None
    series: Mapping[str, NamedSeries]
    mapped: MappedFile = AS_IT_IS
    notes: tuple[str, ...] = ()
    meanings: Mapping[str, str] = field(default_factory=dict)
    turns: Mapping[str, float] = field(default_factory=dict)

    @property
    def has_errors(self) -> bool:
        """Whether its numerical errors are known."""
        return self.run is not None and self.run.coarser is not None

    @property
    def channels(self) -> list[str]:
        """Names of the channels: those that are mapped first, then columns under their own names."""
        return list(dict.fromkeys([*self.mapped.columns, *self.series]))

    def column(self, channel: str) -> MappedColumn:
        """The column that is a channel. Raises InputError if there is none."""
        if found := self.mapped.columns.get(channel):
            return found
        if channel not in self.series:
            raise InputError(
                f"{channel}: {self.name} has no such channel; {nearest(channel, self.channels[:12])}"
            )
        return MappedColumn(column=channel)

    def unit(self, channel: str) -> str | None:
        """Unit of a channel in the file; None if it names none."""
        return self.series[self.column(channel).column].unit

    def meaning(self, channel: str) -> str:
        """What a channel is, in words; empty if the file does not say."""
        return self.meanings.get(self.column(channel).column, "")

    def time(self, channel: str) -> Values:
        """Times of a channel, shifted [s], (n,)."""
        time = self.series[self.column(channel).column].time
        return time + self.mapped.shift if self.mapped.shift else time

    def values(self, channel: str, unit: str) -> Values:
        """Values of a channel in a unit, (n,); an angle that the file wraps is unwrapped.

        Raises InputError if its own unit is not known or of another kind.
        """
        found = self._converted(channel, unit)
        if unit == ANGLE and self.run is None:
            found = unwrapped(found)
        return found - self.turns[channel] if self.turns.get(channel) else found

    def _converted(self, channel: str, unit: str) -> Values:
        column = self.column(channel)
        series = self.series[column.column]
        try:
            if column.sign == 1 and column.offset == 0.0:
                return series.values if series.unit == unit else converted(series, unit)
            return converted(replace(series, values=column.sign * series.values + column.offset), unit)
        except InputError as error:
            raise InputError(f"{self.path}: {error}") from None

    def mean(self, channel: str, unit: str, after: float, until: float) -> Estimate | None:
        """The mean of a channel over time with its error, from every step of a run between two times [s].

        None if this is no run, or has the channel in another unit.
        """
        column, run, shift = self.column(channel), self.run, self.mapped.shift
        if run is None or self.series[column.column].unit != unit:
            return None
        ends = column.column, after - shift, until - shift
        window = run.window(*ends)
        error = run.estimate(lambda one: one.window(*ends).mean).error if self.has_errors else math.nan
        return Estimate(column.sign * window.mean + column.offset, error + window.mean_doubt, unit)

    def errors(self, channel: str) -> Values:
        """Numerical errors of a channel in SI, (n,); NaN: not known, infinite from the horizon on."""
        found = self._errors.get(self.column(channel).column)
        return np.full(self.time(channel).size, np.nan) if found is None else found

    @cached_property
    def _errors(self) -> Mapping[str, Values]:
        """Numerical errors of all channels of a run at once, as they share most of the work."""
        return {} if self.run is None else curve_errors(self.run, self.series)

    def of(self, run: Result) -> ComparedFile:
        """The file with another run of the scene in it, such as one with longer steps."""
        return replace(self, run=run, series=_series(run))

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
    mapped: MappedFile = AS_IT_IS,
    name: str = "",
    channels: Sequence[str] = (),
    progress: Progress = silent,
) -> ComparedFile:
    """Read a file that is compared.

    Arguments:
        path: of a run, or of whatever `read_series` reads.
        mapped: what is said of its columns.
        name: by which tables and figures call it; its file name if it is empty.
        channels: patterns of those that are wanted, all if there are none: others take no memory.
        progress: is told the share that is read.

    Raises InputError if it cannot be read, or lacks a column that `mapped` names; OSError if it is not there.
    """
    name = name or path.name
    if is_own(path):
        return _mapped(of_run(Result.load(path), path, name), mapped)
    found = _series_of(path, mapped, channels, progress)
    return _mapped(ComparedFile(name, path, found.kind, None, found.series, AS_IT_IS, found.notes), mapped)


def _series_of(path: Path, mapped: MappedFile, channels: Sequence[str], progress: Progress) -> SeriesFile:
    """The series of a file that may be wanted; all if none is, so that it can be told which there are."""
    columns = [one.column for one in mapped.columns.values()]  # they have to be there, wanted or not
    names = [*channels, *map(glob.escape, columns)] if channels else []
    try:
        return read_series(path, units=mapped.units, analysis=mapped.analysis, names=names, progress=progress)
    except InputError:
        if not names:
            raise
        return read_series(path, units=mapped.units, analysis=mapped.analysis, progress=progress)


def of_run(run: Result, path: Path, name: str) -> ComparedFile:
    """A run as a file that is compared."""
    meanings = {channel: one.meaning for channel, one in run.channels.items()}
    return ComparedFile(name, path, "run of this program", run, _series(run), meanings=meanings)


def _series(run: Result) -> Mapping[str, NamedSeries]:
    return {
        channel: NamedSeries(channel, one.unit, run.time, one.values)
        for channel, one in run.channels.items()
        if channel != "time"
    }


def _mapped(file: ComparedFile, mapped: MappedFile) -> ComparedFile:
    """The file with what is said of its columns. Raises InputError with a line for each that it lacks."""
    lacking = [
        f"{file.path}: has no column {one.column!r}, which is to be {channel}; "
        f"{nearest(one.column, list(file.series))}"
        for channel, one in mapped.columns.items()
        if one.column not in file.series
    ]
    if lacking:
        raise InputError("\n".join(lacking))
    return replace(file, mapped=mapped)
