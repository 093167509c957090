"""Forces in ideal pins, cranks and guides from the motion, body by body, where the linkage has no closed loop.

For a body whose other forces are known, force and moment of its last joint follow from Newton and Euler:

    F = m (a - g) - sum of the other forces,    M = J alpha - sum of their moments about the centre of mass

Its partner then has one unknown joint less.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, BodySeries, pairs
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from user_forces.values.value import Vector2


@dataclass
class JointForces:
    """Forces of joints at all records, in the units of `Trajectory`.

    pins: of the first body on the second (n, 2). cranks (n,). slides: magnitudes of force and moment (n, 2).
    gears: moment on the second body (n,).
    """

    pins: dict[str, Series] = field(default_factory=dict)
    cranks: dict[str, Series] = field(default_factory=dict)
    slides: dict[str, Series] = field(default_factory=dict)
    gears: dict[str, Series] = field(default_factory=dict)


@dataclass(frozen=True)
class PinForce:
    """A known force in a pin: of the first body on the second (n, 2) [N], and where it acts (n, 2) [m]."""

    force: Series
    point: Series


class _Balance:
    """What is left of every body's force and moment after the known ones."""

    def __init__(self, motion: BodyMotion, gravity: Vector2) -> None:
        self.motion = motion
        self.force: dict[str, Series] = {}
        self.moment: dict[str, Series] = {}
        self.centre: dict[str, BodySeries] = {}
        for name, body in motion.linkage.bodies.items():
            i = motion.first(name)
            ax, ay = motion.acceleration[:, i], motion.acceleration[:, i + 1]
            self.force[name] = pairs(body.mass * (ax - gravity[0]), body.mass * (ay - gravity[1]))
            self.moment[name] = body.inertia * motion.acceleration[:, i + 2]
            self.centre[name] = motion.body(name)

    def take(self, body: str, force: Series, point: Series) -> None:
        """Account for a force [N] on a body at points [m]."""
        if body == GROUND:
            return
        x, y = point[:, 0] - self.centre[body].x, point[:, 1] - self.centre[body].y
        self.force[body] -= force
        self.moment[body] -= x * force[:, 1] - y * force[:, 0]


def open_joint_forces(
    motion: BodyMotion,
    gravity: Vector2,
    actuators: Mapping[str, Series],
    known: Mapping[str, PinForce],
) -> JointForces:
    """Forces of all ideal pins, cranks and slides.

    Arguments:
        motion: of all bodies.
        gravity: [m/s^2].
        actuators: force of every actuator (n,) [N], positive if it pushes its ends apart.
        known: forces of the pins that are known, by name; the others must leave no closed loop.

    Raises ValueError if they do.
    """
    linkage = motion.linkage
    left = _Balance(motion, gravity)
    for name, push in actuators.items():
        actuator = linkage.actuators[name]
        foot = motion.place(actuator.foot, actuator.foot_point)
        head = motion.place(actuator.head, actuator.head_point)
        x, y = (head - foot).T
        length = np.sqrt(x * x + y * y)
        force = pairs(push * (x / length), push * (y / length))
        left.take(actuator.head, force, head)
        left.take(actuator.foot, -force, foot)
    for name, pin in known.items():
        place = linkage.pins[name]
        left.take(place.second, pin.force, pin.point)
        left.take(place.first, -pin.force, pin.point)
    found = JointForces(pins={name: pin.force for name, pin in known.items()})
    _guides(left, found)
    waiting = {name: place for name, place in linkage.pins.items() if name not in known}
    while waiting:
        name, body = _next(motion, {name: (p.first, p.second) for name, p in waiting.items()})
        place = waiting.pop(name)
        point = place.second_point if body == place.second else place.first_point
        where = motion.place(body, point)
        force = left.force[body].copy("K")  # on the body
        found.pins[name] = force if body == place.second else -force
        left.take(place.second, found.pins[name], where)
        left.take(place.first, -found.pins[name], where)
    found.cranks = {name: left.moment[crank.body] for name, crank in linkage.cranks.items()}
    return found


def _next(motion: BodyMotion, waiting: Mapping[str, tuple[str, str]]) -> tuple[str, str]:
    """A pin that is the only one left of a body, and that body."""
    for body in motion.linkage.bodies:
        pins = [name for name, ends in waiting.items() if body in ends]
        if len(pins) == 1:
            return pins[0], body
    raise ValueError(f"pins {', '.join(waiting)}: the linkage has a closed loop; allowed: none")


def _guides(left: _Balance, found: JointForces) -> None:
    """Force and moment of straight guides, whose bodies have no other unknown joint."""
    motion = left.motion
    for name, slide in motion.linkage.slides.items():
        angle = slide.direction + motion.turn(slide.against)
        across = np.column_stack([-np.sin(angle), np.cos(angle)])
        where = motion.point(slide.body, slide.point).position
        force = np.einsum("nx,nx->n", left.force[slide.body], across)
        left.take(slide.body, force[:, None] * across, where)
        moment = left.moment[slide.body]
        if slide.against != GROUND:
            left.take(slide.against, -force[:, None] * across, where)
            left.moment[slide.against] = left.moment[slide.against] + moment
        found.slides[name] = np.abs(np.column_stack([force, moment]))
