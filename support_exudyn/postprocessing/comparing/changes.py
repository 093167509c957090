"""Changes between two runs of the same scenario by more than both of their errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple

from support_exudyn.postprocessing.comparing.common_times import ComparedColumn
from support_exudyn.postprocessing.comparing.compared_channel import ComparedWindow, compared
from support_exudyn.postprocessing.comparing.kept_run import KeptRun, kept_number
from support_exudyn.postprocessing.comparing.tolerance import BOTH_ERRORS
from support_exudyn.postprocessing.figures.units import readable_change

HEADER = ("change", "of", "name", "was -> is", ">times both errors", ">at")
MOST = 12  # rows of a scenario
DIGITS = 10  # of a number, most


class RunChange(NamedTuple):
    """Something that is no longer what it was.

    kind: whether it has changed, is new, or gone. what: "number", "channel", "key" of the scenario.
    name: of it. values: was and now, in words. time: when that is [s], of channels.
    ratio: the difference over the sum of both errors; infinite if nothing measures it.
    """

    kind: Literal["changed", "new", "gone"]
    what: str
    name: str
    values: str = ""
    time: float | None = None
    ratio: float = math.inf


def changes(old: KeptRun, new: KeptRun) -> list[RunChange]:
    """All that has changed by more than the errors of both runs, is new, or gone.

    What is not determined is not compared: numbers of which an error is not known or that one of the runs has
    no more because of its horizon, and curves beyond the horizon of either run.
    """
    was, now = dict(_leaves(old.scenario)), dict(_leaves(new.scenario))
    found = [*_gone_and_new("key", was, now)]
    found += [
        RunChange("changed", "key", key, f"{was[key]} -> {now[key]}")
        for key in was
        if key in now and was[key] != now[key]
    ]
    numbers = [{name: kept_number(one) for name, one in run.numbers.items()} for run in (old, new)]
    if math.isinf(old.horizon) == math.isinf(new.horizon):
        found += _columns("number", numbers[0], numbers[1], math.inf)
    return [*found, *_columns("channel", old.curves, new.curves, min(old.horizon, new.horizon))]


def _leaves(data: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    """The items of nested data with their places in it, such as pins.B.friction or gravity[1]."""
    if isinstance(data, Mapping) and data:
        for key, item in data.items():
            yield from _leaves(item, f"{place}.{key}" if place else str(key))
    elif isinstance(data, (list, tuple)) and data:
        for n, item in enumerate(data):
            yield from _leaves(item, f"{place}[{n}]")
    else:
        yield place, data


def _gone_and_new(what: str, was: Mapping[str, Any], now: Mapping[str, Any]) -> Iterator[RunChange]:
    for name in [name for name in was if name not in now]:
        yield RunChange("gone", what, name, str(was[name]) if what == "key" else "")
    for name in [name for name in now if name not in was]:
        yield RunChange("new", what, name, str(now[name]) if what == "key" else "")


def _columns(
    what: str, old: Mapping[str, ComparedColumn], new: Mapping[str, ComparedColumn], end: float
) -> Iterator[RunChange]:
    """Changes of curves up to a time [s], or of numbers."""
    yield from _gone_and_new(what, old, new)
    for name in [name for name in old if name in new]:
        was, now = old[name], new[name]
        if was.unit != now.unit:
            yield RunChange("changed", what, name, f"in {was.unit} -> in {now.unit}")
            continue
        if was.time.size and was.time[0] > end:
            continue
        one = compared(name, was, now, BOTH_ERRORS, ComparedWindow(until=end))
        if one.gaps:
            yield RunChange("changed", what, name, f"no value at {one.gaps} of {one.common.time.size} times")
        elif one.verdict == "not within":
            record = one.record
            both = float(one.common.reference[record]), float(one.common.other[record])
            shown = readable_change(one.unit, max(map(abs, both)), abs(both[1] - both[0]))
            first, second = (f"{shown.scale * value:.{DIGITS}g}" for value in both)
            time = float(one.common.time[record]) if was.time.size else None
            yield RunChange(
                "changed", what, name, f"{first} -> {second} {shown.name}", time, one.beside_errors.ratio
            )


def worst_first(found: Sequence[RunChange]) -> list[RunChange]:
    """Keys of the scenario first, for they explain the rest; then what is gone and new, then the farthest."""
    return sorted(found, key=lambda change: (change.what != "key", -change.ratio, change.name))


def rows(found: Sequence[RunChange], most: int = MOST) -> list[tuple[str, ...]]:
    """The worst changes as rows of a table with `HEADER`, and how many more there are."""
    shown = [
        (
            change.kind,
            change.what,
            change.name,
            change.values,
            f"{change.ratio:.3g}" if math.isfinite(change.ratio) else "",
            f"{change.time:.6g} s" if change.time is not None else "",
        )
        for change in worst_first(found)[:most]
    ]
    return shown + [("", "", f"and {len(found) - most} more", "", "", "")] * (len(found) > most)
