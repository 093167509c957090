"""The stationary block bootstrap: series like a given one, made of blocks of it of random lengths.

Sources: D. N. Politis and J. P. Romano, "The stationary bootstrap", J. Am. Stat. Assoc. 89 (1994) 1303-1313;
D. N. Politis and H. White, "Automatic block-length selection for the dependent bootstrap", Econometric Reviews
23 (2004) 53-70; A. Patton, D. N. Politis and H. White, correction to it, Econometric Reviews 28 (2009) 372-375.
"""

import math

import numpy as np
import numpy.typing as npt
from scipy import fft

Values = npt.NDArray[np.float64]
ROUNDING = 1e-14  # of the largest value, that a mean of equal values may differ by
BAND = 2.0  # correlations below BAND sqrt(log10(n) / n) are taken to be none


def block_length(values: Values) -> float:
    """The mean length of blocks, in samples, that is best for the mean of a series (Politis and White).

        b = (2 G^2 / D)^(1/3) n^(1/3),  G = sum h(k/M) |k| R(k),  D = 2 (sum h(k/M) R(k))^2

    with autocovariances R(k), both sums from -M to M, and the flat-top window h(x) = 1 up to 1/2, then
    2 (1 - |x|). M is twice the lag after which K = max(5, log10 n) correlations in a row are within
    2 sqrt(log10(n)/n). The length is at least 1 and at most min(3 sqrt n, n/3).

    values: (n,), of a stationary series at equal spacings.
    """
    count = values.size
    covariances, window = _flat_top(values)
    if not covariances[0] > 0.0:
        return 1.0
    k = np.arange(1, window.size)
    slope = 2.0 * float((window[1:] * k * covariances[1:]).sum())
    variance = _sum(covariances, window)
    longest = math.ceil(min(3.0 * math.sqrt(count), count / 3.0))
    if variance == 0.0:
        return float(longest)
    length = abs(slope / variance) ** (2.0 / 3.0) * count ** (1.0 / 3.0)
    return float(min(max(length, 1.0), longest))


def long_run_variance(values: Values) -> float:
    """n times the variance of a series' mean: the sum of autocovariances, by the window of `block_length`.

    The variance itself, where that sum is not positive. values: (n,).
    """
    covariances, window = _flat_top(values)
    found = _sum(covariances, window)
    return found if found > 0.0 else float(covariances[0])


def resampled(count: int, length: float, random: np.random.Generator) -> npt.NDArray[np.intp]:
    """Which samples a new series is made of: blocks that begin anywhere and go on, around the end, for lengths
    that are geometrically distributed.

    Arguments:
        count: of samples, n. length: mean of the blocks' lengths, at least 1.

    Returns:
        Indexes from 0 to n - 1, (n,).
    """
    begins = random.random(count) * length < 1.0
    begins[0] = True
    at = np.flatnonzero(begins)
    starts = random.integers(count, size=at.size)
    return np.asarray(
        (np.repeat(starts - at, np.diff(at, append=count)) + np.arange(count)) % count, dtype=np.intp
    )


def _flat_top(values: Values) -> tuple[Values, Values]:
    """Autocovariances R(0), R(1), ... R(M) and the window that they are weighted by."""
    count = values.size
    row = max(5, int(math.log10(count)))
    most = min(math.ceil(math.sqrt(count)) + row, count - 1)
    centred = values - values.mean()
    power = np.abs(fft.rfft(centred, fft.next_fast_len(count + most + 1, real=True))) ** 2
    covariances = fft.irfft(power, fft.next_fast_len(count + most + 1, real=True))[: most + 1] / count
    if not covariances[0] > (ROUNDING * float(np.abs(values).max())) ** 2:
        return np.zeros(1), np.ones(1)  # constant
    none = np.abs(covariances[1:]) < BAND * math.sqrt(math.log10(count) / count) * covariances[0]
    in_a_row = np.convolve(none, np.ones(row), "valid") == row  # [m]: those of lags m + 1 to m + row
    last = 2 * max(int(in_a_row.argmax()), 1) if in_a_row.any() else most
    last = min(last, most)
    share = np.arange(last + 1) / last
    return covariances[: last + 1], np.minimum(1.0, 2.0 * (1.0 - share))


def _sum(covariances: Values, window: Values) -> float:
    return float(covariances[0] + 2.0 * (window[1:] * covariances[1:]).sum())
