"""The arithmetic that laws are written in: floats, or expressions of them.

A law is written once, with `+ - * / **`, comparisons and the functions of this module. Called with floats it
gives a float. Called with `Expression`s it gives the expression of the same formula, which a backend can
compile. For that a law must not branch with `if` on its arguments: `where` does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import cast


class Expression:
    """A number that is not known yet; see the module's docstring.

    Besides the methods below a backend defines `+ - * / **` (exponent a float) with floats on either side,
    negation, and `< <= > >=`, which give an expression that is a condition. (No abstract base class: what
    those cost at every `isinstance` would double the time of a law.)
    """

    def __bool__(self) -> bool:
        """Not known yet: a law that branches on it would take one branch for all times."""
        raise TypeError("a law must not branch with `if`, `and`, `or` or `not` on its arguments; use `where`")

    def __float__(self) -> float:
        """Not known yet: functions of `math` and `numpy` would take it for a number."""
        raise TypeError(
            "a law must not use functions of math or numpy on its arguments; allowed: those of "
            "user_forces.expressions.scalar, such as `from user_forces.expressions.scalar import exp`"
        )

    def function(self, name: str) -> Expression:
        """The function of this name of it: sqrt, exp, log, tanh, cos, sin, abs or sign."""
        raise NotImplementedError

    def hypotenuse(self, other: Expression | float) -> Expression:
        """Square root of the sum of both squares."""
        raise NotImplementedError

    def choose(self, yes: Expression | float, no: Expression | float) -> Expression:
        """`yes` where this condition holds, else `no`; only that one is evaluated."""
        raise NotImplementedError

    def larger(self, other: Expression | float) -> Expression:
        """The larger of both."""
        raise NotImplementedError

    def smaller(self, other: Expression | float) -> Expression:
        """The smaller of both."""
        raise NotImplementedError

    def course(self, function: Callable[[float], float]) -> Expression:
        """What a function makes of this time that is no formula of it, such as a table."""
        del function
        raise TypeError("a table, or what branches on the time, is no formula of it")


def is_number(x: float) -> bool:
    """Whether x is a number already, and no expression."""
    return not isinstance(x, Expression)


def in_time(function: Callable[[float], float], t: float) -> float | None:
    """What stands for a function of time that is no formula, if the time is an expression; None if a number."""
    return cast(float, t.course(function)) if isinstance(t, Expression) else None


def where(condition: object, yes: float, no: float) -> float:
    """`yes` if the condition holds, else `no`. With floats both have been computed already."""
    if isinstance(condition, Expression):
        return cast(float, condition.choose(yes, no))
    return yes if condition else no


def maximum(a: float, b: float) -> float:
    """The larger of both; no number if one of them is none, so that it is not lost where a law is cut."""
    if isinstance(a, Expression):
        return cast(float, a.larger(b))
    if isinstance(b, Expression):
        return cast(float, b.larger(a))
    return a if a > b or a != a else b


def minimum(a: float, b: float) -> float:
    """The smaller of both; no number if one of them is none."""
    if isinstance(a, Expression):
        return cast(float, a.smaller(b))
    if isinstance(b, Expression):
        return cast(float, b.smaller(a))
    return a if a < b or a != a else b


def sqrt(x: float) -> float:
    """Square root."""
    return cast(float, x.function("sqrt")) if isinstance(x, Expression) else math.sqrt(x)


def power(x: float, exponent: float) -> float:
    """x >= 0 to the power of a number."""
    return cast(float, x**exponent)


def exp(x: float) -> float:
    """e to the power of x."""
    return cast(float, x.function("exp")) if isinstance(x, Expression) else math.exp(x)


def log(x: float) -> float:
    """Natural logarithm."""
    return cast(float, x.function("log")) if isinstance(x, Expression) else math.log(x)


def tanh(x: float) -> float:
    """Hyperbolic tangent."""
    return cast(float, x.function("tanh")) if isinstance(x, Expression) else math.tanh(x)


def cos(x: float) -> float:
    """Cosine of an angle [rad]."""
    return cast(float, x.function("cos")) if isinstance(x, Expression) else math.cos(x)


def sin(x: float) -> float:
    """Sine of an angle [rad]."""
    return cast(float, x.function("sin")) if isinstance(x, Expression) else math.sin(x)


def hypot(x: float, y: float) -> float:
    """Square root of x^2 + y^2."""
    if isinstance(x, Expression):
        return cast(float, x.hypotenuse(y))
    return cast(float, y.hypotenuse(x)) if isinstance(y, Expression) else math.hypot(x, y)


def sign(x: float) -> float:
    """-1, 0 or 1."""
    if isinstance(x, Expression):
        return cast(float, x.function("sign"))
    return 1.0 if x > 0.0 else -1.0 if x < 0.0 else 0.0


def magnitude(x: float) -> float:
    """Absolute value."""
    return cast(float, x.function("abs")) if isinstance(x, Expression) else abs(x)


def step(x: float) -> float:
    """The cubic STEP from 0 at x = 0 to 1 at x = 1, constant beyond: x^2 (3 - 2 x)."""
    inside = minimum(maximum(x, 0.0), 1.0)
    return inside * inside * (3.0 - 2.0 * inside)
