"""Impacts of the contacts of two files: of runs, or read off a curve of a force, and matched in time."""

import bisect
import math
import re
from collections.abc import Collection, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from user_forces.contact_state import Onset
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
Pair = tuple[Onset, Onset]
Onsets = Mapping[str, Sequence[Onset]]  # by contact, in the order of time
NEAREST = 64  # impacts to either side in time that may be matched; chatter may have thousands
SHARE = 1e-3  # of the largest force, below which a contact carries none
PIN_FORCE = re.compile(r"pin\.(.+)\.force")


class FileImpacts(NamedTuple):
    """Impacts of a file by contact, and the resolution of their times [s]: 0 of a run."""

    onsets: Onsets
    resolution: float


def impacts_of(file: ComparedFile, channels: Collection[str]) -> FileImpacts:
    """The impacts that a file knows, at its shifted times.

    Of a run these are all. Of another file they are read off the forces of pins among the channels, as far as
    these are computed: exactly zero at times, which nothing that is measured is.
    """
    if file.run is not None:
        return FileImpacts(
            {
                name: tuple(
                    onset._replace(
                        time=onset.time + file.mapped.shift,
                        separation_time=onset.separation_time + file.mapped.shift,
                    )
                    for onset in onsets
                )
                for name, onsets in file.run.onsets.items()
            },
            0.0,
        )
    shown, resolution = dict[str, Sequence[Onset]](), 0.0
    for channel in channels:
        name = PIN_FORCE.fullmatch(channel)
        if name is None or file.time(channel).size < 2:
            continue
        try:
            time, force = file.time(channel), file.values(channel, "N")
            onsets = impacts_of_force(time, force) if (force == 0.0).any() else ()
        except InputError:  # a component, or of another unit
            continue
        if onsets:
            shown[name[1]] = onsets
            resolution = max(resolution, float(np.median(np.diff(time))))
    return FileImpacts(shown, resolution)


def impacts_of_force(time: Values, force: Values) -> tuple[Onset, ...]:
    """Impacts that show in the magnitude of a contact force: each rises from zero and falls back.

    An impact begins where the straight line between two records crosses the threshold, `SHARE` of the largest
    force, upwards, and separates where it crosses downwards. An impact that goes on when the curve begins has
    no onset; an impact that goes on at its end has not separated. Records farther apart than an impact is long
    show several as a single impact, or none. Speeds cannot be seen in a force: they are NaN.

    Arguments:
        time: [s], (n,), increasing.
        force: its magnitude, >= 0, in any unit, (n,); NaN where a value is not known counts as no force.

    Raises InputError if a force is negative, as a component would be.
    """
    known = np.where(np.isfinite(force), force, 0.0)
    if known.size and known.min() < 0.0:
        raise InputError(f"a force of {known.min():g}: allowed: magnitudes of a contact's force, from 0 on")
    level = SHARE * float(known.max(initial=0.0))
    pressed = known > level
    ends = []
    for at in (np.flatnonzero(~pressed[:-1] & pressed[1:]), np.flatnonzero(pressed[:-1] & ~pressed[1:])):
        way = (level - known[at]) / (known[at + 1] - known[at])
        ends.append(time[at] + way * (time[at + 1] - time[at]))
    begins, separations = ends[0].tolist(), [*ends[1].tolist(), math.inf]
    after = np.searchsorted(ends[1], ends[0])
    return tuple(
        Onset(begin, math.nan, separations[n], math.nan) for begin, n in zip(begins, after, strict=True)
    )


class MatchedImpacts(NamedTuple):
    """Impacts of the same contact in two runs.

    pairs: the matched impacts, the first run's and the second run's, in the order of time.
    only_first, only_second: the impacts without a partner.
    """

    pairs: tuple[Pair, ...]
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
