"""What is said of an input: that it cannot be used, and texts of somebody else's that are fit to be printed.

It needs no library, so that a command line can refuse a word before any is imported.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from typing import Any


class InputError(ValueError):
    """A value that cannot be used: says which field, what it was, and what is allowed."""


def cleaned(text: str) -> str:
    r"""A text of somebody else's, fit to be printed and written.

    What steers a terminal, turns the direction of writing or is no letter at all stands in it by its number,
    such as \x1b.
    """
    return "".join(one if one.isprintable() or one in " \t\n" else f"{one!a}"[1:-1] for one in text)


def short(item: Any) -> str:
    """An input as text that fits into a line."""
    try:
        text = " ".join(repr(item).split())
    except Exception:  # of someone else's class, of data nested too deep, of a number of 5000 digits
        text = f"<{type(item).__name__}>"
    return text if len(text) <= 80 else text[:77] + "..."


def check_names(where: str, names: Iterable[str]) -> None:
    """Raise InputError that shows the first name with a character that channels and files cannot have.

    where: the table of the names, such as "pins".
    """
    for name in names:
        if not name or not all(one in "_-" or unicodedata.category(one)[0] in "LMN" for one in name):
            raise InputError(
                f"{where}: {short(name)}: cannot be used as a name; allowed: letters of any language, digits, "
                '"_" and "-"'
            )
