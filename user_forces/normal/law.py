"""The contract of a normal contact law."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property
from typing import Any

from user_forces.kernel import Formula, formula_of, quadrature, refuse_methods
from user_forces.roots import bracketed_root
from user_forces.values.value import InputError, Value


class LoadError(InputError):
    """A contact is indented deeper than its law is valid, or loaded by more than the law can carry."""


class NormalLaw(Value, ABC):
    """Normal contact force as a function of indentation, indentation rate and impact velocity.

    A law is a data class of parameters with a function of numbers, its `force`. The function is a static method
    whose first arguments are indentation, rate and impact velocity, and whose others are names of parameters or
    properties of the law. It is plain Python with `if` and `math`, which numba compiles, see `kernel`.

    The contract:
    1. `law(depth, rate, impact_velocity)` is called with depth > 0 only, all in SI.
    2. `impact_velocity` [m/s] >= 0 is the indentation rate at zero indentation when the contact began; 0 for a
       contact that is closed at the start. It is constant until the surfaces separate.
    3. The result may be negative (tension). The caller cuts it at zero and counts that it did.
    4. `elastic` is the part that is given back, and `energy` its integral; the rest is dissipated. By default
       `elastic` is the force at no rate, and the energy a Gauss quadrature of it.
    5. A law that is valid up to some indentation says so by `largest_depth`.
    6. A law that needs a mass has a field `mass` [kg]. If that is None, a scenario takes the joint's effective
       mass in the start posture, a constant of the run.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        refuse_methods(cls, {"__call__": "force", "elastic_force": "elastic", "elastic_energy": "energy"})

    @staticmethod
    @abstractmethod
    def force(*arguments: Any, **parameters: Any) -> float:
        """Normal force [N], positive pushes apart, of depth [m], rate [m/s], impact velocity, parameters."""

    @cached_property
    def force_formula(self) -> Formula:
        """The force as a function of numbers, with this law's parameters."""
        return formula_of(self, self.force, 3)

    @cached_property
    def elastic_formula(self) -> Formula:
        """The force at rest as a function of numbers, with this law's parameters."""
        elastic = getattr(self, "elastic", None)
        if elastic is not None:
            return formula_of(self, elastic, 1)
        return self.force_formula.at_rest()

    @cached_property
    def energy_formula(self) -> Formula:
        """The stored energy as a function of numbers, with this law's parameters."""
        energy = getattr(self, "energy", None)
        return quadrature(self.elastic_formula) if energy is None else formula_of(self, energy, 1)

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        """Normal force [N], positive pushes apart, at depth [m] > 0 and rate [m/s]."""
        self.check(depth)
        return float(self.force_formula(depth, rate, impact_velocity))

    def elastic_force(self, depth: float) -> float:
        """Force [N] at rest at this depth [m] > 0."""
        self.check(depth)
        return float(self.elastic_formula(depth))

    def elastic_energy(self, depth: float) -> float:
        """Energy [J] stored at this depth [m] > 0."""
        self.check(depth)
        return float(self.energy_formula(depth))

    @property
    def largest_depth(self) -> float:
        """Depth [m] up to which the law is valid."""
        return math.inf

    def check(self, depth: float) -> None:
        """Raise LoadError if this depth [m] is outside the law's range."""
        if depth > self.largest_depth:
            raise LoadError(
                f"{type(self).__name__}: depth = {depth:.6g} m is outside its range; allowed: up to "
                f"{self.largest_depth:.6g} m{self._range_note}"
            )

    @property
    def _range_note(self) -> str:
        """What the message about a depth outside the range adds."""
        return ""

    def resting_depth(self, force: float) -> float:
        """Depth [m] at which a constant force [N] >= 0 is held at rest.

        Raises LoadError if the law cannot hold it.
        """
        depth = self._depth_of(self.elastic_force, force)
        if depth == self.largest_depth < math.inf and force > self.elastic_force(depth):
            raise LoadError(
                f"{type(self).__name__}: force = {force:.6g} N is outside its range; allowed: up to "
                f"{self.elastic_force(depth):.6g} N, at a depth of {depth:.6g} m"
            )
        return depth

    def turning_depth(self, energy: float) -> float:
        """Depth [m] at which the energy [J] >= 0 is stored: where an undamped impact turns.

        The largest depth, if the law cannot store so much.
        """
        return self._depth_of(self.elastic_energy, energy)

    def impact_time(self, speed: float, mass: float) -> float:
        """Duration [s] of an undamped impact of a speed [m/s] and a mass [kg]; less if a dashpot stops it.

        2.94 times turning depth over speed, right for n = 1.5 and within 13 % for n from 1 to 3; or 3 m v / F0
        with the force F0 just after the impact. Infinite for no speed.
        """
        if speed <= 0.0:
            return math.inf
        time = 2.94 * self.turning_depth(0.5 * mass * speed**2) / speed
        first = self.initial_force(speed, mass)
        return min(time, 3.0 * mass * speed / first) if first > 0.0 else time

    def initial_force(self, speed: float, mass: float) -> float:
        """Force [N] just after an impact: zero unless the law jumps there, as a dashpot's force does.

        speed: [m/s]. mass: that moves [kg].
        """
        depth = 1e-9 * self.turning_depth(0.5 * mass * speed**2)
        if depth == 0.0:
            return 0.0
        force = self(depth, speed, speed)
        continuous = 1e-6 * mass * speed**2 / (1e9 * depth)  # far below that of the impact
        return force if force > continuous else 0.0

    def _depth_of(self, rising: Callable[[float], float], wanted: float) -> float:
        """The depth [m] at which a function that rises from 0 has a value; at most the largest depth."""
        if not wanted >= 0.0:
            raise InputError(f"{type(self).__name__}: {wanted}: allowed: >= 0")
        if wanted == 0.0:
            return 0.0
        limit = self.largest_depth
        low, high = 0.0, min(1e-9, limit)
        while rising(high) < wanted:
            if high >= limit:
                return limit
            low, high = high, min(2.0 * high, limit)

        def excess(depth: float) -> float:
            return rising(depth) - wanted if depth else -wanted

        return bracketed_root(excess, low, high, xtol=1e-18)
