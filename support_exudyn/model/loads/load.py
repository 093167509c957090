"""Loads: functions of time and of the motion of what they act on, of three strain kinds.

| kind | strain | force |
|---|---|---|
| `Load` | way of a point against another | a force on the point, and the opposite one on the other |
| `MomentLoad` | turn of a body against another | a moment on the body, and the opposite one on the other |
| `StretchLoad` | ways up of both ends of a stretch of a body | forces up that are spread over the stretch |
"""

from __future__ import annotations

import math
from abc import ABC
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND
from user_forces.kernel import Formula, formula_of
from user_forces.values.units import Metres
from user_forces.values.value import Real, Value, Vector2, value

TimeFunction = Callable[[float], float]
COINCIDE = 1e-9  # [m] up to which two points are one


class LoadedPoint(NamedTuple):
    """The point that a load acts on: time [s], way [m], velocity [m/s]; y is up, z to the right.

    Way and velocity are seen from `Load.origin` on `Load.against`: if that lies at the point in the start
    posture, the way is the point's since then. In the plane z and vz are 0.
    """

    time: float
    x: float
    y: float
    vx: float
    vy: float
    z: float = 0.0
    vz: float = 0.0


class TurnedBody(NamedTuple):
    """A body under a moment: time [s], turn since the start posture [rad], angular velocity [rad/s].

    Turn and angular velocity are against `MomentLoad.other`; anticlockwise is positive.
    """

    time: float
    turn: float
    spin: float


class LoadedStretch(NamedTuple):
    """Both ends of a stretch: time [s], their ways up since the start posture [m], their rates [m/s]."""

    time: float
    first: float
    second: float
    first_rate: float
    second_rate: float


class LoadChannel(NamedTuple):
    """A channel of a load: its unit, and what it is."""

    unit: str
    meaning: str


@value
class AnyLoad(Value, ABC):
    """What is put on a machine besides its weight.

    Arguments:
        body: name of the body that it acts on.
    """

    body: str

    def against(self, name: str) -> str:
        """The body that the opposite acts on, if the load has this name: the ground by default."""
        del name
        return GROUND


@value
class ActingLoad(AnyLoad, ABC):
    """What acts on a body by a function of numbers, its `action`; see the module for the strain kinds.

        action(*at, *values of its courses, *parameters)
            = (*forces, stored energy, power of what moves it, power that is lost, *values of its channels)

    It is a static method and a `user_forces.kernel.kernel`, in plain Python with `if` and `math`, which Python
    runs and numba compiles. `at` is the motion, a `LoadedPoint`, `TurnedBody` or `LoadedStretch`. Parameters
    are named as attributes of the load; the last one may be `*name`, for a tuple.

    The contract: the force is continuous in time and motion, and smooth between two neighbouring `breaks` but
    for kinks; the stored energy changes by the powers and by the work that is done on the bodies,

        d stored/dt = work - loss - force . rate of the strain

    An action that numba cannot compile runs in the Exudyn formulation only.

    Arguments:
        body: name of the body.
    """

    action: ClassVar[Callable[..., tuple[float, ...]]]
    MOTION: ClassVar[Any]  # the tuple of what a load follows
    RATES: ClassVar[tuple[str, ...]]  # those fields of it that are rates of the strain
    FORCES: ClassVar[int]  # how many numbers of the action come before the stored energy
    # what is recorded of it besides its energies, by name; the action gives the values last
    channels: ClassVar[Mapping[str, LoadChannel]] = {}

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """Functions of time [s] whose values the action takes after the motion; none by default."""
        return ()

    @cached_property
    def formula(self) -> Formula:
        """The action as a function of numbers, with this load's parameters.

        Raises TypeError if the class has no action.
        """
        if not hasattr(type(self), "action"):
            raise TypeError(f"{type(self).__name__}: has no `action`; see `ActingLoad`")
        return formula_of(self, type(self).action, len(self.MOTION._fields) + len(self.courses))

    def numbers(self, at: Any) -> tuple[float, ...]:
        """What the action gives for a motion."""
        found: tuple[float, ...] = self.formula(*at, *(course(at.time) for course in self.courses))
        return found

    @property
    def drives(self) -> tuple[Drive, ...]:
        """What moves it; none by default."""
        return ()

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times [s] at which a derivative by time jumps, and on which the solver lands."""
        return tuple(sorted({t for drive in self.drives for t in drive.breaks}))

    @property
    def steepness(self) -> tuple[float, ...]:
        """Largest growth of each force with its strain [N/m], [N m/rad], which steps follow; 0 by default."""
        return (0.0,) * self.FORCES

    @property
    def shortest_time(self) -> float:
        """Shortest time of a course of its own [s], which steps have to follow; infinite by default."""
        return math.inf


@value
class Load(ActingLoad, ABC):
    """A force on a point of a body: forward, up, and to the right, which counts in space alone.

    Arguments:
        body: name of the body.
        point: of the body, start posture [m].
        lateral: how far to the right of the machine's plane the point is in space [m]; negative: to the left.
            In the plane, where both sides of a machine are lumped, a load acts the same wherever it is.
    """

    point: Metres[Vector2]
    lateral: Metres[Real] = 0.0

    MOTION: ClassVar[Any] = LoadedPoint
    RATES: ClassVar[tuple[str, ...]] = ("vx", "vy", "vz")
    FORCES: ClassVar[int] = 3

    @property
    def origin(self) -> Vector2:
        """The point of `against` that the opposite force acts on, start posture [m]; by default the same."""
        return self.point

    @property
    def origin_lateral(self) -> float:
        """How far to the right that point is [m]; by default as far as the other."""
        return self.lateral


@value
class LinkLoad(Load, ABC):
    """A force on a point of a body, and the opposite one on a point of another.

    Arguments:
        body, point: one end, see `Load`.
        other, other_point: the other end: name of another body, or "ground", and its point, start posture [m].
        other_lateral: how far to the right of the machine's plane the other end is in space [m].
    """

    other: str = GROUND
    other_point: Metres[Vector2]
    other_lateral: Metres[Real] = 0.0

    @model_validator(mode="after")
    def _acts_between_two(self) -> Self:
        check_two(self.body, self.other)
        return self

    def against(self, name: str) -> str:
        """The opposite force acts on the other body."""
        del name
        return self.other

    @property
    def origin(self) -> Vector2:
        """The opposite force acts at the other end."""
        return self.other_point

    @property
    def origin_lateral(self) -> float:
        """How far to the right the other end is [m]."""
        return self.other_lateral


@value
class MomentLoad(ActingLoad, ABC):
    """A moment on a body, and the opposite one on another.

    In space it acts on the turn that the side view shows, about the lateral axis; see
    `mechanics/acting_loads.py`.

    Arguments:
        body: name of the body.
        other: the body that the opposite moment acts on, or "ground".
    """

    MOTION: ClassVar[Any] = TurnedBody
    RATES: ClassVar[tuple[str, ...]] = ("spin",)
    FORCES: ClassVar[int] = 1

    other: str = GROUND

    @model_validator(mode="after")
    def _acts_between_two(self) -> Self:
        check_two(self.body, self.other)
        return self

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "moment": LoadChannel("N m", "on the body, positive anticlockwise")
    }

    def against(self, name: str) -> str:
        """The opposite moment acts on the other body."""
        del name
        return self.other


@value
class StretchLoad(ActingLoad, ABC):
    """Forces, up or down, over the stretch between two points of a body.

    The body is rigid, so that forces q(s) up, at shares s of the way from the first point to the second, do as
    two forces at its ends,

        F1 = integral of (1 - s) q ds,   F2 = integral of s q ds,

    whose sum and moments are theirs.

    Arguments:
        body: name of the body.
        points: both ends of the stretch, start posture [m].
        lateral: how far to the right of the machine's plane it is in space [m]; without effect in the plane.
    """

    MOTION: ClassVar[Any] = LoadedStretch
    RATES: ClassVar[tuple[str, ...]] = ("first_rate", "second_rate")
    FORCES: ClassVar[int] = 2

    points: Metres[tuple[Vector2, Vector2]]
    lateral: Metres[Real] = 0.0

    @model_validator(mode="after")
    def _has_a_length(self) -> Self:
        if self.length <= COINCIDE:
            raise ValueError(f"points = {self.points} m: allowed: two that are > {COINCIDE:g} m apart")
        return self

    @property
    def length(self) -> float:
        """Length of the stretch [m]."""
        return math.dist(*self.points)


def check_two(body: str, other: str) -> None:
    """Raise ValueError if what acts between two bodies has the same one twice."""
    if body == other:
        raise ValueError(f"other = {other!r}: is the body itself; allowed: another body, or {GROUND!r}")
