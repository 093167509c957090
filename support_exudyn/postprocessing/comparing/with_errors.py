"""What a difference means beside the numerical errors of both numbers or curves."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from support_exudyn.postprocessing.figures.channels import error_over_time
from support_exudyn.simulation.result import Result

Values = npt.NDArray[np.float64]
UNKNOWN = "errors not known"


class BesideErrors(NamedTuple):
    """A difference, and the error that it may have: the sum of those of both sides; NaN or infinite: not known."""

    difference: float
    error: float

    @property
    def within(self) -> bool | None:
        """Whether the difference is no larger than the error; None if that is not known."""
        if not (math.isfinite(self.error) and math.isfinite(self.difference)):
            return None
        return abs(self.difference) <= self.error

    @property
    def times(self) -> float:
        """The difference as a multiple of the error: 0 of none, infinite beside an error of 0, NaN: not known."""
        if self.within is None:
            return math.nan
        if self.difference == 0.0:
            return 0.0
        return abs(self.difference) / self.error if self.error > 0.0 else math.inf

    def __str__(self) -> str:
        """In words: "within both errors", "larger: 3.1 times", "errors not known"."""
        if self.within is None:
            return UNKNOWN
        if self.within:
            return "within both errors"
        return f"larger: {self.times:.2g} times" if math.isfinite(self.times) else "larger; both errors are 0"


def beside_errors(first: float, second: float, first_error: float, second_error: float) -> BesideErrors:
    """The difference of two numbers, second less first, beside their errors; NaN: an error is not known."""
    return BesideErrors(second - first, first_error + second_error)


def numbers_beside_errors(
    first: Result, second: Result, after: float = 0.0, until: float = math.inf
) -> Mapping[str, BesideErrors]:
    """The numbers that both runs report between two times [s], see `Result.numbers`, by their names.

    Errors are not known if a run was made without an accuracy.
    """
    raise NotImplementedError


def curve_errors(result: Result, name: str) -> Values | None:
    """Numerical errors of a channel at each of its records, (n,), in its unit; None if the run has none.

    See `error_over_time`, which tells them record by record from the coarser runs. A record beside an impact may be
    the same in all runs by chance, because the impact lies just after it in all of them, while it is not in the
    limit. So each record is given the largest error within the time by which impacts until then are uncertain.
    """
    raise NotImplementedError
