"""Impacts of one contact in two runs, matched in time: in their order, one to one."""

import bisect
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from user_forces.contact_state import Onset

Pair = tuple[Onset, Onset]
NEAREST = 64  # impacts to either side in time that are looked at; chatter may have thousands


class MatchedImpacts(NamedTuple):
    """Impacts of one contact in two runs.

    pairs: those that are matched, the first run's and the second run's, in the order of time.
    only_first, only_second: those that have no partner.
    """

    pairs: tuple[Pair, ...]
    only_first: tuple[Onset, ...]
    only_second: tuple[Onset, ...]


def match_impacts(first: Sequence[Onset], second: Sequence[Onset]) -> MatchedImpacts:
    """Match impacts of two runs in time, in their order and one to one.

    The sum of all costs is least: of a pair the distance |t1 - t2| of its onsets, of an impact without a
    partner its reach, which is half of the longer one of the times to its two neighbours in its own run. So two
    impacts are never matched that are farther apart than their reaches together. The reach of an impact without
    neighbours is the time that all impacts span.

    It is found by dynamic programming over the pairs that are near enough, of the `NEAREST` to either side.

    first, second: impacts in the order of time.
    """
    span = max((one.time for one in (*first, *second)), default=0.0)
    span -= min((one.time for one in (*first, *second)), default=0.0)
    mine, its = _reaches(first, span), _reaches(second, span)
    chains: list[tuple[int, int, int]] = []  # pairs, and the chain that each one goes on: first, second, before
    best = _LargestBefore(len(second))
    times = [one.time for one in second]
    for i, one in enumerate(first):
        middle = bisect.bisect_left(times, one.time)
        near = range(max(middle - NEAREST, 0), min(middle + NEAREST, len(times)))
        for j in reversed(near):  # downwards, so that no impact gets two partners
            gain = mine[i] + its[j] - abs(one.time - times[j])
            if gain >= 0.0:
                before, chain = best.up_to(j)
                best.put(j, before + gain, len(chains))
                chains.append((i, j, chain))
    chosen = []
    _, chain = best.up_to(len(second))
    while chain >= 0:
        i, j, chain = chains[chain]
        chosen.append((i, j))
    return _matched(first, second, chosen[::-1])


def _matched(
    first: Sequence[Onset], second: Sequence[Onset], chosen: Sequence[tuple[int, int]]
) -> MatchedImpacts:
    mine, its = {i for i, _ in chosen}, {j for _, j in chosen}
    return MatchedImpacts(
        tuple((first[i], second[j]) for i, j in chosen),
        tuple(one for i, one in enumerate(first) if i not in mine),
        tuple(one for j, one in enumerate(second) if j not in its),
    )


def _reaches(impacts: Sequence[Onset], span: float) -> list[float]:
    """Half of the longer one of the times to both neighbours [s]."""
    times = [one.time for one in impacts]
    between = [late - early for early, late in pairwise(times)]
    if not between:
        return [span] * len(times)
    return [0.5 * max(pair) for pair in zip([0.0, *between], [*between, 0.0], strict=True)]


class _LargestBefore:
    """The largest value put at a place below another, and what belongs to it: a tree of Fenwick."""

    def __init__(self, count: int) -> None:
        self._tree = [(0.0, -1)] * (count + 1)

    def up_to(self, end: int) -> tuple[float, int]:
        """The largest one at places below `end`; (0, -1) if there is none."""
        found = (0.0, -1)
        while end > 0:
            found = max(found, self._tree[end])
            end &= end - 1
        return found

    def put(self, place: int, value: float, item: int) -> None:
        place += 1
        while place < len(self._tree):
            self._tree[place] = max(self._tree[place], (value, item))
            place += place & -place
