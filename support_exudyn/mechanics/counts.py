"""What a run took."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Counts:
    """What a run took.

    steps: accepted; cut_steps: repeated shorter to land on an impact; newton_iterations, jacobians: of an
    implicit solver; evaluations: of the equations of motion by an explicit one; user_function_calls:
    evaluations of contact forces in Python; failed_newton: steps repeated because Newton's method did not
    converge; clamped_steps: steps at whose end a law asked for tension.
    """

    steps: int = 0
    cut_steps: int = 0
    newton_iterations: int = 0
    jacobians: int = 0
    evaluations: int = 0
    user_function_calls: int = 0
    failed_newton: int = 0
    clamped_steps: int = 0
