"""Integrals over time of what is known at five points of every step (Gauss-Lobatto, exact to degree 7)."""

from __future__ import annotations

import math

import numpy as np

from support_exudyn.tree.branches import Matrix, Numbers

POINTS = 0.5 + 0.5 * np.array([-1.0, -math.sqrt(3.0 / 7.0), 0.0, math.sqrt(3.0 / 7.0), 1.0])
# row k: coefficients of the polynomial, by power of the fraction, that is 1 at point k and 0 at the others
_SHAPES = np.linalg.inv(np.vander(POINTS, increasing=True)).T


def weights(fraction: Matrix) -> Matrix:
    """Of the points, for the integral from the start to fractions (m,) of a step of length 1; shape (m, 5)."""
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


def largest(values: Matrix) -> float:
    """The top of a quantity given at the points of every step, shape (steps, 5), at least 0.

    That of the parabola through the highest point of a step and its neighbours in it.
    """
    if values.size == 0:
        return 0.0
    step, point = np.unravel_index(int(np.argmax(values)), values.shape)
    middle = min(max(int(point), 1), len(POINTS) - 2)
    x, y = POINTS[middle - 1 : middle + 2], values[step, middle - 1 : middle + 2]
    bend, slope, at_zero = np.polyfit(x, y, 2)
    top = -0.5 * slope / bend if bend < 0.0 else math.inf
    reached = at_zero - 0.25 * slope**2 / bend if x[0] <= top <= x[2] else 0.0
    return max(0.0, float(values.max()), float(reached))
