"""What a pin can be: ideal, or with clearance. One field of the scenario switches it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Literal

from pydantic import model_validator

from user_forces.contact import JournalContact
from user_forces.friction.law import FrictionLaw
from user_forces.values.units import Metres
from user_forces.values.value import Positive, Value, Vector2, value


class Pin(Value, ABC):
    """An ideal pin or a clearance pin."""

    @property
    @abstractmethod
    def is_ideal(self) -> bool:
        """Whether the two bodies share a point."""


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
    def is_ideal(self) -> bool:
        """Yes."""
        return True


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
    def is_ideal(self) -> bool:
        """No."""
        return False
