r"""Geometry of a point that meets a straight face from one side, in the plane.

    ////////////////////////  what is behind the face
    ------------------------  face
             .                point
             : y              y  distance of the point from a line in front of the face, upwards positive
    - - - - -:- - - - - - -
                              c  distance of that line from the face

A point in front of the face is free however far away it is; behind the face it is pressed.
"""

from __future__ import annotations

from typing import ClassVar

from user_forces.journal import ContactGeometry, Kinematics
from user_forces.kernel import kernel
from user_forces.values.units import Metres
from user_forces.values.value import Positive, value


@kernel
def point_on_face(
    x: float,
    y: float,
    vx: float,
    vy: float,
    bore_spin: float,
    journal_spin: float,
    radius: float,
    clearance: float,
) -> tuple[float, float, float, float, float, float]:
    """Kinematics of a point that meets a face from one side.

    Arguments:
        x: has no effect. y: distance from the line in front of the face [m]; vx, vy: rates [m/s].
        bore_spin, journal_spin: angular velocities of face and point [rad/s]. radius: has no effect.
        clearance: distance of the face from the line [m].

    Returns:
        As `journal_in_bore`; the direction is always that across the face, and the contact point the point.
    """
    return y - clearance, vy, -vx - bore_spin * y, 0.0, 1.0, 0.0


@value
class Face(ContactGeometry):
    """A straight face, and the point that meets it from one side.

    x lies along the face and y across, from a line in front of the face towards it. Were y measured from the
    face itself, it would have no direction where the contact begins.

    Arguments:
        clearance: distance of that line from the face, as large as what is behind the face [m], > 0; a depth
            has to be small beside it.
    """

    clearance: Metres[Positive]
    is_slot: ClassVar[bool] = True
    is_one_sided: ClassVar[bool] = True

    @property
    def size(self) -> float:
        """The size of what is behind the face [m]."""
        return self.clearance

    @property
    def words(self) -> str:
        """What is behind the face, with its size."""
        return f"the face of a block of {1e3 * self.size:.4g} mm"

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the line and from the point, across: it is the point."""
        return self.clearance + depth, 0.0

    def placed(self, depth: float, rate: float, slip: float) -> tuple[float, ...]:
        """A motion, as `kinematics` takes it first, with this depth [m], rate [m/s] and slip [m/s]."""
        return 0.0, self.clearance + depth, -slip, rate, 0.0, 0.0

    @property
    def kinematics(self) -> Kinematics:
        """See `point_on_face`."""
        return point_on_face
