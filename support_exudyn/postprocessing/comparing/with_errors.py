"""What a difference means beside the numerical errors of both numbers or curves."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.simulation.result import Result

Values = npt.NDArray[np.float64]


class BesideErrors(NamedTuple):
    """A difference, and the error that it may have: the sum of those of both numbers; NaN: not known."""

    difference: float
    error: float

    @property
    def within(self) -> bool | None:
        """Whether the difference is no larger than the error; None if that is not known."""
        if math.isnan(self.error) or math.isnan(self.difference):
            return None
        return abs(self.difference) <= self.error

    @property
    def times(self) -> float:
        """The difference as a multiple of the error; NaN if that is not known, infinite if it is 0."""
        raise NotImplementedError

    def __str__(self) -> str:
        """In words: "within both errors", "larger: 3.1 times", "errors not known"."""
        raise NotImplementedError


def beside_errors(first: float, second: float, first_error: float, second_error: float) -> BesideErrors:
    """The difference of two numbers beside their errors; NaN: an error is not known."""
    return BesideErrors(second - first, first_error + second_error)


def curve_errors(result: Result, name: str) -> Values:
    """Numerical errors of a channel at each record, (n,), in its unit; NaN if the run has none."""
    raise NotImplementedError
