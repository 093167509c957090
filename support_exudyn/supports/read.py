"""From a machine data file to a HydraulicSupport."""

from __future__ import annotations

import sys
from importlib import resources
from pathlib import Path
from typing import Any

from support_exudyn.linkages.hydraulic_support import HydraulicSupport
from support_exudyn.machine import Part, bar
from user_forces.values import InputError, Vector2

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PART_KEYS = {"mass_kg", "between", "centre_mm", "length_mm"}
FILE_KEYS = {"name", "start_hinge_height_mm", "pivots_mm", "parts"}


def reference_support() -> HydraulicSupport:
    """The reference support that comes with the package."""
    with resources.as_file(resources.files("support_exudyn.supports") / "reference.toml") as path:
        return load_support(path)


def load_support(path: str | Path) -> HydraulicSupport:
    """Read a machine data file (mm and kg) into SI.

    Raises InputError, naming file and key, for anything that does not fit; OSError if there is no file.
    """
    path = Path(path)
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        return _support(data)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, InputError) as error:
        raise InputError(f"{path}: {error}") from None


def _support(data: dict[str, Any]) -> HydraulicSupport:
    _only(data, FILE_KEYS, "")
    for key in ("start_hinge_height_mm", "pivots_mm", "parts"):
        if key not in data:
            raise InputError(f"{key}: missing; it has no default")
    for key in ("pivots_mm", "parts"):
        if not isinstance(data[key], dict):
            raise InputError(f"{key} = {data[key]!r}: allowed: a table")
    pivots = {name: _metres(point, f"pivots_mm.{name}") for name, point in data["pivots_mm"].items()}
    parts = {
        body: tuple(_part(item, pivots, f"parts.{body}[{n}]") for n, item in enumerate(_tables(items, body)))
        for body, items in data["parts"].items()
    }
    height = _number(data["start_hinge_height_mm"], "start_hinge_height_mm")
    return HydraulicSupport(parts=parts, start_hinge_height=height / 1e3, **pivots)


def _tables(items: Any, body: str) -> list[dict[str, Any]]:
    if not (isinstance(items, list) and all(isinstance(item, dict) for item in items)):
        raise InputError(f"parts.{body} = {items!r}: allowed: tables, each begun with [[parts.{body}]]")
    return items


def _part(item: dict[str, Any], pivots: dict[str, Vector2], where: str) -> Part:
    _only(item, PART_KEYS, where + ".")
    if "mass_kg" not in item:
        raise InputError(f"{where}.mass_kg: missing; it has no default")
    mass = _number(item["mass_kg"], f"{where}.mass_kg")
    try:
        if "between" in item:
            a, b = _ends(item["between"], pivots, f"{where}.between")
            return bar(mass, a, b)
        if "centre_mm" not in item:
            raise InputError("centre_mm or between: missing; a part needs one of them")
        length = _number(item.get("length_mm", 0.0), f"{where}.length_mm") / 1e3
        centre = _metres(item["centre_mm"], f"{where}.centre_mm")
        return Part(mass=mass, centre=centre, inertia=mass * length**2 / 12)
    except InputError as error:
        raise InputError(str(error) if str(error).startswith(where) else f"{where}: {error}") from None


def _ends(names: Any, pivots: dict[str, Vector2], where: str) -> tuple[Vector2, Vector2]:
    if not (isinstance(names, list) and len(names) == 2 and all(name in pivots for name in names)):
        raise InputError(f"{where} = {names!r}: allowed: two of {', '.join(pivots)}")
    return pivots[names[0]], pivots[names[1]]


def _number(item: Any, where: str) -> float:
    if isinstance(item, bool) or not isinstance(item, (int, float)):
        raise InputError(f"{where} = {item!r}: allowed: a number")
    return float(item)


def _metres(point: Any, where: str) -> Vector2:
    if not (isinstance(point, list) and len(point) == 2):
        raise InputError(f"{where} = {point!r}: allowed: two numbers [x, y] in mm")
    return _number(point[0], where) / 1e3, _number(point[1], where) / 1e3


def _only(data: dict[str, Any], allowed: set[str], where: str) -> None:
    for key in data:
        if key not in allowed:
            raise InputError(f"{where}{key}: unknown key; allowed: {', '.join(sorted(allowed))}")
