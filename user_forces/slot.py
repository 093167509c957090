r"""Geometry of a corner or a round pin between two straight, parallel walls, in the plane.

    ////////////////////////  upper wall
           . o                o  corner of a block, or centre of a pin of radius r
             : e              e  its distance from the middle line, upwards positive
    - - - - -:- - - - - - - -
                              c  distance at which it makes contact: half the height of the slot, less r
    ////////////////////////  lower wall

A corner is a journal that slides freely along, so that only what is across counts as its eccentricity.
"""

from __future__ import annotations

from typing import Annotated, ClassVar

from pydantic import Field

from user_forces.journal import ContactGeometry, Kinematics
from user_forces.kernel import kernel
from user_forces.values.units import Metres
from user_forces.values.value import Positive, Real, value


@kernel
def corner_in_slot(
    x: float,
    y: float,
    vx: float,
    vy: float,
    bore_spin: float,
    journal_spin: float,
    radius: float,
    clearance: float,
) -> tuple[float, float, float, float, float, float]:
    """Kinematics of a corner, or of a round pin, between the walls of a slot.

    Arguments:
        x: has no effect. y: distance from the middle line [m], upwards positive.
        vx, vy: rates along and across [m/s], vy less what the turning of the slot moves the walls there.
        bore_spin, journal_spin: angular velocities of slot and corner [rad/s].
        radius: of the pin [m], 0 of a corner. clearance: distance from the middle line at contact [m].

    Returns:
        As `journal_in_bore`; the contact point lies on the surface of corner or pin.
    """
    side = 1.0 if y >= 0.0 else -1.0
    depth = side * y - clearance
    bore_arm = clearance + depth + radius
    return depth, side * vy, -side * vx + journal_spin * radius - bore_spin * bore_arm, 0.0, side, radius


@value
class Slot(ContactGeometry):
    """Two walls, and the corner or the pin between them.

    x lies along the walls and y across, from the middle line.

    Arguments:
        clearance: distance from the middle line at which it makes contact [m], > 0.
        radius: of the pin [m], >= 0; 0: a corner.
    """

    clearance: Metres[Positive]
    radius: Metres[Annotated[Real, Field(ge=0)]] = 0.0
    is_slot: ClassVar[bool] = True

    @property
    def size(self) -> float:
        """Half the height of the slot [m]."""
        return self.clearance + self.radius

    @property
    def words(self) -> str:
        """The slot, with half its height."""
        return f"a wall of a slot of {1e3 * self.size:.4g} mm half height"

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the middle line and from corner or pin's centre, across.

        It lies on the surface of the corner or the pin: there both bodies feel the force.
        """
        return self.clearance + depth + self.radius, self.radius

    @property
    def constants(self) -> tuple[float, float]:
        """Radius of the pin [m] and clearance [m]."""
        return self.radius, self.clearance

    def placed(self, depth: float, rate: float, slip: float) -> tuple[float, ...]:
        """A motion, as `kinematics` takes it first, with this depth [m], rate [m/s] and slip [m/s]."""
        return 0.0, self.clearance + depth, -slip, rate, 0.0, 0.0

    @property
    def kinematics(self) -> Kinematics:
        """See `corner_in_slot`."""
        return corner_in_slot


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
