"""The store of a sweep: a folder with a file for the row of every run, and one for the run itself.

    STORE/rows/KEY.json     what is noted of a run, or why there is none
    STORE/runs/KEY.h5       the run, as `Result.save` writes it
    STORE/named/NAME.h5     the same file by a readable name, where the disk lets a file have two
    STORE/table.parquet     all of it in one table, and table.csv for eyes

A run's file is written before its row, each whole: where there is a row, there was a run.
"""

from __future__ import annotations

import errno
import hashlib
import json
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Literal, NamedTuple

from support_exudyn.files.free_memory import available
from support_exudyn.files.hdf5 import check_checksum
from support_exudyn.files.whole_file import contents, remove_leftovers, whole_file, writing_alone
from support_exudyn.simulation.result import FORMAT
from support_exudyn.sweeps.key import LENGTH

KEY = re.compile(rf"[0-9a-f]{{{LENGTH}}}")
LARGEST_ROW = 100_000_000  # bytes
TABLES = ("table.parquet", "table.csv")
RUN = FORMAT.rpartition(" ")[0].encode() + b" "  # as files of runs of any version begin
Status = Literal["done", "failed", "killed"]
Pieces = Sequence[bytes | bytearray]  # of a file, one behind the other


class StoredNumber(NamedTuple):
    """A number of a run: value, estimated numerical error if it is known, and unit."""

    value: float
    error: float | None
    unit: str


@dataclass(frozen=True)
class StoredRun:
    """A run, or why there is none.

    status: "done"; "failed": it cannot be run, or could not be finished, and would not be if it were tried
    again; "killed": its process ended. reason: why, or of a run that is done how far it is from its accuracy.
    wall_time: of the run [s]. noted: what was to be noted, see `Record.digest`. size, modified: of the run's
    file [bytes; ns], when it was known to be whole.
    """

    key: str
    status: Status
    reason: str = ""
    wall_time: float | None = None
    numbers: Mapping[str, StoredNumber] = field(default_factory=dict)
    noted: str = ""
    size: int | None = None
    modified: int | None = None

    def to_text(self) -> str:
        """The text of the row's file: a digest of what follows, and that."""
        text = json.dumps({one.name: getattr(self, one.name) for one in fields(self)})
        return f"{_digest(text)}\n{text}\n"

    @staticmethod
    def from_text(text: str) -> StoredRun:
        """What `to_text` wrote. Raises ValueError if it is not that, to the letter."""
        digest, _, rest = text.partition("\n")
        if not rest.endswith("\n") or digest != _digest(rest[:-1]):
            raise ValueError("does not fit its digest: it was cut off or changed")
        data = json.loads(rest)
        data["numbers"] = {name: StoredNumber(*number) for name, number in data["numbers"].items()}
        return StoredRun(**data)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Store:
    """The folder of a sweep."""

    folder: Path

    @property
    def rows(self) -> Path:
        """The folder of the rows."""
        return self.folder / "rows"

    @property
    def runs(self) -> Path:
        """The folder of the runs."""
        return self.folder / "runs"

    def run_file(self, key: str) -> Path:
        """The file of the run of this key."""
        return self.runs / f"{key}.h5"

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Write there alone. Raises OSError if another process does, or if it cannot be written to.

        Also if a table is there without a store: it is somebody else's, and would be lost.
        """
        for name in TABLES:
            if (self.folder / name).exists() and not self.rows.exists():
                raise FileExistsError(
                    errno.EEXIST,
                    "is of no sweep, and would be lost; allowed: another folder",
                    str(self.folder / name),
                )
        self.rows.mkdir(parents=True, exist_ok=True)
        self.runs.mkdir(exist_ok=True)
        with writing_alone(self.folder):
            self._clear()
            try:
                yield
            finally:
                self._clear()

    def _clear(self) -> None:
        for folder in (self.folder, self.rows, self.runs):
            remove_leftovers(folder, older=0.0)

    def row(self, key: str) -> StoredRun | None:
        """What is known of a run; None if that is nothing, or damaged."""
        try:
            found = StoredRun.from_text(contents(self.rows / f"{key}.json", LARGEST_ROW).decode("utf-8"))
        except (FileNotFoundError, ValueError, TypeError, LookupError):
            return None
        return found if found.key == key else None

    def put(self, row: StoredRun, run: Pieces = (), within: Path | None = None) -> StoredRun:
        """Keep a row, and before it the run.

        A row need not be on the disk for good: one that was cut off is known by its digest.

        Arguments:
            run: the bytes of its file, in pieces; none if it is not to be kept, or is there already.
            within: see `whole_file`.
        """
        path = self.run_file(row.key)
        if run:
            with whole_file(path, within) as temporary, temporary.open("wb") as file:
                file.writelines(run)
        if row.status == "done" and path.exists():
            status = path.stat()
            row = replace(row, size=status.st_size, modified=status.st_mtime_ns)
        with whole_file(self.rows / f"{row.key}.json", within, lasting=False) as temporary:
            temporary.write_text(row.to_text(), encoding="utf-8")
        return row

    def has_run(self, row: StoredRun) -> bool:
        """Whether the run of a row is there and whole.

        What is as large and as old as when it was written is not read again; anything else is, and must fit its
        digest.
        """
        path = self.run_file(row.key)
        try:
            status = path.stat()
            if (status.st_size, status.st_mtime_ns) == (row.size, row.modified):
                return True
            check_checksum(contents(path, available()), FORMAT)
        except (OSError, ValueError):
            return False
        return True

    @property
    def named(self) -> Path:
        """The folder of the runs by readable names."""
        return self.folder / "named"

    def name_runs(self, keys: Mapping[str, str]) -> None:
        """Let runs that are kept have readable names, too; those that had one before lose it.

        Each is the same file by a second name, which takes no room. A disk that has no such names goes without.

        keys: of runs, by their readable names.
        """
        if not any(self.runs.iterdir()):
            return
        self.named.mkdir(exist_ok=True)
        for path in self.named.glob("*.h5"):
            if path.is_file() and not path.is_symlink() and _begins_as_a_run(path):
                path.unlink()
        for name, key in keys.items():
            if key and self.run_file(key).exists():
                with suppress(OSError):  # no second names on this disk, or a file of somebody else's
                    (self.named / f"{name}.h5").hardlink_to(self.run_file(key))

    def prune(self, keys: Collection[str]) -> int:
        """Remove rows of all other keys, and their runs. Returns of how many.

        Files that only have such names stay: what goes is a row that fits its digest, and what begins as a run.
        """
        wanted = set(keys)
        gone = set()
        for path in (*self.rows.glob("*.json"), *self.runs.glob("*.h5")):
            if path.stem not in wanted and self._is_ours(path):
                path.unlink()
                gone.add(path.stem)
        return len(gone)

    def _is_ours(self, path: Path) -> bool:
        if not (KEY.fullmatch(path.stem) and path.is_file()) or path.is_symlink():
            return False
        if path.suffix == ".json":
            return self.row(path.stem) is not None
        return _begins_as_a_run(path)


def _begins_as_a_run(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(len(RUN)) == RUN
