"""What a friction law is."""

from __future__ import annotations

from abc import ABC, abstractmethod

from user_forces.values import Value


class FrictionLaw(Value, ABC):
    """Tangential force as a function of slip speed and normal force.

    The contract: `law(slip, normal_force)` gives the force along t on the journal, where slip is the
    speed of the journal's surface relative to the bore's along the same t. It never does positive work:
    force times slip <= 0.
    """

    @abstractmethod
    def __call__(self, slip: float, normal_force: float) -> float:
        """Tangential force [N] for a slip [m/s] and a normal force [N] >= 0."""
