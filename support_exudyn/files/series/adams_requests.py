"""Series from ADAMS request files (`.req`), and those that RecurDyn and MotionSolve write alike.

Text: a few lines of a header, the last of which has the number of requests, perhaps the system of units, and a
factor of it; then each request; then for every step its time, and six numbers for each request.

     A.R3    2019-08-11 13:52:24               0         0  3D       version, date
    Adams View model name: camelot_1                                 title
        2     INLBS_PFRACA 3.937007874015748E+01                     requests, units, factor of units
        1    4    11    12    9                                      id, type, markers, letters of its name
    hinge_pin                                                        its name, unless these are 0
       ...
       1.00000E-03                                                   time
      ... six numbers for each request: X Y Z R1 R2 R3

Genuine files of ADAMS in public have no requests; how these are written follows RecurDyn's manual ("REQ File
Format") and files of MotionSolve. `INLBS_PFRACA` is inch, pound, second, pound of force, radian, Cartesian.
Requests of type 1 to 4 are displacement, velocity, acceleration and force (RecurDyn's manual); of others the
units are not known, and are asked for.
"""

from __future__ import annotations

import re
from array import array
from pathlib import Path

import numpy as np

from support_exudyn.files.series.columns import Column, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.text_tables import text_of
from user_forces.values.value import InputError, short

FIRST = re.compile(rb"\s*A\.R\d\b|MotionSolve\b[^\n]*Plot File|[^\n]{0,200}RecurDyn", re.IGNORECASE)
COUNT = re.compile(r"\s*(\d{1,7})\s+(?:([A-Z_]{12})\s+)?(\d[\d.]*(?:[eEdD][+-]?\d+)?)\s*")
ENTRY = re.compile(r"\s*(\d{1,9})\s+(\d{1,3})\s+-?\d{1,9}\s+-?\d{1,9}\s+(\d{1,4})\s*")
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eED][+-]?\d+)?", re.ASCII)
COMPONENTS = ("X", "Y", "Z", "R1", "R2", "R3")
HEADER = 6  # lines before that of the number of requests
ALLOWED = "the whole of a request file as text"
LENGTHS = {"MM": "mm", "CM": "cm", "M_": "m", "KM": "km", "IN": "inch", "FT": "foot", "MI": "mile"}
TIMES = {"S_": "s", "MS": "ms", "MI": "min", "HR": "hour"}
FORCES = {"N_": "N", "KN": "kN", "DY": "dyne", "PF": "lbf", "KF": "kilogram_force", "OF": "ounce_force"}
ANGLES = {"RA": "rad", "DE": "deg"}
KINDS = {  # of requests: units of X Y Z, and of R1 R2 R3
    1: ("{length}", "{angle}"),
    2: ("{length}/{time}", "{angle}/{time}"),
    3: ("{length}/{time}**2", "{angle}/{time}**2"),
    4: ("{force}", "{force}*{length}"),
}


def is_request_file(head: bytes) -> bool:
    """Whether a file begins as request files do."""
    return FIRST.match(head) is not None


def read_adams_requests(path: Path, asked: Asked) -> SeriesFile:
    """The series of a request file, called `NAME.X` or, without a name, `reqID.X`, as ADAMS calls them.

    Raises InputError if it is damaged, with the line; OSError if it cannot be read.
    """
    data, notes = text_of(path)
    lines = data.decode().splitlines()
    place, count, system = _count(path, lines)
    units = _units(system)
    found: list[tuple[str, str | None]] = []
    for _ in range(count):
        place, name, kind = _request(path, lines, place)
        straight, turning = (one.format(**units) if units else None for one in KINDS.get(kind, ("", "")))
        found += [(f"{name}.{one}", (turning if one[0] == "R" else straight) or None) for one in COMPONENTS]
    if not count:
        raise InputError(f"{path}: has times and no request; allowed: one request or more")
    titles = [("time", units.get("time")), *found]
    rows = _rows(path, lines, place, len(titles))
    columns = [Column(name, unit, one) for (name, unit), one in zip(titles, rows.T, strict=True)]
    if units:
        notes.append(f"Units are those of the system {system} and of the kind of each request.")
    return series_file(path, "ADAMS request file", [(columns[0], columns[1:])], asked, notes)


def _count(path: Path, lines: list[str]) -> tuple[int, int, str]:
    """The index of the line after that of the number of requests, this number, and the system of units."""
    for n, line in enumerate(lines[: HEADER + 1]):
        if n and (found := COUNT.fullmatch(line)):
            return n + 1, int(found[1]), found[2] or ""
    raise InputError(f"{path}: line 2 to {HEADER + 1}: none has the number of requests; allowed: {ALLOWED}")


def _units(system: str) -> dict[str, str]:
    """Units of a system such as MMKGS_N_RACA; none if one of them is not known."""
    words = [system[n : n + 2] for n in range(0, 10, 2)]
    if len(system) != 12:
        return {}
    length, _, time, force, angle = words
    found = {
        "length": LENGTHS.get(length), "time": TIMES.get(time), "force": FORCES.get(force),
        "angle": ANGLES.get(angle),
    }  # fmt: skip
    return {} if None in found.values() else {key: str(one) for key, one in found.items()}


def _request(path: Path, lines: list[str], place: int) -> tuple[int, str, int]:
    """The index of the line after a request, its name and its type."""
    found = ENTRY.fullmatch(lines[place]) if place < len(lines) else None
    if found is None:
        raise InputError(
            f"{path}: line {place + 1}: is no request, with five whole numbers; allowed: {ALLOWED}"
        )
    name = f"req{found[1]}"
    place += 1
    if int(found[3]):
        if place >= len(lines):
            raise InputError(f"{path}: line {place}: the file ends; allowed: {ALLOWED}")
        name = " ".join(lines[place].split()) or name
        place += 1
    return place, name, int(found[2])


def _rows(path: Path, lines: list[str], place: int, width: int) -> np.ndarray:
    """The numbers of all steps (n, width)."""
    numbers = array("d")
    for n, line in enumerate(lines[place:], place + 1):
        words = line.split()
        if wrong := [one for one in words if not NUMBER.fullmatch(one)]:
            raise InputError(f"{path}: line {n}: {short(wrong[0])}; allowed: numbers such as 1.5E-03")
        numbers.extend(float(one.replace("D", "E")) for one in words)
    if not numbers or len(numbers) % width:
        steps, rest = divmod(len(numbers), width)
        raise InputError(
            f"{path}: line {len(lines)}: {rest} numbers behind {steps} steps of {width}; allowed: {ALLOWED}"
        )
    return np.frombuffer(numbers, dtype=np.float64).reshape(-1, width)
