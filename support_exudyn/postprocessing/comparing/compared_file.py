"""A file that is compared: a run with its numerical errors, or series of another program or a measurement.

Errors of runs are estimates from coarser runs (`simulation.estimate`), and some are too small: of 16 481
numbers that were judged by far finer runs 91 had larger errors than estimated, the worst 7.1 times
(`accuracy.md`). So only a difference of more than ten times both errors is certain.
"""

from __future__ import annotations

import glob
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from support_exudyn.files.series.named_series import Progress, SeriesFile, silent
from support_exudyn.files.series.own_runs import is_run
from support_exudyn.files.series.read import read_series
from support_exudyn.postprocessing.comparing.compared_channel import ComparedColumn
from support_exudyn.postprocessing.comparing.mapping import MappedFile
from support_exudyn.postprocessing.figures.channels import error_over_time
from support_exudyn.scenario.timescales import timescales
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.reported_numbers import ROUNDING, left_by_newton
from support_exudyn.simulation.result import Result
from user_forces.values.names import nearest
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
ENDING = ".h5"  # of runs
HEAD = 64  # bytes by which a run is recognised
# Of a single record, coarser runs can agree by chance. Draft, standard and reference runs of 36 drawn scenes
# were compared: with these, 49 of 7701 curves differ anywhere by more than both errors, the worst 9.7 times.
AROUND = 5  # records to either side of which the largest error is taken
SINGLE = 3.0  # times what is estimated of numbers, which average
JUMPING = ".impact_velocity"  # end of the names of channels that are steps in time
# Share of the largest value of a unit, of the whole run, that a safe error is at least: what is nothing in
# truth, as the force of a pin that carries nothing or what is missing of an energy, is rounding of others.
ROUNDED = 1e-12


@dataclass(frozen=True)
class ComparedFile:
    """A file that is compared: a run with its numerical errors, or series of another program or a measurement.

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

    @cached_property
    def horizon(self) -> float:
        """The time from which on shorter steps change its impacts [s]; infinite if none is known."""
        return self.run.horizon + self.shift if self.run is not None and self.has_errors else math.inf

    def mean(self, channel: str, unit: str, after: float, until: float) -> Estimate | None:
        """The mean of a channel over time with its error, from every step of a run between two times [s].

        The error is that of the run's own numbers, if the mean is among them. None if this is no run, or has
        the channel mapped or in another unit.
        """
        run, ends = self.run, (channel, after - self.shift, until - self.shift)
        if run is None or channel in self.mapped or self.columns[channel].unit != unit:
            return None
        window, error = run.window(*ends), math.nan
        if self.has_errors:
            usual = self._numbers(*ends[1:]).get(f"{channel}.mean")
            error = usual.error if usual else run.estimate(lambda run: run.window(*ends).mean).error
        return Estimate(window.mean, error + window.mean_doubt, unit)

    @cached_property
    def _numbers(self) -> Callable[[float, float], Mapping[str, Estimate]]:
        """The usual numbers of the run between two times [s], computed once for each pair of times."""
        assert self.run is not None
        return cache(self.run.numbers)

    def shifted(self, seconds: float) -> ComparedFile:
        """The file with a time [s] added to all of its times."""
        columns = {name: each._replace(time=each.time + seconds) for name, each in self.columns.items()}
        return replace(self, columns=columns, shift=self.shift + seconds)


def compared_file(
    source: Path | Result | SeriesFile,
    name: str = "",
    mapped: MappedFile | None = None,
    channels: Sequence[str] = (),
    progress: Progress = silent,
) -> ComparedFile:
    """A run, or a file with the channels of its mapping, which take the place of the columns of others' files.

    channels: patterns of those that are wanted, all if there are none: others take no memory.

    Raises InputError if it cannot be read or lacks a mapped column; OSError if it is not there.
    """
    mapped = mapped or MappedFile()
    sources = {channel: each.column for channel, each in mapped.columns.items()}
    if isinstance(source, Path):
        path = source
        wanted = [*channels, *map(glob.escape, sources.values())] if channels else []
        try:
            read = _read(path, mapped, wanted, progress)
        except InputError:  # read all, so that an error can name the columns
            read = _read(path, mapped, [], progress)
    else:
        path, read = Path(name), source
    if isinstance(read, Result):
        file = ComparedFile(name, path, "run of this program", recorded_columns(read), read)
    else:
        series = {column: ComparedColumn.of_series(each) for column, each in read.series.items()}
        file = ComparedFile(name, path, read.kind, series, notes=read.notes)
    if lacking := [(channel, column) for channel, column in sources.items() if column not in file.columns]:
        raise InputError(
            "\n".join(
                f"{path}: has no column {column!r} for {channel}; {nearest(column, list(file.columns))}"
                for channel, column in lacking
            )
        )
    columns = {}
    for channel, each in mapped.columns.items():
        column = file.columns[each.column]
        columns[channel] = column._replace(values=each.sign * column.values + each.offset)
    for channel, column in file.columns.items():
        if file.run is not None or channel not in sources.values():
            columns.setdefault(channel, column)
    return replace(file, columns=columns, mapped=sources).shifted(mapped.shift)


def _read(path: Path, mapped: MappedFile, names: Sequence[str], progress: Progress) -> Result | SeriesFile:
    """The contents of a file: a run of this program with its errors, or the series of any other."""
    is_own = path.suffix.lower() == ENDING
    if path.is_file():
        with path.open("rb") as file:
            is_own = is_run(file.read(HEAD))
    if is_own:
        return Result.load(path)
    settings = {"analysis": mapped.analysis, "sheet": mapped.sheet}
    return read_series(path, units=mapped.units, rate=mapped.rate, names=names, progress=progress, **settings)


# --- errors of a run's channels ---


def recorded_columns(result: Result, names: Iterable[str] | None = None) -> dict[str, ComparedColumn]:
    """Channels of a run with their numerical errors at each record; None: all but time.

    Record by record as `error_over_time` estimates them from the coarser runs; then of each the largest one of
    the `AROUND` records to either side, and no less than a step may be wrong by; all of it `SINGLE` times. An
    error is at least the largest before: of thousands of records none is to differ by chance, and in chaos
    what is behind an impact is not more certain than that is. Rounding on other processors is added. From the
    horizon on errors are infinite; NaN if the run has none. Impact velocities jump at impacts and
    separations, whose times have errors: the error at both records about a jump is at least the jump.
    """
    names = [name for name in result.channels if name != "time"] if names is None else list(names)
    unknown = np.full(result.time.size, math.nan)
    columns = {name: ComparedColumn(result.unit(name), result.time, result[name], unknown) for name in names}
    if result.coarser is None:
        return columns
    largest: dict[str, float] = {}
    for channel in result.channels.values():
        size = float(np.abs(channel.values[np.isfinite(channel.values)]).max(initial=0.0))
        largest[channel.unit] = max(largest.get(channel.unit, 0.0), size)
    least, beyond = _least_errors(result, largest), result.time >= result.horizon
    for name, column in columns.items():
        single, unit = error_over_time(result, name), result.unit(name)
        if single is None:
            continue
        near = ndimage.maximum_filter1d(single, 2 * AROUND + 1) + least.get(unit, 0.0)
        errors = np.maximum.accumulate(np.where(beyond, math.inf, SINGLE * near)) + ROUNDED * largest[unit]
        if name.endswith(JUMPING):
            jumps = np.pad(np.abs(np.diff(column.values)), 1)
            errors = np.maximum.reduce([errors, jumps[1:], jumps[:-1]])
        columns[name] = column._replace(errors=errors)
    return columns


def _least_errors(result: Result, largest: Mapping[str, float]) -> Mapping[str, float]:
    """The least error that coarser runs can show, by unit: a share of the sizes of a run's motion and forces.

    The share is the tolerance that steps are chosen by, else what Newton's method leaves, or rounding. A step
    is wrong by so much of the smallest clearance d, of d/T and d/T^2 in speed and acceleration, T being the
    shortest time in which anything moves (`Timescales`), and of the largest force F, of F d in energy.
    Angles: per 1 m. A scene at rest can be the same to the bit in all of its runs, whatever it is in the
    limit. Without the contact's law, whose module is not imported, the mean step stands for T.

    largest: the largest magnitude of all channels of a unit, by unit.
    """
    scenario = result.scenario
    try:
        times = timescales(scenario)
        shortest = min(times.flight, times.resting, times.drive, scenario.duration)
    except InputError:
        shortest = scenario.duration / max(1, result.counts.steps)
    share = scenario.solver.tolerance if scenario.chooses_steps else max(left_by_newton(scenario), ROUNDING)
    length = min((place.play for place in scenario.contact_places.values()), default=0.0)
    moving = {
        f"{unit}{per}": length / shortest**power
        for unit in ("m", "rad")
        for per, power in (("", 0), ("/s", 1), ("/s^2", 2))
    }
    moving["J"] = largest.get("N", 0.0) * length
    return {unit: share * moving.get(unit, size) for unit, size in largest.items()}
