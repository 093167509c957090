"""Pins and guides with clearance as people write them: clearance, restitution, friction; the rest is usual.

Laws and materials are named. A law that needs more than a stiffness and a restitution is given in full.
"""

from __future__ import annotations

import dataclasses
import math
from abc import ABC
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from support_exudyn.files.toml.shapes import Names
from support_exudyn.model.guides import ClearanceGuide, Gaps, Guide, IdealGuide
from support_exudyn.model.machine import Machine, contact_length, links_stiffness
from support_exudyn.model.pins import CYLINDERS, ClearancePin, IdealPin, Stiffness, friction_of, on_cylinders
from user_forces.backing import in_series, pin_stiffness
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.materials import STEEL, STEEL_35CRMO, Material
from user_forces.normal.hysteresis import without_damping_speed
from user_forces.normal.law import NormalLaw
from user_forces.normal.power_laws import ElasticPower
from user_forces.values.units import Metres, MetresPerSecond, NewtonsPerMetre, NewtonsPerMetreToN
from user_forces.values.value import (
    Coefficient,
    InputError,
    NonNegative,
    Positive,
    Restitution,
    Value,
    Vector2,
    kinds_of,
    value,
)

MATERIALS: Mapping[str, Material] = MappingProxyType({one.name: one for one in (STEEL, STEEL_35CRMO)})
COEFFICIENT = "sliding_coefficient"
NEEDED = {"stiffness", "restitution"}  # all that the short form can give a law
NamedMaterial = Annotated[str, Names(MATERIALS)]
Length = Annotated[Positive, Field(le=10.0)]  # of any pin [m]: in a wrong unit it would be longer


def simple_laws() -> tuple[str, ...]:
    """Names of the laws that need a stiffness K of K depth^1.5 and a restitution at most."""
    return tuple(sorted(name for name, law in kinds_of(NormalLaw).items() if _is_simple(law)))


def _is_simple(law: type[Value]) -> bool:
    info: Mapping[str, Any] = law.__pydantic_fields__  # type: ignore[attr-defined]
    of_power = issubclass(law, ElasticPower) and info["exponent"].default == 1.5
    return needed_by(law) <= NEEDED and (of_power or not info.keys() & {"stiffness", "exponent"})


def simple_friction_laws() -> tuple[str, ...]:
    """Names of the friction laws that need one coefficient at most."""
    return tuple(sorted(name for name, law in kinds_of(FrictionLaw).items() if len(needed_by(law)) <= 1))


def needed_by(law: type[Value]) -> set[str]:
    """Names of the fields that a law has no default for."""
    info: Mapping[str, Any] = law.__pydantic_fields__  # type: ignore[attr-defined]
    return {name for name, one in info.items() if one.is_required()}


IN_FULL = (
    "{key} takes laws of {takes} only; give any other in full, {place}{{ type = ..., ... }}; one of your own "
    'as {key} = "FILE.py:CLASS", with --import FILE'
)
OF_JOINTS = 'type = "ClearancePin" and in [pins.NAME.contact], or "ClearanceGuide" and in it, normal = '
SimpleLaw = Annotated[
    str, Names(simple_laws, IN_FULL.format(key="law", takes="stiffness and restitution", place=OF_JOINTS))
]
SimpleFriction = Annotated[
    str,
    Names(
        simple_friction_laws,
        IN_FULL.format(key="friction_law", takes="one coefficient", place="friction = "),
    ),
]


@value
class ShortContact(Value, ABC):
    """What pins and guides with clearance have in common, in few words.

    Arguments:
        restitution: of an impact, > 0 and <= 1; 0.9 by default.
        friction: sliding coefficient of Ambrosio's law, >= 0 and <= 5, 0: none; or a friction law as a table.
        friction_law: one that needs a single coefficient, which `friction` is; Ambrosio's by default. Of one's
            own by its place, "my_laws.py:MyFriction".
        law: of the normal force: one that needs a stiffness and a restitution only; Exact by default. Of one's
            own by its place, "my_laws.py:MyLaw".
        rest_velocity: smallest velocity that the damping is scaled with [m/s], > 0; the law's own by default.
    """

    UNUSED_WITH_A_STIFFNESS: ClassVar[tuple[str, ...]] = ()

    restitution: Restitution | None = None
    friction: Coefficient | FrictionLaw = 0.0
    friction_law: SimpleFriction | None = None
    law: SimpleLaw | None = None
    rest_velocity: MetresPerSecond[Positive] | None = None

    @classmethod
    def of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        """The fields without those of earlier versions."""
        return without_damping_speed(given)

    @model_validator(mode="after")
    def _nothing_is_left_unused(self) -> ShortContact:
        if self.friction_law is not None and isinstance(self.friction, FrictionLaw):
            raise ValueError("friction_law: and a law as friction are two; allowed: one of them")
        for name in self.UNUSED_WITH_A_STIFFNESS:
            if getattr(self, name) is not None and isinstance(getattr(self, "stiffness", None), float):
                raise ValueError(f"{name}: would be left unused beside a stiffness; allowed: one of them")
        return self

    @property
    def asked(self) -> dict[str, Any]:
        """What is given, as arguments of `simple`: laws and materials in place of their names."""
        given = {one.name: getattr(self, one.name) for one in dataclasses.fields(self)}
        for name, item in given.items():
            if name.endswith("_material") and isinstance(item, str):
                given[name] = MATERIALS[item]
        given["law"] = None if self.law is None else kinds_of(NormalLaw)[self.law]
        given["friction"] = self.chosen_friction
        del given["friction_law"]
        return {name: item for name, item in given.items() if item is not None}

    @property
    def chosen_friction(self) -> float | FrictionLaw:
        """The friction law, or the coefficient of the usual one."""
        if isinstance(self.friction, FrictionLaw) or self.friction_law is None:
            return self.friction
        law: Any = kinds_of(FrictionLaw)[self.friction_law]
        coefficient = next(iter(needed_by(law)), COEFFICIENT)
        if coefficient in law.__pydantic_fields__:
            return law(**{coefficient: self.friction})  # type: ignore[no-any-return]
        if self.friction:
            raise InputError(
                f"friction = {self.friction:g}: {self.friction_law} has no coefficient; allowed with it: to "
                "leave this out"
            )
        return law()  # type: ignore[no-any-return]

    @property
    def ideal_friction(self) -> FrictionLaw | None:
        """The friction law of the joint without clearance; None without friction."""
        law = friction_of(self.chosen_friction)
        return None if isinstance(law, Frictionless) else law


@value
class ShortPin(ShortContact):
    """A pin with clearance, in few words.

    Arguments: those of `ShortContact`, and

        clearance: radial, bore radius minus journal radius [m], >= 0; 0 is an ideal pin, which keeps its
            friction at the radius of the bore and ignores all else.
        bore_radius: [m], > 0; the machine's file may say it for the pin.
        stiffness: "cylinders": the pin along its length; the rest are K of K depth^1.5: "paper": Eq. 5 of the
            paper, two spheres; "internal": a sphere in a hollow sphere; or a number [N/m^1.5], > 0. "cylinders"
            where the length is known and the law allows it, else "paper", by default.
        length: of the contact, along the pin's axis [m], > 0 and <= 10; the machine's file may say it for the
            pin.
        backing_stiffness: of pin and link behind the contact of cylinders: "rigid", a number [N/m], > 0, or
            "estimated" from the pin's bending and shear and the links' sections, the default.
        bore_material, journal_material: names or tables; steel and 35CrMo by default.
        bore: which of the two bodies of the pin's place carries the bore.
        eccentricity: of the journal's centre from the bore's at the start [m], forward and up.
    """

    UNUSED_WITH_A_STIFFNESS: ClassVar[tuple[str, ...]] = ("bore_material", "journal_material")

    clearance: Metres[NonNegative]
    bore_radius: Metres[Positive] | None = None
    stiffness: Stiffness | NewtonsPerMetreToN[Positive] | None = None
    length: Metres[Length] | None = None
    backing_stiffness: Literal["estimated", "rigid"] | NewtonsPerMetre[Positive] | None = None
    bore_material: NamedMaterial | Material | None = None
    journal_material: NamedMaterial | Material | None = None
    bore: Literal["first", "second"] = ClearancePin.bore
    eccentricity: Metres[Vector2] = ClearancePin.eccentricity

    def ideal(self, bore_radius: float | None) -> IdealPin:
        """The pin without clearance; bore_radius: of the machine's file [m], if this has none."""
        friction = self.ideal_friction
        return IdealPin() if friction is None else IdealPin(friction=friction, radius=self.radius(bore_radius))

    def radius(self, bore_radius: float | None) -> float:
        """Radius of the bore [m], of this or of the machine's file. Raises InputError without either."""
        radius = bore_radius if self.bore_radius is None else self.bore_radius
        if radius is None:
            raise InputError(
                "bore_radius_mm: missing, and the machine's file says none for this pin; "
                "allowed: > 0, here or there"
            )
        return radius


def pin_in_machine(short: ShortPin, machine: Machine, name: str, bore_radius: float | None) -> ClearancePin:
    """A pin in full: length of the contact and stiffness of the links are those of the machine.

    Arguments:
        short: the pin.
        machine: with or without a pin of this name; without, length and links are unknown.
        name: of the pin.
        bore_radius: of the machine's file [m], None if it has none.

    Raises InputError, in the keys and units of files, if the journal fills the bore or a length is missing.
    """
    asked, length, radius = short.asked, short.length, short.radius(bore_radius)
    if short.clearance >= radius:
        raise InputError(
            f"clearance_mm = {1e3 * short.clearance:g}: leaves no journal in a bore of bore_radius_mm = "
            f"{1e3 * radius:g}; allowed: > 0 and < {1e3 * radius:g}"
        )
    is_known = name in machine.linkage().pins
    if length is None and is_known:
        length = contact_length(machine, name)
    if short.stiffness == CYLINDERS and length is None:
        raise InputError(
            "length_mm: missing, and the machine's file has none for this pin below [width_mm.pins]; "
            "allowed: > 0, here or there"
        )
    along = on_cylinders(short.stiffness, length, asked.get("law"))
    if short.backing_stiffness is not None and not along:
        raise InputError(
            'backing_stiffness: is of stiffness = "cylinders" alone; allowed without it: to leave this out'
        )
    if along and length is not None:
        asked["length"] = length
        if short.backing_stiffness == "rigid":
            asked["backing_stiffness"] = math.inf
        elif not isinstance(short.backing_stiffness, float):
            bore, journal = asked.get("bore_material", STEEL), asked.get("journal_material", STEEL_35CRMO)
            links = links_stiffness(machine, name, bore) if is_known else math.inf
            of_pin = pin_stiffness(radius - short.clearance, length, journal)
            asked["backing_stiffness"] = in_series((of_pin, links))
    return ClearancePin.simple(**asked | {"bore_radius": radius})


@value
class ShortGuide(ShortContact):
    """A guide with clearance, in few words.

    Arguments: those of `ShortContact`, and

        clearance: gap between block and wall at the start [m], >= 0, on either side; or gaps to the upper and
            the lower wall; 0 is an ideal guide, which keeps its friction and shape and ignores all else. Upper
            is the side to which a quarter turn counterclockwise leads from the direction of the guide.
        block: length and height of the block [m], > 0; the machine's file may say it for the guide.
        pin_radius: of a round pin in place of a block [m], > 0; for guides that let turn.
        stiffness: K of K depth^1.5 at every corner [N/m^1.5], > 0; Hertz's of a sphere on a plane by
            default.
        corner_radius: of that sphere [m], > 0; the pin's, or a tenth of the block's height by default.
        wall_material, block_material: names or tables; steel and 35CrMo by default.
    """

    UNUSED_WITH_A_STIFFNESS: ClassVar[tuple[str, ...]] = ("corner_radius", "wall_material", "block_material")

    clearance: Metres[NonNegative | Gaps]
    block: Metres[tuple[Positive, Positive]] | None = None
    pin_radius: Metres[Positive] | None = None
    stiffness: NewtonsPerMetreToN[Positive] | None = None
    corner_radius: Metres[Positive] | None = None
    wall_material: NamedMaterial | Material | None = None
    block_material: NamedMaterial | Material | None = None

    @model_validator(mode="after")
    def _has_one_shape(self) -> ShortGuide:
        if self.block is not None and self.pin_radius is not None:
            raise ValueError("block: and pin_radius are two shapes; allowed: one of them")
        return self

    def guide(self, block: tuple[float, float] | None = None) -> Guide:
        """The guide in full; block: length and height of the machine's file [m], if this has none."""
        shape = self.block or (None if self.pin_radius else block)
        if self.clearance in (0.0, (0.0, 0.0)):  # as at the end of a sweep over clearances
            friction = self.ideal_friction
            if friction is None:
                return IdealGuide()
            return IdealGuide(friction=friction, block=shape, pin_radius=self.pin_radius)
        if shape is None and self.pin_radius is None:
            raise InputError(
                "block_mm: missing, and the machine's file says none for this guide; "
                "allowed: [length, height], or pin_radius_mm of a pin"
            )
        asked = self.asked
        return ClearanceGuide.simple(gaps=asked.pop("clearance"), **asked | {"block": shape})
