"""How long steps are: by their error, and to end where something happens."""

import math

from support_exudyn.scene.compilation import compiled

SAFETY, SLOWEST, FASTEST = 0.9, 0.2, 8.0  # change of the step: margin, smallest and largest factor
SHORTEN = 0.25  # factor for a step in which too much happens
STEADY = 0.04  # weight of the last error in the choice of a step (Gustafsson), against hunting
ORDER = 0.2 - 0.75 * STEADY
SMALLEST_STEP = 1e-13  # [s]
# Of the step before an impact is the first in it: forces begin as a broken power of time, over which a long
# step is of low order, so that errors would not fall as the tolerance does
AFTER_IMPACT = 0.01
LANDED = 1e-14  # depth [m] at which an impact or separation is met; rounding of the posture is some 1e-16
LANDINGS = 12
CLOSE = 1e-12  # [s]: a record that lies so little behind the end of a step belongs to it


@compiled
def factor(error: float, before: float) -> float:
    """By which the next step may be longer than one with this error, in units of what is allowed."""
    if not error < 1e30:
        return SLOWEST
    wanted: float = SAFETY * max(error, 1e-9) ** -ORDER * before**STEADY
    return min(FASTEST, max(SLOWEST, wanted))


@compiled
def factor_over_corner(error: float) -> float:
    """By which a step is shorter that is made again because of a corner within it: an error of order 2."""
    return max(SLOWEST, SAFETY / math.sqrt(error)) if error < 1e30 else SLOWEST
