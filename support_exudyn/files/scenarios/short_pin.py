"""A pin as people write it: clearance, restitution, friction; the rest has usual values."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from support_exudyn.files.scenarios.short_laws import (
    NamedMaterial,
    fields_of_law,
    friction_in_full,
    friction_in_short,
    law_in_full,
    material_of,
    simple_friction_laws,
    simple_laws,
)
from support_exudyn.files.toml.shapes import GroupShape, Names
from support_exudyn.model.machine import Machine
from support_exudyn.model.pin_surroundings import contact_length, links_stiffness
from support_exudyn.model.pins import CYLINDERS, ClearancePin, IdealPin, Stiffness, on_cylinders
from support_exudyn.model.simple_laws import friction_of
from user_forces.backing import in_series, pin_stiffness
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Frictionless
from user_forces.materials import STEEL, STEEL_35CRMO, Material
from user_forces.normal.hysteresis import without_damping_speed
from user_forces.normal.law import NormalLaw
from user_forces.values.units import Metres, MetresPerSecond, NewtonsPerMetre, NewtonsPerMetreToN
from user_forces.values.value import (
    Coefficient,
    InputError,
    NonNegative,
    Positive,
    Restitution,
    Value,
    Vector2,
    value,
)

Length = Annotated[Positive, Field(le=10.0)]  # of any pin [m]: in a wrong unit it would be longer
_law_in_full = partial(law_in_full, where="in [pins.NAME.contact] normal = ")


@value
class ShortPin(Value):
    """A pin with clearance, in few words.

    Arguments:
        clearance: radial, bore radius minus journal radius [m], >= 0; 0 is an ideal pin, which keeps its
            friction at the radius of the bore and ignores all else.
        bore_radius: [m], > 0; the machine's file may say it for the pin.
        restitution: of an impact, > 0 and <= 1; 0.9 if nothing is said.
        friction: sliding coefficient of Ambrosio's law, >= 0 and <= 5, 0: none; or a friction law as a table.
        friction_law: one that needs a single coefficient, which `friction` is; Ambrosio's if nothing is said.
            Of one's own by its place, "my_laws.py:MyFriction".
        law: of the normal force: one that needs a stiffness and a restitution only; Exact if nothing is said.
            Of one's own by its place, "my_laws.py:MyLaw".
        rest_velocity: smallest velocity that the damping is scaled with [m/s], > 0; the law's own by default.
        stiffness: "cylinders": the pin along its length; the rest are K of K depth^1.5: "paper": Eq. 5 of the
            paper, two spheres; "internal": a sphere in a hollow sphere; or a number [N/m^1.5], > 0. "cylinders"
            where the length is known and the law allows it, else "paper", if nothing is said.
        length: of the contact, along the pin's axis [m], > 0 and <= 10; the machine's file may say it for the
            pin.
        backing_stiffness: of pin and link behind the contact of cylinders: "rigid", a number [N/m], > 0, or
            "estimated" from the pin's bending and shear and the links' sections; so if nothing is said.
        bore_material, journal_material: names or tables; steel and 35CrMo if nothing is said.
        bore: which of the two bodies of the pin's place carries the bore.
        eccentricity: of the journal's centre from the bore's at the start [m], forward and up.
    """

    clearance: Metres[NonNegative]
    bore_radius: Metres[Positive] | None = None
    restitution: Restitution | None = None
    friction: Coefficient | FrictionLaw = 0.0
    friction_law: Annotated[str, Names(simple_friction_laws, instead=friction_in_full)] | None = None
    law: Annotated[str, Names(simple_laws, instead=_law_in_full)] | None = None
    rest_velocity: MetresPerSecond[Positive] | None = None
    stiffness: Stiffness | NewtonsPerMetreToN[Positive] | None = None
    length: Metres[Length] | None = None
    backing_stiffness: Literal["estimated", "rigid"] | NewtonsPerMetre[Positive] | None = None
    bore_material: NamedMaterial | Material | None = None
    journal_material: NamedMaterial | Material | None = None
    bore: Literal["first", "second"] = ClearancePin.bore
    eccentricity: Metres[Vector2] = ClearancePin.eccentricity

    @classmethod
    def _of_earlier(cls, given: Mapping[str, Any]) -> Mapping[str, Any]:
        return without_damping_speed(given)

    @model_validator(mode="after")
    def _nothing_is_left_unused(self) -> ShortPin:
        for name in ("restitution", "rest_velocity"):
            if self.law and getattr(self, name) is not None and name not in fields_of_law(self.law):
                raise ValueError(f"{name}: the law {self.law} has none; allowed with it: to leave this out")
        if self.friction_law is not None and isinstance(self.friction, FrictionLaw):
            raise ValueError("friction_law: and a law as friction are two; allowed: one of them")
        for name in ("bore_material", "journal_material"):
            if getattr(self, name) is not None and isinstance(self.stiffness, float):
                raise ValueError(
                    f"{name}: would be left unused, for the stiffness is given as a number; "
                    "allowed: one of them"
                )
        return self

    def ideal(self, bore_radius: float | None) -> IdealPin:
        """The pin without clearance; bore_radius: of the machine's file [m], if this has none."""
        friction = friction_of(friction_in_short(self.friction, self.friction_law))
        if isinstance(friction, Frictionless):
            return IdealPin()
        return IdealPin(friction=friction, radius=self._radius(bore_radius))

    def _radius(self, bore_radius: float | None) -> float:
        """Radius of the bore [m], of this or else of the machine's file. Raises InputError without either."""
        radius = bore_radius if self.bore_radius is None else self.bore_radius
        if radius is None:
            raise InputError(
                "bore_radius_mm: missing, and the machine's file says none for this pin; "
                "allowed: > 0, here or there"
            )
        return radius

    def pin(
        self,
        bore_radius: float | None = None,
        length: float | None = None,
        links: Callable[[Material], float] = lambda material: math.inf,
    ) -> ClearancePin:
        """The pin in full.

        Arguments:
            bore_radius, length: of the machine's file [m], if this has none.
            links: stiffness [N/m] of the links that the pin joins, of a material.
        """
        radius = self._radius(bore_radius)
        if self.clearance >= radius:  # which the class says in metres
            raise InputError(
                f"clearance_mm = {1e3 * self.clearance:g}: leaves no journal in a bore of bore_radius_mm = "
                f"{1e3 * radius:g}; allowed: > 0 and < {1e3 * radius:g}"
            )
        law: Any = None if self.law is None else GroupShape((NormalLaw,)).kinds[self.law]
        length = length if self.length is None else self.length
        if self.stiffness == CYLINDERS and length is None:
            raise InputError(
                "length_mm: missing, and the machine's file says none for this pin below [width_mm.pins]; "
                "allowed: > 0, here or there"
            )
        bore, journal = material_of(self.bore_material, STEEL), material_of(self.journal_material, STEEL_35CRMO)
        along = on_cylinders(self.stiffness, length, law)
        if self.backing_stiffness is not None and not along:
            raise InputError(
                'backing_stiffness: is of stiffness = "cylinders" alone; allowed without it: to leave this out'
            )
        backing = None
        if along and length is not None:
            backing = self._backing(radius, length, journal, links(bore))
        return ClearancePin.simple(
            clearance=self.clearance,
            bore_radius=radius,
            restitution=self.restitution,
            friction=friction_in_short(self.friction, self.friction_law),
            law=law,
            rest_velocity=self.rest_velocity,
            stiffness=self.stiffness,
            length=length if along else self.length,
            backing_stiffness=backing,
            bore_material=bore,
            journal_material=journal,
            bore=self.bore,
            eccentricity=self.eccentricity,
        )

    def _backing(self, bore_radius: float, length: float, journal: Material, links: float) -> float:
        """Stiffness [N/m] of pin and links behind the contact; infinite if it is rigid."""
        if isinstance(self.backing_stiffness, float):
            return self.backing_stiffness
        if self.backing_stiffness == "rigid":
            return math.inf
        return in_series((pin_stiffness(bore_radius - self.clearance, length, journal), links))


def pin_in_machine(short: ShortPin, machine: Machine, name: str, bore_radius: float | None) -> ClearancePin:
    """A pin with what the machine knows of it: the length of its contact, and the links that it joins.

    Arguments:
        short: what is said of the pin.
        machine: with a pin of this name, or without one: then nothing is known.
        name: of the pin.
        bore_radius: of the machine's file [m], None if it says none.
    """
    if name not in machine.linkage().pins:
        return short.pin(bore_radius)
    length = contact_length(machine, name)
    return short.pin(bore_radius, length, partial(links_stiffness, machine, name))
