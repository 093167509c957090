"""Second derivatives of drives, which say only how far they are and how fast."""

from bisect import bisect_left
from collections.abc import Sequence

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.drives.drive import Drive

# [s] over which speeds are compared: no drive changes so fast, and rounding of speeds is far less. A power of
# two, so that times of a fine grid have no rounding late in a run that they do not have early.
BACK = 2.0**-17
PARTS = 4.0  # of the time since the last break, of which three are compared
CLOSE = 1e-9  # [s] and share of its time by which a break is the same time


def accelerations(drive: Drive, time: Series, duration: float) -> Series:
    """Rate of a drive's speed at times from 0 on [s], (n,) [m/s^2], [rad/s^2].

        (11 v(t) - 18 v(t - d) + 9 v(t - 2 d) - 2 v(t - 3 d)) / (6 d)

    At a break it is the value before it. duration: of the run [s].
    """
    if drive.span(duration) == (0.0, 0.0):
        return np.zeros_like(time)
    breaks, found = sorted(drive.breaks), []
    for t in time.tolist():
        if t <= 0.0:  # from times after the start; before one that is a break nothing has been accelerated
            d = min([BACK, *(b / PARTS for b in breaks if b > 0.0)])
            change = _difference(drive.initial_speed, *(drive.speed(n * d) for n in (1, 2, 3)))
            found.append(0.0 if 0.0 in breaks else -change / d)
            continue
        close = CLOSE * max(1.0, t)
        place = bisect_left(breaks, t - close)
        if place < len(breaks) and breaks[place] <= t + close:
            t = breaks[place]  # beyond it the speed may be another
        d = min(BACK, (t - (breaks[place - 1] if place else 0.0)) / PARTS)
        found.append(_difference(drive.speed(t), *(drive.speed(t - n * d) for n in (1, 2, 3))) / d)
    return np.array(found)


def accelerations_of(drives: Sequence[Drive], time: Series, duration: float) -> list[Series]:
    """`accelerations` of several drives, which often are the same: computed once for all that are equal."""
    found: list[Series] = []
    for drive in drives:
        first = drives.index(drive)
        found.append(found[first] if first < len(found) else accelerations(drive, time, duration))
    return found


def _difference(last: float, first: float, second: float, third: float) -> float:
    """Change of the cubic through four speeds, counted back from the last, in a step up to that."""
    return (11.0 * last - 18.0 * first + 9.0 * second - 2.0 * third) / 6.0
