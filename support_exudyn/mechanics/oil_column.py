"""Columns of oil: what they carry at the start; their force, energy and power; see `actuators.OilColumn`."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion, PointMotion
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.actuators import OilColumn, Quantity
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import LinearActuator, Linkage
from user_forces.values.value import Vector2


@dataclass(frozen=True)
class PreloadedActuator:
    """An actuator on oil in its place, and by how much its oil is compressed at the start [m]."""

    actuator: LinearActuator
    model: OilColumn
    precompression: float

    def natural_length(self, extension: Quantity) -> Quantity:
        """Length [m] at which the oil carries nothing."""
        return self.actuator.start_length + self.precompression + extension

    def force(self, length: Quantity, extension: Quantity) -> Quantity:
        """Force that pushes the ends apart [N]."""
        return self.model.stiffness(extension) * (self.natural_length(extension) - length)

    def energy(self, length: Quantity, extension: Quantity) -> Quantity:
        """Energy stored in the oil [J]."""
        compression = self.natural_length(extension) - length
        return 0.5 * self.model.stiffness(extension) * compression * compression

    def power(self, length: Quantity, extension: Quantity, speed: Quantity) -> Quantity:
        """Power of the drive that lets oil in [W].

            F speed + (dk/dextension) speed u^2 / 2

        The second term is what the oil gives back because there is more of it to be compressed.
        """
        compression = self.natural_length(extension) - length
        more = 0.5 * self.model.stiffness_slope(extension) * speed * compression * compression
        return self.force(length, extension) * speed + more

    def ends(self, motion: BodyMotion) -> tuple[PointMotion, PointMotion]:
        """Motions of foot and head."""
        actuator = self.actuator
        return motion.point(actuator.foot, actuator.foot_point), motion.point(
            actuator.head, actuator.head_point
        )

    def series(self, motion: BodyMotion, extension: Series, speed: Series) -> OilSeries:
        """The actuator over time, while the drive has these extensions [m] and speeds [m/s], shape (n,)."""
        length, _ = motion.lengthening(self.actuator)
        return OilSeries(
            self.force(length, extension),
            self.energy(length, extension),
            self.power(length, extension, speed),
        )


LENGTHS = 4  # that are rounded, each by up to half a unit in its last place, until there is a force


class OilSeries(NamedTuple):
    """An actuator over time, shape (n,) each.

    force: that pushes the ends apart [N]. energy: stored [J]. work: power of the drive [W].
    """

    force: Series
    energy: Series
    work: Series


def static_loads(linkage: Linkage, gravity: Vector2) -> dict[str, float]:
    """What every actuator carries in the start posture, all pins ideal [N]; positive pushes its ends apart."""
    closed = kinetics_of(linkage)
    weight = closed.weight(gravity)
    tensions = closed.respond(np.zeros(weight.size), weight, 0.0)[1][closed.driven()]
    return {name: -float(tension) for name, tension in zip(linkage.actuators, tensions, strict=False)}


def fill(linkage: Linkage, models: Mapping[str, OilColumn], gravity: Vector2) -> dict[str, PreloadedActuator]:
    """Columns of oil that hold the machine in its start posture, all pins ideal and the others rigid."""
    if not models:
        return {}
    loads = static_loads(linkage, gravity)
    return {
        name: PreloadedActuator(linkage.actuators[name], model, loads[name] / model.stiffness(0.0))
        for name, model in models.items()
    }


def force_rounding(actuators: Iterable[PreloadedActuator]) -> float:
    """Scatter [N] of the forces of these actuators that the rounding of lengths causes."""
    return sum(
        LENGTHS * sys.float_info.epsilon * one.model.stiffness(0.0) * _size(one.actuator) for one in actuators
    )


def _size(actuator: LinearActuator) -> float:
    """The largest of the numbers that an actuator's length is computed from [m]."""
    ends = (*actuator.foot_point, *actuator.head_point)
    return max(actuator.start_length, *map(abs, ends))


def oil_series(preloaded: PreloadedActuator, motion: BodyMotion, drive: Drive, time: Series) -> OilSeries:
    """An actuator over time [s]."""
    extension = np.array([drive.extension(t) for t in time.tolist()])
    speed = np.array([drive.speed(t) for t in time.tolist()])
    return preloaded.series(motion, extension, speed)
