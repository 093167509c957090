"""Roots of functions of one variable.

Brent's method is written out here, operation by operation as `scipy.optimize.brentq` has it, so that it gives
the same root to the bit: importing scipy.optimize takes longer than all that a run asks of it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

RTOL = 8.881784197001252e-16  # four roundings, the least that is allowed
STEPS = 100  # the most that are tried


class _Tried(NamedTuple):
    """A place and the function there."""

    at: float
    value: float


def bracketed_root(
    function: Callable[[float], float], low: float, high: float, xtol: float = 2e-12, rtol: float = RTOL
) -> float:
    """Root of a function between two places at which its signs differ, by Brent's method.

    Arguments:
        function: continuous, of one number.
        low, high: the places.
        xtol, rtol: allowed error, absolute and relative; rtol at least RTOL.

    Raises ValueError if the signs do not differ or the function is no number somewhere between, RuntimeError if
    the root is not found in STEPS steps.
    """
    before, now = _tried(function, low), _tried(function, high)
    for end in (before, now):
        if end.value == 0.0:
            return end.at
    if (before.value < 0.0) == (now.value < 0.0):
        raise ValueError("the signs at both places must differ")
    across = before  # the last place on the other side of the root
    step = last = now.at - before.at
    for _ in range(STEPS):
        if before.value != 0.0 and now.value != 0.0 and (before.value < 0.0) != (now.value < 0.0):
            across = before
            step = last = now.at - before.at
        if abs(across.value) < abs(now.value):
            before, now, across = now, across, now
        enough = (xtol + rtol * abs(now.at)) / 2.0
        half = (across.at - now.at) / 2.0
        if now.value == 0.0 or abs(half) < enough:
            return now.at
        guess = None
        if abs(last) > enough and abs(now.value) < abs(before.value):
            guess = _guess(before, now, across)
        if guess is not None and 2.0 * abs(guess) < min(abs(last), 3.0 * abs(half) - enough):
            last, step = step, guess
        else:
            last = step = half
        further = step if abs(step) > enough else enough if half > 0.0 else -enough
        before, now = now, _tried(function, now.at + further)
    raise RuntimeError(f"no root after {STEPS} steps, last at {now.at:.9g}")


def _tried(function: Callable[[float], float], at: float) -> _Tried:
    value = float(function(at))
    if value != value:
        raise ValueError(f"the function is no number at {at:.9g}")
    return _Tried(float(at), value)


def _guess(before: _Tried, now: _Tried, across: _Tried) -> float | None:
    """The step to where a line or a parabola through what was tried is zero; None if there is no such place."""
    if before.at == across.at:
        return -now.value * (now.at - before.at) / (now.value - before.value)
    near = (before.value - now.value) / (before.at - now.at)
    far = (across.value - now.value) / (across.at - now.at)
    share = far * near * (across.value - before.value)
    return -now.value * (across.value * far - before.value * near) / share if share else None
