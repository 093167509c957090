"""Forces, up or down, that are spread over a straight stretch of a body."""

import math
from abc import ABC
from typing import Any, ClassVar, NamedTuple

from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.loads.load import ActingLoad
from user_forces.values.units import Metres
from user_forces.values.value import Real, Vector2, value

COINCIDE = 1e-9  # [m] up to which two points are one


class LoadedStretch(NamedTuple):
    """Both ends of a stretch: time [s], their ways up since the start posture [m], their rates [m/s]."""

    time: float
    first: float
    second: float
    first_rate: float
    second_rate: float


@value
class StretchLoad(ActingLoad, ABC):
    """Forces, up or down, over the stretch between two points of a body.

    A new one is a class with an `action`, see `ActingLoad`, or with `forces`, `stored` and `powers`.

    The body is rigid, so that forces q(s) up, at shares s of the way from the first point to the second, do as
    two forces at its ends,

        F1 = integral of (1 - s) q ds,   F2 = integral of s q ds,

    whose sum and moments are theirs. The contract is that of `Load`, with

        d stored/dt = work - loss - F1 first_rate - F2 second_rate

    Arguments:
        body: name of the body.
        points: both ends of the stretch, start posture [m].
        lateral: how far to the right of the machine's plane it is in space [m]; without effect in the plane.
    """

    MOTION: ClassVar[Any] = LoadedStretch
    FORCES: ClassVar[int] = 2
    METHODS: ClassVar[tuple[str, ...]] = ("forces", "stored", "powers", "observed")

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

    def forces(self, at: LoadedStretch) -> Vector2:
        """F1 and F2, up [N]."""
        first, second = self._acted(at)[:2]
        return first, second

    def pushes(self, at: LoadedStretch) -> tuple[float, ...]:
        """F1 and F2, up [N]."""
        return self.forces(at)

    @property
    def steepness(self) -> Vector2:
        """Largest growth of F1 and F2 with the ways of their ends, those of the other taken in [N/m]."""
        return 0.0, 0.0

    def largest(self, duration: float) -> Vector2:
        """F1 and F2 in a run of this duration [s] at their largest, if the ends stayed where they are [N]."""
        del duration
        return 0.0, 0.0
