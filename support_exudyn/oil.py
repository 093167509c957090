"""Columns of oil: what they carry at the start, and their force, energy and power; see `columns.OilColumn`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from support_exudyn.body_motion import BodyMotion
from support_exudyn.columns import OilColumn
from support_exudyn.drives import Drive
from support_exudyn.kinetics import Kinetics
from support_exudyn.machine import Column, Linkage
from support_exudyn.scene_items import BodyItem
from support_exudyn.trajectory import Series
from user_forces.values import Vector2


@dataclass(frozen=True)
class FilledColumn:
    """A column of oil in its place, and by how much its oil is compressed at the start [m]."""

    column: Column
    model: OilColumn
    precompression: float

    def natural_length(self, extension: float) -> float:
        """Length [m] at which the oil carries nothing."""
        return self.column.start_length + self.precompression + extension

    def powers(self, length: float, rate: float, extension: float, speed: float) -> tuple[float, float]:
        """Power of the drive that lets oil in, and of the damping [W].

            drive = F speed + (dk/dextension) speed u^2 / 2,   damping = k T (du/dt)^2

        The second term of the drive is what the oil gives back because there is more of it to be compressed.
        """
        stiffness = self.model.stiffness(extension)
        compression = self.natural_length(extension) - length
        closing = speed - rate
        force = stiffness * (compression + self.model.damping_time * closing)
        drive = force * speed + 0.5 * self.model.stiffness_slope(extension) * speed * compression**2
        return drive, stiffness * self.model.damping_time * closing**2


class OilSeries(NamedTuple):
    """Force that pushes the ends apart [N] and energy stored in the oil [J] over time, shape (n,)."""

    force: Series
    energy: Series


def fill(linkage: Linkage, models: Mapping[str, OilColumn], gravity: Vector2) -> dict[str, FilledColumn]:
    """Columns of oil that hold the machine in its start posture, all pins ideal and the others rigid."""
    if not models:
        return {}
    bodies = {name: BodyItem(body, None, None, 3 * n) for n, (name, body) in enumerate(linkage.bodies.items())}
    closed = Kinetics(linkage, bodies, tuple(linkage.pins), tuple(linkage.columns))
    position = np.zeros(3 * len(bodies))
    weight = np.concatenate([[b.mass * gravity[0], b.mass * gravity[1], 0.0] for b in linkage.bodies.values()])
    tensions = closed.respond(position, weight, 0.0)[1][closed.driven()]
    loads = {name: -float(tension) for name, tension in zip(linkage.columns, tensions, strict=False)}
    return {
        name: FilledColumn(linkage.columns[name], model, loads[name] / model.stiffness(0.0))
        for name, model in models.items()
    }


def oil_series(filled: FilledColumn, motion: BodyMotion, drive: Drive, time: Series) -> OilSeries:
    """Force and energy of a column over time."""
    column = filled.column
    foot = motion.point(column.foot, column.foot_point)
    head = motion.point(column.head, column.head_point)
    apart, relative = head.position - foot.position, head.velocity - foot.velocity
    length = np.hypot(*apart.T)
    rate = (apart * relative).sum(axis=1) / length
    extension = np.array([drive.extension(t) for t in time.tolist()])
    speed = np.array([drive.speed(t) for t in time.tolist()])
    stiffness = np.array([filled.model.stiffness(e) for e in extension.tolist()])
    compression = np.array([filled.natural_length(e) for e in extension.tolist()]) - length
    force = stiffness * (compression + filled.model.damping_time * (speed - rate))
    return OilSeries(force, 0.5 * stiffness * compression**2)
