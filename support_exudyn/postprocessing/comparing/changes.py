"""Changes between two runs of the same scenario by more than both of their errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.comparing.closeness import compared_columns
from support_exudyn.postprocessing.comparing.kept_run import (
    MOST_IMPACTS,
    KeptColumn,
    KeptImpact,
    KeptRun,
    kept_number,
)
from support_exudyn.postprocessing.figures.selection import nearest
from support_exudyn.postprocessing.figures.units import readable_change
from support_exudyn.simulation.estimate import Estimate

Kind = Literal["changed", "new", "gone"]
# share of a pin's fastest impact, below which rounding decides whether there is a touch at all
SLIGHT = 1e-3
# shares of a time: an impact there may be on either side of the end of a run, or of its horizon
AT_THE_END, AT_THE_HORIZON = 1e-9, 0.01
HEADER = ("change", "of", "name", "was -> is", ">times both errors", ">at")
MOST = 12  # rows of a scenario


class RunChange(NamedTuple):
    """Something that is no longer what it was.

    kind: whether it has changed, is new, or gone. what: "number", "channel", "impact", "key" of the scenario.
    name: of it. was, now: its value; None if it has none, or is not there. time: when that is [s], of channels
    and impacts. ratio: the difference over the sum of both errors; infinite if nothing measures it.
    said: was and now in words, of what is no number.
    """

    kind: Kind
    what: str
    name: str
    was: Estimate | None = None
    now: Estimate | None = None
    time: float | None = None
    ratio: float = math.inf
    said: str = ""


def changes(old: KeptRun, new: KeptRun) -> list[RunChange]:
    """All that has changed by more than the errors of both runs, is new, or gone.

    What is not determined is not compared: numbers of which an error is not known or that one of the runs has
    no more because of its horizon, curves and impacts beyond the horizon of either run.
    """
    was, now = dict(_leaves(old.scenario)), dict(_leaves(new.scenario))
    keys = [*_gone_and_new("key", was, now)]
    keys += [
        RunChange("changed", "key", key, said=f"{was[key]} -> {now[key]}")
        for key in was
        if key in now and was[key] != now[key]
    ]
    alike = math.isinf(old.horizon) == math.isinf(new.horizon)
    end = min(old.horizon, new.horizon)
    first, second = ({name: kept_number(one) for name, one in run.numbers.items()} for run in (old, new))
    return [
        *sorted(keys, key=lambda change: change.name),
        *(_columns("number", first, second, math.inf) if alike else ()),
        *_impacts(old, new, end),
        *_columns("channel", old.curves, new.curves, end),
    ]


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
        yield RunChange("gone", what, name, _value(what, was[name]), said=_words(what, was[name]))
    for name in [name for name in now if name not in was]:
        yield RunChange("new", what, name, now=_value(what, now[name]), said=_words(what, now[name]))


def _value(what: str, item: Any) -> Estimate | None:
    return _at(item, 0.0) if what == "number" else None


def _words(what: str, item: Any) -> str:
    return str(item) if what == "key" else ""


def _columns(
    what: str, old: Mapping[str, KeptColumn], new: Mapping[str, KeptColumn], end: float
) -> Iterator[RunChange]:
    """Changes of curves up to a time [s], or of numbers."""
    yield from _gone_and_new(what, old, new)
    for name in [name for name in old if name in new]:
        yield from _column(what, name, old[name], new[name], end)


def _column(
    what: str, name: str, was: KeptColumn, now: KeptColumn, end: float = math.inf
) -> Iterator[RunChange]:
    if was.unit != now.unit:
        yield RunChange("changed", what, name, said=f"in {was.unit} -> in {now.unit}")
    elif not was.time.size or was.time[0] <= end:
        one = compared_columns(name, now, was, until=end)
        if one.judged.verdict == "not within":
            first, second = _at(was, one.time or 0.0), _at(now, one.time or 0.0)
            yield RunChange("changed", what, name, first, second, one.time, one.judged.ratio)


def _at(column: KeptColumn, time: float) -> Estimate:
    """A column at the record next to a time [s], with its error; of a number its value."""
    n = int(np.abs(column.time - time).argmin()) if column.time.size else 0
    return Estimate(float(column.values[n]), float(column.errors[n]), column.unit or "")


def _impacts(old: KeptRun, new: KeptRun, end: float) -> Iterator[RunChange]:
    """Two impacts are matched that are nearest to each other; an impact without a partner is gone, or new.

    Only so many of a pin are kept: beyond the last that both have kept nothing is gone.
    """
    yield from _gone_and_new("impact", old.impacts, new.impacts)
    times = [curve.time[-1] for run in (old, new) for curve in run.curves.values()]
    end = min([(1.0 - AT_THE_HORIZON) * end, *((1.0 - AT_THE_END) * time for time in times)])
    for pin in [pin for pin in old.impacts if pin in new.impacts]:
        was, now = old.impacts[pin], new.impacts[pin]
        times_of = [np.array([impact.time.value for impact in side]) for side in (was, now)]
        matched = _matched(*times_of)
        for n, m in matched.items():
            for word, first, second in zip(("time", "speed"), was[n], now[m], strict=True):
                for change in _column(
                    "impact", f"{pin}: {n + 1}, {word}", kept_number(first), kept_number(second)
                ):
                    yield change._replace(time=was[n].time.value)
        last = min([end, *(side[-1].time.value for side in (was, now) if len(side) >= MOST_IMPACTS)])
        least = SLIGHT * max((impact.speed.value for impact in (*was, *now)), default=0.0)
        for n, impact in enumerate(was):
            if n not in matched and _counts(impact, last, least):
                yield RunChange("gone", "impact", f"{pin}: {n + 1}", impact.time, None, impact.time.value)
        for m, impact in enumerate(now):
            if m not in matched.values() and _counts(impact, last, least):
                yield RunChange("new", "impact", f"{pin}: {m + 1}", None, impact.time, impact.time.value)


def _matched(first: Series, second: Series) -> dict[int, int]:
    """Times of two runs (n,) and (m,) [s] that are nearest to each other, by their places in both."""
    if not (first.size and second.size):
        return {}
    partners, back = nearest(second, first).tolist(), nearest(first, second).tolist()
    return {n: m for n, m in enumerate(partners) if back[m] == n}


def _counts(impact: KeptImpact, end: float, least: float) -> bool:
    """Whether an impact is surely there: before an end [s], and faster than a slight touch [m/s]."""
    time, speed = impact
    return time.value + 2.0 * time.error < end and speed.value - speed.error > least


# --- in words ---


def worst_first(found: Sequence[RunChange]) -> list[RunChange]:
    """Keys of the scenario first, for they explain the rest; then what is gone and new, then the farthest."""
    return sorted(found, key=lambda change: (change.what != "key", -change.ratio))


def rows(found: Sequence[RunChange]) -> list[tuple[str, ...]]:
    """The worst changes as rows of a table with `HEADER`, and how many more there are."""
    more = [("", "", f"and {len(found) - MOST} more", "", "", "")] if len(found) > MOST else []
    return [*map(_row, worst_first(found)[:MOST]), *more]


def line(change: RunChange) -> str:
    """A change in a line."""
    kind, what, name, values, ratio, time = _row(change)
    words = f"{what} {name} {kind}" + (f": {values}" if values else "")
    return words + (f", {ratio} times both errors" if ratio else "") + (f", at {time}" if time else "")


def _row(change: RunChange) -> tuple[str, ...]:
    """Both numbers in the unit in which they are read best."""
    both = [number for number in (change.was, change.now) if number is not None]
    texts = []
    if both:
        size, off = max(abs(number.value) for number in both), abs(both[-1].value - both[0].value)
        shown = readable_change(both[0].unit, size, off)
        texts = [str(Estimate(shown.scale * n.value, shown.scale * n.error, shown.name)) for n in both]
    ratio = f"{change.ratio:.3g}" if math.isfinite(change.ratio) else ""
    time = f"{change.time:.6g} s" if change.time is not None else ""
    return change.kind, change.what, change.name, change.said or " -> ".join(texts), ratio, time
