"""Laws from few numbers, as short forms give them: a stiffness, a restitution, a coefficient of friction."""

from __future__ import annotations

from typing import Any

from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.normal.law import NormalLaw
from user_forces.values.value import InputError, short

USUAL_RESTITUTION = 0.9


def friction_of(friction: float | FrictionLaw) -> FrictionLaw:
    """Ambrosio's law with a sliding coefficient, none for 0; a law as it is."""
    if isinstance(friction, FrictionLaw):
        return friction
    return Ambrosio(sliding_coefficient=friction) if friction != 0.0 else Frictionless()


def law_with(law: type[NormalLaw], **asked: Any) -> NormalLaw:
    """A law with a stiffness, a restitution and a rest velocity, as far as they are asked for and not None.

    Raises InputError if one is asked for that it has not.
    """
    has = fields_of(law)
    given = {name: number for name, number in asked.items() if number is not None}
    for name, number in given.items():
        if name not in has:
            raise InputError(f"{name} = {short(number)}: {law.__name__} has none; allowed: to leave it out")
    if "restitution" in has:
        given.setdefault("restitution", USUAL_RESTITUTION)
    return law(**given)


def fields_of(law: Any) -> set[str]:
    """Names of the fields of a class of laws. Raises InputError if it is none that can be made."""
    is_law = isinstance(law, type) and issubclass(law, NormalLaw)
    fields = getattr(law, "__dataclass_fields__", None) if is_law else None
    if fields is not None:
        return set(fields)
    raise InputError(
        f"law = {short(law)}: allowed: a class of normal laws that needs a stiffness and a restitution only, "
        "such as Flores; with any other law make ClearancePin(contact=JournalContact(...))"
    )
