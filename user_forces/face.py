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

from user_forces.journal import ContactGeometry
from user_forces.values.units import Metres
from user_forces.values.value import Positive, value


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

    def outwards(self, x: float, y: float) -> tuple[float, float, float]:
        """The distance y [m] from the line, with its sign; the direction is always that across the face."""
        del x
        return y, 0.0, 1.0

    def contact_arms(self, depth: float) -> tuple[float, float]:
        """Distances [m] of the contact point from the line and from the point, across: it is the point."""
        return self.clearance + depth, 0.0

    def speed_outwards(self, vx: float, vy: float) -> float:
        """The speed across [m/s]."""
        del vx
        return vy
