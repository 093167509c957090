"""Rigid actuators and cranks in the engine that follow the same drive."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from support_exudyn.model.drives.drive import Drive
from user_forces.lawful import LawError


class DrivenItem(NamedTuple):
    """A joint of the engine that holds a length or an angle: its object, the parameter that it holds, what that
    is at the start [m], [rad], and its multiplier.
    """

    object: Any
    parameter: str
    start: float
    multiplier: int


@dataclass
class DrivenParts:
    """All that one drive moves.

    mbs: the engine's system. drive: of all of these. items: rigid actuators and cranks. state: extension that
    the engine has, and speed, which are those of a time [s].
    """

    mbs: Any = field(repr=False)  # which cannot be shown once it is released
    drive: Drive
    items: list[DrivenItem] = field(default_factory=list)
    state: tuple[float, float] | None = None
    time: float = math.nan

    @property
    def multipliers(self) -> tuple[int, ...]:
        """The multipliers of rigid actuators and cranks."""
        return tuple(item.multiplier for item in self.items)

    def moves(self, duration: float) -> bool:
        """Whether anything moves within this time [s]."""
        return self.drive.span(duration) != (0.0, 0.0)

    def move_to(self, t: float) -> None:
        """Let the engine have lengths and angles of time t [s], unless it has them already."""
        if t == self.time:
            return
        drive, self.time = self.drive, t
        # at the start the speed is the one just after it
        state = drive.extension(t), drive.speed(t) if t > 0.0 else drive.initial_speed
        if not math.isfinite(state[0] + state[1]):
            self.look(t)
        if state != self.state:
            self.state = state
            for item in self.items:
                self.mbs.SetObjectParameter(item.object, item.parameter, item.start + state[0])

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


def by_drive(mbs: Any, driven: Iterable[tuple[Drive, DrivenItem]]) -> Sequence[DrivenParts]:
    """All that can be driven, by the drive that it follows."""
    found: list[DrivenParts] = []
    for drive, item in driven:
        if drive not in [parts.drive for parts in found]:
            found.append(DrivenParts(mbs, drive))
        next(parts for parts in found if parts.drive == drive).items.append(item)
    return found
