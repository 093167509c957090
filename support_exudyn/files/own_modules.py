"""Classes of one's own in the file of a run: which module they are of, and its import when the run is read."""

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from support_exudyn.files.scenarios.own_classes import own_module
from user_forces.values.value import InputError, Value, cleaned, kinds_of, short

OURS = ("user_forces", "support_exudyn")
SCRIPT = "__main__"
NAMING = ("type", "damping")  # keys of plain data whose texts are names of classes


def classes_in(data: Any) -> Iterator[str]:
    """Names of all classes in the plain data of a value, some of them more than once."""
    if isinstance(data, Mapping):
        yield from (data[key] for key in NAMING if isinstance(data.get(key), str))
        for item in data.values():
            yield from classes_in(item)
    elif isinstance(data, (list, tuple)):
        for item in data:
            yield from classes_in(item)


def modules_of(data: Any) -> dict[str, dict[str, str]]:
    """The modules of one's own that have classes of a value.

    data: of the value, as `Value.to_data` gives it.

    Returns:
        For each class by name its `module` and the absolute `path` of that ("" if it has no file).
    """
    found = {}
    for name in dict.fromkeys(classes_in(data)):
        module = Value.of_name(name).__module__
        if module.partition(".")[0] not in OURS:
            path = getattr(sys.modules.get(module), "__file__", None)
            found[name] = {"module": module, "path": str(Path(path).resolve()) if path else ""}
    return found


def import_modules_of(found: Mapping[str, Mapping[str, str]]) -> None:
    """Import the modules of classes that are not known yet; this runs their Python.

    found: as `modules_of` gives it.

    Raises InputError that names class, module and where it was, if it is not there or cannot be imported.
    """
    for name, place in found.items():
        if name in kinds_of(Value):
            continue
        module, path = place["module"], Path(place["path"])
        was = f"{short(name)} is a class of module {cleaned(module)}, which was at {cleaned(place['path'])}"
        if module == SCRIPT or not place["path"]:
            raise InputError(f"{was}: a script; allowed: its class in a module, and --import MODULE")
        if not path.is_file():
            raise InputError(
                f"{was}: there is no such file now; allowed: the file there, or "
                f"--import {cleaned(module)} from the folder where it is"
            )
        try:
            own_module(*_called(module, path))
        except InputError as error:
            raise InputError(f"{was}: {error}") from None
        if name not in kinds_of(Value):
            raise InputError(f"{was}: the file has no such class now; allowed: the file as it was")


def _called(module: str, path: Path) -> tuple[str, Path]:
    """By which name and from which folder a module is imported."""
    package = path.name == "__init__.py"
    if "." not in module and not package:
        return str(path), path.parent
    return module, path.parents[module.count(".") + package]
