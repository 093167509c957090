"""The store of a sweep: a folder with the rows of its runs, and the table that is made of them.

    STORE/rows.txt          a line for every run that has ended: its key, a digest, and what is noted of it
    STORE/table.parquet     all of it in one table, and table.csv for eyes

Lines are only added. Of several with one key the last counts; what was cut off or changed fits no digest.
"""

from __future__ import annotations

import errno
import hashlib
import json
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any, BinaryIO, Literal, NamedTuple

from support_exudyn.files.whole_file import remove_leftovers, whole_file, writing_alone

ROWS, TABLES = "rows.txt", ("table.parquet", "table.csv")
Status = Literal["done", "failed", "killed"]


class StoredNumber(NamedTuple):
    """A number of a run: value, estimated numerical error if it is known, and unit."""

    value: float
    error: float | None
    unit: str


@dataclass(frozen=True)
class StoredRun:
    """What is noted of a run, or why there is none.

    status: "done"; "failed": it cannot be run, or could not be finished, and would not be if it were tried
    again; "killed": its process ended. reason: why, or of a run that is done how far it is from its accuracy.
    wall_time: of the run [s]. noted: what was to be noted, see `Record.digest`.
    """

    key: str
    status: Status
    reason: str = ""
    wall_time: float | None = None
    numbers: Mapping[str, StoredNumber] = field(default_factory=dict)
    noted: str = ""

    def to_text(self) -> str:
        """The line of the row: its key, the digest of what follows, and that."""
        text = json.dumps({one.name: getattr(self, one.name) for one in fields(self)})
        return f"{self.key} {_digest(text)} {text}\n"

    @staticmethod
    def from_text(text: str) -> StoredRun:
        """What `to_text` wrote. Raises ValueError if it is not that, to the letter."""
        key, _, rest = text.partition(" ")
        digest, _, rest = rest.partition(" ")
        if not rest.endswith("\n") or digest != _digest(rest[:-1]):
            raise ValueError("does not fit its digest: it was cut off or changed")
        data: dict[str, Any] = json.loads(rest)
        if data["key"] != key:
            raise ValueError("does not fit its digest: it is of another run")
        data["numbers"] = {name: StoredNumber(*number) for name, number in data["numbers"].items()}
        return StoredRun(**data)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


class Store:
    """The folder of a sweep. Of its rows only the places are held in memory."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._places: dict[str, int] = {}  # of the last line of each key
        self._file: BinaryIO | None = None

    @property
    def rows(self) -> Path:
        """The file of the rows."""
        return self.folder / ROWS

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Write there alone. Raises OSError if another process does, or if it cannot be written to.

        Also if a table is there without rows: it is somebody else's, and would be lost.
        """
        for name in TABLES:
            if (self.folder / name).exists() and not self.rows.exists():
                said = "is of no sweep, and would be lost; allowed: another folder"
                raise FileExistsError(errno.EEXIST, said, str(self.folder / name))
        self.folder.mkdir(parents=True, exist_ok=True)
        with writing_alone(self.folder):
            remove_leftovers(self.folder, older=0.0)
            with self.rows.open("ab+") as self._file:
                self._look()
                yield

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Read there, also while another process writes. Nothing is known of a folder that is not there."""
        if not self.rows.exists():
            yield
            return
        with self.rows.open("rb") as self._file:
            self._look()
            yield

    def _look(self) -> None:
        """Note where rows are, and end a line that was cut off."""
        assert self._file is not None
        self._places.clear()
        place, line = self._file.seek(0), b"\n"
        for line in self._file:
            self._places[line.partition(b" ")[0].decode("ascii", "replace")] = place
            place += len(line)
        if not line.endswith(b"\n") and self._file.writable():
            self._file.write(b"\n")

    def row(self, key: str) -> StoredRun | None:
        """What is known of a run; None if that is nothing, or damaged."""
        if key not in self._places or self._file is None:
            return None
        self._file.seek(self._places[key])
        try:
            return StoredRun.from_text(self._file.readline().decode("utf-8"))
        except (ValueError, TypeError, LookupError):
            return None

    def put(self, row: StoredRun) -> None:
        """Keep a row. Raises OSError that names the file if it cannot be written, as on a full disk."""
        assert self._file is not None
        self._places[row.key] = self._file.seek(0, 2)
        try:
            self._file.write(row.to_text().encode("utf-8"))
            self._file.flush()
        except OSError as error:
            raise OSError(error.errno, error.strerror, str(self.rows)) from None

    def prune(self, keys: Collection[str]) -> int:
        """Remove the rows of all other keys. Returns of how many."""
        kept = [row.to_text() for name in self._places if name in keys and (row := self.row(name))]
        gone = len(self._places.keys() - set(keys))
        assert self._file is not None
        self._file.close()
        with whole_file(self.rows) as temporary:
            temporary.write_text("".join(kept), encoding="utf-8")
        self._places.clear()
        return gone
