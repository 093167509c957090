"""What every load is; most are a force or a moment that follows from time and the motion of what it acts on."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND
from user_forces.kernel import Formula, formula_of
from user_forces.values.units import Metres
from user_forces.values.value import Real, Value, Vector2, value

TimeFunction = Callable[[float], float]


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


class LoadChannel(NamedTuple):
    """A channel of a load: its unit, and what it is."""

    unit: str
    meaning: str


class Powers(NamedTuple):
    """Power of what moves a load, and of what it loses [W]."""

    work: float
    loss: float


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
    """What acts on a body: `Load` is a force on a point, `MomentLoad` a moment, `StretchLoad` spread forces.

    What a load does is one function of numbers, its `action`, which Python runs and numba compiles:

        action(*at, *values of its courses, *parameters)
            = (*forces, stored energy, power of what moves it, power that is lost, *values of its channels)

    It is a static method and a `user_forces.kernel.kernel`, in plain Python with `if` and `math`. `at` is the
    motion, a `LoadedPoint`, `TurnedBody` or `LoadedStretch`. Parameters are named as attributes of the load.
    The last one may be `*name`, for a tuple.

    A load that no function of numbers describes has methods of its own, in any Python: that of its forces,
    `stored` and `powers`. The compiled formulation does not cover it.

    Arguments:
        body: name of the body.
    """

    action: ClassVar[Callable[..., tuple[float, ...]] | None] = None
    MOTION: ClassVar[Any]  # the tuple of what a load follows
    FORCES: ClassVar[int]  # how many numbers of the action come before the stored energy
    METHODS: ClassVar[tuple[str, ...]]  # that follow from the action, unless a class has its own

    @property
    def courses(self) -> tuple[TimeFunction, ...]:
        """Functions of time [s] whose values the action takes after the motion; none by default."""
        return ()

    @cached_property
    def formula(self) -> Formula:
        """The action as a function of numbers, with this load's parameters."""
        if self.action is None:
            raise NotImplementedError(
                f"{type(self).__name__}: has no `action`; allowed without it: all of {', '.join(self.METHODS)}"
            )
        return formula_of(self, self.action, len(self.MOTION._fields) + len(self.courses))

    @cached_property
    def own_methods(self) -> tuple[str, ...]:
        """Names of the methods that the load's class has in place of its action."""
        kind: Any = next(one for one in type(self).__mro__ if "METHODS" in vars(one))
        return tuple(name for name in kind.METHODS if getattr(type(self), name) is not getattr(kind, name))

    def acts(self, at: Any) -> tuple[float, ...]:
        """What the action gives; of a load with methods of its own, the same from these."""
        if not self.own_methods:
            return self._acted(at)
        observed = self.observed(at)
        return (
            *self.pushes(at),
            self.stored(at),
            *self.powers(at),
            *(observed[name] for name in self.channels),
        )

    def _acted(self, at: Any) -> tuple[float, ...]:
        found: tuple[float, ...] = self.formula(*at, *(course(at.time) for course in self.courses))
        return found

    @abstractmethod
    def pushes(self, at: Any) -> tuple[float, ...]:
        """Its forces [N] or its moment [N m], as the action gives them."""

    def stored(self, at: Any) -> float:
        """Energy that the load has stored [J]."""
        return self._acted(at)[self.FORCES]

    def powers(self, at: Any) -> Powers:
        """What moves the load does, and what is lost in it."""
        return Powers(*self._acted(at)[self.FORCES + 1 : self.FORCES + 3])

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """What is recorded of it besides its energies, by name; see `observed`."""
        return {}

    def observed(self, at: Any) -> Mapping[str, float]:
        """Values of its `channels`, by name."""
        if self.action is None:
            return {}
        return dict(zip(self.channels, self._acted(at)[self.FORCES + 3 :], strict=True))

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
        """Largest growth of the force [N/m] or moment [N m/rad] with the motion, in each direction."""
        return ()

    def largest(self, duration: float) -> tuple[float, ...]:
        """The largest force [N] or moment [N m] in a run of this duration [s] in the start posture."""
        del duration
        return ()

    @property
    def shortest_time(self) -> float:
        """Shortest time of a course of its own [s], which steps have to follow; infinite by default."""
        return math.inf


@value
class Load(ActingLoad, ABC):
    """A force on a point of a body: forward, up, and to the right, which counts in space alone.

    A new one is a class with an `action`, see `ActingLoad`, or with `force`, `stored` and `powers`.

    The contract: the force is continuous in time and motion, and smooth between two neighbouring `breaks` but
    for kinks; the energy `stored` changes by what `powers` say and by the work that is done on the point,

        d stored/dt = work - loss - force . velocity

    Arguments:
        body: name of the body.
        point: of the body, start posture [m].
        lateral: how far to the right of the machine's plane the point is in space [m]; negative: to the left.
            In the plane, where both sides of a machine are lumped, a load acts the same wherever it is.
    """

    point: Metres[Vector2]
    lateral: Metres[Real] = 0.0

    MOTION: ClassVar[Any] = LoadedPoint
    FORCES: ClassVar[int] = 3
    METHODS: ClassVar[tuple[str, ...]] = ("force", "sideways", "stored", "powers", "observed")

    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point, forward and up [N]."""
        along, up = self._acted(at)[:2]
        return along, up

    def sideways(self, at: LoadedPoint) -> float:
        """Force on the point to the right [N], in space; 0 of a load without an action."""
        return 0.0 if self.action is None else self._acted(at)[2]

    def pushes(self, at: LoadedPoint) -> tuple[float, ...]:
        """Force on the point, forward, up and to the right [N]."""
        return (*self.force(at), self.sideways(at)) if self.own_methods else self._acted(at)[:3]

    @property
    def origin(self) -> Vector2:
        """The point of `against` that the opposite force acts on, start posture [m]; by default the same."""
        return self.point

    @property
    def origin_lateral(self) -> float:
        """How far to the right that point is [m]; by default as far as the other."""
        return self.lateral

    @property
    def steepness(self) -> Vector2:
        """Largest growth of the force with the point's way along x and y [N/m]."""
        return 0.0, 0.0

    def largest(self, duration: float) -> Vector2:
        """The largest force in a run of this duration [s] if the point stayed in its start posture [N]."""
        del duration
        return 0.0, 0.0
