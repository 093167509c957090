"""Roots of functions of one variable.

scipy.optimize takes a third of a second to import, so that is left until a root is asked for.
"""

from collections.abc import Callable

RTOL = 8.881784197001252e-16  # four roundings, the least that is allowed


def bracketed_root(
    function: Callable[[float], float], low: float, high: float, xtol: float = 2e-12, rtol: float = RTOL
) -> float:
    """Root of a function between two places at which its signs differ, by Brent's method.

    Arguments:
        function: continuous, of one number.
        low, high: the places.
        xtol, rtol: allowed error, absolute and relative; rtol at least RTOL.

    Raises ValueError if the signs do not differ.
    """
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=xtol, rtol=rtol))
