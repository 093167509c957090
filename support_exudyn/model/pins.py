"""The kinds of pins: ideal, with clearance, and whatever derives from `Pin`. A field of the scenario chooses.

A kind is one class, which answers what every stage asks of a pin; its channels, see `mechanics.pin_channels`;
and what stands for it in the engine, see `formulations.redundant.scene.scene_builder`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Literal, NamedTuple

from pydantic import model_validator

from user_forces.contact import JournalContact
from user_forces.friction.law import FrictionLaw
from user_forces.values.units import Metres
from user_forces.values.value import Positive, Value, Vector2, value


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
