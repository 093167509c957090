"""Modules of the user's own: they are imported because the user names them, never because a file does.

A file that is read runs no Python. A scenario's file names a class by its place, "my_laws.py:MyLaw"; the file
of a run notes the module of each such class. Both hold for modules that `trusted` or the user's own program has
imported. Without its module a run still has its numbers: a `NotImported` stands where the value was.
"""

import sys
from abc import ABC
from collections.abc import Iterator, Mapping
from dataclasses import fields, make_dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any, NoReturn

from user_forces.values.value import InputError, Value, cleaned, kinds_of, known_class, known_classes, short

OURS = ("user_forces", "support_exudyn")
NAMING = ("type", "damping")  # keys of plain data whose texts are names of classes
ENDING = ".py"


def trusted(*names: str | Path) -> None:
    """Import modules, so that files may hold their laws, machines, drives and loads.

    On a command line `--import` does this. Files run no Python without it.

    names: of files, such as "my_laws.py", or of modules in the working directory or installed.

    Raises InputError that names the file or module if there is none, or if it cannot be imported.
    """
    for name in names:
        _import(str(name))


def _import(name: str) -> None:
    """Import a module by its file or by its name."""
    path = Path(name).resolve() if name.endswith(ENDING) else None
    if path is not None and not path.is_file():
        raise InputError(
            f"{short(name)}: there is no such file; allowed: a file of Python, or the name of a module"
        )
    folder, called = (Path.cwd(), name) if path is None else _place_of(path)
    if str(folder) not in sys.path:
        sys.path.append(str(folder))  # at the end: no file beside the module stands for a library
    try:
        module = import_module(called)
    except ModuleNotFoundError as error:
        missing = "no such module" if error.name in (called, called.partition(".")[0]) else str(error)
        raise InputError(
            f"{short(name)}: {missing}; allowed: a file, or a module in the working directory or installed"
        ) from None
    except Exception as error:  # whatever a user's module does wrong
        raise InputError(f"{short(name)}: {type(error).__name__}: {error}") from error
    if path not in (None, file_of(module)):
        raise InputError(
            f"{short(name)}: {called} is the name of another module already; allowed: a file of another name"
        )


def _place_of(path: Path) -> tuple[Path, str]:
    """The folder from which the module of a file is imported, and its name; packages have an __init__.py."""
    folder, parts = path.parent, [] if path.name == "__init__.py" else [path.stem]
    while (folder / "__init__.py").is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return folder, ".".join(parts)


def file_of(module: ModuleType | None) -> Path | None:
    """The file of a module; None if it has none."""
    path = getattr(module, "__dict__", {}).get("__file__")  # asks no module that imports others for it
    return Path(path).resolve() if isinstance(path, str) else None


def refusal(name: str, module: str, path: Path | str) -> str:
    """Why the class of a module that is not imported is not known, and what to do."""
    place = cleaned(str(path)) or f"{cleaned(module)}, a module without a file"
    return (
        f"{short(name)} is a class of {place}, which is not imported: files run no Python by themselves; if "
        f"you trust it: --import {cleaned(str(path)) or 'FILE'} on the command line, "
        f"support_exudyn.trusted({str(path) or 'FILE'!r}) in Python"
    )


def classes_in(data: Any) -> Iterator[str]:
    """Names of all classes in the plain data of a value, some of them more than once."""
    if isinstance(data, Mapping):
        yield from _named(data)
        for item in data.values():
            yield from classes_in(item)
    elif isinstance(data, (list, tuple)):
        for item in data:
            yield from classes_in(item)


def _named(data: Mapping[str, Any]) -> list[str]:
    return [data[key] for key in NAMING if isinstance(data.get(key), str)]


def modules_of(data: Any) -> dict[str, dict[str, str]]:
    """The modules of one's own that have classes of a value.

    data: of the value, as `Value.to_data` gives it.

    Returns:
        For each class by name its `module` and the absolute `path` of that ("" if it has no file).

    Raises InputError if the value has a class that is not imported.
    """
    found = {}
    for name in dict.fromkeys(classes_in(data)):
        kind = known_class(name)
        if kind is None:
            raise InputError(f"{short(name)}: its module is not imported; allowed: trusted(FILE) before")
        if kind.__module__.partition(".")[0] not in OURS:
            path = file_of(sys.modules.get(kind.__module__))
            found[name] = {"module": kind.__module__, "path": str(path or "")}
    return found


# --- values of classes that are not imported ---


class _NotThereError(InputError, AttributeError):
    """What is asked of a value whose class is not imported: for `hasattr` it is not there."""


class NotImported(Value):
    """A value of a class that is not imported: its fields are there, what it does is refused.

    Arguments:
        why: the refusal, as `refusal` says it.
        fields: the values of its fields, by name.
    """

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Such classes stand in no register: the class itself may be imported later."""

    def __new__(cls, *args: Any) -> "NotImported":
        """The new value; there is no check that could be made."""
        return object.__new__(cls)

    _why = ""  # before the value has its own, as while it is copied

    def __init__(self, why: str, fields: Mapping[str, Any]) -> None:
        vars(self).update(fields, _why=why)

    def __getattr__(self, name: str) -> Any:
        del name
        raise _NotThereError(self._why)

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Refuse: there is no law to evaluate."""
        self.refuse()

    def refuse(self) -> NoReturn:
        """Raise InputError that says which module is not imported, and what to do."""
        raise InputError(self._why)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, NotImported) and self.to_data() == other.to_data()

    def __hash__(self) -> int:
        return hash(str(self.to_data()))

    def __reduce__(self) -> tuple[Any, ...]:
        named = {one.name: getattr(self, one.name) for one in fields(self)}  # type: ignore[arg-type]
        return not_imported, (type(self).__name__, self._why, named)


def not_imported(name: str, why: str, named: Mapping[str, Any]) -> NotImported:
    """A value of a class that is not imported.

    name: of the class. why, named: the refusal and the fields, see `NotImported`.
    """
    for kind in known_classes().values():
        if kind.__bases__ == (Value, ABC):  # what fields ask for
            kind.register(NotImported)  # type: ignore[attr-defined]
    made = make_dataclass(name, list(named), bases=(NotImported,), init=False, repr=False, eq=False)
    found: NotImported = made(why, named)
    return found


def with_known_laws(pins: Mapping[str, Any]) -> dict[str, Any]:
    """The clearance pins whose laws are imported, of some by name."""
    return {
        name: pin
        for name, pin in pins.items()
        if not any(isinstance(law, NotImported) for law in (pin.contact.normal, pin.contact.friction))
    }


def without_modules(data: Any, missing: Mapping[str, str]) -> Any:
    """Plain data with a `NotImported` in place of every value of a class that is not imported.

    missing: their refusals, by the names of the classes.
    """
    if isinstance(data, list):
        return [without_modules(item, missing) for item in data]
    if not isinstance(data, dict):
        return data
    inside = {key: without_modules(item, missing) for key, item in data.items()}
    for name in _named(data):
        if name in missing:
            named = {key: _value(item) for key, item in inside.items() if key != "type"}
            return not_imported(data["type"], missing[name], named)
    return inside


def _value(item: Any) -> Any:
    return Value.from_data(item) if isinstance(item, dict) and "type" in item else item


def refusals(noted: Mapping[str, Mapping[str, str]]) -> dict[str, str]:
    """Why classes of a file are not known, by their names. noted: as `modules_of` gives it."""
    known = kinds_of(Value)
    return {
        name: refusal(name, place["module"], place["path"])
        for name, place in noted.items()
        if name not in known
    }
