"""What has to be known of a comparison, in sentences: what was read, shifts, the parting, interpolation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from support_exudyn.postprocessing.comparing.compared_channel import CONFIDENCE, ComparedChannel, extent
from support_exudyn.postprocessing.comparing.files_compared import ComparedPair
from support_exudyn.postprocessing.comparing.pair_parting import impacts_of
from support_exudyn.postprocessing.comparing.told import share
from support_exudyn.postprocessing.figures.selection import CLEARANCE
from support_exudyn.postprocessing.figures.units import said

FEW = 6  # names that are told of many


def sentences(pair: ComparedPair) -> Iterator[str]:
    """What has to be known of the comparison of a file."""
    if pair.same:
        yield f"the same to the bit: all records of {pair.same} channels"
    yield from _files(pair)
    yield from _shift(pair)
    yield from _parting(pair)
    yield from _numbers(pair)
    yield from _times(pair)
    yield from _covered(pair)
    yield from _not_known(pair)
    for one in pair.channels.values():
        yield from (f"{one.name}: {reason}" for reason in one.not_told)
    if lacking := pair.common.lacking:
        yield f"{pair.other.name} has no {_some(lacking)}"
    if reasons := pair.common.not_alike:
        yield f"left out: {_some(list(reasons))}; {next(iter(reasons.values()))}"


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - FEW} more" if len(names) > FEW else ""
    return f"{', '.join(names[:FEW])}{more}"


def _files(pair: ComparedPair) -> Iterator[str]:
    for file in (pair.reference, pair.other):
        for note in file.notes:
            yield f"{file.name}: {note}"
        if file.mapped.shift and (pair.shift is None or file is pair.reference):
            yield f"{file.name}: {said(file.mapped.shift, 's', 4)} are added to its times"


def _shift(pair: ComparedPair) -> Iterator[str]:
    if pair.shift is None:
        return
    found = pair.shift.found
    late = "lags behind" if found.shift > 0.0 else "is ahead of"
    yield (
        f"{pair.other.name} {late} {pair.reference.name} by {said(abs(found.shift), 's', 5)} ± "
        f"{said(found.error, 's', 2)}, found by {pair.shift.channel} (correlation {found.correlation:.4f}); "
        "that is taken off its times"
    )


def _parting(pair: ComparedPair) -> Iterator[str]:
    if not math.isfinite(pair.parting.time):
        if not pair.same and any(
            one.pairs or one.only_first or one.only_second for one in pair.impacts.values()
        ):
            yield "point by point over all of it: no impact parts the curves"
        return
    told = f"{pair.parting.time:.6g} s" + (f", {which}" if (which := _impact(pair)) else "")
    yield f"point by point up to {told} ({pair.parting.because.rstrip('.')}); after it by statistics"
    if equal := equality(pair):
        yield equal


def _impact(pair: ComparedPair) -> str:
    """The impact at which two runs part, such as "impact 3 of pin.B"; empty if there are none."""
    near = [
        (abs(one.time - pair.parting.time), number, file.run.scenario.contact_stem(contact))
        for file in (pair.reference, pair.other)
        if file.run is not None
        for contact, onsets in impacts_of(file, ()).onsets.items()
        for number, one in enumerate(onsets, 1)
    ]
    _, number, stem = min(near, default=(0.0, 0, ""))
    return f"impact {number} of {stem}" if number else ""


def equality(pair: ComparedPair) -> str:
    """Whether the statistics after the parting are equal, in a sentence; empty if there are none."""
    found = [(one.name, what) for one in pair.channels.values() for what in one.statistics.values()]
    if not found:
        return "after it there is too little for statistics"
    confidence = f"{100.0 * CONFIDENCE:.3g} % confidence of all together"
    differ = [f"{what.name.replace('_', ' ')} of {name}" for name, what in found if what.equal is False]
    silent = sum(what.equal is None for _, what in found)
    number = len(found) - silent
    told, verb = f"{number} {'statistic' if number == 1 else 'statistics'}", "is" if number == 1 else "are"
    tail = f"; {silent} have no interval" if silent else ""
    if not number:
        return "after it there is too little for confidence intervals of statistics"
    if not differ:
        return f"after it {told} {verb} equal within the intervals, with {confidence}{tail}"
    some = ", ".join(differ[:4]) + (f" and {len(differ) - 4} more" if len(differ) > 4 else "")
    return f"after it {len(differ)} of {told} differ, with {confidence}: {some}{tail}"


def _numbers(pair: ComparedPair) -> Iterator[str]:
    """How many of the numbers that two runs report are within both errors."""
    known = {name: one for name, one in pair.numbers.items() if one.within is not None}
    if not known:
        return
    larger = {name: one for name, one in known.items() if not one.within}
    told = f"{len(known) - len(larger)} of {len(known)} reported numbers are within both errors"
    if larger:
        name = max(larger, key=lambda one: larger[one].times)
        told += f"; the farthest from it is {name}, {larger[name]}"
    yield told


def _times(pair: ComparedPair) -> Iterator[str]:
    """That curves were interpolated, and what it may add."""
    worst = max(pair.channels.values(), key=_interpolation)
    if not worst.common.interpolated:
        return
    added = _interpolation(worst)
    yield (
        f"{worst.common.interpolated} of {worst.common.time.size} times lie between records of one file; "
        f"straight lines there may be wrong by "
        f"{share(added) if math.isfinite(added) else 'an amount not known'} of the "
        f"range ({worst.name}, where it is most)"
    )


def _interpolation(one: ComparedChannel) -> float:
    """Largest error of interpolation, as a share of the reference's range; -1 if nothing is interpolated."""
    if not one.common.interpolated:
        return -1.0
    size = extent(one.common.reference)
    return float(np.nanmax(one.common.interpolation_error)) / size if size > 0.0 else math.inf


def _covered(pair: ComparedPair) -> Iterator[str]:
    """Which times of the reference the other file lacks, if that is more than the time between two records."""
    worst, most = "", 0.0
    for name, one in pair.channels.items():
        time, common = pair.reference.time(name), one.common.time
        start, end = max(float(time[0]), pair.after), min(float(time[-1]), pair.until)
        gap = max(float(common[0]) - start, end - float(common[-1]))
        step = float(np.diff(common).max()) if common.size > 1 else 0.0
        if gap > max(most, CLEARANCE + 1.5 * step):
            most = gap
            worst = (
                f"compared are {common[0]:.6g} to {common[-1]:.6g} s of {start:.6g} to {end:.6g} s of "
                f"{pair.reference.name} ({name}), for {pair.other.name} has no more"
            )
    if worst:
        yield worst


def _not_known(pair: ComparedPair) -> Iterator[str]:
    """How many values are not there, and so are left out."""
    for one in pair.channels.values():
        for file, values in ((pair.reference, one.common.reference), (pair.other, one.common.other)):
            if missing := int(np.count_nonzero(~np.isfinite(values))):
                yield f"{one.name}: {file.name} has no value at {missing} of {values.size} times"
