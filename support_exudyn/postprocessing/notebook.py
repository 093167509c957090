"""What notebooks show of scenarios and results, see `scenario.presentation`."""

import math
from collections.abc import Sequence

from matplotlib.figure import Figure

from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.channels import over_time
from support_exudyn.postprocessing.html import html_table
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result

IMPACTS = ("pin", "impact", ">time", ">lasts", ">speed of approach", ">of separation", ">force at records")
FORCES = ("pin.*.force",)  # that are drawn if nothing is named


def figure(result: Result, channels: Sequence[str], after: float, until: float) -> Figure:
    """Channels of a result over time, those of one unit together; the forces of all pins if none are named.

    Raises InputError as `over_time` does.
    """
    with style.look():
        return over_time(result, channels or FORCES, after, until)


def page_of_result(result: Result) -> str:
    """What was run, what came out with its errors, first impacts, and how it was computed."""
    known = "± estimated numerical error" if result.coarser else "errors not known: no accuracy was asked"
    header: tuple[str, ...] = ("number", ">value", ">±", "unit")
    rows = [row for row in summary.came_out(result, 0.0, math.inf) if ".onset_" not in row[0]]
    if result.coarser is None:
        header, rows = (header[0], header[1], header[3]), [(row[0], row[1], row[3]) for row in rows]
    tables = [
        html_table(repr(result).strip("<>"), (), summary.what_was_run(result)),
        html_table(f"what came out ({known})", header, rows),
    ]
    if impacts := summary.impacts(result):
        tables.append(html_table("first impacts", IMPACTS, impacts))
    return "".join([*tables, html_table("how", (), summary.how(result))])


def page_of_scenario(scenario: Scenario) -> str:
    """What is run, and to which accuracy."""
    goal = "settings as they stand" if scenario.goal is None else f"{scenario.goal:g} asked for"
    rows = [*summary.what_is_run(scenario), ("formulation", scenario.formulation), ("accuracy", goal)]
    count = len(scenario.channel_definitions)
    rows.append(("channels", f"{', '.join(scenario.channels)} of {count}, see channels(scenario)"))
    return html_table("Scenario", (), rows)
