"""What loads do to a linkage in motion: their forces and moments at the records, and on the coordinates."""

from collections.abc import Callable, Mapping
from functools import cache, singledispatch
from typing import Any

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.kinetics import Kinetics, Matrix
from support_exudyn.mechanics.reactions import push, twist
from support_exudyn.mechanics.trajectory import LoadSeries, Series
from support_exudyn.model.loads.load import ActingLoad, Load, LoadedPoint
from support_exudyn.model.loads.moment_load import MomentLoad, TurnedBody
from support_exudyn.model.loads.stretch_load import LoadedStretch, StretchLoad
from user_forces.kernel import compiled_or_plain, numbers

MANY = 1000  # records from which on a compiled loop is faster, though it may have to be compiled


def actions(load: ActingLoad, motion: Matrix) -> tuple[Matrix, Series, dict[str, Series]]:
    """What a load does at the records: its forces (n, k), stored energy (n,) [J], and its channels by name.

    motion: the time [s] and what the load follows, (n, m), in the order of `load.MOTION`.
    """
    forces, width = load.FORCES, load.FORCES + 3 + len(load.channels)
    if load.own_methods or len(motion) < MANY:
        found = np.array([load.acts(load.MOTION(*row)) for row in motion.tolist()]).reshape(-1, width)
    else:
        action, own = load.formula
        times = motion[:, 0].tolist()
        values = [[course(t) for t in times] for course in load.courses]
        known = np.column_stack([motion, *values])
        found = _loop(action, known.shape[1], len(own), width)(known, np.array(own))
    observed = zip(load.channels, found[:, forces + 3 :].T, strict=True)
    return found[:, :forces], found[:, forces], dict(observed)


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


@singledispatch
def load_series(load: ActingLoad, name: str, motion: BodyMotion, time: Series) -> LoadSeries:
    """The load of this name at the records [s]."""
    raise TypeError(f"loads.{name} = {type(load).__name__}: is no Load, MomentLoad or StretchLoad")


@load_series.register
def _of_force(load: Load, name: str, motion: BodyMotion, time: Series) -> LoadSeries:
    point, origin = motion.point(load.body, load.point), motion.point(load.against(name), load.origin)
    way, velocity = point.position - origin.position, point.velocity - origin.velocity
    level = np.zeros((len(time), 2))
    forces, stored, observed = actions(load, np.column_stack([time, way, velocity, level]))
    return LoadSeries(forces[:, :2], level[:, 0], stored, observed)


@load_series.register
def _of_moment(load: MomentLoad, name: str, motion: BodyMotion, time: Series) -> LoadSeries:
    del name
    turn, spin = motion.turn(load.body), motion.spin(load.body)
    turn, spin = turn - motion.turn(load.other), spin - motion.spin(load.other)
    moments, stored, observed = actions(load, np.column_stack([time, turn, spin]))
    return LoadSeries(np.zeros((len(time), 2)), moments[:, 0], stored, observed)


@load_series.register
def _of_stretch(load: StretchLoad, name: str, motion: BodyMotion, time: Series) -> LoadSeries:
    del name
    ends = [motion.point(load.body, point) for point in load.points]
    ways = [end.position[:, 1] - point[1] for end, point in zip(ends, load.points, strict=True)]
    rates = [end.velocity[:, 1] for end in ends]
    forces, stored, observed = actions(load, np.column_stack([time, *ways, *rates]))
    arm = ends[1].position[:, 0] - ends[0].position[:, 0]
    upward = np.column_stack([np.zeros(len(time)), forces.sum(axis=1)])
    return LoadSeries(upward, arm * forces[:, 1], stored, observed)


def add_load(forces: Series, motion: BodyMotion, name: str, load: ActingLoad, series: LoadSeries) -> None:
    """Add what a load of this name does at the records to the forces on all coordinates (n, 3 b)."""
    against = load.against(name)
    if isinstance(load, Load):
        push(forces, motion, load.body, series.force, motion.place(load.body, load.point))
        push(forces, motion, against, -series.force, motion.place(against, load.origin))
    elif isinstance(load, StretchLoad):
        push(forces, motion, load.body, series.force, motion.place(load.body, load.points[0]))
        twist(forces, motion, load.body, series.moment)
    else:
        twist(forces, motion, load.body, series.moment)
        twist(forces, motion, against, -series.moment)


def forces_at_rest(
    system: Kinetics, loads: Mapping[str, ActingLoad], position: Matrix, at: float | None = None
) -> Matrix:
    """What loads do to all coordinates (n,) of a linkage at rest [N], [N m].

    position: coordinates of all bodies (n,). at: a time [s]; None: each once it has come on for good.
    """
    forces = np.zeros(position.size)
    for name, load in loads.items():
        time = max(load.breaks, default=0.0) if at is None else at
        against = load.against(name)
        if isinstance(load, Load):
            point, rate = system.point(position, load.body, load.point)
            origin, origin_rate = system.point(position, against, load.origin)
            x, y = (point - origin).tolist()
            forces += (rate - origin_rate).T @ load.force(LoadedPoint(time, x, y, 0.0, 0.0))
        elif isinstance(load, MomentLoad):
            row = system.turning(position.size, load.body) - system.turning(position.size, against)
            forces += row * load.moment(TurnedBody(time, float(row @ position), 0.0))
        elif isinstance(load, StretchLoad):
            ends = [system.point(position, load.body, point) for point in load.points]
            ways = [float(place[1]) - point[1] for (place, _), point in zip(ends, load.points, strict=True)]
            pushes = load.forces(LoadedStretch(time, ways[0], ways[1], 0.0, 0.0))
            forces += sum(push * rate[1] for push, (_, rate) in zip(pushes, ends, strict=True))
    return forces


def load_rate(system: Kinetics, name: str, load: ActingLoad) -> Matrix:
    """What turns all velocities into those a load sees in the start posture, (2, n) or of a moment (1, n).

    Of a stretch those up at both its ends.
    """
    still, against = np.zeros(3 * len(system.bodies)), load.against(name)
    if isinstance(load, Load):
        point = system.point(still, load.body, load.point)[1]
        return point - system.point(still, against, load.origin)[1]
    if isinstance(load, StretchLoad):
        return np.array([system.point(still, load.body, point)[1][1] for point in load.points])
    return (system.turning(still.size, load.body) - system.turning(still.size, against))[None]
