"""A linear bushing in place of a pin: a force between two points and a moment between two bodies."""

import math
from collections.abc import Mapping
from typing import ClassVar

from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.linkage import PinPlace
from support_exudyn.model.loads.load import ActingLoad, LinkLoad, LoadChannel
from support_exudyn.model.loads.springs import TorsionSpring
from support_exudyn.model.pins import CompliantPin
from user_forces.kernel import kernel
from user_forces.values.units import (
    NewtonMetreSecondsPerRadian,
    NewtonMetresPerRadian,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
)
from user_forces.values.value import NonNegative, Positive, Vector2, value


@value
class _BushingForce(LinkLoad):
    """The force of a linear bushing on its second body; d: way of that body's point against the first's.

        F = -(stiffness d + damping d')

    Arguments:
        body, point: the second body and its point. other, other_point: the first, see `LinkLoad`.
        stiffness: forward and up [N/m]. damping: forward and up [N s/m].
    """

    stiffness: NewtonsPerMetre[Vector2]
    damping: NewtonSecondsPerMetre[Vector2]

    @property
    def coefficients(self) -> tuple[float, ...]:
        """Stiffnesses, then dampings."""
        return (*self.stiffness, *self.damping)

    @staticmethod
    @kernel
    def action(
        t: float, x: float, y: float, vx: float, vy: float, z: float, vz: float, *coefficients: float
    ) -> tuple[float, ...]:
        """The force, energy of the springs and loss of the dampers; see `ActingLoad`."""
        kx, ky, cx, cy = coefficients
        fx, fy = -kx * x - cx * vx, -ky * y - cy * vy
        stored, loss = 0.5 * (kx * x * x + ky * y * y), cx * vx * vx + cy * vy * vy
        return fx, fy, 0.0, stored, 0.0, loss, math.hypot(fx, fy), fx, fy, math.hypot(x, y), x, y

    channels: ClassVar[Mapping[str, LoadChannel]] = {
        "force": LoadChannel("N", "magnitude of the pin force"),
        "force_x": LoadChannel("N", "force of the first body on the second, forward"),
        "force_y": LoadChannel("N", "force of the first body on the second, up"),
        "deflection": LoadChannel("m", "distance of both bodies' points"),
        "deflection_x": LoadChannel("m", "second body's point from the first's, forward"),
        "deflection_y": LoadChannel("m", "second body's point from the first's, up"),
    }

    @property
    def steepness(self) -> tuple[float, ...]:
        """Stiffness forward and up [N/m]."""
        return (*self.stiffness, 0.0)


@value
class _BushingMoment(TorsionSpring):
    """The moment of a bushing on its second body, by the turn against the first; it may be none."""

    @model_validator(mode="after")
    def _does_something(self) -> Self:
        return self


@value
class BushingPin(CompliantPin):
    """A linear bushing, as of rubber: force and moment follow from how the two bodies have moved at the pin.

    With d from the first body's point to the second's, in the axes of the ground, and a the turn of the second
    body against the first since the start, on the second body act

        F = -(stiffness d + damping d'),    M = -(rotational_stiffness a + rotational_damping a')

    at its point, and on the first at its own the opposite. In the plane.

    Arguments:
        stiffness: forward and up [N/m], > 0.
        damping: forward and up [N s/m], >= 0.
        rotational_stiffness: [N m/rad], >= 0.
        rotational_damping: [N m s/rad], >= 0.
    """

    stiffness: NewtonsPerMetre[tuple[Positive, Positive]]
    damping: NewtonSecondsPerMetre[tuple[NonNegative, NonNegative]] = (0.0, 0.0)
    rotational_stiffness: NewtonMetresPerRadian[NonNegative] = 0.0
    rotational_damping: NewtonMetreSecondsPerRadian[NonNegative] = 0.0

    def loads(self, place: PinPlace) -> Mapping[str, ActingLoad]:
        """A force between both points and a moment between both bodies."""
        return {
            "force": _BushingForce(
                body=place.second,
                point=place.second_point,
                other=place.first,
                other_point=place.first_point,
                stiffness=self.stiffness,
                damping=self.damping,
            ),
            "moment": _BushingMoment(
                body=place.second,
                other=place.first,
                stiffness=self.rotational_stiffness,
                damping=self.rotational_damping,
            ),
        }
