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

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar

from pydantic import model_validator

from user_forces.kernel import kernel
from user_forces.values.units import Metres
from user_forces.values.value import Positive, Value, value

Kinematics = Callable[..., tuple[float, float, float, float, float, float]]


@kernel
def journal_in_bore(
    x: float,
    y: float,
    vx: float,
    vy: float,
    bore_spin: float,
    journal_spin: float,
    radius: float,
    clearance: float,
) -> tuple[float, float, float, float, float, float]:
    """Kinematics of a journal in its bore.

    Arguments:
        x, y, vx, vy: journal's centre minus bore's [m] and its rate [m/s], in any axes.
        bore_spin, journal_spin: angular velocities of both bodies [rad/s].
        radius: R2 of the bore [m]. clearance: c [m].

    Returns:
        Depth |e| - c [m] (Eq. 3 of the paper), its rate [m/s], slip of the journal's surface on the bore's
        [m/s] along t, the direction n (2) towards the wall, and the arm of the contact point from the journal's
        centre [m]. The contact point lies midway in the overlap, so that it serves both bodies. From the middle
        every direction leads outwards: there the rate is the speed.
    """
    eccentricity = math.sqrt(x * x + y * y)
    depth = eccentricity - clearance
    bore_arm = radius + 0.5 * depth
    arm = bore_arm - depth - clearance
    if eccentricity == 0.0:
        slip = journal_spin * arm - bore_spin * bore_arm
        return depth, math.sqrt(vx * vx + vy * vy), slip, 0.0, 0.0, arm
    nx, ny = x / eccentricity, y / eccentricity
    slip = nx * vy - ny * vx + journal_spin * arm - bore_spin * bore_arm
    return depth, nx * vx + ny * vy, slip, nx, ny, arm


class ContactGeometry(Value, ABC):
    """What a journal is enclosed by, and where both make contact.

    clearance: eccentricity at which it makes contact [m]. is_slot: only what is across counts, the journal
    slides freely along. is_one_sided: only one side of it can be met.
    """

    clearance: float
    is_slot: ClassVar[bool] = False
    is_one_sided: ClassVar[bool] = False

    @property
    @abstractmethod
    def kinematics(self) -> Kinematics:
        """The kernel of the contact's kinematics; `constants` are what it takes last."""

    @property
    def constants(self) -> tuple[float, float]:
        """Size of the bore or pin [m] and clearance [m], as `kinematics` takes them."""
        return self.size, self.clearance

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
    def placed(self, depth: float, rate: float, slip: float) -> tuple[float, ...]:
        """A motion, as `kinematics` takes it first, with this depth [m], rate [m/s] and slip [m/s]."""

    @abstractmethod
    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the centres of bore and journal, both along n."""


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

    @property
    def kinematics(self) -> Kinematics:
        """See `journal_in_bore`."""
        return journal_in_bore

    def placed(self, depth: float, rate: float, slip: float) -> tuple[float, ...]:
        """A motion, as `kinematics` takes it first, with this depth [m], rate [m/s] and slip [m/s]."""
        return self.clearance + depth, 0.0, rate, slip, 0.0, 0.0

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the centres of bore and journal, both along n.

        The contact point lies midway in the overlap, so that one point serves both bodies:
        R2 + depth/2 and R1 - depth/2, whose difference is the eccentricity.
        """
        bore_arm = self.bore_radius + 0.5 * depth
        return bore_arm, bore_arm - depth - self.clearance
