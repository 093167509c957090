"""The faults of a file, each with its key, its value and what is allowed."""

import re
from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from user_forces.values.value import InputError, short, step

Place = tuple[str, ...]  # keys from the top of a file on, as they are written in it
LONGEST = 80  # characters of a value that is repeated
NESTED = 3  # levels of lists that are repeated
MOST_LINES = 30


class Faults:
    """The faults of a file, one line each.

    where: the file's name, or what the table is.
    """

    def __init__(self, where: str) -> None:
        self.where = where
        self.lines: list[str] = []

    def add(self, place: Place, text: str) -> None:
        """Note the fault of a place."""
        self.lines.append(": ".join(filter(None, (self.where, place_text(place), text))))

    def refuse(self, place: Place, item: Any, text: str) -> None:
        """Note a value that cannot be used, and why."""
        self.add((), ": ".join(filter(None, (f"{place_text(place)} = {quoted(item)}", text))))

    def wrong(self, place: Place, item: Any, allowed: str) -> None:
        """Note a value that cannot be used, and what is allowed."""
        self.refuse(place, item, f"allowed: {allowed}")

    def check(self) -> None:
        """Raise InputError if there are faults."""
        if not self.lines:
            return
        rest = len(self.lines) - MOST_LINES
        more = [": ".join(filter(None, (self.where, f"and {rest} more")))] if rest > 0 else []
        raise InputError("\n".join([*dict.fromkeys(self.lines[:MOST_LINES]), *more]))


def place_text(place: Place) -> str:
    """Keys as TOML joins them."""
    return ".".join(map(step, place))


def dotted_key(place: Place) -> str:
    """Keys as a sweep joins them: items of lists by their numbers, from 0."""
    return re.sub(r"\[(\d+)\]", r".\1", place_text(place))


def quoted(item: Any, level: int = 0) -> str:
    """A value as it is written in TOML, cut to fit a line."""
    if isinstance(item, bool):
        text = str(item).lower()
    elif isinstance(item, Decimal):
        text = str(item)
    elif isinstance(item, Mapping):
        text = "a table"
    elif isinstance(item, list):
        inside = ", ".join(quoted(each, level + 1) for each in item[:LONGEST]) if level < NESTED else "..."
        text = f"[{inside}]"
    else:
        text = short(item)
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."
