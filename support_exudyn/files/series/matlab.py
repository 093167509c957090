"""Series of MATLAB files: versions 4 to 7 by scipy, 7.3, which is HDF5, by h5py.

A vector of times is called t or time, whatever its letters. All vectors as long as it, beside it in the same
structure or in the file, are series; so are the columns of a matrix that has as many rows. A structure with
the fields Time and Data is taken as a timeseries. Names are joined by points, `run.pin.force`. MATLAB keeps no
units: a name such as `force_kN` has one, of all others it is asked for.
"""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.asked import Asked
from support_exudyn.files.series.columns import Column, series_file
from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.titles import split_title
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned, short

MAGIC = b"MATLAB 5.0 MAT-file"
MAGIC_HDF5 = b"MATLAB 7.3 MAT-file"
DEEPEST = 8  # structures in structures
MOST = 100_000  # variables and fields
WIDEST = 1000  # columns of a matrix
TIMES = ("t", "time")
DATA = ("data", "values", "signals")
Tree = Mapping[str, Any]  # arrays of numbers (n, k), and trees, by name


def is_matlab(head: bytes) -> bool:
    """Whether a file begins as MATLAB's do."""
    return head.startswith((MAGIC, MAGIC_HDF5)) or _is_version_4(head)


def _is_version_4(head: bytes) -> bool:
    """Five whole numbers: type, rows, columns, whether there is an imaginary part, letters of the name."""
    if len(head) < 21:
        return False
    for order in "<>":
        kind, rows, columns, imaginary, letters = (int(one) for one in np.frombuffer(head[:20], f"{order}i4"))
        digits = [kind // 1000, kind // 100 % 10, kind // 10 % 10, kind % 10]
        fits = kind >= 0 and digits[0] in (0, 1) and digits[1] == 0 and digits[2] <= 5 and digits[3] <= 2
        if fits and rows >= 0 and columns >= 0 and imaginary in (0, 1) and 2 <= letters <= 64:
            name = head[20 : 20 + letters]
            if len(name) == letters and name.endswith(b"\0") and name[:-1].replace(b"_", b"a").isalnum():
                return True
    return False


def read_matlab(path: Path, asked: Asked) -> SeriesFile:
    """The series of a MATLAB file.

    Raises InputError if it is damaged, or has no vector of times; OSError if it cannot be read.
    """
    data = contents(path, available() // 4)
    try:
        tree = _of_hdf5(data) if data.startswith(MAGIC_HDF5) else _of_scipy(data)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    except Exception as error:  # scipy, zlib and HDF5 have errors of many kinds for what is damaged
        said = cleaned(str(error)).partition("\n")[0][:200]
        raise InputError(
            f"{path}: is no whole MATLAB file ({said}); allowed: versions 4 to 7.3, with vectors of numbers"
        ) from None
    groups = list(_groups(tree, ""))
    if not any(columns for _, columns in groups):
        known = ", ".join(short(name) for name in list(tree)[:6]) or "nothing"
        raise InputError(
            f"{path}: has no vector of times with others as long; allowed: a vector t or time beside them; it "
            f"has {known}"
        )
    return series_file(path, "MATLAB file", [one for one in groups if one[1]], asked)


def _groups(tree: Tree, above: str) -> Iterator[tuple[Column, list[Column]]]:
    """A column of times, and those beside it that are as long, for each structure that has one."""
    arrays = {name: one for name, one in tree.items() if isinstance(one, np.ndarray)}
    titles = {name: split_title(name)[0].casefold() for name, one in arrays.items() if one.shape[1] == 1}
    times = [name for name, title in titles.items() if title in TIMES]
    if len(times) > 1:
        raise InputError(f"{above or 'file'}: {len(times)} vectors of times, {', '.join(times)}; allowed: one")
    if times:
        name, unit, _ = split_title(times[0])
        time = arrays.pop(times[0])[:, 0]
        columns = []
        for other, values in arrays.items():
            if values.shape[0] == time.size and values.shape[1] <= WIDEST:
                columns += _named(above, other, values)
        yield Column(f"{above}{name}", unit, time), columns
    for name, one in tree.items():
        if isinstance(one, Mapping):
            yield from _groups(one, f"{above}{name}.")


def _named(above: str, title: str, values: Any) -> list[Column]:
    """The columns of an array, without the name of the data of a timeseries."""
    name, unit, _ = split_title(title)
    whole = above.rstrip(".") if name.casefold() in DATA and above else f"{above}{name}"
    if values.shape[1] == 1:
        return [Column(whole, unit, values[:, 0])]
    return [Column(f"{whole}.{n + 1}", unit, values[:, n]) for n in range(values.shape[1])]


def _standing(values: Any) -> Any:
    """Numbers as columns (n, k): a row is one column; None for what is no vector or matrix of numbers."""
    if values.dtype.kind not in "fiub" or values.ndim > 2 or values.size < 2:
        return None
    table = np.asarray(values, dtype=np.float64)
    return table.reshape(-1, 1) if table.ndim < 2 or 1 in table.shape else table


# --- versions 4 to 7 ---


def _of_scipy(data: bytes) -> Tree:
    from scipy.io import loadmat

    _check_declared(data)
    stream: Any = io.BytesIO(data)  # which scipy takes, and its stubs do not tell
    found = loadmat(stream, squeeze_me=False)
    left = [MOST]
    trees = {name: _of_array(item, DEEPEST, left) for name, item in found.items()}
    return {name: one for name, one in trees.items() if one is not None}


def _check_declared(data: bytes) -> None:
    """Raise ValueError if what is compressed would not fit into memory: zlib's ratio is a thousand at most."""
    if 1032 * len(data) <= available() // 8:
        return
    import zlib

    place, most = 128, available() // 8
    while not _is_version_4(data) and place + 8 <= len(data):
        kind, size = (int(one) for one in np.frombuffer(data[place : place + 8], "<u4"))
        if kind == 15:
            unpacked, squeezed = zlib.decompressobj(), memoryview(data)[place + 8 : place + 8 + size]
            for start in range(0, len(squeezed), 2**16):
                most -= len(unpacked.decompress(squeezed[start : start + 2**16]))
                if most < 0:
                    raise ValueError("it is compressed, and does not fit into memory")
        place += 8 + size


def _of_array(item: Any, depth: int, left: list[int]) -> Any:
    """Numbers as columns, a structure as a tree; None for all else."""
    left[0] -= 1
    if left[0] < 0 or depth < 0:
        raise ValueError(f"it has more than {MOST} variables and fields, or {DEEPEST} structures in structures")
    if not isinstance(item, np.ndarray):
        return None
    if item.dtype.names and item.size == 1:
        fields = {name: _of_array(item.reshape(-1)[0][name], depth - 1, left) for name in item.dtype.names}
        return {name: one for name, one in fields.items() if one is not None}
    return None if item.dtype.names else _standing(item)


# --- version 7.3 ---


def _of_hdf5(data: bytes) -> Tree:
    with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
        return _of_group(file, DEEPEST, [MOST], [available() // 4])


def _of_group(group: Any, depth: int, left: list[int], room: list[int]) -> Tree:
    """The vectors and structures of a group; nothing that stands in other files."""
    if depth < 0:
        raise ValueError(f"it has more than {DEEPEST} structures in structures")
    found: dict[str, Any] = {}
    for name in group:
        left[0] -= 1
        if left[0] < 0:
            raise ValueError(f"it has more than {MOST} variables and fields")
        if name.startswith("#") or not isinstance(group.get(name, getlink=True), h5py.HardLink):
            continue
        item = group[name]
        if isinstance(item, h5py.Group):
            found[name] = _of_group(item, depth - 1, left, room)
        elif isinstance(item, h5py.Dataset) and (values := _of_data(item, room)) is not None:
            found[name] = values
    return found


def _of_data(item: Any, room: list[int]) -> Any:
    if item.external or item.is_virtual or item.dtype.kind not in "fiu" or "MATLAB_empty" in item.attrs:
        return None
    room[0] -= int(np.prod(item.shape, dtype=object)) * 8
    if room[0] < 0:
        raise ValueError("it does not fit into memory")
    values = item[()]
    return _standing(values.T)  # which MATLAB keeps the other way round
