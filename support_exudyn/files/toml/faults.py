"""Where in a file something stands, and what is said of all that is wrong in it."""

import re
from collections.abc import Collection, Mapping
from decimal import Decimal
from difflib import get_close_matches
from typing import Any

from user_forces.values.value import InputError, short, step

Place = tuple[str, ...]  # keys from the top of a file on, as they are written in it
LONGEST = 80  # characters of a value that is repeated
NESTED = 3  # levels of lists that are repeated
MOST_LINES = 30


class Faults:
    """The faults that were found in a file, one line each.

    where: the file's name, or what the table is.
    """

    def __init__(self, where: str) -> None:
        self.where = where
        self.lines: list[str] = []

    @property
    def is_full(self) -> bool:
        """Whether more was noted than is shown, so that nothing needs to be said of what follows."""
        return len(self.lines) > MOST_LINES

    def add(self, place: Place, text: str) -> None:
        """Note what is said of a place."""
        self.lines.append(": ".join(filter(None, (self.where, place_text(place), text))))

    def wrong(self, place: Place, item: Any, allowed: str) -> None:
        """Note a value that cannot be used."""
        key = place_text(place)
        self.lines.append(
            ": ".join(filter(None, (self.where, f"{key} = {quoted(item)}", f"allowed: {allowed}")))
        )

    def check(self) -> None:
        """Raise InputError if anything was added."""
        if not self.lines:
            return
        rest = len(self.lines) - MOST_LINES
        more = [": ".join(filter(None, (self.where, f"and {rest} more")))] if rest > 0 else []
        raise InputError("\n".join([*dict.fromkeys(self.lines[:MOST_LINES]), *more]))


def nearest(word: str, known: Collection[str]) -> str:
    """The hint for a misspelt word: the names that look like it, then all that are allowed."""
    near = get_close_matches(word[:LONGEST], known, 3)
    guess = f"did you mean {' or '.join(near)}? " if near else ""
    return f"{guess}allowed: {', '.join(known) or 'none'}"


def place_text(place: Place) -> str:
    """Keys as TOML joins them."""
    return ".".join(map(step, place))


def dotted_key(place: Place) -> str:
    """Keys as a sweep joins them: those of lists are the numbers of their items, from 0."""
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
        text = f"[{', '.join(quoted(one, level + 1) for one in item[:LONGEST])}]" if level < NESTED else "[...]"
    else:
        text = short(item)
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."
