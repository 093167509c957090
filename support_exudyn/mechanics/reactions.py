"""Accelerations and forces of all that is held (pins, actuators, cranks, guides, gears), from the motion.

Mass matrix M and constraint Jacobian C of one instant give both from the forces f that are applied and from
what drives do to the lengths and angles that are held, c:

    M a + C^T L = f,    C a = c'' - C' v

Where rows of C repeat each other, many L do that, and rigid bodies cannot tell them apart. The least is taken:
that of the smallest sum of squares, in which a moment counts by one over the size of the linkage.

The engine's own multipliers and accelerations are differences of positions over the step's square, in which
rounding shows at short steps. Nothing here is divided by a step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.kinetics import REPEATED, kinetics_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND, Crank, Gear, LinearActuator, PinPlace, Slide
from user_forces.values.value import Vector2

SHIFT = 1e-5  # [m], [rad] by which bodies go on, at most, where it is looked how rows turn with them
STILL = 1e-6  # [m/s], [rad/s] below which they go on by less: what is left then is far below rounding
# Beside bodies of next to no mass what heavy ones add to the square of the rows is lost to rounding: the second
# round makes up for it.
ROUNDS = 2
# Those in which point masses are given back what stands in for their inertia end once that has settled.
MOST_ROUNDS, SETTLED = 30, 1e-13
SAMPLES = 5  # records at which it is looked how many rows repeat others


@dataclass(frozen=True)
class HeldJoints:
    """What is held, in the order of its rows.

    Two rows an ideal pin, one an actuator, one a crank, one or two a guide, one a gear.
    """

    pins: Sequence[PinPlace]
    actuators: Sequence[LinearActuator]
    cranks: Sequence[Crank]
    slides: Sequence[Slide]
    gears: Sequence[Gear] = ()

    @property
    def driven(self) -> slice:
        """The rows that drives move: actuators, then cranks."""
        first = 2 * len(self.pins)
        return slice(first, first + len(self.actuators) + len(self.cranks))

    @property
    def guided(self) -> tuple[slice, ...]:
        """The rows of each guide: the distance from the line, and the angle of a block."""
        stops = accumulate((slide.conditions for slide in self.slides), initial=self.driven.stop)
        return tuple(slice(first, stop) for first, stop in pairwise(stops))

    @property
    def geared(self) -> slice:
        """The rows of gears, which are the last."""
        first = self.driven.stop + sum(slide.conditions for slide in self.slides)
        return slice(first, first + len(self.gears))


class _Rows:
    """Rates of points and turns at all instants as rows over the velocities of all bodies, (n, 3 b)."""

    def __init__(self, motion: BodyMotion) -> None:
        self.motion = motion
        self.shape = motion.position.shape

    def point(self, body: str, point: Vector2, along: Series) -> Series:
        """The rate of a point of a body in a direction (n, 2)."""
        row = np.zeros(self.shape)
        if body != GROUND:
            i, arm = self.motion.first(body), self.motion.arm(body, point)
            row[:, i : i + 2] = along
            row[:, i + 2] = arm[:, 0] * along[:, 1] - arm[:, 1] * along[:, 0]
        return row

    def turn(self, body: str) -> Series:
        """The rate of a body's angle."""
        row = np.zeros(self.shape)
        if body != GROUND:
            row[:, self.motion.first(body) + 2] = 1.0
        return row

    def gear(self, gear: Gear) -> Series:
        """The rate of the second wheel less the ratio of that of the first, both against the carrier."""
        first, second, carrier = map(self.turn, (gear.first, gear.second, gear.carrier or GROUND))
        return second - gear.ratio * first - (1.0 - gear.ratio) * carrier

    def pin(self, place: PinPlace) -> list[Series]:
        """The rates of a pin's centre on its second body against that on its first, forward and up."""
        return [
            self.point(place.second, place.second_point, along)
            - self.point(place.first, place.first_point, along)
            for along in (np.tile(axis, (self.shape[0], 1)) for axis in ((1.0, 0.0), (0.0, 1.0)))
        ]

    def actuator(self, actuator: LinearActuator) -> Series:
        """The rate of an actuator's length."""
        along = direction(self.motion, actuator)
        head = self.point(actuator.head, actuator.head_point, along)
        return head - self.point(actuator.foot, actuator.foot_point, along)

    def slide(self, slide: Slide) -> list[Series]:
        """The rates of a guide: of its point's distance from the line, which may turn, and of the angle."""
        turned = slide.direction + self.motion.turn(slide.against)
        along = np.column_stack([np.cos(turned), np.sin(turned)])
        across = np.column_stack([-along[:, 1], along[:, 0]])
        apart = self.motion.place(slide.body, slide.point) - self.motion.place(slide.against, slide.point)
        carrier = self.turn(slide.against)
        distance = self.point(slide.body, slide.point, across) - self.point(slide.against, slide.point, across)
        # as the line turns, what is along it comes to lie across it
        distance -= np.einsum("ni,ni->n", along, apart)[:, None] * carrier
        return [distance, self.turn(slide.body) - carrier][: slide.conditions]


def direction(motion: BodyMotion, actuator: LinearActuator) -> Series:
    """The direction from foot to head of an actuator (n, 2)."""
    foot, head = (
        motion.place(actuator.foot, actuator.foot_point),
        motion.place(actuator.head, actuator.head_point),
    )
    span = head - foot
    along: Series = span / np.linalg.norm(span, axis=1)[:, None]
    return along


def matrix(motion: BodyMotion, held: HeldJoints) -> Series:
    """C: the rows of all that is held at every instant, (n, rows, 3 b)."""
    of = _Rows(motion)
    rows = [row for place in held.pins for row in of.pin(place)]
    rows += [of.actuator(actuator) for actuator in held.actuators]
    rows += [of.turn(crank.body) for crank in held.cranks]
    rows += [row for slide in held.slides for row in of.slide(slide)]
    rows += [of.gear(gear) for gear in held.gears]
    return np.stack(rows, axis=1) if rows else np.zeros((len(motion.position), 0, motion.position.shape[1]))


def turning(motion: BodyMotion, held: HeldJoints) -> Series:
    """C' v at every instant, (n, rows): by how much the rows change as the bodies move on."""
    fastest = np.abs(motion.velocity).max(axis=1, initial=0.0)
    time = SHIFT / np.maximum(fastest, STILL)

    def rows(h: Series) -> Series:
        there = motion.position + h[:, None] * motion.velocity
        return matrix(BodyMotion(motion.linkage, there, motion.velocity, motion.acceleration), held)

    changed: Series = np.einsum("nrk,nk->nr", rows(time) - rows(-time), motion.velocity) / (2.0 * time)[:, None]
    return changed


def weight_of(motion: BodyMotion, gravity: Vector2) -> Series:
    """Forces of gravity on all coordinates, (n, 3 b)."""
    bodies = motion.linkage.bodies.values()
    one = [part for body in bodies for part in (body.mass * gravity[0], body.mass * gravity[1], 0.0)]
    return np.tile(one, (len(motion.position), 1))


def push(forces: Series, motion: BodyMotion, body: str, force: Series, point: Series) -> None:
    """Add a force (n, 2) [N] on a body at points (n, 2) [m] to the forces on all coordinates."""
    if body == GROUND:
        return
    i = motion.first(body)
    arm = point - motion.place(body, motion.linkage.bodies[body].centre)
    forces[:, i : i + 2] += force
    forces[:, i + 2] += arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]


def twist(forces: Series, motion: BodyMotion, body: str, moment: Series) -> None:
    """Add a moment (n,) [N m] on a body to the forces on all coordinates."""
    if body != GROUND:
        forces[:, motion.first(body) + 2] += moment


def equations(motion: BodyMotion, held: HeldJoints, driven: Series) -> Equations:
    """Those of all bodies of a plane.

    Arguments:
        motion: positions and velocities of all bodies.
        held: what is held.
        driven: second derivatives of what drives move, (n, actuators and cranks) [m/s^2], [rad/s^2].
    """
    kinetics = kinetics_of(motion.linkage)
    wanted = -turning(motion, held)
    wanted[:, held.driven] += driven
    rows, mass = matrix(motion, held), kinetics.mass() + kinetics.stand_in
    turns = ~rows[:, :, np.arange(mass.size) % 3 != 2].any(axis=(0, 2))
    counts = np.where(turns, kinetics.size, 1.0)
    return Equations(rows, wanted, lambda forces: forces / mass, counts, kinetics.stand_in)


class Equations:
    """The equations of motion at all records, to be solved for any forces.

    Arguments:
        rows: C, (n, rows, coordinates).
        wanted: C a, (n, rows).
        lightness: gives M^-1 f for forces f on all coordinates, (n, ..., coordinates).
        counts: factor of each row (rows,) [m], see `Kinetics.counts`, where rows may repeat each other.
        stand_in: what of M stands in for the inertia of point masses (coordinates,), see `Kinetics.stand_in`.
    """

    def __init__(
        self,
        rows: Series,
        wanted: Series,
        lightness: Callable[[Series], Series],
        counts: Series | None = None,
        stand_in: Series | float = 0.0,
    ) -> None:
        self._stand_in = stand_in
        self._rows, self._wanted, self._lightness = rows, wanted, lightness
        self._square = rows @ np.swapaxes(lightness(rows), 1, 2)  # C M^-1 C^T
        self._inverse: Series | None = None
        if counts is not None and (repeats := _repeats(rows * counts[:, None])):
            self._inverse = least_inverse(self._square, counts, repeats)

    def solve(self, forces: Series) -> tuple[Series, Series]:
        """Accelerations (n, coordinates) and L (n, rows) under forces on all coordinates."""
        held, acceleration = np.zeros(self._wanted.shape), np.zeros_like(forces)
        for rounds in range(1, MOST_ROUNDS + 1):
            given = self._stand_in * acceleration  # the moment that gives back what stands in
            left = forces + given - np.einsum("nrk,nr->nk", self._rows, held)
            missing = np.einsum("nrk,nk->nr", self._rows, self._lightness(left)) - self._wanted
            change = self._respond(missing)
            held += change
            acceleration = self._lightness(left - np.einsum("nrk,nr->nk", self._rows, change))
            changed = np.abs(self._stand_in * acceleration - given)
            if rounds >= ROUNDS and np.all(changed <= SETTLED * np.abs(given).max(initial=0.0)):
                break
        return acceleration, held

    def _respond(self, missing: Series) -> Series:
        if self._inverse is not None:
            return np.asarray(np.einsum("nrs,ns->nr", self._inverse, missing))
        try:
            return np.asarray(np.linalg.solve(self._square, missing[..., None])[..., 0])
        except np.linalg.LinAlgError:  # at a dead centre
            return np.asarray(np.einsum("nrs,ns->nr", np.linalg.pinv(self._square, hermitian=True), missing))


def _repeats(rows: Series) -> int:
    """How many rows repeat others at all records (n, rows, coordinates); some of these are looked at."""
    if not rows.size:
        return 0
    some = rows[np.linspace(0, len(rows) - 1, SAMPLES).astype(int)]
    values = np.linalg.svd(some / np.linalg.norm(some, axis=(1, 2), keepdims=True), compute_uv=False)
    return int(rows.shape[1] - np.count_nonzero(values > REPEATED, axis=1).max())


def least_inverse(square: Series, counts: Series, repeats: int) -> Series:
    """What gives the least L with C M^-1 C^T L = b from b, of matrices C M^-1 C^T with rows that repeat others.

    Arguments:
        square: C M^-1 C^T (n, rows, rows).
        counts: factor of each row (rows,) [m].
        repeats: how many rows repeat others.
    """
    own = np.sqrt(np.diagonal(square, axis1=1, axis2=2))[..., None]
    values, vectors = np.linalg.eigh(square / (own * np.swapaxes(own, 1, 2)))
    kept = vectors[..., repeats:] / own
    some = (kept / values[:, None, repeats:]) @ np.swapaxes(kept, 1, 2)
    nothing = np.linalg.qr(vectors[..., :repeats] / own / counts[:, None])[0]
    least: Series = some - counts[:, None] * (nothing @ (np.swapaxes(nothing, 1, 2) @ (some / counts[:, None])))
    return least
