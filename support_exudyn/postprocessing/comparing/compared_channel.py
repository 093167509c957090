"""A channel of a file beside the same of the reference: differences, errors, statistics, bands, a verdict."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.bands import BandRms, band_rms
from support_exudyn.postprocessing.comparing.common_times import CommonCurves, on_common_times
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.postprocessing.comparing.measures import CurveMeasures, curve_measures
from support_exudyn.postprocessing.comparing.parting import Parting
from support_exudyn.postprocessing.comparing.rating import IsoRating, iso_rating
from support_exudyn.postprocessing.comparing.statistics import StatisticDifference, compared_statistics
from support_exudyn.postprocessing.comparing.tolerances import Tolerance
from support_exudyn.postprocessing.comparing.verdict import JudgedDifference, ToleranceVerdict, worst
from support_exudyn.postprocessing.comparing.with_errors import BesideErrors
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
Measure = Callable[[CommonCurves], float]
JUDGED = ("mean", "rms", "spread", "quantile_95")  # statistics that are in the unit of the channel
LARGEST = "largest difference"


@dataclass(frozen=True)
class Window:
    """What is compared: times [s] between two, and what is told of them.

    parting: from when on the curves are compared by statistics. bands: edges [Hz], in which spectra are compared;
    empty: they are not. among: how many statistics are told together.
    """

    after: float
    until: float
    parting: Parting
    bands: Sequence[float] = ()
    among: int = 1


class ErrorOf(NamedTuple): ...
