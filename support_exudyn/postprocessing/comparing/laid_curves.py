"""A channel of two files laid on common times, and numbers of both with the numerical errors of the runs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.common_times import CommonCurves, on_common_times
from support_exudyn.postprocessing.comparing.compared_file import ComparedFile
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
Measure = Callable[[CommonCurves], float]


@dataclass(frozen=True)
class LaidCurves:
    """A channel of a reference and of another file at the times between two [s] at which both are known.

    unit: in SI, of all values.
    """

    reference: ComparedFile
    other: ComparedFile
    channel: str
    unit: str
    after: float = -math.inf
    until: float = math.inf
    _found: dict[tuple[int, int], CommonCurves] = field(default_factory=dict, repr=False, compare=False)

    @property
    def common(self) -> CommonCurves:
        """Both curves. Raises InputError if they do not overlap, or if a unit is not known or does not fit."""
        return self._laid(self.reference, self.other)

    def estimate(self, measure: Measure) -> Estimate:
        """A number of both curves with its numerical error: the sum of those that the runs are known to have.

        The error is NaN if none of both has one that is known.
        """
        known = [
            error
            for error in (
                _error(self.reference, lambda run: measure(self._laid(run, self.other))),
                _error(self.other, lambda run: measure(self._laid(self.reference, run))),
            )
            if error is not None
        ]
        return Estimate(measure(self.common), sum(known) if known else math.nan, self.unit)

    @property
    def with_errors(self) -> tuple[str, ...]:
        """Names of the files whose numerical errors are known."""
        return tuple(one.name for one in (self.reference, self.other) if one.has_errors)

    def errors(self) -> Values:
        """Numerical errors of the difference at the common times, (n,): the sum of those known; NaN of none.

        Between the records of a run the errors are joined by straight lines. What interpolation of the curves
        may add is part of it.
        """
        common = self.common
        sides = [one for one in (self.reference, self.other) if one.has_errors]
        if not sides:
            return np.full(common.time.size, math.nan)
        total = np.zeros(common.time.size) + common.interpolation_error
        for side in sides:
            total += _joined(common.time, side.time(self.channel), side.errors(self.channel))
        return total

    def _laid(self, reference: ComparedFile, other: ComparedFile) -> CommonCurves:
        key = id(reference.run), id(other.run)
        if key not in self._found:
            try:
                self._found[key] = on_common_times(
                    reference.time(self.channel),
                    reference.values(self.channel, self.unit),
                    other.time(self.channel),
                    other.values(self.channel, self.unit),
                    self.after,
                    self.until,
                )
            except InputError as error:
                raise InputError(f"{self.channel} of {reference.name} and {other.name}: {error}") from None
        return self._found[key]


def _joined(at: Values, time: Values, errors: Values) -> Values:
    """Errors (n,) at other times (m,) [s], joined by straight lines; infinite beside those that are."""
    endless = np.isinf(errors)
    finite = np.interp(at, time, np.where(endless, 0.0, errors))
    return np.where(np.interp(at, time, endless.astype(float)) > 0.0, math.inf, finite)


def _error(file: ComparedFile, measure: Callable[[ComparedFile], float]) -> float | None:
    """The numerical error of a number by the coarser runs of a file; None if it has none."""
    if file.run is None or not file.has_errors:
        return None
    same = {id(file.run): file}

    def of(run: Result) -> float:
        return measure(same.setdefault(id(run), file.of(run)))

    return file.run.estimate(of).error
