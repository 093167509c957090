"""Files compared with a reference, channel by channel: runs, measurements, results of other programs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path

import numpy as np

from support_exudyn.files.series.named_series import Progress, silent
from support_exudyn.files.series.units import scaled, unit_checked
from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.comparing.compared_channel import (
    ComparedChannel,
    ComparedRow,
    Verdict,
    compared,
    worst,
)
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile, compared_file
from support_exudyn.postprocessing.comparing.mapping import (
    CompareFile,
    MappedFile,
    Tolerance,
    read_compare_file,
    read_tolerances,
    tolerances_of,
)
from support_exudyn.postprocessing.comparing.measures import STATISTICS, TimeShift, time_shift
from support_exudyn.postprocessing.figures.selection import is_called, matching
from support_exudyn.postprocessing.figures.units import QUANTITIES
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

SHOWN = 6  # names that are listed of many
Comparable = Result | str | Path


@dataclass(frozen=True)
class ComparedPair:
    """A file compared with the reference.

    channels: by their names. after, until: the part that is compared [s].
    shift: the shift in time that was determined, and applied to `other`; None: none was asked for.
    left_out: channels of the reference that are not compared, each with the reason.
    """

    reference: ComparedFile
    other: ComparedFile
    channels: Mapping[str, ComparedChannel]
    after: float
    until: float
    shift: TimeShift | None
    left_out: Mapping[str, str]

    @property
    def horizon(self) -> float:
        """The earlier horizon of both [s]; beyond it single impacts are no result of a run."""
        return min(self.reference.horizon, self.other.horizon)

    def rows(self) -> Iterator[ComparedRow]:
        """The table of the comparison: the rows of all channels, then the channels that are not comparable."""
        for channel in self.channels.values():
            yield from channel.rows
        for name, reason in self.left_out.items():
            yield ComparedRow(name, "", "", verdict="not comparable", reason=reason)

    @property
    def verdict(self) -> Verdict:
        """The worst verdict of the channels with a tolerance; without any tolerance, of all channels."""
        return FilesCompared(self.reference, (self,)).verdict

    @property
    def faults(self) -> list[str]:
        """Why channels are not within their tolerances, or not decided."""
        return [text for channel in self.channels.values() for text in channel.faults]


@dataclass(frozen=True)
class FilesCompared:
    """Files compared with a reference."""

    reference: ComparedFile
    pairs: tuple[ComparedPair, ...]

    @property
    def channels(self) -> list[ComparedChannel]:
        """The channels of all files."""
        return [channel for pair in self.pairs for channel in pair.channels.values()]

    @property
    def verdict(self) -> Verdict:
        """The worst verdict on channels with a tolerance; if there is none, on all."""
        judged = [channel for channel in self.channels if channel.tolerance is not None]
        return worst(channel.verdict for channel in judged or self.channels)

    @property
    def failed(self) -> bool:
        """Whether a channel is not within its tolerance, or not decided."""
        return any(channel.faults for channel in self.channels)


def compare_files(
    reference: Comparable,
    *others: Comparable,
    channels: Sequence[str] = (),
    mapping: str | Path | CompareFile | None = None,
    tolerance: str | Sequence[Tolerance] = (),
    after: float = -math.inf,
    until: float = math.inf,
    find_shift: bool = False,
    progress: Progress = silent,
    rate: float | None = None,
) -> FilesCompared:
    """Compare files with a reference.

        compare_files("measured.csv", "rise.h5", mapping="compare.toml", tolerance="tip.*=0.1mm").verdict

    Arguments:
        reference, others: runs, or paths of files of any kind that can be read.
        channels: names, or patterns as in a shell. Without: of two runs forces and traced points, else all that
            both files have.
        mapping: the file of the comparison, compare.toml, or its contents.
        tolerance: as on a command line, 'pin.*.force=2%,tip.*=0.1mm'; goes before those of the mapping.
        after, until: the part that is compared [s].
        find_shift: determine by how much every file lags behind the reference, and take it off.
        progress: receives the share of the files that is read.
        rate: rows per second [Hz] of files without times for which the mapping gives none.

    Raises InputError if something cannot be read, mapped or compared: what, where, and what is allowed; OSError
    if a file is not there.
    """
    sources = [each if isinstance(each, Result) else Path(each) for each in (reference, *others)]
    if not others:
        raise InputError("1 file: allowed: 2 or more, the first is the reference")
    if isinstance(mapping, (str, Path)):
        mapping = read_compare_file(Path(mapping), [path for path in sources if isinstance(path, Path)])
    mapping = mapping or CompareFile()
    mapping = replace(mapping, rate=mapping.rate or rate)
    files: list[ComparedFile] = []

    def share_done(n: int, share: float) -> None:
        progress((n + share) / len(sources))

    for n, source in enumerate(sources):
        name, mapped = f"run {n + 1}", MappedFile()
        if isinstance(source, Path):
            alike = {each for each in sources if isinstance(each, Path) and each.name == source.name}
            name, mapped = source.name if len(alike) == 1 else str(source), mapping.of(source)
            name = f"{name} ({n + 1})" if name in [file.name for file in files] else name
        files.append(compared_file(source, name, mapped, channels, partial(share_done, n)))
    progress(1.0)
    first, *rest = files
    asked = read_tolerances(tolerance) if isinstance(tolerance, str) else list(tolerance)
    tolerances = [*asked, *tolerances_of(mapping)]
    named = [*channels, *(each.pattern for each in tolerances)]
    chosen = [_common(first, other, channels, named) for other in rest]
    common = list(dict.fromkeys(name for units, _ in chosen for name in units))
    for each in tolerances:
        matching(common, [each.pattern], f"channel is compared, tolerance {each.text}")
    pairs = []
    for other, (units, left_out) in zip(rest, chosen, strict=True):
        shift = _surest_shift(first, other, units) if find_shift else None
        if shift is not None:
            other = other.shifted(-shift.shift)
        pair = ComparedPair(first, other, {}, after, until, shift, left_out)
        pairs.append(replace(pair, channels={name: _channel(pair, name, units, tolerances) for name in units}))
    return FilesCompared(first, tuple(pairs))


def _channel(
    pair: ComparedPair, name: str, units: Mapping[str, str], tolerances: Sequence[Tolerance]
) -> ComparedChannel:
    """Compare a channel; the means of two runs are taken from all of their steps."""
    files, unit = (pair.reference, pair.other), units[name]
    try:
        channel = compared(
            name,
            files[0].columns[name],
            files[1].columns[name],
            next((each for each in tolerances if is_called(name, each.pattern)), None),
            unit=unit,
            after=pair.after,
            until=pair.until,
            horizon=pair.horizon,
            among=len(units) * len(STATISTICS),
        )
    except InputError as error:
        raise InputError(f"{name} of {files[0].name} and {files[1].name}: {error}") from None
    ends = float(channel.common.time[0]), float(channel.common.time[-1])
    first, second = (file.mean(name, unit, *ends) for file in files)
    if first is None or second is None:
        return channel
    known = [mean.error for mean in (first, second) if not math.isnan(mean.error)]
    row = channel.rows[0]._replace(
        reference=first.value,
        other=second.value,
        difference=second.value - first.value,
        error=sum(known) if known else math.nan,
    )
    return replace(channel, rows=(row, *channel.rows[1:]))


def _surest_shift(reference: ComparedFile, other: ComparedFile, units: Mapping[str, str]) -> TimeShift:
    """The shift of the channel that is sure of it and has the largest correlation.

    Raises InputError if no channel is sure: the curves are not alike, or alike at several shifts.
    """
    sure, reasons = [], []
    for name, unit in units.items():
        mine, its = (file.columns[name].in_unit(unit, name) for file in (reference, other))
        try:
            shift = time_shift(mine.time, mine.values, its.time, its.values)._replace(channel=name)
        except InputError as error:
            reasons.append(f"{name}: {error}")
            continue
        sure += [shift] if shift.is_sure else []
        reasons.append(f"{name}: correlation {shift.correlation:.2f}, at another shift {shift.next_best:.2f}")
    if sure:
        return max(sure, key=lambda shift: shift.correlation)
    raise InputError(
        f"--shift: {other.name} and {reference.name}: no shift in time is sure ({'; '.join(reasons[:3])}); "
        f'allowed: a channel with one clear event, or shift_s of [files."{other.path.name}"] in compare.toml'
    )


# --- the channels that two files have in common, each in a unit ---


def _common(
    reference: ComparedFile, other: ComparedFile, patterns: Sequence[str], named: Sequence[str]
) -> tuple[dict[str, str], dict[str, str]]:
    """The units of the channels that are compared, and why others, though they are asked for, are not.

    patterns: names, or patterns as in a shell; without, of two runs forces and traced points, else all.
    named: of channels that are asked for, or have a tolerance; patterns among them are passed over.

    Raises InputError if nothing is left, or if a channel that is named, or mapped, cannot be compared.
    """
    mine, its, mapped = reference.columns, other.columns, (*reference.mapped, *other.mapped)
    if patterns:
        asked = matching(mine, patterns)
    elif reference.run is None:
        asked = list(mine)
    elif other.run is None:
        asked = [name for name in mine if name in its]
    else:
        usual = [name for name in summary.telling(reference.run) if not name.startswith("energy.")]
        asked = [name for name in dict.fromkeys([*mapped, *usual]) if name in mine]
    lacking = [name for name in named if name in mine and name not in its]
    if lacking or its.keys().isdisjoint(asked):
        shown = "; ".join(f"{file.name} has {first_names(list(file.columns))}" for file in (reference, other))
        first, second = (next(iter(columns)) for columns in (mine, its))
        what = f"{lacking[0]}: {other.name} has no such channel" if lacking else "no channel in common"
        raise InputError(
            f"{what}; {shown}; allowed: columns called as channels, or --map compare.toml, which says which "
            f'column is which: [files."{other.path.name}".columns] "{first}" = "{second}"'
        )
    units, left_out = {}, {name: f"{other.name} has no such channel" for name in asked if name not in its}
    for name in asked:
        if name in left_out:
            continue
        try:
            units[name] = _channel_unit(reference, other, name)
        except InputError as error:
            if name in {*named, *mapped}:
                raise
            left_out[name] = str(error)
    if not units:
        raise InputError("\n".join([reason for name, reason in left_out.items() if name in its][:SHOWN]))
    return units, left_out


def first_names(names: Sequence[str]) -> str:
    """The first of some names, and how many more there are."""
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return f"{', '.join(names[:SHOWN])}{more}"


def _channel_unit(reference: ComparedFile, other: ComparedFile, channel: str) -> str:
    """The unit in which a channel is compared: that of a run, else the SI unit of what the files name.

    Raises InputError if a file names none, or if both are of two kinds.
    """
    own, others = units = [file.columns[channel].unit for file in (reference, other)]
    if own is not None and others is not None:
        of_runs = [file.columns[channel].unit for file in (reference, other) if file.run is not None]
        for unit in of_runs[:1] or map(_si_unit, (own, others)):  # g may be an acceleration, not where kg are
            if unit is not None and _of_a_kind(own, unit) and _of_a_kind(others, unit):
                return unit
    lacking = reference if own is None else other
    column = lacking.mapped.get(channel, channel)
    mine, its = ("no unit" if unit is None else unit or "pure numbers" for unit in units)
    raise InputError(
        f"{channel}: is in {mine} in {reference.name}, and in {its} in {other.name}; allowed: units of "
        f"one kind, in the column's title, '{column} [mm]', or in compare.toml, "
        f'[files."{lacking.path.name}".units] "{column}" = "mm"'
    )


@cache
def _si_unit(unit: str) -> str:
    """The SI unit of the kind of a unit: "N" of kN, "m" of inch; the unit itself if no channel is of its kind.

    Raises InputError if it is no unit.
    """
    unit_checked(unit, "unit")
    kinds = [each for each in QUANTITIES if _of_a_kind(unit, each)]
    return "J" if "J" in kinds and "J" in unit else next(iter(kinds), unit)  # work and moment have one unit


@cache
def _of_a_kind(first: str, second: str) -> bool:
    """Whether quantities in the first unit can be given in the second."""
    try:
        scaled(np.ones(1), first, second, "unit")
    except InputError:
        return False
    return True
