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
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.matched_impacts import Pair, match_impacts
from support_exudyn.postprocessing.comparing.with_errors import BesideErrors
from support_exudyn.simulation.estimate import errors
from support_exudyn.simulation.horizon import APART
from support_exudyn.simulation.reported_numbers import impact_numbers
from support_exudyn.simulation.result import Result
from user_forces.contact_state import Onset

Values = npt.NDArray[np.float64]
SUDDEN = 10.0  # times what growth explains
SMALL = 0.01  # share of the time since the impact before, below which nothing parts
LIGHT = 0.02  # share of the fastest impact so far


class Parting(NamedTuple):
    """When two curves part.

    time: [s]; infinite: they do not.
    because: why, for users; "" if they do not.
    contact: the one whose impact parts them; "" if none does.
    impacts: how many matched impacts lie before, of all contacts.
    growth: by what factor an impact multiplied the differences in time before, the mean of the contact that
        parts, or of the one with the most impacts; NaN if fewer than two tell it.
    """

    time: float
    because: str
    contact: str
    impacts: int
    growth: float


def parting_of_runs(first: Result, second: Result) -> Parting:
    """When two own runs part, by the contacts that both have; without errors as in `parting_of_impacts`."""
    without = parting_of_impacts(first.onsets, second.onsets)
    errors_known = first.coarser is not None and second.coarser is not None
    found = _beyond_errors(first, second)._replace(growth=without.growth) if errors_known else without
    for word, run in (("first", first), ("second", second)):
        if run.coarser is not None and run.horizon < found.time:
            why = f"the horizon of the {word} run: from there on shorter steps change its impacts"
            found = found._replace(time=run.horizon, because=why, contact="")
    before = _pairs_before(first.onsets, second.onsets, found.time)
    return found._replace(impacts=before)


def parting_of_impacts(
    first: Mapping[str, Sequence[Onset]],
    second: Mapping[str, Sequence[Onset]],
    *,
    start: float = 0.0,
    resolution: float = 0.0,
) -> Parting:
    """When two curves part of which one has no errors, by the impacts of contacts of the same names.

    Arguments:
        first, second: impacts in the order of time, by contact. A speed that is NaN is not compared.
        start: time at which both begin [s].
        resolution: to which times of impacts are known [s]: the time between records, if impacts are found in a
            curve.
    """
    ends = [
        _Course(name, start, resolution).parted(first[name], second[name]) for name in first if name in second
    ]
    if not ends:
        return Parting(math.inf, "", "", 0, math.nan)
    found = min(ends, key=lambda one: (one.time, -one.impacts))
    return found._replace(impacts=_pairs_before(first, second, found.time))


@dataclass
class _Course:
    """How the differences of one contact's impacts grow, see the module."""

    contact: str
    before: float  # time of the impact before [s]
    resolution: float
    largest: list[float] = field(default_factory=list)  # D_k
    fastest: float = 0.0

    def parted(self, first: Sequence[Onset], second: Sequence[Onset]) -> Parting:
        matched = match_impacts(first, second)
        events: list[tuple[float, Pair | Onset]] = [(min(a.time, b.time), (a, b)) for a, b in matched.pairs]
        for own, alone in ((first, matched.only_first), (second, matched.only_second)):
            merged = self._merged(own)
            events += [(one.time, one) for one in alone if one not in merged]
        for time, event in sorted(events, key=lambda one: one[0]):
            because = self._alone(event) if isinstance(event, Onset) else self._apart(*event)
            if because:
                return Parting(time, because, self.contact, len(self.largest), self.growth)
        return Parting(math.inf, "", "", len(self.largest), self.growth)

    @property
    def growth(self) -> float:
        """G_k, not bounded; NaN if fewer than two differences tell it."""
        if len(self.largest) < 2 or not self.largest[0] > 0.0:
            return math.nan
        return float((self.largest[-1] / self.largest[0]) ** (1.0 / (len(self.largest) - 1)))

    def _apart(self, one: Onset, other: Onset) -> str:
        """Why a pair parts the curves; empty if it does not."""
        since = max(min(one.time, other.time) - self.before, 0.0)
        distance = abs(one.time - other.time)
        growth, explained = self.growth, self.largest[-1] if self.largest else math.inf
        bound = min(max(SUDDEN * explained * (growth if growth > 1.0 else 1.0), SMALL * since), APART * since)
        if distance > max(bound, self.resolution):
            return f"{self.contact}: impacts are {distance:.2g} s apart, {since:.2g} s after the one before"
        if abs(one.speed - other.speed) > APART * max(one.speed, other.speed):
            return f"{self.contact}: impacts hit at {one.speed:.3g} and {other.speed:.3g} m/s"
        self.before = max(one.time, other.time)
        self.largest.append(max(distance, self.resolution, *self.largest[-1:]))
        self.fastest = np.nanmax([self.fastest, one.speed, other.speed])
        return ""

    def _alone(self, onset: Onset) -> str:
        if onset.speed < LIGHT * self.fastest:
            return ""
        if self.resolution > 0.0:
            return (
                f"{self.contact}: one shows an impact that the other does not, read to {self.resolution:.2g} s"
            )
        return f"{self.contact}: one has an impact that the other lacks"

    def _merged(self, onsets: Sequence[Onset]) -> set[Onset]:
        """Impacts that a curve of this resolution may show as one with the impact before or after."""
        close = (
            (one, other) for one, other in pairwise(onsets) if other.time - one.time <= 2.0 * self.resolution
        )
        return {onset for pair in close for onset in pair} if self.resolution > 0.0 else set()


# --- with errors ---


class _Doubts(NamedTuple):
    """Errors of an impact's time [s] and speed [m/s]."""

    time: float
    speed: float


def _beyond_errors(first: Result, second: Result) -> Parting:
    """The first impact before both horizons that differs by more than errors explain."""
    found = Parting(math.inf, "", "", 0, math.nan)
    end = min(first.horizon, second.horizon)
    for name in first.onsets:
        if name not in second.onsets:
            continue
        mine, its = first.onsets[name], second.onsets[name]
        doubts = {**_doubts(first, name, end), **_doubts(second, name, end)}
        matched = match_impacts(mine, its)
        for one, other in matched.pairs:
            if max(one.time, other.time) < min(end, found.time):
                because = _differ(name, one, other, doubts)
                found = Parting(min(one.time, other.time), because, name, 0, math.nan) if because else found
        for onset in (*matched.only_first, *matched.only_second):
            if onset.time < min(end, found.time) and BesideErrors(onset.speed, doubts[onset].speed).different:
                because = f"{name}: one has an impact at {onset.speed:.3g} m/s that the other lacks"
                found = Parting(onset.time, because, name, 0, math.nan)
    return found


def _differ(name: str, one: Onset, other: Onset, doubts: Mapping[Onset, _Doubts]) -> str:
    late = BesideErrors(other.time - one.time, doubts[one].time + doubts[other].time)
    if late.different:
        return f"{name}: impacts are {abs(late.difference):.2g} s apart, {late.times:.2g} times both errors"
    fast = BesideErrors(other.speed - one.speed, doubts[one].speed + doubts[other].speed)
    if fast.different:
        speeds = f"{one.speed:.4g} and {other.speed:.4g} m/s"
        return f"{name}: impacts hit at {speeds}, {fast.times:.2g} times both errors apart"
    return ""


def _doubts(run: Result, name: str, end: float) -> dict[Onset, _Doubts]:
    """Errors of the impacts before a time [s], each at least as large as those before."""
    onsets = [onset for onset in run.onsets[name] if onset.time < end]
    kinds = impact_numbers(run, name, len(onsets))
    known = errors(kinds, run, run.fall) if kinds else {}
    stem = run.scenario.contact_stem(name)
    late = fast = 0.0
    found = {}
    for n, onset in enumerate(onsets):
        late = max(late, known[f"{stem}.onset_{n + 1}.time"])
        fast = max(fast, known[f"{stem}.onset_{n + 1}.speed"])
        found[onset] = _Doubts(late, fast)
    return found


def _pairs_before(
    first: Mapping[str, Sequence[Onset]], second: Mapping[str, Sequence[Onset]], time: float
) -> int:
    pairs = (match_impacts(first[name], second[name]).pairs for name in first if name in second)
    return sum(max(one.time, other.time) < time for of_contact in pairs for one, other in of_contact)
