"""Scenarios from the table of a scenario file, with fields of it and of its machine's file replaced."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from support_exudyn.files import machines
from support_exudyn.files.machines.read import shipped
from support_exudyn.files.scenarios.scenario_file import scenario_of
from support_exudyn.files.toml.toml_reading import load_toml
from support_exudyn.files.toml.toml_text import toml_text
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.sweeps.fields import Table, keys_of, replaced
from support_exudyn.sweeps.plan import Inputs
from user_forces.values.value import InputError, short

MACHINE = "machine"


def maker(table: Table, where: str, folder: Path, names: tuple[str, ...]) -> Callable[[Inputs], Scenario]:
    """What makes a scenario of a point.

    Arguments:
        table: of the scenario file. where: what errors call it. folder: from which paths in it go on.
        names: dotted keys of what is varied; those that begin with "machine." are of the machine's file.

    Raises InputError if a key cannot be one, or if fields of a machine are varied that is not known; OSError if
    its file cannot be read.
    """
    of_machine = tuple(name for name in names if keys_of(name)[0] == MACHINE and len(keys_of(name)) > 1)
    given = table.get(MACHINE)
    plain = FromTable(table, where, folder)
    if not of_machine or isinstance(given, dict):  # one that stands in the scenario file is a table of it
        return plain
    if not isinstance(given, str):
        raise InputError(
            f"{where}: machine = {short(given)}: allowed where fields of it vary: a machine, by its file"
        )
    file = machine_file(given, folder)
    data = load_toml(file, named=True)
    return WithMachine(plain, data, file, {name: name.partition(".")[2] for name in of_machine})


def machine_file(name: str, folder: Path) -> Path:
    """The data file of a machine: a path that ends in .toml, or the name of one that comes with the package."""
    if name.endswith(".toml"):
        return folder / name
    shipped(name)  # refuses what there is none of
    return Path(machines.__path__[0]) / f"{name}.toml"


@dataclass(frozen=True)
class FromTable:
    """Makes scenarios from a table of a scenario file with some of its fields replaced."""

    table: Table
    where: str
    folder: Path

    def __call__(self, inputs: Inputs) -> Scenario:
        """The scenario of a point; raises InputError."""
        return scenario_of(replaced(self.table, inputs), self.where, self.folder)


@dataclass(frozen=True)
class WithMachine:
    """The same with fields of the machine's file replaced, too.

    machine: table of that file, `file`. keys: those of what is varied there, by how the sweep calls them.
    """

    plain: FromTable
    machine: Table
    file: Path
    keys: Mapping[str, str]

    def __call__(self, inputs: Inputs) -> Scenario:
        """The scenario of a point; raises InputError."""
        changed = replaced(self.machine, {self.keys[name]: inputs[name] for name in self.keys})
        rest = {name: item for name, item in inputs.items() if name not in self.keys}
        with tempfile.TemporaryDirectory(prefix="support-exudyn-") as folder:
            file = Path(folder) / self.file.name  # machines are read from files
            file.write_text(toml_text(changed), encoding="utf-8")
            try:
                return self.plain({**rest, MACHINE: str(file)})
            except InputError as error:
                raise InputError(str(error).replace(str(file), str(self.file))) from None
