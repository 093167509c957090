"""Classes of one's own that a file names by where they are: "my_laws:MyLaw", "my_laws.py:MyLaw"."""

import re
import sys
from collections.abc import Mapping
from difflib import get_close_matches
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from support_exudyn.files.toml.faults import Faults, Place, said, said_place
from user_forces.values.value import DEEPEST, InputError, Value, kinds_of

KEYS = ("type", "law", "friction_law", "damping")  # whose texts are names of classes
NAMED = re.compile(r"(?P<module>[^:]+):(?P<name>\w+)")
ENDING = ".py"


def without_places(table: Mapping[str, Any], faults: Faults, folder: Path) -> dict[str, Any]:
    """A table whose classes of one's own are imported, and named by their names alone.

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
        _check_class(own_module(found["module"], folder), found["name"])
    except InputError as error:
        faults.add((), f"{said_place(place)} = {said(item)}: {error}")
    return found["name"]


def own_module(name: str, folder: Path) -> ModuleType:
    """A module by its name or its file. Raises InputError that says what is allowed."""
    path = (folder / name).resolve() if name.endswith(ENDING) else None
    if path is not None and not path.is_file():
        raise InputError(f"allowed: a file that is there, from {folder.resolve()} on")
    where, called = (folder.resolve(), name) if path is None else (path.parent, path.stem)
    if str(where) not in sys.path:  # other processes that run it look there, too
        sys.path.insert(0, str(where))
    try:
        module = import_module(called)
    except ModuleNotFoundError as error:
        missing = called if error.name in (called, called.partition(".")[0]) else error.name
        raise InputError(
            f"allowed: a module in {where}, or one that is installed (no module {missing!r})"
        ) from None
    except Exception as error:  # whatever a user's module does wrong
        raise InputError(f"allowed: a module that can be imported ({type(error).__name__}: {error})") from None
    if path is not None and Path(getattr(module, "__file__", None) or "").resolve() != path:
        raise InputError(f"allowed: a file of another name, for {called} is the name of another module already")
    return module


def _check_class(module: ModuleType, name: str) -> None:
    """Raise InputError, which says what is allowed, unless a module has such a class of values."""
    known = [one for one, kind in kinds_of(Value).items() if kind.__module__ == module.__name__]
    if kinds_of(Value).get(name) is getattr(module, name, ()):
        return
    if hasattr(module, name):
        raise InputError(
            f"allowed: a class that is made with @value and has all methods of its kind; {name} is not"
        )
    near = get_close_matches(name, known, 2, 0.4)
    guess = f"did you mean {' or '.join(map(said, near))}? " if near else ""
    raise InputError(f"{guess}allowed: classes of {module.__name__}: {', '.join(known) or 'none'}")
