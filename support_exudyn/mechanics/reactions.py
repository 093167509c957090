"""Accelerations and forces of all that is held, from the motion, in the plane and in space.

Mass matrix M and constraint Jacobian C of one instant give both from the forces f that are applied, those of
turning among them, and from what drives do to the lengths and angles that are held, c:

    M a + C^T L = f,    C a = c'' - C' v

Where rows of C repeat each other, many L do that, and rigid bodies cannot tell them apart. The least is taken:
that of the smallest sum of squares. In the plane a moment counts by one over the size of the linkage, in space
as a force at 1 m. `Loads` tells which forces that leaves open.

The engine's own multipliers and accelerations are differences of positions over the step's square, in which
rounding shows at short steps. Nothing here is divided by a step.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cached_property

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, Motion, SpatialMotion
from support_exudyn.mechanics.constraints import (
    SAME,
    Constraint,
    Shift,
    Turn,
    constraints_in_space,
    independent,
    joints_held,
    matrix,
    turning,
)
from support_exudyn.mechanics.kinetics import counts_of, gyroscopic, kinetics_of, lightness_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND, LinearActuator
from support_exudyn.model.spatial_linkage import SpatialActuator, SpatialLinkage

# Beside bodies of next to no mass what heavy ones add to the square of the rows is lost to rounding: the second
# round makes up for it.
ROUNDS = 2
# Those in which point masses are given back what stands in for their inertia end once that has settled.
MOST_ROUNDS, SETTLED = 30, 1e-13
SAMPLES = 5  # records at which is determined which rows repeat others
# how the meaning of a channel ends that holds one of many shares
UNDETERMINED = (
    "; rigid bodies do not determine it: of all that balance, that with the least sum of squares of all loads"
)

# [s] over which speeds are compared: no drive changes so fast, and rounding of speeds is far less. A power of
# two, so that times of a fine grid have no rounding late in a run that they do not have early.
BACK = 2.0**-17
PARTS = 4.0  # of the time since the last break, of which three are compared
CLOSE = 1e-9  # [s] and share of its time by which a break is the same time


def push(forces: Series, motion: Motion, body: str, force: Series, point: Series) -> None:
    """Add a force (n, d) [N] on a body at points (n, d) [m] to the forces on all coordinates."""
    if body == GROUND:
        return
    i, turns = motion.first(body), motion.first(body) + motion.SHIFTS
    arm = point - motion.place(body, motion.linkage.bodies[body].centre)
    forces[:, i:turns] += force
    forces[:, turns : i + motion.FREEDOMS] += motion.moment(arm, force)


def twist(forces: Series, motion: Motion, body: str, moment: Series) -> None:
    """Add a moment [N m] on a body to the forces on all coordinates; (n,) in the plane, (n, 3) in space."""
    if body != GROUND:
        i = motion.first(body)
        forces[:, i + motion.SHIFTS : i + motion.FREEDOMS] += moment.reshape(motion.count, -1)


def push_apart(
    forces: Series, motion: Motion, actuator: LinearActuator | SpatialActuator, force: Series
) -> None:
    """Add the force (n,) [N] with which an actuator pushes its ends apart to the forces on all coordinates."""
    span = motion.span(actuator)
    apart = force[:, None] * (span / np.linalg.norm(span, axis=1)[:, None])
    push(forces, motion, actuator.head, apart, motion.place(actuator.head, actuator.head_point))
    push(forces, motion, actuator.foot, -apart, motion.place(actuator.foot, actuator.foot_point))


def equations(motion: Motion, held: Sequence[Constraint], driven: Series) -> Equations:
    """Those of all bodies.

    Arguments:
        motion: positions and velocities of all bodies.
        held: what is held.
        driven: second derivatives of what drives move, (n, actuators and cranks) [m/s^2], [rad/s^2].
    """
    wanted = -turning(motion, held)
    wanted[:, [constraint.part in ("actuators", "cranks") for constraint in held]] += driven
    size, stand_in = 1.0, np.zeros(1)
    if isinstance(motion, BodyMotion):
        kinetics = kinetics_of(motion.linkage)
        size, stand_in = kinetics.size, kinetics.stand_in
    lightness, counts = lightness_of(motion, stand_in), counts_of(held, size)
    return Equations(matrix(motion, held), wanted, lightness, gyroscopic(motion), counts, stand_in)


class Equations:
    """The equations of motion at all records, to be solved for any forces.

    Rows C_d that repeat others, C_i, are sums of them, C_d = K C_i. They ask for nothing new, and N L_d does
    nothing to any body, with N = (-K^T, 1): of all L that fit the least is orthogonal to the columns of N.

    Arguments:
        rows: C, (n, rows, coordinates).
        wanted: C a, (n, rows).
        lightness: gives M^-1 f for forces f on all coordinates, (n, ..., coordinates).
        turning: omega x J omega, (n, coordinates).
        counts: factor of each row (rows,) [m], see `Kinetics.counts`.
        stand_in: what of M stands in for the inertia of point masses (coordinates,), see `Kinetics.stand_in`.
    """

    def __init__(
        self,
        rows: Series,
        wanted: Series,
        lightness: Callable[[Series], Series],
        turning: Series | float,
        counts: Series,
        stand_in: Series,
    ) -> None:
        self._stand_in, self._turning, self._lightness = stand_in, turning, lightness
        some = np.linspace(0, len(rows) - 1, SAMPLES).astype(int) if len(rows) else ()
        kept = max((independent(rows[n] * counts[:, None]) for n in some), key=len, default=[])
        self._counts, self._kept = counts, np.array(kept, dtype=int)
        self._rows, self._wanted = rows[:, self._kept], wanted[:, self._kept]
        light = np.swapaxes(lightness(self._rows), 1, 2)
        self._square = self._rows @ light  # C M^-1 C^T
        self._repeating = np.setdiff1d(np.arange(len(counts)), self._kept)
        self._cross = rows[:, self._repeating] @ light

    def solve(self, forces: Series) -> tuple[Series, Series]:
        """Accelerations (n, coordinates) and L (n, rows) under applied forces on all coordinates."""
        forces = forces - self._turning
        held, acceleration = np.zeros(self._wanted.shape), np.zeros_like(forces)
        for rounds in range(1, MOST_ROUNDS + 1):
            given = self._stand_in * acceleration  # the moment that gives back what stands in
            left = forces + given - np.einsum("nrk,nr->nk", self._rows, held)
            missing = np.einsum("nrk,nk->nr", self._rows, self._lightness(left)) - self._wanted
            change = _solved(self._square, missing[..., None])[..., 0]
            held += change
            acceleration = self._lightness(left - np.einsum("nrk,nr->nk", self._rows, change))
            changed = np.abs(self._stand_in * acceleration - given)
            if rounds >= ROUNDS and np.all(changed <= SETTLED * np.abs(given).max(initial=0.0)):
                break
        return acceleration, self._least(held)

    def _least(self, held: Series) -> Series:
        """The least L (n, rows) that does what those of the independent rows do (n, independent rows)."""
        found = np.zeros((len(held), len(self._counts)))
        found[:, self._kept] = held
        if not self._repeating.size:
            return found
        nothing = np.zeros((*found.shape, self._repeating.size))  # N
        nothing[:, self._kept] = -_solved(self._square, np.swapaxes(self._cross, 1, 2))
        nothing[:, self._repeating] = np.eye(self._repeating.size)
        nothing /= self._counts[:, None]
        counted = (found / self._counts)[..., None]
        square = np.swapaxes(nothing, 1, 2) @ nothing
        shares = np.linalg.solve(square, np.swapaxes(nothing, 1, 2) @ counted)
        return np.asarray(self._counts * (counted - nothing @ shares)[..., 0])


def _solved(square: Series, right: Series) -> Series:
    """x (n, r, k) of square x = right, symmetric matrices (n, r, r); the least that fits at a dead centre."""
    try:
        return np.asarray(np.linalg.solve(square, right))
    except np.linalg.LinAlgError:
        return np.asarray(np.linalg.pinv(square, hermitian=True) @ right)


def joint_forces(held: Sequence[Constraint], multipliers: Series) -> Mapping[str, dict[str, Series]]:
    """Forces of all joints of the plane by the field of the linkage and their names, from L (n, rows).

    Of pins on the second body (n, 2) [N], of actuators, pushing their ends apart (n,) [N], of cranks on the
    crank and of gears on the second body (n,) [N m], of guides force and moment (n, 2) [N], [N m].
    """
    parts = ("pins", "actuators", "cranks", "slides", "gears")
    found: dict[str, dict[str, Series]] = {part: {} for part in parts}
    for (part, name), rows in joints_held(held).items():
        # rows are second minus first, so that what holds them acts on the second reversed
        force = -multipliers[:, rows]
        if part == "slides":  # with no moment where the body may turn
            found[part][name] = np.zeros((len(force), 2))
            found[part][name][:, : force.shape[1]] = force
        else:
            found[part][name] = force if part == "pins" else force[:, 0]
    return found


def bearing_load(
    motion: SpatialMotion, held: Sequence[Constraint], multipliers: Series, name: str
) -> tuple[Series, Series]:
    """Force [N] and moment [N m] of the constraints of a bearing on its second body, from L; (n, 3) each."""
    force, moment = np.zeros((2, motion.count, 3))
    for constraint, value in zip(held, multipliers.T, strict=True):
        if constraint.name == name and isinstance(constraint, Shift | Turn):
            part = moment if isinstance(constraint, Turn) else force
            part -= value[:, None] * motion.carried(constraint.carrier, constraint.direction)
    return force, moment


class Loads:
    """Which loads of a linkage in space rigid bodies determine, where constraints repeat each other.

    The equations of motion fix C^T L alone. A load is a linear map of L; it is determined if it is zero for all
    that C^T takes to zero: loads that bearings put on each other. Judged in the start posture.

    Arguments:
        linkage: what is held.
        with_clearance: planar pins with clearance. oil: planar actuators on oil.
    """

    def __init__(self, linkage: SpatialLinkage, with_clearance: Collection[str], oil: Collection[str]) -> None:
        rigid = [name for name, actuator in linkage.actuators.items() if actuator.actuator not in oil]
        self.held = constraints_in_space(linkage, with_clearance, rigid)
        self.start = SpatialMotion.at_start(linkage)

    @cached_property
    def unbalanced(self) -> Series:
        """An orthonormal basis of the L that do nothing to any body, (rows, how many)."""
        if not self.held:
            return np.zeros((0, 0))
        left, sizes, _ = np.linalg.svd(matrix(self.start, self.held)[0])
        return np.asarray(left[:, int((sizes > SAME * sizes[0]).sum()) :])

    def determine(self, kind: type[Constraint], names: Collection[str]) -> bool:
        """Whether the sum of the loads of constraints of this kind and these names is determined, as a vector.

        kind: Distance of actuators' forces, Shift of bearings' forces, Turn of their moments.
        """
        rows = [n for n, held in enumerate(self.held) if type(held) is kind and held.name in names]
        along = np.array([getattr(self.held[n], "direction", (1.0,)) for n in rows])
        return bool(np.abs(along.T @ self.unbalanced[rows]).max(initial=0.0) <= SAME)


# --- second derivatives of drives, which say only how far they are and how fast ---


def accelerations(drive: Drive, time: Series, duration: float) -> Series:
    """Rate of a drive's speed at times from 0 on [s], (n,) [m/s^2], [rad/s^2].

        (11 v(t) - 18 v(t - d) + 9 v(t - 2 d) - 2 v(t - 3 d)) / (6 d)

    At a break it is the value before it. duration: of the run [s].
    """
    if drive.span(duration) == (0.0, 0.0):
        return np.zeros_like(time)
    breaks, found = sorted(drive.breaks), []
    for t in time.tolist():
        if t <= 0.0:  # from times after the start; before one that is a break nothing has been accelerated
            d = min([BACK, *(b / PARTS for b in breaks if b > 0.0)])
            change = _difference(drive.initial_speed, *(drive.speed(n * d) for n in (1, 2, 3)))
            found.append(0.0 if 0.0 in breaks else -change / d)
            continue
        close = CLOSE * max(1.0, t)
        place = bisect_left(breaks, t - close)
        if place < len(breaks) and breaks[place] <= t + close:
            t = breaks[place]  # beyond it the speed may be another
        d = min(BACK, (t - (breaks[place - 1] if place else 0.0)) / PARTS)
        found.append(_difference(drive.speed(t), *(drive.speed(t - n * d) for n in (1, 2, 3))) / d)
    return np.array(found)


def accelerations_of(drives: Sequence[Drive], time: Series, duration: float) -> list[Series]:
    """`accelerations` of several drives, which often are the same: computed once for all that are equal."""
    found: list[Series] = []
    for drive in drives:
        first = drives.index(drive)
        found.append(found[first] if first < len(found) else accelerations(drive, time, duration))
    return found


def _difference(last: float, first: float, second: float, third: float) -> float:
    """Change of the cubic through four speeds, counted back from the last, in a step up to that."""
    return (11.0 * last - 18.0 * first + 9.0 * second - 2.0 * third) / 6.0
