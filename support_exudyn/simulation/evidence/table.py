"""Scenes that have been tried: what they say and what they cost; kept as a file that a study writes."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from support_exudyn.files.whole_file import contents, whole_file
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.estimate import Estimate
from user_forces.values.value import InputError, Value, short

LARGEST_FILE = 100_000_000  # bytes
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
    def load(path: Path) -> EvidenceTable:
        """Read it. Raises InputError if it is not such a table, OSError if it cannot be read."""
        return _table(contents(path, LARGEST_FILE), str(path))


def check_replaceable(path: Path) -> None:
    """Raise InputError if something else than such a table is at a path: it would be lost."""
    if not path.exists():
        return
    try:
        known = str(json.loads(contents(path, LARGEST_FILE))["format"])
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        known = ""
    if not known.startswith(FORMAT.rpartition(" ")[0]):
        raise InputError(f"{path}: is no table of tried scenes, and would be lost; allowed: another name")


def fields_of(scenario: Scenario) -> dict[str, Any]:
    """What an element of the model is, of a scenario."""
    return {name: getattr(scenario, name) for name in FIELDS}


@cache
def committed() -> EvidenceTable:
    """The table that comes with the program."""
    file = resources.files("support_exudyn.simulation.evidence") / "scene_detail.json"
    return _table(file.read_bytes(), file.name)


def _table(content: bytes, where: str) -> EvidenceTable:
    try:
        data = json.loads(content.decode("utf-8"))
        if data["format"] != FORMAT:
            raise KeyError(f"format is {short(data['format'])}, expected {FORMAT!r}")
        scenes = tuple(map(_tried, data["scenes"]))
        table = EvidenceTable(scenes, _texts(data["fullest"]), _texts(data["said"]))
        names = [(scene.family, scene.name) for scene in scenes]
        for family in {family for family, _ in names if family}:
            if (family, table.fullest[family]) not in names:
                raise KeyError(f"the fullest scene of {short(family)} is not there")
        return table
    except RecursionError:
        raise InputError(f"{where}: is nested too deep; allowed: a table of tried scenes") from None
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
        raise InputError(
            f"{where}: not a table of tried scenes, or damaged ({error}); allowed: what `save` wrote"
        ) from None


def _texts(data: Any) -> dict[str, str]:
    return {name: _text(item) for name, item in data.items()}


def _text(item: Any) -> str:
    if not isinstance(item, str):
        raise TypeError(f"{short(item)} is no text")
    return item


def _number(item: Any) -> float:
    if isinstance(item, bool) or not isinstance(item, (int, float)) or not math.isfinite(item):
        raise TypeError(f"{short(item)} is no number")
    return float(item)


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
    numbers = {
        name: Estimate(_number(size), _number(error), _text(unit))
        for name, (size, error, unit) in data["numbers"].items()
    }
    unknown = [name for name in fields if name not in FIELDS]
    if unknown:
        raise KeyError(f"{short(unknown[0])} is no element of a model")
    seconds, steps = _number(data["seconds"]), _number(data["steps"])
    if min(seconds, steps, *(number.error for number in numbers.values())) < 0.0:
        raise ValueError("seconds, steps and errors are not below 0")
    return Tried(_text(data["name"]), _text(data["family"]), fields, numbers, seconds, int(steps))
