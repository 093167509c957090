"""Every law that lies in `normal` and `friction`, found in its file, and what tables say of it.

A law's name is that of its file. Its docstring has the paragraph "Source: ...", with the year in brackets.
"""

import inspect
import re
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

import user_forces.friction
import user_forces.normal
from user_forces.values.value import Value, kinds_of

ROOMS = (user_forces.normal, user_forces.friction)
FIRST = ("Exact", "Johnson")  # of their kind: what the others are compared with

MODULES = tuple(
    import_module(found.name) for room in ROOMS for found in iter_modules(room.__path__, f"{room.__name__}.")
)


def laws(kind: type[Value]) -> dict[str, Any]:
    """Classes of the published laws of a kind, such as `PowerLaw`, by name: the reference, then by year."""
    names = {module.__name__: module.__name__.rpartition(".")[2] for module in MODULES}
    found = [law for law in kinds_of(kind).values() if law.__module__ in names and source(law)]
    found.sort(key=lambda law: (law.__name__ not in FIRST, year(law), law.__module__))
    return {names[law.__module__]: law for law in found}


def source(law: type[Value]) -> str:
    """Where a law was published, on one line; empty if its docstring does not say."""
    return " ".join((inspect.getdoc(law) or "").partition("Source: ")[2].split())


def year(law: type[Value]) -> int:
    """The year in which a law was published; 9999 if its source has none in brackets."""
    found = re.search(r"\((\d{4})\)", source(law))
    return int(found[1]) if found else 9999


def title(law: type[Value]) -> str:
    """A law's name for readers: its `TITLE`, or its authors with a dash between them."""
    return getattr(law, "TITLE", "") or re.sub(r"(?<=[a-z])(?<!Mc)(?=[A-Z])", "-", law.__name__)
