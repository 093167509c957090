"""The table of a sweep: a row for every run of the plan, in its order."""

import json
from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from pyarrow import csv, parquet

from support_exudyn.files.free_memory import available
from support_exudyn.files.whole_file import check_is_file, whole_file
from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.plan import Plan
from support_exudyn.sweeps.store import StoredRun
from user_forces.values.value import InputError, cleaned, short

FORMAT = "support_exudyn sweep 2"
FILE = "table.parquet"
OWN = b"support_exudyn"  # of the schema's metadata
UNIT_WORDS = {"^": "", "/": "_per_", " ": "_"}
MEANINGS = {
    "run": "readable name of the run",
    "key": "digest of the run's inputs and of the program",
    "status": "done, failed (it cannot be run, or stopped), killed (its process ended)",
    "reason": "why there are no numbers, or why they are less accurate than asked for",
    "wall_time_s": "time that the run took",
}


class _NumberColumn:
    """Numbers by rows; NaN where there is none."""

    def __init__(self, rows: int, unit: str) -> None:
        self.unit = unit
        self.values = np.full(rows, np.nan)
        self.errors = np.full(rows, np.nan)
        self.there = np.zeros(rows, dtype=bool)
        self.rank = (rows, 0)  # first row and place in it


class SweepTable:
    """All rows, as far as they are known. Of a hundred numbers ten thousand rows take 20 MB."""

    def __init__(self, plan: Plan) -> None:
        self._plan, self._size = plan, len(plan.points)
        self.keys: list[str] = [""] * self._size
        self.run_names = plan.run_names
        self.status: list[str] = ["waiting"] * self._size
        self._reasons: list[str] = [""] * self._size
        self._wall_times = np.full(self._size, np.nan)
        self._columns: dict[str, _NumberColumn] = {}

    def set(self, number: int, row: StoredRun) -> None:
        """Note a row at its place."""
        self.keys[number], self.status[number] = row.key, row.status
        self._reasons[number] = row.reason
        self._wall_times[number] = np.nan if row.wall_time is None else row.wall_time
        for place, (name, (value, error, unit)) in enumerate(row.numbers.items()):
            column = self._columns.setdefault(name, _NumberColumn(self._size, unit))
            column.values[number], column.there[number] = value, True
            column.errors[number] = np.nan if error is None else error
            column.rank = min(column.rank, (number, place))

    @property
    def numbers(self) -> list[str]:
        """Names of the numbers that any run has."""
        return list(self._columns)

    def to_arrow(self) -> pa.Table:
        """The table; units and meanings are metadata of its columns, what it was made with is its own."""
        fields: list[pa.Field] = []
        columns: list[pa.Array] = []

        def add(name: str, column: pa.Array, unit: str = "", meaning: str = "") -> None:
            about = {"unit": cleaned(unit), "meaning": cleaned(meaning)}
            fields.append(pa.field(cleaned(name), column.type, metadata=about))
            columns.append(column)

        for name in self._plan.names:
            add(name, _inputs([point[name] for point in self._plan.points]), meaning="varied")
        texts_of = {"run": self.run_names, "key": self.keys, "status": self.status, "reason": self._reasons}
        for name, texts in texts_of.items():
            add(name, pa.array(texts, pa.string()), meaning=MEANINGS[name])
        taken = pa.array(self._wall_times, mask=np.isnan(self._wall_times))
        add("wall_time_s", taken, "s", MEANINGS["wall_time_s"])
        for name, column in sorted(self._columns.items(), key=lambda item: item[1].rank):
            title = amount(name, column.unit)
            add(title, pa.array(column.values, mask=~column.there), column.unit, f"{name} of the run")
            if not np.isnan(column.errors).all():
                errors = pa.array(column.errors, mask=np.isnan(column.errors))
                add(f"{title}_error", errors, column.unit, f"estimated numerical error of {name}")
        about = {
            "format": FORMAT,
            "sweep": self._plan.text,
            "program": program(),
            "sampled": self._plan.sampled,
        }
        return pa.table(columns, schema=pa.schema(fields, metadata={OWN: json.dumps(about)}))

    def write(self, folder: Path) -> Path:
        """Write table.parquet and table.csv; return the path of the former."""
        made = self.to_arrow()
        with whole_file(folder / FILE) as temporary:
            parquet.write_table(made, temporary)
        with whole_file(folder / "table.csv") as temporary:
            csv.write_csv(made, temporary)
        return folder / FILE


def amount(name: str, unit: str) -> str:
    """Title of a column: `pin.rear_base.force.mean_N`."""
    for letter, word in UNIT_WORDS.items():
        unit = unit.replace(letter, word)
    return f"{name}_{unit}" if unit else name


def read_table(path: str | Path) -> pa.Table:
    """The table of a sweep.

    path: of the store, or of the table.parquet in it.

    Raises OSError if there is none; InputError if it is no table of a sweep, or damaged.
    """
    path = Path(path)
    path = path / FILE if path.is_dir() else path
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such file; allowed: the folder of a sweep, or its {FILE}")
    check_is_file(path, available())
    try:
        found = parquet.read_table(path)
        found.validate(full=True)
        about = json.loads((found.schema.metadata or {}).get(OWN, b"{}"))
        known = about.get("format")
    except (pa.ArrowException, OSError, ValueError, AttributeError, RecursionError, MemoryError) as error:
        said = cleaned(" ".join(str(error).split()))
        raise InputError(f"{path}: not a table of a sweep, or damaged ({said})") from None
    if known != FORMAT:
        raise InputError(
            f"{path}: format is {short(known)}, expected {FORMAT!r}; the same `sweep` command writes it anew"
        )
    return found


def is_sampled(table: pa.Table) -> bool:
    """Whether the runs of a sweep's table were drawn, so that percentiles of their numbers mean something."""
    return json.loads((table.schema.metadata or {}).get(OWN, b"{}")).get("sampled") is True


def _inputs(values: Sequence[Any]) -> pa.Array:
    """What was varied: numbers, truth values or texts; anything else, also what no column holds, as JSON."""
    plain = [float(one) if isinstance(one, Decimal) else one for one in values]
    try:
        found = pa.array(plain)
    except (pa.ArrowException, OverflowError):
        found = pa.nulls(len(plain))
    if any(kind(found.type) for kind in (pa.types.is_integer, pa.types.is_floating, pa.types.is_boolean)):
        return found
    return pa.array(
        [cleaned(one if isinstance(one, str) else json.dumps(one, default=_plain)) for one in values]
    )


def _plain(item: Any) -> Any:
    return float(item) if isinstance(item, Decimal) else str(item)
