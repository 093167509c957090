"""The largest contact force inside a step whose ends are known.

Laws have corners, where what limits the damping changes: between the ends of steps a force can be larger than
at either, by a share of the step and not of its square.
"""

import math
from collections.abc import Callable

PEAK_SAMPLES = 8  # parts of a step between which the force is looked at
NEAR_PEAK = 0.8  # share of the largest force so far from which a step is looked at more closely
NEAR_TOP = 0.98  # and of which its largest sample is, if the top between two is looked for
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)  # by golden section: share that is left of an interval
NARROWINGS = 24  # to 1e-5 of it
NEXT_TO_END, ABOVE = 1e-3, 1e-10  # share of a step; and of a force, that is more than rounding


def has_a_top(size: Callable[[float], float], first: float, last: float) -> bool:
    """Whether a force is larger inside a step than at its ends: where it falls towards the larger one [N]."""
    if last >= first:
        return size(1.0 - NEXT_TO_END) > (1.0 + ABOVE) * last
    return size(NEXT_TO_END) > (1.0 + ABOVE) * first


def peak(size: Callable[[float], float], largest: float) -> float:
    """The largest force [N] so far, a step included; size: the force's magnitude at fractions of the step.

    Like `compiled.recording.peak`: that at points between the ends, and the highest between these, which may
    be a corner.
    """
    sizes = [size(n / PEAK_SAMPLES) for n in range(PEAK_SAMPLES + 1)]
    top = max(sizes)
    if top <= NEAR_TOP * largest:
        return largest
    at = sizes.index(top)
    low, high = max(0.0, (at - 1) / PEAK_SAMPLES), min(1.0, (at + 1) / PEAK_SAMPLES)
    one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_one, at_other = size(one), size(other)
    for _ in range(NARROWINGS):
        top = max(top, at_one, at_other)
        if at_one > at_other:
            high, other, at_other = other, one, at_one
            one = high - GOLDEN * (high - low)
            at_one = size(one)
        else:
            low, one, at_one = one, other, at_other
            other = low + GOLDEN * (high - low)
            at_other = size(other)
    return max(largest, top)
