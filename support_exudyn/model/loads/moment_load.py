"""A moment on a body that follows from time and from how the body turns against another."""

from abc import ABC
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.linkage import GROUND
from support_exudyn.model.loads.load import ActingLoad, LoadChannel, Powers
from user_forces.values.value import value


class TurnedBody(NamedTuple):
    """A body under a moment: time [s], turn since the start posture [rad], angular velocity [rad/s].

    Turn and angular velocity are against `MomentLoad.other`; anticlockwise is positive.
    """

    time: float
    turn: float
    spin: float


@value
class MomentLoad(ActingLoad, ABC):
    """A moment on a body, and the opposite one on another.

    A new one is a class with an `action`, see `ActingLoad`, or with a method `moment`. With `moment` alone it
    stores nothing, all that it does counts as work, and the moment is its only channel.

    The contract is that of `Load`, with

        d stored/dt = work - loss - moment spin

    In space it acts on the turn that the side view shows, about the lateral axis; see
    `mechanics/space/acting_loads.py`.

    Arguments:
        body: name of the body.
        other: the body that the opposite moment acts on, or "ground".
    """

    MOTION: ClassVar[Any] = TurnedBody
    FORCES: ClassVar[int] = 1
    METHODS: ClassVar[tuple[str, ...]] = ("moment", "stored", "powers", "observed")

    other: str = GROUND

    @model_validator(mode="after")
    def _acts_between_two(self) -> Self:
        check_two(self.body, self.other)
        return self

    def moment(self, at: TurnedBody) -> float:
        """Moment on the body, positive anticlockwise [N m]."""
        return self._acted(at)[0]

    def pushes(self, at: TurnedBody) -> tuple[float, ...]:
        """The moment [N m]."""
        return (self.moment(at),)

    def stored(self, at: TurnedBody) -> float:
        """Stored energy [J], 0 by default."""
        return 0.0 if self.action is None else super().stored(at)

    def powers(self, at: TurnedBody) -> Powers:
        """Power [W] of the moment, and no loss, by default."""
        return Powers(self.moment(at) * at.spin, 0.0) if self.action is None else super().powers(at)

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """The only channel is the moment by default."""
        return {"moment": LoadChannel("N m", "on the body, positive anticlockwise")}

    def observed(self, at: TurnedBody) -> Mapping[str, float]:
        """Moment [N m], by default."""
        return {"moment": self.moment(at)} if self.action is None else super().observed(at)

    def against(self, name: str) -> str:
        """The opposite moment acts on the other body."""
        del name
        return self.other

    @property
    def steepness(self) -> tuple[float]:
        """Largest growth of the moment with the turn [N m/rad]."""
        return (0.0,)

    def largest(self, duration: float) -> tuple[float]:
        """The largest moment in a run of this duration [s] if nothing turned [N m]."""
        del duration
        return (0.0,)


def check_two(body: str, other: str) -> None:
    """Raise ValueError if what acts between two bodies has the same one twice."""
    if body == other:
        raise ValueError(f"other = {other!r}: is the body itself; allowed: another body, or {GROUND!r}")
