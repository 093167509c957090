"""What a linear actuator, and a part that a jack holds, can be modelled as; the scenario chooses it."""

from __future__ import annotations

import math
from abc import ABC
from dataclasses import field, replace

from support_exudyn.model.hydraulics.leg import ActuatorModel as ActuatorModel
from support_exudyn.model.hydraulics.leg import OilColumn as OilColumn
from support_exudyn.model.linkage import GROUND, Body, LinearActuator, Linkage, Slide, pinned
from support_exudyn.model.plane_geometry import direction
from user_forces.values.units import Kilograms, KilogramSquareMetres, Metres
from user_forces.values.value import InputError, NonNegative, Positive, Value, Vector2, value


@value
class RigidActuator(ActuatorModel):
    """A massless drive: the length is what the drive says, a constraint whose multiplier is the force."""


@value
class CylinderAndRod(ActuatorModel):
    """An actuator with mass: a cylinder on the foot's pin, and in it a sliding rod on the head's.

    The drive acts between both, so that the forces in the pins of foot and head differ from it by weight and
    inertia. Centres of mass are on the line from foot to head. `with_cylinder_and_rod` names bodies and pins.

    Arguments:
        cylinder_mass: [kg], > 0, all cylinders of a pair together.
        cylinder_centre: distance of its centre of mass from the foot [m], >= 0.
        cylinder_inertia: about its centre of mass [kg m^2], > 0.
        rod_mass: [kg], > 0.
        rod_centre: distance of its centre of mass from the head [m], >= 0.
        rod_inertia: about its centre of mass [kg m^2], > 0.
        drive: what holds the length: a constraint or oil.
    """

    cylinder_mass: Kilograms[Positive]
    cylinder_centre: Metres[NonNegative]
    cylinder_inertia: KilogramSquareMetres[Positive]
    rod_mass: Kilograms[Positive]
    rod_centre: Metres[NonNegative]
    rod_inertia: KilogramSquareMetres[Positive]
    drive: RigidActuator | OilColumn = field(default_factory=RigidActuator)

    @property
    def hydraulic(self) -> ActuatorModel | None:
        """The oil of the actuator's drive; None if that is rigid."""
        return self.drive.hydraulic

    def check_extension(self, lowest: float, name: str) -> None:
        """Raise InputError if its drive cannot be drawn in so far [m]."""
        self.drive.check_extension(lowest, f"{name}.drive")

    def check_elements(self, where: str) -> None:
        """Raise InputError if what its drive consists of does not go together; where: its path."""
        self.drive.check_elements(f"{where}.drive")


class PartModel(Value, ABC):
    """How a part that a jack holds on its body is modelled."""


@value
class Lumped(PartModel):
    """Fixed to its body, whose mass and inertia contain it."""


@value
class OwnBody(PartModel):
    """A body of its own on a hinge, locked by its jack, which is not driven.

    Arguments:
        jack: a strut of constant length, or a closed cushion of oil, which carries the static load of the start
            posture, so that a machine at rest stays there.
    """

    jack: RigidActuator | OilColumn = field(default_factory=RigidActuator)


def bore_area(diameter: float, number: int = 1) -> float:
    """Piston area [m^2] of so many cylinders of this bore diameter [m]."""
    if not (math.isfinite(diameter) and diameter > 0.0 and number >= 1):
        raise InputError(f"diameter = {diameter} m, number = {number}: allowed: > 0 and at least 1")
    return number * math.pi / 4.0 * diameter**2


def with_cylinder_and_rod(linkage: Linkage, name: str, model: CylinderAndRod) -> Linkage:
    """The linkage with an actuator NAME in two bodies.

    It gains the bodies NAME_cylinder and NAME_rod, their pins NAME_foot (foot body - cylinder) and NAME_head
    (rod - head body), and the guide NAME_guide of the rod in the cylinder, through the head. The actuator
    itself then pushes cylinder and rod apart. Both bodies move as the actuator's ends do.

    Raises InputError if one of these names is taken.
    """
    actuator = linkage.actuators[name]
    cylinder, rod, guide = f"{name}_cylinder", f"{name}_rod", f"{name}_guide"
    pins = {
        f"{name}_foot": pinned(actuator.foot, cylinder, actuator.foot_point),
        f"{name}_head": pinned(rod, actuator.head, actuator.head_point),
    }
    for new, taken in (({cylinder, rod}, linkage.bodies), (pins, linkage.pins), ({guide}, linkage.slides)):
        for item in new:
            if item in taken:
                raise InputError(
                    f"actuators.{name}: {item} is a name of the machine; allowed: one that is free"
                )
    angle = direction(actuator.foot_point, actuator.head_point)
    foot_speed, head_speed = (
        _velocity(linkage, body, point)
        for body, point in ((actuator.foot, actuator.foot_point), (actuator.head, actuator.head_point))
    )
    c, s = math.cos(angle), math.sin(angle)
    across = (head_speed[1] - foot_speed[1]) * c - (head_speed[0] - foot_speed[0]) * s
    spin = across / actuator.start_length

    def body(mass: float, inertia: float, end: Vector2, end_speed: Vector2, away: float) -> Body:
        """A body whose centre of mass is so far [m] along the actuator from an end."""
        return Body(
            mass=mass,
            inertia=inertia,
            centre=(end[0] + away * c, end[1] + away * s),
            angle=angle,
            velocity=(end_speed[0] - spin * away * s, end_speed[1] + spin * away * c),
            spin=spin,
        )

    bodies = {
        cylinder: body(
            model.cylinder_mass, model.cylinder_inertia, actuator.foot_point, foot_speed, model.cylinder_centre
        ),
        rod: body(model.rod_mass, model.rod_inertia, actuator.head_point, head_speed, -model.rod_centre),
    }
    between = LinearActuator(
        foot=cylinder, head=rod, foot_point=actuator.foot_point, head_point=actuator.head_point
    )
    slide = Slide(body=rod, point=actuator.head_point, direction=angle, against=cylinder)
    return replace(
        linkage,
        bodies={**linkage.bodies, **bodies},
        pins={**linkage.pins, **pins},
        actuators={**linkage.actuators, name: between},
        slides={**linkage.slides, guide: slide},
    )


def _velocity(linkage: Linkage, body: str, point: Vector2) -> Vector2:
    """Velocity of a point of a body at the start [m/s]."""
    if body == GROUND:
        return 0.0, 0.0
    item = linkage.bodies[body]
    vx, vy = item.velocity
    return vx - item.spin * (point[1] - item.centre[1]), vy + item.spin * (point[0] - item.centre[0])
