"""A scenario from Python in the words of its files."""

import numbers
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from support_exudyn.files.scenarios.scenario_file import scenario_of
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.model.machine import Machine
from support_exudyn.scenario.scenario import Scenario


def simple_scenario(machine: str | Path | Machine | MachineData, **keys: Any) -> Scenario:
    """A scenario in few words: the keys of a scenario's file, which say their units.

        pins = {"rear_base": {"clearance_mm": 0.5, "friction": 0.1}}
        simple_scenario("zf18000", duration_s=5, drive={"mode": 2}, pins=pins)

    Radii of bores and the stroke come from the machine's file, as they do for a scenario's file.

    Arguments:
        machine: the name of one that comes with the package, the path of a machine data file, or the machine.
        keys: as in files; what is a table there is a dictionary, or the value itself, such as `CubicStep()`.
            Files that are named lie from the working directory on.

    Raises InputError with a line for each thing that is wrong: key, value and what is allowed.
    """
    return scenario_of({"machine": _written(machine), **_written(keys)}, "", Path())


def _written(item: Any) -> Any:
    """An item as a file would have it: tables, lists, texts and plain numbers; values stay."""
    if isinstance(item, Mapping):
        return {key: _written(one) for key, one in item.items()}
    if isinstance(item, (list, tuple)):
        return [_written(one) for one in item]
    if isinstance(item, bool) or not isinstance(item, (numbers.Real, Path)):
        return item.tolist() if hasattr(item, "tolist") else item
    if isinstance(item, Path):
        return str(item)
    return int(item) if isinstance(item, numbers.Integral) else float(item)
