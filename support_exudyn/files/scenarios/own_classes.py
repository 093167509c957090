"""Classes of one's own that a file names by where they are, "my_laws.py:MyLaw"; none is imported here."""

import re
import sys
from collections.abc import Mapping
from contextlib import suppress
from difflib import get_close_matches
from pathlib import Path
from types import ModuleType
from typing import Any

from support_exudyn.files.own_modules import ENDING, file_of, refusal
from support_exudyn.files.toml.faults import Faults, Place, quoted
from user_forces.values.value import DEEPEST, InputError, Value, kinds_of

KEYS = ("type", "law", "friction_law", "damping")  # whose texts are names of classes
NAMED = re.compile(r"(?P<module>[^:]+):(?P<name>\w+)")


def without_places(table: Mapping[str, Any], faults: Faults, folder: Path) -> dict[str, Any]:
    """A table whose classes of one's own are named by their names alone, if their modules are imported.

    Arguments:
        table: of a file. faults: takes what is wrong with them.
        folder: from which files and modules lie.
    """
    return {key: _inside(key, item, (key,), faults, folder) for key, item in table.items()}


def _inside(key: str, item: Any, place: Place, faults: Faults, folder: Path) -> Any:
    if len(place) > DEEPEST:  # which reading refuses
        return item
    if isinstance(item, dict):
        return {name: _inside(name, one, (*place, name), faults, folder) for name, one in item.items()}
    if isinstance(item, list):
        return [_inside(key, one, (*place, str(n)), faults, folder) for n, one in enumerate(item)]
    if key not in KEYS or not isinstance(item, str) or not (found := NAMED.fullmatch(item)):
        return item
    try:
        _check_class(_module(found["module"], folder, found["name"]), found["name"])
    except InputError as error:
        faults.refuse(place, item, str(error))
    return found["name"]


def modules_named(item: Any, folder: Path) -> set[str]:
    """Names of the imported modules whose classes tables name; other processes have to import them, too."""
    if isinstance(item, (dict, list)):
        inside = item.values() if isinstance(item, dict) else item
        return set().union(*(modules_named(one, folder) for one in inside))
    if isinstance(item, str) and (found := NAMED.fullmatch(item)):
        with suppress(InputError):  # which reading tells
            return {_module(found["module"], folder, found["name"]).__name__}
    return set()


def _module(name: str, folder: Path, wanted: str) -> ModuleType:
    """A module that is imported, by its name or by its file. Raises InputError that says what to do."""
    if not name.endswith(ENDING):
        if (module := sys.modules.get(name)) is None:
            raise InputError(refusal(wanted, name, name))
        return module
    path = (folder / name).resolve()
    if not path.is_file():
        raise InputError(f"allowed: a file that is there, from {folder.resolve()} on")
    for module in list(sys.modules.values()):
        if file_of(module) == path:
            return module
    raise InputError(refusal(wanted, name, path))


def _check_class(module: ModuleType, name: str) -> None:
    """Raise InputError, which says what is allowed, unless a module has such a class of values."""
    known = [one for one, kind in kinds_of(Value).items() if kind.__module__ == module.__name__]
    if name in known or kinds_of(Value).get(name) is vars(module).get(name, ()):
        return
    if name in vars(module):
        raise InputError(
            f"allowed: a class that is made with @value and has all methods of its kind; {name} is not"
        )
    near = get_close_matches(name, known, 2, 0.4)
    guess = f"did you mean {' or '.join(map(quoted, near))}? " if near else ""
    raise InputError(f"{guess}allowed: classes of {module.__name__}: {', '.join(known) or 'none'}")
