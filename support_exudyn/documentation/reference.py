"""Public names in Python, a page for each room: their docstrings, units and ranges, and an example of each."""

import inspect
import sys
from collections import defaultdict
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from support_exudyn.files.toml.shapes import allowed, field_shapes
from user_forces.values.value import InputError, Value

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

MODULES = (
    "support_exudyn",
    "support_exudyn.files",
    "support_exudyn.files.machines",
    "support_exudyn.sweeps",
    "user_forces",
)
INHERITED = "Result"  # whose page shows what a run recorded, too


def public_names() -> dict[str, Any]:
    """All names that users import, each as MODULE.NAME, with what it stands for."""
    found: dict[str, Any] = {}
    for name in MODULES:
        module = import_module(name)
        for one in module.__all__:
            thing = getattr(module, one)
            if not inspect.ismodule(thing) and thing not in found.values():
                found[f"{name}.{one}"] = thing
    return found


def key_of(name: str) -> str:
    """The key of a public name's example: its last part, or all of it where two packages have the same name."""
    short = name.rpartition(".")[2]
    alike = [other for other in public_names() if other.rpartition(".")[2] == short]
    return short if len(alike) == 1 else name


def examples() -> Mapping[str, str]:
    """The example of each public name."""
    with (Path(__file__).parent / "names.toml").open("rb") as file:
        found: Mapping[str, str] = tomllib.load(file)
    return found


def room_of(name: str, thing: Any) -> str:
    """The room in which a public name is at home."""
    where = getattr(thing, "__module__", None) or name.rpartition(".")[0]
    first, *rest = where.split(".")
    return rest[0] if first == "support_exudyn" and rest else first


def reference_pages() -> dict[str, str]:
    """Pages of Markdown by room."""
    shown = examples()
    rooms: dict[str, list[str]] = defaultdict(list)
    for name, thing in sorted(public_names().items(), key=lambda item: item[0].rpartition(".")[2].lower()):
        rooms[room_of(name, thing)].append(_entry(name, thing, shown))
    return {room: f"# {room}\n\n" + "\n\n".join(entries) + "\n" for room, entries in sorted(rooms.items())}


def _entry(name: str, thing: Any, shown: Mapping[str, str]) -> str:
    short, key = name.rpartition(".")[2], key_of(name)
    if key not in shown:
        raise InputError(f"names.toml: {key}: missing; allowed: an example of every public name")
    parts = []
    if inspect.isclass(thing) or inspect.isfunction(thing):
        parts.append(f"::: {thing.__module__}.{thing.__qualname__}")
        if short == INHERITED:
            parts[-1] += "\n    options:\n      inherited_members: true"
    else:  # a value that is there
        parts.append(f"## {short}\n\n`{thing!r}`")
    if inspect.isclass(thing) and issubclass(thing, Value) and hasattr(thing, "__pydantic_fields__"):
        parts.append(_fields(thing))
    parts.append(f"**Example**\n\n```python\n{shown[key].strip()}\n```")
    return "\n\n".join(part for part in parts if part)


def _fields(cls: type[Value]) -> str:
    """Unit, range and default of every argument of a class."""
    lines = ["| argument | unit | allowed | default |", "|---|---|---|---|"]
    for field in field_shapes(cls).values():
        limits = allowed(field.shape) + (", or None" if field.allows_none else "")
        default = "needed" if field.required else f"`{field.default!r}`"
        cells = (f"`{field.name}`", field.unit.symbol if field.unit else "", limits, default)
        escaped = (cell.replace("|", "\\|") for cell in cells)
        lines.append(f"| {' | '.join(escaped)} |")
    return "\n".join(lines) if len(lines) > 2 else ""
