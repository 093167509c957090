"""Rigid actuators and cranks in the engine that follow the same drive."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from support_exudyn.model.drives.drive import Drive
from user_forces.lawful import LawError

Item = TypeVar("Item")


@dataclass(frozen=True)
class HeldItem:
    """What constraints of the engine hold: a pin, guide, crank or actuator, its object and first multiplier."""

    part: Any
    object: Any
    first: int


@dataclass
class DrivenParts:
    """All that one drive moves.

    mbs: the engine's system. drive: of all of these. rigid, cranks: in the engine. state: extension that
    the engine has, and speed, which are those of a time [s].
    """

    mbs: Any
    drive: Drive
    rigid: tuple[HeldItem, ...]
    cranks: tuple[HeldItem, ...]
    state: tuple[float, float] | None = None
    time: float = math.nan

    @property
    def multipliers(self) -> tuple[int, ...]:
        """The multipliers of rigid actuators and cranks."""
        return tuple(item.first for item in (*self.rigid, *self.cranks))

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
            self._set(state[0])

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

    def _set(self, extension: float) -> None:
        put = self.mbs.SetObjectParameter
        for rigid in self.rigid:
            put(rigid.object, "distance", rigid.part.start_length + extension)
        for crank in self.cranks:
            put(crank.object, "offset", extension)


def by_drive(
    mbs: Any,
    drive_of: Callable[[str], Drive],
    rigid: Mapping[str, HeldItem],
    cranks: Mapping[str, HeldItem],
) -> tuple[DrivenParts, ...]:
    """All that can be driven, by the drive that it follows; drive_of: gives that of a name."""
    drives: list[Drive] = []
    for name in (*rigid, *cranks):
        if (drive := drive_of(name)) not in drives:
            drives.append(drive)

    def of(drive: Drive, items: Mapping[str, Item]) -> tuple[Item, ...]:
        return tuple(item for name, item in items.items() if drive_of(name) == drive)

    return tuple(DrivenParts(mbs, one, of(one, rigid), of(one, cranks)) for one in drives)
