"""What is kept of a run: its numbers, impacts and thinned curves, each with its error."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.baselines.fluctuation import fluctuation
from support_exudyn.postprocessing.baselines.kept_impacts import Impacts, kept_impacts
from support_exudyn.postprocessing.baselines.safe_errors import safe_errors
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.provenance import provenance
from support_exudyn.simulation.result import Result
from support_exudyn.sweeps.key import program
from support_exudyn.sweeps.own_sources import own_sources
from user_forces.values.value import InputError

RECORDS = 100  # of every curve that are kept
TIME = "time"
SOURCES = "sources"
ONSET = ".onset_"  # in names of numbers: impacts are kept by themselves
STATISTICS = (".mean", ".std")  # which are numbers of a run, whatever its single impacts


class KeptCurve(NamedTuple):
    """A channel at the records that are kept: unit, values and their errors (n,), in SI."""

    unit: str
    values: Series
    errors: Series


@dataclass(frozen=True)
class KeptRun:
    """What is kept of a run, to tell later what has changed.

    scenario: that was asked for, as plain data; empty where that is not compared.
    numbers: by name, those of single impacts left out.
    time: of the records that are kept (n,) [s]. curves: at these, by channel.
    impacts: the first of every clearance pin.
    horizon: up to when single impacts and curves are determined [s], see `kept_impacts`.
    provenance: versions, platform, time, digests of our own sources and of the user's modules.
    history: what was said when the baseline was changed: date and reason.
    """

    numbers: Mapping[str, Estimate]
    provenance: Mapping[str, str]
    scenario: Mapping[str, Any] = field(default_factory=dict)
    time: Series = field(default_factory=lambda: np.zeros(0))
    curves: Mapping[str, KeptCurve] = field(default_factory=dict)
    impacts: Impacts = field(default_factory=dict)
    horizon: float = math.inf
    history: tuple[Mapping[str, str], ...] = ()


def kept_run(result: Result) -> KeptRun:
    """What is kept of a run.

    Beyond the horizon single impacts, extremes and curves are no results, so of a run that has one the numbers
    kept are means and spreads, whose errors then are at least what they fluctuate by.

    Arguments:
        result: with errors.

    Raises InputError if the result has nothing to estimate errors by.
    """
    if result.coarser is None:
        raise InputError(
            "the run has no numerical errors, so that no change can be told from them; allowed: a run with an "
            "accuracy, or made with errors=True"
        )
    impacts, horizon = kept_impacts(result)
    rows = np.unique(np.linspace(0, result.time.size - 1, RECORDS).round().astype(np.intp))
    return KeptRun(
        numbers=_numbers(result, horizon),
        provenance={**result.provenance, SOURCES: program()[SOURCES], **_own(result)},
        time=result.time[rows],
        curves=_curves(result, rows),
        impacts=impacts,
        horizon=horizon,
    )


def kept_numbers(numbers: Mapping[str, Estimate]) -> KeptRun:
    """Numbers of one's own with their errors, kept as those of a run are."""
    return KeptRun(numbers=dict(numbers), provenance={**provenance(), SOURCES: program()[SOURCES]})


def _own(result: Result) -> dict[str, str]:
    """Digests of one's own modules with laws and machines."""
    return {f"module {name}": digest for name, digest in own_sources(result.scenario.plain).items()}


def _numbers(result: Result, horizon: float) -> dict[str, Estimate]:
    numbers = {name: one for name, one in result.numbers().items() if ONSET not in name}
    if math.isinf(horizon):
        return numbers
    statistics = {name: one for name, one in numbers.items() if name.endswith(STATISTICS)}
    return {
        name: one._replace(error=one.error + fluctuation(result, name, horizon))
        for name, one in statistics.items()
    }


def _curves(result: Result, rows: npt.NDArray[np.intp]) -> dict[str, KeptCurve]:
    """All channels at some records."""
    names = [name for name, one in result.channels.items() if name != TIME and one.is_determined]
    known = safe_errors(result, names)
    return {name: KeptCurve(result.unit(name), result[name][rows], known[name][rows]) for name in names}
