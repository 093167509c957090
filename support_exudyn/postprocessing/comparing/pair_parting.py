"""When the curves of two files part."""

from __future__ import annotations

import math
from collections.abc import Mapping

from support_exudyn.mechanics.contact_state import Onset
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.parting import Parting, parting_of_impacts, parting_of_runs

NEVER = Parting(math.inf, "", "", 0, math.nan)


def onsets_of(file: ComparedFile) -> Mapping[str, tuple[Onset, ...]]:
    """Impacts of the contacts that a file knows, at its shifted times; none of a file that is no run."""
    if file.run is None:
        return {}
    shift = file.mapped.shift
    if not shift:
        return file.run.onsets
    return {name: tuple(_later(one, shift) for one in found) for name, found in file.run.onsets.items()}


def _later(onset: Onset, shift: float) -> Onset:
    return onset._replace(time=onset.time + shift, separation_time=onset.separation_time + shift)


def pair_parting(reference: ComparedFile, other: ComparedFile) -> Parting:
    """When two files part: by the impacts and errors of runs; of a run and another file, at the run's horizon.

    Beyond its horizon a run's own single impacts are no result, whatever it is compared with.
    """
    if reference.run is not None and other.run is not None:
        if reference.has_errors and other.has_errors and not (reference.mapped.shift or other.mapped.shift):
            found = parting_of_runs(reference.run, other.run)
            said = found.because.replace("the first run", reference.name).replace("the second run", other.name)
            return found._replace(because=said)
        return parting_of_impacts(onsets_of(reference), onsets_of(other))
    file = reference if reference.run is not None else other
    if file.run is None or not file.has_errors or not math.isfinite(file.run.horizon):
        return NEVER
    because = f"beyond it the impacts of {file.name} hang on its steps"
    return Parting(file.run.horizon + file.mapped.shift, because, "", 0, math.nan)
