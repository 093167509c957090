"""Names that somebody asks for: what is said of one that is not there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType
from typing import Any, NoReturn, TypeVar

T = TypeVar("T")
NEAR = 3  # names that are told of many
LIKE = 0.6  # least likeness of those
LETTERS = 80  # of a name that are compared


class UnknownNameError(KeyError):
    """A name that is not there, said in a sentence; a plain KeyError would print it in quotes."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class Named(dict[str, T]):
    """A table by name. What is not in it is told with the names that look like it.

    Arguments:
        items: names and what they stand for.
        what: a name is of, such as "channel".
        refused: names that have no value, and why.
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
    """The way out of a name that is not known: those like it, or some of those that there are."""
    names = [one for one in known if isinstance(one, str)]
    near = get_close_matches(str(name)[:LETTERS], names, NEAR, LIKE)
    if near:
        return f"did you mean {' or '.join(map(repr, near))}?"
    if not names:
        return "there are none"
    more = f" and {len(names) - NEAR} more" if len(names) > NEAR else ""
    return f"there are {', '.join(map(repr, names[:NEAR]))}{more}"


def suggestion(name: str, known: Iterable[str]) -> str:
    """The way out of a name that is not known: those like it, and all that are allowed."""
    names = list(known)
    near = get_close_matches(name[:LETTERS], names, NEAR, LIKE)
    guess = f"did you mean {' or '.join(map(repr, near))}? " if near else ""
    return f"{guess}allowed: {', '.join(names) or 'none'}"


def unknown(what: str, name: str, known: Iterable[str]) -> str:
    """The message for a name that is not known; what: it should be of."""
    return f"unknown {what} {name!r:.{LETTERS}}; {suggestion(name, known)}"
