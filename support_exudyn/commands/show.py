"""`show RUN [CHANNEL|NUMBER...]`, `show STORE [NUMBER...]`: what a run or a sweep was, as tables."""

import argparse
import math
from typing import Any

from rich.console import Console

from support_exudyn.commands.command_line import add_json, add_times, answer, folder
from support_exudyn.commands.sweep_tables import is_store, show_sweep
from support_exudyn.commands.tables import (
    NARROWEST,
    facts,
    first_impacts,
    printed,
    show_fitting,
    show_impacts,
    show_numbers,
    show_table,
)
from support_exudyn.files.own_modules import with_known_laws
from support_exudyn.postprocessing import joint_tables
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.figures.units import said
from support_exudyn.scenario.pin_stability import PinOutlook, pin_outlooks
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

WHOLE = (0.0, math.inf)  # run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, and which channels."""
    add = parser.add_argument
    add(
        "run",
        type=folder,
        metavar="RUN|STORE",
        help="file of a run, as Result.save writes it; or the folder of a sweep",
    )
    add(
        "channels",
        nargs="*",
        default=[],
        metavar="CHANNEL|NUMBER",
        help="only these channels and numbers: names or patterns, such as 'pin.*.force', '*largest_force'",
    )
    add("--impacts", action="store_true", help="all impacts of a run's clearance pins, with their forces")
    add("--all", action="store_true", help="all channels, not only those looked at first")
    add_json(parser)
    add_times(parser, *WHOLE)


def run(given: argparse.Namespace) -> None:
    """Print the tables; as many of them as are read, if another program takes them."""
    if is_store(given.run):
        if given.impacts:
            raise InputError(f"{given.run}: --impacts: is a sweep; allowed: the file of a run")
        show_sweep(given)
        return
    result = Result.load(given.run)
    if given.impacts and not result.onsets:
        raise InputError(f"{given.run}: --impacts: has no clearance joint; allowed: a run that has some")
    if given.json:
        answer(_object(result, given))
        return
    printed(lambda console: _tables(console, result, given))


def _object(result: Result, given: argparse.Namespace) -> dict[str, Any]:
    """What scripts are told, in SI: every number with its error, and all channels unless some are asked for."""
    ends = given.after, given.until
    names = [name for name in result.channels if name != "time"]
    if given.channels:
        names, _ = _asked(result, given)
    return {
        "run": given.run,
        "scenario": result.scenario.to_data(),
        **facts(result, *ends),
        "provenance": dict(result.provenance),
        "impacts": {
            pin: [
                {
                    "time_s": o.time,
                    "speed_m_per_s": o.speed,
                    "parting_time_s": o.separation_time,
                    "force_at_records_N": summary.force_of_impact(result, pin, n),
                }
                for n, o in enumerate(onsets)
            ]
            for pin, onsets in result.onsets.items()
        },
        "oil_events": {
            name: [event._asdict() for event in events] for name, events in result.oil_events.items()
        },
        "pin_stability": joint_tables.stability_data(_outlooks(result)),
        "channels": {name: summary.extent(result, name, *ends) for name in names},
    }


def _outlooks(result: Result) -> list[PinOutlook]:
    """Whether the clearance pins of a run shake, by their postures alone."""
    return pin_outlooks(result.scenario, pins=tuple(with_known_laws(result.scenario.clearance_pins)))


def _asked(result: Result, given: argparse.Namespace) -> tuple[list[str], list[str]]:
    """The channels and the numbers that are asked for by names or patterns."""
    numbers = summary.numbers(result, given.after, given.until)
    found = matching([*result.channels, *numbers], given.channels, "channel or number")
    return [name for name in found if name in result.channels], [name for name in found if name in numbers]


def _tables(console: Console, result: Result, given: argparse.Namespace) -> None:
    ends = given.after, given.until
    steps = "every step" if result.statistics else f"records every {said(result.scenario.recorded_every, 's')}"
    piece = f" from {steps}, {selection.said(result, *ends)}"
    if given.impacts:
        show_impacts(console, f"impacts, {selection.said(result, *ends)}", result, None, *ends)
        if not given.channels:
            return
    if given.channels:
        names, numbers = _asked(result, given)
        if numbers:
            show_numbers(console, "numbers", "no accuracy was asked", result, *ends, only=numbers)
        _show_channels(console, summary.of_channels(result, names, *ends), f"channels{piece}")
        return
    show_table(console, "what was run", (), summary.what_was_run(result))
    show_table(console, "how", (), summary.how(result))
    show_numbers(console, "what came out", "no accuracy was asked", result, *ends)
    show_fitting(console, joint_tables.leg_table(result, *ends))
    pressed = joint_tables.hardest_pressed(result)
    show_fitting(console, joint_tables.pressure_table(joint_tables.LARGEST, pressed))
    for one in (pin for pin in pressed if pin.warning):
        console.print(f"warning: {one.warning}", markup=False, soft_wrap=True, end="\n\n")
    show_fitting(console, joint_tables.stability_table(_outlooks(result)))
    first_impacts(console, result)
    telling = [name for name in result.channels if name != "time"] if given.all else summary.telling(result)
    rest = len(result.channels) - 1 - len(telling)
    more = f" ({rest} more: --all)" if rest else ""
    _show_channels(console, summary.of_channels(result, telling, *ends), f"channels{piece}{more}")


def _show_channels(console: Console, rows: list[summary.Row], title: str) -> None:
    if not rows:  # nothing was recorded but the time
        return
    header: tuple[str, ...] = ("channel", "unit", ">min", ">mean", ">max", "meaning")
    taken = sum(max(len(row[n]) for row in rows) + 3 for n in range(len(header) - 1))
    if console.width - taken < NARROWEST:  # the numbers first
        header, rows = header[:-1], [row[:-1] for row in rows]
    show_table(console, title, header, rows)
