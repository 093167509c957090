r"""Geometry of a journal in a bore, in the plane.

      bore, radius R2, centre O2
    .-----------.
  .'             '.
 /     O2 +--e     \         e      from the bore's centre to the journal's centre
|          \ .--.   |        c      clearance R2 - R1
|           ( O1 )  |        depth  |e| - c, positive in contact
 \           '--'  /         n      e / |e|, towards the bore's wall
  '.              .'         t      n turned by +90 degrees
    '-----------'
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

from pydantic import model_validator

from user_forces.expressions.scalar import hypot, maximum
from user_forces.values.units import Metres
from user_forces.values.value import Positive, Value, value

SMALLEST = 1e-300  # [m], only so that nothing is divided by zero


class ContactGeometry(Value, ABC):
    """What a journal is enclosed by, and where both make contact.

    clearance: eccentricity at which it makes contact [m]. is_slot: only what is across counts, the journal
    slides freely along. is_one_sided: only one side of it can be met.
    """

    clearance: float
    is_slot: ClassVar[bool] = False
    is_one_sided: ClassVar[bool] = False

    def outwards(self, x: float, y: float) -> tuple[float, float, float]:
        """The eccentricity [m] of a journal at x, y [m], and the direction towards what it may meet there."""
        eccentricity = hypot(x, y)
        away = maximum(eccentricity, SMALLEST)
        return eccentricity, x / away, y / away

    def depth(self, eccentricity: float) -> float:
        """Depth |e| - c [m] for an eccentricity |e| [m] (Eq. 3 of the paper); negative: a gap."""
        return eccentricity - self.clearance

    @property
    @abstractmethod
    def size(self) -> float:
        """Length [m] beside which a depth has to be small."""

    @property
    @abstractmethod
    def words(self) -> str:
        """What encloses the journal, with its size."""

    @abstractmethod
    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the centres of bore and journal, both along n."""

    @abstractmethod
    def speed_outwards(self, vx: float, vy: float) -> float:
        """Speed [m/s] at which a journal that is in the middle leaves it, at a velocity vx, vy [m/s]."""


@value
class JournalBearing(ContactGeometry):
    """Bore and journal of a pin.

    Arguments:
        bore_radius: R2 [m], > 0.
        clearance: radial clearance c [m], > 0 and < bore_radius.
    """

    bore_radius: Metres[Positive]
    clearance: Metres[Positive]

    @model_validator(mode="after")
    def _journal_has_a_radius(self) -> JournalBearing:
        if self.clearance >= self.bore_radius:
            raise ValueError(
                f"clearance = {self.clearance} m: leaves no journal in a bore of radius {self.bore_radius} m; "
                f"allowed: > 0 and < {self.bore_radius} m (is it given in mm?)"
            )
        return self

    @property
    def journal_radius(self) -> float:
        """R1 = R2 - c [m] (Eq. 1 of the paper)."""
        return self.bore_radius - self.clearance

    @property
    def size(self) -> float:
        """The bore's radius [m]."""
        return self.bore_radius

    @property
    def words(self) -> str:
        """The bore, with its radius."""
        return f"a bore of {1e3 * self.bore_radius:.4g} mm radius"

    def speed_outwards(self, vx: float, vy: float) -> float:
        """The speed [m/s]: from the middle of a bore every way leads outwards."""
        return hypot(vx, vy)

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the centres of bore and journal, both along n.

        The contact point lies midway in the overlap, so that one point serves both bodies:
        R2 + depth/2 and R1 - depth/2, whose difference is the eccentricity.
        """
        bore_arm = self.bore_radius + 0.5 * depth
        return bore_arm, bore_arm - depth - self.clearance
