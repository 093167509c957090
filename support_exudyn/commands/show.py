"""`show RUN [CHANNEL|NUMBER...]`, `show STORE [NUMBER...]`: what a run or a sweep was, as tables."""

from pathlib import Path

from support_exudyn.commands.command_line import After, Json, Until, answer, show_table
from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.shown_numbers import numbers
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError


def show(
    run: Path,
    /,
    *channels: str,
    impacts: bool = False,
    all: bool = False,  # noqa: A002, the option's name
    after: After = summary.WHOLE[0],
    until: Until = summary.WHOLE[1],
    json: Json = False,
) -> None:
    """Print the tables of a run or of a sweep.

    Args:
        run: File of a run, as Result.save writes it; or the folder of a sweep.
        channels: Only these channels and numbers: names or patterns, such as `pin.*.force`, `*largest_force`.
        impacts: Print all impacts of a run's clearance pins, with their forces.
        all: Print all channels, and all numbers of a sweep.
    """
    if run.is_dir() or run.suffix == ".parquet":
        from support_exudyn.commands.sweeps import show_sweep  # and pyarrow

        if impacts:
            raise InputError(f"{run}: --impacts: is a sweep; allowed: the file of a run")
        show_sweep(run, channels, all, json)
        return
    result, ends = Result.load(run), (after, until)
    if impacts and not result.onsets:
        raise InputError(f"{run}: --impacts: has no clearance joint; allowed: a run that has some")
    known = numbers(result, *ends) if channels else {}
    names = matching([*result.channels, *known], channels, "channel or number")
    asked = [name for name in names if name in result.channels]
    if json:
        shown = asked if channels else [name for name in result.channels if name != "time"]
        answer({"run": run} | summary.data(result, shown, ends))
        return
    if impacts:
        show_table(*summary.impacts_table("impacts", result, None, ends))
    if channels:
        if only := [name for name in names if name in known]:
            show_table(*summary.numbers_table(result, ends, only))
        show_table(*summary.channels_table(result, asked, ends))
    elif not impacts:
        for table in summary.run_tables(result, ends, all):
            show_table(*table)
