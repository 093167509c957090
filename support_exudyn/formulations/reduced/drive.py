"""What the drive does at an instant, from the formula of its segment."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.compiled import inlined
from support_exudyn.formulations.reduced.layout import A0, A1, A2, A3, AMPLITUDE, FREQUENCY, ORIGIN, WIDTH

Vector = npt.NDArray[np.float64]
Matrix = npt.NDArray[np.float64]


class Drive(NamedTuple):
    """Extension [m] of columns or turn [rad] of a crank, its speed and its acceleration."""

    extension: float
    speed: float
    acceleration: float


@inlined
def driven(segment: Vector, t: float) -> Drive:
    """What the drive does at time t [s] of a segment, see `layout`; also beyond its ends."""
    width = segment[WIDTH]
    x = (t - segment[ORIGIN]) / width
    a1, a2, a3 = segment[A1], segment[A2], segment[A3]
    extension = segment[A0] + x * (a1 + x * (a2 + x * a3))
    speed = (a1 + x * (2.0 * a2 + 3.0 * a3 * x)) / width
    acceleration = (2.0 * a2 + 6.0 * a3 * x) / (width * width)
    frequency = segment[FREQUENCY]
    if frequency != 0.0:  # of the segment: one branch for all times, and no cosine where none is needed
        amplitude = segment[AMPLITUDE]
        cosine, sine = math.cos(frequency * t), math.sin(frequency * t)
        extension = extension + amplitude * (1.0 - cosine)
        speed = speed + amplitude * frequency * sine
        acceleration = acceleration + amplitude * frequency * frequency * cosine
    return Drive(extension, speed, acceleration)
