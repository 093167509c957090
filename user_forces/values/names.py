"""Messages on input: the names near an unknown name, and texts that can be printed.

The module imports no library, so that a command line can refuse a word before any is imported.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any, NoReturn, TypeVar

T = TypeVar("T")
NEAR = 3  # names that a message suggests
LETTERS = 80  # of a name or value that a message repeats


class InputError(ValueError):
    """A value that cannot be used: the message names the field, its value, and what is allowed."""


class UnknownNameError(KeyError):
    """An unknown name; the message is a sentence, which a plain KeyError would print in quotes."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class Named(dict[str, T]):
    """A table by name, whose message on an unknown name suggests those that are similar.

    Arguments:
        items: names and their entries.
        what: kind of the entries, such as "channel".
        refused: names that have no entry, and why.
    """

    def __init__(
        self,
        items: Mapping[str, T] | Iterable[tuple[str, T]] = (),
        what: str = "entry",
        refused: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        super().__init__(items)
        self.what, self.refused = what, dict(refused)

    def __missing__(self, name: Any) -> NoReturn:
        if name in self.refused:
            raise UnknownNameError(f"{name!r}: {self.refused[name]}")
        raise UnknownNameError(f"{name!r:.{LETTERS}}: no such {self.what}; {meant(name, self)}")


def meant(name: Any, known: Iterable[str]) -> str:
    """Advice on an unknown name out of many: the similar ones, or the first of all."""
    names = [each for each in known if isinstance(each, str)]
    if guess := _guess(str(name), names):
        return guess
    if not names:
        return "there are none"
    more = f" and {len(names) - NEAR} more" if len(names) > NEAR else ""
    return f"there are {', '.join(map(repr, names[:NEAR]))}{more}"


def nearest(name: str, known: Iterable[str]) -> str:
    """Advice on an unknown name: the similar ones, then all that are allowed."""
    names = list(known)
    return f"{_guess(name, names)} allowed: {', '.join(names) or 'none'}".lstrip()


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """The message on an unknown name; what: kind of the named."""
    return f"unknown {what} {name!r:.{LETTERS}}; {nearest(name, known)}"


def _guess(name: str, names: list[str]) -> str:
    near = get_close_matches(name[:LETTERS], names, NEAR)
    return f"did you mean {' or '.join(map(repr, near))}?" if near else ""


def cleaned(text: str) -> str:
    r"""A foreign text that can be printed: control characters are replaced by escapes such as \x1b."""
    return "".join(each if each.isprintable() or each in " \t\n" else f"{each!a}"[1:-1] for each in text)


def short(item: Any) -> str:
    """An input as text that fits into a line."""
    try:
        text = " ".join(repr(item).split())
    except Exception:  # of a foreign class, of deeply nested data, of a number of 5000 digits
        text = f"<{type(item).__name__}>"
    return text if len(text) <= LETTERS else text[: LETTERS - 3] + "..."


def check_names(where: str, names: Iterable[str]) -> None:
    """Raise InputError at the first name with a character that channels and files cannot have.

    where: the table of the names, such as "pins".
    """
    for name in names:
        if not name or not all(each in "_-" or unicodedata.category(each)[0] in "LMN" for each in name):
            raise InputError(
                f"{where}: {short(name)}: cannot be used as a name; allowed: letters of any language, digits, "
                '"_" and "-"'
            )
