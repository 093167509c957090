"""What all instruments have in common: a signal of a run is filtered, sampled, made noisy and rounded."""

from abc import ABC, abstractmethod
from typing import Annotated, ClassVar
from zlib import crc32

import numpy as np
from pydantic import Field

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.simulation.result import Result
from user_forces.values.units import Hertz
from user_forces.values.value import InputError, NonNegative, Positive, Value, Whole, value

CLOSE = 1e-6  # share of a period by which records that are evenly spaced may be off
RECORDS = 20  # in a period of a filter's corner frequency, at least


@value
class LowPass(Value):
    """A Butterworth filter as a device has it: causal, so that its output comes late.

    Gain at a frequency f: 1 / sqrt(1 + (f / corner)^(2 order)). Before the first record its input was as there.

    Arguments:
        order: 1 to 8; 1 is a resistor and a capacitor. 2 by default.
        corner: frequency at which the gain is 1 / sqrt(2) [Hz], > 0.
    """

    order: Annotated[Whole, Field(ge=1, le=8)] = 2
    corner: Hertz[Positive]

    @property
    def longest_period(self) -> float:
        """Time between records [s] that is just fine enough for it.

        A wave at the corner frequency loses 0.8 % of its height by the straight lines between such records,
        and 1.6 % where it is a derivative by them.
        """
        return 1.0 / (RECORDS * self.corner)

    def filtered(self, values: Series, period: float) -> Series:
        """The filter's output at the records (n, m), from its input there (n, m), straight lines between.

        For such an input it is exact. period: between records [s].
        """
        from scipy import signal  # takes a while to import

        time = 2.0 * np.pi * self.corner * period * np.arange(len(values))
        system = signal.butter(self.order, 1.0, analog=True)
        columns = [column[0] + signal.lsim(system, column - column[0], time)[1] for column in values.T]
        return np.stack(columns, axis=-1)


@value
class Instrument(Value, ABC):
    """A device on a machine.

        signal --> low-pass --> reading --> samples --> plus noise --> rounded to the resolution

    Arguments:
        rate: samples per second [Hz], > 0, 10 by default; the first at the start of the run.
        low_pass: filter before the samples are taken; None: there is none.
        noise: RMS of white, normally distributed noise, in the unit of the reading, >= 0, 0 by default.
        resolution: step of its digits, in the same unit, >= 0, 0 by default: digits without end.
    """

    UNIT: ClassVar[str]  # of the reading, in SI

    rate: Hertz[Positive] = 10.0
    low_pass: LowPass | None = None
    noise: NonNegative = 0.0
    resolution: NonNegative = 0.0

    @abstractmethod
    def signals(self, result: Result) -> Series:
        """The signals that act on it at every record, shape (n, m).

        Raises InputError if the run has not recorded them, or has no such part.
        """

    def reading(self, signals: Series) -> Series:
        """The reading (n,) of filtered signals (n, m); the first, unless an instrument defines another."""
        return signals[:, 0]


def samples(instrument: Instrument, name: str, result: Result, seed: int) -> tuple[Series, Series]:
    """The samples of an instrument: times (k,) [s] and readings (k,) in SI.

    Between two records a reading is on the straight line. A last record at a shorter distance is left out.

    Arguments:
        instrument: on the machine of the run. name: of it, which with the seed decides its noise.
        result: the run. seed: of the noise, >= 0.

    Raises InputError if the records are too far apart for the filter or the samples, or are not evenly spaced.
    """
    time, steps = result.time, np.diff(result.time)
    if time.size < 3:
        raise InputError(f"{name}: the run has {time.size} records; allowed: at least 3")
    period = float(steps[0])
    uneven = np.flatnonzero(np.abs(steps - period) > CLOSE * period)
    if uneven.size and uneven[0] < steps.size - 1:
        raise InputError(
            f"{name}: the records are {period:g} s apart, and {steps[uneven[0]]:g} s at t = "
            f"{time[uneven[0]]:g} s; allowed: runs with one record_period"
        )
    time = time[: time.size - uneven.size]
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
    signals = instrument.signals(result)[: len(time)]
    if low_pass is not None:
        signals = low_pass.filtered(signals, period)
    count = int(np.floor((time[-1] - time[0]) * instrument.rate * (1.0 + 1e-12))) + 1
    when = time[0] + np.arange(count) / instrument.rate
    values = np.interp(when, time, instrument.reading(signals))
    if instrument.noise:
        own = np.random.default_rng([seed, crc32(name.encode())])
        values = values + instrument.noise * own.standard_normal(values.size)
    if instrument.resolution:
        values = instrument.resolution * np.round(values / instrument.resolution) + 0.0  # no -0
    return when, values
