"""What every load is; most are a force or a moment that follows from time and the motion of what it acts on."""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, NamedTuple

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND
from user_forces.values.units import Metres
from user_forces.values.value import Real, Value, Vector2, value


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
    """What acts on a body: `Load` is a force on a point of it, `MomentLoad` a moment.

    What it is told of the motion, `at`, is a `LoadedPoint` or a `TurnedBody`.

    Arguments:
        body: name of the body.
    """

    @abstractmethod
    def stored(self, at: Any) -> float:
        """Energy that the load has stored [J]."""

    @abstractmethod
    def powers(self, at: Any) -> Powers:
        """What moves the load does, and what is lost in it."""

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """What is recorded of it besides its energies, by name; see `observed`."""
        return {}

    def observed(self, at: Any) -> Mapping[str, float]:
        """Values of its `channels`, by name."""
        del at
        return {}

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
    """A force on a point of a body. A new one is a class with the methods below.

    The contract: `force` is continuous in time and motion, and smooth between two neighbouring `breaks` but for
    kinks; the energy `stored` changes by what `powers` say and by the work that is done on the point,

        d stored/dt = work - loss - force . velocity

    A `force` written as laws are, see `expressions.scalar`, is evaluated by the engine without Python.

    In space the force has a third part, `sideways`, which is 0 by default, and counts in the work.

    Arguments:
        body: name of the body.
        point: of the body, start posture [m].
        lateral: how far to the right of the machine's plane the point is in space [m]; negative: to the left.
            In the plane, where both sides of a machine are lumped, a load acts the same wherever it is.
    """

    point: Metres[Vector2]
    lateral: Metres[Real] = 0.0

    @abstractmethod
    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point, forward and up [N]."""

    def sideways(self, at: LoadedPoint) -> float:
        """Force on the point to the right [N], in space."""
        del at
        return 0.0

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
