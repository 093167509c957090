"""Scenes that have been tried: what they say and what they cost; kept as a file that a study writes."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any

from support_exudyn.files.whole_file import whole_file
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError, Value, short

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

FORMAT = "support_exudyn scene detail 2"
FIELDS = ("pins", "actuators", "parts", "start", "dimensions")  # of a scenario: what an element of the model is


@dataclass(frozen=True)
class Tried:
    """A scene that has been run.

    name. family: scenes of one family are of the same machine, drive and duration, so that they can be
    compared; empty if it is not to be recommended. fields: of the scenario, by name. numbers: by name, with
    errors.
    seconds: processor time of its run. steps: of that run.
    """

    name: str
    family: str
    fields: Mapping[str, Any]
    numbers: Mapping[str, Estimate]
    seconds: float
    steps: int

    @property
    def elements(self) -> int:
        """How many pins, actuators and parts are other than plain, and whether start and dimensions are."""
        entries = sum(len(entry) for entry in self.fields.values() if isinstance(entry, Mapping))
        settled = self.fields.get("start", "concentric") != "concentric"
        return entries + int(settled) + int(self.fields.get("dimensions", 2) != 2)


@dataclass(frozen=True)
class EvidenceTable:
    """All scenes that have been tried.

    scenes: in any order. fullest: of each family the name of the scene with the most elements. said: of each
    family, what machine and drive its numbers are of.
    """

    scenes: tuple[Tried, ...]
    fullest: Mapping[str, str]
    said: Mapping[str, str]

    def family(self, name: str) -> tuple[Tried, ...]:
        """Scenes of a family. Raises InputError if there are none."""
        found = tuple(scene for scene in self.scenes if scene.family == name)
        if not found:
            known = sorted({scene.family for scene in self.scenes if scene.family})
            raise InputError(f"family = {name!r}: allowed: {', '.join(known) or 'none, the table is empty'}")
        return found

    def fullest_of(self, name: str) -> Tried:
        """The scene of a family that the others are measured by."""
        return next(scene for scene in self.family(name) if scene.name == self.fullest[name])

    def save(self, path: Path) -> None:
        """Write it, whole or not at all."""
        data = {
            "format": FORMAT,
            "fullest": dict(self.fullest),
            "said": dict(self.said),
            "scenes": [_plain(scene) for scene in self.scenes],
        }
        with whole_file(path) as temporary:
            temporary.write_text(json.dumps(data, indent=1, allow_nan=False) + "\n", encoding="utf-8")

    @staticmethod
    def load(path: Traversable) -> EvidenceTable:
        """Read what `save` wrote. Raises InputError if another version of the program wrote it."""
        data = json.loads(path.read_text(encoding="utf-8"))
        if data["format"] != FORMAT:
            raise InputError(f"{path}: format is {short(data['format'])}; allowed: {FORMAT!r}")
        return EvidenceTable(tuple(map(_tried, data["scenes"])), data["fullest"], data["said"])


def fields_of(scenario: Scenario) -> dict[str, Any]:
    """What an element of the model is, of a scenario."""
    return {name: getattr(scenario, name) for name in FIELDS}


@cache
def committed() -> EvidenceTable:
    """The table that comes with the program."""
    return EvidenceTable.load(resources.files("support_exudyn.simulation.evidence") / "scene_detail.json")


def _plain(scene: Tried) -> dict[str, Any]:
    fields = {
        name: {key: item.to_data() for key, item in entry.items()} if isinstance(entry, Mapping) else entry
        for name, entry in scene.fields.items()
    }
    numbers = {name: [number.value, number.error, number.unit] for name, number in scene.numbers.items()}
    return {
        "name": scene.name,
        "family": scene.family,
        "seconds": scene.seconds,
        "steps": scene.steps,
        "fields": fields,
        "numbers": numbers,
    }


def _tried(data: Mapping[str, Any]) -> Tried:
    fields = {
        name: {key: Value.from_data(item) for key, item in entry.items()} if isinstance(entry, dict) else entry
        for name, entry in data["fields"].items()
    }
    numbers = {name: Estimate(*written) for name, written in data["numbers"].items()}
    return Tried(data["name"], data["family"], fields, numbers, data["seconds"], data["steps"])
