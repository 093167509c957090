"""The contract of a friction law."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cache, cached_property
from typing import Any

from pydantic import model_validator
from typing_extensions import Self

from user_forces.kernel import Formula, formula_of, kernel, refuse_methods, sign
from user_forces.values.value import Coefficient, Value, value

LONG = 1.0  # [s], in which a deflection becomes that of steady slip
SLIPS: tuple[float, ...] = tuple(
    1e-9 * 10.0 ** (0.025 * n) for n in range(401)
)  # [m/s] at which a law is evaluated
HALVINGS = 40
MOMENT = 1e-10  # [s], in which no bristle moves by more than a share of 1e-4 of its way


class FrictionLaw(Value, ABC):
    """Tangential force as a function of slip speed and normal force.

    A law is a data class of parameters with a function of numbers, its `force`: a static method whose first
    arguments are slip and normal force, and whose others are names of parameters or properties of the law. It
    is plain Python with `if` and `math`, which numba compiles, see `kernel`.

    The contract:
    1. `law(slip, normal_force, deflection)` gives the force along t on the journal, where slip is the speed of
       the journal's surface relative to the bore's along the same t.
    2. A law without a state never does positive work: force times slip <= 0; it ignores `deflection`.
    3. A law with a state has a second function of numbers, `advance(deflection, slip, step)`: the deflection
       [m] after a step [s] at a constant slip. Its `force` then takes the deflection as third argument. The
       state is a number, zero at the impact. The law owns no memory: the solver keeps the deflection and makes
       the step with it. A third function, `rate(deflection, slip)`, is the rate of the deflection [m/s]; by
       default what `advance` makes of a step that tends to nothing. `swing_time` limits the steps.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        refuse_methods(cls, {"__call__": "force", "next_deflection": "advance", "deflection_rate": "rate"})

    @staticmethod
    @abstractmethod
    def force(*arguments: Any, **parameters: Any) -> float:
        """Tangential force [N] of slip [m/s], normal force [N] >= 0, and parameters."""

    @property
    def has_state(self) -> bool:
        """Whether the force depends on the deflection."""
        return hasattr(type(self), "advance")

    @cached_property
    def force_formula(self) -> Formula:
        """The force as a function of numbers, with this law's parameters."""
        return formula_of(self, self.force, 3 if self.has_state else 2)

    @cached_property
    def advance_formula(self) -> Formula:
        """The deflection after a step as a function of numbers, of a law with a state."""
        return formula_of(self, getattr(self, "advance"), 3)  # noqa: B009 - laws without a state have none

    @cached_property
    def rate_formula(self) -> Formula:
        """The rate of the deflection as a function of numbers, of a law with a state."""
        rate = getattr(self, "rate", None)
        if rate is not None:
            return formula_of(self, rate, 2)
        return Formula(_rate_of(self.advance_formula.function), self.advance_formula.parameters)

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Tangential force [N] for a slip [m/s], a normal force [N] >= 0 and a deflection [m]."""
        if self.has_state:
            return float(self.force_formula(slip, normal_force, deflection))
        return float(self.force_formula(slip, normal_force))

    def next_deflection(self, deflection: float, slip: float, step: float) -> float:
        """Deflection [m] after a step [s] over which the slip [m/s] was this one on average."""
        return self.advance_formula(deflection, slip, step) if self.has_state else deflection

    def deflection_rate(self, deflection: float, slip: float) -> float:
        """Rate of the deflection [m/s] at a slip [m/s]."""
        return self.rate_formula(deflection, slip) if self.has_state else 0.0

    def steady_deflection(self, slip: float) -> float:
        """Deflection [m] of a slip [m/s] that has lasted long: that of a joint which moves at the start."""
        return self.next_deflection(0.0, slip, LONG)

    @cached_property
    def _coefficients(self) -> tuple[float, ...]:
        """Ratios of friction to normal force at SLIPS, of a law without a state."""
        force, own = self.force_formula
        return tuple(abs(force(slip, 1.0, *own)) for slip in SLIPS)

    @property
    def largest_coefficient(self) -> float:
        """Largest ratio of friction to normal force at any of SLIPS, of a law without a state."""
        return max(self._coefficients)

    def slip_speed(self, share: float) -> float:
        """Smallest slip [m/s] with this share of the largest coefficient; 0 of a law with a state."""
        wanted = 0.0 if self.has_state else share * self.largest_coefficient
        if wanted == 0.0:
            return 0.0
        first = next(n for n, coefficient in enumerate(self._coefficients) if coefficient >= wanted)
        low, high = float(SLIPS[max(0, first - 1)]), float(SLIPS[first])
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (low, middle) if abs(self(middle, 1.0)) >= wanted else (middle, high)
        return high

    def swing_time(self, mass: float, normal_force: float) -> float:
        """One over the angular frequency [s] at which a mass [kg] that sticks swings under a normal force [N].

        Steps have to follow it. Infinite for laws without a state: what they do to a motion is to slow it down,
        and an implicit step that is too long for that does so all the same.
        """
        del mass, normal_force
        return math.inf


@cache
def _rate_of(advance: Callable[..., float]) -> Callable[..., float]:
    def rate(deflection: float, slip: float, *parameters: float) -> float:
        return (advance(deflection, slip, MOMENT, *parameters) - deflection) / MOMENT

    return kernel(rate)


@kernel
def against(slip: float, force: float) -> float:
    """A force [N] that points against the slip; zero where there is none."""
    return -sign(slip) * force


@value
class TwoCoefficients(FrictionLaw, ABC):
    """Laws whose coefficient of friction is larger at rest than in fast slip.

    Arguments:
        static_coefficient: mu_s [-], >= mu_d and <= 5.
        sliding_coefficient: mu_d [-], >= 0.
    """

    static_coefficient: Coefficient
    sliding_coefficient: Coefficient

    @model_validator(mode="after")
    def _static_is_larger(self) -> Self:
        if self.static_coefficient < self.sliding_coefficient:
            raise ValueError(
                f"static_coefficient = {self.static_coefficient}: allowed: >= sliding_coefficient = "
                f"{self.sliding_coefficient}"
            )
        return self
