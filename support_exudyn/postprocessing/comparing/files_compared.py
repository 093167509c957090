"""Files compared with a reference, channel by channel: runs, measurements, results of other programs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from support_exudyn.files.series.asked import Progress, silent
from support_exudyn.postprocessing.comparing.compare_file import CompareFile, read_compare_file, tolerances_of
from support_exudyn.postprocessing.comparing.compared_channel import (
    JUDGED,
    ComparedChannel,
    ComparedWindow,
    compared_channel,
)
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile, compared_file, of_run
from support_exudyn.postprocessing.comparing.found_shift import FoundShift, found_shift
from support_exudyn.postprocessing.comparing.laid_curves import LaidCurves
from support_exudyn.postprocessing.comparing.matched_channels import (
    CommonChannels,
    check_named,
    common_channels,
)
from support_exudyn.postprocessing.comparing.matched_impacts import MatchedImpacts, match_impacts
from support_exudyn.postprocessing.comparing.own_runs import same_to_the_bit
from support_exudyn.postprocessing.comparing.pair_parting import NEVER, impacts_of, pair_parting
from support_exudyn.postprocessing.comparing.parting import Parting
from support_exudyn.postprocessing.comparing.tolerances import (
    Tolerance,
    of_channel,
    read_tolerances,
)
from support_exudyn.postprocessing.comparing.verdict import ToleranceVerdict, worst
from support_exudyn.postprocessing.comparing.whole_turns import ANGLE, turns_apart
from support_exudyn.postprocessing.comparing.with_errors import BesideErrors, numbers_beside_errors
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

FEWEST = 2  # files
Comparable = Result | str | Path


@dataclass(frozen=True)
class ComparedPair:
    """A file compared with the reference.

    channels: by their names. parting: when both part, and why; never, if all is the same to the bit.
    impacts: of contacts that both know.
    shift: the shift in time that was found, which `other` has been given; None: none was asked for.
    same: how many channels there are, if both are runs and all records are the same to the bit; else 0.
    common: which channels are compared, and which are not. after, until: what is compared, [s].
    """

    reference: ComparedFile
    other: ComparedFile
    channels: Mapping[str, ComparedChannel]
    parting: Parting
    impacts: Mapping[str, MatchedImpacts]
    shift: FoundShift | None
    same: int
    common: CommonChannels
    after: float
    until: float

    @cached_property
    def numbers(self) -> Mapping[str, BesideErrors]:
        """The numbers that two runs report, see `Result.numbers`, beside their errors; none without errors."""
        first, second = self.reference.run, self.other.run
        if first is None or second is None or not (self.reference.has_errors and self.other.has_errors):
            return {}
        return numbers_beside_errors(first, second, self.after, self.until)

    @property
    def verdict(self) -> ToleranceVerdict:
        """The worst of those on the channels."""
        return worst(one.verdict for one in self.channels.values())


@dataclass(frozen=True)
class FilesCompared:
    """Files compared with a reference. after, until: what of them [s]."""

    reference: ComparedFile
    pairs: tuple[ComparedPair, ...]
    after: float
    until: float

    @property
    def verdict(self) -> ToleranceVerdict:
        """Whether all channels of all files are within their tolerances; "told" if none was given."""
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
        mapping: the file of the comparison, compare.toml, or what it says.
        tolerance: as on a command line, 'pin.*.force=2%,tip.*=0.1mm'; goes before those of the mapping.
        after, until: what is compared [s].
        find_shift: find by how much every file lags behind the reference, and take it off.
        progress: is told the share of the files that is read.

    Raises InputError if something cannot be read, mapped or compared: what, where, and what is allowed; OSError
    if a file is not there.
    """
    given = [reference, *others]
    if len(given) < FEWEST:
        raise InputError(f"{len(given)} file: allowed: {FEWEST} or more, the first is the reference")
    files, said = read_files(given, mapping, channels, progress)
    asked = read_tolerances(tolerance) if isinstance(tolerance, str) else list(tolerance)
    tolerances = [*asked, *tolerances_of(said)]
    first, *rest = files
    chosen = [common_channels(first, other, channels) for other in rest]
    check_named(tolerances, chosen)
    pairs = tuple(
        _pair(first, other, common, (after, until), said, tolerances, find_shift)
        for other, common in zip(rest, chosen, strict=True)
    )
    return FilesCompared(first, pairs, after, until)


def read_files(
    given: Sequence[Comparable],
    mapping: str | Path | CompareFile | None = None,
    channels: Sequence[str] = (),
    progress: Progress = silent,
) -> tuple[list[ComparedFile], CompareFile]:
    """Files, each with what a mapping says of it; and the mapping. Raises as `compare_files`."""
    paths = [one if isinstance(one, Result) else Path(one) for one in given]
    if isinstance(mapping, (str, Path)):
        mapping = read_compare_file(Path(mapping), [path for path in paths if isinstance(path, Path)])
    said = mapping or CompareFile()
    files: list[ComparedFile] = []
    for n, path in enumerate(paths):
        name = _name(path, n, [one.name for one in files], paths)
        if isinstance(path, Result):
            files.append(of_run(path, Path(name), name))
            continue
        files.append(compared_file(path, said.of(path), name, channels, _piece(progress, n, len(paths))))
    progress(1.0)
    return files, said


def _piece(progress: Progress, number: int, count: int) -> Progress:
    """What is told of one of several files, as a share of all."""
    return lambda share: progress((number + share) / count)


def _name(path: Path | Result, number: int, taken: Sequence[str], paths: Sequence[Path | Result]) -> str:
    """By which a file is called: its name; with its folder or its place if another has the same."""
    if isinstance(path, Result):
        return f"run {number + 1}"
    alike = {other for other in paths if isinstance(other, Path) and other.name == path.name}
    name = path.name if len(alike) == 1 else str(path)
    return name if name not in taken else f"{name} ({number + 1})"


def _pair(
    reference: ComparedFile,
    other: ComparedFile,
    common: CommonChannels,
    ends: tuple[float, float],
    said: CompareFile,
    tolerances: Sequence[Tolerance],
    find_shift: bool,
) -> ComparedPair:
    """Compare two files."""
    units, names = common.units, list(common.units)
    shift = found_shift(reference, other, units) if find_shift else None
    if shift is not None:
        other = other.shifted(-shift.found.shift)
    angles = [name for name in names if units[name] == ANGLE]
    laid = {name: LaidCurves(reference, other, name, ANGLE, *ends).common for name in angles}
    other = replace(other, turns={name: turns_apart(one.reference, one.other) for name, one in laid.items()})
    known = impacts_of(reference, names), impacts_of(other, names)
    same = 0
    if reference.run is not None and other.run is not None and other.mapped == reference.mapped:
        same = same_to_the_bit(reference.run, other.run)
    parting = NEVER if same else pair_parting(reference, other, known)
    onsets = known[0].onsets, known[1].onsets
    contacts = [name for name in onsets[0] if name in onsets[1]]
    run = reference.run or other.run
    stems = {one: f"pin.{one}" if run is None else run.scenario.contact_stem(one) for one in contacts}
    told = len(names) * len(JUDGED) + len(contacts)
    window = ComparedWindow(*ends, parting.time, said.bands, max(told, 1))
    channels = {}
    for name in names:
        contact = next((one for one in contacts if name.startswith(f"{stems[one]}.")), None)
        impacts = None
        if contact is not None:
            impacts = tuple([one.time for one in side[contact]] for side in onsets)
        channels[name] = compared_channel(
            reference,
            other,
            name,
            units[name],
            window,
            of_channel(tolerances, name),
            impacts,  # type: ignore[arg-type]
        )
    matched = {name: match_impacts(onsets[0][name], onsets[1][name]) for name in contacts}
    return ComparedPair(reference, other, channels, parting, matched, shift, same, common, *ends)
