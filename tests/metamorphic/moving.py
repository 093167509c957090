"""Scenes seen in a mirror, turned or from elsewhere, and what is recorded of them."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from support_exudyn import (
    AppliedForce,
    AppliedTorque,
    ClearancePin,
    Crank,
    CubicStep,
    Drive,
    Linkage,
    Machine,
    Result,
    Scenario,
    SpringDamper,
    Steady,
    TorsionSpring,
)
from support_exudyn.model.linkage import turned_moments
from user_forces import value

Point = tuple[float, float]
TURNED = (  # of which the sign says which way round; of guides magnitudes are recorded
    *(".angle", ".angular_velocity", ".angular_acceleration"),
    *(".slip", ".friction_force", ".friction_moment", "crank.moment", "coil.moment", "motor.moment"),
)
FROM_THE_START = (".angle", "energy.potential")  # of which only the change means anything


@dataclass(frozen=True)
class Move:
    """p -> R F (p - about) + about + shift, R a turn; F (x, y) -> (x, -y) if it is flipped, else nothing.

    along: cosine and sine of the turn.
    """

    along: Point = (1.0, 0.0)
    flipped: bool = False
    shift: Point = (0.0, 0.0)
    about: Point = (0.0, 0.0)

    @property
    def sign(self) -> float:
        """What becomes of angles."""
        return -1.0 if self.flipped else 1.0

    @property
    def angle(self) -> float:
        """Of the turn [rad]."""
        return math.atan2(self.along[1], self.along[0])

    def vector(self, of: Any) -> Any:
        """A difference of points; components may be arrays."""
        (c, s), (x, y) = self.along, of
        y = self.sign * y
        return c * x - s * y, s * x + c * y

    def point(self, of: Any) -> Any:
        """A point; components may be arrays."""
        x, y = self.vector((of[0] - self.about[0], of[1] - self.about[1]))
        return x + self.about[0] + self.shift[0], y + self.about[1] + self.shift[1]

    def moments(self, of: Any) -> Any:
        """Second moments of mass."""
        return of and turned_moments((of[0], of[1], self.sign * of[2]), self.angle)

    @property
    def back(self) -> Move:
        """The move that undoes a turn, a shift or a mirror; of no more than one of these."""
        c, s = self.along
        return Move(
            (c, s) if self.flipped else (c, -s), self.flipped, (-self.shift[0], -self.shift[1]), self.about
        )


def turn(degrees: float, about: Point = (0.0, 0.0)) -> Move:
    """A turn about a point."""
    angle = math.radians(degrees)
    return Move(along=(math.cos(angle), math.sin(angle)), about=about)


MIRROR = Move(along=(-1.0, 0.0), flipped=True)  # x -> -x
UPSIDE_DOWN = Move(flipped=True)  # y -> -y


def moved_linkage(linkage: Linkage, move: Move) -> Linkage:
    """All that a linkage holds, moved."""
    bodies = {
        name: replace(
            body,
            centre=move.point(body.centre),
            angle=move.sign * body.angle + move.angle,
            velocity=move.vector(body.velocity),
            spin=move.sign * body.spin,
            moments=move.moments(body.moments),
        )
        for name, body in linkage.bodies.items()
    }
    pins = {
        name: replace(pin, first_point=move.point(pin.first_point), second_point=move.point(pin.second_point))
        for name, pin in linkage.pins.items()
    }
    actuators = {
        name: replace(one, foot_point=move.point(one.foot_point), head_point=move.point(one.head_point))
        for name, one in linkage.actuators.items()
    }
    points = {name: replace(one, point=move.point(one.point)) for name, one in linkage.points.items()}
    slides = {
        name: replace(one, point=move.point(one.point), direction=move.sign * one.direction + move.angle)
        for name, one in linkage.slides.items()
    }
    cranks: Mapping[str, Crank] = linkage.cranks
    return Linkage(bodies=bodies, pins=pins, actuators=actuators, points=points, cranks=cranks, slides=slides)


@value
class Moved(Machine):
    """A machine that is somewhere else; it moves as it did."""

    inner: Machine
    along: tuple[float, float]
    flipped: bool
    shift: tuple[float, float]
    about: tuple[float, float]

    def linkage(self) -> Linkage:
        return moved_linkage(self.inner.linkage(), self._move)

    def detailed(self, actuators: Collection[str], parts: Collection[str]) -> Linkage:
        return moved_linkage(self.inner.detailed(actuators, parts), self._move)

    @property
    def _move(self) -> Move:
        return Move(self.along, self.flipped, self.shift, self.about)

    @property
    def jacks(self) -> Mapping[str, str]:
        return self.inner.jacks

    @property
    def leaders(self) -> Mapping[str, str]:
        return self.inner.leaders

    def coupled_drive(self, name: str, lead: Drive, duration: float) -> Drive:
        return self.inner.coupled_drive(name, lead, duration)


def moved_load(load: Any, move: Move) -> Any:
    """A load moved."""
    if isinstance(load, TorsionSpring):
        return replace(load, free_turn=move.sign * load.free_turn)
    if isinstance(load, AppliedTorque):
        return replace(load, full_torque=move.sign * load.full_torque)
    found = replace(load, point=move.point(load.point))
    if isinstance(load, SpringDamper):
        return replace(found, other_point=move.point(load.other_point))
    return replace(found, full_force=move.vector(load.full_force)) if isinstance(load, AppliedForce) else found


def moved(scenario: Scenario, move: Move) -> Scenario:
    """The whole scene moved, gravity and all."""
    loads = {name: moved_load(load, move) for name, load in scenario.loads.items()}
    pins = {
        name: replace(pin, eccentricity=move.vector(pin.eccentricity)) if isinstance(pin, ClearancePin) else pin
        for name, pin in scenario.pins.items()
    }
    turned = move.flipped and bool(scenario.linkage.cranks)
    return replace(
        scenario,
        machine=Moved(
            inner=scenario.machine,
            along=move.along,
            flipped=move.flipped,
            shift=move.shift,
            about=move.about,
        ),
        gravity=move.vector(scenario.gravity),
        pins=pins,
        loads=loads,
        drive=_turned_back(scenario.drive) if turned else scenario.drive,
    )


def _turned_back(drive: Drive) -> Drive:
    """The other way round."""
    if isinstance(drive, Steady):
        return Steady(rate=-drive.rate)
    assert isinstance(drive, CubicStep)
    return replace(drive, stroke=-drive.stroke)


def context(result: Result, move: Move) -> dict[str, np.ndarray]:
    """What would be recorded of a run if it were moved; potential energy and angles from the start."""
    found = {name: np.array(result[name]) for name in result.channels}
    for name in list(found):
        stem = name[:-1]
        if name.endswith("_x"):
            found[name], found[f"{stem}y"] = move.vector((result[name], result[f"{stem}y"]))
        elif name.endswith(".x"):
            found[name], found[f"{stem}y"] = move.point((result[name], result[f"{stem}y"]))
        elif name.endswith(TURNED):
            found[name] = move.sign * found[name]
    for name in found:
        if name.endswith(FROM_THE_START):
            found[name] = found[name] - found[name][0]
    return found
