"""Journal, normal law and friction law together: the force of a bore on its journal."""

from __future__ import annotations

import math
from typing import NamedTuple

from user_forces.friction.frictionless import Frictionless
from user_forces.friction.law import FrictionLaw
from user_forces.journal import JournalBearing
from user_forces.normal.law import NormalLaw
from user_forces.values import Value, value


class ContactForce(NamedTuple):
    """State of a journal in its bore and the force of the bore on the journal.

    x and y are the axes in which the displacement was given.
    """

    depth: float  # [m], negative: gap
    rate: float  # of depth [m/s]
    slip: float  # of the journal's surface on the bore's, along t [m/s]
    normal_force: float  # [N] >= 0, along -n
    friction_force: float  # [N], along t
    force_x: float  # [N]
    force_y: float  # [N]
    journal_arm: float  # of the contact point from the journal's centre, along n [m]
    clamped: bool  # the law asked for tension, which was cut to zero

    @property
    def journal_moment(self) -> float:
        """Moment [N m] of the force about the journal's centre."""
        return self.journal_arm * self.friction_force


@value
class JournalContact(Value):
    """Contact of a journal in a bore: geometry, normal law and friction law.

    Arguments:
        bearing: radii and clearance.
        normal: law for the normal force.
        friction: law for the tangential force; none by default.
    """

    bearing: JournalBearing
    normal: NormalLaw
    friction: FrictionLaw = Frictionless()

    def gap_state(self, x: float, y: float, vx: float, vy: float) -> tuple[float, float]:
        """Depth [m] and its rate [m/s]; see `force` for the arguments.

        From the middle every way leads outwards: there the rate is the speed.
        """
        eccentricity = math.hypot(x, y)
        rate = (x * vx + y * vy) / eccentricity if eccentricity > 0.0 else math.hypot(vx, vy)
        return self.bearing.depth(eccentricity), rate

    def force(
        self,
        x: float,
        y: float,
        vx: float,
        vy: float,
        bore_spin: float,
        journal_spin: float,
        approach_speed: float | None,
    ) -> ContactForce:
        """Force of the bore on the journal.

        Arguments:
            x, y: journal's centre minus bore's centre [m], in any axes.
            vx, vy: velocity of the journal's centre minus that of the bore's centre [m/s], same axes;
                the plain difference, not the rate seen by an observer who turns with the bore.
            bore_spin, journal_spin: angular velocities of both bodies [rad/s].
            approach_speed: rate at the onset of the contact going on [m/s]; None while the surfaces
                are apart, and then there is no force whatever the depth.

        Returns:
            ContactForce. The force acts at one point of space on both bodies, so linear and angular
            momentum are conserved: on the journal `journal_arm` from its centre along n, which is
            `journal_arm` plus the eccentricity from the bore's.
        """
        eccentricity = math.hypot(x, y)
        bearing = self.bearing
        depth = eccentricity - bearing.clearance  # Eq. 3
        if eccentricity == 0.0:  # no direction of contact
            return ContactForce(depth, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, bearing.journal_radius, False)
        nx, ny = x / eccentricity, y / eccentricity
        rate = nx * vx + ny * vy
        bore_arm, journal_arm = bearing.contact_arms(depth)
        slip = nx * vy - ny * vx + journal_spin * journal_arm - bore_spin * bore_arm
        if depth <= 0.0 or approach_speed is None:
            return ContactForce(depth, rate, slip, 0.0, 0.0, 0.0, 0.0, journal_arm, False)
        normal = self.normal(depth, rate, approach_speed)
        clamped = normal < 0.0
        if clamped:
            normal = 0.0
        friction = self.friction(slip, normal)
        return ContactForce(
            depth,
            rate,
            slip,
            normal,
            friction,
            -normal * nx - friction * ny,
            -normal * ny + friction * nx,
            journal_arm,
            clamped,
        )
