"""Dry friction in ideal pins and guides: how they slide, how large friction is, and where it acts.

pin: moment = radius law(radius spin, pin force)
guide: force = law(slip, force across), see `IdealGuide`
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.reactions import push, twist
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.guides import IdealGuide
from support_exudyn.model.linkage import Linkage, Slide
from support_exudyn.model.pins import IdealPin
from user_forces.friction.law import FrictionLaw

Carried = tuple[float, float]  # both multipliers of a joint; the second is 0 of a guide without a moment


@dataclass(frozen=True)
class FrictionJoint:
    """An ideal joint with friction, whose second body slides on the first.

    Friction is a force on the second body, along a guide and of nothing but a moment in a pin. Multipliers are
    those of the rows of `reactions.equations`.

    owner: of its rows, see `Kinetics.owners`. part: the pin or guide. slide: of a guide.
    """

    owner: tuple[str, str]
    part: IdealPin | IdealGuide
    first: str
    second: str
    slide: Slide | None = None

    @cached_property
    def law(self) -> FrictionLaw:
        """The law of its friction."""
        assert self.part.friction is not None  # joints without are left out
        return self.part.friction

    @property
    def conditions(self) -> int:
        """How many multipliers the joint has."""
        return 2 if self.slide is None else self.slide.conditions

    def lever(self, carried: Carried) -> float:
        """Arm [m] of the friction force about the joint's point on the second body."""
        return self.part.lever(-carried[0]) if isinstance(self.part, IdealGuide) else self.part.radius or 0.0

    def force(self, carried: Carried, slip: float, deflection: float) -> float:
        """Friction force [N] on the second body, along the slip [m/s]; deflection: state of the law [m]."""
        if isinstance(self.part, IdealGuide):  # multipliers act against the second body
            return self.part.friction_force(-carried[0], -carried[1], slip, deflection)
        return float(self.law(slip, math.hypot(*carried), deflection))

    def slips(self, motion: BodyMotion, carried: Series | None = None) -> Series:
        """The slip (n,) [m/s] under multipliers (n, conditions); without, a pin in a slot does not turn."""
        speed = np.zeros(motion.count) if self.slide is None else motion.sliding(self.slide)[1]
        if carried is None and self.slide is not None:
            return speed
        levers = self._levers(np.zeros((motion.count, 2)) if carried is None else carried)
        return speed + levers * (motion.spin(self.second) - motion.spin(self.first))

    def forces(self, motion: BodyMotion, carried: Series, deflection: Series) -> Series:
        """The friction force (n,) [N], from multipliers (n, conditions) and states of the law (n,) [m]."""
        known = zip(_both(carried), self.slips(motion, carried).tolist(), deflection.tolist(), strict=True)
        return np.array([self.force(held, slip, state) for held, slip, state in known])

    def apply(self, total: Series, motion: BodyMotion, carried: Series, friction: Series) -> None:
        """Add a friction force (n,) [N] to the forces on all coordinates (n, 3 b)."""
        moment = self._levers(carried) * friction
        for body, sign in ((self.second, 1.0), (self.first, -1.0)):
            twist(total, motion, body, sign * moment)
            if self.slide is not None:
                point = motion.place(self.slide.body, self.slide.point)
                push(total, motion, body, sign * friction[:, None] * motion.sliding(self.slide)[0], point)

    def _levers(self, carried: Series) -> Series:
        return np.array([self.lever(one) for one in _both(carried)])


def _both(carried: Series) -> list[Carried]:
    """Multipliers (n, 1) or (n, 2) as pairs."""
    return [(one[0], one[-1] if len(one) == 2 else 0.0) for one in carried.tolist()]


def friction_joints(
    linkage: Linkage, pins: Mapping[str, IdealPin], guides: Mapping[str, IdealGuide]
) -> dict[str, FrictionJoint]:
    """Ideal pins with friction, then ideal guides, as "pins.NAME" and "guides.NAME"."""
    found: dict[str, FrictionJoint] = {}
    for name, pin in pins.items():
        place = linkage.pins[name]
        found[f"pins.{name}"] = FrictionJoint(("pins", name), pin, place.first, place.second)
    for name, guide in guides.items():
        slide = linkage.slides[name]
        found[f"guides.{name}"] = FrictionJoint(("slides", name), guide, slide.against, slide.body, slide)
    return found


def friction_series(
    joints: Mapping[str, FrictionJoint], forces: Mapping[str, Series]
) -> dict[str, dict[str, Series]]:
    """Fields of a `Trajectory` from friction forces (n,) [N] by the names of the joints."""
    found: dict[str, dict[str, Series]] = {"friction_moments": {}, "friction_forces": {}}
    for where, force in forces.items():
        joint, name = joints[where], joints[where].owner[1]
        if isinstance(joint.part, IdealPin):
            found["friction_moments"][name] = (joint.part.radius or 0.0) * force
        else:
            found["friction_forces"][name] = force
    return found
