"""The table that says what the numbers of meshes stand for."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from support_exudyn.postprocessing.look.solid import Role


class Named(NamedTuple):
    """A number in the field `field` ("body", "role", "pin") and its name."""

    field: str
    id: int
    name: str


ROLES = tuple(Role)


def numbered(field: str, names: Iterable[str]) -> list[Named]:
    """Names with numbers from 0 on."""
    return [Named(field, number, name) for number, name in enumerate(names)]


def role_names() -> list[Named]:
    """What a part of the machine is."""
    return numbered("role", (role.value for role in ROLES))


def write_names(path: Path, names: Iterable[Named]) -> None:
    """As CSV with the columns field, id, name."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(Named._fields)
        writer.writerows(names)
