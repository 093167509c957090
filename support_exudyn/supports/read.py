"""From a machine data file to a HydraulicSupport."""

from __future__ import annotations

import math
import sys
from contextlib import AbstractContextManager
from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import Any

from support_exudyn.columns import OilColumn, RigidColumn, TwoBodyColumn
from support_exudyn.linkages.hydraulic_support import HydraulicSupport
from support_exudyn.machine import Part, bar
from support_exudyn.width import Width
from user_forces.values import LARGEST, InputError, Vector2, short, step

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PART_KEYS = {"name", "mass_kg", "between", "centre_mm", "length_mm", "direction_deg"}
FILE_KEYS = {"name", "start_hinge_height_mm", "pivots_mm", "parts", "columns", "width_mm"}
WIDTH_KEYS = {"bodies", "pairs", "columns", "pins", "points"}
NO_PIVOTS = {"parts", "start_hinge_height", "width"}  # fields of the support that stand elsewhere
COLUMN_KEYS = ("cylinder_mass_kg", "cylinder_length_mm", "rod_mass_kg", "rod_length_mm")


def reference_support() -> HydraulicSupport:
    """The reference support that comes with the package."""
    with _reference() as path:
        return load_support(path)


def load_support(path: str | Path) -> HydraulicSupport:
    """Read a machine data file (mm and kg) into SI.

    Raises InputError, naming file and key, for anything that does not fit; OSError if there is no file.
    """
    return _read(Path(path))[0]


def two_body_columns(
    drive: RigidColumn | OilColumn | None = None, path: str | Path | None = None
) -> dict[str, TwoBodyColumn]:
    """Columns with mass, by name, for `Scenario.columns`: cylinder and rod each a uniform bar from its pin on.

    Arguments:
        drive: what holds their lengths; rigid if nothing is said.
        path: of the machine data file whose `[columns.NAME]` say masses and lengths; by default that of the
            reference support.

    Raises as `load_support` does.
    """
    if path is None:
        with _reference() as reference:
            return two_body_columns(drive, reference)
    columns = _read(Path(path))[1]
    return columns if drive is None else {name: replace(item, drive=drive) for name, item in columns.items()}


def _reference() -> AbstractContextManager[Path]:
    return resources.as_file(resources.files("support_exudyn.supports") / "reference.toml")


def _read(path: Path) -> tuple[HydraulicSupport, dict[str, TwoBodyColumn]]:
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        return _support(data), _columns(data.get("columns", {}))
    except RecursionError:
        raise InputError(f"{path}: is nested too deep; allowed: tables of numbers and lists of two") from None
    except ValueError as error:  # of TOML, of UTF-8, of a number with thousands of digits, or ours
        raise InputError(f"{path}: {error}") from None


def _columns(data: Any) -> dict[str, TwoBodyColumn]:
    if not (isinstance(data, dict) and all(isinstance(item, dict) for item in data.values())):
        raise InputError(f"columns = {short(data)}: allowed: tables, each begun with [columns.NAME]")
    return {name: _column(item, f"columns.{step(name)}") for name, item in data.items()}


def _column(item: dict[str, Any], where: str) -> TwoBodyColumn:
    _only(item, set(COLUMN_KEYS), where + ".")
    for key in COLUMN_KEYS:
        if key not in item:
            raise InputError(f"{where}.{key}: missing; it has no default")
        if _number(item[key], f"{where}.{key}") <= 0.0:
            raise InputError(f"{where}.{key} = {short(item[key])}: allowed: > 0")
    cylinder, cylinder_length, rod, rod_length = (float(item[key]) for key in COLUMN_KEYS)
    return TwoBodyColumn(
        cylinder_mass=cylinder,
        cylinder_centre=0.5 * cylinder_length / 1e3,
        cylinder_inertia=cylinder * (cylinder_length / 1e3) ** 2 / 12,
        rod_mass=rod,
        rod_centre=0.5 * rod_length / 1e3,
        rod_inertia=rod * (rod_length / 1e3) ** 2 / 12,
    )


def _support(data: dict[str, Any]) -> HydraulicSupport:
    _only(data, FILE_KEYS, "")
    for key in ("start_hinge_height_mm", "pivots_mm", "parts"):
        if key not in data:
            raise InputError(f"{key}: missing; it has no default")
    for key in ("pivots_mm", "parts"):
        if not isinstance(data[key], dict):
            raise InputError(f"{key} = {short(data[key])}: allowed: a table")
    pivots = {name: _metres(point, f"pivots_mm.{step(name)}") for name, point in data["pivots_mm"].items()}
    for name in NO_PIVOTS & pivots.keys():
        raise InputError(f"pivots_mm.{name}: unknown field; allowed: names of pivots")
    parts = {
        body: tuple(
            _part(item, pivots, f"parts.{step(body)}[{n}]") for n, item in enumerate(_tables(items, body))
        )
        for body, items in data["parts"].items()
    }
    height = _number(data["start_hinge_height_mm"], "start_hinge_height_mm")
    width = _width(data["width_mm"]) if "width_mm" in data else None
    return HydraulicSupport(parts=parts, start_hinge_height=height / 1e3, width=width, **pivots)


def _width(data: Any) -> Width:
    """Lateral dimensions: widths of bodies, distances of pairs, lengths of pins [mm]."""
    if not (isinstance(data, dict) and all(isinstance(item, dict) for item in data.values())):
        raise InputError(f"width_mm = {short(data)}: allowed: tables, each begun with [width_mm.NAME]")
    _only(data, WIDTH_KEYS, "width_mm.")

    def table(key: str, scale: float) -> dict[str, float]:
        items = data.get(key, {}).items()
        return {name: scale * _number(item, f"width_mm.{key}.{step(name)}") / 1e3 for name, item in items}

    return Width(
        spreads=table("bodies", 1.0 / math.sqrt(12.0)),
        pairs=table("pairs", 0.5),
        columns=table("columns", 0.5),
        lengths=table("pins", 1.0),
        points=table("points", 0.5),
    )


def _tables(items: Any, body: str) -> list[dict[str, Any]]:
    if not (isinstance(items, list) and all(isinstance(item, dict) for item in items)):
        raise InputError(
            f"parts.{step(body)} = {short(items)}: allowed: tables, each begun with [[parts.NAME]]"
        )
    return items


def _part(item: dict[str, Any], pivots: dict[str, Vector2], where: str) -> Part:
    _only(item, PART_KEYS, where + ".")
    if "mass_kg" not in item:
        raise InputError(f"{where}.mass_kg: missing; it has no default")
    mass = _number(item["mass_kg"], f"{where}.mass_kg")
    name = item.get("name", "")
    if not isinstance(name, str):
        raise InputError(f"{where}.name = {short(name)}: allowed: a text")
    try:
        if "between" in item:
            a, b = _ends(item["between"], pivots, f"{where}.between")
            return replace(bar(mass, a, b), name=name)
        if "centre_mm" not in item:
            raise InputError("centre_mm or between: missing; a part needs one of them")
        length = _number(item.get("length_mm", 0.0), f"{where}.length_mm") / 1e3
        centre = _metres(item["centre_mm"], f"{where}.centre_mm")
        along = math.radians(_number(item.get("direction_deg", 0.0), f"{where}.direction_deg"))
        half = 0.5 * length * math.cos(along), 0.5 * length * math.sin(along)
        # not its ends: rounding would move its centre
        return replace(bar(mass, (-half[0], -half[1]), half), name=name, centre=centre)
    except InputError as error:
        raise InputError(str(error) if str(error).startswith(where) else f"{where}: {error}") from None


def _ends(names: Any, pivots: dict[str, Vector2], where: str) -> tuple[Vector2, Vector2]:
    if not (
        isinstance(names, list) and len(names) == 2 and all(isinstance(n, str) and n in pivots for n in names)
    ):
        raise InputError(f"{where} = {short(names)}: allowed: two of {', '.join(pivots)}")
    return pivots[names[0]], pivots[names[1]]


def _number(item: Any, where: str) -> float:
    if isinstance(item, bool) or not isinstance(item, (int, float)):
        raise InputError(f"{where} = {short(item)}: allowed: a number")
    if abs(item) > LARGEST:
        raise InputError(f"{where} = {short(item)}: allowed: a number up to {LARGEST:g}")
    return float(item)


def _metres(point: Any, where: str) -> Vector2:
    if not (isinstance(point, list) and len(point) == 2):
        raise InputError(f"{where} = {short(point)}: allowed: two numbers [x, y] in mm")
    return _number(point[0], where) / 1e3, _number(point[1], where) / 1e3


def _only(data: dict[str, Any], allowed: set[str], where: str) -> None:
    for key in data:
        if key not in allowed:
            raise InputError(f"{where}{step(key)}: unknown key; allowed: {', '.join(sorted(allowed))}")
