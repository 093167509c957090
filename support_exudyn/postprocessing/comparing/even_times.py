"""A curve at equally spaced times, which spectra, correlations and resampling need."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.comparing.common_times import interpolated
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
EVEN = 1e-6  # share of the spacing by which times may be off
MOST = 2**22  # samples


class EvenSamples(NamedTuple):
    """A curve at equally spaced times.

    start, spacing: of the times [s]. values: (n,). resampled: whether it was interpolated by straight lines
    to these times.
    """

    start: float
    spacing: float
    values: Values
    resampled: bool


def even_samples(time: Values, values: Values, spacing: float | None = None) -> EvenSamples:
    """The known values of a curve, at equally spaced times.

    Arguments:
        time: [s], (n,), increasing. values: (n,); what is not known is bridged by a straight line.
        spacing: of the samples [s]; None: that of the times, the median.

    Raises InputError if fewer than two values are known, or if the samples would be more than `MOST`.
    """
    known = np.isfinite(values)
    time, values = time[known], values[known]
    if time.size < 2:
        raise InputError(f"{time.size} known values; allowed: a curve with at least 2")
    own = float(np.median(np.diff(time)))
    wanted = own if spacing is None else spacing
    count = int((time[-1] - time[0]) / wanted * (1.0 + EVEN) + EVEN) + 1
    if count > MOST:
        raise InputError(
            f"{count} samples of {wanted:g} s would be needed; allowed: at most {MOST}, so a shorter piece"
        )
    at = time[0] + wanted * np.arange(count)
    if count == time.size and float(np.abs(at - time).max()) <= EVEN * wanted:
        return EvenSamples(float(time[0]), wanted, values, False)
    found, _, _ = interpolated(time, values, np.minimum(at, time[-1]))
    return EvenSamples(float(time[0]), wanted, found, True)
