"""Series of our own files: runs as `Result.save` writes them, and channels as `export --to hdf5` does.

Here a run gives its channels without their numerical errors; `Result.load` gives those, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.hdf5 import HDF5, check_checksum, series_in
from support_exudyn.files.series.columns import Column, Numbers, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned

RUN = "support_exudyn result 6"  # what the file of a run begins with
OLDER = "support_exudyn result 5"  # without statistics from every step
EXPORTED = "support_exudyn channels 1"  # the attribute "format" of exported channels
DAMAGES = (OSError, LookupError, AttributeError, TypeError, ValueError, RuntimeError, MemoryError)


def is_run(head: bytes) -> bool:
    """Whether a file begins as runs of this or another version do."""
    return head.startswith(RUN.rpartition(" ")[0].encode())


def format_of(data: bytes) -> str:
    """The format that a run's file is to be of: an older one that can be read if it says so."""
    return OLDER if data.startswith(OLDER.encode()) else RUN


def read_own_run(path: Path, asked: Asked) -> SeriesFile:
    """The channels of a run.

    Raises InputError if the file is not a whole one, or was changed; OSError if it cannot be read.
    """
    data = contents(path, available() // 2)
    try:
        check_checksum(data, format_of(data))
        columns = [Column(name, unit, values) for name, unit, values in _channels(data)]
    except DAMAGES as error:
        raise InputError(
            f"{path}: is no whole run of this program ({cleaned(str(error))}); allowed: what `run` writes"
        ) from None
    return _over_time(path, "run of this program", columns, asked)


def is_exported(head: bytes) -> bool:
    """Whether a file may be one of exported channels: HDF5 without the block of runs and of MATLAB."""
    return head.startswith(HDF5)


def read_exported(path: Path, asked: Asked) -> SeriesFile:
    """The channels of an HDF5 file that `export --to hdf5` has written.

    Raises InputError if it is none, or damaged; OSError if it cannot be read.
    """
    data = contents(path, available() // 4)
    try:
        with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
            if _words(file.attrs.get("format", "")) != EXPORTED:
                raise ValueError(f"its attribute 'format' is not {EXPORTED!r}")
        columns = [Column(name, unit, values) for name, unit, values in _channels(data)]
    except DAMAGES as error:
        raise InputError(
            f"{path}: is no HDF5 file that `export --to hdf5` has written ({cleaned(str(error))}); allowed: a "
            "whole one"
        ) from None
    return _over_time(path, "channels that this program has exported", columns, asked)


def _channels(data: bytes) -> Iterator[tuple[str, str, Numbers]]:
    """Names, units and values (n,) of the channels. Raises ValueError for what are none."""
    with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
        found = series_in(file["channels"])
    for name, one in found.items():
        unit = _words(one.attributes["unit"])
        if one.values.ndim != 1:
            raise ValueError(f"channel {name!r} is of shape {one.values.shape}, not of one dimension")
        yield name, "" if unit == "1" else unit, np.asarray(one.values, dtype=np.float64)


def _over_time(path: Path, kind: str, columns: list[Column], asked: Asked) -> SeriesFile:
    times = next((one for one in columns if one.name == "time"), None)
    if times is None:
        raise InputError(f"{path}: has no channel 'time'; allowed: with it")
    if lengths := {one.values.size for one in columns} - {times.values.size}:
        raise InputError(f"{path}: has {times.values.size} times, and {lengths.pop()} values; allowed: as many")
    return series_file(path, kind, [(times, [one for one in columns if one is not times])], asked)


def _words(text: object) -> str:
    """A text attribute, of any kind that HDF5 has."""
    return text.decode("utf-8") if isinstance(text, bytes) else str(text)
