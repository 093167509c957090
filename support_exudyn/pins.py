"""What a pin can be: ideal, or with clearance. One field of the scenario switches it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Literal

from user_forces.contact import JournalContact
from user_forces.values import Value, value


class Pin(Value, ABC):
    """An ideal pin or a clearance pin."""

    @property
    @abstractmethod
    def is_ideal(self) -> bool:
        """Whether the two bodies share a point."""


@value
class IdealPin(Pin):
    """The two bodies share a point: two position constraints, whose multipliers are the pin force."""

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
    """

    contact: JournalContact
    bore: Literal["first", "second"] = "first"

    @property
    def is_ideal(self) -> bool:
        """No."""
        return False
