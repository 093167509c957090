"""What drives and inlets do at an instant, and rigid actuators and cranks in the engine, which drives move."""

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.hydraulics.inlets import Inlet
from user_forces.lawful import LawError


class Supply(NamedTuple):
    """What a drive or an inlet gives at an instant: extension [m] and its rate [m/s], or angle; opening."""

    extension: float
    rate: float
    opening: float


def supply_at(source: Drive | Inlet, t: float, after: bool = False) -> Supply:
    """What a drive or an inlet gives at t [s], at the start just after it; after: just after a break.

    Raises LawError if that is no number.
    """
    if isinstance(source, Inlet):
        found = Supply(0.0, 0.0, source.opening(t) + (source.opening_jump(t) if after else 0.0))
    elif t > 0.0:
        speed = source.speed(t) + (source.speed_jump(t) if after else 0.0)
        found = Supply(source.extension(t), speed, 0.0)
    else:
        found = Supply(source.extension(t), source.initial_speed, 0.0)
    if not math.isfinite(sum(found)):
        raise LawError(
            f"{type(source).__name__} has an extension of {found.extension:g}, a speed of {found.rate:g}, "
            f"an opening of {found.opening:g} at {t:.9g} s"
        )
    return found


@dataclass
class DrivenPart:
    """A joint of the engine that holds a length or an angle, which a drive moves.

    mbs: the engine's system. drive: what moves it. object, parameter: of the engine, and what is set of it.
    start: length or angle at the start [m], [rad]. multiplier: its place. state: what the engine has, of a time
    [s].
    """

    mbs: Any = field(repr=False)  # which cannot be shown once it is released
    drive: Drive
    object: Any
    parameter: str
    start: float
    multiplier: int
    state: Supply | None = None
    time: float = math.nan

    def move_to(self, t: float) -> None:
        """Let the engine have the length or angle of time t [s], unless it has it already."""
        if t == self.time:
            return
        self.time, state = t, supply_at(self.drive, t)
        if state != self.state:
            self.state = state
            self.mbs.SetObjectParameter(self.object, self.parameter, self.start + state.extension)

    def speed(self, t: float) -> float:
        """Rate of the length or angle [m/s], [rad/s] at t [s]; at a jump that before it."""
        if self.state is not None and t == self.time > 0.0:  # nearly always: that is where the step ends
            return self.state.rate
        return self.drive.speed(t)
