"""Spring and dashpot side by side."""

import math
from dataclasses import field
from typing import Annotated

from pydantic import Field

from user_forces.normal.power_law import ElasticPower
from user_forces.values.units import NewtonSecondsPerMetre
from user_forces.values.value import NonNegative, Real, value


@value
class KelvinVoigt(ElasticPower):
    """F = K depth + c rate.

    The force jumps to c v0 at the impact, and near the separation the law asks for tension, which is cut: the
    surfaces part when spring and dashpot balance. Restitution is no input. Of two free bodies with reduced
    mass m a central impact delivers, with zeta = c / (2 sqrt(K m)) and the tension cut,

        e = exp(-2 zeta arccos(zeta) / sqrt(1 - zeta^2))     zeta < 1
            exp(-2 zeta arcosh(zeta) / sqrt(zeta^2 - 1))     zeta > 1

    Arguments:
        stiffness: K [N/m], > 0.
        damping: c [N s/m], >= 0.

    Source: Voigt, Ann. Phys. 283 (1892) 671-693; with a cut tension Schwager and Poeschel, Granular Matter 9
    (2007) 465-469.
    """

    damping: NewtonSecondsPerMetre[NonNegative]
    exponent: Annotated[Real, Field(ge=1, le=1)] = field(default=1.0)

    def __call__(self, depth: float, rate: float, impact_velocity: float) -> float:
        """Normal force [N] at depth [m] > 0, rate [m/s]."""
        return self.stiffness * depth + self.damping * rate

    def delivered_restitution(self, mass: float) -> float:
        """Restitution [-] of a free impact of this reduced mass [kg] > 0, tension cut."""
        return cut_dashpot_restitution(self.damping / (2.0 * math.sqrt(self.stiffness * mass)))


def cut_dashpot_restitution(damping_ratio: float) -> float:
    """Restitution of a linear spring and dashpot that part as soon as they would pull.

        e = exp(-2 zeta arccos(zeta) / sqrt(1 - zeta^2))     zeta < 1
            exp(-2)                                          zeta = 1
            exp(-2 zeta arcosh(zeta) / sqrt(zeta^2 - 1))     zeta > 1

    K x + c v of the free oscillation with x = 0, v = v0 at the start falls to zero when its phase is
    2 arccos(zeta), and the speed is -v0 times the decay till then.

    Arguments:
        damping_ratio: zeta [-] >= 0.
    """
    zeta = damping_ratio
    if abs(zeta - 1.0) < 1e-9:
        return math.exp(-2.0)
    if zeta < 1.0:
        return math.exp(-2.0 * zeta * math.acos(zeta) / math.sqrt(1.0 - zeta * zeta))
    return math.exp(-2.0 * zeta * math.acosh(zeta) / math.sqrt(zeta * zeta - 1.0))
