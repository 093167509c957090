"""Geometry, normal law and friction law together: force of a bore on its journal, or of a wall on a corner."""

from __future__ import annotations

from abc import ABC
from dataclasses import replace
from typing import NamedTuple

from pydantic import model_validator

from user_forces.expressions.scalar import is_number, maximum, where
from user_forces.face import Face
from user_forces.friction.frictionless import Frictionless
from user_forces.friction.law import FrictionLaw
from user_forces.journal import SMALLEST as SMALLEST
from user_forces.journal import ContactGeometry, JournalBearing
from user_forces.normal.law import NormalLaw
from user_forces.slot import Slot
from user_forces.values.value import Value, value

SHALLOWEST = 1e-30  # depth [m] with which a law is evaluated where there is no contact


class ContactForce(NamedTuple):
    """State of a journal in its bore and the force of the bore on the journal.

    x and y are the axes in which the displacement was given.
    """

    depth: float  # [m], negative: gap
    rate: float  # of depth [m/s]
    slip: float  # of the journal's surface on the bore's, along t [m/s]
    normal_force: float  # [N] >= 0, along -n
    friction_force: float  # [N], along t
    force_x: float  # [N]
    force_y: float  # [N]
    journal_arm: float  # of the contact point from the journal's centre, along n [m]
    clamped: bool  # the law asked for tension, which was cut to zero
    deflection: float  # state of the friction law, 0 if it has none [m]

    @property
    def journal_moment(self) -> float:
        """Moment [N m] of the force about the journal's centre."""
        return self.journal_arm * self.friction_force


class SlipHistory(NamedTuple):
    """What a friction law with a state needs of the step that is being made.

    deflection: at its start [m]. slip: at its start [m/s]. step: its length [s].
    """

    deflection: float
    slip: float
    step: float


AT_REST = SlipHistory(0.0, 0.0, 0.0)


class Contact(Value, ABC):
    """Contact of a journal in what encloses it: geometry, normal law and friction law."""

    bearing: ContactGeometry
    normal: NormalLaw
    friction: FrictionLaw

    def force(
        self,
        x: float,
        y: float,
        vx: float,
        vy: float,
        bore_spin: float,
        journal_spin: float,
        impact_velocity: float | None,
        history: SlipHistory = AT_REST,
    ) -> ContactForce:
        """Force of the bore on the journal. Takes floats or expressions (`user_forces.expressions.scalar`).

        Arguments:
            x, y: journal's centre minus bore's centre [m], in any axes; of a slot 0 and the distance from the
                middle line, of a face 0 and that from the line in front of it.
            vx, vy: velocity of the journal's centre minus that of the bore's centre [m/s], same axes;
                the plain difference, not the rate seen by an observer who turns with the bore. Of a slot along
                and across: the plain difference from any point of the middle line, less along y what the
                slot's turning moves the walls across at the place of the corner.
            bore_spin, journal_spin: angular velocities of both bodies [rad/s].
            impact_velocity: of the present contact [m/s], see `NormalLaw`; None while the surfaces are apart,
                and then there is no force whatever the depth.
            history: for friction laws with a state, the step whose end this is.

        Returns:
            ContactForce. The force acts at one point of space on both bodies, so linear and angular
            momentum are conserved: on the journal `journal_arm` from its centre along n, which is
            `journal_arm` plus the eccentricity from the bore's. From the middle every way leads outwards:
            there the rate is the speed.
        """
        bearing = self.bearing
        eccentricity, nx, ny = bearing.outwards(x, y)
        depth = bearing.depth(eccentricity)  # Eq. 3
        bore_arm, journal_arm = bearing.contact_arms(depth)
        slip = nx * vy - ny * vx + journal_spin * journal_arm - bore_spin * bore_arm
        rate = nx * vx + ny * vy
        if impact_velocity is None or (is_number(depth) and depth <= 0.0):
            if is_number(eccentricity) and eccentricity == 0.0:
                rate = bearing.speed_outwards(vx, vy)
            return ContactForce(depth, rate, slip, 0.0, 0.0, 0.0, 0.0, journal_arm, False, 0.0)
        asked = self.normal(maximum(depth, SHALLOWEST), rate, impact_velocity)
        normal = where(depth > 0.0, maximum(asked, 0.0), 0.0)
        deflection = 0.0
        if self.friction.has_state:
            mean_slip = 0.5 * (history.slip + slip)
            deflection = self.friction.next_deflection(history.deflection, mean_slip, history.step)
        friction = self.friction(slip, normal, deflection)
        return ContactForce(
            depth,
            rate,
            slip,
            normal,
            friction,
            -normal * nx - friction * ny,
            -normal * ny + friction * nx,
            journal_arm,
            asked < 0.0,
            deflection,
        )


@value
class JournalContact(Contact):
    """Contact of a journal in a bore: geometry, normal law and friction law.

    Arguments:
        bearing: radii and clearance.
        normal: law for the normal force.
        friction: law for the tangential force; none by default.
    """

    bearing: JournalBearing
    normal: NormalLaw
    friction: FrictionLaw = Frictionless()

    @model_validator(mode="after")
    def _law_is_of_this_bearing(self) -> JournalContact:
        own = getattr(self.normal, "bearing", self.bearing)
        if own != self.bearing:
            here, there = (f"({one.bore_radius}, {one.clearance}) m" for one in (own, self.bearing))
            raise ValueError(
                f"normal.bearing = {here} of bore radius and clearance: is another than that of the contact; "
                f"allowed: {there}"
            )
        return self

    def with_clearance(self, clearance: float) -> JournalContact:
        """The same bore and laws with another radial clearance [m], > 0."""
        bearing = replace(self.bearing, clearance=clearance)
        own = {"bearing": bearing} if hasattr(self.normal, "bearing") else {}
        return replace(self, bearing=bearing, normal=replace(self.normal, **own))  # type: ignore[type-var]


@value
class SlotContact(Contact):
    """Contact of a corner or a round pin with the walls of a slot: geometry, normal law and friction law.

    Arguments:
        bearing: the slot's geometry.
        normal: law for the normal force; one that goes by the radii of a bore does not fit.
        friction: law for the tangential force; none by default.
    """

    bearing: Slot
    normal: NormalLaw
    friction: FrictionLaw = Frictionless()

    @model_validator(mode="after")
    def _law_is_of_walls(self) -> SlotContact:
        _check_straight(self.normal)
        return self


@value
class FaceContact(Contact):
    """Contact of a point with a straight face: geometry and normal law; there is no friction along the face.

    Arguments:
        bearing: the face.
        normal: law for the normal force; one that goes by the radii of a bore does not fit.
    """

    bearing: Face
    normal: NormalLaw
    friction: Frictionless = Frictionless()

    @model_validator(mode="after")
    def _law_is_of_a_face(self) -> FaceContact:
        _check_straight(self.normal)
        return self


def _check_straight(law: NormalLaw) -> None:
    """Raise ValueError if a law goes by the radii of a pin in its bore."""
    if hasattr(law, "bearing"):
        raise ValueError(
            f"normal = {type(law).__name__}: is of a pin in its bore; "
            "allowed: laws of a stiffness, such as Exact"
        )
