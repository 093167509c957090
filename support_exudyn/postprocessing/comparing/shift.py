"""By how much a curve lags behind another, by cross-correlation. It is told; nobody is shifted unasked."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[np.float64]


class TimeShift(NamedTuple):
    """By how much another curve lags behind a reference.

    shift: [s]; the other curve at t + shift is like the reference at t. Its times less the shift lay it on the
        reference.
    error: standard error of the shift [s], from what is left between both curves; see `time_shift`.
    correlation: of both curves when shifted, -1 to 1.
    next_best: the largest correlation at another shift that is a peak of its own; -1 if there is none.
    at_limit: whether the best shift is the largest that was looked at, so that a better one may lie beyond.
    """

    shift: float
    error: float
    correlation: float
    next_best: float
    at_limit: bool

    @property
    def is_sure(self) -> bool:
        """Whether no other shift is nearly as good, and the curves are alike at all."""
        raise NotImplementedError


def time_shift(
    reference_time: Values, reference: Values, other_time: Values, other: Values, most: float | None = None
) -> TimeShift:
    """The shift at which two curves correlate best.

    most: largest shift that is looked at [s], either way; None: a quarter of the shorter duration.
    """
    raise NotImplementedError
