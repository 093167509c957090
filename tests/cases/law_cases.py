"""Laws, and an impact in one dimension, that several unit tests share."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

from user_forces import (
    AdamsImpact,
    Ambrosio,
    Anagnostopoulos,
    BengisuAkay,
    BrownMcPhee,
    CarvalhoMartins,
    CubicCoulomb,
    CylinderLaw,
    DubowskyFreudenstein,
    Esdu78035,
    Exact,
    Flores,
    FrictionLaw,
    Frictionless,
    GharibHurmuzlu,
    Goldsmith,
    Gonthier,
    HerbertMcWhannell,
    Hertz,
    HuGuo,
    HuntCrossley,
    Johnson,
    JournalBearing,
    KelvinVoigt,
    LankaraniNikravesh,
    LeeWang,
    Liu,
    LuGre,
    NormalLaw,
    Pereira,
    PowerLaw,
    Radzimovsky,
    SafaeifarFarshidianfar,
    Stribeck,
    Threlfall,
    Value,
    ZhiyingQishao,
)

BEARING = JournalBearing(bore_radius=0.0655, clearance=0.0015)
MODULUS = 1.153846e11  # E* of steel on steel, E = 210 GPa, nu = 0.3 [Pa]
LENGTH = 0.1  # of a line contact [m]

# those that approximate chi(e) by a formula, and the one that does not
APPROXIMATIONS: tuple[type[PowerLaw], ...] = (
    HuntCrossley,
    HerbertMcWhannell,
    LeeWang,
    LankaraniNikravesh,
    Gonthier,
    ZhiyingQishao,
    Flores,
    GharibHurmuzlu,
    HuGuo,
    SafaeifarFarshidianfar,
    CarvalhoMartins,
)
POWER_LAWS: tuple[type[PowerLaw], ...] = (Exact, *APPROXIMATIONS)
LOGARITHMIC_LAWS: tuple[type[CylinderLaw], ...] = (
    Johnson,
    Radzimovsky,
    Goldsmith,
    DubowskyFreudenstein,
    Esdu78035,
)
CYLINDER_LAWS: tuple[type[CylinderLaw], ...] = (*LOGARITHMIC_LAWS, Liu, Pereira)


def power_law(kind: type[PowerLaw], **changes: object) -> PowerLaw:
    """A law K depth^n of the size of the support's pins."""
    fields: dict[str, object] = {"stiffness": 2.7e10, "restitution": 0.7}
    return kind(**fields | changes)


def cylinder_law(kind: type[CylinderLaw], **changes: object) -> CylinderLaw:
    """A line contact of the size of the support's pins."""
    fields: dict[str, object] = {
        "bearing": BEARING,
        "length": LENGTH,
        "effective_modulus": MODULUS,
        "restitution": 0.7,
    }
    return kind(**fields | changes)


NORMAL_LAWS: tuple[NormalLaw, ...] = (
    *(power_law(kind) for kind in POWER_LAWS),
    *(cylinder_law(kind) for kind in CYLINDER_LAWS),
    Hertz(stiffness=2.7e10),
    KelvinVoigt(stiffness=1e9, damping=5e4),
    Anagnostopoulos(stiffness=1e9, restitution=0.7, mass=700.0),
    AdamsImpact(stiffness=3.16e9, full_damping=5e4, full_damping_depth=1e-4),
)
STATELESS_FRICTION: tuple[FrictionLaw, ...] = (
    Frictionless(),
    Ambrosio(sliding_coefficient=0.25),
    CubicCoulomb(sliding_coefficient=0.25),
    Threlfall(sliding_coefficient=0.25),
    BengisuAkay(static_coefficient=0.3, sliding_coefficient=0.2),
    Stribeck(static_coefficient=0.3, sliding_coefficient=0.2),
    BrownMcPhee(static_coefficient=0.3, sliding_coefficient=0.2),
)
LUGRE = LuGre(static_coefficient=0.3, sliding_coefficient=0.2, viscosity=0.01)
FRICTION_LAWS: tuple[FrictionLaw, ...] = (*STATELESS_FRICTION, LUGRE)


def kind_of(item: object) -> str:
    """Name of a law, or of the class of one, for the report."""
    if isinstance(item, Value):
        return type(item).__name__
    return item.__name__ if isinstance(item, type) else str(item)


def rebound(force: Callable[[float, float], float], mass: float, speed: float, depth: float) -> float:
    """Speed after over speed before a free impact, by scipy.

    Arguments:
        force: of depth [m] > 0 and its rate [m/s], in N; what would pull is cut.
        mass, speed: that moves as the depth does [kg], at the impact [m/s].
        depth: about the greatest of the impact [m]; only the unit in which it is computed.
    """
    per_newton = depth / (mass * speed**2)

    def motion(_: float, y: np.ndarray) -> list[float]:
        # at the impact itself a law is asked for its limit at depth zero, since a dashpot jumps there
        push = max(0.0, force(max(y[0] * depth, 1e-30), y[1] * speed))
        return [y[1], -push * per_newton]

    # a hard dashpot stops a body in a small part of this unit and lets it creep out in thousands
    solver = DOP853(motion, 0.0, [0.0, 1.0], 1e6, first_step=1e-4, rtol=1e-10, atol=1e-13)
    while solver.y[0] > 0.0 or solver.t == 0.0:
        # where tension is cut nothing is felt, and a long step would jump over the depth where force
        # sets in again
        solver.max_step = 0.05 * max(solver.y[0], 1e-3) / max(abs(solver.y[1]), 1e-9)
        solver.step()
    within = solver.dense_output()
    end = brentq(lambda t: within(t)[0], solver.t_old, solver.t)
    return -float(within(end)[1])


def law_rebound(law: NormalLaw, mass: float, speed: float) -> float:
    """The same for a law."""
    impact = speed
    depth = law.turning_depth(0.5 * mass * speed**2)
    return rebound(lambda x, rate: law(x, rate, impact), mass, speed, depth)
