"""The formulations, one value each. A new one is a folder with `check` and `run`, and a value here.

`check(scenario)` raises InputError, with what to do instead, if the formulation does not cover the scenario.
`run(scenario, progress)` gives its Outcome; it raises SimulationError if the run cannot be finished.
"""

from dataclasses import dataclass
from importlib import import_module
from typing import Literal, Protocol, cast

from support_exudyn.formulations.interruption import put_off
from support_exudyn.mechanics.observed_run import Outcome
from support_exudyn.scenario.scenario import EARLIER_NAMES, Scenario
from support_exudyn.scene.contract import Progress
from user_forces.values.value import InputError

FormulationName = Literal["exudyn", "compiled"]


class Program(Protocol):
    """What the module of a formulation offers."""

    def check(self, scenario: Scenario) -> None:
        """Raise InputError if the scenario is not covered."""

    def run(self, scenario: Scenario, progress: Progress) -> Outcome:
        """Run the scenario."""


@dataclass(frozen=True)
class Formulation:
    """A formulation of the equations of motion.

    Arguments:
        name: by which scenarios ask for it.
        module: that has its `check` and `run`; it is imported at the first use.
        cost: rank among those that cover a scene, the cheapest first.
        safety: factor on the errors that are estimated of its runs, see `simulation.estimate`.
    """

    name: FormulationName
    module: str
    cost: int
    safety: float

    @property
    def program(self) -> Program:
        """The module of the formulation."""
        with put_off():
            return cast(Program, import_module(self.module))

    def check(self, scenario: Scenario) -> None:
        """Raise InputError if the scenario is not covered."""
        self.program.check(scenario)

    def covers(self, scenario: Scenario) -> bool:
        """Whether the formulation covers a scenario, whatever formulation that asks for."""
        try:
            self.check(scenario)
        except InputError:
            return False
        return True

    def run(self, scenario: Scenario, progress: Progress) -> Outcome:
        """Run the scenario; raises SimulationError if the run cannot be finished."""
        return self.program.run(scenario, progress)


HERE = __name__.rpartition(".")[0]
FORMULATIONS = {
    one.name: one
    for one in (
        Formulation("exudyn", f"{HERE}.exudyn.run", cost=2, safety=3.0),
        Formulation("compiled", f"{HERE}.compiled", cost=1, safety=2.3),
    )
}
CHEAPEST_FIRST = sorted(FORMULATIONS.values(), key=lambda one: one.cost)


def formulation(name: str) -> Formulation:
    """The formulation of this name, also an earlier one; "auto" is Exudyn, which runs nearly every scene."""
    known = "exudyn" if name == "auto" else EARLIER_NAMES.get(name, name)
    return FORMULATIONS[cast(FormulationName, known)]
