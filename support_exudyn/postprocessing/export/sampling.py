"""Which records of a run are written."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.selection import nearest
from user_forces.values.value import InputError, NonNegative, Positive, Value, Whole, value

MOST_FRAMES = 1_000_000


@value
class Sampling(Value):
    """The choice of the records that are written; all if nothing is said. Nothing between records is written.

    Arguments:
        every: one in so many records, >= 1.
        frames_per_second: or the records nearest to so many times a second of the run, > 0; where the records
            lie farther apart, each of them once.
        after, until: from which time to which [s], both included; None: to the end.
    """

    every: Annotated[Whole, Field(ge=1)] | None = None
    frames_per_second: Positive | None = None
    after: NonNegative = 0.0
    until: NonNegative | None = None

    @model_validator(mode="after")
    def _can_be(self) -> Sampling:
        if self.every is not None and self.frames_per_second is not None:
            raise ValueError(
                f"every = {self.every}, frames_per_second = {self.frames_per_second}: allowed: one of them"
            )
        if self.until is not None and self.until < self.after:
            raise ValueError(f"after = {self.after:g}, until = {self.until:g}: allowed: until >= after")
        return self

    def records(self, time: Series) -> list[int]:
        """Indexes into the times of all records (n,) [s].

        Raises InputError if no record lies between the times, or if frames are so many that they must be a
        mistake.
        """
        until = math.inf if self.until is None else self.until
        inside = np.flatnonzero((time >= self.after) & (time <= until))
        if not inside.size:
            raise InputError(
                f"after = {self.after:g}, until = {until:g}: no record lies there; "
                f"allowed: times of which some are between {time[0]:g} and {time[-1]:g} s"
            )
        if self.every is not None:
            inside = inside[:: self.every]
        if self.frames_per_second is not None:
            times, rate = time[inside], self.frames_per_second
            count = (times[-1] - times[0]) * rate
            if count > MOST_FRAMES:
                raise InputError(
                    f"frames_per_second = {rate:g}: {count:.3g} frames; allowed: up to {MOST_FRAMES}; every = "
                    "1 takes all records"
                )
            wanted = times[0] + np.arange(math.floor(count + 1e-9) + 1) / rate
            inside = inside[np.unique(nearest(times, wanted))]
        return [int(record) for record in inside]
