"""Impacts of a run with their errors, and up to when the run is determined.

Each impact multiplies the errors of all before it, of whatever pin. The distances of three runs can be small by
chance at one of them; so the error of an impact is at least, as a share, the largest of those before. All of
them get a factor, as records of curves do, see `comparing.with_errors`.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

from support_exudyn.postprocessing.comparing.with_errors import SINGLE
from support_exudyn.simulation.estimate import Estimate, errors
from support_exudyn.simulation.horizon import horizon
from support_exudyn.simulation.reported_numbers import impact_numbers, measures
from support_exudyn.simulation.result import Result

MOST = 100  # impacts of every clearance pin that are kept
DOUBTFUL = 0.01  # share by which an impact may be uncertain; soon behind it nothing is known


class KeptImpact(NamedTuple):
    """An impact of a clearance pin: onset [s] and initial impact velocity [m/s], with their errors."""

    time: Estimate
    speed: Estimate


Impacts = Mapping[str, tuple[KeptImpact, ...]]


def kept_impacts(result: Result) -> tuple[Impacts, float]:
    """The first impacts of every clearance pin; up to when the run is determined [s], infinite: to its end.

    It is up to the horizon of the run, to that of the next coarser one, and to the first impact that may be
    wrong by more than `DOUBTFUL`: its time, of the time since the one before, or its initial impact velocity.
    """
    end = horizon(result)
    if result.coarser is not None and result.coarser.coarser is not None:
        end = min(end, horizon(result.coarser))
    found: dict[str, list[KeptImpact]] = {pin: [] for pin in result.onsets}
    late = slow = 0.0  # shares
    for pin, impact in _in_time(result):
        before = found[pin][-1].time.value if found[pin] else 0.0
        since, speed = impact.time.value - before, impact.speed.value
        late, slow = max(late, _share(impact.time.error, since)), max(slow, _share(impact.speed.error, speed))
        if max(late, slow) > DOUBTFUL:
            end = min(end, impact.time.value)
        if impact.time.value >= end:
            break
        off, wrong = max(impact.time.error, late * since), max(impact.speed.error, slow * speed)
        time = impact.time._replace(error=SINGLE * off)
        found[pin].append(KeptImpact(time, impact.speed._replace(error=SINGLE * wrong)))
    return {pin: tuple(impacts[:MOST]) for pin, impacts in found.items()}, end


def _share(error: float, size: float) -> float:
    """An error as a share; nothing where it is that of nothing, as of a contact that a run begins with."""
    return error / size if size > 0.0 else 0.0


def _in_time(result: Result) -> list[tuple[str, KeptImpact]]:
    """All impacts of all pins with their own errors, in the order of their onsets."""
    every = max(map(len, result.onsets.values()), default=0)
    kinds = {pin: impact_numbers(result, pin, every) for pin in result.onsets}
    whole = {name: kind for of_pin in kinds.values() for name, kind in of_pin.items()}
    known = errors(whole, result, result.fall, {**measures(result, 0.0, math.inf), **whole})
    found = []
    for pin, of_pin in kinds.items():
        estimates = [Estimate(kind.measure(result), known[name], kind.unit) for name, kind in of_pin.items()]
        found += [(pin, KeptImpact(*pair)) for pair in zip(estimates[::2], estimates[1::2], strict=True)]
    return sorted(found, key=lambda one: one[1].time.value)
