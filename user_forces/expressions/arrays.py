"""Laws over whole time series: numpy arrays as expressions of `user_forces.expressions.scalar`."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
import numpy.typing as npt

from user_forces.expressions.scalar import Expression

NAMES = ("sqrt", "exp", "log", "tanh", "cos", "sin", "abs", "sign")
FUNCTIONS = {name: getattr(np, name) for name in NAMES}


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

    def __add__(self, other: Any) -> Array:
        return Array(self.values + _values(other))

    def __radd__(self, other: Any) -> Array:
        return Array(_values(other) + self.values)

    def __sub__(self, other: Any) -> Array:
        return Array(self.values - _values(other))

    def __rsub__(self, other: Any) -> Array:
        return Array(_values(other) - self.values)

    def __mul__(self, other: Any) -> Array:
        return Array(self.values * _values(other))

    def __rmul__(self, other: Any) -> Array:
        return Array(_values(other) * self.values)

    def __truediv__(self, other: Any) -> Array:
        return Array(self.values / _values(other))

    def __rtruediv__(self, other: Any) -> Array:
        return Array(_values(other) / self.values)

    def __pow__(self, exponent: float) -> Array:
        return Array(self.values**exponent)

    def __neg__(self) -> Array:
        return Array(-self.values)

    def __lt__(self, other: Any) -> Array:
        return Array(self.values < _values(other))

    def __le__(self, other: Any) -> Array:
        return Array(self.values <= _values(other))

    def __gt__(self, other: Any) -> Array:
        return Array(self.values > _values(other))

    def __ge__(self, other: Any) -> Array:
        return Array(self.values >= _values(other))


def as_number(values: npt.ArrayLike) -> float:
    """An array where a law expects a number."""
    return cast(float, Array(values))


def values_of(result: float, count: int) -> npt.NDArray[np.float64]:
    """What a law computed, shape (count,); also if it did not depend on the arrays."""
    return np.broadcast_to(np.asarray(_values(result), dtype=np.float64), (count,))


def _values(item: Any) -> Any:
    return item.values if isinstance(item, Array) else item
