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
from pathlib import Path

import numpy as np

from support_exudyn.files.series.columns import Column, Numbers, series_file
from support_exudyn.files.series.named_series import Asked, SeriesFile
from support_exudyn.files.series.text_tables import lines_of
from user_forces.values.value import InputError, short

COUNT = re.compile(r"\s*(\d{1,7})\s+(?:([A-Z_]{12})\s+)?(\d[\d.]*(?:[eEdD][+-]?\d+)?)\s*")
ENTRY = re.compile(r"\s*(\d{1,9})\s+(\d{1,3})\s+-?\d{1,9}\s+-?\d{1,9}\s+(\d{1,4})\s*")
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eED][+-]?\d+)?", re.ASCII)
COMPONENTS = ("X", "Y", "Z", "R1", "R2", "R3")
HEADER = 6  # lines before that of the number of requests
UNITS = {  # by the letters that a system of units has for them
    "length": {"MM": "mm", "CM": "cm", "M_": "m", "KM": "km", "IN": "inch", "FT": "foot", "MI": "mile"},
    "time": {"S_": "s", "MS": "ms", "MI": "min", "HR": "hour"},
    "force": {"N_": "N", "KN": "kN", "DY": "dyne", "PF": "lbf", "KF": "kilogram_force", "OF": "ounce_force"},
    "angle": {"RA": "rad", "DE": "deg"},
}
KINDS = {  # of requests: units of X Y Z, and of R1 R2 R3
    1: ("{length}", "{angle}"),
    2: ("{length}/{time}", "{angle}/{time}"),
    3: ("{length}/{time}**2", "{angle}/{time}**2"),
    4: ("{force}", "{force}*{length}"),
}


def read_adams_requests(path: Path, asked: Asked) -> SeriesFile:
    """The series of a request file, called `NAME.X` or, without a name, `reqID.X`, as ADAMS calls them.

    Raises InputError if it is damaged, with the line; OSError if it cannot be read.
    """
    lines, notes = lines_of(path)
    lines = lines[: None if lines[-1] else -1]
    headers = ((n, COUNT.fullmatch(line)) for n, line in enumerate(lines[1 : HEADER + 1], 2))
    place, header = next(((n, found) for n, found in headers if found), (0, None))
    if header is None:
        raise _wrong(f"{path}: line 2 to {HEADER + 1}", "none has the number of requests")
    system = header[2] or ""
    letters = {"length": system[:2], "time": system[4:6], "force": system[6:8], "angle": system[8:10]}
    units = {key: UNITS[key].get(two, "") for key, two in letters.items()}
    units = units if all(units.values()) else {}  # of a system that is not known
    titles: list[tuple[str, str | None]] = [("time", units.get("time"))]
    for _ in range(int(header[1])):
        found = ENTRY.fullmatch(lines[place]) if place < len(lines) else None
        if found is None:
            raise _wrong(f"{path}: line {place + 1}", "is no request, with five whole numbers")
        is_named = bool(int(found[3])) and place + 1 < len(lines)
        name = (" ".join(lines[place + 1].split()) if is_named else "") or f"req{found[1]}"
        kinds = KINDS.get(int(found[2]), ("", "")) if units else ("", "")
        straight, turning = (one.format(**units) or None for one in kinds)
        titles += [(f"{name}.{one}", turning if one[0] == "R" else straight) for one in COMPONENTS]
        place += 1 + is_named
    if len(titles) == 1:
        raise InputError(f"{path}: has times and no request; allowed: one request or more")
    rows = _rows(path, lines, place, len(titles))
    columns = [Column(name, unit, one) for (name, unit), one in zip(titles, rows.T, strict=True)]
    if units:
        notes.append(f"Units are those of the system {header[2]} and of the kind of each request.")
    return series_file(path, "ADAMS request file", [(columns[0], columns[1:])], asked, notes)


def _wrong(where: str, phrase: str) -> InputError:
    return InputError(f"{where}: {phrase}; allowed: the whole of a request file as text")


def _rows(path: Path, lines: list[str], place: int, width: int) -> Numbers:
    """The numbers of all steps (n, width)."""
    words = " ".join(lines[place:]).upper().replace("D", "E").split()
    try:
        numbers = np.array(words, dtype=np.float64)
    except ValueError:
        wrong = ((n, one) for n, line in enumerate(lines[place:], place + 1) for one in line.split())
        n, word = next((n, one) for n, one in wrong if not NUMBER.fullmatch(one))
        raise InputError(f"{path}: line {n}: {short(word)}; allowed: numbers such as 1.5E-03") from None
    if not numbers.size or numbers.size % width:
        steps, rest = divmod(numbers.size, width)
        raise _wrong(f"{path}: line {len(lines)}", f"{rest} numbers behind {steps} steps of {width}")
    return numbers.reshape(-1, width)
