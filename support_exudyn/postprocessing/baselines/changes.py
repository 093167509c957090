"""What has changed between two runs of one scenario by more than both of their errors."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

import numpy as np

from support_exudyn.postprocessing.baselines.kept_impacts import MOST, KeptImpact
from support_exudyn.postprocessing.baselines.kept_run import KeptCurve, KeptRun
from support_exudyn.simulation.estimate import Estimate

Kind = Literal["changed", "new", "gone"]
CHANGED: Kind = "changed"
NEW: Kind = "new"
GONE: Kind = "gone"
NEAR = 0.25  # share of the time to the next impact, within which one is still the same
SLIGHT = 1e-3  # share of a pin's fastest impact, below which rounding decides whether there is a touch at all
# shares of a time: an impact there may be on either side of the end of a run, or of what is determined of it
AT_THE_END, AT_THE_HORIZON = 1e-9, 0.01


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

    What is not determined is not compared: numbers of which an error is not known, curves and impacts beyond
    the horizon of either run.
    """
    return [
        *_scenario(old.scenario, new.scenario),
        *_numbers(old, new),
        *_impacts(old, new),
        *_curves(old, new),
    ]


def _scenario(old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[RunChange]:
    was, now = dict(_leaves(old)), dict(_leaves(new))
    for key in sorted(was.keys() | now.keys()):
        if key not in now:
            yield RunChange(GONE, "key", key, said=f"{was[key]}")
        elif key not in was:
            yield RunChange(NEW, "key", key, said=f"{now[key]}")
        elif was[key] != now[key]:
            yield RunChange(CHANGED, "key", key, said=f"{was[key]} -> {now[key]}")


def _leaves(data: Any, place: str = "") -> Iterator[tuple[str, Any]]:
    if isinstance(data, Mapping) and data:
        for key, value in data.items():
            yield from _leaves(value, f"{place}.{key}" if place else str(key))
    elif isinstance(data, (list, tuple)) and data:
        for n, value in enumerate(data):
            yield from _leaves(value, f"{place}[{n}]")
    else:
        yield place, data


def _numbers(old: KeptRun, new: KeptRun) -> Iterator[RunChange]:
    # a run without a horizon has numbers that one with a horizon has not
    alike = math.isinf(old.horizon) == math.isinf(new.horizon)
    for name, was in old.numbers.items():
        now = new.numbers.get(name)
        if now is None:
            if alike:
                yield RunChange(GONE, "number", name, was)
        elif was.unit != now.unit:
            yield RunChange(CHANGED, "number", name, was, now)
        elif (ratio := apart(was, now)) > 1.0:
            yield RunChange(CHANGED, "number", name, was, now, ratio=ratio)
    if alike:
        for name, now in new.numbers.items():
            if name not in old.numbers:
                yield RunChange(NEW, "number", name, None, now)


def apart(was: Estimate, now: Estimate) -> float:
    """The difference of two numbers over the sum of their errors; 0 if an error is not known."""
    both = was.error + now.error
    if not math.isfinite(both):
        return 0.0
    if math.isnan(was.value) and math.isnan(now.value):
        return 0.0
    off = abs(now.value - was.value)
    if math.isnan(off):
        return math.inf
    return off / both if both > 0.0 else (math.inf if off > 0.0 else 0.0)


def _curves(old: KeptRun, new: KeptRun) -> Iterator[RunChange]:
    for name in old.curves.keys() - new.curves.keys():
        yield RunChange(GONE, "channel", name)
    for name in new.curves.keys() - old.curves.keys():
        yield RunChange(NEW, "channel", name)
    common = [name for name in old.curves if name in new.curves]
    if not common:
        return
    if old.time.shape != new.time.shape or not np.allclose(old.time, new.time, rtol=1e-9, atol=1e-12):
        yield RunChange(CHANGED, "channel", "time", said="the records are at other times")
        return
    end = min(old.horizon, new.horizon)
    for name in common:
        change = _curve(name, old.curves[name], new.curves[name], old.time, end)
        if change is not None:
            yield change


def _curve(name: str, was: KeptCurve, now: KeptCurve, time: np.ndarray, end: float) -> RunChange | None:
    """Where a channel is farthest from what it was, as a share of both errors."""
    if was.unit != now.unit:
        return RunChange(CHANGED, "channel", name, said=f"in {was.unit} -> in {now.unit}")
    worst, where = 0.0, -1
    for n in np.flatnonzero(time < end).tolist():
        ratio = apart(_at(was, n), _at(now, n))
        if ratio > worst:
            worst, where = ratio, n
    if worst <= 1.0:
        return None
    return RunChange(CHANGED, "channel", name, _at(was, where), _at(now, where), float(time[where]), worst)


def _at(curve: KeptCurve, n: int) -> Estimate:
    return Estimate(float(curve.values[n]), float(curve.errors[n]), curve.unit)


# --- impacts ---


def _impacts(old: KeptRun, new: KeptRun) -> Iterator[RunChange]:
    for pin in old.impacts.keys() - new.impacts.keys():
        yield RunChange(GONE, "impact", f"{pin}: all")
    for pin in new.impacts.keys() - old.impacts.keys():
        yield RunChange(NEW, "impact", f"{pin}: all")
    last = [run.time[-1] for run in (old, new) if run.time.size]
    end = min(
        [(1.0 - AT_THE_HORIZON) * min(old.horizon, new.horizon), *((1.0 - AT_THE_END) * one for one in last)]
    )
    for pin, was in old.impacts.items():
        if pin in new.impacts:
            yield from _of_pin(pin, was, new.impacts[pin], end)


def _of_pin(
    pin: str, was: tuple[KeptImpact, ...], now: tuple[KeptImpact, ...], end: float
) -> Iterator[RunChange]:
    """Impacts are matched in their order; one that has no other near it is gone, or new.

    Only so many of a pin are kept: beyond the last that both have kept nothing is gone.
    """
    last = [impacts[-1].time.value for impacts in (was, now) if len(impacts) >= MOST]
    end = min([end, *last])
    least = SLIGHT * max((one.speed.value for one in (*was, *now)), default=0.0)
    n = m = 0
    while n < len(was) or m < len(now):
        mine, its = was[n : n + 1], now[m : m + 1]
        if mine and its and _same(mine[0], its[0], _gap(was, n), _gap(now, m)):
            yield from _of_impact(f"{pin}: {n + 1}", mine[0], its[0])
            n, m = n + 1, m + 1
        elif not its or (mine and mine[0].time.value < its[0].time.value):
            if _counts(mine[0], end, least):
                yield RunChange(GONE, "impact", f"{pin}: {n + 1}", mine[0].time, None, mine[0].time.value)
            n += 1
        else:
            if _counts(its[0], end, least):
                yield RunChange(NEW, "impact", f"{pin}: {m + 1}", None, its[0].time, its[0].time.value)
            m += 1


def _counts(impact: KeptImpact, end: float, least: float) -> bool:
    """Whether an impact is surely there: before an end [s], and faster than a slight touch [m/s]."""
    time, speed = impact
    before = time.value + 2.0 * time.error < end
    return before and speed.value - speed.error > least


def _gap(impacts: tuple[KeptImpact, ...], n: int) -> float:
    """Time between an impact and its nearest neighbour [s]."""
    times = [one.time.value for one in impacts[max(0, n - 1) : n + 2]]
    return min(np.diff(times), default=math.inf)


def _same(was: KeptImpact, now: KeptImpact, gap: float, other: float) -> bool:
    """Whether two impacts can be one: they are within their errors, or nearer than their neighbours are."""
    off = abs(now.time.value - was.time.value)
    return off <= was.time.error + now.time.error or off < NEAR * min(gap, other)


def _of_impact(name: str, was: KeptImpact, now: KeptImpact) -> Iterator[RunChange]:
    for word, one, other in (("time", was.time, now.time), ("speed", was.speed, now.speed)):
        if (ratio := apart(one, other)) > 1.0:
            yield RunChange(CHANGED, "impact", f"{name}, {word}", one, other, was.time.value, ratio)
