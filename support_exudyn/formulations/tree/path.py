"""The motion within the steps: the quintic that fits place, velocity and acceleration at both ends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix, Numbers

# In shorter steps [s] the quintic's slope has much rounding, and velocities are the cubic through velocities
# and accelerations; there both are right within 1e-9 m/s.
SHORT = 1e-5


@dataclass(frozen=True)
class Ends:
    """Coordinates, rates and accelerations (steps, n) at one end of every step."""

    position: Matrix
    velocity: Matrix
    acceleration: Matrix


def motion_within(
    start: Ends, end: Ends, step: Matrix, number: Numbers, fraction: Matrix
) -> tuple[Matrix, Matrix]:
    """Coordinates and rates at fractions (m,) of the steps with these numbers (m,); step: lengths (steps,) [s].

    Errors of sixth and fifth order in the step.
    """
    h, x = step[number][:, None], fraction[:, None]
    q0, v0, a0 = (item[number] for item in (start.position, h_times(start.velocity, step), _bent(start, step)))
    q1, v1, a1 = (item[number] for item in (end.position, h_times(end.velocity, step), _bent(end, step)))
    far, fast, bent = q1 - q0 - v0 - 0.5 * a0, v1 - v0 - a0, a1 - a0
    c3 = 10.0 * far - 4.0 * fast + 0.5 * bent
    c4 = -15.0 * far + 7.0 * fast - bent
    c5 = 6.0 * far - 3.0 * fast + 0.5 * bent
    position = q0 + x * (v0 + x * (0.5 * a0 + x * (c3 + x * (c4 + x * c5))))
    slope = v0 + x * (a0 + x * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)))
    y = 1.0 - x
    cubic = y * y * ((1.0 + 2.0 * x) * v0 + x * a0) + x * x * ((3.0 - 2.0 * x) * v1 - y * a1)
    return position, np.where(h < SHORT, cubic, slope) / h


def h_times(rate: Matrix, step: Matrix) -> Matrix:
    """A rate (steps, n) in units per step."""
    return np.asarray(rate * step[:, None])


def _bent(ends: Ends, step: Matrix) -> Matrix:
    return h_times(h_times(ends.acceleration, step), step)
