"""What comes out of a run, and its file."""

from __future__ import annotations

import errno
import json
import math
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import h5py
import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.hdf5 import Series, check_checksum, checksum_block, file_image, series_in, write_texts
from support_exudyn.files.own_modules import modules_of, refusals, without_modules
from support_exudyn.files.series.own_runs import RUN, format_of
from support_exudyn.files.whole_file import contents, missing_file, whole_file
from support_exudyn.mechanics.time_statistics import COLUMNS as COLUMNS_OF_STATISTICS
from support_exudyn.mechanics.time_statistics import TimeStatistics
from support_exudyn.mechanics.trajectory import Counts, Impulse, OilEvent
from support_exudyn.scenario.presentation import presenter
from support_exudyn.scenario.recorded_channels import Channel
from support_exudyn.simulation import impulses
from support_exudyn.simulation.estimate import Estimate, error, errors, fall, horizon, worst_error
from support_exudyn.simulation.recorded_run import RecordedRun, to_pandas, to_xarray
from support_exudyn.simulation.reported_numbers import measures
from user_forces.contact_state import Onset
from user_forces.values.names import Named
from user_forces.values.value import InputError, Value, cleaned

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

FORMAT = RUN
COLUMNS = "time [s], initial impact velocity [m/s], time of separation [s], speed of separation [m/s]"
DAMAGES = (OSError, LookupError, AttributeError, TypeError, ValueError, RuntimeError, MemoryError)


OTHERS = {  # what files are that are no runs, and which command takes them
    ".csv": "a CSV table, no run: `plot RUN {path}` draws its curves over a run, `show STORE` tells of a sweep",
    ".parquet": "the table of a sweep, no run: `show`, `table` and `chart` take it",
    ".toml": "a text that people write, no run: `run` makes one of a scenario, `check` looks at a machine",
}


@dataclass(frozen=True, repr=False)
class Result(RecordedRun):
    """A finished run: what it has recorded, the estimated errors of its numbers, and its file.

    The arguments are those of `RecordedRun`.
    """

    coarser: Result | None = None

    # --- errors; of results that were run to an accuracy ---

    def estimate(self, measure: Callable[[Result], float], unit: str = "") -> Estimate:
        """A number of one's own with its estimated error.

        Arguments:
            measure: gives the number of a result, such as `lambda r: r["tip.x"].max()`.
            unit: of it.

        Raises InputError if the run was not made to an accuracy.
        """
        self._check()

        def measured(run: RecordedRun) -> float:
            return measure(cast(Result, run))  # all runs that a result is estimated by are results

        return Estimate(float(measure(self)), float(error(measured, self, self.fall)), unit)

    def numbers(self, after: float = 0.0, until: float = math.inf) -> Named[Estimate]:
        """The usual numbers with their estimated errors, by names such as `pin.rear_base.force.mean`.

        Over time between two times [s], from every step and not from the records: mean, standard deviation
        (`std`) and largest magnitude of all forces and when that is (`largest_time`), with `min` and `max` of
        those that have a sign; `std` of angular accelerations, mean place of traced points; and of clearance
        pins the largest force of the run and when it is (`pin.NAME.largest_force` and `largest_force_time`)
        and the first three impacts.

        Where velocities jump, as of rigid actuators with a sudden drive, the forces of ideal pins and rigid
        actuators have no finite peak: `largest`, `min`, `max` and `std` are refused, and their impulses
        (`pin.NAME.force.impulse_1` [N s]) stand in their place. Means leave the impulse out.

        Errors are those of the steps, of rounding, and of a time that lies inside an interval for which
        statistics are kept (1000 of a run). Of files of earlier versions numbers are those of the records.
        """
        self._check()
        kinds = measures(self, after, until)
        known = errors(kinds, self, self.fall)
        found = {name: Estimate(kind.measure(self), known[name], kind.unit) for name, kind in kinds.items()}
        return Named(found, "number", impulses.refused(self, after, until))

    @cached_property
    def fall(self) -> float:
        """The factor by which the distances of numbers fell from run to run: 1/4 for second order."""
        return fall(self)

    @property
    def worst_error(self) -> float:
        """Estimated error of what an accuracy is of: the largest, relative.

        Mean, spread and largest value of the pin forces over the run; paths of traced points, of their extent
        (at least the clearance).
        """
        self._check()
        return worst_error(self, self.fall)

    @property
    def met(self) -> bool:
        """Whether the estimated error is as small as was asked for."""
        return self.goal is not None and self.worst_error <= self.goal

    @property
    def horizon(self) -> float:
        """The time [s] of the first impact that shorter steps change, see `estimate.horizon`; infinite: none.

        Up to it the run is determined; beyond it means and spreads may be results, single impacts are not.
        """
        self._check()
        return horizon(self)

    def _check(self) -> None:
        if self.coarser is None:
            raise InputError(
                "the run has nothing to estimate errors by; allowed: runs with an accuracy, "
                "simulate(scenario, accuracy='standard'), or with errors, simulate(scenario, errors=True)"
            )

    # --- notebooks ---

    def to_pandas(self) -> pd.DataFrame:
        """All channels as a table: a row for each record, the index its time [s], all in SI.

        `attrs` has "units" and "meanings" by name.
        """
        return to_pandas(self)

    def to_xarray(self) -> xr.Dataset:
        """All channels over the coordinate `time` [s], each with its `units` and `long_name`, all in SI.

        Raises InputError if xarray is not installed.
        """
        return to_xarray(self)

    def plot(self, *channels: str, after: float = 0.0, until: float = math.inf) -> Figure:
        """A figure of channels over time, those of one unit together, with impacts and numerical errors.

        Arguments:
            channels: names, or patterns of them as in a shell, "pin.*.force"; that one if none are given.
            after, until: what of the run is drawn [s].

        Returns:
            A figure of matplotlib without pyplot, which notebooks show; `savefig` writes it.

        Raises InputError if a pattern matches no channel, if they are too many, or if no records lie between
        the times.
        """
        return presenter().figure(self, channels, after, until)

    def _repr_html_(self) -> str:
        """What was run and what came out, for notebooks."""
        return presenter().page_of_result(self)

    # --- file ---

    def save(self, path: str | Path) -> Path:
        """Write everything to one HDF5 file: /channels/NAME with units, and the rest as JSON attributes.

        The run by which errors are estimated stands likewise in /coarser. Of classes of one's own the modules
        are noted, with their absolute paths. The file begins with a digest of all that follows, so that `load`
        takes no damaged one for good.

        Raises OSError that names the file if it cannot be written; an older one is then as it was.
        """
        pieces = with_digest(self.image())
        with whole_file(path) as temporary, temporary.open("wb") as file:
            file.writelines(pieces)
        return Path(path)

    def image(self) -> bytearray:
        """The bytes of the HDF5 file that `save` writes, behind its digest."""

        def write(file: h5py.File) -> None:
            data = self.scenario.plain
            own = modules_of(data)
            write_texts(file, {"format": FORMAT} | ({"own_classes": json.dumps(own)} if own else {}))
            _write(file, self, data)

        return file_image(dict(_series(self)), write)

    @staticmethod
    def load(path: str | Path) -> Result:
        """Read what `save` wrote. Modules of one's own are not imported: see `support_exudyn.trusted`.

        A law without its module stands as text in the scenario, and a warning says what to do.

        Raises InputError if the file is not a whole result file, or was changed, or if nothing can be read
        without its modules; OSError if it cannot be opened at all.
        """
        if not Path(path).exists():
            raise missing_file(path, "files that Result.save has written")
        if Path(path).is_dir():
            raise IsADirectoryError(
                errno.EISDIR, "is a directory; allowed: files that Result.save has written", str(path)
            )
        if Path(path).is_file() and (other := OTHERS.get(Path(path).suffix.lower())) is not None:
            raise InputError(
                f"{path}: is {other.format(path=path)}; allowed: files that Result.save has written"
            )
        data, missing = contents(path, available()), dict[str, str]()
        try:
            check_checksum(data, format_of(data))
            with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
                if "own_classes" in file.attrs:
                    missing = refusals(json.loads(file.attrs["own_classes"]))
                result = _read(file, missing)
        except InputError as error:  # of a value that is not known or does not fit
            raise InputError(f"{path}: {'; '.join(missing.values()) or error}") from None
        except DAMAGES as error:
            raise InputError(
                f"{path}: not a result file of this program, or damaged ({cleaned(str(error))})"
            ) from None
        for sentence in missing.values():
            warnings.warn(f"{path}: {sentence}", stacklevel=2)
        return result


def with_digest(image: bytearray) -> tuple[bytes, bytearray]:
    """The bytes of a run's file, in pieces: the digest before those of `Result.image`."""
    return checksum_block(image, FORMAT), image


def _series(result: Result, above: str = "") -> Iterator[tuple[str, tuple[np.ndarray, dict[str, str]]]]:
    """All channels of a run and of coarser ones by the paths of their data sets, with what is said of them."""
    for name, channel in result.channels.items():
        texts = {"unit": channel.unit, "meaning": channel.meaning}
        yield f"{above}channels/{name}", (channel.values, texts)
    if result.statistics is not None:
        yield f"{above}statistics/time", (result.statistics.edges, {"unit": "s"})
        for name, rows in result.statistics.channels.items():
            yield f"{above}statistics/{name}", (rows.ravel(), {"columns": ", ".join(COLUMNS_OF_STATISTICS)})
    if result.coarser is not None:
        yield from _series(result.coarser, f"{above}coarser/")


def _write(group: h5py.Group, result: Result, scenario: Mapping[str, Any]) -> None:
    """Write all but the channels. scenario: its plain data."""
    texts = {
        "scenario": scenario,
        "impulses": [asdict(impulse) for impulse in result.impulses],
        "counts": asdict(result.counts),
        "provenance": dict(result.provenance),
        "goal": result.goal,
    }
    if result.oil_events:
        texts["oil_events"] = {name: [*map(list, found)] for name, found in result.oil_events.items()}
    write_texts(group, {name: json.dumps(item) for name, item in texts.items()})
    group.attrs["wall_time_s"] = result.wall_time
    for name, onsets in result.onsets.items():
        data = group.create_dataset(f"onsets/{name}", data=np.array(onsets).reshape(-1, 4))
        write_texts(data, {"columns": COLUMNS})
        data.attrs["largest_force_N"] = result.largest_force[name]
        if name in result.largest_force_time:
            data.attrs["largest_force_time_s"] = result.largest_force_time[name]
    if result.coarser is not None:
        _write(group["coarser"], result.coarser, result.coarser.scenario.plain)


def _read(group: h5py.Group, missing: Mapping[str, str]) -> Result:
    """The run of a group. missing: refusals of the classes that are not imported, by name."""
    onsets = series_in(group["onsets"]) if "onsets" in group else {}
    channels = {
        name: Channel(data.values, data.text("unit"), data.text("meaning"))
        for name, data in series_in(group["channels"]).items()
    }
    _check_channels(channels)
    coarser = _read(group["coarser"], missing) if "coarser" in group else None
    if coarser is not None:
        _check_coarser(channels, coarser.channels)
    return Result(
        scenario=Value.from_data(without_modules(json.loads(group.attrs["scenario"]), missing)),
        channels=channels,
        onsets={name: _onsets(name, data.values) for name, data in onsets.items()},
        largest_force={name: float(data.attributes["largest_force_N"]) for name, data in onsets.items()},
        largest_force_time={
            name: float(data.attributes["largest_force_time_s"])
            for name, data in onsets.items()
            if "largest_force_time_s" in data.attributes  # runs of earlier versions do not tell it
        },
        impulses=tuple(Impulse(**item) for item in json.loads(group.attrs["impulses"])),
        counts=Counts(**json.loads(group.attrs["counts"])),
        wall_time=float(group.attrs["wall_time_s"]),
        provenance=json.loads(group.attrs["provenance"]),
        oil_events=_oil_events(json.loads(group.attrs["oil_events"])) if "oil_events" in group.attrs else {},
        statistics=_statistics(series_in(group["statistics"]), channels) if "statistics" in group else None,
        goal=json.loads(group.attrs["goal"]),
        coarser=coarser,
    )


def _statistics(found: Mapping[str, Series], channels: Mapping[str, Channel]) -> TimeStatistics:
    """Raises ValueError unless each channel has a row for each interval."""
    if found.keys() != channels.keys():
        raise ValueError("statistics and channels do not have the same names")
    edges, width = found["time"].values, len(COLUMNS_OF_STATISTICS)
    rows = {name: one.values for name, one in found.items() if name != "time"}
    for name, one in found.items():
        size = edges.size if name == "time" else (edges.size - 1) * width
        if one.values.dtype != np.float64 or one.values.shape != (size,) or edges.size < 2:
            raise ValueError(
                f"statistics of {name!r} are of {one.values.dtype} and shape {one.values.shape}; allowed: "
                f"float64, {width} numbers for each of the intervals between {edges.size} times"
            )
    if not np.isfinite(edges).all() or not (np.diff(edges) > 0.0).all():
        raise ValueError("the times of the statistics do not increase")
    return TimeStatistics(edges, {name: one.reshape(-1, width) for name, one in rows.items()})


def _oil_events(data: Mapping[str, Any]) -> dict[str, tuple[OilEvent, ...]]:
    return {
        name: tuple(OilEvent(float(t), str(what), bool(on)) for t, what, on in found)
        for name, found in data.items()
    }


def _onsets(name: str, rows: np.ndarray) -> tuple[Onset, ...]:
    """Raises ValueError if they have not all of their columns."""
    if rows.ndim != 2 or rows.shape[1] != len(Onset._fields):
        raise ValueError(
            f"onsets of {name!r} are of shape {rows.shape}; allowed: {len(Onset._fields)} columns, "
            f"{', '.join(Onset._fields)}"
        )
    return tuple(Onset(*row) for row in rows.tolist())


def _check_channels(channels: Mapping[str, Channel]) -> None:
    """Raise ValueError unless all are as long as the times, which increase."""
    time = channels["time"].values
    for name, channel in channels.items():
        if channel.values.dtype != np.float64 or channel.values.shape != (time.size,):
            raise ValueError(
                f"channel {name!r} is of {channel.values.dtype} and shape {channel.values.shape}; allowed: one "
                f"of float64 for each of the {time.size} times"
            )
    if not time.size or not np.isfinite(time).all() or not (np.diff(time) > 0.0).all():
        raise ValueError("the times of the records do not increase")


def _check_coarser(channels: Mapping[str, Channel], coarser: Mapping[str, Channel]) -> None:
    """Raise ValueError unless the run by which errors are estimated has all channels of the run."""
    missing = [name for name in channels if name not in coarser]
    if missing:
        raise ValueError(
            f"the coarser run lacks {len(missing)} channels, such as {missing[0]!r}; allowed: none, for errors "
            "are estimated by all of them"
        )
