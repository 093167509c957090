"""Names that a package offers and imports only when they are asked for, and the classes of values among them.

A package of ours gives all its names, but a program that asks for three of them need not wait for the others. A
class that is named in a file is imported from where it lies.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from importlib.util import resolve_name
from pathlib import Path
from typing import Any

from user_forces.values.names import meant

_of_classes: dict[str, str] = {}  # the modules in which classes of values lie, and names that lie there too


def for_types(file: str) -> dict[str, list[str]]:
    """The names that a package imports for type checkers alone, in `if TYPE_CHECKING`, by their module."""
    places: dict[str, list[str]] = {}
    for block in ast.parse(Path(file).read_text(encoding="utf-8")).body:
        if isinstance(block, ast.If) and ast.unparse(block.test) == "TYPE_CHECKING":
            for line in block.body:
                if isinstance(line, ast.ImportFrom) and line.module is not None:
                    places.setdefault(line.module, []).extend(one.name for one in line.names)
    return places


def offered(
    package: str, places: Mapping[str, Sequence[str]]
) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """What a package calls `__getattr__`, which imports a name when it is asked for, and `__dir__`.

    places: names by the module that has them; one of the package itself begins with a dot.
    """
    where = _modules(package, places)

    def found(name: str) -> Any:
        if name == "__all__":  # of an import of everything
            return sorted(where)
        if name not in where:
            raise AttributeError(f"module {package!r} has no attribute {name!r}; {meant(name, sorted(where))}")
        item = getattr(import_module(where[name]), name)
        setattr(sys.modules[package], name, item)  # from now on it is there
        return item

    return found, lambda: sorted({*vars(sys.modules[package]), *where})


def keep_classes(package: str, places: Mapping[str, Sequence[str]]) -> None:
    """Let classes of values be found in these modules; places as of `offered`."""
    _of_classes.update(_modules(package, places))


def _modules(package: str, places: Mapping[str, Sequence[str]]) -> dict[str, str]:
    return {name: resolve_name(module, package) for module, names in places.items() for name in names}


def place(name: str) -> str | None:
    """The module in which a class of ours lies; None if it is not one that packages offer."""
    return _of_classes.get(name)


def import_all() -> None:
    """Import all modules of ours that have classes of values."""
    while missing := set(_of_classes.values()) - sys.modules.keys():  # each may tell of others
        for module in sorted(missing):
            import_module(module)
