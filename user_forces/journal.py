r"""Geometry of what encloses a journal, in the plane: a bore, two walls, or a face.

      bore, radius R2, centre O2
    .-----------.
  .'             '.
 /     O2 +--e     \         e      from the bore's centre to the journal's centre
|          \ .--.   |        c      clearance R2 - R1
|           ( O1 )  |        depth  |e| - c, positive in contact
 \           '--'  /         n      e / |e|, towards the bore's wall
  '.              .'         t      n turned by +90 degrees
    '-----------'

    ////////////////////////  upper wall
           . o                o  corner of a block, or centre of a pin of radius r
             : e              e  its distance from the middle line, upwards positive
    - - - - -:- - - - - - - -
                              c  distance at which it makes contact: half the height of the slot, less r
    ////////////////////////  lower wall

A corner slides freely along its walls, so that only what is across counts as its eccentricity. A point that
meets a face has one wall, the upper; the line from which its distance counts lies in front of the face.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Annotated, ClassVar

from pydantic import Field, model_validator

from user_forces.kernel import kernel
from user_forces.values.units import Metres
from user_forces.values.value import Positive, Real, Value, value

Kinematics = Callable[..., tuple[float, float, float, float, float, float]]


@kernel
def journal_in_bore(
    x: float, y: float, vx: float, vy: float,
    bore_spin: float, journal_spin: float, radius: float, clearance: float,
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
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


@kernel
def corner_in_slot(
    x: float, y: float, vx: float, vy: float,
    bore_spin: float, journal_spin: float, radius: float, clearance: float,
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
    """Kinematics of a corner, or of a round pin, between the walls of a slot; returns as `journal_in_bore`.

    Arguments:
        x: has no effect. y: distance from the middle line [m], upwards positive.
        vx, vy: rates along and across [m/s], vy less what the turning of the slot moves the walls there.
        bore_spin, journal_spin: angular velocities of slot and corner [rad/s].
        radius: of the pin [m], 0 of a corner. clearance: distance from the middle line at contact [m].

    The contact point lies on the surface of corner or pin.
    """
    side = 1.0 if y >= 0.0 else -1.0
    depth = side * y - clearance
    bore_arm = clearance + depth + radius
    return depth, side * vy, -side * vx + journal_spin * radius - bore_spin * bore_arm, 0.0, side, radius


@kernel
def point_on_face(
    x: float, y: float, vx: float, vy: float,
    bore_spin: float, journal_spin: float, radius: float, clearance: float,
) -> tuple[float, float, float, float, float, float]:  # fmt: skip
    """Kinematics of a point that meets a face from one side: `corner_in_slot` with the upper wall alone.

    clearance: distance of the face from the line [m]. radius: has no effect. The contact point is the point.
    """
    return y - clearance, vy, -vx - bore_spin * y, 0.0, 1.0, 0.0


class ContactGeometry(Value, ABC):
    """What a journal is enclosed by, and where both make contact; here with straight walls.

    clearance: eccentricity at which it makes contact [m]. kinematics: kernel of the contact's kinematics, which
    takes `constants` last. is_slot: only what is across counts, the journal slides freely along. is_one_sided:
    only one side of it can be met.
    """

    clearance: float
    kinematics: ClassVar[Kinematics]
    is_slot: ClassVar[bool] = True
    is_one_sided: ClassVar[bool] = False

    @property
    def radius(self) -> float:
        """Radius of the pin between walls [m]; 0: a corner or a point."""
        return 0.0

    @property
    def constants(self) -> tuple[float, float]:
        """Radius [m] and clearance [m], as `kinematics` takes them."""
        return self.radius, self.clearance

    def depth(self, eccentricity: float) -> float:
        """Depth |e| - c [m] for an eccentricity |e| [m] (Eq. 3 of the paper); negative: a gap."""
        return eccentricity - self.clearance

    @property
    def size(self) -> float:
        """Length [m] against which a depth has to be small: half the height of a slot."""
        return self.clearance + self.radius

    @property
    @abstractmethod
    def words(self) -> str:
        """What encloses the journal, with its size."""

    def placed(self, depth: float, rate: float, slip: float) -> tuple[float, ...]:
        """A motion, as `kinematics` takes it first, with this depth [m], rate [m/s] and slip [m/s]."""
        return 0.0, self.clearance + depth, -slip, rate, 0.0, 0.0

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the centres of bore and journal, both along n.

        Between walls, from the middle line and from the pin's centre: there both bodies feel the force.
        """
        return self.clearance + depth + self.radius, self.radius


@value
class JournalBearing(ContactGeometry):
    """Bore and journal of a pin.

    Arguments:
        bore_radius: R2 [m], > 0.
        clearance: radial clearance c [m], > 0 and < bore_radius.
    """

    bore_radius: Metres[Positive]
    clearance: Metres[Positive]
    kinematics: ClassVar[Kinematics] = staticmethod(journal_in_bore)
    is_slot: ClassVar[bool] = False

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
    def constants(self) -> tuple[float, float]:
        """Radius of the bore [m] and clearance [m]."""
        return self.bore_radius, self.clearance

    @property
    def size(self) -> float:
        """The bore's radius [m]."""
        return self.bore_radius

    @property
    def words(self) -> str:
        """The bore, with its radius."""
        return f"a bore of {1e3 * self.bore_radius:.4g} mm radius"

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


@value
class Slot(ContactGeometry):
    """Two walls, and the corner or the pin between them; x lies along the walls and y across.

    Arguments:
        clearance: distance from the middle line at which it makes contact [m], > 0.
        radius: of the pin [m], >= 0; 0: a corner.
    """

    clearance: Metres[Positive]
    radius: Metres[Annotated[Real, Field(ge=0)]] = 0.0
    kinematics: ClassVar[Kinematics] = staticmethod(corner_in_slot)

    @property
    def words(self) -> str:
        """The slot, with half its height."""
        return f"a wall of a slot of {1e3 * self.size:.4g} mm half height"


@value
class Face(ContactGeometry):
    """A straight face, and the point that meets it from one side; x lies along the face and y across.

    y counts from a line in front of the face: from the face itself it would have no direction where the contact
    begins. A point in front of the face is free however far away it is.

    Arguments:
        clearance: distance of that line from the face, as large as what is behind the face [m], > 0.
    """

    clearance: Metres[Positive]
    kinematics: ClassVar[Kinematics] = staticmethod(point_on_face)
    is_one_sided: ClassVar[bool] = True

    @property
    def words(self) -> str:
        """What is behind the face, with its size."""
        return f"the face of a block of {1e3 * self.size:.4g} mm"


@kernel
def larger_load(across: float, moment: float, half_length: float) -> float:
    """The larger of a guide's force across a block and of the pair that its moment is at the ends [N]."""
    return max(abs(across), abs(moment) / half_length)


@kernel
def end_loads(
    across: float, moment: float, ratio: float, half_length: float, half_height: float
) -> tuple[float, float]:
    """What presses the ends of a block on the walls [N], see `IdealGuide`; ratio: of friction to load."""
    apart = (moment - ratio * across * half_height) / half_length
    return 0.5 * abs(across + apart), 0.5 * abs(across - apart)
