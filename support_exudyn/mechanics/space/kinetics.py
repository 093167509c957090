"""Masses and constraints of a spatial linkage as matrices, for what happens at an instant.

As in the plane (`mechanics.kinetics`), with velocities v and omega of every body in the ground's axes:

    M dv + C^T L = b,    C dv = c
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from support_exudyn.mechanics.space.constraints import BearingEnd, Constraint, frame_of, matrix
from support_exudyn.mechanics.space.motion import SpatialMotion, cross
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.spatial_linkage import SpatialBody, SpatialLinkage
from user_forces.values.value import Vector3


def tensor(body: SpatialBody) -> Series:
    """Inertia about the centre of mass at the start, (3, 3) [kg m^2]."""
    xx, yy, zz, yz, xz, xy = body.inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def inertias(motion: SpatialMotion) -> Series:
    """Inertia of all bodies in the ground's axes, (n, b, 3, 3)."""
    own = np.array([tensor(body) for body in motion.linkage.bodies.values()])
    return np.asarray(motion.turn @ own @ np.swapaxes(motion.turn, -1, -2))


def weight(linkage: SpatialLinkage, gravity: Vector3) -> Series:
    """Forces of gravity [m/s^2] on all coordinates [N], shape (6 bodies,)."""
    forces = np.zeros((len(linkage.bodies), 6))
    forces[:, :3] = np.outer([body.mass for body in linkage.bodies.values()], gravity)
    return forces.ravel()


@dataclass(frozen=True)
class SpatialKinetics:
    """Matrices at one instant; rows: the constraints that hold.

    motion: of one instant.
    """

    motion: SpatialMotion
    rows: Sequence[Constraint]

    def mass(self) -> Series:
        """Mass matrix (6 bodies, 6 bodies)."""
        bodies = self.motion.linkage.bodies.values()
        found = np.zeros((6 * len(bodies), 6 * len(bodies)))
        for n, (body, inertia) in enumerate(zip(bodies, inertias(self.motion)[0], strict=True)):
            found[6 * n : 6 * n + 3, 6 * n : 6 * n + 3] = body.mass * np.eye(3)
            found[6 * n + 3 : 6 * n + 6, 6 * n + 3 : 6 * n + 6] = inertia
        return found

    def respond(self, impulse: Series, jump: Series | float) -> tuple[Series, Series]:
        """Change of velocities dv and impulses L of the rows, under impulses b (6 bodies[, k]) and a jump c."""
        rows = matrix(self.motion, self.rows)[0]
        mass = self.mass()
        size, count = len(mass), len(rows)
        system = np.block([[mass, rows.T], [rows, np.zeros((count, count))]])
        right = np.concatenate([impulse, np.broadcast_to(jump, (count, *impulse.shape[1:]))])
        try:
            solution = np.linalg.solve(system, right)
        except np.linalg.LinAlgError:  # at a dead centre
            solution = np.linalg.lstsq(system, right, rcond=None)[0]
        return solution[:size], solution[size:]

    def answers(self, rate: Series) -> Series:
        """Velocities of which these are the rows (k, 6 bodies), by impulses along them (k, k) [1/kg]."""
        found: Series = (rate @ self.respond(rate.T, 0.0)[0]).T
        return found

    def bearing_rate(self, bore: BearingEnd, journal: BearingEnd) -> Series:
        """Rows that give the velocity of the journal's middle across the bore, in its axes (2, 6 bodies)."""
        return np.array([self._rate(bore, journal, k) for k in (0, 1)])

    def _rate(self, bore: BearingEnd, journal: BearingEnd, axis: int) -> Series:
        """The row that gives the velocity of the journal's middle against the bore's along one of its axes."""
        direction = self.motion.carried(bore.body, frame_of(bore.axis)[:, axis])[0]
        found = np.zeros(6 * len(self.motion.linkage.bodies))
        for end, sign in ((journal, 1.0), (bore, -1.0)):
            if end.body != GROUND:
                i = 6 * self.motion.index(end.body)
                arm = self.motion.point(end.body, end.point).arm[0]
                found[i : i + 3] += sign * direction
                found[i + 3 : i + 6] += sign * cross(arm, direction)
        return found
