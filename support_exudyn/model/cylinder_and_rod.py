"""A column as cylinder and rod on a sliding joint: the linkage with both in place of the massless one."""

from __future__ import annotations

import math
from dataclasses import replace

from support_exudyn.model.columns import TwoBodyColumn
from support_exudyn.model.linkage import GROUND, Body, Column, Linkage, Slide, pinned
from support_exudyn.model.plane_geometry import direction
from user_forces.values.value import InputError, Vector2


def with_two_bodies(linkage: Linkage, name: str, model: TwoBodyColumn) -> Linkage:
    """The linkage with a column NAME in two bodies.

    It gains the bodies NAME_cylinder and NAME_rod, their pins NAME_foot (foot body - cylinder) and NAME_head
    (rod - head body), and the guide NAME_guide of the rod in the cylinder, through the head. The column itself
    then pushes cylinder and rod apart. Both bodies move as the column's ends do.

    Raises InputError if one of these names is taken.
    """
    column = linkage.columns[name]
    cylinder, rod, guide = f"{name}_cylinder", f"{name}_rod", f"{name}_guide"
    pins = {
        f"{name}_foot": pinned(column.foot, cylinder, column.foot_point),
        f"{name}_head": pinned(rod, column.head, column.head_point),
    }
    for new, taken in (({cylinder, rod}, linkage.bodies), (pins, linkage.pins), ({guide}, linkage.slides)):
        for item in new:
            if item in taken:
                raise InputError(f"columns.{name}: {item} is a name of the machine; allowed: one that is free")
    angle = direction(column.foot_point, column.head_point)
    foot_speed, head_speed = (
        _velocity(linkage, body, point)
        for body, point in ((column.foot, column.foot_point), (column.head, column.head_point))
    )
    c, s = math.cos(angle), math.sin(angle)
    across = (head_speed[1] - foot_speed[1]) * c - (head_speed[0] - foot_speed[0]) * s
    spin = across / column.start_length

    def body(mass: float, inertia: float, end: Vector2, end_speed: Vector2, away: float) -> Body:
        """A body whose centre of mass is so far [m] along the column from an end."""
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
            model.cylinder_mass, model.cylinder_inertia, column.foot_point, foot_speed, model.cylinder_centre
        ),
        rod: body(model.rod_mass, model.rod_inertia, column.head_point, head_speed, -model.rod_centre),
    }
    between = Column(foot=cylinder, head=rod, foot_point=column.foot_point, head_point=column.head_point)
    slide = Slide(body=rod, point=column.head_point, direction=angle, against=cylinder)
    return replace(
        linkage,
        bodies={**linkage.bodies, **bodies},
        pins={**linkage.pins, **pins},
        columns={**linkage.columns, name: between},
        slides={**linkage.slides, guide: slide},
    )


def _velocity(linkage: Linkage, body: str, point: Vector2) -> Vector2:
    """Of a point of a body at the start [m/s]."""
    if body == GROUND:
        return 0.0, 0.0
    item = linkage.bodies[body]
    vx, vy = item.velocity
    return vx - item.spin * (point[1] - item.centre[1]), vy + item.spin * (point[0] - item.centre[0])
