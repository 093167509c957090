"""The damped Hertz contact that delivers the restitution asked for."""

from user_forces.normal.hysteresis import exact_damping_factor
from user_forces.normal.power_law import PowerLaw
from user_forces.values.value import Restitution, value


@value
class Exact(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi the root of chi (1 + e) = ln((1 + chi)/(1 - chi e)) in (0, 1/e].

    For any e > 0. The force has the form that Hunt and Crossley gave it; all that differs is that chi is not
    approximated.
    Delivers 0.100, 0.300, 0.500, 0.700, 0.900
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: derived in `Hysteresis`. Gonthier, McPhee, Lange and Piedboeuf, Multibody Syst. Dyn. 11 (2004)
    209-233, have the condition in the form (1 + d/e)/(1 - d) = exp(d (1 + 1/e)) with d = chi e, and go on with
    its approximation d = 1 - e^2; Carvalho and Martins, Mech. Mach. Theory 139 (2019) 174-194, approximate
    its root otherwise.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi is the exact damping factor, see there."""
        return exact_damping_factor(restitution)
