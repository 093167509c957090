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

from support_exudyn.files.series.columns import Column, Group, Numbers, first_names, named_times, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.units import read_unit, split_title
from user_forces.values.value import InputError, cleaned

MAGIC, MAGIC_HDF5 = b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"
WIDEST = 1000  # columns of a matrix
LETTERS = 300  # of an error of scipy or h5py that are shown
DATA = ("data", "values", "signals")
UNIT = re.compile(r"\[([^\[\]|]*)(?:\|[^\[\]]*)?\]\s*$")  # "angle [rad|deg]": a unit, and that for display
MODELICA = {"Aclass", "name", "dataInfo"}
OPAQUE = ("MatlabOpaque", "MatlabFunction")  # classes of scipy for what only MATLAB reads
RATES, INTERVALS = ("fs", "samplerate", "sample_rate", "samplingrate", "rate"), ("dt", "ts")  # names of numbers
Tree = Mapping[str, Any]  # structures as mappings, their arrays as lists, numbers as arrays, texts


class _Object(str):
    """The class of an object of MATLAB, which only MATLAB reads."""

    __slots__ = ()


def is_matlab(head: bytes) -> bool:
    """Whether a file begins as MATLAB's do."""
    return head.startswith((MAGIC, MAGIC_HDF5)) or _is_version_4(head)


def _is_version_4(head: bytes) -> bool:
    """Five whole numbers: type, rows, columns, whether there is an imaginary part, letters of the name."""
    for order in "<>" if len(head) >= 22 else "":
        kind, rows, columns, imaginary, letters = np.frombuffer(head[:20], f"{order}i4").tolist()
        digits = f"{kind:04d}"  # order of bytes, 0, type of the numbers, kind of the matrix
        known = len(digits) == 4 and digits[0] in "01" and digits[1] == "0" and digits[2] <= "5"
        name = head[20 : 20 + max(0, letters)]
        if known and min(rows, columns) >= 0 and imaginary in (0, 1) and name[-1:] == b"\0":
            return name[:-1].replace(b"_", b"a").isalnum()
    return False


def read_matlab(path: Path, asked: Asked) -> SeriesFile:
    """The series of a MATLAB file.

    Raises InputError if it is damaged, or has no vector of times; OSError if it cannot be read.
    """
    data = path.read_bytes()
    try:
        tree = _of_hdf5(data) if data.startswith(MAGIC_HDF5) else _of_scipy(data)
        if tree.keys() >= MODELICA:
            return _of_modelica(path, tree, asked)
    except InputError:
        raise
    except Exception as error:  # of many kinds, by scipy and h5py
        why = cleaned(" ".join(f"{error or type(error).__name__}".split()))[:LETTERS]
        raise InputError(f"{path}: is no MATLAB file that can be read ({why}); allowed: a whole one") from None
    groups = list(_groups(path, tree, (), None)) or _of_rate(tree, asked.rate)
    phrase = "; ".join(f"{name} ({one})" for name, one in tree.items() if isinstance(one, _Object))
    if not groups and phrase:
        raise InputError(
            f"{path}: has nothing but objects of MATLAB, which only MATLAB reads: {phrase}; allowed: "
            "arrays, as by t = ts.Time; y = ts.Data; save('file.mat', 't', 'y'), or Simulink's format Array or "
            "Structure With Time"
        )
    if not groups:
        raise InputError(
            f"{path}: has no vector of times with others as long; allowed: a vector t or time beside them; its "
            f"variables are {first_names(tree) or 'none'}"
        )
    notes = [f"Objects of MATLAB, which only MATLAB reads, are left out: {phrase}."] if phrase else []
    return series_file(path, "MATLAB file", groups, asked, notes)


# --- series of structures ---


def _vectors(tree: Tree) -> dict[str, Numbers]:
    """Vectors and matrices (n, k) among the fields of a structure; a row counts as a column."""
    found = {}
    for name, values in tree.items():
        if isinstance(values, np.ndarray) and values.dtype.kind in "fiub" and values.size > 1:
            table = values.squeeze()
            if table.ndim == 3:  # Simulink's matrices over time: the last index is the time's
                table = np.moveaxis(table, -1, 0)
            if table.ndim < 4:
                found[name] = np.asarray(table, dtype=np.float64).reshape(table.shape[0], -1)
    return found


def _groups(path: Path, tree: Tree, above: tuple[str, ...], times: Column | None) -> Iterator[Group]:
    """Times, each with its columns, of a structure and of those in it, which may have times of their own."""
    vectors, signals = _vectors(tree), _signals(tree)
    names = [name for name, values in vectors.items() if values.shape[1] == 1]
    titles = [names[n] for n in named_times([split_title(one)[:2] for one in names])]
    titles = titles or [one for one in names if one == "tout"]
    if len(titles) > 1:
        raise InputError(f"{path}: has {len(titles)} vectors of times, {', '.join(titles)}; allowed: one")
    if titles:
        name, unit, _ = split_title(titles[0])
        in_seconds = "s" if name == "tout" or signals else None  # of Simulink
        times = Column(".".join((*above, name)), unit or in_seconds, vectors.pop(titles[0])[:, 0])
    if times is not None:
        count = times.values.size
        fitting = {name: one if len(one) == count else one.T for name, one in signals.items()}
        fitting = {**vectors, **fitting}
        columns = [
            column
            for name, values in fitting.items()
            if len(values) == count and values.shape[1] <= WIDEST
            for column in _columns((*above, name), values)
        ]
        if columns:
            yield times, columns
    for name, item in tree.items():
        if name == "signals" and signals:
            continue
        if isinstance(item, Mapping):
            yield from _groups(path, item, (*above, name), times)
        for n, one in enumerate(item if isinstance(item, list) else (), 1):
            if isinstance(one, Mapping):
                yield from _groups(path, one, (*above, f"{name}.{n}"), times)


def _of_rate(tree: Tree, rate: float | None) -> list[Group]:
    """Times at a rate [Hz], by default that of a number `fs` or `dt` in the file, with the longest columns."""
    real = {
        name: one for name, one in tree.items() if np.size(one) == 1 and np.asarray(one).dtype.kind in "fiu"
    }
    numbers = {name.casefold(): float(one) for name, one in real.items()}
    known = [numbers[name] for name in RATES if name in numbers]
    known += [1.0 / numbers[name] for name in INTERVALS if numbers.get(name)]
    rate = rate or next((one for one in known if one > 0.0), None)
    found = [one for name, values in _vectors(tree).items() for one in _columns((name,), values)]
    size = max((one.values.size for one in found), default=0)
    if rate is None or not size:
        return []
    times = Column("time at the rate", "s", np.arange(size) / rate)
    return [(times, [one for one in found if one.values.size == size])]


def _columns(place: tuple[str, ...], values: Numbers) -> list[Column]:
    """The columns of a matrix (n, k), called by its name and their numbers."""
    name, unit, _ = split_title(place[-1])
    whole = ".".join(place[:-1] if name.casefold() in DATA and place[:-1] else (*place[:-1], name))
    several = values.shape[1] > 1
    return [Column(f"{whole}.{n}" if several else whole, unit, one) for n, one in enumerate(values.T, 1)]


def _signals(tree: Tree) -> dict[str, Numbers]:
    """The values of the signals of Simulink's structure with time, by their labels, blocks or numbers."""
    signals = tree.get("signals")
    found = {}
    for n, one in enumerate(signals if isinstance(signals, list) else [signals], 1):
        if isinstance(one, Mapping) and (values := _vectors({"values": one.get("values")})):
            labels = [one.get(key) for key in ("label", "blockName")]
            named = (text.rpartition("/")[2] for text in labels if isinstance(text, str) and text.strip())
            found[next(named, f"signal{n}")] = values["values"]
    return found


# --- Dymola and OpenModelica ---


def _of_modelica(path: Path, tree: Tree, asked: Asked) -> SeriesFile:
    """The variables of a simulation in Modelica; parameters, which do not change, are series of two points."""
    is_transposed = any("trans" in str(one).casefold() for one in np.atleast_1d(tree["Aclass"])[3:4])
    names, remarks = (_words(tree.get(key, ()), is_transposed) for key in ("name", "description"))
    tables = {
        key: np.atleast_2d(np.asarray(tree[key], dtype=np.float64))
        for key in ("dataInfo", "data_1", "data_2")
        if key in tree
    }
    rows = tables if is_transposed else {key: one.T for key, one in tables.items()}
    groups = {key: (Column("Time", "s", rows[key][0]), list[Column]()) for key in rows if key != "dataInfo"}
    for n, name in enumerate(names):
        key, place = f"data_{int(rows['dataInfo'][0, n])}", int(rows["dataInfo"][1, n])
        if key in groups and abs(place) > 1:
            unit = UNIT.search(remarks[n]) if n < len(remarks) else None
            values = np.sign(place) * rows[key][abs(place) - 1]
            groups[key][1].append(Column(name, read_unit(unit[1])[0] if unit else None, values))
    return series_file(path, "simulation in Modelica", groups.values(), asked)


def _words(matrix: Any, is_transposed: bool) -> list[str]:
    """The texts of a matrix of letters: rows as scipy gives them, or its columns."""
    rows = [str(one) for one in np.atleast_1d(matrix)]
    if is_transposed:
        width = max(map(len, rows), default=0)
        rows = ["".join(letters) for letters in zip(*(one.ljust(width) for one in rows), strict=True)]
    return [one.strip(" \0") for one in rows]


# --- what is in files, by scipy and h5py ---


def _of_scipy(data: bytes) -> Tree:
    """The variables of a file of version 4 to 7."""
    from scipy.io.matlab import loadmat

    stream: Any = io.BytesIO(data)  # which scipy takes, and its stubs do not tell
    found = loadmat(stream, simplify_cells=data.startswith(MAGIC))
    return {name: _plain(one) for name, one in found.items() if not name.startswith("__")}


def _plain(item: Any) -> Any:
    """An item of scipy's, with a class in place of an object of MATLAB, and a list in place of cells."""
    if isinstance(item, dict):
        return {name: _plain(one) for name, one in item.items()}
    if type(item).__name__ in OPAQUE:
        names = [key for key in ("s0", "s2") if key in (item.dtype.names or ())]
        return _Object(" of class ".join(str(item[key].reshape(-1)[0]) for key in names) or "a function")
    return [_plain(one) for one in item] if isinstance(item, list) or np.asarray(item).dtype == "O" else item


def _of_hdf5(data: bytes) -> Tree:
    """The variables of a file of version 7.3; nothing that stands in other files."""
    with h5py.File(h5py.h5f.open_file_image(data), "r") as file:
        found = _of_item(file, file)
    return found if isinstance(found, dict) else {"signals": found}


def _of_item(file: Any, item: Any) -> Any:
    """An item of a file of version 7.3, which MATLAB keeps the other way round."""
    if "MATLAB_object_decode" in item.attrs:
        return _Object(bytes(item.attrs.get("MATLAB_class", b"object")).decode())
    if isinstance(item, h5py.Group):
        names = [one for one in item if isinstance(item.get(one, getlink=True), h5py.HardLink)]
        found = {name: _of_item(file, item[name]) for name in names if not name.startswith("#")}
        sizes = {len(one) if isinstance(one, list) else -1 for one in found.values()}
        if len(sizes) != 1 or -1 in sizes:
            return found
        return [dict(zip(found, one, strict=True)) for one in zip(*found.values(), strict=True)]  # structures
    if item.external or item.is_virtual or "MATLAB_empty" in item.attrs:
        return None
    if item.dtype == h5py.ref_dtype:
        return [_of_item(file, file[one]) for one in item[()].reshape(-1) if one]
    if item.attrs.get("MATLAB_class") in (b"char", np.bytes_(b"char")):
        return "".join(map(chr, item[()].T.reshape(-1, order="F")))
    return item[()].T if item.dtype.kind in "fiu" else None
