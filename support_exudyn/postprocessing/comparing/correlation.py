"""Correlation of two evenly sampled curves at every lag."""

import numpy as np
import numpy.typing as npt
from scipy import signal

Values = npt.NDArray[np.float64]
Lags = npt.NDArray[np.int64]
FLAT = 1e-12  # variance, of the square of the largest deviation, below which a piece is taken to be constant


def lagged_correlations(first: Values, second: Values, lags: Lags) -> Values:
    """Pearson's correlation of first[i] and second[i + lag] over all i at which both are, for each lag.

    Arguments:
        first, second: samples at one spacing, (n,) and (m,).
        lags: in samples, (k,).

    Returns:
        Values from -1 to 1, (k,); NaN where the curves overlap in fewer than two samples, or where one of them
        is constant there.
    """
    one, other = _scaled(first), _scaled(second)
    products = signal.correlate(other, one, method="fft")[lags + one.size - 1]
    start, end = np.maximum(0, -lags), np.minimum(one.size, other.size - lags)
    count = (end - start).astype(np.float64)
    pieces = []
    for values, shift in ((one, 0), (other, lags)):
        sums, squares = (np.concatenate(([0.0], np.cumsum(item))) for item in (values, values**2))
        pieces.append([item[end + shift] - item[start + shift] for item in (sums, squares)])
    (sum_one, square_one), (sum_other, square_other) = pieces
    with np.errstate(invalid="ignore", divide="ignore"):
        spread_one = square_one / count - (sum_one / count) ** 2
        spread_other = square_other / count - (sum_other / count) ** 2
        both = products / count - sum_one * sum_other / count**2
        known = (count >= 2.0) & (spread_one > FLAT) & (spread_other > FLAT)
        found: Values = np.where(known, both / np.sqrt(spread_one * spread_other), np.nan)
    return np.clip(found, -1.0, 1.0)


def _scaled(values: Values) -> Values:
    """About the mean, the largest magnitude 1."""
    centred = values - values.mean()
    size = float(np.abs(centred).max(initial=0.0))
    scaled: Values = centred / size if size > 0.0 else centred
    return scaled
