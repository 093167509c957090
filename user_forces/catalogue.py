"""The published laws, and what tables say of them.

The docstring of a law has the paragraph "Source: ...", with the year in brackets.
"""

import inspect
import re
from typing import Any

from user_forces.friction import laws as friction_laws
from user_forces.friction import lugre
from user_forces.normal import cylinders, dashpots, pin_in_bore, power_laws
from user_forces.values.value import Value, kinds_of

FIRST = ("Exact", "Johnson")  # of their kind: what the others are compared with
MODULES = (power_laws, dashpots, cylinders, pin_in_bore, friction_laws, lugre)


def laws(kind: type[Value]) -> dict[str, Any]:
    """Classes of the published laws of a kind, such as `PowerLaw`, by name: the reference, then by year."""
    names = {module.__name__ for module in MODULES}
    published = [law for law in kinds_of(kind).values() if law.__module__ in names and source(law)]
    published.sort(key=lambda law: (law.__name__ not in FIRST, year(law), law.__name__))
    return {name_of(law): law for law in published}


def name_of(law: type[Value]) -> str:
    """A law's name in figures and tables: `lankarani_nikravesh`, `esdu_78035`, `lugre`."""
    return re.sub(r"(?<=[a-z])(?<!Mc)(?<!Lu)(?=[A-Z\d])", "_", law.__name__).lower().replace("__", "_")


def source(law: type[Value]) -> str:
    """Where a law was published, on one line; empty if its docstring does not say."""
    return " ".join((inspect.getdoc(law) or "").partition("Source: ")[2].split())


def year(law: type[Value]) -> int:
    """The year in which a law was published; 9999 if its source has none in brackets."""
    match = re.search(r"\((\d{4})\)", source(law))
    return int(match[1]) if match else 9999


def title(law: type[Value]) -> str:
    """A law's name for readers: its `TITLE`, or its authors with a dash between them."""
    return getattr(law, "TITLE", "") or re.sub(r"(?<=[a-z])(?<!Mc)(?=[A-Z])", "-", law.__name__)
