"""What every load is: a force on a point of a body that follows from time and the point's motion."""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import NamedTuple

from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND, Linkage
from user_forces.values.units import Metres
from user_forces.values.value import Value, Vector2, value


class LoadedPoint(NamedTuple):
    """The point that a load acts on: time [s], way since the start posture [m], velocity [m/s]; y is up.

    Way and velocity are seen from the place of `Load.against` that lay at the point in the start posture.
    """

    time: float
    x: float
    y: float
    vx: float
    vy: float


class LoadChannel(NamedTuple):
    """A channel of a load: its unit, and what it is."""

    unit: str
    meaning: str


class Powers(NamedTuple):
    """Power of what moves a load, and of what it loses [W]."""

    work: float
    loss: float


@value
class Load(Value, ABC):
    """A force on a point of a body. A new one is a class with the methods below.

    The contract: `force` is continuous in time and motion, and smooth between two neighbouring `breaks` but for
    kinks; the energy `stored` changes by what `powers` say and by the work that is done on the point,

        d stored/dt = work - loss - force . velocity

    A `force` written as laws are, see `expressions.scalar`, is evaluated by the engine without Python.

    Arguments:
        body: name of the body.
        point: of the body, start posture [m].
    """

    body: str
    point: Metres[Vector2]

    @abstractmethod
    def force(self, at: LoadedPoint) -> Vector2:
        """Force on the point, forward and up [N]."""

    @abstractmethod
    def stored(self, at: LoadedPoint) -> float:
        """Energy that the load has stored [J]."""

    @abstractmethod
    def powers(self, at: LoadedPoint) -> Powers:
        """What moves the load does, and what is lost in it."""

    def joined(self, linkage: Linkage, name: str) -> Linkage:
        """The linkage with the bodies that the load of this name brings along; none by default."""
        del name
        return linkage

    def check(self, gravity: Vector2) -> None:
        """Raise InputError if it does not go with this gravity [m/s^2]; any does by default."""
        del gravity

    def against(self, name: str) -> str:
        """The body that the opposite force acts on, if the load has this name: the ground by default."""
        del name
        return GROUND

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """What is recorded of it besides its energies, by name; see `observed`."""
        return {}

    def observed(self, at: LoadedPoint) -> Mapping[str, float]:
        """Values of its `channels`, by name."""
        del at
        return {}

    @property
    def drives(self) -> tuple[Drive, ...]:
        """What moves it; none by default."""
        return ()

    @property
    def breaks(self) -> tuple[float, ...]:
        """Times [s] at which a derivative of the force by time jumps, and on which the solver lands."""
        return tuple(sorted({t for drive in self.drives for t in drive.breaks}))

    @property
    def steepness(self) -> Vector2:
        """Largest growth of the force with the point's way along x and y [N/m]."""
        return 0.0, 0.0

    @property
    def impacts_machine(self) -> bool:
        """Whether it strikes the machine, so that steps have to be shortened in time: see `longest_step`."""
        return False

    def longest_step(self, at: LoadedPoint, number: int) -> float:
        """Longest next step [s] if an impact is to take so many steps; infinite by default."""
        del at, number
        return math.inf

    def largest(self, duration: float) -> Vector2:
        """The largest force in a run of this duration [s] if the point stayed in its start posture [N]."""
        del duration
        return 0.0, 0.0
