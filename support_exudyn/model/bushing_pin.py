"""A linear bushing in place of a pin: springs and dampers in two directions and about the axis."""

from support_exudyn.model.pins import Pin, Refusal
from user_forces.values.units import (
    NewtonMetreSecondsPerRadian,
    NewtonMetresPerRadian,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
)
from user_forces.values.value import NonNegative, Positive, value


@value
class BushingPin(Pin):
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

    @property
    def holds(self) -> bool:
        """A bushing gives way."""
        return False

    @property
    def steepness(self) -> tuple[float, float, float]:
        """Stiffness against shifts forward and up [N/m] and against turning [N m/rad]."""
        return (*self.stiffness, self.rotational_stiffness)

    def refused_in_space(self) -> Refusal | None:
        """A bushing is of the plane alone."""
        return Refusal("", "BushingPin", "IdealPin, ClearancePin")

    def losses(self) -> dict[str, object]:
        """A bushing loses energy by damping."""
        return {"damping_loss": self}
