"""The arrays of a MATLAB file, by scipy and h5py. It is called in a process of its own, see `apart`."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.files.series.columns import Numbers

MAGIC_HDF5 = b"MATLAB 7.3 MAT-file"
DEEPEST = 8  # structures in structures
MOST = 100_000  # variables and fields
Found = Iterator[tuple[list[str], Numbers]]


def matlab_arrays(path: Path) -> Iterator[tuple[dict[str, Any], Numbers]]:
    """Vectors and matrices of numbers (n, k), each with its path: names of structures, and its own.

    Raises what scipy and h5py do for what is damaged.
    """
    data = path.read_bytes()
    found = _of_hdf5(data) if data.startswith(MAGIC_HDF5) else _of_scipy(data)
    for number, (names, values) in enumerate(found):
        if number >= MOST:
            raise ValueError(f"it has more than {MOST} arrays")
        yield {"path": names}, values


def _standing(values: Any) -> Numbers | None:
    """Numbers as columns (n, k): a row is one column; None for what is no vector or matrix of numbers."""
    if values.dtype.kind not in "fiub" or values.ndim > 2 or values.size < 2:
        return None
    table = np.asarray(values, dtype=np.float64)
    return table.reshape(-1, 1) if table.ndim < 2 or 1 in table.shape else table


# --- versions 4 to 7 ---


def _of_scipy(data: bytes) -> Found:
    from scipy.io.matlab import loadmat

    stream: Any = io.BytesIO(data)  # which scipy takes, and its stubs do not tell
    for name, item in loadmat(stream).items():
        yield from _of_item([name], item)


def _of_item(names: list[str], item: Any) -> Found:
    """The arrays of a variable, or of a structure's fields."""
    if len(names) > DEEPEST:
        raise ValueError(f"it has more than {DEEPEST} structures in structures")
    if not isinstance(item, np.ndarray):
        return
    if item.dtype.names and item.size == 1:
        for name in item.dtype.names:
            yield from _of_item([*names, name], item.reshape(-1)[0][name])
    elif not item.dtype.names and (values := _standing(item)) is not None:
        yield names, values


# --- version 7.3 ---


def _of_hdf5(data: bytes) -> Found:
    with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
        yield from _of_group([], file)


def _of_group(names: list[str], group: Any) -> Found:
    """The arrays of a group and of groups in it; nothing that stands in other files."""
    if len(names) > DEEPEST:
        raise ValueError(f"it has more than {DEEPEST} structures in structures")
    for name in group:
        if name.startswith("#") or not isinstance(group.get(name, getlink=True), h5py.HardLink):
            continue
        item = group[name]
        if isinstance(item, h5py.Group):
            yield from _of_group([*names, name], item)
        elif not (
            item.external or item.is_virtual or item.dtype.kind not in "fiu" or "MATLAB_empty" in item.attrs
        ):
            values = _standing(item[()].T)  # which MATLAB keeps the other way round
            if values is not None:
                yield [*names, name], values
