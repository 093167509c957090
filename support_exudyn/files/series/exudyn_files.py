"""Series of Exudyn's own files: sensors, and solutions as text or binary (`EXUBIN`).

A sensor's file has the sensor's values over time, a solution's file the coordinates of the system, both behind
lines of comments. Formats are as Exudyn 1.13 writes them, and as its `exudyn.plot` and `LoadSolutionFile` read
them. Units are those that a model was made in, which no file tells: they are asked for, of times as well as of
values. Only of solutions that this program has written it is known that times are in seconds.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path
from typing import Any

import numpy as np

from support_exudyn.files.series.columns import Column, Numbers, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.table_layout import TableLayout
from support_exudyn.files.series.text_tables import columns_of, lines_of
from user_forces.values.value import InputError

BINARY = b"EXUBIN"
FINISHED = "#simulation finished"  # ends solutions as text
OURS = "channels and scenario are in the run's file"  # in solutions of this program
HEADER = 20  # lines that comments at the beginning may have
VECTORS = (  # what sensors measure that has three components, by the ends of Exudyn's words
    *("Position", "Displacement", "Velocity", "VelocityLocal", "Acceleration", "AccelerationLocal"),
    *("Rotation", "Force", "ForceLocal", "Torque", "TorqueLocal"),
)
GROUPS = ("ODE2", "ODE2_t", "ODE2_tt", "ODE1", "ODE1_t", "algebraic", "data")  # coordinates that are written
WRITTEN = re.compile(r"#number of written coordinates \[[\w, ]+\] = \[(\d{1,9}(?:,\d{1,9}){6})\]")
SENSORS = re.compile(r"#number of sensor values = (\d{1,6})")
MEASURED = re.compile(r"#OutputVariableType *= *(\w*)")


def read_exudyn_text(path: Path, asked: Asked) -> SeriesFile:
    """The series of a sensor's file, or of a solution as text.

    Raises InputError if it is damaged, with the line; OSError if it cannot be read.
    """
    lines, notes = lines_of(path)
    header = [*takewhile(lambda line: line.startswith("#"), lines[:HEADER])]
    if not any(lines[len(header) :]):
        raise InputError(f"{path}: has no rows; allowed: one or more below its comments")
    sensor = "sensor output file" in header[0].lower()
    if sensor:
        names = _of_sensor(path, "\n".join(header))
    elif found := WRITTEN.search("\n".join(header)):
        names = _coordinates(path, [int(one) for one in found[1].split(",")])
    else:
        raise InputError(f"{path}: lacks its line '#number of written coordinates ...'; allowed: with it")
    if not sensor and not any(line.startswith(FINISHED) for line in lines[-HEADER:]):
        notes.append("There is no line '#simulation finished': the run was cut off, or the file was.")
    titles = (("time", "s" if any(OURS in line for line in header) else None), *((one, None) for one in names))
    columns, _ = columns_of(path, lines, TableLayout(",", ".", len(header), titles, ("number",) * len(titles)))
    kind = "sensor of Exudyn" if sensor else "solution of Exudyn"
    return series_file(path, kind, [(columns[0], columns[1:])], asked, notes)


def _of_sensor(path: Path, header: str) -> list[str]:
    """The names of a sensor's values."""
    if not (found := SENSORS.search(header)) or not (count := int(found[1])):
        raise InputError(f"{path}: lacks its line '#number of sensor values = ...'; allowed: 1 or more")
    measured = MEASURED.search(header)
    kind = measured[1] if measured and measured[1] not in ("", "_None") else "value"
    if count == 3 and kind.endswith(VECTORS):
        return [f"{kind}.{axis}" for axis in "xyz"]
    return [kind] if count == 1 else [f"{kind}.{n}" for n in range(count)]


def _coordinates(path: Path, counts: Sequence[int]) -> list[str]:
    if len(counts) != len(GROUPS) or min(counts) < 0 or not 0 < sum(counts) <= 10_000_000:
        raise InputError(
            f"{path}: its numbers of coordinates are {[*counts][:9]}; allowed: {len(GROUPS)}, of which the sum "
            "is 1 to 10000000"
        )
    return [f"{group}.{n}" for group, count in zip(GROUPS, counts, strict=True) for n in range(count)]


# --- binary ---


class _Binary:
    """The bytes of a binary solution, read one item after the other. Raises ValueError at their end."""

    def __init__(self, data: bytes) -> None:
        self.data, self.place = data, len(BINARY) + 10
        self.whole, self.real = (np.dtype(f"<{kind}{n}") for kind, n in zip("if", data[7:9], strict=True))

    def take(self, count: int, kind: Any) -> Any:
        found = np.frombuffer(self.data, kind, count, self.place)
        self.place += found.nbytes
        return found

    def counted(self, kind: Any) -> Any:
        """Items behind their number."""
        return self.take(int(self.take(1, self.whole)[0]), kind)

    def text(self) -> str:
        return bytes(self.counted("u1")).decode("utf-8", "replace")


def read_exudyn_binary(path: Path, asked: Asked) -> SeriesFile:
    """The series of a binary solution.

    Raises InputError if it is damaged, with the byte; OSError if it cannot be read.
    """
    data = path.read_bytes()
    place = 0
    try:
        reading = _Binary(data)
        for _ in range(4):  # version, mode, solver, date
            reading.text()
        reading.counted(reading.whole)  # sizes of the system
        counts = reading.counted(reading.whole).tolist()
        reading.take(2, reading.whole)  # coordinates in all, steps that were planned
        about, end = reading.text(), reading.text()
        place = reading.place
    except (ValueError, TypeError):
        end = ""
    if end != "EndOfHeader":
        raise InputError(
            f"{path}: in its header the file ends; allowed: the whole of a binary solution of Exudyn"
        )
    names = _coordinates(path, counts)
    rows = _rows(path, data[place:], len(names) + 1, reading)
    titles = [("time", "s" if OURS in about else None), *((name, None) for name in names)]
    columns = [Column(name, unit, one) for (name, unit), one in zip(titles, rows.T, strict=True)]
    return series_file(path, "solution of Exudyn", [(columns[0], columns[1:])], asked)


def _rows(path: Path, data: bytes, width: int, reading: _Binary) -> Numbers:
    """The rows behind the header, each behind its length; -1 ends them."""
    row = np.dtype([("length", reading.whole), ("values", reading.real, (width,))])
    found = np.frombuffer(data, row, len(data) // row.itemsize)
    wrong = np.flatnonzero(found["length"] != width)
    found = found[: wrong[0]] if wrong.size else found
    if data[found.nbytes :][: reading.whole.itemsize] != b"\xff" * reading.whole.itemsize:
        raise InputError(
            f"{path}: row {found.size + 1} is not of {width} numbers; allowed: rows that are, and -1 at the end"
        )
    if not found.size:
        raise InputError(f"{path}: has no rows; allowed: one or more")
    return found["values"].astype(np.float64)
