"""All channels of a linkage in the plane by name, see `channels`."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import numpy as np

import support_exudyn.mechanics.bushing  # noqa: F401 - registers its channels
from support_exudyn.mechanics.channels import (
    CONTACT,
    LOADED,
    MOTION,
    OIL,
    Part,
    Recipe,
    Recipes,
    Seen,
)
from support_exudyn.mechanics.pin_channels import pin_channels
from support_exudyn.mechanics.trajectory import CylinderSeries, Series
from support_exudyn.model.linkage import Body, Linkage
from support_exudyn.model.loads.load import Load, Observed
from support_exudyn.model.pins import IdealPin, Pin


def recipes(
    linkage: Linkage,
    pins: Mapping[str, Pin],
    oil: Collection[str],
    loads: Mapping[str, Load],
    cylinders: Collection[str] = (),
) -> Recipes:
    """All channels of a linkage by name.

    Arguments:
        linkage: the mechanism.
        pins: all that are not ideal, by name.
        oil: names of the columns that no constraint holds.
        loads: what presses on the machine, by name.
        cylinders: names of those columns of oil that have a valve and pressures.
    """
    found = {"time": Recipe("s", "time", Part.NOTHING, lambda seen: seen.run.time)}
    for n, (name, body) in enumerate(linkage.bodies.items()):
        found |= _of_body(name, body, 3 * n)
    for name in linkage.points:
        found |= _of_point(name)
    for name in linkage.columns:
        found |= _of_column(name, name in oil)
        if name in cylinders:
            found |= _of_cylinder(name)
    for name in linkage.cranks:
        found |= _of_crank(name)
    for name in linkage.slides:
        found |= _of_slide(name)
    for name in linkage.pins:
        found |= pin_channels(pins.get(name, IdealPin()), name)
    for name, load in loads.items():
        found |= _of_load(name, load)
    return found | _of_energy(
        _stored(not all(pin.holds for pin in pins.values()), bool(oil), bool(loads)),
        bool(loads),
        bool(cylinders),
    )


def _of_body(name: str, body: Body, i: int) -> Recipes:
    cx, cy = body.centre
    velocity, acceleration = Part.VELOCITY, Part.ACCELERATION
    return {
        f"{name}.x": Recipe(
            "m", "centre of mass, forward", Part.POSITION, lambda seen: cx + seen.run.position[:, i]
        ),
        f"{name}.y": Recipe(
            "m", "centre of mass, up", Part.POSITION, lambda seen: cy + seen.run.position[:, i + 1]
        ),
        f"{name}.velocity_x": Recipe(
            "m/s", "velocity of the centre of mass, forward", velocity, lambda seen: seen.run.velocity[:, i]
        ),
        f"{name}.velocity_y": Recipe(
            "m/s", "velocity of the centre of mass, up", velocity, lambda seen: seen.run.velocity[:, i + 1]
        ),
        f"{name}.angle": Recipe(
            "rad",
            "orientation from +x",
            Part.POSITION,
            lambda seen: body.angle + seen.run.position[:, i + 2],
        ),
        f"{name}.angular_velocity": Recipe(
            "rad/s", "angular velocity", velocity, lambda seen: seen.run.velocity[:, i + 2]
        ),
        f"{name}.angular_acceleration": Recipe(
            "rad/s^2", "angular acceleration", acceleration, lambda seen: seen.run.acceleration[:, i + 2]
        ),
    }


def _of_point(name: str) -> Recipes:
    return {
        f"{name}.x": Recipe("m", "position, forward", Part.POSITION, lambda seen: seen.path(name)[:, 0]),
        f"{name}.y": Recipe("m", "position, up", Part.POSITION, lambda seen: seen.path(name)[:, 1]),
    }


def _of_column(name: str, oil: bool) -> Recipes:
    def angle(seen: Seen) -> Series:
        dx, dy = seen.span(name).T
        direction: Series = np.arctan2(dy, dx)
        return direction

    def length(seen: Seen) -> Series:
        distance: Series = np.hypot(*seen.span(name).T)
        return distance

    return {
        f"{name}.angle": Recipe("rad", "direction from foot to head, from +x", Part.POSITION, angle),
        f"{name}.length": Recipe("m", "distance of its ends", Part.POSITION, length),
        f"{name}.force": Recipe(
            "N",
            "pushes its ends apart if positive",
            OIL if oil else Part.JOINTS,
            lambda seen: seen.run.columns[name],
        ),
    }


def _of_cylinder(name: str) -> Recipes:
    def said(what: str, unit: str, meaning: str, values: Callable[[CylinderSeries], Series]) -> Recipes:
        return {f"{name}.{what}": Recipe(unit, meaning, OIL, lambda seen: values(seen.run.cylinders[name]))}

    found = said("pressure", "Pa", "of the piston side", lambda c: c.pressure)
    found |= said("rod_pressure", "Pa", "of the rod side", lambda c: c.rod_pressure)
    found |= said("opening", "1", "of the valve; positive: pump to the piston side", lambda c: c.opening)
    found |= said("flow", "m^3/s", "into the piston side", lambda c: c.flow)
    found |= said("rod_flow", "m^3/s", "into the rod side", lambda c: c.rod_flow)
    return found


def _of_crank(name: str) -> Recipes:
    moment = Recipe("N m", "of the drive on the crank", Part.JOINTS, lambda seen: seen.run.cranks[name])
    return {f"{name}.moment": moment}


def _of_slide(name: str) -> Recipes:
    joints = Part.JOINTS
    return {
        f"{name}.force": Recipe(
            "N", "magnitude of the guide's force, across it", joints, lambda seen: seen.run.slides[name][:, 0]
        ),
        f"{name}.moment": Recipe(
            "N m", "magnitude of the guide's moment", joints, lambda seen: seen.run.slides[name][:, 1]
        ),
    }


def _of_load(name: str, load: Load) -> Recipes:
    def said(what: str, channel: Observed) -> Recipe:
        return Recipe(channel.unit, channel.meaning, LOADED, lambda seen: seen.run.loads[name].observed[what])

    return {f"{name}.{what}": said(what, channel) for what, channel in load.channels.items()}


def _stored(compliant: bool, oil: bool, loaded: bool) -> Part:
    """What the elastic energy needs."""
    found = Part.NOTHING
    for there, part in ((compliant, CONTACT), (oil, OIL), (loaded, LOADED)):
        found |= part if there else Part.NOTHING
    return found


def _of_energy(stored: Part, loaded: bool, pumped: bool) -> Recipes:
    movers = ["the drive" if not loaded else "the drives"] + ["pumps"] * pumped + ["what moves loads"] * loaded
    lost = "damping" + " and valves" * pumped
    places = "contacts, oil and loads" if loaded else "contacts and oil"
    integrals = Part.INTEGRALS
    balance = MOTION | stored | integrals
    return {
        "energy.kinetic": Recipe("J", "kinetic energy of all bodies", Part.VELOCITY, lambda seen: seen.kinetic),
        "energy.potential": Recipe(
            "J", "of weight, zero in the machine's start posture", Part.POSITION, lambda seen: seen.potential
        ),
        "energy.elastic": Recipe("J", f"stored in {places}", stored, lambda seen: seen.stored),
        "energy.damping_loss": Recipe(
            "J",
            f"dissipated by {lost} in {places} so far",
            integrals,
            lambda seen: seen.run.damping_loss,
        ),
        "energy.friction_loss": Recipe(
            "J", "dissipated by friction so far", integrals, lambda seen: seen.run.friction_loss
        ),
        "energy.work": Recipe(
            "J",
            f"work of {' and of '.join(movers)} so far",
            integrals,
            lambda seen: seen.run.work,
        ),
        "energy.balance": Recipe(
            "J", "gain minus work plus loss; zero if computed exactly", balance, lambda seen: seen.balance
        ),
    }
