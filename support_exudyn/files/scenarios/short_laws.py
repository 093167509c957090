"""Laws and materials as short forms of pins and guides name them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType
from typing import Annotated, Any

from support_exudyn.files.toml.shapes import GroupShape, Names
from user_forces.friction.law import FrictionLaw
from user_forces.materials import STEEL, STEEL_35CRMO, Material
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_laws import ElasticPower
from user_forces.values.value import InputError, Value

MATERIALS: Mapping[str, Material] = MappingProxyType({one.name: one for one in (STEEL, STEEL_35CRMO)})
COEFFICIENT = "sliding_coefficient"
NEEDED = {"stiffness", "restitution"}  # all that the short form can give a law
NamedMaterial = Annotated[str, Names(MATERIALS)]


def simple_laws() -> tuple[str, ...]:
    """Names of the laws that need a stiffness K of K depth^1.5 and a restitution at most."""
    known = GroupShape((NormalLaw,)).kinds.items()
    return tuple(name for name, law in known if _is_simple(law))


def _is_simple(law: type[Value]) -> bool:
    info: Mapping[str, Any] = law.__pydantic_fields__  # type: ignore[attr-defined]
    of_power = issubclass(law, ElasticPower) and info["exponent"].default == 1.5
    return needed_by(law) <= NEEDED and (of_power or not info.keys() & {"stiffness", "exponent"})


def simple_friction_laws() -> tuple[str, ...]:
    """Names of the friction laws that need one coefficient at most."""
    known = GroupShape((FrictionLaw,)).kinds.items()
    return tuple(name for name, law in known if len(needed_by(law)) <= 1)


def needed_by(law: type[Value]) -> set[str]:
    """Names of the fields that a law has no default for."""
    info: Mapping[str, Any] = law.__pydantic_fields__  # type: ignore[attr-defined]
    return {name for name, one in info.items() if one.is_required()}


def law_in_full(name: str, where: str) -> str:
    """What to do with a law that a short form has no room for, or that is not known; where: it goes in full."""
    return _in_full(name, NormalLaw, "law", "stiffness and restitution", where)


def friction_in_full(name: str) -> str:
    """What to do with a friction law that a short form has no room for, or that is not known."""
    return _in_full(name, FrictionLaw, "friction_law", "one coefficient", "friction = ")


def _in_full(name: str, base: type[Value], key: str, takes: str, place: str) -> str:
    known = GroupShape((base,)).kinds
    if name not in known:
        return f'a law of your own: {key} = "FILE.py:CLASS", with --import FILE'
    needed = ", ".join(sorted(needed_by(known[name]))) or "fields of its own"
    kind = "ClearanceGuide" if "guides" in place else "ClearancePin"
    pin = f'type = "{kind}" and ' if base is NormalLaw else ""
    return (
        f"{key} takes laws of {takes} only, and {name} has {needed}: give it in full, "
        f'{pin}{place}{{ type = "{name}", ... }}'
    )


def friction_in_short(friction: float | FrictionLaw, name: str | None) -> float | FrictionLaw:
    """The law, or the coefficient of the usual one.

    name: of a law that takes one coefficient, which `friction` is then; None: Ambrosio's.
    """
    if isinstance(friction, FrictionLaw):
        return friction
    if name is not None:
        law: Any = GroupShape((FrictionLaw,)).kinds[name]
        coefficient = next(iter(needed_by(law)), COEFFICIENT)
        takes = coefficient in law.__pydantic_fields__
        if friction and not takes:
            raise InputError(
                f"friction = {friction:g}: {name} has no coefficient; allowed with it: to leave this out"
            )
        return law(**({coefficient: friction} if takes else {}))  # type: ignore[no-any-return]
    return friction


def fields_of_law(law: str) -> set[str]:
    """Names of the fields of a normal law, by its name."""
    return {one.name for one in fields(GroupShape((NormalLaw,)).kinds[law])}  # type: ignore[arg-type]


def material_of(given: str | Material | None, usual: Material) -> Material:
    """A material by its name, or as it is; the usual one if nothing is said."""
    if given is None:
        return usual
    return given if isinstance(given, Material) else MATERIALS[given]
