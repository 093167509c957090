"""What is kept of a run: states at the records, and integrals over all steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np

from support_exudyn.energy import RunningIntegrals
from support_exudyn.oil import oil_powers
from support_exudyn.scene import Scene
from support_exudyn.scene_items import OilColumnItem


@dataclass(frozen=True)
class History:
    """Raw states at the records, one row each; see `channels` for what they mean.

    time (n,); position, velocity, acceleration (n, coordinates); multiplier (n, constraints);
    memory (n, data coordinates); work, damping_loss, friction_loss (n,) [J].
    """

    time: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    multiplier: np.ndarray
    memory: np.ndarray
    work: np.ndarray
    damping_loss: np.ndarray
    friction_loss: np.ndarray


class Recorder:
    """Collects a History while a run goes on."""

    def __init__(self, scene: Scene) -> None:
        self.energies = RunningIntegrals(3)  # work of the drive, losses by damping and by friction
        self._data = scene.mbs.systemData
        self._pins = tuple(scene.loose_pins.values())
        self._driven = tuple(column.multiplier for column in scene.rigid_columns.values()) + tuple(
            crank.multiplier for crank in scene.cranks.values()
        )
        self._oil = tuple(scene.oil_columns.values())
        self._mbs = scene.mbs
        self._speed = scene.scenario.drive.speed
        self._extension = scene.scenario.drive.extension
        self._rows: list[tuple[Any, ...]] = []

    def after_step(self, t: float, kink: bool) -> None:
        """Add a step that has been accepted; `kink`: an impact or a break of the drive lies at its end."""
        self.energies.add(t, self._powers(t))
        if kink:
            self.energies.restart()

    def jump(self, t: float, energy: float) -> None:
        """The columns' speed has jumped at t [s], which gave the bodies this energy [J]."""
        self.energies.totals[0] += energy
        self.energies.jump(t)

    def record(self, t: float) -> None:
        """Keep the state at time t [s]."""
        data = self._data
        self._rows.append(
            (
                t,
                data.GetODE2Coordinates(),
                data.GetODE2Coordinates_t(),
                data.GetODE2Coordinates_tt(),
                data.GetAECoordinates(),
                data.GetDataCoordinates(),
                *self.energies.totals,
            )
        )

    def _length(self, item: OilColumnItem) -> tuple[float, float]:
        """Length [m] of an oil column and its rate [m/s]."""
        output = exudyn.OutputVariableType
        distance = float(self._mbs.GetObjectOutput(item.object, output.Distance))
        apart = self._mbs.GetObjectOutput(item.object, output.Displacement)
        rate = self._mbs.GetObjectOutput(item.object, output.Velocity)
        return distance, float(apart @ rate) / distance

    def history(self) -> History:
        """What has been recorded so far."""
        return History(*(np.array(column) for column in zip(*self._rows, strict=True)))

    def _powers(self, t: float) -> tuple[float, float, float]:
        """Power [W] of the drive, of damping and of friction at the end of a step."""
        columns = damping = friction = 0.0
        speed = self._speed(t)
        if speed != 0.0 and self._driven:
            multipliers = self._data.GetAECoordinates()
            # the multiplier of a distance is the tension, that of a crank's angle the moment against it
            columns = -speed * sum(float(multipliers[n]) for n in self._driven)
        for item in self._oil:
            work, loss = oil_powers(item, *self._length(item), self._extension(t), speed)
            columns += work
            damping += loss
        for pin in self._pins:
            force = pin.force
            if force.depth > 0.0:
                elastic = pin.contact.normal.elastic_force(force.depth) if pin.memory.in_contact else 0.0
                damping += (force.normal_force - elastic) * force.rate
                friction -= force.friction_force * force.slip
        return columns, damping, friction
