"""Rigid actuators and cranks in the engine that follow drives."""

import math
from dataclasses import dataclass, field
from typing import Any

from support_exudyn.model.drives.drive import Drive
from user_forces.lawful import LawError


@dataclass
class DrivenPart:
    """A joint of the engine that holds a length or an angle, which a drive moves.

    mbs: the engine's system. drive: what moves it. object, parameter: of the engine, and what is set of it.
    start: length or angle at the start [m], [rad]. multiplier: its place. state: extension that the engine has,
    and speed, which are those of a time [s].
    """

    mbs: Any = field(repr=False)  # which cannot be shown once it is released
    drive: Drive
    object: Any
    parameter: str
    start: float
    multiplier: int
    state: tuple[float, float] | None = None
    time: float = math.nan

    def move_to(self, t: float) -> None:
        """Let the engine have the length or angle of time t [s], unless it has it already."""
        if t == self.time:
            return
        drive, self.time = self.drive, t
        # at the start the speed is the one just after it
        state = drive.extension(t), drive.speed(t) if t > 0.0 else drive.initial_speed
        if not math.isfinite(state[0] + state[1]):
            self.look(t)
        if state != self.state:
            self.state = state
            self.mbs.SetObjectParameter(self.object, self.parameter, self.start + state[0])

    def at(self, t: float) -> tuple[float, float]:
        """Extension and speed at t [s]; at a jump the speed before it."""
        if self.state is not None and t == self.time > 0.0:  # nearly always: that is where the step ends
            return self.state
        return self.drive.extension(t), self.drive.speed(t)

    def look(self, t: float) -> None:
        """Raise LawError if the drive has no finite extension and speed at t [s]."""
        extension, speed = self.drive.extension(t), self.drive.speed(t)
        if not math.isfinite(extension + speed):
            raise LawError(
                f"{type(self.drive).__name__} has an extension of {extension:g} and a speed of {speed:g} at "
                f"{t:.9g} s"
            )
