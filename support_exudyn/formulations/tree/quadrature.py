"""Integrals over time of what is known at five points of every step (Gauss-Lobatto, exact to degree 7)."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from support_exudyn.formulations.tree.branches import Matrix, Numbers

POINTS = 0.5 + 0.5 * np.array([-1.0, -math.sqrt(3.0 / 7.0), 0.0, math.sqrt(3.0 / 7.0), 1.0])
# of the steps that are looked at for the top: highest point as a share of the highest of all, and how many
NEAR_TOP, MOST_TOPS = 0.98, 20
SAMPLES, NARROWINGS = 17, 5  # each to an eighth of what is left
Look = Callable[[Numbers, Matrix], Matrix]
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


def largest(values: Matrix, look: Look) -> float:
    """The top of a quantity, at least 0, which may be a corner.

    Of the steps whose highest point is near the highest of all, what is around it is looked at ever closer.

    Arguments:
        values: at the points of every step, shape (steps, 5).
        look: the quantity at fractions (m,) of the steps with these numbers (m,).
    """
    if not (values > 0.0).any():
        return 0.0
    highest = values.max(axis=1)
    steps = np.flatnonzero(highest >= NEAR_TOP * highest.max())
    steps = steps[np.argsort(highest[steps])][-MOST_TOPS:]
    point = values[steps].argmax(axis=1)
    low, high = POINTS[np.maximum(point - 1, 0)], POINTS[np.minimum(point + 1, len(POINTS) - 1)]
    each, top = np.arange(len(steps)), float(highest.max())
    for _ in range(NARROWINGS):
        x = low + (high - low) * np.linspace(0.0, 1.0, SAMPLES)[:, None]
        found = look(np.tile(steps, SAMPLES), x.ravel()).reshape(x.shape)
        best = found.argmax(axis=0)
        low, high = x[np.maximum(best - 1, 0), each], x[np.minimum(best + 1, SAMPLES - 1), each]
        top = max(top, float(found.max()))
    return top
