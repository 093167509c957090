"""Forces in ideal bearings and rigid actuators at all records, from the motion.

Newton's and Euler's equations say what the constraints together do to every body:

    C^T lambda = M a + omega x J omega - all other forces

Where constraints repeat each other many lambda do that, and rigid bodies cannot tell them apart. Taken are
those with the least sum of squares (moments count as forces at 1 m), which load alike what is alike: two
parallel links half each. Which loads that leaves open is told by `determined`.
"""

from collections.abc import Sequence

import numpy as np

from support_exudyn.mechanics.space.constraints import Constraint, matrix
from support_exudyn.mechanics.space.kinetics import inertias
from support_exudyn.mechanics.space.motion import SpatialMotion, cross
from support_exudyn.mechanics.trajectory import Series

# The rows repeat each other, so C C^T has no inverse. A small share of its size is added to its diagonal, and
# what that changes is taken back in a few rounds, each of which leaves about this share of it.
LIFT = 1e-9
ROUNDS = 2


def inertia_forces(motion: SpatialMotion, acceleration: Series) -> Series:
    """M a + omega x J omega of all bodies with accelerations a (n, b, 6); the same shape, [N], [N m]."""
    mass = np.array([body.mass for body in motion.linkage.bodies.values()])
    inertia = inertias(motion)
    momentum = np.einsum("nbij,nbj->nbi", inertia, motion.spin)
    moment = np.einsum("nbij,nbj->nbi", inertia, acceleration[..., 3:]) + cross(motion.spin, momentum)
    return np.concatenate([mass[:, None] * acceleration[..., :3], moment], axis=-1)


def reactions(motion: SpatialMotion, rows: Sequence[Constraint], left: Series) -> Series:
    """Forces of the rows on the second body (or pushing an actuator's ends apart), (n, rows).

    Arguments:
        motion: of all bodies.
        rows: all that is held.
        left: what they have to do to the bodies, (n, b, 6).
    """
    c = matrix(motion, rows)
    wanted = np.einsum("nrk,nk->nr", c, left.reshape(motion.count, -1))
    square = c @ np.swapaxes(c, 1, 2)
    size = np.einsum("nrr->n", square) / len(rows)
    lifted = square + LIFT * size[:, None, None] * np.eye(len(rows))
    found: Series = np.zeros_like(wanted)
    for _ in range(ROUNDS):
        rest = wanted - np.einsum("nrk,nk->nr", square, found)
        found += np.linalg.solve(lifted, rest[..., None])[..., 0]
    return found
