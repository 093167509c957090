"""What is known of a run of a sweep."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Literal, NamedTuple

Status = Literal["done", "failed", "killed"]


class Number(NamedTuple):
    """A number of a run: value, estimated numerical error if it is known, and unit."""

    value: float
    error: float | None
    unit: str


@dataclass(frozen=True)
class Row:
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
    numbers: Mapping[str, Number] = field(default_factory=dict)
    noted: str = ""
    size: int | None = None
    modified: int | None = None

    def to_text(self) -> str:
        """As a file holds it: a digest of what follows, and that."""
        text = json.dumps({one.name: getattr(self, one.name) for one in fields(self)})
        return f"{_digest(text)}\n{text}\n"

    @staticmethod
    def from_text(text: str) -> Row:
        """What `to_text` wrote. Raises ValueError if it is not that, to the letter."""
        digest, _, rest = text.partition("\n")
        if not rest.endswith("\n") or digest != _digest(rest[:-1]):
            raise ValueError("does not fit its digest: it was cut off or changed")
        data = json.loads(rest)
        data["numbers"] = {name: Number(*number) for name, number in data["numbers"].items()}
        return Row(**data)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
