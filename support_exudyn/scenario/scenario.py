"""Everything that determines a run."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import replace
from functools import cached_property
from typing import Any

from pydantic import field_validator, model_validator

from support_exudyn.scenario.presentation import presenter
from support_exudyn.scenario.scenario_data import ACCURACIES, LARGEST_GOAL, SMALLEST_GOAL, ScenarioData
from support_exudyn.scenario.solver_settings import MOST_SECTIONS, REFINED_TOLERANCE, SMALLEST_TOLERANCE
from support_exudyn.scenario.timescales import default_period
from support_exudyn.scenario.validation import check
from user_forces.values.value import InputError, short, value

EARLIER_NAMES = {"redundant": "exudyn"}  # of formulations, still read
MOST_REFINED = 1e6  # by what factor a run can be refined


@value
class Scenario(ScenarioData):
    """One run: a machine, its pins, how it starts and is driven, and how finely it is computed.

    The arguments are those of `ScenarioData`; they are checked against the machine and each other when a
    scenario is made. Raises InputError that names the field, its value and what is allowed.
    """

    @field_validator("accuracy", mode="before")
    @classmethod
    def _is_an_accuracy(cls, asked: object) -> object:
        number = isinstance(asked, (int, float)) and SMALLEST_GOAL <= asked <= LARGEST_GOAL
        if asked is None or (isinstance(asked, str) and asked in ACCURACIES) or number:
            return asked
        raise ValueError(
            f"allowed: {', '.join(map(repr, ACCURACIES))}, None, or a relative error from {SMALLEST_GOAL} to "
            f"{LARGEST_GOAL}"
        )

    @classmethod
    def of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        """Data and files of earlier versions call the Exudyn formulation "redundant"."""
        named = given.get("formulation")
        known = isinstance(named, str) and named in EARLIER_NAMES
        return {**given, "formulation": EARLIER_NAMES[str(named)]} if known else given

    @model_validator(mode="after")
    def _fits_the_machine(self) -> Scenario:
        check(self)
        return self

    def _repr_html_(self) -> str:
        """What is run, for notebooks."""
        return presenter().page_of_scenario(self)

    @cached_property
    def recorded_every(self) -> float:
        """Time between records [s]: that which is given, or that which follows the machine."""
        return self.record_period or default_period(self)

    def recorded_as(self, channels: tuple[str, ...], period: float) -> Scenario:
        """The same run with other channels and another time between records [s].

        It is not checked again, and what has been computed of the machine is kept.
        """
        other = copy(self)
        for name in ("recorded_every", "plain"):
            other.__dict__.pop(name, None)
        other.__dict__.update(channels=channels, record_period=period)
        return other

    def refined(self, factor: float = 2) -> Scenario:
        """The run with all steps, also those of impacts, so many times shorter.

        In space, sections of clearance pins are so many times shorter, too.

        The difference between both runs is the numerical error that studies report. Where the formulation
        chooses its steps by a tolerance, that becomes factor^3 times smaller; where the scenario asks for an
        accuracy in place of settings, that becomes factor^2 times smaller.

        factor: > 0, up to a million. Raises InputError if it is not, or if a setting leaves its range.
        """
        number = isinstance(factor, (int, float)) and not isinstance(factor, bool)
        if not (number and 1.0 / MOST_REFINED <= factor <= MOST_REFINED):
            raise InputError(
                f"factor = {short(factor)}: allowed: > 0, from {1.0 / MOST_REFINED:g} to {MOST_REFINED:g}"
            )
        if self.goal is not None:
            return replace(self, accuracy=max(SMALLEST_GOAL, self.goal / factor**2))
        if self.chooses_steps:
            tolerance = max(SMALLEST_TOLERANCE, self.solver.tolerance / factor**REFINED_TOLERANCE)
            return replace(self, solver=replace(self.solver, tolerance=tolerance))
        finer = replace(self.solver, impact_steps=round(factor * self.solver.impact_steps))
        if self.dimensions == 3:
            sections = round(factor * (finer.sections - 1)) + 1
            finer = replace(finer, sections=min(max(sections, 2), MOST_SECTIONS))
        # steps never reach over a record
        step = min(self.step, self.recorded_every) / factor
        return replace(self, step=step, record_period=self.recorded_every, solver=finer)
