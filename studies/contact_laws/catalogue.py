"""The laws that are compared, by the names under which studies report them."""

from __future__ import annotations

from typing import Any

from studies.common import paper_machine
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    AdamsImpact,
    Ambrosio,
    Anagnostopoulos,
    BengisuAkay,
    BrownMcPhee,
    CarvalhoMartins,
    CubicCoulomb,
    DubowskyFreudenstein,
    Esdu78035,
    Exact,
    Flores,
    FrictionLaw,
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
    Radzimovsky,
    SafaeifarFarshidianfar,
    Stribeck,
    Threlfall,
    ZhiyingQishao,
    effective_modulus,
)

# F = K depth^n (1 + chi rate / w), in the order of their publication, the exact one first
POWER_LAWS: dict[str, Any] = {
    "exact": Exact,
    "hunt_crossley": HuntCrossley,
    "herbert_mcwhannell": HerbertMcWhannell,
    "lee_wang": LeeWang,
    "lankarani_nikravesh": LankaraniNikravesh,
    "gonthier": Gonthier,
    "zhiying_qishao": ZhiyingQishao,
    "flores": Flores,
    "gharib_hurmuzlu": GharibHurmuzlu,
    "hu_guo": HuGuo,
    "carvalho_martins": CarvalhoMartins,
    "safaeifar_farshidianfar": SafaeifarFarshidianfar,
}
CYLINDER_LAWS: dict[str, Any] = {
    "johnson": Johnson,
    "radzimovsky": Radzimovsky,
    "goldsmith": Goldsmith,
    "dubowsky_freudenstein": DubowskyFreudenstein,
    "esdu_78035": Esdu78035,
    "liu": Liu,
    "pereira": Pereira,
}
PIN_LENGTH = 0.1  # of the rear-link pin's bearing, for laws of line contact; assumed [m]
RESTING_FORCE = 51e3  # of the rear-link pin, about [N]


def cylinder_law(name: str, bearing: JournalBearing, restitution: float, length: float = PIN_LENGTH) -> Any:
    """A law of line contact, steel on 35CrMo."""
    modulus = effective_modulus(STEEL, STEEL_35CRMO)
    return CYLINDER_LAWS[name](
        bearing=bearing, length=length, effective_modulus=modulus, restitution=restitution
    )


def normal_laws(clearance_mm: float, restitution: float) -> dict[str, NormalLaw]:
    """Every normal law for the rear-link pin.

    Laws K depth^1.5 have the paper's K; linear laws have the stiffness with which those hold the pin's load,
    and the dashpot of Kelvin and Voigt a damping ratio of some per cent. IMPACT has its common set of values.
    """
    k = paper_machine.stiffness(clearance_mm)
    linear = RESTING_FORCE / Hertz(stiffness=k).resting_depth(RESTING_FORCE)
    laws: dict[str, NormalLaw] = {
        name: law(stiffness=k, restitution=restitution) for name, law in POWER_LAWS.items()
    }
    laws["hertz"] = Hertz(stiffness=k)
    laws["kelvin_voigt"] = KelvinVoigt(stiffness=linear, damping=1e5)
    laws["anagnostopoulos"] = Anagnostopoulos(stiffness=linear, restitution=restitution)
    laws["adams_impact"] = AdamsImpact(stiffness=k, full_damping=5e4, full_damping_depth=1e-4)
    bearing = paper_machine.bearing(clearance_mm)
    return laws | {name: cylinder_law(name, bearing, restitution) for name in CYLINDER_LAWS}


def friction_laws(sliding_coefficient: float) -> dict[str, FrictionLaw]:
    """Every friction law but none, with static coefficients a quarter above the sliding one."""
    static = 1.25 * sliding_coefficient
    return {
        "ambrosio": Ambrosio(sliding_coefficient=sliding_coefficient),
        "cubic_coulomb": CubicCoulomb(sliding_coefficient=sliding_coefficient),
        "threlfall": Threlfall(sliding_coefficient=sliding_coefficient),
        "bengisu_akay": BengisuAkay(static_coefficient=static, sliding_coefficient=sliding_coefficient),
        "stribeck": Stribeck(static_coefficient=static, sliding_coefficient=sliding_coefficient),
        "brown_mcphee": BrownMcPhee(static_coefficient=static, sliding_coefficient=sliding_coefficient),
        "lugre": LuGre(static_coefficient=static, sliding_coefficient=sliding_coefficient),
    }


def title(name: str) -> str:
    """A law's name for readers: authors with a dash between them."""
    special = {
        "adams_impact": "ADAMS IMPACT",
        "esdu_78035": "ESDU 78035",
        "lugre": "LuGre",
        "cubic_coulomb": "Coulomb, cubic STEP",
        "brown_mcphee": "Brown-McPhee",
        "herbert_mcwhannell": "Herbert-McWhannell",
    }
    return special.get(name) or "-".join(part.capitalize() for part in name.split("_"))
