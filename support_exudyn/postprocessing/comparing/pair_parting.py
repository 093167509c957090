"""The impacts of two files, and when their curves part."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from typing import NamedTuple

import numpy as np

from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.found_impacts import impacts_of_force
from support_exudyn.postprocessing.comparing.parting import Parting, parting_of_impacts, parting_of_runs
from user_forces.contact_state import Onset
from user_forces.values.value import InputError

NEVER = Parting(math.inf, "", "", 0, math.nan)
PIN_FORCE = re.compile(r"pin\.(.+)\.force")
Onsets = Mapping[str, tuple[Onset, ...]]  # by contact


class FileImpacts(NamedTuple):
    """Impacts of a file by contact, and to which their times are known [s]: 0 of a run."""

    onsets: Onsets
    resolution: float


def impacts_of(file: ComparedFile, channels: Collection[str]) -> FileImpacts:
    """The impacts that a file knows, at its shifted times.

    Of a run these are all. Of another file they are found in the forces of pins among the channels, as far as
    these are computed: exactly zero at times, which nothing that is measured is.
    """
    if file.run is None:
        return _found(file, channels)
    shift = file.mapped.shift
    if not shift:
        return FileImpacts(file.run.onsets, 0.0)
    later = {name: tuple(_later(one, shift) for one in found) for name, found in file.run.onsets.items()}
    return FileImpacts(later, 0.0)


def _later(onset: Onset, shift: float) -> Onset:
    return onset._replace(time=onset.time + shift, separation_time=onset.separation_time + shift)


def _found(file: ComparedFile, channels: Collection[str]) -> FileImpacts:
    onsets, resolution = {}, 0.0
    for channel in channels:
        name = PIN_FORCE.fullmatch(channel)
        found = _in_force(file, channel) if name else ()
        if name and found:
            onsets[name[1]] = found
            resolution = max(resolution, float(np.median(np.diff(file.time(channel)))))
    return FileImpacts(onsets, resolution)


def _in_force(file: ComparedFile, channel: str) -> tuple[Onset, ...]:
    """The impacts that show in a force; none if it is not one of a contact that opens."""
    try:
        time, force = file.time(channel), file.values(channel, "N")
        return impacts_of_force(time, force) if time.size > 1 and (force == 0.0).any() else ()
    except InputError:  # a component, or of another unit
        return ()


def pair_parting(
    reference: ComparedFile, other: ComparedFile, impacts: tuple[FileImpacts, FileImpacts]
) -> Parting:
    """When two files part: by their impacts, and of runs by their errors.

    Beyond its horizon a run's own single impacts are no result, whatever it is compared with.

    Arguments:
        reference, other: the files.
        impacts: of both, see `impacts_of`.
    """
    shifted = reference.mapped.shift or other.mapped.shift
    if reference.run is not None and other.run is not None and not shifted:
        found = parting_of_runs(reference.run, other.run)
        said = found.because.replace("the first run", reference.name).replace("the second run", other.name)
        return found._replace(because=said)
    mine, its = impacts
    found = parting_of_impacts(
        mine.onsets,
        its.onsets,
        start=max(_start(reference), _start(other)),
        resolution=max(mine.resolution, its.resolution),
    )
    for file in (reference, other):
        if file.run is not None and file.has_errors and file.run.horizon + file.mapped.shift < found.time:
            because = f"the horizon of {file.name}: from there on shorter steps change its impacts"
            found = Parting(file.run.horizon + file.mapped.shift, because, "", found.impacts, found.growth)
    return found


def _start(file: ComparedFile) -> float:
    """First time of a file [s]."""
    return min(float(one.time[0]) for one in file.series.values() if one.time.size) + file.mapped.shift
