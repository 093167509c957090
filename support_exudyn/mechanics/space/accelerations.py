"""Accelerations of all bodies at all records, from where they are and how they move, as in the plane.

See `mechanics.reactions`: the engine's own are differences of positions over the step's square, and after
a kink of a drive they swing about the right ones.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from support_exudyn.mechanics.reactions import SHIFT, Equations
from support_exudyn.mechanics.space.constraints import Constraint, matrix
from support_exudyn.mechanics.space.kinetics import inertias
from support_exudyn.mechanics.space.motion import SpatialMotion, rotation
from support_exudyn.mechanics.trajectory import Series


def accelerations(motion: SpatialMotion, rows: Sequence[Constraint], driven: Series, forces: Series) -> Series:
    """Accelerations of the centres [m/s^2], and rates of the spins [rad/s^2], (n, b, 6).

    Arguments:
        motion: of all bodies.
        rows: constraints that hold, none of which repeats others.
        driven: second derivatives of what they hold, (n, rows).
        forces: applied ones, and those of turning, (n, b, 6) [N], [N m].
    """
    count = motion.count
    equations = Equations(matrix(motion, rows), driven - turning(motion, rows), _lightness(motion))
    return equations.solve(forces.reshape(count, -1))[0].reshape(forces.shape)


def turning(motion: SpatialMotion, rows: Sequence[Constraint]) -> Series:
    """C' v at every instant, (n, rows): by how much the rows change as the bodies move on."""
    velocity = np.concatenate([motion.velocity, motion.spin], axis=-1).reshape(motion.count, -1)
    fastest = np.abs(velocity).max(axis=1, initial=0.0)
    time = SHIFT / np.where(fastest > 0.0, fastest, 1.0)
    changed = matrix(_moved(motion, time), rows) - matrix(_moved(motion, -time), rows)
    found: Series = np.einsum("nrk,nk->nr", changed, velocity) / (2.0 * time)[:, None]
    return found


def _moved(motion: SpatialMotion, time: Series) -> SpatialMotion:
    """All bodies a moment (n,) [s] later, at the velocities that they have."""
    half = 0.5 * time[:, None, None] * motion.spin
    turned = np.concatenate([np.ones((*half.shape[:-1], 1)), half], axis=-1)
    turned /= np.linalg.norm(turned, axis=-1, keepdims=True)
    return replace(
        motion,
        displacement=motion.displacement + time[:, None, None] * motion.velocity,
        turn=rotation(turned) @ motion.turn,
    )


def _lightness(motion: SpatialMotion) -> Callable[[Series], Series]:
    """What gives accelerations for forces on all coordinates, (n, ..., 6 b)."""
    mass = np.array([body.mass for body in motion.linkage.bodies.values()])
    inverse = np.linalg.inv(inertias(motion))

    def lightness(forces: Series) -> Series:
        split = forces.reshape(motion.count, -1, len(mass), 6)
        turned = np.einsum("nbij,nkbj->nkbi", inverse, split[..., 3:])
        found = np.concatenate([split[..., :3] / mass[:, None], turned], axis=-1)
        return np.asarray(found.reshape(forces.shape))

    return lightness
