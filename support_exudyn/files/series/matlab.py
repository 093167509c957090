"""Series of MATLAB files of versions 4 to 7.3, also as Simulink, Dymola and OpenModelica write them.

A vector of times is called time, t, T or tout, in this order. All vectors as long as it, next to it and in
structures without times of their own, are series; so are the columns of a matrix that has as many rows. Names
are joined by points, `run.pin.force`. MATLAB keeps no units: a name such as `force_kN` has one, of all others
it is asked for.

Simulink's structure with time has `time` [s] and `signals`, each with `values` and a `label`. A structure with
the fields Time and Data is taken as a timeseries. Objects, as timeseries and Dataset, are read by MATLAB alone.

Dymola and OpenModelica write version 4: the matrix `name`, `description` with units in brackets, `dataInfo`,
which says of each name the matrix, the column and the sign, and the matrices `data_1` and `data_2`.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, Numbers, first_names, named_times, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.units import read_unit, split_title
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, cleaned

MAGIC, MAGIC_HDF5 = b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"
DEEPEST = 8  # structures in structures
WIDEST = 1000  # columns of a matrix
TOLD = 300  # letters of what went wrong
DATA = ("data", "values", "signals")
UNIT = re.compile(r"\[([^\[\]|]*)(?:\|[^\[\]]*)?\]\s*$")  # "angle [rad|deg]": a unit, and that for display
MODELICA = ("Aclass", "name", "dataInfo")
Tree = Mapping[str, Any]  # structures as mappings, their arrays as lists, numbers as arrays, texts


class _Object(str):
    """The class of an object of MATLAB, which only MATLAB reads."""

    __slots__ = ()


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
    try:
        tree = _of_hdf5(data) if data.startswith(MAGIC_HDF5) else _of_scipy(data)
        if all(key in tree for key in MODELICA):
            return _of_modelica(path, tree, asked)
    except InputError:
        raise
    except Exception as error:  # of many kinds, by scipy and h5py
        why = cleaned(" ".join(f"{error or type(error).__name__}".split()))[:TOLD]
        raise InputError(f"{path}: is no MATLAB file that can be read ({why}); allowed: a whole one") from None
    groups = list(_groups(path, tree, (), None))
    if not groups:
        groups = _of_rate(tree, asked.rate)
    objects = sorted({f"{name} ({kind})" for name, kind in _objects(tree, ())})
    phrase = "; ".join(objects[:4])
    if not groups and objects:
        raise InputError(
            f"{path}: has nothing but objects of MATLAB, which only MATLAB reads: {phrase}; allowed: "
            "arrays, as by t = ts.Time; y = ts.Data; save('file.mat', 't', 'y'), or Simulink's format Array or "
            "Structure With Time"
        )
    if not groups:
        names = [".".join(one) for one, _ in _arrays(tree, ())]
        raise InputError(
            f"{path}: has no vector of times with others as long; allowed: a vector t or time beside them; its "
            f"vectors are {first_names(names) or 'none'}"
        )
    notes = [f"Objects of MATLAB, which only MATLAB reads, are left out: {phrase}."] if objects else []
    return series_file(path, "MATLAB file", groups, asked, notes)


# --- series of structures ---


def _vectors(tree: Tree) -> dict[str, Numbers]:
    """Vectors and matrices (n, k) among the fields of a structure; a row counts as a column."""
    found = {}
    for name, values in tree.items():
        if isinstance(values, np.ndarray) and values.dtype.kind in "fiub" and values.size > 1:
            table = values.squeeze() if values.ndim < 4 else values
            if table.ndim == 3:  # Simulink's matrices over time: the last index is the time's
                table = np.moveaxis(table, -1, 0).reshape(table.shape[-1], -1)
            if table.ndim in (1, 2):
                found[name] = np.asarray(table, dtype=np.float64).reshape(table.shape[0], -1)
    return found


def _groups(
    path: Path, tree: Tree, above: tuple[str, ...], times: Column | None
) -> Iterator[tuple[Column, list[Column]]]:
    """Times, each with its columns, of a structure and of those in it, which may have times of their own."""
    vectors = _vectors(tree)
    names = [name for name, values in vectors.items() if values.shape[1] == 1]
    titles = [names[n] for n in named_times([split_title(one)[:2] for one in names])]
    titles = titles or [one for one in names if one == "tout"]
    if len(titles) > 1:
        raise InputError(f"{path}: has {len(titles)} vectors of times, {', '.join(titles)}; allowed: one")
    if titles:
        name, unit, _ = split_title(titles[0])
        in_seconds = "s" if name == "tout" or _signals(tree) else None  # of Simulink
        times = Column(".".join((*above, name)), unit or in_seconds, vectors.pop(titles[0])[:, 0])
    if times is not None:
        columns = [
            one
            for name, values in vectors.items()
            if len(values) == times.values.size and values.shape[1] <= WIDEST
            for one in _columns((*above, name), values)
        ]
        columns += [
            one for n, signal in _signals(tree) for one in _of_signal(above, n, signal, times.values.size)
        ]
        if columns:
            yield times, columns
    for name, inside in tree.items():
        if isinstance(inside, Mapping) and not (name == "signals" and "values" in inside):
            yield from _groups(path, inside, (*above, name), times)
        elif isinstance(inside, list) and name != "signals":
            for n, one in enumerate(inside, 1):
                if isinstance(one, Mapping):
                    yield from _groups(path, one, (*above, f"{name}.{n}"), times)


def _of_rate(tree: Tree, rate: float | None) -> list[tuple[Column, list[Column]]]:
    """Times at a rate [Hz], by default that of a number `fs` or `dt` in the file, with the longest columns."""
    numbers = {
        name.casefold(): one.item()
        for name, one in tree.items()
        if isinstance(one, np.ndarray) and one.size == 1 and one.dtype.kind in "fiu"
    }
    known = [
        numbers[name] for name in ("fs", "samplerate", "sample_rate", "samplingrate", "rate") if name in numbers
    ]
    known += [1.0 / numbers[name] for name in ("dt", "ts") if numbers.get(name)]
    rate = rate or next((float(one) for one in known if one > 0.0), None)
    found = [one for name, values in _vectors(tree).items() for one in _columns((name,), values)]
    size = max((one.values.size for one in found), default=0)
    if rate is None or not size:
        return []
    return [
        (
            Column("time at the rate", "s", np.arange(size) / rate),
            [one for one in found if one.values.size == size],
        )
    ]


def _columns(place: tuple[str, ...], values: Numbers) -> list[Column]:
    """The columns of a matrix (n, k), called by its name and their numbers."""
    name, unit, _ = split_title(place[-1])
    whole = ".".join(place[:-1] if name.casefold() in DATA and place[:-1] else (*place[:-1], name))
    several = values.shape[1] > 1
    return [
        Column(f"{whole}.{n + 1}" if several else whole, unit, values[:, n]) for n in range(values.shape[1])
    ]


def _signals(tree: Tree) -> list[tuple[int, Tree]]:
    """The signals of Simulink's structure with time, with their numbers from 1 on."""
    signals = tree.get("signals")
    found = signals if isinstance(signals, list) else [signals]
    return [(n, one) for n, one in enumerate(found, 1) if isinstance(one, Mapping) and "values" in one]


def _of_signal(above: tuple[str, ...], n: int, signal: Tree, count: int) -> list[Column]:
    """The columns of a signal, called by its label, its block or its number."""
    values = _vectors({"values": signal["values"]}).get("values")
    if values is None or count not in values.shape:
        return []
    values = values if len(values) == count else values.T
    labels = [signal.get(key) for key in ("label", "blockName")]
    label = next(
        (one.rpartition("/")[2] for one in labels if isinstance(one, str) and one.strip()), f"signal{n}"
    )
    return _columns((*above, label), values)


# --- Dymola and OpenModelica ---


def _of_modelica(path: Path, tree: Tree, asked: Asked) -> SeriesFile:
    """The variables of a simulation in Modelica; parameters, which do not change, are series of two points."""
    form = [str(one).strip() for one in np.atleast_1d(tree["Aclass"])]
    is_transposed = len(form) > 3 and "trans" in form[3].casefold()
    names, remarks = (_words(tree.get(key, ()), is_transposed) for key in ("name", "description"))
    info = np.asarray(tree["dataInfo"]).astype(int)
    info = info if is_transposed else info.T
    data = {
        key: np.atleast_2d(np.asarray(tree[f"data_{key}"], dtype=np.float64))
        for key in (1, 2)
        if f"data_{key}" in tree
    }
    data = data if is_transposed else {key: one.T for key, one in data.items()}
    times: dict[int, Column] = {key: Column("Time", "s", one[0]) for key, one in data.items()}
    columns: dict[int, list[Column]] = {key: [] for key in data}
    for n, name in enumerate(names):
        matrix, place = int(info[0, n]), int(info[1, n])
        if matrix in data and place and abs(place) > 1:
            unit = UNIT.search(remarks[n]) if n < len(remarks) else None
            values = np.sign(place) * data[matrix][abs(place) - 1]
            columns[matrix].append(Column(name, read_unit(unit[1])[0] if unit else None, values))
    return series_file(
        path, "simulation in Modelica", [(times[key], columns[key]) for key in sorted(data)], asked
    )


def _words(matrix: Any, is_transposed: bool) -> list[str]:
    """The texts of a matrix of letters: rows as scipy gives them, or its columns."""
    rows = [str(one) for one in np.atleast_1d(matrix)]
    if is_transposed:
        width = max(map(len, rows), default=0)
        rows = ["".join(letters) for letters in zip(*(one.ljust(width) for one in rows), strict=True)]
    return [one.strip(" \0") for one in rows]


# --- what is in files, by scipy and h5py ---


def _objects(tree: Tree, above: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    """Objects of MATLAB, by their names and classes."""
    for name, item in tree.items():
        if isinstance(item, _Object):
            yield ".".join((*above, name)), str(item)
        elif isinstance(item, Mapping):
            yield from _objects(item, (*above, name))


def _arrays(tree: Tree, above: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    for name, item in tree.items():
        if isinstance(item, Mapping):
            yield from _arrays(item, (*above, name))
        elif isinstance(item, np.ndarray):
            yield (*above, name), item


def _of_scipy(data: bytes) -> Tree:
    """The variables of a file of version 4 to 7."""
    from scipy.io.matlab import loadmat

    stream: Any = io.BytesIO(data)  # which scipy takes, and its stubs do not tell
    return {name: _plain(one, 0) for name, one in loadmat(stream).items() if not name.startswith("__")}


def _plain(item: Any, depth: int) -> Any:
    """An item of scipy's as mappings, lists, arrays and texts."""
    if depth > DEEPEST:
        raise ValueError(f"it has more than {DEEPEST} structures in structures")
    kind = getattr(item, "dtype", None)
    if kind is None:
        return item
    if type(item).__name__ in ("MatlabOpaque", "MatlabObject", "MatlabFunction"):
        words = [str(item[name].reshape(-1)[0]) for name in ("s0", "s2")] if "s2" in (kind.names or ()) else []
        return _Object(" of class ".join(words) or getattr(item, "classname", "a function"))
    if kind.names:
        found = [{name: _plain(one[name], depth + 1) for name in kind.names} for one in item.reshape(-1)]
        return found[0] if len(found) == 1 else found
    if kind.kind == "O":
        cells = [_plain(one, depth + 1) for one in item.reshape(-1)]
        return cells[0] if len(cells) == 1 else cells
    return str(item.reshape(-1)[0]) if kind.kind in "US" and item.size == 1 else item


def _of_hdf5(data: bytes) -> Tree:
    """The variables of a file of version 7.3; nothing that stands in other files."""
    with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
        return _of_group(file, file, 0)


def _of_group(file: Any, group: Any, depth: int) -> Tree:
    found = {}
    for name in group:
        if not name.startswith("#") and isinstance(group.get(name, getlink=True), h5py.HardLink):
            found[name] = _of_item(file, group[name], depth + 1)
    lists = {name: one for name, one in found.items() if isinstance(one, list)}
    if (
        found and len(lists) == len(found) and len({len(one) for one in lists.values()}) == 1
    ):  # an array of structures
        return {"signals": [dict(zip(lists, one, strict=True)) for one in zip(*lists.values(), strict=True)]}
    return found


def _of_item(file: Any, item: Any, depth: int) -> Any:
    """An item of a file of version 7.3, which MATLAB keeps the other way round."""
    if depth > DEEPEST:
        raise ValueError(f"it has more than {DEEPEST} structures in structures")
    if "MATLAB_object_decode" in item.attrs:
        return _Object(bytes(item.attrs.get("MATLAB_class", b"object")).decode())
    if isinstance(item, h5py.Group):
        inside = _of_group(file, item, depth)
        return inside["signals"] if isinstance(inside, Mapping) and list(inside) == ["signals"] else inside
    if item.external or item.is_virtual or "MATLAB_empty" in item.attrs:
        return None
    if item.dtype == h5py.ref_dtype:
        return [_of_item(file, file[one], depth + 1) for one in item[()].reshape(-1) if one]
    if item.attrs.get("MATLAB_class") in (b"char", np.bytes_(b"char")):
        return "".join(map(chr, item[()].T.reshape(-1, order="F")))
    return item[()].T if item.dtype.kind in "fiu" else None
