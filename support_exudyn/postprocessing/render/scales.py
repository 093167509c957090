"""Round numbers for scales."""

from __future__ import annotations

import math

import numpy as np

from support_exudyn.mechanics.trajectory import Series

STEPS = (1.0, 2.0, 5.0, 10.0)
MOST = 0.97  # share of forces that arrows and axes are made for; what is beyond is cut


def round_up(number: float) -> float:
    """The next of ..., 1, 2, 5, 10, ...; 1 for what is not above 0."""
    if not number > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(number))
    return next(step * power for step in STEPS if step * power >= number * (1.0 - 1e-9))


def round_down(number: float) -> float:
    """The last of ..., 1, 2, 5, 10, ... that is not above it; 1 for what is not above 0."""
    if not number > 0.0:
        return 1.0
    up = round_up(number)
    if up <= number * (1.0 + 1e-9):
        return up
    power = 10.0 ** math.floor(math.log10(number))
    return max(step * power for step in STEPS if step * power <= number)


def usual(sizes: Series) -> float:
    """A size that nearly all, without those that are 0, do not exceed; 1 if there are none."""
    there = sizes[sizes > 0.0]
    return float(np.quantile(there, MOST)) if there.size else 1.0


def said(number: float) -> str:
    """A round number as it is written."""
    return f"{number:,.0f}".replace(",", " ") if number >= 1.0 else f"{number:g}"
