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
    except (tomllib.TOMLDecodeError, InputError) as error:
        raise InputError(f"{path}: {error}") from None


def _support(data: dict[str, Any]) -> HydraulicSupport:
    _only(data, FILE_KEYS, "")
    for key in ("start_hinge_height_mm", "pivots_mm", "parts"):
        if key not in data:
            raise InputError(f"{key}: missing; it has no default")
    pivots = {name: _metres(point, f"pivots_mm.{name}") for name, point in data["pivots_mm"].items()}
    parts = {
        body: tuple(_part(item, pivots, f"parts.{body}[{n}]") for n, item in enumerate(items))
        for body, items in data["parts"].items()
    }
    return HydraulicSupport(parts=parts, start_hinge_height=data["start_hinge_height_mm"] / 1e3, **pivots)


def _part(item: dict[str, Any], pivots: dict[str, Vector2], where: str) -> Part:
    _only(item, PART_KEYS, where + ".")
    try:
        if "between" in item:
            a, b = (pivots[name] for name in item["between"])
            return bar(item["mass_kg"], a, b)
        centre = _metres(item["centre_mm"], f"{where}.centre_mm")
        length = item.get("length_mm", 0.0) / 1e3
        return Part(mass=item["mass_kg"], centre=centre, inertia=item["mass_kg"] * length**2 / 12)
    except KeyError as error:
        raise InputError(f"{where}: {error} is missing or not a pivot") from None
    except InputError as error:
        raise InputError(f"{where}: {error}") from None


def _metres(point: Any, where: str) -> Vector2:
    if not (isinstance(point, list) and len(point) == 2 and all(isinstance(c, (int, float)) for c in point)):
        raise InputError(f"{where} = {point!r}: allowed: two numbers [x, y] in mm")
    return point[0] / 1e3, point[1] / 1e3


def _only(data: dict[str, Any], allowed: set[str], where: str) -> None:
    for key in data:
        if key not in allowed:
            raise InputError(f"{where}{key}: unknown key; allowed: {', '.join(sorted(allowed))}")
