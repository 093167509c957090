"""How strongly a curve varies in bands of frequency; the squares of all bands add up to its variance."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy import fft, signal

from support_exudyn.postprocessing.comparing.even_times import even_samples
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
MOST_BANDS = 64
ROUNDING = 1e-9  # of times, and so of frequencies


class BandRms(NamedTuple):
    """RMS values of a curve in bands of frequency, in the unit of the curve.

    edges: of the bands [Hz], (n + 1,), from 0 to half the sampling frequency. rms: in each band, (n,).
    line: RMS of the straight line, about its mean, that was taken off before: it has no frequency.
    resampled: whether the curve had to be interpolated to equally spaced times.
    """

    edges: Values
    rms: Values
    line: float
    resampled: bool

    @property
    def total(self) -> float:
        """RMS of all of it about its mean: the square root of the sum of all squares."""
        return math.hypot(self.line, *self.rms)


def band_rms(time: Values, values: Values, edges: Sequence[float] | None = None) -> BandRms:
    """RMS of a curve in bands of frequency, by Parseval's theorem.

    The straight line that fits best is taken off, else its jump from the end to the start would fill all bands.
    X_k being the discrete Fourier transform of what is left, the n samples' mean square is the sum of
    |X_k|^2 / n^2 over all k. A line k counts in the band that has its frequency k / (n spacing), lowest edge
    included. There is no window, so a tone that does not fit the duration leaks into bands beside its own.

    Arguments:
        time: [s], (n,), increasing. values: (n,).
        edges: [Hz], increasing, between 0 and half the sampling frequency; 0 and that are added if they are
            missing, so that every frequency has a band. None: octaves, see `octaves`.

    Raises InputError if fewer than 4 values are known, or if the edges do not fit.
    """
    samples = even_samples(time, values)
    count = samples.values.size
    if count < 4:
        raise InputError(f"{count} known values; allowed: at least 4 for a spectrum")
    highest = 0.5 / samples.spacing
    chosen = octaves(1.0 / (count * samples.spacing), highest) if edges is None else np.asarray(edges, float)
    whole = _whole(chosen, highest)
    rest = signal.detrend(samples.values)
    line = samples.values - rest
    lines = np.abs(fft.rfft(rest) / count) ** 2
    lines[1 : (count + 1) // 2] *= 2.0  # those of negative frequencies, too
    band = np.searchsorted(whole, fft.rfftfreq(count, samples.spacing), "right") - 1
    squares = np.bincount(np.minimum(band, whole.size - 2), lines, whole.size - 1)
    return BandRms(whole, np.sqrt(squares), float(line.std()), samples.resampled)


def octaves(lowest: float, highest: float) -> Values:
    """Edges of octaves [Hz]: powers of two times 1000/sqrt(2) Hz, as in IEC 61260, that lie between two."""
    first = math.ceil(math.log2(lowest * math.sqrt(2.0) / 1000.0))
    last = math.floor(math.log2(highest * math.sqrt(2.0) / 1000.0))
    found: Values = 1000.0 / math.sqrt(2.0) * np.exp2(np.arange(first, last + 1, dtype=float))
    return found


def _whole(edges: Values, highest: float) -> Values:
    if edges.size > MOST_BANDS:
        raise InputError(f"{edges.size} edges of bands; allowed: at most {MOST_BANDS}")
    inside = (edges >= 0.0) & (edges <= highest * (1.0 + ROUNDING))
    if not (inside.all() and (np.diff(edges) > 0.0).all()):
        raise InputError(
            f"edges of bands = {edges.tolist()} Hz; allowed: increasing ones from 0 to {highest:g} Hz, half "
            "the sampling frequency"
        )
    return np.concatenate(([0.0], edges[(edges > 0.0) & (edges < highest * (1.0 - ROUNDING))], [highest]))
