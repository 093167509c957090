"""When two curves with impacts part: from then on they are compared by their statistics only.

Each impact multiplies the differences that it meets, so two runs part whatever program they are of.

**Two runs with errors** part at the earlier of their horizons (`simulation.horizon`), or at the first impact
before whose time or speed differs by more than both errors explain (`BesideErrors.different`). An impact is
no better known than those before it, so its error is at least theirs. An impact that one run lacks parts
them, too, unless its speed is within its error.

**Where one has no errors**, the first impacts show how differences grow. Impacts of a contact are matched in
time (`match_impacts`). Let d_k be the distance in time of the k-th pair, T_k the time since the impact
before, D_k the largest of d_1 to d_k, and G_k = (D_k / D_1)^(1 / (k - 1)) its mean growth from impact to
impact, at least 1. Then the curves part at the first pair with

    d_k > bound_k = min(max(SUDDEN G D, SMALL T_k), APART T_k),  G and D of the pair before

that is, by more than growth explains as soon as that is 1 % of the time since the impact before, and at 10 %
of it in any case, which is where the horizon of a run lies. They part likewise where speeds differ by 10 %,
and at an impact without a partner. Times that are read off a curve are known to its resolution only: d_k of
that size tell nothing, nor do impacts that are lighter than `LIGHT` of the fastest, or nearer to another than
the resolution.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.impacts import FileImpacts, Onsets, Pair, match_impacts
from support_exudyn.postprocessing.comparing.with_errors import BesideErrors
from support_exudyn.simulation.estimate import errors
from support_exudyn.simulation.horizon import APART
from support_exudyn.simulation.reported_numbers import impact_numbers
from support_exudyn.simulation.result import Result
from user_forces.contact_state import Onset

SUDDEN = 10.0  # times what growth explains
SMALL = 0.01  # share of the time since the impact before, below which nothing parts
LIGHT = 0.02  # share of the fastest impact so far


class Parting(NamedTuple):
    """When two curves part.

    time: [s]; infinite: they do not. because: why, for users; "" if they do not.
    contact: whose impact parts them; "" if none does.
    """

    time: float
    because: str = ""
    contact: str = ""


NEVER = Parting(math.inf)


def pair_parting(
    reference: ComparedFile, other: ComparedFile, impacts: tuple[FileImpacts, FileImpacts]
) -> Parting:
    """When two files part: by their impacts, and of runs by their errors.

    Beyond its horizon a run's own single impacts are no result, whatever it is compared with.

    Arguments:
        reference, other: the files.
        impacts: of both, see `impacts_of`.
    """
    first, second = reference.run, other.run
    shifted = reference.mapped.shift or other.mapped.shift
    if first is not None and second is not None and not shifted and reference.has_errors and other.has_errors:
        parting = parting_of_runs(first, second)
    else:
        mine, its = impacts
        start, resolution = max(reference.start, other.start), max(mine.resolution, its.resolution)
        parting = parting_of_impacts(mine.onsets, its.onsets, start, resolution)
    for file in (reference, other):
        if file.run is not None and file.has_errors and file.run.horizon + file.mapped.shift < parting.time:
            because = f"the horizon of {file.name}: from there on shorter steps change its impacts"
            parting = Parting(file.run.horizon + file.mapped.shift, because)
    return parting


def parting_of_impacts(first: Onsets, second: Onsets, start: float = 0.0, resolution: float = 0.0) -> Parting:
    """When two curves part of which one has no errors, by the impacts of contacts of the same names.

    Arguments:
        first, second: impacts in the order of time, by contact. A speed that is NaN is not compared.
        start: time at which both begin [s].
        resolution: of the times of impacts [s]: the time between records, if impacts are read off a curve.
    """
    ends = [_of_contact(name, first[name], second[name], start, resolution) for name in first if name in second]
    return min(ends, key=lambda parting: parting.time, default=NEVER)


def _of_contact(
    contact: str, first: Sequence[Onset], second: Sequence[Onset], before: float, resolution: float
) -> Parting:
    """When the impacts of a contact part two curves, see the module. before: time of the impact before [s]."""
    matched = match_impacts(first, second)
    events: list[tuple[float, Pair | Onset]] = [(min(a.time, b.time), (a, b)) for a, b in matched.pairs]
    for own, alone in ((first, matched.only_first), (second, matched.only_second)):
        merged = _merged(own, resolution)
        events += [(onset.time, onset) for onset in alone if onset not in merged]
    largest: list[float] = []  # D_k
    fastest = 0.0
    for time, event in sorted(events, key=lambda event: event[0]):
        if isinstance(event, Onset):
            if event.speed < LIGHT * fastest:
                continue
            shown = f"one shows an impact that the other does not, read to {resolution:.2g} s"
            lacking = shown if resolution > 0.0 else "one has an impact that the other lacks"
            return Parting(time, f"{contact}: {lacking}", contact)
        a, b = event
        since, distance = max(time - before, 0.0), abs(a.time - b.time)
        growth = 1.0
        if len(largest) > 1 and largest[0] > 0.0:
            growth = max(1.0, (largest[-1] / largest[0]) ** (1.0 / (len(largest) - 1)))
        explained = SUDDEN * growth * largest[-1] if largest else math.inf
        if distance > max(min(max(explained, SMALL * since), APART * since), resolution):
            late = f"impacts are {distance:.2g} s apart, {since:.2g} s after the one before"
            return Parting(time, f"{contact}: {late}", contact)
        if abs(a.speed - b.speed) > APART * max(a.speed, b.speed):
            return Parting(time, f"{contact}: impacts hit at {a.speed:.3g} and {b.speed:.3g} m/s", contact)
        before = max(a.time, b.time)
        largest.append(max(distance, resolution, *largest[-1:]))
        fastest = float(np.nanmax([fastest, a.speed, b.speed]))
    return NEVER


def _merged(onsets: Sequence[Onset], resolution: float) -> set[Onset]:
    """Impacts that a curve of this resolution may show together with the impact before or after."""
    close = ((one, other) for one, other in pairwise(onsets) if other.time - one.time <= 2.0 * resolution)
    return {onset for pair in close for onset in pair} if resolution > 0.0 else set()


# --- with errors ---


def parting_of_runs(first: Result, second: Result) -> Parting:
    """The first impact before both horizons that differs by more than the errors of two runs explain."""
    parting = NEVER
    end = min(first.horizon, second.horizon)
    for name in first.onsets:
        if name not in second.onsets:
            continue
        doubts = {**_doubts(first, name, end), **_doubts(second, name, end)}
        matched = match_impacts(first.onsets[name], second.onsets[name])
        for one, other in matched.pairs:
            if max(one.time, other.time) < min(end, parting.time):
                because = _differ(name, one, other, doubts)
                parting = Parting(min(one.time, other.time), because, name) if because else parting
        for onset in (*matched.only_first, *matched.only_second):
            if onset.time < min(end, parting.time) and BesideErrors(onset.speed, doubts[onset][1]).different:
                because = f"{name}: one has an impact at {onset.speed:.3g} m/s that the other lacks"
                parting = Parting(onset.time, because, name)
    return parting


Doubts = dict[Onset, tuple[float, float]]  # errors of the time [s] and the speed [m/s]


def _differ(name: str, one: Onset, other: Onset, doubts: Doubts) -> str:
    """Why a pair of impacts differs by more than errors explain; empty if it does not."""
    late = BesideErrors(other.time - one.time, doubts[one][0] + doubts[other][0])
    if late.different:
        return f"{name}: impacts are {abs(late.difference):.2g} s apart, {late.times:.2g} times both errors"
    fast = BesideErrors(other.speed - one.speed, doubts[one][1] + doubts[other][1])
    if fast.different:
        speeds = f"{one.speed:.4g} and {other.speed:.4g} m/s"
        return f"{name}: impacts hit at {speeds}, {fast.times:.2g} times both errors apart"
    return ""


def _doubts(run: Result, name: str, end: float) -> Doubts:
    """Errors of the impacts before a time [s], each at least as large as those before."""
    onsets = [onset for onset in run.onsets[name] if onset.time < end]
    kinds = impact_numbers(run, name, len(onsets))
    known = errors(kinds, run, run.fall) if kinds else {}
    late, fast = (
        np.maximum.accumulate([error for key, error in known.items() if key.endswith(word)] or [0.0])
        for word in (".time", ".speed")
    )
    return dict(zip(onsets, zip(late.tolist(), fast.tolist(), strict=True), strict=False))
