"""A torsion spring and damper between two bodies."""

from collections.abc import Mapping

from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.loads.load import LoadChannel
from support_exudyn.model.loads.moment_load import MomentLoad
from user_forces.kernel import kernel
from user_forces.values.units import NewtonMetreSecondsPerRadian, NewtonMetresPerRadian, Radians
from user_forces.values.value import NonNegative, Real, value


@value
class TorsionSpring(MomentLoad):
    """A spring and a damper that act by a moment on how a body turns against another.

        M = -k (a - a0) - c da/dt

    a is the turn of the body against the other since the start posture, and M acts on the body.

    Arguments:
        body, other: see `MomentLoad`.
        stiffness: k [N m/rad], >= 0.
        free_turn: a0 at which the spring carries nothing [rad]; 0: it is slack in the start posture.
        damping: c [N m s/rad], >= 0.
    """

    stiffness: NewtonMetresPerRadian[NonNegative] = 0.0
    free_turn: Radians[Real] = 0.0
    damping: NewtonMetreSecondsPerRadian[NonNegative] = 0.0

    @model_validator(mode="after")
    def _does_something(self) -> Self:
        if self.stiffness == 0.0 and self.damping == 0.0:
            raise ValueError("stiffness = 0 N m/rad, damping = 0 N m s/rad: allowed: one of them > 0")
        return self

    @staticmethod
    @kernel
    def action(
        t: float, turn: float, spin: float, stiffness: float, free_turn: float, damping: float
    ) -> tuple[float, ...]:
        """M, the spring's k (a - a0)^2/2 and the damper's loss c (da/dt)^2; see `ActingLoad`."""
        twist = turn - free_turn
        moment = -stiffness * twist - damping * spin
        return moment, 0.5 * stiffness * twist * twist, 0.0, damping * spin * spin, moment, turn

    @property
    def channels(self) -> Mapping[str, LoadChannel]:
        """The channels are its moment and its angle."""
        return {
            "moment": LoadChannel("N m", "on the body, positive anticlockwise"),
            "angle": LoadChannel("rad", "turn of the body against the other since the start posture"),
        }

    @property
    def steepness(self) -> tuple[float]:
        """k [N m/rad]."""
        return (self.stiffness,)

    def largest(self, duration: float) -> tuple[float]:
        """Its moment in the start posture [N m]."""
        del duration
        return (self.stiffness * self.free_turn,)
