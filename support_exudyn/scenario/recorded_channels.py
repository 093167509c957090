"""From a trajectory to named channels with units: those that the scenario asks for."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce
from operator import or_

from support_exudyn.mechanics.channels import (
    ALL_CHANNELS,
    EVERYTHING,
    ChannelDefinition,
    DataNeeds,
    chosen,
)
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.reactions import UNDETERMINED
from support_exudyn.mechanics.trajectory import Series
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


def channels(scenario: Scenario, run: Trajectory) -> dict[str, Channel]:
    """The channels that a scenario asks for, by name; all if the result checks look at all of them."""
    channel_definitions = (
        scenario.channel_definitions if scenario.solver.result_checks else asked_definitions(scenario)
    )
    return {
        name: Channel(definition.values(run), definition.unit, definition.meaning)
        for name, definition in channel_definitions.items()
    }


def asked(scenario: Scenario, found: Mapping[str, Channel]) -> dict[str, Channel]:
    """Those of the channels found that a scenario asks for."""
    return {name: found[name] for name in asked_definitions(scenario)}


def needs(scenario: Scenario) -> DataNeeds:
    """What of a run its channels are computed from: everything if results are checked."""
    if scenario.solver.result_checks or scenario.channels == ALL_CHANNELS:
        return EVERYTHING
    return reduce(
        or_, (definition.needs for definition in asked_definitions(scenario).values()), DataNeeds.NOTHING
    )


def asked_definitions(scenario: Scenario) -> dict[str, ChannelDefinition]:
    """The channels that a scenario asks for, by name."""
    known = scenario.channel_definitions
    return {name: known[name] for name in chosen(known, scenario.channels)}
