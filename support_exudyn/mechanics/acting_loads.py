"""What loads do to bodies in motion, in the plane and in space: strains, forces, and where these act.

A strain kind is a class here: how it is measured from the motion of the bodies, and where its forces act.

In space a moment acts on the turn that the side view shows: the angle of the body's forward direction e about
the lateral axis of the body that the opposite moment acts on,

    turn = atan2(e_y, e_x),   d turn/dt = axis . omega
    axis = (-e_x e_z, -e_y e_z, e_x^2 + e_y^2) / (e_x^2 + e_y^2)

with the components and the relative angular velocity omega in that body's axes. The moment's vector is moment
times axis, which is the lateral axis as long as e stays in the machine's plane; so the power is moment times
d turn/dt, and a spring that acts on the turn gives back what it has taken up.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, Motion
from support_exudyn.mechanics.channels import LOADED, ChannelDefinitions, named, table
from support_exudyn.mechanics.kinetics import Kinetics, Matrix
from support_exudyn.mechanics.reactions import push, twist
from support_exudyn.mechanics.trajectory import LoadSeries, Series
from support_exudyn.model.loads.load import ActingLoad, Load, MomentLoad, StretchLoad
from support_exudyn.model.to_space import at
from user_forces.kernel import compiled_or_plain, numbers

MANY = 1000  # records from which on a compiled loop is faster, though it may have to be compiled
# Times at which the largest force is looked for: at least so many, a share of the shortest time apart, at most.
SAMPLES, FINEST = 200, 0.25
MOST_SAMPLES = 5000


def turning_axis(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    """The axis of a body's turn in the side view, from its forward direction; see the module."""
    square = x * x + y * y
    return -x * z / square, -y * z / square, 1.0 + 0.0 * z


class PointStrain:
    """The way of a point against another, of a `Load`, over the motion of all bodies.

    numbers: strains and rates (n, m), as `LoadedPoint` has them.
    """

    def __init__(self, load: Load, name: str, motion: Motion) -> None:
        self.body, self.against, self.motion = load.body, load.against(name), motion
        plane = motion.SHIFTS == 2  # in which both sides are lumped
        self.point = motion.point(self.body, load.point if plane else at(load.point, load.lateral))
        self.origin = motion.point(self.against, load.origin if plane else at(load.origin, load.origin_lateral))
        way, velocity = self.point.position - self.origin.position, self.point.velocity - self.origin.velocity
        level = np.zeros((len(way), 3 - way.shape[1]))
        across = np.column_stack([way[:, 2:], level, velocity[:, 2:], level])
        self.numbers = np.column_stack([way[:, :2], velocity[:, :2], across])

    def apply(self, total: Series, forces: Series) -> None:
        """Add forces (n, 3) of the load to the forces on all bodies."""
        known = forces[:, : self.point.position.shape[1]]
        push(total, self.motion, self.body, known, self.point.position)
        push(total, self.motion, self.against, -known, self.origin.position)


class TurnStrain:
    """The turn of a body against another, of a `MomentLoad`, over the motion of all bodies.

    numbers: turn [rad] and rate [rad/s] (n, 2). axis: of the turn (n, 1) or (n, 3).
    """

    def __init__(self, load: MomentLoad, motion: Motion) -> None:
        self.load, self.motion = load, motion
        spin = motion.spin(load.body) - motion.spin(load.other)
        if isinstance(motion, BodyMotion):
            turn = motion.turn(load.body) - motion.turn(load.other)
            rate, self.axis = spin, np.ones((len(turn), 1))
        else:
            frame = np.stack([motion.carried(load.other, np.eye(3)[k]) for k in range(3)], axis=-1)
            forward = np.einsum("nij,ni->jn", frame, motion.carried(load.body, np.array([1.0, 0.0, 0.0])))
            self.axis = np.einsum("nij,jn->ni", frame, np.array(turning_axis(*forward)))
            rate = np.einsum("ni,ni->n", self.axis, spin)
            turn = np.unwrap(np.arctan2(forward[1], forward[0]))
        self.numbers = np.column_stack([turn, rate])

    def apply(self, total: Series, forces: Series) -> None:
        """Add moments (n, 1) of the load to the forces on all bodies."""
        twist(total, self.motion, self.load.body, forces * self.axis)
        twist(total, self.motion, self.load.other, -forces * self.axis)


class StretchStrain:
    """The ways up of both ends of a stretch, of a `StretchLoad`, over the motion of all bodies.

    numbers: ways up [m] and their rates [m/s] (n, 4).
    """

    def __init__(self, load: StretchLoad, motion: Motion) -> None:
        self.load, self.motion = load, motion
        plane = motion.SHIFTS == 2
        self.ends = [
            motion.point(load.body, point if plane else at(point, load.lateral)) for point in load.points
        ]
        ways = [end.position[:, 1] - point[1] for end, point in zip(self.ends, load.points, strict=True)]
        self.numbers = np.column_stack([*ways, *(end.velocity[:, 1] for end in self.ends)])

    def apply(self, total: Series, forces: Series) -> None:
        """Add forces up (n, 2) of the load at both ends to the forces on all bodies."""
        for end, size in zip(self.ends, forces.T, strict=True):
            up = np.zeros_like(end.position)
            up[:, 1] = size
            push(total, self.motion, self.load.body, up, end.position)


def strain_of(load: ActingLoad, name: str, motion: Motion) -> PointStrain | TurnStrain | StretchStrain:
    """The strain of a load of this name. Raises TypeError for a load of no strain kind."""
    if isinstance(load, Load):
        return PointStrain(load, name, motion)
    if isinstance(load, MomentLoad):
        return TurnStrain(load, motion)
    if isinstance(load, StretchLoad):
        return StretchStrain(load, motion)
    raise TypeError(f"loads.{name} = {type(load).__name__}: is no Load, MomentLoad or StretchLoad")


def load_series(load: ActingLoad, name: str, motion: Motion, time: Series) -> LoadSeries:
    """The load of this name at the records [s]."""
    known = np.column_stack([time, strain_of(load, name, motion).numbers])
    forces, width = load.FORCES, load.FORCES + 3 + len(load.channels)
    if len(known) < MANY:
        found = np.array([load.numbers(load.MOTION(*row)) for row in known.tolist()]).reshape(-1, width)
    else:
        action, own = load.formula
        values = [[course(t) for t in time.tolist()] for course in load.courses]
        known = np.ascontiguousarray(np.column_stack([known, *values]))
        found = _loop(action, known.shape[1], len(own), width)(known, np.array(own))
    observed = dict(zip(load.channels, found[:, forces + 3 :].T, strict=True))
    return LoadSeries(found[:, :forces], found[:, forces], observed)


@cache
def _loop(
    action: Callable[..., tuple[float, ...]], known: int, count: int, width: int
) -> Callable[[Matrix, Matrix], Matrix]:
    """An action as a function of arrays: so many numbers a record and so many parameters."""

    def loop(rows: Any, parameters: Any) -> Matrix:
        found = np.empty((len(rows), width))
        own = numbers(parameters, 0, count)
        for n in range(len(rows)):
            values = action(*numbers(rows[n], 0, known), *own)
            for k in range(width):
                found[n, k] = values[k]
        return found

    return compiled_or_plain(loop, (np.empty((1, known)), np.empty(count)))


def add_load(forces: Series, motion: Motion, name: str, load: ActingLoad, series: LoadSeries) -> None:
    """Add what a load of this name does at the records to the forces on all bodies, (n, freedoms)."""
    strain_of(load, name, motion).apply(forces, series.forces)


def load_channels(name: str, load: ActingLoad, stem: str | None = None) -> ChannelDefinitions:
    """The channels of a load of this name; stem: what their names begin with, by default its name."""
    rows = [(what, *text, partial(_observed, what)) for what, text in load.channels.items()]
    return table(stem or name, LOADED, named("loads", name), rows)


def _observed(what: str, load: LoadSeries) -> Series:
    return load.observed[what]


def forces_at_rest(system: Kinetics, loads: Mapping[str, ActingLoad], position: Matrix) -> Matrix:
    """What loads do to all coordinates (n,) of a linkage at rest, each once it has come on for good [N], [N m].

    system: with coordinates in the order of its bodies. position: coordinates of all bodies (n,).
    """
    motion, forces = system.motion(position), np.zeros((1, position.size))
    for name, load in loads.items():
        time = np.array([max(load.breaks, default=0.0)])
        add_load(forces, motion, name, load, load_series(load, name, motion, time))
    return np.asarray(forces[0])


def largest_forces(system: Kinetics, loads: Mapping[str, ActingLoad], duration: float) -> Matrix:
    """What loads do to all coordinates (n,) in the start posture, each when it is largest in a run [N], [N m].

    system: with coordinates in the order of its bodies. duration: of the run [s].
    """
    found = np.zeros(3 * len(system.linkage.bodies))
    for name, load in loads.items():
        count = SAMPLES + duration / (FINEST * load.shortest_time)
        even = np.linspace(0.0, duration, int(min(count, MOST_SAMPLES)) + 1)
        times = np.union1d(even, [t for t in load.breaks if 0.0 <= t <= duration])
        still, forces = np.zeros((2, len(times), found.size))
        motion = BodyMotion(system.linkage, still, still)
        series = load_series(load, name, motion, times)
        add_load(forces, motion, name, load, series)
        found += forces[np.argmax(np.linalg.norm(series.forces, axis=1))]
    return found


def strain_rates(system: Kinetics, name: str, load: ActingLoad) -> Matrix:
    """What turns all velocities into the rates of a load's strains in the start posture, (k, n).

    That is the transpose of what turns its forces into those on all coordinates.
    """
    still, forces = np.zeros((2, load.FORCES, 3 * len(system.linkage.bodies)))
    strain_of(load, name, BodyMotion(system.linkage, still, still)).apply(forces, np.eye(load.FORCES))
    return forces
