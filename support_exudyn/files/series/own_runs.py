"""Series of our own files: runs as `Result.save` writes them, and channels as `export --to hdf5` does.

Here a run gives its channels without their numerical errors; `Result.load` gives those, too.
"""

from __future__ import annotations

from pathlib import Path

import h5py

from support_exudyn.files.free_memory import available
from support_exudyn.files.hdf5 import HDF5, Inside, check_checksum
from support_exudyn.files.series.asked import Asked
from support_exudyn.files.series.columns import Column, series_file
from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned

RUN = "support_exudyn result 5"  # what the file of a run begins with
EXPORTED = "support_exudyn channels 1"  # the attribute "format" of exported channels
DAMAGES = (OSError, LookupError, AttributeError, TypeError, ValueError, RuntimeError, MemoryError)


def is_run(head: bytes) -> bool:
    """Whether a file begins as runs of this or another version do."""
    return head.startswith(b"support_exudyn result ")


def read_own_run(path: Path, asked: Asked) -> SeriesFile:
    """The channels of a run.

    Raises InputError if the file is not a whole one, or was changed; OSError if it cannot be read.
    """
    data = contents(path, available() // 2)
    try:
        check_checksum(data, RUN)
        return _channels(path, data, "run of this program", asked)
    except InputError:
        raise
    except DAMAGES as error:
        raise InputError(
            f"{path}: is no whole run of this program ({cleaned(str(error))}); allowed: what `run` writes"
        ) from None


def is_exported(head: bytes) -> bool:
    """Whether a file may be one of exported channels: HDF5 without the block of runs and of MATLAB."""
    return head.startswith(HDF5)


def read_exported(path: Path, asked: Asked) -> SeriesFile:
    """The channels of an HDF5 file that `export --to hdf5` has written.

    Raises InputError if it is none, or damaged; OSError if it cannot be read.
    """
    data = contents(path, available() // 2)
    try:
        with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
            if _words(file.attrs.get("format", "")) != EXPORTED:
                raise ValueError(f"its attribute 'format' is not {EXPORTED!r}")
        return _channels(path, data, "channels that this program has exported", asked)
    except InputError:
        raise
    except DAMAGES as error:
        raise InputError(
            f"{path}: is HDF5, but no channels of this program ({cleaned(str(error))}); allowed: what `export "
            "--to hdf5` writes, runs, MATLAB files of version 7.3"
        ) from None


def _channels(path: Path, data: bytes, kind: str, asked: Asked) -> SeriesFile:
    with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
        found = Inside(file, len(data)).inside("channels").series()
    columns = []
    for name, one in found.items():
        unit = _words(one.attributes["unit"])
        if one.values.ndim != 1:
            raise ValueError(f"channel {name!r} is of shape {one.values.shape}, not of one dimension")
        columns.append(Column(name, "" if unit == "1" else unit, one.values.astype(float)))
    times = next((one for one in columns if one.name == "time"), None)
    if times is None:
        raise ValueError("it has no channel 'time'")
    if lengths := {one.values.size for one in columns} - {times.values.size}:
        raise ValueError(f"channels have {lengths.pop()} values, and {times.values.size} times")
    return series_file(path, kind, [(times, [one for one in columns if one is not times])], asked)


def _words(text: object) -> str:
    """A text attribute, of any kind that HDF5 has."""
    return text.decode("utf-8") if isinstance(text, bytes) else str(text)
