"""The formulations by name. A new one is a module with `check` and `run`, and a line here.

`check(scenario)` raises InputError, with what to do instead, if the formulation does not cover the scenario.
`run(scenario, progress)` gives its Outcome; it raises SimulationError if the run cannot be finished.
"""

from __future__ import annotations

from importlib import import_module
from typing import Protocol, cast

from support_exudyn.formulations.interruption import put_off
from support_exudyn.formulations.progress import Progress
from support_exudyn.mechanics.trajectory import Outcome
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

MODULES = {
    "auto": "support_exudyn.formulations.redundant.run",
    "redundant": "support_exudyn.formulations.redundant.run",
    "tree": "support_exudyn.formulations.tree",
    "reduced": "support_exudyn.formulations.reduced",
}


class Formulation(Protocol):
    """What a module of a formulation offers."""

    def check(self, scenario: Scenario) -> None:
        """Raise InputError if the scenario is not covered."""

    def run(self, scenario: Scenario, progress: Progress) -> Outcome:
        """Run the scenario."""


def formulation(name: str) -> Formulation:
    """The formulation of this name; its module is imported at the first use."""
    with put_off():
        return cast(Formulation, import_module(MODULES[name]))


def covers(name: str, scenario: Scenario) -> bool:
    """Whether a formulation covers a scenario, whatever formulation that asks for."""
    try:
        formulation(name).check(scenario)
    except InputError:
        return False
    return True
