"""Series of our own files: runs as `Result.save` writes them, and channels as `export --to hdf5` does.

Here a run gives its channels without their numerical errors; `Result.load` gives those, too.
"""

from __future__ import annotations

from pathlib import Path

import h5py

from support_exudyn.files.hdf5 import HDF5, check_checksum, series_in
from support_exudyn.files.series.columns import Column, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
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


def is_exported(head: bytes) -> bool:
    """Whether a file may be one of exported channels: HDF5 without the block of runs and of MATLAB."""
    return head.startswith(HDF5)


def read_own_file(path: Path, asked: Asked) -> SeriesFile:
    """The channels of a run, or of an HDF5 file that `export --to hdf5` has written.

    Raises InputError if the file is not a whole one, or was changed; OSError if it cannot be read.
    """
    data = path.read_bytes()
    kind, writer = "run of this program", "`run` writes"
    if not is_run(data):
        kind, writer = "HDF5 file of channels", "`export --to hdf5` writes"
    try:
        if is_run(data):
            check_checksum(data, format_of(data))
        with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
            if not is_run(data) and _text(file.attrs.get("format", "")) != EXPORTED:
                raise ValueError(f"its attribute 'format' is not {EXPORTED!r}")
            found = series_in(file["channels"])
        units = {name: _text(one.attributes["unit"]) for name, one in found.items()}
        columns = {
            name: Column(name, "" if units[name] == "1" else units[name], one.values.astype("f8"))
            for name, one in found.items()
        }
        times = columns.pop("time")
        if any(one.values.shape != (times.values.size,) for one in columns.values()):
            raise ValueError("not all channels have a value at each time")
    except DAMAGES as error:
        raise InputError(
            f"{path}: is no whole {kind} ({cleaned(str(error))}); allowed: what {writer}"
        ) from None
    return series_file(path, kind, [(times, [*columns.values()])], asked)


def _text(attribute: object) -> str:
    """A text attribute, of any kind that HDF5 has."""
    return attribute.decode("utf-8") if isinstance(attribute, bytes) else str(attribute)
