"""Impacts of a contact in two runs, matched in time."""

import bisect
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from user_forces.contact_state import Onset

NEAREST = 64  # impacts to either side in time that may be matched; chatter may have thousands


class MatchedImpacts(NamedTuple):
    """Impacts of the same contact in two runs.

    pairs: the matched impacts, the first run's and the second run's, in the order of time.
    only_first, only_second: the impacts without a partner.
    """

    pairs: tuple[tuple[Onset, Onset], ...]
    only_first: tuple[Onset, ...]
    only_second: tuple[Onset, ...]


def match_impacts(first: Sequence[Onset], second: Sequence[Onset]) -> MatchedImpacts:
    """Match impacts of two runs in time, in their order and one to one.

    The sum of all costs is least: of a pair the distance |t1 - t2| of its onsets, of an impact without a
    partner its reach, which is half of the longer of the times to its two neighbours in its own run. So two
    impacts are never matched that are farther apart than their reaches together. The reach of an impact without
    neighbours is the time that all impacts span.

    Dynamic programming over the pairs that are near enough, of the `NEAREST` to either side: best[j] is the
    largest gain of any chain of pairs with the second run's first j impacts, and never falls with j.

    first, second: impacts in the order of time.
    """
    times = [onset.time for onset in second]
    every = [onset.time for onset in (*first, *second)]
    span = max(every, default=0.0) - min(every, default=0.0)
    mine, its = _reaches(first, span), _reaches(second, span)
    best, last = np.zeros(len(second) + 1), np.full(len(second) + 1, -1)
    chains: list[tuple[int, int, int]] = []  # pairs, each with the chain before it
    for i, onset in enumerate(first):
        middle = bisect.bisect_left(times, onset.time)
        near = range(max(middle - NEAREST, 0), min(middle + NEAREST, len(times)))
        for j in reversed(near):  # downwards, so that no impact gets two partners
            gain = mine[i] + its[j] - abs(onset.time - times[j])
            if gain >= 0.0 and best[j] + gain >= best[j + 1]:
                total, before = best[j] + gain, int(last[j])
                better = slice(j + 1, int(np.searchsorted(best, total, "right")))
                best[better], last[better] = total, len(chains)
                chains.append((i, j, before))
    chosen, chain = dict[int, int](), int(last[-1])
    while chain >= 0:
        i, j, chain = chains[chain]
        chosen[i] = j
    partners = set(chosen.values())
    return MatchedImpacts(
        tuple((first[i], second[chosen[i]]) for i in sorted(chosen)),
        tuple(onset for i, onset in enumerate(first) if i not in chosen),
        tuple(onset for j, onset in enumerate(second) if j not in partners),
    )


def _reaches(impacts: Sequence[Onset], span: float) -> list[float]:
    """Half of the longer of the times to both neighbours [s]."""
    between = [late.time - early.time for early, late in pairwise(impacts)]
    if not between:
        return [span] * len(impacts)
    return [0.5 * max(pair) for pair in zip([0.0, *between], [*between, 0.0], strict=True)]
