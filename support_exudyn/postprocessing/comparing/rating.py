"""The objective rating of ISO/TS 18571: how well a curve follows a reference, from 0 to 1."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[np.float64]


class IsoRating(NamedTuple):
    """Scores from 0 to 1: overall, and of corridor, phase, magnitude and slope; why one is NaN, by its name."""

    overall: float
    corridor: float
    phase: float
    magnitude: float
    slope: float
    not_told: Mapping[str, str]


def iso_rating(time: Values, reference: Values, other: Values) -> IsoRating:
    """The rating of a curve against a reference at common times [s]."""
    raise NotImplementedError
