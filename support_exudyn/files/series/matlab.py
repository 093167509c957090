"""Series of MATLAB files of versions 4 to 7.3.

A vector of times is called time, t or T, in this order. All vectors as long as it, beside it and in
structures without times of their own, are series; so are the columns of a matrix that has as many rows. A
structure with the fields Time and Data is taken as a timeseries. Names are joined by points, `run.pin.force`.
MATLAB keeps no units: a name such as `force_kN` has one, of all others it is asked for.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, Numbers, named_times, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.units import split_title
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned, short

MAGIC, MAGIC_HDF5 = b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"
DEEPEST = 8  # structures in structures
MOST = 100_000  # variables and fields
WIDEST = 1000  # columns of a matrix
TOLD = 300  # letters of what went wrong
Place = tuple[str, ...]  # of a structure: the names on the way to it
Found = Iterator[tuple[list[str], Numbers]]
DATA = ("data", "values", "signals")


def is_matlab(head: bytes) -> bool:
    """Whether a file begins as MATLAB's do."""
    return head.startswith((MAGIC, MAGIC_HDF5)) or _is_version_4(head)


def _is_version_4(head: bytes) -> bool:
    """Five whole numbers: type, rows, columns, whether there is an imaginary part, letters of the name."""
    if len(head) < 22:
        return False
    for order in "<>":
        kind, rows, columns, imaginary, letters = (int(one) for one in np.frombuffer(head[:20], f"{order}i4"))
        digits = f"{kind:04d}"  # order of bytes, 0, type of the numbers, kind of the matrix
        known = len(digits) == 4 and digits[0] in "01" and digits[1] == "0" and digits[2] <= "5"
        if known and min(rows, columns) >= 0 and imaginary in (0, 1) and 2 <= letters <= 64:
            name = head[20 : 20 + letters]
            if name[-1:] == b"\0" and name[:-1].replace(b"_", b"a").isalnum():
                return True
    return False


def read_matlab(path: Path, asked: Asked) -> SeriesFile:
    """The series of a MATLAB file.

    Raises InputError if it is damaged, or has no vector of times; OSError if it cannot be read.
    """
    data = contents(path, available() // 4)
    structures: dict[Place, dict[str, Numbers]] = {}
    try:
        for place, values in islice(_arrays(data), MOST):
            structures.setdefault(tuple(place[:-1]), {})[place[-1]] = values
    except Exception as error:  # of many kinds, by scipy and h5py
        why = cleaned(" ".join(f"{error or type(error).__name__}".split()))[:TOLD]
        raise InputError(f"{path}: is no MATLAB file that can be read ({why}); allowed: a whole one") from None
    times = {above: found for above, arrays in structures.items() if (found := _times(path, above, arrays))}
    groups = []
    for above, arrays in structures.items():
        known = [above[:n] for n in range(len(above), -1, -1) if above[:n] in times]
        if known and (columns := _columns(above, arrays, times[known[0]])):
            groups.append((times[known[0]], columns))
    if not groups:
        names = ", ".join(short(name) for arrays in structures.values() for name in list(arrays)[:6]) or "none"
        raise InputError(
            f"{path}: has no vector of times with others as long; allowed: a vector t or time beside them; its "
            f"vectors are {names:.200}"
        )
    return series_file(path, "MATLAB file", groups, asked)


def _times(path: Path, above: Place, arrays: Mapping[str, Numbers]) -> Column | None:
    """The times of a structure, None if it has none."""
    vectors = [title for title, values in arrays.items() if values.shape[1] == 1]
    titles = [vectors[n] for n in named_times([split_title(one)[:2] for one in vectors])]
    if len(titles) > 1:
        raise InputError(f"{path}: has {len(titles)} vectors of times, {', '.join(titles)}; allowed: one")
    if not titles:
        return None
    name, unit, _ = split_title(titles[0])
    return Column(".".join((*above, name)), unit, arrays[titles[0]][:, 0])


def _columns(above: Place, arrays: Mapping[str, Numbers], times: Column) -> list[Column]:
    """What of a structure is as long as the times."""
    found, size = [], times.values.size
    for title, values in arrays.items():
        name, unit, _ = split_title(title)
        is_times = ".".join((*above, name)) == times.name
        if is_times or len(values) != size or values.shape[1] > WIDEST:
            continue
        whole = ".".join(above if name.casefold() in DATA and above else (*above, name))
        several = values.shape[1] > 1
        found += [
            Column(f"{whole}.{n + 1}" if several else whole, unit, values[:, n]) for n in range(values.shape[1])
        ]
    return found


# --- arrays, by scipy and h5py ---


def _arrays(data: bytes) -> Found:
    """Vectors and matrices of numbers (n, k), each with its path: names of structures, and its own.

    Raises what scipy and h5py do for what is damaged.
    """
    yield from _of_hdf5(data) if data.startswith(MAGIC_HDF5) else _of_scipy(data)


def _standing(values: Any) -> Numbers | None:
    """Numbers as columns (n, k): a row is one column; None for what is no vector or matrix of numbers."""
    if values.dtype.kind not in "fiub" or values.ndim > 2 or values.size < 2:
        return None
    table = np.asarray(values, dtype=np.float64)
    return table.reshape(-1, 1) if table.ndim < 2 or 1 in table.shape else table


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
