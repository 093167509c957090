"""Whether the records of a run fit into memory."""

from support_exudyn.files.free_memory import available
from support_exudyn.mechanics.channels import chosen
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

NUMBER = 2 * 8  # bytes of a number at a record, and of the states that it follows from; 2.9 * 8 were measured
GIGA = 1e9


def check_room(scenario: Scenario) -> None:
    """Raise InputError if the records of a run do not fit into memory, with what does.

    What is asked for is the least that it takes.
    """
    records = scenario.duration / scenario.recorded_every + 1.0
    count = len(chosen(scenario.channel_definitions, scenario.channels))
    needed, there = records * count * NUMBER, available()
    if needed > there:
        period = scenario.recorded_every * needed / there
        raise InputError(
            f"duration = {scenario.duration:g} s, record_period = {scenario.recorded_every:g} s: {records:.3g} "
            f"records of {count} channels take {needed / GIGA:.3g} GB and more, {there / GIGA:.3g} GB are "
            f"free; allowed: a shorter duration, fewer channels, or records at least {_up(period):g} s apart"
        )


def _up(number: float) -> float:
    """In two digits, not below it."""
    return float(f"{1.05 * number:.2g}")
