"""Impacts that show in a curve of a contact force."""

import math

import numpy as np
import numpy.typing as npt

from user_forces.contact_state import Onset
from user_forces.values.value import InputError

Values = npt.NDArray[np.float64]
SHARE = 1e-3  # of the largest force, below which a contact carries none


def impacts_of_force(time: Values, force: Values, share: float = SHARE) -> tuple[Onset, ...]:
    """Impacts that show in the magnitude of a contact force: each rises from zero and falls back.

    An impact begins where the straight line between two records crosses the threshold upwards, and separates
    where it crosses downwards. One that goes on when the curve begins has no onset; one that goes on at its end
    has not separated. Records farther apart than an impact is long show several as one, or none. Speeds
    cannot be seen in a force: they are NaN.

    Arguments:
        time: [s], (n,), increasing. force: its magnitude, >= 0, in any unit, (n,); NaN where not known counts
        as
            no force.
        share: of the largest force, that is the threshold.

    Raises InputError if a force is negative, as a component would be.
    """
    known = np.where(np.isfinite(force), force, 0.0)
    if known.size and known.min() < 0.0:
        raise InputError(f"a force of {known.min():g}: allowed: magnitudes of a contact's force, from 0 on")
    level = share * float(known.max(initial=0.0))
    pressed = known > level
    up = np.flatnonzero(~pressed[:-1] & pressed[1:])
    down = np.flatnonzero(pressed[:-1] & ~pressed[1:])
    begins, ends = (_crossing(time, known, level, at) for at in (up, down))
    after = np.searchsorted(ends, begins)
    last = np.append(ends, math.inf)
    return tuple(
        Onset(float(begin), math.nan, float(last[n]), math.nan) for begin, n in zip(begins, after, strict=True)
    )


def _crossing(time: Values, force: Values, level: float, at: npt.NDArray[np.intp]) -> Values:
    way = (level - force[at]) / (force[at + 1] - force[at])
    found: Values = time[at] + way * (time[at + 1] - time[at])
    return found
