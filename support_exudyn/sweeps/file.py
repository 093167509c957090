"""The file of a sweep, and the scenarios that its points give.

A scenario is made of the table of a scenario file, with fields of it and of its machine's file replaced.
"""

import copy
import math
import tempfile
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from decimal import Decimal
from importlib import import_module
from pathlib import Path
from typing import Any

from support_exudyn.files import machines
from support_exudyn.files.machines.read import shipped
from support_exudyn.files.scenarios.own_classes import modules_named
from support_exudyn.files.scenarios.scenario_file import scenario_of
from support_exudyn.files.toml.text import load_toml, parsed, text_of, toml_text
from support_exudyn.files.whole_file import missing_file
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.sweeps.distributions import KEYS as DISTRIBUTION_KEYS
from support_exudyn.sweeps.distributions import (
    MACHINE,
    STATED,
    STRENGTH,
    distribution_of,
    of_strength,
    stated_ranges,
)
from support_exudyn.sweeps.plan import (
    Inputs,
    Plan,
    Point,
    Range,
    Record,
    Varied,
    grid,
    latin_hypercube,
    side_by_side,
)
from user_forces.values.value import InputError, short

METHODS = ("grid", "list", "latin_hypercube")
KEYS = {"scenario", "method", "vary", "record", "samples", "seed"}
RECORD_KEYS = {"numbers", "after_s", "until_s"}
RANGE_KEYS = {"from", "to", "steps", "scale"}
RANGE, NORMAL = (
    "{from = 0.0, to = 0.3, steps = 4}",
    '{distribution = "normal", mean = 0.9, std = 0.02}',
)
Table = dict[str, Any]


def read_sweep(path: str | Path) -> Plan:
    """The plan that a file describes.

    Raises InputError that names file, key, value and what is allowed; OSError if there is no such file.
    """
    path = Path(path)
    try:
        data = load_toml(path)
    except FileNotFoundError as error:
        raise missing_file(path, "the TOML file of a sweep") from error
    try:
        _only(data, KEYS, "")
        table, where, folder = _scenario(data, path)
        asked = dict(_flat(_table(data, "vary")))
        said = {
            name: _varied(item, f"vary.{name!r}", path.parent) for name, item in asked.items() if item != STATED
        }
        patterns = [name for name in asked if name not in said]
        stated = stated_ranges(patterns, data.get("method", "grid"), table, where, folder) if patterns else {}
        varied = {  # what is said of a key itself goes before what a file states
            name: one
            for name, one in stated.items()
            if not any(f"{name}.".startswith(f"{key}.") for key in said.keys() - {MACHINE})
        } | said
        told = where if isinstance(data.get("scenario"), dict) else f"{where} as {path} varies it"
        return Plan(
            points=_points(data, varied),
            scenario=replace(
                maker(table, told, folder, tuple(varied)), modules=modules_named([table, data], folder)
            ),
            record=_record(_table(data, "record")),
            errors=table.get("errors") is True,
            text=text_of(path),
            sampled=data.get("method") == "latin_hypercube",
            store=path.with_name(f"{path.stem}_sweep"),
        )
    except InputError as error:
        raise InputError(str(error) if str(error).startswith(str(path)) else f"{path}: {error}") from None


def _scenario(data: Table, path: Path) -> tuple[Table, str, Path]:
    """Its table, what errors call it, and the folder from which its paths go on."""
    given = data.get("scenario")
    if isinstance(given, dict):
        return given, f"{path}: scenario", path.parent
    if not isinstance(given, str):
        raise InputError(
            f"scenario = {short(given)}: allowed: the path of a scenario file, or a table [scenario]"
        )
    file = path.parent / given
    return load_toml(file, named=True), str(file), file.parent


def _points(data: Table, varied: Varied) -> list[Point]:
    method = data.get("method", "grid")
    if method not in METHODS:
        raise InputError(f"method = {short(method)}: allowed: {', '.join(map(repr, METHODS))}")
    if method == "latin_hypercube":
        return latin_hypercube(varied, _whole(data, "samples", 1), _whole(data, "seed", 0, 1))
    for name in ("samples", "seed"):
        if name in data:
            raise InputError(f"{name}: means nothing here; allowed with method = 'latin_hypercube'")
    for name, one in varied.items():
        if "distribution" in _table(data, "vary").get(name, ()):
            raise InputError(f"vary.{name!r}.distribution: allowed with method = 'latin_hypercube'")
        if isinstance(one, Range) and not one.steps:
            raise InputError(f"vary.{name!r}.steps: missing; allowed with method = {method!r}: from 2 on")
    return grid(varied) if method == "grid" else side_by_side(varied)


def _varied(item: Any, where: str, folder: Path) -> Any:
    if isinstance(item, list):
        if not item:
            raise InputError(f"{where} = []: allowed: at least one value")
        return item
    if "distribution" in item:
        return distribution_of(item, where, folder)
    _only(item, RANGE_KEYS, f"{where}.")
    for key in ("from", "to"):
        if not _is_number(item.get(key)):
            raise InputError(f"{where}.{key} = {_said(item.get(key))}: allowed: a number")
    low, high = Decimal(item["from"]), Decimal(item["to"])
    scale = item.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise InputError(f"{where}.scale = {short(scale)}: allowed: 'linear', 'log'")
    if scale == "log" and not (low > 0 and high > 0):
        raise InputError(f"{where}: from = {low}, to = {high}: allowed with scale = 'log': > 0")
    steps = _whole(item, "steps", 2, default=0, where=f"{where}.") if "steps" in item else 0
    return Range(low, high, steps, scale)


def _record(table: Table) -> Record:
    _only(table, RECORD_KEYS, "record.")
    numbers = table.get("numbers", [])
    if not (isinstance(numbers, list) and all(isinstance(name, str) and name for name in numbers)):
        raise InputError(f"record.numbers = {short(numbers)}: allowed: a list of names")
    times = {}
    for key, usual in (("after_s", 0), ("until_s", math.inf)):
        times[key] = table.get(key, usual)
        if key in table and not (_is_number(times[key]) and times[key] >= 0):
            raise InputError(f"record.{key} = {_said(times[key])}: allowed: a time in s, >= 0")
    return Record(tuple(numbers), float(times["after_s"]), float(times["until_s"]))


def _flat(table: Table, before: str = "") -> list[tuple[str, Any]]:
    """Fields by their dotted keys, whether these were quoted or not."""
    found = []
    for key, item in table.items():
        name = f"{before}{key}"
        if isinstance(item, dict) and not item.keys() & (RANGE_KEYS | DISTRIBUTION_KEYS):
            found += _flat(item, f"{name}.")
        elif isinstance(item, (dict, list)) or item == STATED:
            found.append((name, item))
        else:
            raise InputError(
                f"vary.{name!r} = {_said(item)}: allowed: a list of values, or a range such as "
                f"{RANGE}, or {NORMAL}; {STATED!r} for numbers whose file states one"
            )
    return found


# --- what TOML gives ---


def _table(data: Table, key: str) -> Table:
    found = data.get(key, {})
    if not isinstance(found, dict):
        raise InputError(f"{key} = {short(found)}: allowed: a table, begun with [{key}]")
    return found


def _whole(data: Table, key: str, least: int, default: int | None = None, where: str = "") -> int:
    found = data.get(key, default)
    if not isinstance(found, int) or isinstance(found, bool) or found < least:
        raise InputError(f"{where}{key} = {_said(found)}: allowed: a whole number from {least} on")
    return found


def _is_number(item: Any) -> bool:
    return isinstance(item, (int, Decimal)) and not isinstance(item, bool) and math.isfinite(item)


def _said(item: Any) -> str:
    return "missing" if item is None else str(item) if isinstance(item, Decimal) else short(item)


def _only(data: Table, known: set[str], where: str) -> None:
    for key in data:
        if key not in known:
            raise InputError(f"{where}{key}: unknown key; allowed: {', '.join(sorted(known))}")


# --- fields by their dotted keys ---


def replaced(table: Table, inputs: Mapping[str, Any]) -> Table:
    """A copy of a table with some fields replaced or added.

    inputs: values by their keys, joined by dots; of a list by its number from 0, such as
    "machine.parts.shield.0.mass_kg".

    Raises InputError if a key leads into something that is no table.
    """
    whole = copy.deepcopy(table)
    for name, item in inputs.items():
        *above, last = keys_of(name)
        inner: Any = whole
        for n, key in enumerate(above):
            here = _at(inner, key, name)
            inner = inner.setdefault(key, {}) if isinstance(inner, dict) else inner[here]
            if not isinstance(inner, (dict, list)):
                said = ".".join(above[: n + 1])
                raise InputError(
                    f"vary.{name!r}: {said} = {short(inner)} is no table; allowed: a field of a table"
                )
        inner[_at(inner, last, name)] = item
    return whole


def _at(inner: Any, key: str, name: str) -> Any:
    """How a table or list is asked for a key."""
    if isinstance(inner, dict):
        return key
    if not (key.isdecimal() and int(key) < len(inner)):
        raise InputError(f"vary.{name!r}: {key!r} of a list; allowed: its items, from 0 to {len(inner) - 1}")
    return int(key)


def keys_of(name: str) -> list[str]:
    """The keys that a dotted one is made of, by TOML's own rules. Raises InputError if it is none."""
    try:
        inner: Any = parsed(f"{name} = 0", "vary")
    except InputError:
        raise InputError(f"vary: {short(name)}: allowed: keys of a scenario file, joined by dots") from None
    keys = []
    while isinstance(inner, dict):
        ((key, inner),) = inner.items()
        keys.append(key)
    return keys


# --- scenarios ---


@dataclass(frozen=True)
class FromTables:
    """Scenarios from the table of a scenario file, with fields of it replaced, and of its machine's file.

    table: of the scenario file. where: what errors call it. folder: from which paths in it go on. file,
    machine: the machine's file and its table, if fields of that vary; keys: of these fields, by how the sweep
    calls them. modules: of classes of one's own, which are imported where the sweep is read; workers do so too.
    """

    table: Table
    where: str
    folder: Path
    file: Path = Path()
    machine: Table = field(default_factory=dict)
    keys: Mapping[str, str] = field(default_factory=dict)
    modules: Iterable[str] = ()

    def __call__(self, inputs: Inputs) -> Scenario:
        """The scenario of a point; raises InputError."""
        for module in self.modules:
            import_module(module)
        if not self.keys:
            return scenario_of(replaced(self.table, inputs), self.where, self.folder)
        changed = replaced(self.machine, {self.keys[name]: inputs[name] for name in self.keys})
        rest = {name: item for name, item in inputs.items() if name not in self.keys}
        with tempfile.TemporaryDirectory(prefix="support-exudyn-") as folder:
            file = Path(folder) / self.file.name  # machines are read from files
            file.write_text(toml_text(changed), encoding="utf-8")
            try:
                varied = replaced(self.table, {**rest, MACHINE: str(file)})
                return scenario_of(varied, self.where, self.folder)
            except InputError as error:
                raise InputError(str(error).replace(str(file), str(self.file))) from None


def maker(table: Table, where: str, folder: Path, names: tuple[str, ...]) -> FromTables:
    """What makes a scenario of a point.

    names: dotted keys of what is varied; those that begin with "machine." are of the machine's file, unless the
    machine is a table in the scenario file itself. For the others see `FromTables`.

    Raises InputError if a key cannot be one, or if fields of a machine are varied that is not known; OSError if
    its file cannot be read.
    """
    of_machine = [name for name in names if keys_of(name)[0] == MACHINE and len(keys_of(name)) > 1]
    if of_machine and MACHINE in names:
        raise InputError(f"vary.{MACHINE!r} and vary.{of_machine[0]!r}: allowed: one of them")
    given = table.get(MACHINE)
    if not of_machine or isinstance(given, dict):
        return FromTables(table, where, folder)
    if not isinstance(given, str):
        raise InputError(
            f"{where}: machine = {short(given)}: allowed where fields of it vary: a machine, by its file"
        )
    for name in of_machine:
        if keys_of(name)[:2] == [MACHINE, STRENGTH]:
            raise of_strength(name)
    file = folder / given
    if not given.endswith(".toml"):
        shipped(given)  # refuses what there is none of
        file = Path(machines.__path__[0]) / f"{given}.toml"
    keys = {name: name.partition(".")[2] for name in of_machine}
    return FromTables(table, where, folder, file, load_toml(file, named=True), keys)
