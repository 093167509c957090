"""Fields of tables by their dotted keys."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

from support_exudyn.files.toml.toml_reading import parsed
from user_forces.values.value import InputError, short

Table = dict[str, Any]


def replaced(table: Table, inputs: Mapping[str, Any]) -> Table:
    """A copy of a table with some fields replaced or added.

    inputs: values by their keys, joined by dots; of a list by its number from 0, such as
    "machine.parts.shield.0.mass_kg".

    Raises InputError if a key leads into something that is no table.
    """
    whole = copy.deepcopy(table)
    for name, item in inputs.items():
        *above, last = keys_of(name)
        inner: Any = whole
        for n, key in enumerate(above):
            here = _at(inner, key, name)
            inner = inner.setdefault(key, {}) if isinstance(inner, dict) else inner[here]
            if not isinstance(inner, (dict, list)):
                said = ".".join(above[: n + 1])
                raise InputError(
                    f"vary.{name!r}: {said} = {short(inner)} is no table; allowed: a field of a table"
                )
        inner[_at(inner, last, name)] = item
    return whole


def _at(inner: Any, key: str, name: str) -> Any:
    """How a table or list is asked for a key."""
    if isinstance(inner, dict):
        return key
    if not (key.isdecimal() and int(key) < len(inner)):
        raise InputError(f"vary.{name!r}: {key!r} of a list; allowed: its items, from 0 to {len(inner) - 1}")
    return int(key)


def keys_of(name: str) -> list[str]:
    """The keys that a dotted one is made of, by TOML's own rules. Raises InputError if it is none."""
    try:
        inner: Any = parsed(f"{name} = 0", "vary")
    except InputError:
        raise InputError(f"vary: {short(name)}: allowed: keys of a scenario file, joined by dots") from None
    keys = []
    while isinstance(inner, dict):
        ((key, inner),) = inner.items()
        keys.append(key)
    return keys
