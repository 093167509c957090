"""`compare FIRST SECOND [CHANNEL...]`: by how much a second run differs from a first."""

import argparse
import math
from collections.abc import Mapping

from rich.console import Console

from support_exudyn.commands.command_line import add_json, add_times, answer, folder, say
from support_exudyn.commands.tables import printed, show_table
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.comparing.own_runs import Difference, compared, same_to_the_bit
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.figures.units import readable_change
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

WHOLE = (0.0, math.inf)  # run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Both files, and which channels."""
    add = parser.add_argument
    for name in ("first", "second"):
        add(name, type=folder, metavar=name.upper(), help="file of a run, as Result.save writes it")
    add(
        "channels",
        nargs="*",
        default=[],
        metavar="CHANNEL",
        help="only these: names or patterns, such as 'tip.*'; by default forces and traced points",
    )
    add_json(parser)
    add_times(parser, *WHOLE)


def run(given: argparse.Namespace) -> None:
    """Print the table, or the object."""
    first, second = Result.load(given.first), Result.load(given.second)
    names = matching(first.channels, given.channels)
    if not names:
        names = [name for name in summary.telling(first) if name in second.channels]
        names = [name for name in names if not name.startswith("energy.")]
    if not names:
        raise InputError(
            f"{given.first}, {given.second}: have no channel in common; allowed: runs of like machines"
        )
    found = compared(first, second, names, given.after, given.until)
    if given.json:
        answer({name: _object(one) for name, one in found.items()})
        return
    ends = given.after, given.until
    piece = f", {selection.said(first, *ends)}"
    printed(lambda console: _table(console, found, f"{given.second.name} less {given.first.name}{piece}"))
    if same := same_to_the_bit(first, second):
        say(f"the same to the bit: all records of {same} channels")


def _object(one: Difference) -> dict[str, object]:
    numbers = {
        name: {"value": number.value, "error": number.error}
        for name, number in one._asdict().items()
        if isinstance(number, Estimate)
    }
    return {"unit": one.mean.unit, **numbers, "time_s": one.time}


def _table(console: Console, found: Mapping[str, Difference], title: str) -> None:
    known = all(math.isfinite(one.mean.error) for one in found.values())
    header = ("channel", "unit", ">first, mean", ">second, mean", ">difference, mean", ">largest", ">at [s]")
    errors = (
        "± numerical errors of both runs"
        if known
        else "numerical errors not known: an accuracy was not asked of both"
    )
    show_table(console, f"{title} ({errors})", header, [_row(name, one) for name, one in found.items()])


def _row(name: str, one: Difference) -> tuple[str, ...]:
    means = max(abs(one.first.value), abs(one.second.value))
    unit = readable_change(one.mean.unit, means, abs(one.largest.value))
    numbers = (_said(number, unit.scale) for number in (one.first, one.second, one.mean, one.largest))
    return name, unit.name, *numbers, f"{one.time:.6g}"


def _said(number: Estimate, scale: float) -> str:
    """A number in a unit, with its error if that is known."""
    value, error = scale * number.value, scale * number.error
    if math.isnan(error):
        return f"{value:.{summary.DIGITS}g}"
    if not math.isfinite(error) or error <= 0.0:
        return f"{value:.{summary.DIGITS}g} ± {'not known' if error else '0'}"
    digits = min(max(0, 1 - math.floor(math.log10(error))), 9)
    return f"{value:.{digits}f} ± {error:.1g}"
