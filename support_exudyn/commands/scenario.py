"""`scenario RUN`: the scenario of a run as TOML, from which `run` makes the same run again."""

import argparse
from dataclasses import replace

from support_exudyn.commands.command_line import add_out, add_run, say
from support_exudyn.files import save_scenario, scenario_text
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, and where the scenario goes."""
    add_run(parser)
    add_out(parser, "write it there, not to standard output", "FILE")


def run(given: argparse.Namespace) -> None:
    """Write it, or print it."""
    result = Result.load(given.run)
    scenario, errors = asked(result)
    if given.out is None:
        say(scenario_text(scenario, errors=errors).rstrip("\n"))
    else:
        say(str(save_scenario(scenario, given.out, errors=errors)))


def asked(result: Result) -> tuple[Scenario, bool]:
    """What makes a result again, with its errors: the scenario, and whether `errors` have to be asked for.

    A run to an accuracy is asked for by that again: it then finds the same settings.
    """
    if result.goal is not None:
        return replace(result.scenario, accuracy=result.goal), False
    first = result
    while first.coarser is not None:  # the one that was given, of which the others are finer
        first = first.coarser
    return first.scenario, result.coarser is not None
