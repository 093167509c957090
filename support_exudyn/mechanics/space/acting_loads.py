"""What loads do to a machine in space at the records: forces on points, moments about the lateral axis.

A moment acts on the turn that the side view shows: the angle of the body's forward direction e about the
lateral axis of the body that the opposite moment acts on,

    turn = atan2(e_y, e_x),   d turn/dt = axis . omega
    axis = (-e_x e_z, -e_y e_z, e_x^2 + e_y^2) / (e_x^2 + e_y^2)

with the components and the relative angular velocity omega in that body's axes. The moment's vector is moment
times axis, which is the lateral axis as long as e stays in the machine's plane; so the power is moment times
d turn/dt, and a spring that acts on the turn gives back what it has taken up.
"""

from functools import singledispatch
from typing import Any, Protocol

import numpy as np

from support_exudyn.mechanics.acting_loads import actions
from support_exudyn.mechanics.channels import LOADED, ChannelDefinition, ChannelDefinitions
from support_exudyn.mechanics.space.motion import SpatialMotion
from support_exudyn.mechanics.trajectory import LoadSeries, Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.loads.load import ActingLoad, Load, LoadChannel
from support_exudyn.model.loads.moment_load import MomentLoad
from support_exudyn.model.loads.stretch_load import StretchLoad
from support_exudyn.model.to_space import at


class Push(Protocol):
    """Adds a force on a body (n, 3) [N] at points (n, 3) [m] to the forces on all bodies."""

    def __call__(self, forces: Series, body: str, force: Series, point: Series) -> None:
        """See the class."""


def turning_axis(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any]:
    """The axis of a body's turn in the side view, from its forward direction; see the module."""
    square = x * x + y * y
    return -x * z / square, -y * z / square, 1.0 + 0.0 * z


@singledispatch
def load_series(load: ActingLoad, name: str, motion: SpatialMotion, time: Series) -> LoadSeries:
    """The load of this name at the records [s]; force and moment (n, 3) each, in the ground's axes."""
    raise TypeError(f"loads.{name} = {type(load).__name__}: is no Load, MomentLoad or StretchLoad")


@load_series.register
def _of_force(load: Load, name: str, motion: SpatialMotion, time: Series) -> LoadSeries:
    point = motion.point(load.body, at(load.point, load.lateral))
    origin = motion.point(load.against(name), at(load.origin, load.origin_lateral))
    x, y, z = (point.position - origin.position).T
    vx, vy, vz = (point.velocity - origin.velocity).T
    force, stored, observed = actions(load, np.column_stack([time, x, y, vx, vy, z, vz]))
    return LoadSeries(force, np.zeros_like(force), stored, observed)


@load_series.register
def _of_moment(load: MomentLoad, name: str, motion: SpatialMotion, time: Series) -> LoadSeries:
    del name
    frame = np.stack([motion.carried(load.other, np.eye(3)[k]) for k in range(3)], axis=-1)
    forward = np.einsum("nij,ni->jn", frame, motion.carried(load.body, np.array([1.0, 0.0, 0.0])))
    axis = np.einsum("nij,jn->ni", frame, np.array(turning_axis(*forward)))
    turn = np.unwrap(np.arctan2(forward[1], forward[0]))
    rate = np.einsum("ni,ni->n", axis, motion.spin_of(load.body) - motion.spin_of(load.other))
    found, stored, observed = actions(load, np.column_stack([time, turn, rate]))
    moment = found * axis
    return LoadSeries(np.zeros_like(moment), moment, stored, observed)


@load_series.register
def _of_stretch(load: StretchLoad, name: str, motion: SpatialMotion, time: Series) -> LoadSeries:
    del name
    ends = [motion.point(load.body, at(point, load.lateral)) for point in load.points]
    ways = [end.position[:, 1] - point[1] for end, point in zip(ends, load.points, strict=True)]
    rates = [end.velocity[:, 1] for end in ends]
    forces, stored, observed = actions(load, np.column_stack([time, *ways, *rates]))
    up = np.array([0.0, 1.0, 0.0])
    moment = np.cross(ends[1].position - ends[0].position, forces[:, 1:] * up)
    return LoadSeries(forces.sum(axis=1)[:, None] * up, moment, stored, observed)


def add_load(
    forces: Series, motion: SpatialMotion, name: str, load: ActingLoad, series: LoadSeries, push: Push
) -> None:
    """Add what a load of this name does at the records to the forces on all bodies (n, b, 6)."""
    against = load.against(name)
    if isinstance(load, Load):
        point = motion.point(load.body, at(load.point, load.lateral)).position
        push(forces, load.body, series.force, point)
        origin = motion.point(against, at(load.origin, load.origin_lateral)).position
        push(forces, against, -series.force, origin)
        return
    if isinstance(load, StretchLoad):  # its moment is about the first point
        push(
            forces, load.body, series.force, motion.point(load.body, at(load.points[0], load.lateral)).position
        )
    for body, sign in ((load.body, 1.0), (against, -1.0)):
        if body != GROUND:
            forces[:, motion.index(body), 3:] += sign * series.moment


def load_channels(name: str, load: ActingLoad) -> ChannelDefinitions:
    """The channels of a load of this name, as in the plane."""

    def said(what: str, channel: LoadChannel) -> ChannelDefinition:
        return ChannelDefinition(
            channel.unit, channel.meaning, LOADED, lambda context: context.acting[name].observed[what]
        )

    return {f"{name}.{what}": said(what, channel) for what, channel in load.channels.items()}
