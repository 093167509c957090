"""What lies within the steps of a run: the motion, integrals over time, the top of a quantity.

The motion is the quintic that fits place, velocity and acceleration at both ends of a step. Integrals are of
what is known at five points of every step (Gauss-Lobatto, exact to degree 7).
"""

import math
from collections.abc import Callable
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


POINTS = 0.5 + 0.5 * np.array([-1.0, -math.sqrt(3.0 / 7.0), 0.0, math.sqrt(3.0 / 7.0), 1.0])
# of the steps that are looked at for the top: highest point as a share of the highest of all, and how many
NEAR_TOP, MOST_TOPS = 0.98, 20
SAMPLES, NARROWINGS = 17, 5  # each to an eighth of what is left
Look = Callable[[Numbers, Matrix], Matrix]
# row k: coefficients of the polynomial, by power of the fraction, that is 1 at point k and 0 at the others
_SHAPES = np.linalg.inv(np.vander(POINTS, increasing=True)).T


def weights(fraction: Matrix) -> Matrix:
    """Weights of the points for the integral up to fractions (m,) of a step of length 1; shape (m, 5)."""
    powers = fraction[:, None] ** np.arange(1, 6) / np.arange(1, 6)
    return np.asarray(powers @ _SHAPES.T)


def running(values: Matrix, step: Matrix, number: Numbers, fraction: Matrix) -> Matrix:
    """Integrals from the start of the run.

    Arguments:
        values: of k quantities at the points of every step, shape (k, steps, 5).
        step: lengths (steps,) [s].
        number, fraction: step, and how far within it, of the times up to which it is integrated (m,).

    Returns shape (k, m).
    """
    whole = np.cumsum(values @ weights(np.ones(1))[0] * step, axis=1)
    before = np.concatenate([np.zeros((len(values), 1)), whole], axis=1)[:, number]
    part = np.einsum("kmp,mp->km", values[:, number], weights(fraction)) * step[number]
    return np.asarray(before + part)


def largest(values: Matrix, look: Look) -> tuple[float, int]:
    """The top of a quantity, at least 0, which may be a corner; and the number of the step that has it.

    Of the steps whose highest point is near the highest of all, what is around it is looked at ever closer.

    Arguments:
        values: at the points of every step, shape (steps, 5).
        look: the quantity at fractions (m,) of the steps with these numbers (m,).
    """
    if not (values > 0.0).any():
        return 0.0, 0
    highest = values.max(axis=1)
    steps = np.flatnonzero(highest >= NEAR_TOP * highest.max())
    steps = steps[np.argsort(highest[steps])][-MOST_TOPS:]
    point = values[steps].argmax(axis=1)
    low, high = POINTS[np.maximum(point - 1, 0)], POINTS[np.minimum(point + 1, len(POINTS) - 1)]
    each, top, at = np.arange(len(steps)), float(highest.max()), int(highest.argmax())
    for _ in range(NARROWINGS):
        x = low + (high - low) * np.linspace(0.0, 1.0, SAMPLES)[:, None]
        found = look(np.tile(steps, SAMPLES), x.ravel()).reshape(x.shape)
        best = found.argmax(axis=0)
        low, high = x[np.maximum(best - 1, 0), each], x[np.minimum(best + 1, SAMPLES - 1), each]
        if (more := float(found.max())) > top:
            top, at = more, int(steps[found.max(axis=0).argmax()])
    return top, at
