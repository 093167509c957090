"""What notebooks show of scenarios and results, see `scenario.presentation`."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.channels import over_time
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result


def figure(result: Result, channels: Sequence[str], after: float, until: float) -> Figure:
    """Channels of a result over time, those of one unit together; the forces of all pins if none are named.

    Raises InputError as `over_time` does.
    """
    with style.look():
        return over_time(result, channels or ("pin.*.force",), after, until)


def page_of_result(result: Result) -> str:
    """What was run, what came out with its errors, first impacts, and how it was computed."""
    came_out = summary.numbers_table(result)
    tables = [
        ResultTable(repr(result).strip("<>"), (), summary.what_is_run(result.scenario)),
        came_out._replace(rows=[row for row in came_out.rows if ".onset_" not in row[0]]),
        summary.impacts_table("first impacts", result),
        ResultTable("how", (), summary.how(result)),
    ]
    return "".join(table.html() for table in tables if table.rows)


def page_of_scenario(scenario: Scenario) -> str:
    """What is run, and to which accuracy."""
    goal = "settings as they stand" if scenario.goal is None else f"{scenario.goal:g} asked for"
    rows = [*summary.what_is_run(scenario), ("formulation", scenario.formulation), ("accuracy", goal)]
    count = len(scenario.channel_definitions)
    rows.append(("channels", f"{', '.join(scenario.channels)} of {count}, see channels(scenario)"))
    return ResultTable("Scenario", (), rows).html()
