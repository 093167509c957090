"""The numbers of a run that a sweep notes."""

import math
import re
from collections.abc import Callable, Iterable, Mapping
from difflib import get_close_matches
from fnmatch import fnmatchcase
from functools import lru_cache

from support_exudyn.mechanics.channels import chosen
from support_exudyn.mechanics.time_statistics import TimeWindow
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.estimate import errors
from support_exudyn.simulation.impulses import ENDLESS, impulses_of
from support_exudyn.simulation.reported_numbers import (
    DOUBTS,
    LARGEST,
    ReportedNumber,
    measures,
    other_times,
    over,
    time_of,
)
from support_exudyn.simulation.reported_numbers import STATISTICS as USUAL
from support_exudyn.simulation.result import Result
from support_exudyn.sweeps.plan import Record
from support_exudyn.sweeps.store import StoredNumber
from user_forces.values.value import InputError, short

STATISTICS: Mapping[str, Callable[[TimeWindow], float]] = {
    **USUAL,
    "first": lambda window: window.first,
    "last": lambda window: window.last,
}
TIMES: Mapping[str, Callable[[TimeWindow], tuple[float, float]]] = {  # of extremes
    "largest_time": LARGEST,
    "max_time": lambda window: window.greatest,
    "min_time": lambda window: window.least,
}
WORDS = (*STATISTICS, *TIMES)
OF_SIGNED = ("max", "max_time")  # of a magnitude the greatest is the largest
OF_IMPACTS = re.compile(r"(?P<stem>.+)\.(largest_force|largest_force_time|onset_[1-9]\d*\.(time|speed))")


def numbers(result: Result, record: Record) -> dict[str, StoredNumber]:
    """What is to be noted of a run, as far as it has it, with errors if the run tells them.

    Raises InputError if the run does not last between the times.
    """
    usual = measures(result, record.after, record.until, sized=result.coarser is not None)
    found: dict[str, ReportedNumber] = {}
    if not record.numbers:
        found.update(usual)
    for pattern in record.numbers:
        found |= _matching(pattern, usual, result, record)
    known: dict[str, float] = {}
    if result.coarser is not None:
        known = errors(found, result, result.fall, usual)
    return {
        name: StoredNumber(kind.measure(result), _finite(known.get(name)), kind.unit)
        for name, kind in found.items()
    }


def channels_of(numbers: tuple[str, ...], scenario: Scenario) -> tuple[str, ...]:
    """Those channels of a scenario that numbers may be taken of, named or as patterns; at least the time."""
    return _channels_of(numbers, tuple(chosen(scenario.channel_definitions, scenario.channels)))


@lru_cache(maxsize=8)
def _channels_of(numbers: tuple[str, ...], known: tuple[str, ...]) -> tuple[str, ...]:
    words = (*WORDS, *(f"impulse_{n}" for n in range(1, 10)))
    found = [
        name
        for name in known
        for number in numbers
        if number.rpartition(".")[0] == name or any(fnmatchcase(f"{name}.{word}", number) for word in words)
    ]
    return (*dict.fromkeys(found), "time")


def is_pattern(name: str) -> bool:
    """Whether a name stands for all that it matches."""
    return any(letter in name for letter in "*?[")


def check_numbers(scenario: Scenario, names: Iterable[str]) -> None:
    """Raise InputError if a number that is named, not a pattern, is none that its runs could have."""
    for name in names:
        channel, _, statistic = name.rpartition(".")
        if is_pattern(name) or _is_of_impacts(name, scenario):
            continue
        if _is_magnitude(channel) and statistic in OF_SIGNED:
            meant = f"{channel}.{statistic.replace('max', 'largest')}"
            raise InputError(
                f"numbers: {short(name)}: a magnitude has no sign, and its greatest value is called largest; "
                f"did you mean {short(meant)}?"
            )
        if statistic not in WORDS:
            words = get_close_matches(statistic, WORDS, 1)
            guess = f"did you mean {short(f'{channel}.{words[0]}')}? " if words else ""
            raise InputError(
                f"numbers: {short(name)}: no such number; {guess}allowed: a channel and one of "
                f"{', '.join(WORDS)}, such as 'pin.rear_base.force.mean', patterns of such, "
                "pin.NAME.largest_force, pin.NAME.largest_force_time, pin.NAME.onset_1.time, and so of a "
                "falling block: NAME.largest_force"
            )
        if channel not in scenario.channel_definitions:
            known = [*scenario.channel_definitions]
            near = ", ".join(get_close_matches(channel, known, 4, 0.5) or known[:6])
            raise InputError(
                f"numbers: {short(name)}: runs have no channel {short(channel)}; allowed: those of the "
                f"scenario, such as {near}; or a pattern, if only some of the runs have it"
            )


def _is_of_impacts(name: str, scenario: Scenario) -> bool:
    """Whether this may be of the impacts of a clearance pin, of a corner in a guide, or of a falling block."""
    found = OF_IMPACTS.fullmatch(name)
    if found is None:
        return False
    stem, stems = found["stem"], {place.stem for place in scenario.contact_places.values()}
    if scenario.dimensions == 3:  # also of either side, pin.front_base_left, and of their edges
        pins = {f"pin.{name}" for name in (*scenario.linkage.pins, *scenario.space.bearings)}
        return bool({stem, stem.rpartition(".")[0]} & pins) or stem in stems
    return stem in stems


def _matching(
    pattern: str, usual: Mapping[str, ReportedNumber], result: Result, record: Record
) -> dict[str, ReportedNumber]:
    if not is_pattern(pattern):
        channel, _, statistic = pattern.rpartition(".")
        if pattern in usual:
            return {pattern: usual[pattern]}
        if statistic in ENDLESS and impulses_of(result, channel, record.after, record.until):
            return {name: kind for name, kind in usual.items() if name.startswith(f"{channel}.impulse_")}
        if channel in result.channels and statistic in WORDS:
            return {pattern: _kind(result, channel, statistic, record)}
        return {}
    found = {name: kind for name, kind in usual.items() if fnmatchcase(name, pattern)}
    for channel in result.channels:
        for statistic in WORDS:
            name = f"{channel}.{statistic}"
            if _is_magnitude(channel) and statistic in OF_SIGNED:
                continue
            if statistic in ENDLESS and impulses_of(result, channel, record.after, record.until):
                continue  # it has no limit; its impulses are among the usual numbers
            if channel != "time" and name not in found and fnmatchcase(name, pattern):
                found[name] = _kind(result, channel, statistic, record)
    return found


def _is_magnitude(channel: str) -> bool:
    return channel.startswith("pin.") and channel.endswith(".force")


def _kind(result: Result, channel: str, statistic: str, record: Record) -> ReportedNumber:
    between = record.after, record.until
    if statistic in TIMES:
        extreme = TIMES[statistic]
        when, doubt = time_of(channel, extreme, *between), other_times(channel, extreme, *between)
        return ReportedNumber("s", when, missed=doubt, settles=False)
    measure = over(channel, STATISTICS[statistic], *between)
    missed = over(channel, DOUBTS.get(statistic, lambda window: 0.0), *between)
    return ReportedNumber(result.unit(channel), measure, missed=missed)


def _finite(error: float | None) -> float | None:
    return error if error is not None and math.isfinite(error) else None
