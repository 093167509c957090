"""A number of a file that says where it comes from, and how far off it may be."""

from dataclasses import dataclass
from decimal import Decimal
from typing import Any


@dataclass(frozen=True)
class SourcedNumber:
    """A number with where it comes from and how far off it may be, in the unit of its key.

    Arguments:
        value: what is reckoned with.
        low, high: the least and the largest that it may be, low <= value <= high; None: not said.
        source: where it comes from, and what the range rests on; empty: not said.
    """

    value: Decimal
    low: Decimal | None = None
    high: Decimal | None = None
    source: str = ""

    def data(self) -> dict[str, Any]:
        """Value, range and source as plain data, by the keys of files."""
        low, high = (None if one is None else float(one) for one in (self.low, self.high))
        return {"value": float(self.value), "from": low, "to": high, "source": self.source}
