"""The kinds of pins: ideal, with clearance, and whatever derives from `Pin`. A field of the scenario chooses.

A kind is one class, which answers what every stage asks of a pin; its channels, see `mechanics.joint_channels`;
and what stands for it in the engine, see `formulations.exudyn.scene.scene_builder`.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, Final, Literal

from pydantic import model_validator

from support_exudyn.model.linkage import PinPlace
from support_exudyn.model.loads.load import ActingLoad
from user_forces.backing import pin_stiffness
from user_forces.contact import JournalContact
from user_forces.friction.law import FrictionLaw
from user_forces.friction.laws import Ambrosio, Frictionless
from user_forces.journal import JournalBearing
from user_forces.materials import (
    STEEL,
    STEEL_35CRMO,
    Material,
    effective_modulus,
    external_contact_stiffness,
    internal_contact_stiffness,
)
from user_forces.normal.law import NormalLaw
from user_forces.normal.pin_in_bore import PinInBore, lends_damping
from user_forces.normal.power_laws import Exact
from user_forces.values.units import Metres
from user_forces.values.value import InputError, Positive, Value, Vector2, short, value

HERTZ_EXPONENT = 1.5
USUAL_RESTITUTION = 0.9
HERTZ = {"paper": external_contact_stiffness, "internal": internal_contact_stiffness}
CYLINDERS: Final = "cylinders"
Stiffness = Literal["cylinders", "paper", "internal"]


class Pin(Value, ABC):
    """What joins two bodies at a place of the machine."""

    holds: ClassVar[bool]  # whether both bodies share a point, by two constraints

    @property
    def offset(self) -> Vector2:
        """The second body's point minus that of the first at the start [m]."""
        return (0.0, 0.0)

    def refused_in_space(self) -> tuple[str, str] | None:
        """What of the pin is of the plane alone, and what is allowed, in words; None: nothing."""
        return None

    def losses(self) -> dict[str, object]:
        """What of the pin loses energy, by the channel that counts it: "damping_loss" and "friction_loss"."""
        return {}


@value
class IdealPin(Pin):
    """The two bodies share a point: two position constraints, whose multipliers are the pin force.

    With friction a moment radius * law(radius * spin, pin force) acts against the turning of the two bodies.

    Arguments:
        friction: law of the friction in the pin; None: none at all.
        radius: of the pin's surface [m], > 0; given together with friction.
    """

    holds: ClassVar[bool] = True
    friction: FrictionLaw | None = None
    radius: Metres[Positive] | None = None

    @model_validator(mode="after")
    def _friction_has_a_radius(self) -> IdealPin:
        if (self.friction is None) != (self.radius is None):
            raise ValueError(
                f"friction = {self.friction}, radius = {self.radius}: allowed: both, or None for both"
            )
        return self

    def refused_in_space(self) -> tuple[str, str] | None:
        """Friction is of the plane alone."""
        if self.friction is None:
            return None
        return ("IdealPin with friction", "IdealPin without, or ClearancePin")

    def losses(self) -> dict[str, object]:
        """An ideal pin loses energy by friction."""
        return {} if self.friction is None else {"friction_loss": self.friction}


@value
class ClearancePin(Pin):
    """A journal that is free in its bore and pushed by contact.

    Arguments:
        contact: bearing, normal law and friction law.
        bore: which of the two bodies of the pin's place carries the bore.
        eccentricity: of the journal's centre from the bore's at the start [m], forward and up; up to the
            clearance it is free, beyond it is pressed in. The bodies are laid out for it, see `eccentric`.
        length: of the contact, along the axis [m], for its pressure; None: as the law or the machine knows it.
        bore_material, journal_material: by whose yield strength the pressure is judged.
    """

    holds: ClassVar[bool] = False
    contact: JournalContact
    bore: Literal["first", "second"] = "first"
    eccentricity: Metres[Vector2] = (0.0, 0.0)
    length: Metres[Positive] | None = None
    bore_material: Material = STEEL
    journal_material: Material = STEEL_35CRMO

    @classmethod
    def simple(
        cls,
        *,
        clearance: float,
        bore_radius: float,
        restitution: float | None = None,
        friction: float | FrictionLaw = 0.0,
        law: type[NormalLaw] | None = None,
        rest_velocity: float | None = None,
        stiffness: Stiffness | float | None = None,
        length: float | None = None,
        backing_stiffness: float | None = None,
        bore_material: Material = STEEL,
        journal_material: Material = STEEL_35CRMO,
        bore: Literal["first", "second"] = "first",
        eccentricity: Vector2 = (0.0, 0.0),
    ) -> ClearancePin:
        """A clearance pin in few words, as scenario files have it; the rest has usual values.

            ClearancePin.simple(clearance=0.5e-3, bore_radius=0.06, length=0.5, restitution=0.9, friction=0.1)

        Arguments:
            clearance: radial, bore radius minus journal radius [m], > 0.
            bore_radius: [m], > clearance; `load_machine(NAME).bore_radii` has those of a machine.
            restitution: of an impact, > 0 and <= 1; 0.9 if nothing is said.
            friction: sliding coefficient of Ambrosio's law, >= 0, 0: none; or a friction law.
            law: class of the normal force, one that needs nothing but a stiffness and a restitution; the
                default `Exact` delivers the restitution.
            rest_velocity: smallest velocity that the damping is scaled with [m/s], > 0; the law's own if None.
            stiffness: "cylinders": the pin along its length, `PinInBore`; the rest are K of K depth^1.5:
                "paper": Eq. 5 of the paper, two spheres; "internal": a sphere in a hollow sphere; or a number
                [N/m^1.5], > 0. By default "cylinders" with a length and a law that allows it, else "paper".
            length: of the contact, along the axis [m], > 0.
            backing_stiffness: of pin and link behind the contact of cylinders [N/m], > 0; inf: rigid; by
                default that of the pin's bending and shear.
            bore_material, journal_material: for the stiffness.
            bore: which of the two bodies of the pin's place carries the bore.
            eccentricity: of the journal's centre from the bore's at the start [m], forward and up.

        Raises InputError that names what does not fit, its value and what is allowed.
        """
        bearing = JournalBearing(bore_radius=bore_radius, clearance=clearance)
        materials, kind = (bore_material, journal_material), law or Exact
        given = {"restitution": restitution, "rest_velocity": rest_velocity}
        normal: NormalLaw
        if on_cylinders(stiffness, length, law):
            normal, length = _on_cylinders(bearing, kind, length, backing_stiffness, materials, given), None
        elif backing_stiffness is not None:
            raise InputError(
                f"backing_stiffness = {backing_stiffness:g}: is of stiffness = {CYLINDERS!r} alone; "
                "allowed: to leave it out"
            )
        else:
            normal = _of_power(bearing, kind, stiffness, materials, given)
        return cls(
            contact=JournalContact(bearing=bearing, normal=normal, friction=friction_of(friction)),
            bore=bore,
            eccentricity=eccentricity,
            length=length,
            bore_material=bore_material,
            journal_material=journal_material,
        )

    @model_validator(mode="after")
    def _length_is_that_of_the_law(self) -> ClearancePin:
        own = getattr(self.contact.normal, "length", self.length)
        if self.length not in (None, own):
            raise ValueError(f"length = {self.length} m: its law has {own} m; allowed: to leave it out")
        return self

    @property
    def offset(self) -> Vector2:
        """The second body's point minus that of the first at the start [m]."""
        x, y = self.eccentricity
        return (x, y) if self.bore == "first" else (-x, -y)

    def losses(self) -> dict[str, object]:
        """A clearance pin loses energy by the damping and the friction of its contact."""
        return {"damping_loss": self.contact.normal, "friction_loss": self.contact.friction}


class CompliantPin(Pin, ABC):
    """A pin without constraints: loads act between its two bodies. A new kind is a class with `loads`."""

    holds: ClassVar[bool] = False

    @abstractmethod
    def loads(self, place: PinPlace) -> Mapping[str, ActingLoad]:
        """What acts between the bodies of a place, by names of the pin's choice.

        Forces and moments are those of the first body on the second. The pin has the loads' channels.
        """

    def named_loads(self, name: str, place: PinPlace) -> dict[str, ActingLoad]:
        """The loads of a pin of this name, as "pin.NAME.LOAD"."""
        return {f"pin.{name}.{part}": load for part, load in self.loads(place).items()}

    def refused_in_space(self) -> tuple[str, str] | None:
        """Compliant pins are of the plane alone."""
        return (type(self).__name__, "IdealPin, ClearancePin")

    def losses(self) -> dict[str, object]:
        """A compliant pin loses energy by damping."""
        return {"damping_loss": self}


def on_cylinders(
    stiffness: Stiffness | float | None, length: float | None, law: type[NormalLaw] | None
) -> bool:
    """Whether a pin touches along its length: that is asked for, or nothing is, and length and law allow it."""
    if stiffness is None:
        return length is not None and (law is None or lends_damping(law))
    return stiffness == CYLINDERS


def _on_cylinders(
    bearing: JournalBearing,
    law: type[NormalLaw],
    length: float | None,
    backing: float | None,
    materials: tuple[Material, Material],
    given: Mapping[str, float | None],
) -> PinInBore:
    """The pin along its length, with the damping of a law; given: restitution and rest velocity."""
    fields_of(law)
    if length is None:
        raise InputError(f"length: missing; a pin with stiffness = {CYLINDERS!r} has one; allowed: > 0 m")
    if not lends_damping(law):
        raise InputError(
            f"law = {law.__name__}: has a force of its own; allowed with stiffness = {CYLINDERS!r}: laws that "
            "are a damping factor, such as Exact, Flores or LankaraniNikravesh"
        )
    if backing is None:
        backing = pin_stiffness(bearing.journal_radius, length, materials[1])
    numbers = {name: number for name, number in given.items() if number is not None}
    return PinInBore(
        bearing=bearing,
        length=length,
        effective_modulus=effective_modulus(*materials),
        backing_stiffness=None if backing == math.inf else backing,
        damping=law.__name__,
        **{"restitution": USUAL_RESTITUTION, **numbers},
    )


def _of_power(
    bearing: JournalBearing,
    law: type[NormalLaw],
    stiffness: str | float | None,
    materials: tuple[Material, Material],
    given: Mapping[str, float | None],
) -> NormalLaw:
    """A law of a stiffness and a restitution at most; given: restitution and rest velocity."""
    if stiffness is None and "stiffness" in fields_of(law):
        stiffness = "paper"
    number = stiffness
    if isinstance(stiffness, str) and "stiffness" in fields_of(law):
        if stiffness not in HERTZ:
            allowed = ", ".join(map(repr, (CYLINDERS, *HERTZ)))
            hint = "; what was 'external' is called 'paper'" if stiffness == "external" else ""
            raise InputError(f"stiffness = {short(stiffness)}: allowed: {allowed} or a number, > 0{hint}")
        number = HERTZ[stiffness](bearing, *materials)
    normal = law_with(law, stiffness=number, **given)
    if isinstance(stiffness, str) and getattr(normal, "exponent", HERTZ_EXPONENT) != HERTZ_EXPONENT:
        raise InputError(
            f"stiffness = {stiffness!r}: is of K depth^{HERTZ_EXPONENT}, and {law.__name__} is not; "
            "allowed with this law: a number"
        )
    return normal


# --- laws from few numbers, of pins and guides ---


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
