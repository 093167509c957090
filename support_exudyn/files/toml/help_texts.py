"""What the docstrings of classes say of them and of their fields."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator, Mapping
from dataclasses import fields as dataclass_fields
from functools import cache

ENTRY = re.compile(r"^(?P<names>\w+(?:, \w+)*): (?P<text>.*)$")


@cache
def help_texts(cls: type) -> Mapping[str, str]:
    """What docstrings say of the fields of a class, those of its bases too."""
    found: dict[str, str] = {}
    for one in reversed(cls.__mro__):
        if one.__doc__ and "Arguments:" in one.__doc__:
            found |= dict(_entries(inspect.cleandoc(one.__doc__).partition("Arguments:")[2]))
    names = "|".join(one.name for one in dataclass_fields(cls))
    for text in list(found.values()):  # several in a line: `radius: [m], > 0. mass: [kg], > 0.`
        first, *more = re.split(rf"(?<=\.) (?=(?:{names}): )", text)
        found = {name: first if said == text else said for name, said in found.items()}
        found |= {name: said for name, _, said in (one.partition(": ") for one in more)}
    return found


def _entries(text: str) -> Iterator[tuple[str, str]]:
    """Names and texts of an indented list `name: text`, one text over several lines."""
    names: list[str] = []
    words: list[str] = []
    for line in [*text.splitlines()[1:], "end"]:
        if line.strip() and not line.startswith("    "):  # a new section
            break
        if line.startswith("     ") or not line.strip():
            words.append(line.strip())
            continue
        yield from ((name, " ".join(words).strip()) for name in names)
        entry = ENTRY.match(line.strip())
        names, words = (entry["names"].split(", "), [entry["text"]]) if entry else ([], [])
    yield from ((name, " ".join(words).strip()) for name in names)


def summary(cls: type) -> str:
    """The first paragraph of a class's docstring, in one line."""
    return " ".join((inspect.cleandoc(cls.__doc__ or "")).partition("\n\n")[0].split())
