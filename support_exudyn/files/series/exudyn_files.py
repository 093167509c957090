"""Series of Exudyn's own files: sensors, and solutions as text or binary (`EXUBIN`).

A sensor's file has the sensor's values over time, a solution's file the coordinates of the system, both behind
lines of comments. Formats are as Exudyn 1.13 writes them, and as its `exudyn.plot` and `LoadSolutionFile` read
them. Units are those that a model was made in, which no file tells: they are asked for, of times as well as of
values. Only of solutions that this program has written it is known that times are in seconds.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from support_exudyn.files.free_memory import available
from support_exudyn.files.series.columns import Column, Numbers, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.table_layout import TableLayout
from support_exudyn.files.series.text_tables import columns_of, lines_of, text_of
from support_exudyn.files.whole_file import contents
from user_forces.values.value import InputError, short

BINARY = b"EXUBIN"
FINISHED = b"\n#simulation finished"  # ends solutions as text
OURS = "channels and scenario are in the run's file"  # in solutions of this program
HEADER = 20  # lines that comments at the beginning may have
VECTORS = (  # what sensors measure that has three components, by the ends of Exudyn's words
    *("Position", "Displacement", "Velocity", "VelocityLocal", "Acceleration", "AccelerationLocal"),
    *("Rotation", "Force", "ForceLocal", "Torque", "TorqueLocal"),
)
GROUPS = ("ODE2", "ODE2_t", "ODE2_tt", "ODE1", "ODE1_t", "algebraic", "data")  # coordinates that are written
WRITTEN = re.compile(r"#number of written coordinates \[[\w, ]+\] = \[(\d{1,9}(?:,\d{1,9}){6})\]")
SENSORS = re.compile(r"#number of sensor values = (\d{1,6})")
LONGEST_TEXT = 10_000  # letters in a binary header


def is_exudyn_text(head: bytes) -> bool:
    """Whether a file begins as Exudyn's sensors and solutions do."""
    first = head.partition(b"\n")[0].lower()
    return first.startswith(b"#exudyn") and (b"sensor output file" in first or b"solution file" in first)


def read_exudyn_text(path: Path, asked: Asked) -> SeriesFile:
    """The series of a sensor's file, or of a solution as text.

    Raises InputError if it is damaged, with the line; OSError if it cannot be read.
    """
    data, notes = text_of(path)
    header: list[str] = []
    for line in lines_of(data):
        if not line.startswith("#") or len(header) >= HEADER:
            break
        header.append(line)
    sensor = "sensor output file" in header[0].lower() if header else False
    names = _of_sensor(path, header) if sensor else _of_solution(path, header)
    seconds = "s" if any(OURS in line for line in header) else None
    titles = (("time", seconds), *((name, None) for name in names))
    how = TableLayout(",", ".", len(header), titles, ("number",) * len(titles))
    if not data.rstrip().count(b"\n") + 1 > len(header):
        raise InputError(f"{path}: has no rows; allowed: one or more below its comments")
    if not sensor and FINISHED not in data:
        notes.append("There is no line '#simulation finished': the run was cut off, or the file was.")
    columns = columns_of(path, data, how)
    kind = "sensor of Exudyn" if sensor else "solution of Exudyn"
    return series_file(path, kind, [(columns[0], columns[1:])], asked, notes)


def _columns(names: Sequence[str], seconds: str | None, values: Iterable[Numbers]) -> list[Column]:
    """Columns of times, in this unit, and of values by their names."""
    titles = [("time", seconds), *((name, None) for name in names)]
    return [Column(name, unit, one) for (name, unit), one in zip(titles, values, strict=True)]


def _of_sensor(path: Path, header: list[str]) -> list[str]:
    count = next((int(found[1]) for line in header if (found := SENSORS.match(line))), 0)
    if not count:
        raise InputError(f"{path}: lacks its line '#number of sensor values = ...'; allowed: 1 or more")
    kinds = [line.partition("=")[2].strip() for line in header if line.startswith("#OutputVariableType")]
    kind = "value" if not kinds or kinds[0] in ("", "_None") else kinds[0]
    if count == 3 and kind.endswith(VECTORS):
        return [f"{kind}.{axis}" for axis in "xyz"]
    return [kind] if count == 1 else [f"{kind}.{n}" for n in range(count)]


def _of_solution(path: Path, header: list[str]) -> list[str]:
    counts = next((found[1] for line in header if (found := WRITTEN.match(line))), None)
    if counts is None:
        raise InputError(f"{path}: lacks its line '#number of written coordinates ...'; allowed: with it")
    return _coordinates(path, [int(one) for one in counts.split(",")])


def _coordinates(path: Path, counts: list[int]) -> list[str]:
    if not 0 < sum(counts) <= 10_000_000:
        raise InputError(f"{path}: says that it has {sum(counts)} coordinates; allowed: 1 to 10000000")
    return [f"{group}.{n}" for group, count in zip(GROUPS, counts, strict=True) for n in range(count)]


# --- binary ---


def is_exudyn_binary(head: bytes) -> bool:
    """Whether a file begins as Exudyn's binary solutions do."""
    return head.startswith(BINARY)


class _Binary:
    """The bytes of a binary solution, read one item after the other."""

    def __init__(self, path: Path, data: bytes) -> None:
        self.path, self.data, self.place = path, data, len(BINARY)
        sizes = self.take(10)
        if sizes[1] not in (4, 8) or sizes[2] not in (4, 8):
            raise self.wrong(f"numbers of {sizes[1]} and {sizes[2]} bytes", "4 or 8")
        self.whole, self.real = np.dtype(f"<i{sizes[1]}"), np.dtype(f"<f{sizes[2]}")

    def wrong(self, phrase: str, allowed: str) -> InputError:
        return InputError(f"{self.path}: byte {self.place}: {phrase}; allowed: {allowed}")

    def take(self, count: int) -> bytes:
        found = self.data[self.place : self.place + count]
        if count < 0 or len(found) < count:
            raise self.wrong("the file ends", "the whole of a binary solution of Exudyn")
        self.place += count
        return found

    def integer(self) -> int:
        return int(np.frombuffer(self.take(self.whole.itemsize), self.whole)[0])

    def integers(self) -> list[int]:
        count = self.integer()
        if not 0 <= count <= LONGEST_TEXT:
            raise self.wrong(f"{count} numbers in its header", f"0 to {LONGEST_TEXT}")
        return [int(one) for one in np.frombuffer(self.take(count * self.whole.itemsize), self.whole)]

    def text(self) -> str:
        count = self.integer()
        if not 0 <= count <= LONGEST_TEXT:
            raise self.wrong(f"a text of {count} letters in its header", f"0 to {LONGEST_TEXT}")
        return self.take(count).decode("utf-8", "replace")


def read_exudyn_binary(path: Path, asked: Asked) -> SeriesFile:
    """The series of a binary solution.

    Raises InputError if it is damaged, with the byte; OSError if it cannot be read.
    """
    reading = _Binary(path, contents(path, available() // 4))
    for _ in range(4):  # version, mode, solver, date
        reading.text()
    reading.integers()  # sizes of the system
    counts = reading.integers()
    if len(counts) != len(GROUPS) or min(counts) < 0:
        raise reading.wrong(f"coordinates {short(counts)}", f"{len(GROUPS)} counts")
    names = _coordinates(path, counts)
    reading.integer(), reading.integer()  # coordinates in all, steps that were planned
    seconds = "s" if OURS in reading.text() else None
    if reading.text() != "EndOfHeader":
        raise reading.wrong("the header has no end", "EndOfHeader")
    rows = _rows(reading, len(names) + 1)
    columns = _columns(names, seconds, rows.T)
    return series_file(path, "solution of Exudyn", [(columns[0], columns[1:])], asked)


def _rows(reading: _Binary, width: int) -> Numbers:
    """The rows behind the header, each behind its length; -1 ends them."""
    row = np.dtype([("length", reading.whole), ("values", reading.real, (width,))])
    rest = reading.data[reading.place :]
    count = len(rest) // row.itemsize
    found = np.frombuffer(rest, row, count)
    wrong = np.flatnonzero(found["length"] != width)
    if wrong.size:
        count = int(wrong[0])
        found = found[:count]
    reading.place += count * row.itemsize
    if reading.integer() != -1:
        raise reading.wrong(f"row {count + 1} is not of {width} numbers", "rows that are, and -1 at the end")
    if not count:
        raise reading.wrong("no rows", "one or more")
    return found["values"].astype(np.float64)
