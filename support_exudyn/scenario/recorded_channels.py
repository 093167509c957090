"""From a trajectory to named channels with units: those that the scenario asks for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from operator import or_

from support_exudyn.mechanics.channels import ALL_CHANNELS, EVERYTHING, Part, Recipe, Seen, chosen
from support_exudyn.mechanics.space.determined import UNDETERMINED
from support_exudyn.mechanics.trajectory import Observed, Series, Trajectory
from support_exudyn.scenario.scenario import Scenario


@dataclass(frozen=True)
class Channel:
    """A quantity over time: values (n,), unit, and what it is."""

    values: Series
    unit: str
    meaning: str

    @property
    def is_determined(self) -> bool:
        """Whether it is the only one that fits the motion; not so of shares of what is held twice in space."""
        return not self.meaning.endswith(UNDETERMINED)


def channels(scenario: Scenario, run: Trajectory | Observed) -> dict[str, Channel]:
    """The channels that a scenario asks for, by name; all if its run is audited, which looks at all of them."""
    seen = Seen(scenario.linkage, scenario.gravity, run) if isinstance(run, Trajectory) else run
    recipes = scenario.recipes if scenario.solver.audit else _asked(scenario)
    return {name: Channel(recipe.values(seen), recipe.unit, recipe.meaning) for name, recipe in recipes.items()}


def asked(scenario: Scenario, found: Mapping[str, Channel]) -> dict[str, Channel]:
    """Those of the channels found that a scenario asks for."""
    return {name: found[name] for name in _asked(scenario)}


def needs(scenario: Scenario) -> Part:
    """What of a run its channels are computed from: everything if it is audited, whatever is asked for."""
    if scenario.solver.audit or scenario.channels == ALL_CHANNELS:
        return EVERYTHING
    return reduce(or_, (recipe.needs for recipe in _asked(scenario).values()), Part.NOTHING)


def _asked(scenario: Scenario) -> dict[str, Recipe]:
    known = scenario.recipes
    return {name: known[name] for name in chosen(known, scenario.channels)}
