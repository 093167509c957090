"""The low-pass filter of an instrument."""

from typing import Annotated

import numpy as np
from pydantic import Field

from support_exudyn.mechanics.trajectory import Series
from user_forces.values.units import Hertz
from user_forces.values.value import Positive, Value, Whole, value

RECORDS = 20  # in a period of the corner frequency, at least


@value
class LowPass(Value):
    """A Butterworth filter as a device has it: causal, so that what it passes comes late.

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

        speed = 2.0 * np.pi * self.corner
        time = speed * period * np.arange(len(values))
        system = signal.butter(self.order, 1.0, analog=True)
        found = np.empty_like(values)
        for n, column in enumerate(values.T):
            found[:, n] = column[0] + signal.lsim(system, column - column[0], time)[1]
        return found
