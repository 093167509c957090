"""The laws that are compared, by the names under which studies report them: all that `user_forces` has."""

from dataclasses import fields
from typing import Any

from studies.common import paper_machine
from user_forces import (
    STEEL,
    STEEL_35CRMO,
    CylinderLaw,
    FrictionLaw,
    Hertz,
    JournalBearing,
    NormalLaw,
    PowerLaw,
    effective_modulus,
    laws,
)
from user_forces import catalogue as found

POWER_LAWS = laws(PowerLaw)  # F = K depth^n (1 + chi rate / w)
CYLINDER_LAWS = laws(CylinderLaw)
OTHER_LAWS = {n: law for n, law in laws(NormalLaw).items() if n not in POWER_LAWS | CYLINDER_LAWS}
FRICTION_LAWS = laws(FrictionLaw)
PIN_LENGTH = 0.1  # of the rear-link pin's bearing, for laws of line contact; assumed [m]
RESTING_FORCE = 51e3  # of the rear-link pin, about [N]
# of the dashpots, by the stiffness of a linear law: Kelvin and Voigt's and IMPACT's [s], and its depth [m]
DAMPING_TIME, FULL_DAMPING_TIME, FULL_DAMPING_DEPTH = 3e-4, 1.5e-4, 1e-4


def cylinder_law(name: str, bearing: JournalBearing, restitution: float, length: float = PIN_LENGTH) -> Any:
    """A law of line contact, steel on 35CrMo, for a bearing of a length [m]."""
    modulus = effective_modulus(STEEL, STEEL_35CRMO)
    return CYLINDER_LAWS[name](
        bearing=bearing, length=length, effective_modulus=modulus, restitution=restitution
    )


def pin_length(bore_radius: float) -> float:
    """Length of a bearing [m], assumed in proportion to its bore radius [m]."""
    return PIN_LENGTH * bore_radius / paper_machine.BORE_RADIUS


def normal_laws(
    clearance_mm: float,
    restitution: float,
    *,
    bore_radius: float = paper_machine.BORE_RADIUS,
    stiffness: float | None = None,
    load: float = RESTING_FORCE,
    length: float | None = None,
) -> dict[str, NormalLaw]:
    """Every normal law for a pin, by name; the rear-link pin's, unless told otherwise.

    Laws K depth^1.5 have the stiffness of Eq. 5; linear laws that with which those hold the pin's load. The
    dashpot of Kelvin and Voigt has a damping ratio of some per cent. IMPACT has its common set of values.

    Arguments:
        clearance_mm: radial clearance [mm].
        restitution: e that is asked for [-].
        bore_radius: of the pin [m].
        stiffness: K of the laws K depth^1.5 [N/m^1.5]; None: that of Eq. 5.
        load: that the pin holds at rest [N].
        length: of the contact in laws of line contact [m]; None: assumed, see `pin_length`.
    """
    along = pin_length(bore_radius) if length is None else length
    k = paper_machine.stiffness(clearance_mm, bore_radius) if stiffness is None else stiffness
    linear = load / Hertz(stiffness=k).resting_depth(load)
    given = {
        "restitution": restitution,
        "damping": DAMPING_TIME * linear,
        "full_damping": FULL_DAMPING_TIME * linear,
        "full_damping_depth": FULL_DAMPING_DEPTH,
    }
    bearing = paper_machine.bearing(clearance_mm, bore_radius)
    return {
        **{
            name: _filled(law, given | {"stiffness": linear if _is_linear(law) else k})
            for name, law in (POWER_LAWS | OTHER_LAWS).items()
        },
        **{name: cylinder_law(name, bearing, restitution, along) for name in CYLINDER_LAWS},
    }


def friction_laws(sliding_coefficient: float) -> dict[str, FrictionLaw]:
    """Every friction law but none, by name, with static coefficients a quarter above the sliding one."""
    given = {"sliding_coefficient": sliding_coefficient, "static_coefficient": 1.25 * sliding_coefficient}
    return {name: _filled(law, given) for name, law in FRICTION_LAWS.items()}


def _filled(law: Any, given: dict[str, float]) -> Any:
    """A law with those of the numbers given that it has fields for."""
    return law(**{field.name: given[field.name] for field in fields(law) if field.name in given})


def _is_linear(law: Any) -> bool:
    return any(field.name == "exponent" and field.default == 1.0 for field in fields(law))


def title(name: str) -> str:
    """A law's name for readers; a name that is no law's as it is, in words."""
    law: Any = (POWER_LAWS | CYLINDER_LAWS | OTHER_LAWS | FRICTION_LAWS).get(name)
    return found.title(law) if law else name.capitalize()
