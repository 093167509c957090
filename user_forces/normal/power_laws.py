"""Laws whose elastic force is K depth^n: Hertz's, and those with a damping factor made from the restitution."""

from __future__ import annotations

import math
from abc import ABC
from collections.abc import Callable
from typing import Annotated, NamedTuple

from pydantic import Field

from user_forces.kernel import kernel
from user_forces.normal.hysteresis import Hysteresis, exact_damping_factor
from user_forces.normal.law import NormalLaw
from user_forces.values.units import NewtonsPerMetreToN
from user_forces.values.value import InputError, Positive, Real, Restitution, value


@value
class ElasticPower(NormalLaw, ABC):
    """The elastic part F_el = K depth^n.

    Arguments:
        stiffness: K [N/m^n], > 0; see `user_forces.materials`.
        exponent: n [-], 1.5 for metals, from 1 to 3.
    """

    stiffness: NewtonsPerMetreToN[Positive]
    exponent: Annotated[Real, Field(ge=1, le=3)] = 1.5

    @staticmethod
    @kernel
    def elastic(depth: float, stiffness: float, exponent: float) -> float:
        """K depth^n [N]."""
        return float(stiffness * depth**exponent)

    @staticmethod
    @kernel
    def energy(depth: float, stiffness: float, exponent: float) -> float:
        """K depth^(n+1) / (n+1) [J]."""
        return float(stiffness / (exponent + 1.0) * depth ** (exponent + 1.0))

    def resting_depth(self, force: float) -> float:
        """The depth (F/K)^(1/n) [m] under a force F [N] >= 0."""
        if not force >= 0.0:
            raise InputError(f"{type(self).__name__}: force = {force} N: allowed: >= 0")
        return float((force / self.stiffness) ** (1.0 / self.exponent))

    def turning_depth(self, energy: float) -> float:
        """The depth ((n+1) E / K)^(1/(n+1)) [m] for an energy E [J] >= 0."""
        if not energy >= 0.0:
            raise InputError(f"{type(self).__name__}: energy = {energy} J: allowed: >= 0")
        return float(((self.exponent + 1.0) * energy / self.stiffness) ** (1.0 / (self.exponent + 1.0)))


@value
class Hertz(ElasticPower):
    """F = K depth^n: no damping, restitution 1.

    Arguments:
        stiffness: K [N/m^n], > 0; see `user_forces.materials`.
        exponent: n [-], 1.5 for two spheres, from 1 to 3.

    Source: Hertz, J. reine angew. Math. 92 (1882) 156-171; Johnson, Contact Mechanics (1985), Eq. 4.23.
    """

    @staticmethod
    @kernel
    def force(depth: float, rate: float, impact_velocity: float, stiffness: float, exponent: float) -> float:
        """K depth^n [N]; rate and impact have no influence."""
        return float(stiffness * depth**exponent)


@value
class PowerLaw(ElasticPower, Hysteresis, ABC):
    """F = K depth^n (1 + chi rate / w); the damping factor chi is what laws differ in.

    Arguments:
        stiffness: K [N/m^n], > 0; see `user_forces.materials`.
        restitution: e that is asked for [-].
        exponent: n [-], 1.5 for metals, from 1 to 3.
        rest_velocity: smallest w [m/s], > 0; see `Hysteresis`.
    """


@value
class Exact(PowerLaw):
    """F = K depth^n (1 + chi rate / w), chi the root of chi (1 + e) = ln((1 + chi)/(1 - chi e)) in (0, 1/e].

    For any e > 0. The force has the form that Hunt and Crossley gave it; all that differs is that chi is not
    approximated.
    Delivers 0.100, 0.300, 0.500, 0.700, 0.900
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution > 0 and <= 1.

    Source: derived in `Hysteresis`. Gonthier, McPhee, Lange and Piedboeuf, Multibody Syst. Dyn. 11 (2004)
    209-233, have the condition in the form (1 + d/e)/(1 - d) = exp(d (1 + 1/e)) with d = chi e, and continue
    with its approximation d = 1 - e^2; Carvalho and Martins, Mech. Mach. Theory 139 (2019) 174-194, approximate
    its root otherwise.
    """

    restitution: Restitution

    def factor(self, restitution: float) -> float:
        """chi is the exact damping factor, see there."""
        return exact_damping_factor(restitution)


class DampingFactor(NamedTuple):
    """A published damping factor.

    chi: function of the restitution e. formula: the same in words. validity: for which e it was made.
    delivers: restitutions of free impacts for e = 0.1, 0.3, 0.5, 0.7, 0.9. source: where it was published.
    divides: whether chi is infinite at e = 0, which then is not allowed.
    """

    chi: Callable[[float], float]
    formula: str
    validity: str
    delivers: tuple[float, float, float, float, float]
    source: str
    divides: bool = False


DAMPING_FACTORS = {
    "HuntCrossley": DampingFactor(
        lambda e: 1.5 * (1.0 - e),
        "3 (1 - e) / 2",
        "First order in 1 - e: for e near 1.",
        (0.516, 0.581, 0.663, 0.768, 0.909),
        "Hunt and Crossley, J. Appl. Mech. 42 (1975) 440-445",
    ),
    "HerbertMcWhannell": DampingFactor(
        lambda e: 6.0 * (1.0 - e) / ((2.0 * e - 1.0) ** 2 + 3.0),
        "6 (1 - e) / ((2 e - 1)^2 + 3)",
        "For e near 1.",
        (0.491, 0.520, 0.594, 0.723, 0.901),
        "Herbert and McWhannell, J. Eng. Ind. 99 (1977) 513-518",
    ),
    "LeeWang": DampingFactor(
        lambda e: 0.75 * (1.0 - e),
        "3 (1 - e) / 4",
        "Half of what the first order in 1 - e asks for, so it loses too little energy at any e < 1.",
        (0.687, 0.739, 0.799, 0.869, 0.952),
        "Lee and Wang, J. Mech. Transm. Autom. Des. 105 (1983) 534-540",
    ),
    "LankaraniNikravesh": DampingFactor(
        lambda e: 0.75 * (1.0 - e**2),
        "3 (1 - e^2) / 4",
        "For e > 0.8: derived for small losses. The law of the paper on the hydraulic support.",
        (0.665, 0.684, 0.725, 0.796, 0.913),
        'Lankarani and Nikravesh, J. Mech. Des. 112 (1990) 369-376; Eq. 4 of "Dynamic Analysis of Hydraulic '
        'Support with Single Clearance", with D = chi K depth^n / v0',
    ),
    "Gonthier": DampingFactor(
        lambda e: (1.0 - e**2) / e,
        "(1 - e^2) / e",
        "For low e, where it is nearly exact; within 0.033 everywhere.",
        (0.101, 0.304, 0.488, 0.670, 0.876),
        "Gonthier, McPhee, Lange and Piedboeuf, Multibody Syst. Dyn. 11 (2004) 209-233",
        divides=True,
    ),
    "ZhiyingQishao": DampingFactor(
        lambda e: 0.75 * (1.0 - e**2) * math.exp(2.0 * (1.0 - e)),
        "3 (1 - e^2) exp(2 (1 - e)) / 4",
        "For e > 0.5.",
        (0.217, 0.327, 0.483, 0.680, 0.896),
        "Zhiying and Qishao, J. Dyn. Control 4 (2006) 294-298",
    ),
    "Flores": DampingFactor(
        lambda e: 8.0 * (1.0 - e) / (5.0 * e),
        "8 (1 - e) / (5 e)",
        "For any e; a little too much damping everywhere.",
        (0.069, 0.256, 0.470, 0.683, 0.894),
        "Flores, Machado, Silva and Martins, Multibody Syst. Dyn. 25 (2011) 357-375",
        divides=True,
    ),
    "GharibHurmuzlu": DampingFactor(
        lambda e: 1.0 / e,
        "1 / e",
        "For e to 0. The largest chi with which the surfaces part with e v0 at all; for e = 1 it still damps.",
        (0.100, 0.282, 0.411, 0.501, 0.567),
        "Gharib and Hurmuzlu, J. Appl. Mech. 79 (2012) 064506",
        divides=True,
    ),
    "HuGuo": DampingFactor(
        lambda e: 1.5 * (1.0 - e) / e,
        "3 (1 - e) / (2 e)",
        "For any e.",
        (0.074, 0.271, 0.488, 0.697, 0.900),
        "Hu and Guo, Multibody Syst. Dyn. 35 (2015) 131-151",
        divides=True,
    ),
    "CarvalhoMartins": DampingFactor(
        lambda e: 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e),
        "3 (1 - e) (11 - e) / (2 (1 + 9 e))",
        "For e > 1/3, where it is right within 0.003; an approximation of the exact law.",
        (0.129, 0.304, 0.500, 0.700, 0.900),
        "Carvalho and Martins, Mech. Mach. Theory 139 (2019) 174-194",
    ),
    "SafaeifarFarshidianfar": DampingFactor(
        lambda e: 1.25 * (1.0 - e) / e,
        "5 (1 - e) / (4 e)",
        "For e < 0.4.",
        (0.089, 0.314, 0.536, 0.735, 0.915),
        "Safaeifar and Farshidianfar, Multibody Syst. Dyn. 50 (2020) 233-257",
        divides=True,
    ),
}


def _law(name: str) -> type[PowerLaw]:
    """The class of the law with the damping factor of this name."""
    row = DAMPING_FACTORS[name]

    def factor(self: PowerLaw, restitution: float) -> float:
        return row.chi(restitution)

    factor.__doc__ = f"chi = {row.formula}."
    known = {
        "__module__": __name__,
        "__qualname__": name,
        "__doc__": f"""F = K depth^n (1 + chi rate / w), chi = {row.formula}.

    {row.validity}
    Delivers {", ".join(f"{e:.3f}" for e in row.delivers)}
    for e = 0.1, 0.3, 0.5, 0.7, 0.9.

    Arguments: those of `PowerLaw`; restitution {"> 0 and <= 1" if row.divides else "from 0 to 1"}.

    Source: {row.source}.
    """,
        "factor": factor,
        "__annotations__": {"restitution": Restitution} if row.divides else {},
    }
    return value(type(name, (PowerLaw,), known))


HuntCrossley = _law("HuntCrossley")
HerbertMcWhannell = _law("HerbertMcWhannell")
LeeWang = _law("LeeWang")
LankaraniNikravesh = _law("LankaraniNikravesh")
Gonthier = _law("Gonthier")
ZhiyingQishao = _law("ZhiyingQishao")
Flores = _law("Flores")
GharibHurmuzlu = _law("GharibHurmuzlu")
HuGuo = _law("HuGuo")
CarvalhoMartins = _law("CarvalhoMartins")
SafaeifarFarshidianfar = _law("SafaeifarFarshidianfar")
