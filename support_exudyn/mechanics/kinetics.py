"""Masses and constraints of a linkage as matrices, for what happens at an instant.

Mass matrix M and constraint Jacobian C (see `constraints`) give the change of velocities dv and the impulses L
under generalised impulses b and a change c of the constraints' rates:

    M dv + C^T L = b,    C dv = c

Velocities are those of the centres of all bodies and their spins, in the ground's axes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.body_motion import BodyMotion, Motion, SpatialMotion, cross
from support_exudyn.mechanics.constraints import (
    SAME,
    TURNS,
    Constraint,
    ConstraintRows,
    Shift,
    constraints_of,
    matrix,
    pin,
)
from support_exudyn.model.linkage import GROUND, Linkage, PinPlace
from support_exudyn.model.spatial_linkage import SpatialBody
from user_forces.values.value import Vector2

Matrix = npt.NDArray[np.float64]
STAND_IN = 0.01  # of mass times the square of the longest arm
REPEATED = 1e-9  # of the largest singular value: below, rows repeat each other


def kinetics_of(
    linkage: Linkage, ideal: Iterable[str] | None = None, rigid: Iterable[str] | None = None
) -> Kinetics:
    """Matrices of a linkage of the plane.

    ideal, rigid: names of the pins that are closed, and of the actuators that are rigid; all by default.
    """
    actuators = tuple(linkage.actuators) if rigid is None else tuple(rigid)
    return Kinetics(linkage, tuple(constraints_of(linkage, ideal, actuators)), actuators)


@dataclass(frozen=True)
class Kinetics:
    """Matrices of a linkage of the plane, coordinates x, y and turn of each body in the order of the linkage.

    linkage: the mechanism. constraints: what is held, in the order of their rows. actuators: names of those
    that are rigid.
    """

    linkage: Linkage
    constraints: Sequence[Constraint]
    actuators: Sequence[str]

    def first(self, body: str) -> int:
        """Column of a body's x; y and turn follow."""
        return self._still.first(body)

    @cached_property
    def _still(self) -> BodyMotion:
        return self.motion(np.zeros(3 * len(self.linkage.bodies)))

    def motion(self, position: Matrix) -> BodyMotion:
        """All bodies at rest at a position (n,)."""
        return BodyMotion(self.linkage, position[None], np.zeros((1, position.size)))

    @cached_property
    def arrays(self) -> ConstraintRows:
        """The constraints as arrays, for many instants at once."""
        return ConstraintRows(self.linkage, self.constraints)

    @cached_property
    def size(self) -> float:
        """The larger of length and height of the linkage at its start [m]; 1 m if all is in one place."""
        places = [body.centre for body in self.linkage.bodies.values()]
        extent = float(np.ptp(places + [place for _, place in joints_of(self.linkage)], axis=0).max())
        return extent if extent > 1e-9 else 1.0

    @cached_property
    def counts(self) -> Matrix:
        """Factor of each row (m,) [m]: angles count by the size of the linkage, and moments by one over it."""
        return counts_of(self.constraints, self.size)

    @cached_property
    def stand_in(self) -> Matrix:
        """What stands in for the inertia of point masses where one is divided by it (n,) [kg m^2], else 0."""
        found = np.zeros(3 * len(self.linkage.bodies))
        for name, body in self.linkage.bodies.items():
            if body.inertia == 0.0:
                arms = [math.dist(at, body.centre) for joined, at in joints_of(self.linkage) if joined == name]
                arm = max(arms, default=0.0) or self.size
                found[self.first(name) + 2] = STAND_IN * body.mass * arm**2
        return found

    def mass(self) -> Matrix:
        """Diagonal of the mass matrix, shape (n,)."""
        return masses_of(self.linkage)

    def weight(self, gravity: Vector2) -> Matrix:
        """Forces of gravity [m/s^2] on all coordinates [N], shape (n,)."""
        return np.asarray(weight_of(self._still, gravity)[0])

    def rows(self, position: Matrix) -> Matrix:
        """Jacobian C, (m, n), see `constraints_of`."""
        return np.asarray(self.arrays.matrix(self.motion(position))[0])

    def values(self, position: Matrix) -> Matrix:
        """What the constraints hold, (m,): lengths [m] and turns [rad]."""
        return np.asarray(self.arrays.values(self.motion(position))[0])

    def owners(self) -> list[tuple[str, str]]:
        """Of each of the rows, the field of the linkage and the name of the part that it is of."""
        return [(constraint.part, constraint.name) for constraint in self.constraints]

    def turning(self, size: int, body: str) -> Matrix:
        """The row (size,) that gives a body's angular velocity; that of the ground is none."""
        row = np.zeros(size)
        if body != GROUND:
            row[self.first(body) + 2] = 1.0
        return row

    def driven(self) -> slice:
        """Which of the rows can be driven: rigid actuators, then cranks."""
        first = sum(constraint.part == "pins" for constraint in self.constraints)
        return slice(first, first + len(self.actuators) + len(self.linkage.cranks))

    def rates(self, speed: Callable[[str], float]) -> Matrix:
        """Rates of all rows, (m,): of rigid actuators and cranks by name [m/s], [rad/s], else 0."""
        return rates(self.constraints, speed)

    def point(self, position: Matrix, body: str, point: Vector2) -> tuple[Matrix, Matrix]:
        """Place of a point of a body (2,) and the matrix that turns all velocities into its own (2, n)."""
        motion, rate = self.motion(position), np.zeros((2, position.size))
        if body != GROUND:
            i, (x, y) = self.first(body), motion.arm(body, point)[0]
            rate[:, i : i + 3] = (1.0, 0.0, -y), (0.0, 1.0, x)
        return motion.place(body, point)[0], rate

    def relative(self, position: Matrix, place: PinPlace) -> tuple[Matrix, Matrix]:
        """Centre of a pin on its second body minus that on its first (2,), and its rate's matrix (2, n)."""
        motion = self.motion(position)
        first, second = (motion.place(*side) for side in place.sides)
        return (second - first)[0], matrix(motion, pin("", place))[0]

    def respond(self, position: Matrix, impulse: Matrix, jump: Matrix | float) -> tuple[Matrix, Matrix]:
        """Change of velocities (n,) and impulses (m,) at a position (n,), see `Instant.respond`."""
        return self._instant(position).respond(impulse, jump)

    def inverse_mass(self, position: Matrix, rate: Matrix) -> Matrix:
        """Answer of rates to impulses in them, J dv per impulse (k, k) [1/kg], J the rows of the rates (k, n).

            M dv + C^T L = J^T,   C dv = 0

        Of a clearance pin's eccentricity the inverse of n J dv n is the mass that an impact along n moves.
        """
        return self._instant(position).answers(rate)

    def _instant(self, position: Matrix) -> Instant:
        return Instant(self.motion(position), self.constraints, self.size, self.arrays)


@dataclass(frozen=True)
class Instant:
    """Masses and constraints of one instant, in the plane or in space.

    motion: of that instant. held: the constraints. size: length [m] by which turns count where constraints
    repeat each other. arrays: of the constraints, where they are known.
    """

    motion: Motion
    held: Sequence[Constraint]
    size: float = 1.0
    arrays: ConstraintRows | None = None

    @cached_property
    def rows(self) -> Matrix:
        """C, (m, n)."""
        arrays = self.arrays or ConstraintRows(self.motion.linkage, self.held)
        return np.asarray(arrays.matrix(self.motion)[0])

    @cached_property
    def mass(self) -> Matrix:
        """M, (n, n)."""
        linkage = self.motion.linkage
        if not isinstance(self.motion, SpatialMotion):
            return np.diag(masses_of(linkage))
        found = np.zeros((6 * len(linkage.bodies), 6 * len(linkage.bodies)))
        for n, (body, inertia) in enumerate(
            zip(linkage.bodies.values(), inertias(self.motion)[0], strict=True)
        ):
            found[6 * n : 6 * n + 3, 6 * n : 6 * n + 3] = body.mass * np.eye(3)
            found[6 * n + 3 : 6 * n + 6, 6 * n + 3 : 6 * n + 6] = inertia
        return found

    def respond(self, impulse: Matrix, jump: Matrix | float) -> tuple[Matrix, Matrix]:
        """Change of velocities dv (n,) and impulses L (m,) under impulses b (n,) and a jump c (m,).

        Where rows repeat others, L is the least of all that fit, turns counted by the size. Of several impulses
        at once, b (n, k) with c a number: (n, k) and (m, k). At a dead centre dv and L are the least that fit.
        """
        shares = self._cancelling()
        size, count, border = len(self.mass), len(self.rows), shares.shape[1]
        system = np.zeros((size + count + border, size + count + border))
        system[:size, :size] = self.mass
        system[:size, size : size + count] = self.rows.T
        system[size : size + count, :size] = self.rows
        system[size : size + count, size + count :] = shares
        system[size + count :, size : size + count] = shares.T
        right = np.zeros((len(system), *impulse.shape[1:]))
        right[:size], right[size : size + count] = impulse, jump
        try:
            solution = np.linalg.solve(system, right)
        except np.linalg.LinAlgError:
            solution = np.linalg.lstsq(system, right, rcond=None)[0]
        return solution[:size], solution[size : size + count]

    def _cancelling(self) -> Matrix:
        """Shares (m, r) with which impulses of rows cancel each other; r = 0 if none repeats others."""
        counts = counts_of(self.held, self.size)[:, None]
        scaled = counts * self.rows
        freedoms = np.arange(scaled.shape[1]) % self.motion.FREEDOMS
        scaled[:, freedoms >= self.motion.SHIFTS] /= self.size
        left, values, _ = np.linalg.svd(scaled, full_matrices=len(scaled) > scaled.shape[1])
        # in space rows repeat each other but for what positions miss the constraints by
        least = SAME if isinstance(self.motion, SpatialMotion) else REPEATED
        rank = np.count_nonzero(values > least * values.max(initial=0.0))
        return np.asarray(left[:, rank:] / counts)

    def answers(self, rate: Matrix) -> Matrix:
        """Answer of rates to impulses in them (k, k) [1/kg], see `Kinetics.inverse_mass`; rate: rows (k, n)."""
        found: Matrix = (rate @ self.respond(rate.T, 0.0)[0]).T
        return found


def counts_of(constraints: Iterable[Constraint], size: float) -> Matrix:
    """Factor of each row (m,) [m]: those of turns count by a size [m]."""
    return np.array([size if constraint.kind in TURNS else 1.0 for constraint in constraints])


def rates(constraints: Iterable[Constraint], speed: Callable[[str], float]) -> Matrix:
    """Rates of all rows, (m,): of rigid actuators and cranks by name [m/s], [rad/s], else 0."""
    return np.array([speed(one.name) if one.part in ("actuators", "cranks") else 0.0 for one in constraints])


def joint_impulses(constraints: Sequence[Constraint], impulses: Matrix) -> dict[str, float]:
    """Magnitudes of the impulses [N s] of pins and guides among those of all rows, see `Impulse.joints`."""
    found: dict[str, float] = {}
    # a loose bearing may be held along its axis
    ideal = [constraint.name for constraint in constraints if constraint.kind == "across_1"]
    for constraint, impulse in zip(constraints, impulses.tolist(), strict=True):
        if isinstance(constraint, Shift) and constraint.name in ideal:
            name = constraint.name if constraint.part == "slides" else f"pin.{constraint.name}"
            found[name] = math.hypot(found.get(name, 0.0), impulse)
    return found


def masses_of(linkage: Linkage) -> Matrix:
    """Diagonal of the mass matrix of a linkage of the plane, (n,)."""
    return np.ravel([(body.mass, body.mass, body.inertia) for body in linkage.bodies.values()])


def tensor(body: SpatialBody) -> Matrix:
    """Inertia about the centre of mass at the start, (3, 3) [kg m^2]."""
    xx, yy, zz, yz, xz, xy = body.inertia
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def inertias(motion: SpatialMotion) -> Matrix:
    """Inertia of all bodies in the ground's axes, (n, b, 3, 3)."""
    own = np.array([tensor(body) for body in motion.linkage.bodies.values()])
    return np.asarray(motion.rotations @ own @ np.swapaxes(motion.rotations, -1, -2))


def weight_of(motion: Motion, gravity: Sequence[float]) -> Matrix:
    """Forces of gravity [m/s^2] on all coordinates, (n, freedoms)."""
    acting = np.zeros(motion.FREEDOMS)
    acting[: motion.SHIFTS] = gravity
    masses = [body.mass for body in motion.linkage.bodies.values()]
    return np.tile(np.outer(masses, acting).ravel(), (motion.count, 1))


def kinetic_energy(motion: Motion) -> Matrix:
    """Kinetic energy of all bodies (n,) [J]."""
    found = np.zeros(motion.count)
    spinning = inertias(motion) if isinstance(motion, SpatialMotion) else None
    for n, (name, body) in enumerate(motion.linkage.bodies.items()):
        spin = motion.spin(name)
        found += 0.5 * body.mass * (motion.centre(name)[1] ** 2).sum(axis=1)
        if spinning is None:
            found += 0.5 * body.inertia * spin**2
        else:
            found += 0.5 * np.einsum("ni,nij,nj->n", spin, spinning[:, n], spin)
    return found


def gyroscopic(motion: Motion) -> Matrix | float:
    """Moments omega x J omega of all bodies as forces on all coordinates, (n, freedoms); 0 in the plane."""
    if not isinstance(motion, SpatialMotion):
        return 0.0
    found = np.zeros((motion.count, len(motion.linkage.bodies), 6))
    momentum = np.einsum("nbij,nbj->nbi", inertias(motion), motion.spins)
    found[..., 3:] = cross(motion.spins, momentum)
    return found.reshape(motion.count, -1)


def lightness_of(motion: Motion, stand_in: Matrix | float) -> Callable[[Matrix], Matrix]:
    """What gives M^-1 f for forces f on all coordinates, (n, ..., freedoms); stand_in: added to a plane's M."""
    if not isinstance(motion, SpatialMotion):
        mass = masses_of(motion.linkage) + stand_in
        return lambda forces: np.asarray(forces / mass)
    masses = np.array([body.mass for body in motion.linkage.bodies.values()])[:, None]
    inverse = np.linalg.inv(inertias(motion))

    def lightness(forces: Matrix) -> Matrix:
        split = forces.reshape(motion.count, -1, len(masses), 6)
        turned = np.einsum("nbij,nkbj->nkbi", inverse, split[..., 3:])
        return np.concatenate([split[..., :3] / masses, turned], axis=-1).reshape(forces.shape)

    return lightness


def joints_of(linkage: Linkage) -> list[tuple[str, Vector2]]:
    """Bodies with the points at which something is joined to them, the ground among them."""
    return [side for sides in linkage.joints.values() for side in sides]
