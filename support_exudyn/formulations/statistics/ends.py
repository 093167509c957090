"""Channels inside of steps of which the ends are known: cubics whose slopes follow from the steps beside.

At the end of a step the slope is that of the parabola through three ends. Where no end beside has a like bend,
as at a corner that nothing has told of, the slope is held back, so that no cubic goes beyond its ends.
"""

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.statistics.steps import NODES
from support_exudyn.mechanics.time_statistics import Series

LIKE = 0.25  # share of a bend that is enough of one beside it, if there is no corner
MONOTONE = 3.0  # times the lesser steepness: up to that slope a cubic does not go beyond its ends
INSIDE, LEAST = 1e-6, 4e-9  # shares of a step and of a time [s] by which times are taken beside a jump


def between_ends(time: Series, begins: npt.NDArray[np.bool_], values: Series) -> Series:
    """A channel (n,) at the nodes of the steps between times [s], (n - 1, 4); begins: see `RunStatistics`."""
    with np.errstate(divide="ignore", invalid="ignore"):
        length = np.diff(time)
        steep = np.where(begins[1:] | (length <= 0.0), 0.0, np.diff(values) / length)
        one, two, h, k = steep[:-1], steep[1:], length[:-1], length[1:]
        slope = (k * one + h * two) / (h + k)
        inner = ~begins[1:-1] & ~begins[2:]  # there is a step before and one behind
        less = MONOTONE * np.minimum(np.abs(one), np.abs(two))
        held = np.where(one * two > 0.0, np.sign(one) * np.minimum(np.abs(slope), less), 0.0)
        slope = np.where(inner, np.where(_bends_alike((two - one) / (h + k), inner), slope, held), 0.0)
        # where a piece begins or ends the parabola goes on from its other two ends
        first, last = np.append(steep, 0.0), np.append(0.0, steep)
        first[:-2] = np.where(inner & begins[:-2], 2.0 * one - slope, first[:-2])
        last[2:] = np.where(inner, 2.0 * two - slope, last[2:])
    left, right = first[:-1], last[1:]
    left[1:] = np.where(inner, slope, left[1:])
    right[:-1] = np.where(inner, slope, right[:-1])
    x, y = NODES, 1.0 - NODES
    ends = np.outer(values[:-1], y * y * (1.0 + 2.0 * x)) + np.outer(values[1:], x * x * (1.0 + 2.0 * y))
    return ends + np.outer(length * left, x * y * y) - np.outer(length * right, x * x * y)


def _bends_alike(bend: Series, inner: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Whether an end beside has a like bend; so if none beside has any, in a piece of two steps."""
    beside, there = np.pad(np.where(inner, bend, 0.0), 1), np.pad(inner, 1)
    alike = [np.sign(bend) * one >= LIKE * np.abs(bend) for one in (beside[:-2], beside[2:])]
    return np.asarray(alike[0] | alike[1] | ~(there[:-2] | there[2:]))


def beside_jumps(time: Series, begins: npt.NDArray[np.bool_]) -> Series:
    """Times of ends of steps [s], those before and after something jumps taken a little to their side."""
    found, length = time.copy(), np.diff(time, append=time[-1], prepend=time[0])
    for beside, sign, rows in ((length[1:], 1.0, begins), (length[:-1], -1.0, np.append(begins[1:], False))):
        aside = np.minimum(np.maximum(INSIDE * beside, LEAST * np.maximum(1.0, time)), 0.5 * beside)
        found += np.where(rows & (beside > 0.0), sign * aside, 0.0)
    return found
