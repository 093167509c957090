"""The arithmetic of laws, with floats, and how it hands over to an expression."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.analytic import adams_step
from user_forces.expressions import scalar
from user_forces.expressions.scalar import Expression

numbers = st.floats(-1e6, 1e6)
positives = st.floats(1e-12, 1e6)


class Recorded(Expression):
    """An expression that says which of its methods was called, and with what."""

    def function(self, name: str) -> Any:
        return name

    def hypotenuse(self, other: Expression | float) -> Any:
        return "hypotenuse", other

    def choose(self, yes: Expression | float, no: Expression | float) -> Any:
        return "choose", yes, no

    def larger(self, other: Expression | float) -> Any:
        return "larger", other

    def smaller(self, other: Expression | float) -> Any:
        return "smaller", other

    def __pow__(self, exponent: float) -> Any:
        return "power", exponent


UNKNOWN = Recorded()


# --- floats ---


@given(x=positives)
def test_roots_and_logarithms_are_those_of_the_machine(x: float) -> None:
    assert scalar.sqrt(x) == math.sqrt(x)
    assert scalar.log(x) == math.log(x)


@given(x=st.floats(-700.0, 700.0))
def test_exponential_and_tangent_are_those_of_the_machine(x: float) -> None:
    assert scalar.exp(x) == math.exp(x)
    assert scalar.tanh(x) == math.tanh(x)


@given(x=numbers)
def test_cosine_and_sine_are_those_of_the_machine(x: float) -> None:
    assert scalar.cos(x) == math.cos(x)
    assert scalar.sin(x) == math.sin(x)


@given(x=positives, exponent=st.floats(-3.0, 3.0))
def test_power_is_that_of_the_machine(x: float, exponent: float) -> None:
    assert scalar.power(x, exponent) == math.pow(x, exponent)


def test_zero_has_a_root_and_powers() -> None:
    assert scalar.sqrt(0.0) == 0.0
    assert scalar.power(0.0, 1.5) == 0.0


@given(x=numbers, y=numbers)
def test_hypotenuse_is_that_of_the_machine(x: float, y: float) -> None:
    assert scalar.hypot(x, y) == math.hypot(x, y)


@given(x=numbers, y=numbers)
def test_larger_and_smaller_of_two_numbers(x: float, y: float) -> None:
    assert scalar.maximum(x, y) == max(x, y)
    assert scalar.minimum(x, y) == min(x, y)


@given(x=numbers)
def test_sign_times_magnitude_is_the_number(x: float) -> None:
    assert scalar.sign(x) * scalar.magnitude(x) == x
    assert scalar.magnitude(x) >= 0.0


@pytest.mark.parametrize(("x", "expected"), [(-3.0, -1.0), (0.0, 0.0), (-0.0, 0.0), (1e-300, 1.0)])
def test_sign_by_hand(x: float, expected: float) -> None:
    assert scalar.sign(x) == expected


@pytest.mark.parametrize(("condition", "expected"), [(True, 1.0), (False, 2.0), (3.0 > 2.0, 1.0)])
def test_where_takes_the_first_if_the_condition_holds(condition: bool, expected: float) -> None:
    assert scalar.where(condition, 1.0, 2.0) == expected


def test_a_float_is_a_number_and_an_expression_is_not() -> None:
    assert scalar.is_number(1.0)
    assert not scalar.is_number(UNKNOWN)  # type: ignore[arg-type]


# --- step ---


@given(x=st.floats(-3.0, 3.0))
def test_step_is_the_cubic_of_multibody_programs(x: float) -> None:
    assert scalar.step(x) == adams_step(x, 0.0, 0.0, 1.0, 1.0)


# x^2 (3 - 2 x) by hand, all of it exact in binary
@pytest.mark.parametrize(
    ("x", "expected"), [(-1.0, 0.0), (0.0, 0.0), (0.25, 0.15625), (0.5, 0.5), (1.0, 1.0), (7.0, 1.0)]
)
def test_step_by_hand(x: float, expected: float) -> None:
    assert scalar.step(x) == expected


@given(x=st.floats(0.0, 1.0), y=st.floats(0.0, 1.0))
def test_step_rises_and_is_nowhere_steeper_than_in_its_middle(x: float, y: float) -> None:
    low, high = min(x, y), max(x, y)
    rise = scalar.step(high) - scalar.step(low)
    # the slope 6 x (1 - x) is largest, 3/2, at 1/2; rounding of numbers up to 1
    assert -1e-15 <= rise <= 1.5 * (high - low) + 1e-15


@given(x=st.floats(0.0, 1.0))
def test_step_is_symmetric_about_its_middle(x: float) -> None:
    # rounding of numbers up to 1
    assert scalar.step(x) + scalar.step(1.0 - x) == pytest.approx(1.0, abs=1e-15)


# --- expressions ---


@pytest.mark.parametrize(
    ("function", "name"),
    [
        (scalar.sqrt, "sqrt"),
        (scalar.exp, "exp"),
        (scalar.log, "log"),
        (scalar.tanh, "tanh"),
        (scalar.cos, "cos"),
        (scalar.sin, "sin"),
        (scalar.sign, "sign"),
        (scalar.magnitude, "abs"),
    ],
)
def test_function_of_an_expression_is_left_to_the_expression(function: Callable[..., Any], name: str) -> None:
    assert function(UNKNOWN) == name


def test_operations_with_an_expression_are_left_to_it() -> None:
    unknown: Any = UNKNOWN
    assert scalar.hypot(unknown, 2.0) == ("hypotenuse", 2.0)
    assert scalar.where(unknown, 1.0, 2.0) == ("choose", 1.0, 2.0)
    assert scalar.power(unknown, 1.5) == ("power", 1.5)


def test_an_expression_may_stand_on_either_side_of_larger_and_smaller() -> None:
    unknown: Any = UNKNOWN
    assert scalar.maximum(unknown, 2.0) == scalar.maximum(2.0, unknown) == ("larger", 2.0)
    assert scalar.minimum(unknown, 2.0) == scalar.minimum(2.0, unknown) == ("smaller", 2.0)


@pytest.mark.parametrize("function", [math.exp, math.sqrt, float])
def test_functions_of_math_are_refused_with_where_theirs_are(function: Callable[[Any], float]) -> None:
    with pytest.raises(TypeError, match=r"from user_forces\.expressions\.scalar import exp"):
        function(Expression())
