"""What a row of the benchmark's table is: a way of ours, what it is set against, and what was asked for."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, cast

from support_exudyn import Scenario
from support_exudyn.formulations.registry import FORMULATIONS, FormulationName

AUTO = "auto"  # the formulation that the program chooses


class LeftOutError(RuntimeError):
    """What cannot be measured here, such as a program that is not installed; says why."""


@dataclass(frozen=True)
class Setting:
    """How finely something is computed.

    words: for readers. scenario, solver: fields of ours. number: step, tolerance or accuracy of others.
    """

    words: str
    scenario: Mapping[str, object] = field(default_factory=dict)
    solver: Mapping[str, object] = field(default_factory=dict)
    number: float = math.nan

    def applied(self, scenario: Scenario, formulation: str) -> Scenario:
        """A scenario of ours with this setting."""
        solver = replace(scenario.solver, **cast(Any, self.solver))
        name = cast(FormulationName, formulation)
        return replace(scenario, formulation=name, solver=solver, **cast(Any, self.scenario))


def tolerance(value: float) -> Setting:
    """Error control; how wrong the outcome is, the benchmark looks itself."""
    return Setting(f"tolerance {value:.0e}", solver={"tolerance": value, "result_checks": False})


def steps(step: float, impact_steps: int, growth: float) -> Setting:
    """Steps [s], and how many an impact has."""
    words = f"step {step:g} s, {impact_steps} an impact" + (f", growth {growth:g}" if growth != 1.0 else "")
    solver = {"impact_steps": impact_steps, "growth": growth, "backend": "symbolic", "result_checks": False}
    return Setting(words, {"step": step}, solver)


def accuracy(name: str) -> Setting:
    """An accuracy that is asked for; all runs that it takes count."""
    return Setting(name, {"accuracy": name})


AS_IT_IS = Setting("")


@dataclass(frozen=True)
class OurWay:
    """A scene, a formulation of ours and its settings, from coarse to fine.

    Of several settings the first that meets the goal of the scene is taken. scene: one of `row_scenes.SCENES`.
    """

    scene: str
    formulation: str
    settings: tuple[Setting, ...] = (AS_IT_IS,)

    @property
    def is_there(self) -> bool:
        """Whether this version has the formulation."""
        return self.formulation in (AUTO, *FORMULATIONS)


@dataclass(frozen=True)
class Row:
    """A row.

    ours: a way, or what `others.OTHERS` has by this name. against: the same, or nothing. asked: the ratio that
    was asked for, as "3" or "1/10", or a time, as "0.06 s". most: time that all its turns may take [s].
    """

    what: str
    ours: OurWay | str
    against: OurWay | str = ""
    asked: str = ""
    most: float = 8.0


class TimedTurn(NamedTuple):
    """What was measured of a side of a row: ours or the other's, how it was set, and its time [s]."""

    is_ours: bool
    label: str
    seconds: float
