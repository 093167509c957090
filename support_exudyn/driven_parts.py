"""Columns and cranks in the engine that follow the same drive."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from support_exudyn.drives import Drive
from support_exudyn.oil import FilledColumn
from support_exudyn.scene_items import ColumnItem, CrankItem


@dataclass(frozen=True)
class OilColumnItem:
    """A column of oil in the engine."""

    filled: FilledColumn
    object: Any


@dataclass
class DrivenParts:
    """All that one drive moves.

    mbs: the engine's system. drive: of all of these. rigid, oil, cranks: in the engine. velocity_level: whether
    cranks follow the drive's speed instead of its angle. state: extension and speed that the engine has.
    """

    mbs: Any
    drive: Drive
    rigid: tuple[ColumnItem, ...]
    oil: tuple[OilColumnItem, ...]
    cranks: tuple[CrankItem, ...]
    velocity_level: bool = False
    state: tuple[float, float] | None = None

    @property
    def multipliers(self) -> tuple[int, ...]:
        """Of rigid columns and cranks."""
        return (*(item.multiplier for item in self.rigid), *(item.multiplier for item in self.cranks))

    def moves(self, duration: float) -> bool:
        """Whether anything moves within this time [s]."""
        return self.drive.span(duration) != (0.0, 0.0)

    def move_to(self, t: float) -> None:
        """Let the engine have lengths and angles of time t [s], unless it has them already."""
        drive = self.drive
        # at the start the speed is the one just after it
        state = drive.extension(t), drive.speed(t) if t > 0.0 else drive.initial_speed
        if state != self.state:
            self.state = state
            self._set(*state)

    def follow_speed(self) -> None:
        """Let cranks follow the speed from now on."""
        self.velocity_level = True
        for crank in self.cranks:
            self.mbs.SetObjectParameter(crank.object, "velocityLevel", True)
        if self.state is not None:
            self._set(*self.state)

    def _set(self, extension: float, speed: float) -> None:
        put = self.mbs.SetObjectParameter
        for rigid in self.rigid:
            put(rigid.object, "distance", rigid.column.start_length + extension)
        for oil in self.oil:
            stiffness = oil.filled.model.stiffness(extension)
            put(oil.object, "referenceLength", oil.filled.natural_length(extension))
            put(oil.object, "velocityOffset", speed)
            put(oil.object, "stiffness", stiffness)
            put(oil.object, "damping", stiffness * oil.filled.model.damping_time)
        for crank in self.cranks:
            put(crank.object, "offset", speed if self.velocity_level else extension)
