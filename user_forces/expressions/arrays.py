"""Laws over whole time series: numpy arrays as expressions of `user_forces.expressions.scalar`."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from user_forces.expressions.scalar import Expression

NAMES = ("sqrt", "exp", "log", "tanh", "cos", "sin", "abs", "sign")
FUNCTIONS = {name: getattr(np, name) for name in NAMES}


def _operator(function: Callable[[Any, Any], Any], swapped: bool = False) -> Callable[[Array, Any], Array]:
    """The method of `Array` for an operator; swapped: with the array on its right."""

    def method(self: Array, other: Any) -> Array:
        sides = (_values(other), self.values) if swapped else (self.values, _values(other))
        return Array(function(*sides))

    return method


class Array(Expression):
    """Values of a quantity at many instants, shape (n,), with which a law computes as with a number."""

    __slots__ = ("values",)

    def __init__(self, values: npt.ArrayLike) -> None:
        self.values = np.asarray(values)

    def function(self, name: str) -> Array:
        """sqrt, exp, log, tanh, cos, sin, abs or sign of each."""
        return Array(FUNCTIONS[name](self.values))

    def hypotenuse(self, other: Expression | float) -> Array:
        """Square root of the sum of both squares."""
        return Array(np.hypot(self.values, _values(other)))

    def choose(self, yes: Expression | float, no: Expression | float) -> Array:
        """`yes` where this condition holds, else `no`; both have been evaluated."""
        return Array(np.where(self.values, _values(yes), _values(no)))

    def larger(self, other: Expression | float) -> Array:
        """The larger of both."""
        return Array(np.maximum(self.values, _values(other)))

    def smaller(self, other: Expression | float) -> Array:
        """The smaller of both."""
        return Array(np.minimum(self.values, _values(other)))

    __add__ = _operator(operator.add)
    __sub__ = _operator(operator.sub)
    __mul__ = _operator(operator.mul)
    __truediv__ = _operator(operator.truediv)
    __pow__ = _operator(operator.pow)
    __radd__ = _operator(operator.add, swapped=True)
    __rsub__ = _operator(operator.sub, swapped=True)
    __rmul__ = _operator(operator.mul, swapped=True)
    __rtruediv__ = _operator(operator.truediv, swapped=True)
    __lt__ = _operator(operator.lt)
    __le__ = _operator(operator.le)
    __gt__ = _operator(operator.gt)
    __ge__ = _operator(operator.ge)

    def __neg__(self) -> Array:
        return Array(-self.values)


def as_number(values: npt.ArrayLike) -> float:
    """An array where a law expects a number."""
    return cast(float, Array(values))


def values_of(result: float, count: int) -> npt.NDArray[np.float64]:
    """What a law computed, shape (count,); also if it did not depend on the arrays."""
    return np.broadcast_to(np.asarray(_values(result), dtype=np.float64), (count,))


def _values(item: Any) -> Any:
    return item.values if isinstance(item, Array) else item
