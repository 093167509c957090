"""What all instruments have in common: a signal of a run is filtered, sampled, made noisy and rounded."""

from abc import ABC, abstractmethod
from typing import ClassVar
from zlib import crc32

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.instruments.low_pass import LowPass
from support_exudyn.simulation.result import Result
from user_forces.values.units import Hertz
from user_forces.values.value import InputError, NonNegative, Positive, Value, value

CLOSE = 1e-6  # share of a period by which records that are evenly spaced may be off


@value
class Instrument(Value, ABC):
    """A device on a machine.

        signal --> low-pass --> reading --> samples --> plus noise --> rounded to the resolution

    Arguments:
        rate: samples per second [Hz], > 0, 10 by default; the first at the start of the run.
        low_pass: filter before the samples are taken; None: there is none.
        noise: RMS of white, normally distributed noise, in the unit of what it reads, >= 0, 0 by default.
        resolution: step of its digits, in the same unit, >= 0, 0 by default: digits without end.
    """

    UNIT: ClassVar[str]  # of what it reads, in SI

    rate: Hertz[Positive] = 10.0
    low_pass: LowPass | None = None
    noise: NonNegative = 0.0
    resolution: NonNegative = 0.0

    @abstractmethod
    def signals(self, result: Result) -> Series:
        """What it feels at every record, shape (n, m).

        Raises InputError if the run has not recorded it, or has no such part.
        """

    def reading(self, signals: Series) -> Series:
        """What it shows (n,) of filtered signals (n, m); the first, unless it says otherwise."""
        return signals[:, 0]


def samples(instrument: Instrument, name: str, result: Result, seed: int) -> tuple[Series, Series]:
    """The samples of an instrument: times (k,) [s] and readings (k,) in SI.

    Between two records a reading is on the straight line.

    Arguments:
        instrument: on the machine of the run. name: of it, which with the seed decides its noise.
        result: the run. seed: of the noise, >= 0.

    Raises InputError if the records are too far apart for the filter or the samples, or are not evenly spaced.
    """
    time, period = _even(result.time, name)
    _check_fine(instrument, name, period)
    signals = instrument.signals(result)[: len(time)]
    if instrument.low_pass is not None:
        signals = instrument.low_pass.filtered(signals, period)
    count = int(np.floor((time[-1] - time[0]) * instrument.rate * (1.0 + 1e-12))) + 1
    when = time[0] + np.arange(count) / instrument.rate
    values = np.interp(when, time, instrument.reading(signals))
    if instrument.noise:
        own = np.random.default_rng([seed, crc32(name.encode())])
        values = values + instrument.noise * own.standard_normal(values.size)
    if instrument.resolution:
        values = instrument.resolution * np.round(values / instrument.resolution) + 0.0  # no -0
    return when, values


def _even(time: Series, name: str) -> tuple[Series, float]:
    """The records that are evenly spaced, all but perhaps the last, and the time between them [s]."""
    steps = np.diff(time)
    if time.size < 3:
        raise InputError(f"{name}: the run has {time.size} records; allowed: at least 3")
    uneven = np.flatnonzero(np.abs(steps - steps[0]) > CLOSE * steps[0])
    if uneven.size and uneven[0] < steps.size - 1:
        raise InputError(
            f"{name}: the records are {steps[0]:g} s apart, and {steps[uneven[0]]:g} s at t = "
            f"{time[uneven[0]]:g} s; allowed: runs with one record_period"
        )
    return time[: steps.size - uneven.size + 1], float(steps[0])


def _check_fine(instrument: Instrument, name: str, period: float) -> None:
    low_pass = instrument.low_pass
    if low_pass is not None and period > low_pass.longest_period * (1.0 + CLOSE):
        raise InputError(
            f"{name}: low_pass.corner = {low_pass.corner:g} Hz: the records are {period:g} s apart, too "
            f"far for it; allowed: runs with record_period <= {low_pass.longest_period:g} s, or a corner up to "
            f"{low_pass.corner * low_pass.longest_period / period:g} Hz"
        )
    if instrument.rate * period > 1.0 + CLOSE:
        raise InputError(
            f"{name}: rate = {instrument.rate:g} Hz: the records are {period:g} s apart; allowed: up to "
            f"{1.0 / period:g} Hz, or runs with a shorter record_period"
        )
