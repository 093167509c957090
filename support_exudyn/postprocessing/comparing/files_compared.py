"""Files compared with a reference, channel by channel: runs, measurements, results of other programs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from support_exudyn.files.series.named_series import Progress, silent
from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.comparing.compared_channel import ComparedChannel, ComparedWindow, compared
from support_exudyn.postprocessing.comparing.compared_file import (
    ComparedFile,
    channel_unit,
    compared_file,
    of_run,
)
from support_exudyn.postprocessing.comparing.mapping import CompareFile, read_compare_file, tolerances_of
from support_exudyn.postprocessing.comparing.measures import STATISTICS
from support_exudyn.postprocessing.comparing.shift import TimeShift, found_shift
from support_exudyn.postprocessing.comparing.tolerance import (
    Tolerance,
    ToleranceVerdict,
    of_channel,
    read_tolerances,
    worst,
)
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

FEWEST = 2  # files
SHOWN = 6  # names that are listed of many
Comparable = Result | str | Path


@dataclass(frozen=True)
class ComparedPair:
    """A file compared with the reference.

    channels: by their names. window: the part that is compared, and the earlier horizon of both; beyond it
    single impacts are no result of a run.
    shift: the shift in time that was determined, and applied to `other`; None: none was asked for.
    left_out: channels of the reference that are not compared, each with the reason.
    """

    reference: ComparedFile
    other: ComparedFile
    channels: Mapping[str, ComparedChannel]
    window: ComparedWindow
    shift: TimeShift | None
    left_out: Mapping[str, str]

    @property
    def verdict(self) -> ToleranceVerdict:
        """The worst of those on the channels."""
        return worst(channel.verdict for channel in self.channels.values())


@dataclass(frozen=True)
class FilesCompared:
    """Files compared with a reference."""

    reference: ComparedFile
    pairs: tuple[ComparedPair, ...]

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether all channels of all files are within their tolerances; "no tolerance" if none was given."""
        return worst(pair.verdict for pair in self.pairs)


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

    Raises InputError if something cannot be read, mapped or compared: what, where, and what is allowed; OSError
    if a file is not there.
    """
    given = [one if isinstance(one, Result) else Path(one) for one in (reference, *others)]
    if len(given) < FEWEST:
        raise InputError(f"{len(given)} file: allowed: {FEWEST} or more, the first is the reference")
    if isinstance(mapping, (str, Path)):
        mapping = read_compare_file(Path(mapping), [path for path in given if isinstance(path, Path)])
    mapping = mapping or CompareFile()
    first, *rest = _read(given, mapping, channels, progress)
    asked = read_tolerances(tolerance) if isinstance(tolerance, str) else list(tolerance)
    tolerances = [*asked, *tolerances_of(mapping)]
    named = [*channels, *(each.pattern for each in tolerances)]
    chosen = [_common(first, other, channels, named) for other in rest]
    compared = list(dict.fromkeys(name for units, _ in chosen for name in units))
    for each in tolerances:
        matching(compared, [each.pattern], f"channel is compared, tolerance {each.text}")
    pairs = []
    for other, (units, left_out) in zip(rest, chosen, strict=True):
        shift = found_shift(first, other, units) if find_shift else None
        if shift is not None:
            other = other.shifted(-shift.shift)
        window = ComparedWindow(after, until, min(first.horizon, other.horizon), len(units) * len(STATISTICS))
        columns = {
            name: _channel(first, other, name, unit, window, of_channel(tolerances, name))
            for name, unit in units.items()
        }
        pairs.append(ComparedPair(first, other, columns, window, shift, left_out))
    return FilesCompared(first, tuple(pairs))


def _read(
    given: Sequence[Path | Result], mapping: CompareFile, channels: Sequence[str], progress: Progress
) -> list[ComparedFile]:
    """Files, called by their names; with folder or place if another file has the same name."""
    files: list[ComparedFile] = []
    for n, path in enumerate(given):
        if isinstance(path, Result):
            files.append(of_run(path, Path(f"run {n + 1}"), f"run {n + 1}"))
            continue
        alike = {other for other in given if isinstance(other, Path) and other.name == path.name}
        name = path.name if len(alike) == 1 else str(path)
        name = f"{name} ({n + 1})" if name in [file.name for file in files] else name

        def piece(share: float, n: int = n) -> None:
            progress((n + share) / len(given))

        files.append(compared_file(path, mapping.of(path), name, channels, piece))
    progress(1.0)
    return files


def _channel(
    reference: ComparedFile,
    other: ComparedFile,
    name: str,
    unit: str,
    window: ComparedWindow,
    tolerance: Tolerance | None,
) -> ComparedChannel:
    """Compare a channel; the means of two runs are taken from all of their steps."""
    try:
        one = compared(name, reference.columns[name], other.columns[name], tolerance, window, unit)
    except InputError as error:
        raise InputError(f"{name} of {reference.name} and {other.name}: {error}") from None
    times = one.common.time
    first, second = (file.mean(name, unit, float(times[0]), float(times[-1])) for file in (reference, other))
    if first is None or second is None:
        return one
    known = [mean.error for mean in (first, second) if not math.isnan(mean.error)]
    apart = Estimate(second.value - first.value, sum(known) if known else math.nan, unit)
    return replace(one, means=(first, second, apart))


# --- the channels that two files have in common ---


def _common(
    reference: ComparedFile, other: ComparedFile, patterns: Sequence[str], named: Sequence[str]
) -> tuple[dict[str, str], dict[str, str]]:
    """The units of the channels that are compared, and why others, though they are asked for, are not.

    patterns: names, or patterns as in a shell; without, of two runs forces and traced points, else all.
    named: of channels that are asked for, or have a tolerance; patterns among them are passed over.

    Raises InputError if nothing is left, or if a channel that is named, or mapped, cannot be compared.
    """
    mine, its = reference.columns, other.columns
    asked = matching(mine, patterns) if patterns else _usual(reference, other)
    for name in named:
        if name in mine and name not in its:
            raise InputError(f"{name}: {other.name} has no such channel; {_way_out(reference, other)}")
    if its.keys().isdisjoint(asked):
        raise InputError(
            f"{reference.path}, {other.path}: have no channel in common; {_way_out(reference, other)}"
        )
    units, left_out = {}, {}
    for name in asked:
        if name not in its:
            left_out[name] = f"{other.name} has no such channel"
            continue
        try:
            units[name] = channel_unit(reference, other, name)
        except InputError as error:
            if name in {*named, *reference.mapped, *other.mapped}:
                raise
            left_out[name] = str(error)
    if not units:
        raise InputError("\n".join([why for name, why in left_out.items() if name in its][:SHOWN]))
    return units, left_out


def _usual(reference: ComparedFile, other: ComparedFile) -> list[str]:
    """The channels that are compared if none is asked for."""
    if reference.run is None:
        return list(reference.columns)
    if other.run is None:
        return [name for name in reference.columns if name in other.columns]
    usual = [name for name in summary.telling(reference.run) if not name.startswith("energy.")]
    mapped = [name for name in (*reference.mapped, *other.mapped) if name in reference.columns]
    return list(dict.fromkeys([*mapped, *usual]))


def _way_out(reference: ComparedFile, other: ComparedFile) -> str:
    """The names of channels in both files, and how to map one to another."""
    shown = []
    for file in (reference, other):
        more = f" and {len(file.columns) - SHOWN} more" if len(file.columns) > SHOWN else ""
        shown.append(f"{file.name} has {', '.join(list(file.columns)[:SHOWN])}{more}")
    first, second = next(iter(reference.columns)), next(iter(other.columns))
    return (
        f"{'; '.join(shown)}; allowed: columns called as channels, or --map compare.toml, which says which "
        f'column is which: [files."{other.path.name}".columns] "{first}" = "{second}"'
    )
