"""What acts on linkages in files: springs, dampers, torques and forces."""

from __future__ import annotations

from dataclasses import replace

from support_exudyn.model.linkage import GROUND
from support_exudyn.model.loads.applied import AppliedForce, AppliedTorque, ComingOn
from support_exudyn.model.loads.springs import SpringDamper, TorsionSpring
from user_forces.values.units import (
    Metres,
    NewtonMetres,
    NewtonMetreSecondsPerRadian,
    NewtonMetresPerRadian,
    Newtons,
    NewtonSecondsPerMetre,
    NewtonsPerMetre,
    Radians,
)
from user_forces.values.value import NonNegative, Real, Value, Vector2, value


@value
class LinkageSpringData(Value):
    """A spring and a damper side by side between points of two bodies.

    Arguments:
        bodies: that it joins, one of them may be "ground".
        at: its points on them.
        stiffness: [N/m], >= 0.
        free_length: at which the spring carries nothing [m]; that of the start posture if nothing is said.
        damping: [N s/m], >= 0.
    """

    bodies: tuple[str, str]
    at: tuple[str, str]
    stiffness: NewtonsPerMetre[NonNegative] = 0.0
    free_length: Metres[NonNegative] | None = None
    damping: NewtonSecondsPerMetre[NonNegative] = 0.0

    def load(self, first: Vector2, second: Vector2) -> SpringDamper:
        """The spring between two places of the start posture [m]."""
        ends = [(self.bodies[0], first), (self.bodies[1], second)]
        (other, other_point), (body, point) = reversed(ends) if self.bodies[1] == GROUND else ends
        spring = SpringDamper(
            body=body,
            point=point,
            other=other,
            other_point=other_point,
            stiffness=self.stiffness,
            free_length=self.free_length or 0.0,
            damping=self.damping,
        )
        return spring if self.free_length is not None else replace(spring, free_length=spring.start_length)


@value
class LinkageTorsionData(Value):
    """A torsion spring and damper between two bodies.

    Arguments:
        bodies: that it joins, one of them may be "ground".
        stiffness: [N m/rad], >= 0.
        free_turn: of the second body against the first from the start posture on, at which it carries nothing
            [rad].
        damping: [N m s/rad], >= 0.
    """

    bodies: tuple[str, str]
    stiffness: NewtonMetresPerRadian[NonNegative] = 0.0
    free_turn: Radians[Real] = 0.0
    damping: NewtonMetreSecondsPerRadian[NonNegative] = 0.0

    def load(self) -> TorsionSpring:
        """The spring."""
        first, second = self.bodies
        free_turn = self.free_turn
        if second == GROUND:  # the turn of the body against it is the opposite
            first, second, free_turn = second, first, -free_turn
        return TorsionSpring(
            body=second, other=first, stiffness=self.stiffness, free_turn=free_turn, damping=self.damping
        )


@value
class LinkageTorqueData(ComingOn):
    """A torque on a body.

    Arguments: those of `ComingOn`, and

        body: on which it acts.
        against: the body on which the opposite acts, or "ground".
        torque: in the end, positive anticlockwise [N m].
    """

    body: str
    against: str = GROUND
    torque: NewtonMetres[Real]

    def load(self) -> AppliedTorque:
        """The torque."""
        return AppliedTorque(
            body=self.body,
            other=self.against,
            full_torque=self.torque,
            start=self.start,
            end=self.end,
            course=self.course,
        )


@value
class LinkageForceData(ComingOn):
    """A force on a point of a body, which keeps its direction.

    Arguments: those of `ComingOn`, and

        body: on which it acts.
        at: the point of it.
        force: in the end, to the right and up [N].
    """

    body: str
    at: str
    force: Newtons[Vector2]

    def load(self, point: Vector2) -> AppliedForce:
        """The force at a place of the start posture [m]."""
        return AppliedForce(
            body=self.body,
            point=point,
            full_force=self.force,
            start=self.start,
            end=self.end,
            course=self.course,
        )
