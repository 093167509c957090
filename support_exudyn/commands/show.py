"""`show RUN [CHANNEL|NUMBER...]`, `show STORE [NUMBER...]`: what a run or a sweep was, as tables."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from support_exudyn.commands.command_line import After, Json, Until, answer, say
from support_exudyn.commands.tables import WHOLE, facts, show_impacts, show_numbers, show_table
from support_exudyn.files.own_modules import with_known_laws
from support_exudyn.postprocessing import joint_tables
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.figures.units import said
from support_exudyn.scenario.pin_stability import PinOutlook, pin_outlooks
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

NO_ERRORS = "no accuracy was asked"
Ends = tuple[float, float]  # times [s]


def show(
    run: Path,
    /,
    *channels: str,
    impacts: bool = False,
    all: bool = False,  # noqa: A002, the option's name
    after: After = WHOLE[0],
    until: Until = WHOLE[1],
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
    if json:
        answer({"run": run} | _data(result, channels, ends))
        return
    if impacts:
        show_impacts(f"impacts, {selection.said(result, *ends)}", result, None, ends)
    if channels:
        names, numbers = _asked(result, channels, ends)
        if numbers:
            show_numbers("numbers", NO_ERRORS, result, ends, only=numbers)
        _show_channels(result, names, ends)
    elif not impacts:
        show_run(result, ends, all)


def show_run(result: Result, ends: Ends = WHOLE, every: bool = False) -> None:
    """Print the tables of a run between two times [s]; every: all channels, not only the telling ones."""
    show_table("what was run", (), summary.what_was_run(result))
    show_table("how", (), summary.how(result))
    show_numbers("what came out", NO_ERRORS, result, ends)
    show_table(*joint_tables.leg_table(result, *ends))
    pressed = joint_tables.hardest_pressed(result)
    show_table(*joint_tables.pressure_table(joint_tables.LARGEST, pressed))
    for one in (pin for pin in pressed if pin.warning):
        say(f"warning: {one.warning}\n")
    show_table(*joint_tables.stability_table(_outlooks(result)))
    more = any(len(onsets) > summary.IMPACTS for onsets in result.onsets.values())
    title = "first impacts" + (" (all: show RUN --impacts)" if more else "")
    show_impacts(title, result, summary.IMPACTS, WHOLE)
    telling = [name for name in result.channels if name != "time"] if every else summary.telling(result)
    _show_channels(result, telling, ends, len(result.channels) - 1 - len(telling))


def _show_channels(result: Result, names: Sequence[str], ends: Ends, rest: int = 0) -> None:
    """Print the table of some channels; rest: how many more there are."""
    steps = "every step" if result.statistics else f"records every {said(result.scenario.recorded_every, 's')}"
    more = f" ({rest} more: --all)" if rest else ""
    title = f"channels from {steps}, {selection.said(result, *ends)}{more}"
    show_table(
        title,
        ("channel", "unit", ">min", ">mean", ">max", "meaning"),
        summary.of_channels(result, names, *ends),
    )


def _data(result: Result, channels: Sequence[str], ends: Ends) -> dict[str, Any]:
    """What scripts read, in SI: every number with its error, and all channels unless some are asked for."""
    names = [name for name in result.channels if name != "time"]
    if channels:
        names, _ = _asked(result, channels, ends)
    return {
        "scenario": result.scenario.to_data(),
        **facts(result, ends),
        "provenance": dict(result.provenance),
        "impacts": {
            pin: [
                {
                    "time_s": onset.time,
                    "speed_m_per_s": onset.speed,
                    "parting_time_s": onset.separation_time,
                    "force_at_records_N": summary.force_of_impact(result, pin, n),
                }
                for n, onset in enumerate(onsets)
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


def _asked(result: Result, words: Sequence[str], ends: Ends) -> tuple[list[str], list[str]]:
    """The channels and the numbers that are asked for by names or patterns."""
    numbers = summary.numbers(result, *ends)
    found = matching([*result.channels, *numbers], words, "channel or number")
    return [name for name in found if name in result.channels], [name for name in found if name in numbers]
