"""How a clearance pin's journal answers an impulse while other clearance pins are pressed.

A pressed contact transmits along its normal and nowhere else: without friction a bore does not hold its journal
along its surface, and friction only bounds a force. So with n_j the normals of the other pressed pins, J_j the
rows that give the rates of their eccentricities, and J that of the pin that is asked for,

    M dv + C^T L + sum of J_j^T n_j p_j = J^T,   C dv = 0,   n_j J_j dv = 0

A contact counts as pressed where its surfaces overlap. It is taken as rigid, which is the most that it can be:
a free impact then stores at most half of this mass times its initial impact velocity squared, and laws that go
by the mass (`IndentationVelocity`) deliver their restitution. Pins that are apart transmit nothing.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.contact_state import InverseMass
from support_exudyn.mechanics.kinetics import Matrix

NEAR = 1e-7  # of the clearance by which surfaces may be apart that touch: as near as an impact is met
GIVES = 1e-6  # of what moves with all others open that is left with them closed: contacts are not rigid
SAME = 1e-9  # what a direction must hold besides the others, as a share of its own


class EffectiveMasses(NamedTuple):
    """How a clearance pin's journal answers impulses, in the axes of its bore.

    alone: with all other clearance pins open; the lightest that can move, which steps have to follow.
    held: with those closed that are pressed; what the laws are told.
    """

    alone: InverseMass
    held: InverseMass

    def mixed(self, other: EffectiveMasses, x: float) -> EffectiveMasses:
        """Those at a fraction x of the way to others, by a straight line."""
        return EffectiveMasses(*(one.mixed(its, x) for one, its in zip(self, other, strict=True)))


NOT_KNOWN = EffectiveMasses(*2 * (InverseMass(math.nan, math.nan, math.nan),))


def inverse_masses(answers: Matrix, axes: Matrix) -> EffectiveMasses:
    """The inverse effective masses of a pin from the answers of all that is pressed.

    Arguments:
        answers: velocities by impulses (2 + m, 2 + m) [1/kg]: both components of the eccentricity, then those
            of m pressed pins along their normals.
        axes: of the bore, in columns (2, 2).
    """
    alone = answers[:2, :2]
    return EffectiveMasses(*(InverseMass.of(axes.T @ found @ axes) for found in (alone, held(answers))))


def struck_together(found: EffectiveMasses, answers: Matrix, closing: Matrix) -> EffectiveMasses:
    """The masses of a corner in a slot that impacts at the same time as others, as those of a face do.

    In a free impact of all of them, with closing velocities v, the impulses p = W^-1 v bring them to rest, W
    the answers. So m = p / v of the first is the mass with which it stores at most m v^2 / 2. Others that are
    pressed but do not close, v = 0, are held, as without.

    Arguments:
        found: masses with all others held.
        answers: W along the normals of the corner and of all others that are pressed (1 + m, 1 + m) [1/kg].
        closing: velocities along these (1 + m,) [m/s].
    """
    others = np.maximum(closing[1:], 0.0)
    if not (closing[0] > 0.0 and others.any()):
        return found
    size = np.sqrt(np.diag(answers))
    impulses = np.linalg.pinv(answers / np.outer(size, size), rcond=SAME, hermitian=True) @ (
        np.array([closing[0], *others]) / size
    )
    mass = impulses[0] / size[0] / closing[0]
    return found._replace(held=found.held._replace(yy=float(1.0 / mass))) if mass > 0.0 else found


def normal(x: float, y: float, clearance: float) -> Matrix | None:
    """Along which a journal at an eccentricity x, y [m] is pressed, (2,); None if it is not."""
    size = math.hypot(x, y)
    return np.array([x, y]) / size if size > (1.0 - NEAR) * clearance and size > 0.0 else None


def held(answers: Matrix) -> Matrix:
    """What is left of the first two directions if all others are closed, (2, 2)."""
    alone, coupling, others = answers[:2, :2], answers[:2, 2:], answers[2:, 2:]
    size = np.sqrt(np.maximum(np.diag(others), 0.0))
    moves = size > 0.0
    if not moves.any():
        return alone
    size, coupling = size[moves], coupling[:, moves] / size[moves]
    others = others[np.ix_(moves, moves)] / np.outer(size, size)
    lost: Matrix = coupling @ np.linalg.pinv(others, rcond=SAME, hermitian=True) @ coupling.T
    return np.asarray(alone - (1.0 - GIVES) * lost)
