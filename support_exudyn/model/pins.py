"""The kinds of pins: ideal, with clearance, and whatever derives from `Pin`. A field of the scenario chooses.

A kind is one class, which answers what every stage asks of a pin; its channels, see `mechanics.pin_channels`;
and what stands for it in the engine, see `formulations.redundant.scene.scene_builder`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Literal, NamedTuple

from pydantic import model_validator

from user_forces.contact import JournalContact
from user_forces.friction.ambrosio import Ambrosio
from user_forces.friction.frictionless import Frictionless
from user_forces.friction.law import FrictionLaw
from user_forces.journal import JournalBearing
from user_forces.materials import (
    STEEL,
    STEEL_35CRMO,
    Material,
    external_contact_stiffness,
    internal_contact_stiffness,
)
from user_forces.normal.damping_speed import DampingSpeed
from user_forces.normal.lankarani_nikravesh import LankaraniNikravesh
from user_forces.normal.law import NormalLaw
from user_forces.values.units import Metres
from user_forces.values.value import InputError, Positive, Value, Vector2, short, value

USUAL_RESTITUTION = 0.9
HERTZ_EXPONENT = 1.5
HERTZ = {"external": external_contact_stiffness, "internal": internal_contact_stiffness}


class Refusal(NamedTuple):
    """What is not covered and what is: the part of the pin, such as ".contact", and words for both."""

    part: str
    what: str
    allowed: str


class Pin(Value, ABC):
    """What joins two bodies at a place of the machine."""

    @property
    @abstractmethod
    def holds(self) -> bool:
        """Whether the two bodies share a point, by two constraints; else forces follow from their motion."""

    @property
    def offset(self) -> Vector2:
        """The second body's point minus that of the first at the start [m]."""
        return (0.0, 0.0)

    @property
    def steepness(self) -> tuple[float, float, float]:
        """Stiffness that steps have to follow: against shifts forward and up [N/m], and turning [N m/rad]."""
        return (0.0, 0.0, 0.0)

    def refused_by(self, formulation: Literal["tree", "reduced", "space"]) -> Refusal | None:
        """What of the pin a formulation, or "space", the third dimension, does not cover; None: all is."""
        del formulation
        return None

    def losses(self) -> dict[str, object]:
        """What of the pin loses energy, by the channel that counts it: "damping_loss" and "friction_loss"."""
        return {}


@value
class IdealPin(Pin):
    """The two bodies share a point: two position constraints, whose multipliers are the pin force.

    With friction a moment radius * law(radius * spin, pin force) acts against the turning of the two bodies.

    Arguments:
        friction: a law without a state; None: none at all.
        radius: of the pin's surface [m], > 0; given together with friction.
    """

    friction: FrictionLaw | None = None
    radius: Metres[Positive] | None = None

    @model_validator(mode="after")
    def _friction_has_a_radius(self) -> IdealPin:
        if (self.friction is None) != (self.radius is None):
            raise ValueError(
                f"friction = {self.friction}, radius = {self.radius}: allowed: both, or None for both"
            )
        if self.friction is not None and self.friction.has_state:
            raise ValueError(f"friction = {type(self.friction).__name__}: allowed: laws without a state")
        return self

    @property
    def holds(self) -> bool:
        """An ideal pin holds its two bodies together."""
        return True

    def refused_by(self, formulation: Literal["tree", "reduced", "space"]) -> Refusal | None:
        """Friction is covered by the redundant formulation in the plane only."""
        del formulation
        if self.friction is None:
            return None
        return Refusal("", "IdealPin with friction", "IdealPin without, or ClearancePin")

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
    """

    contact: JournalContact
    bore: Literal["first", "second"] = "first"
    eccentricity: Metres[Vector2] = (0.0, 0.0)

    @classmethod
    def simple(
        cls,
        *,
        clearance: float,
        bore_radius: float,
        restitution: float | None = None,
        friction: float | FrictionLaw = 0.0,
        law: type[NormalLaw] = LankaraniNikravesh,
        damping_speed: DampingSpeed | None = None,
        stiffness: Literal["external", "internal"] | float = "external",
        bore_material: Material = STEEL,
        journal_material: Material = STEEL_35CRMO,
        bore: Literal["first", "second"] = "first",
        eccentricity: Vector2 = (0.0, 0.0),
    ) -> ClearancePin:
        """A clearance pin in few words, as scenario files have it; the rest has usual values.

            ClearancePin.simple(clearance=0.5e-3, bore_radius=0.06, restitution=0.9, friction=0.1)

        Arguments:
            clearance: radial, bore radius minus journal radius [m], > 0.
            bore_radius: [m], > clearance; `load_machine(NAME).bore_radii` has those of a machine.
            restitution: of an impact, > 0 and <= 1; 0.9 if nothing is said.
            friction: sliding coefficient of Ambrosio's law, >= 0, 0: none; or a friction law.
            law: class of the normal force, one that needs nothing but a stiffness and a restitution.
            damping_speed: what the damping of the law is scaled with; the law's own default if None.
            stiffness: K of K depth^1.5: "external" or "internal", Hertz's for spheres that touch from outside
                or inside, from radii and materials; or a number [N/m^1.5], > 0.
            bore_material, journal_material: for the stiffness.
            bore: which of the two bodies of the pin's place carries the bore.
            eccentricity: of the journal's centre from the bore's at the start [m], forward and up.

        Raises InputError that names what does not fit, its value and what is allowed.
        """
        bearing = JournalBearing(bore_radius=bore_radius, clearance=clearance)
        has, given = _fields_of(law), dict[str, Any]()
        if "stiffness" in has:
            given["stiffness"] = stiffness
        elif stiffness != "external":
            raise InputError(
                f"stiffness = {short(stiffness)}: {law.__name__} has none; allowed: to leave it out"
            )
        named = "stiffness" in has and isinstance(stiffness, str)
        if named:
            if stiffness not in HERTZ:
                allowed = " or ".join(map(repr, HERTZ))
                raise InputError(f"stiffness = {short(stiffness)}: allowed: {allowed}, or a number, > 0")
            given["stiffness"] = HERTZ[stiffness](bearing, bore_material, journal_material)
        for name, asked in (("restitution", restitution), ("damping_speed", damping_speed)):
            if asked is not None and name not in has:
                raise InputError(
                    f"{name} = {short(asked)}: {law.__name__} has none; allowed: None with this law"
                )
            if asked is not None:
                given[name] = asked
        if "restitution" in has:
            given.setdefault("restitution", USUAL_RESTITUTION)
        if not isinstance(friction, FrictionLaw):
            friction = Ambrosio(sliding_coefficient=friction) if friction != 0.0 else Frictionless()
        normal = law(**given)
        if named and getattr(normal, "exponent", HERTZ_EXPONENT) != HERTZ_EXPONENT:
            raise InputError(
                f"stiffness = {stiffness!r}: is of K depth^{HERTZ_EXPONENT}, and {law.__name__} is not; "
                "allowed with this law: a number"
            )
        contact = JournalContact(bearing=bearing, normal=normal, friction=friction)
        return cls(contact=contact, bore=bore, eccentricity=eccentricity)

    @property
    def offset(self) -> Vector2:
        """The second body's point minus that of the first at the start [m]."""
        x, y = self.eccentricity
        return (x, y) if self.bore == "first" else (-x, -y)

    @property
    def holds(self) -> bool:
        """A clearance pin leaves its journal free."""
        return False

    def refused_by(self, formulation: Literal["tree", "reduced", "space"]) -> Refusal | None:
        """Friction laws with a state are covered by the redundant formulation only."""
        friction = self.contact.friction
        if formulation == "space" or not friction.has_state:
            return None
        return Refusal(".contact.friction", type(friction).__name__, "laws without a state")

    def losses(self) -> dict[str, object]:
        """A clearance pin loses energy by the damping and the friction of its contact."""
        return {"damping_loss": self.contact.normal, "friction_loss": self.contact.friction}


def _fields_of(law: Any) -> set[str]:
    """Names of the fields of a class of laws. Raises InputError if it is none that can be made."""
    is_law = isinstance(law, type) and issubclass(law, NormalLaw)
    fields = getattr(law, "__dataclass_fields__", None) if is_law else None
    if fields is not None:
        return set(fields)
    raise InputError(
        f"law = {short(law)}: allowed: a class of normal laws that needs a stiffness and a restitution only, "
        "such as Flores; with any other law make ClearancePin(contact=JournalContact(...))"
    )
