"""A contact has no friction."""

from user_forces.friction.law import FrictionLaw
from user_forces.values.value import value


@value
class Frictionless(FrictionLaw):
    """F_t = 0."""

    def __call__(self, slip: float, normal_force: float, deflection: float = 0.0) -> float:
        """Zero [N], whatever the slip [m/s] and normal force [N]."""
        return 0.0
