"""What a machine's data file holds: the machine, and what a scenario may ask for besides."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from support_exudyn.columns import TwoBodyColumn
from support_exudyn.machine import Machine


@dataclass(frozen=True)
class MachineData:
    """A machine as its file describes it.

    machine: bodies, pivots, masses. name: what it is called. bore_radii: of pins [m], by name, for scenarios
    that give a pin a clearance. columns: masses of columns, by name, for scenarios that model them as two
    bodies. stroke: by how much its columns extend from the start posture on in use [m], None if it is not said.
    sources: where the data come from, by what they are of.
    """

    machine: Machine
    name: str = ""
    bore_radii: Mapping[str, float] = field(default_factory=dict)
    columns: Mapping[str, TwoBodyColumn] = field(default_factory=dict)
    stroke: float | None = None
    sources: Mapping[str, str] = field(default_factory=dict)


def read_machine(name: str, folder: Path | None = None) -> MachineData:
    """A machine from its data file.

    name: a path that ends in .toml, from `folder` on (the working directory); or the name of a machine that
    comes with the package, such as "reference".

    Raises InputError that names file, key, value and what is allowed; OSError if there is no such file.
    """
    from support_exudyn.supports import load_support, reference_support, two_body_columns

    if name == "reference":
        return MachineData(reference_support(), name, columns=two_body_columns())
    path = (folder or Path()) / name
    return MachineData(load_support(path), name, columns=two_body_columns(path=path))
