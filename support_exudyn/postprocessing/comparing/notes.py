"""The notes of a comparison, in sentences: reading, shifts, the horizon, interpolation, gaps."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel, extent
from support_exudyn.postprocessing.comparing.files_compared import SHOWN, ComparedPair
from support_exudyn.postprocessing.comparing.statistics import CONFIDENCE
from support_exudyn.postprocessing.comparing.tables import share
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import said

FEW = 4  # statistics that are named of those that differ


def notes(pair: ComparedPair) -> Iterator[str]:
    """What has to be known of the comparison of a file."""
    if pair.same:
        yield f"the same to the bit: all records of {pair.same} channels"
    for file in (pair.reference, pair.other):
        yield from (f"{file.name}: {note}" for note in file.notes)
        if file.mapped.shift and (pair.shift is None or file is pair.reference):
            yield f"{file.name}: {said(file.mapped.shift, 's', 4)} are added to its times"
    if pair.shift is not None:
        shift = pair.shift.found
        late = "lags behind" if shift.shift > 0.0 else "is ahead of"
        yield (
            f"{pair.other.name} {late} {pair.reference.name} by {said(abs(shift.shift), 's', 5)}, "
            f"found by {pair.shift.channel} (correlation {shift.correlation:.4f}); that is taken off its times"
        )
    yield from _horizon(pair)
    yield from _times(pair)
    for channel in pair.channels.values():
        for file, values in ((pair.reference, channel.common.reference), (pair.other, channel.common.other)):
            if missing := int(np.count_nonzero(~np.isfinite(values))):
                yield f"{channel.name}: {file.name} has no value at {missing} of {values.size} times"
    if lacking := pair.common.lacking:
        yield f"{pair.other.name} has no {_some(lacking, SHOWN)}"
    if reasons := pair.common.not_alike:
        yield f"left out: {_some(list(reasons), SHOWN)}; {next(iter(reasons.values()))}"


def _some(names: Sequence[str], most: int) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return f"{', '.join(names[:most])}{more}"


def _horizon(pair: ComparedPair) -> Iterator[str]:
    """Up to when curves are compared point by point, and whether their statistics after that are equal."""
    horizon = pair.window.horizon
    if math.isinf(horizon):
        return
    file = min((pair.reference, pair.other), key=lambda file: file.horizon)
    yield (
        f"point by point up to {horizon:.6g} s, the horizon of {file.name}, from which on shorter steps change "
        "its impacts; after it by statistics"
    )
    every = [(name, what, one) for name, own in pair.channels.items() for what, one in own.statistics.items()]
    known = [one for one in every if one[2].equal is not None]
    if not known:
        yield "after it there is too little for confidence intervals of statistics"
        return
    differ = [f"{what.replace('_', ' ')} of {name}" for name, what, one in known if not one.equal]
    sure = f"with {100.0 * CONFIDENCE:.3g} % confidence of all together"
    if differ:
        yield f"after it {len(differ)} of {len(known)} statistics differ, {sure}: {_some(differ, FEW)}"
    else:
        yield f"after it {len(known)} statistics are equal within the intervals, {sure}"


def _times(pair: ComparedPair) -> Iterator[str]:
    """The error of interpolation; and the times of the reference that the other file lacks, at the worst.

    A gap that is no longer than the time between two records is none.
    """
    worst = max(pair.channels.values(), key=_interpolation)
    if worst.common.interpolated:
        added = _interpolation(worst)
        yield (
            f"{worst.common.interpolated} of {worst.common.time.size} times lie between records of one file; "
            f"straight lines there may be wrong by "
            f"{share(added) if math.isfinite(added) else 'an amount not known'} of the "
            f"range ({worst.name}, where it is most)"
        )
    sentence, most = "", 0.0
    for name, one in pair.channels.items():
        time, common = pair.reference.time(name), one.common.time
        start, end = max(float(time[0]), pair.window.after), min(float(time[-1]), pair.window.until)
        gap = max(float(common[0]) - start, end - float(common[-1]))
        step = float(np.diff(common).max(initial=0.0))
        if gap > max(most, CLEARANCE + 1.5 * step):
            most = gap
            sentence = (
                f"compared are {common[0]:.6g} to {common[-1]:.6g} s of {start:.6g} to {end:.6g} s of "
                f"{pair.reference.name} ({name}), for {pair.other.name} has no more"
            )
    if sentence:
        yield sentence


def _interpolation(one: ComparedChannel) -> float:
    """Largest error of interpolation, as a share of the reference's range; -1 if nothing is interpolated."""
    if not one.common.interpolated:
        return -1.0
    size = extent(one.common.reference)
    return float(np.nanmax(one.common.interpolation_error)) / size if size > 0.0 else math.inf
