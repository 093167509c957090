"""The notes of a comparison, in sentences: reading, shifts, the parting, interpolation, gaps."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from support_exudyn.postprocessing.comparing.compared_channel import CONFIDENCE, ComparedChannel, extent
from support_exudyn.postprocessing.comparing.files_compared import SHOWN, ComparedPair
from support_exudyn.postprocessing.comparing.impacts import impacts_of
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
            f"{pair.other.name} {late} {pair.reference.name} by {said(abs(shift.shift), 's', 5)} ± "
            f"{said(shift.error, 's', 2)}, found by {pair.shift.channel} "
            f"(correlation {shift.correlation:.4f}); that is taken off its times"
        )
    yield from _parting(pair)
    yield from _numbers(pair)
    yield from _times(pair)
    for channel in pair.channels.values():
        for file, values in ((pair.reference, channel.common.reference), (pair.other, channel.common.other)):
            if missing := int(np.count_nonzero(~np.isfinite(values))):
                yield f"{channel.name}: {file.name} has no value at {missing} of {values.size} times"
    yield from (f"{one.name}: {one.not_told}" for one in pair.channels.values() if one.not_told)
    if lacking := pair.common.lacking:
        yield f"{pair.other.name} has no {_some(lacking, SHOWN)}"
    if reasons := pair.common.not_alike:
        yield f"left out: {_some(list(reasons), SHOWN)}; {next(iter(reasons.values()))}"


def _some(names: Sequence[str], most: int) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return f"{', '.join(names[:most])}{more}"


def _parting(pair: ComparedPair) -> Iterator[str]:
    """Up to when curves are compared point by point, and whether their statistics after that are equal."""
    if not math.isfinite(pair.parting.time):
        if not pair.same and any(any(matched) for matched in pair.impacts.values()):
            yield "point by point over all of it: no impact parts the curves"
        return
    near = [
        (abs(onset.time - pair.parting.time), number, file.run.scenario.contact_stem(contact))
        for file in (pair.reference, pair.other)
        if file.run is not None
        for contact, onsets in impacts_of(file, ()).onsets.items()
        for number, onset in enumerate(onsets, 1)
    ]
    _, number, stem = min(near, default=(0.0, 0, ""))
    impact = f", impact {number} of {stem}" if number else ""
    because = pair.parting.because.rstrip(".")
    yield f"point by point up to {pair.parting.time:.6g} s{impact} ({because}); after it by statistics"
    known = [(one.name, what) for one in pair.channels.values() for what in one.statistics.values()]
    if not known:
        yield "after it there is too little for statistics"
        return
    silent = sum(what.equal is None for _, what in known)
    number = len(known) - silent
    if not number:
        yield "after it there is too little for confidence intervals of statistics"
        return
    differ = [f"{what.name.replace('_', ' ')} of {name}" for name, what in known if what.equal is False]
    counted = f"{number} {'statistic' if number == 1 else 'statistics'}"
    sure = f"with {100.0 * CONFIDENCE:.3g} % confidence of all together"
    tail = f"; {silent} have no interval" if silent else ""
    if differ:
        yield f"after it {len(differ)} of {counted} differ, {sure}: {_some(differ, FEW)}{tail}"
    else:
        yield f"after it {counted} {'is' if number == 1 else 'are'} equal within the intervals, {sure}{tail}"


def _numbers(pair: ComparedPair) -> Iterator[str]:
    """How many of the numbers that two runs report are within both errors."""
    known = {name: number for name, number in pair.numbers.items() if number.within is not None}
    larger = {name: number for name, number in known.items() if not number.within}
    farthest = ""
    if larger:
        name = max(larger, key=lambda name: larger[name].times)
        farthest = f"; the farthest from it is {name}, {larger[name]}"
    if known:
        yield f"{len(known) - len(larger)} of {len(known)} reported numbers are within both errors{farthest}"


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
        start, end = max(float(time[0]), pair.after), min(float(time[-1]), pair.until)
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
