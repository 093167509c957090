"""All channels of a linkage in the plane by name, see `channels`."""

from collections.abc import Collection, Mapping
from types import MappingProxyType

import numpy as np

from support_exudyn.mechanics.acting_loads import load_channels
from support_exudyn.mechanics.block_contact import block_channels
from support_exudyn.mechanics.channels import (
    CONTACT,
    LOADED,
    MOTION,
    OIL,
    ChannelDefinition,
    ChannelDefinitions,
    DataNeeds,
    EvaluationContext,
)
from support_exudyn.mechanics.guide_channels import guide_channels
from support_exudyn.mechanics.leg_channels import leg_channels
from support_exudyn.mechanics.pin_channels import pin_channels
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.guides import Guide, IdealGuide
from support_exudyn.model.hydraulics.leg import HydraulicLeg
from support_exudyn.model.linkage import Body, Linkage, PinPlace, TracePoint
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.pins import CompliantPin, IdealPin, Pin
from user_forces.values.value import InputError


def channel_definitions(
    linkage: Linkage,
    pins: Mapping[str, Pin],
    oil: Collection[str],
    loads: Mapping[str, ActingLoad],
    guides: Mapping[str, Guide] = MappingProxyType({}),
    legs: Mapping[str, HydraulicLeg] = MappingProxyType({}),
    pump: bool = False,
    blocks: Collection[str] = (),
) -> ChannelDefinitions:
    """All channels of a linkage by name.

    Arguments:
        linkage: the mechanism.
        pins: all that are not ideal, by name.
        oil: names of the actuators that no constraint holds.
        loads: what acts on the machine besides its weight, by name.
        guides: all that are not ideal, by name.
        legs: actuators on oil, by name. pump: whether they share one.
        blocks: names of those that fall on the machine.
    """
    compliant = not all(pin.holds for pin in pins.values()) or bool(guides) or bool(blocks)
    stored = _stored(
        compliant, bool(oil), bool(loads) or any(isinstance(pin, CompliantPin) for pin in pins.values())
    )
    parts = [
        {"time": ChannelDefinition("s", "time", DataNeeds.NOTHING, lambda context: context.run.time)},
        *(_of_body(name, body, 3 * n) for n, (name, body) in enumerate(linkage.bodies.items())),
        *map(_of_point, linkage.points),
        *(_of_actuator(name, name in oil) for name in linkage.actuators),
        leg_channels(legs, pump),
        *map(_of_crank, linkage.cranks),
        *(guide_channels(guides.get(name, IdealGuide()), name, one) for name, one in linkage.slides.items()),
        *map(_of_gear, linkage.gears),
        *(_of_pin(pins.get(name, IdealPin()), name, place) for name, place in linkage.pins.items()),
        *(load_channels(name, load) for name, load in loads.items()),
        *map(block_channels, blocks),
        _of_energy(stored, bool(loads), bool(legs)),
    ]
    # a traced centre of mass may have the name of its body, as its place is the same
    centres = {name for name, one in linkage.points.items() if _is_centre(linkage, name, one)}
    same = {f"{name}.{axis}" for name in centres for axis in "xy"}
    found: ChannelDefinitions = {}
    for part in parts:
        if twice := (found.keys() & part.keys()) - same:
            raise InputError(f"{min(twice)}: two parts have a channel of this name; allowed: names that differ")
        found |= part
    return found


def _is_centre(linkage: Linkage, name: str, point: TracePoint) -> bool:
    """Whether a traced point is the centre of mass of the body of the same name."""
    return point.body == name and point.point == linkage.bodies[name].centre


def _of_body(name: str, body: Body, i: int) -> ChannelDefinitions:
    cx, cy = body.centre
    velocity, acceleration = DataNeeds.VELOCITY, DataNeeds.ACCELERATION
    return {
        f"{name}.x": ChannelDefinition(
            "m", "centre of mass, forward", DataNeeds.POSITION, lambda context: cx + context.run.position[:, i]
        ),
        f"{name}.y": ChannelDefinition(
            "m", "centre of mass, up", DataNeeds.POSITION, lambda context: cy + context.run.position[:, i + 1]
        ),
        f"{name}.velocity_x": ChannelDefinition(
            "m/s",
            "velocity of the centre of mass, forward",
            velocity,
            lambda context: context.run.velocity[:, i],
        ),
        f"{name}.velocity_y": ChannelDefinition(
            "m/s",
            "velocity of the centre of mass, up",
            velocity,
            lambda context: context.run.velocity[:, i + 1],
        ),
        f"{name}.angle": ChannelDefinition(
            "rad",
            "orientation from +x",
            DataNeeds.POSITION,
            lambda context: body.angle + context.run.position[:, i + 2],
        ),
        f"{name}.angular_velocity": ChannelDefinition(
            "rad/s", "angular velocity", velocity, lambda context: context.run.velocity[:, i + 2]
        ),
        f"{name}.angular_acceleration": ChannelDefinition(
            "rad/s^2", "angular acceleration", acceleration, lambda context: context.run.acceleration[:, i + 2]
        ),
    }


def _of_point(name: str) -> ChannelDefinitions:
    return {
        f"{name}.x": ChannelDefinition(
            "m", "position, forward", DataNeeds.POSITION, lambda context: context.path(name)[:, 0]
        ),
        f"{name}.y": ChannelDefinition(
            "m", "position, up", DataNeeds.POSITION, lambda context: context.path(name)[:, 1]
        ),
    }


def _of_actuator(name: str, oil: bool) -> ChannelDefinitions:
    def angle(context: EvaluationContext) -> Series:
        dx, dy = context.span(name).T
        direction: Series = np.arctan2(dy, dx)
        return direction

    def length(context: EvaluationContext) -> Series:
        distance: Series = np.hypot(*context.span(name).T)
        return distance

    return {
        f"{name}.angle": ChannelDefinition(
            "rad", "direction from foot to head, from +x", DataNeeds.POSITION, angle
        ),
        f"{name}.length": ChannelDefinition("m", "distance of its ends", DataNeeds.POSITION, length),
        f"{name}.force": ChannelDefinition(
            "N",
            "pushes its ends apart if positive",
            OIL if oil else DataNeeds.JOINTS,
            lambda context: context.run.actuators[name],
        ),
    }


def _of_crank(name: str) -> ChannelDefinitions:
    moment = ChannelDefinition(
        "N m", "of the drive on the crank", DataNeeds.JOINTS, lambda context: context.run.cranks[name]
    )
    return {f"{name}.moment": moment}


def _of_pin(pin: Pin, name: str, place: PinPlace) -> ChannelDefinitions:
    """The channels of a pin; those of a compliant one are its loads'."""
    if not isinstance(pin, CompliantPin):
        return pin_channels(pin, name)
    found: ChannelDefinitions = {}
    for load_name, load in pin.named_loads(name, place).items():
        found |= load_channels(load_name, load, f"pin.{name}")
    return found


def _of_gear(name: str) -> ChannelDefinitions:
    moment = ChannelDefinition(
        "N m", "of the gear on its second body", DataNeeds.JOINTS, lambda context: context.run.gears[name]
    )
    return {f"{name}.moment": moment}


def _stored(compliant: bool, oil: bool, loaded: bool) -> DataNeeds:
    """What the elastic energy needs."""
    found = DataNeeds.NOTHING
    for there, part in ((compliant, CONTACT), (oil, OIL), (loaded, LOADED)):
        found |= part if there else DataNeeds.NOTHING
    return found


def _of_energy(stored: DataNeeds, loaded: bool, pumped: bool) -> ChannelDefinitions:
    movers = ["the drive" if not loaded else "the drives"] + ["pumps"] * pumped + ["what moves loads"] * loaded
    lost = "damping" + " and valves" * pumped
    places = "contacts, oil and loads" if loaded else "contacts and oil"
    integrals = DataNeeds.INTEGRALS
    balance = MOTION | stored | integrals
    return {
        "energy.kinetic": ChannelDefinition(
            "J", "kinetic energy of all bodies", DataNeeds.VELOCITY, lambda context: context.kinetic
        ),
        "energy.potential": ChannelDefinition(
            "J",
            "of weight, zero in the machine's start posture",
            DataNeeds.POSITION,
            lambda context: context.potential,
        ),
        "energy.elastic": ChannelDefinition("J", f"stored in {places}", stored, lambda context: context.stored),
        "energy.damping_loss": ChannelDefinition(
            "J",
            f"dissipated by {lost} in {places} so far",
            integrals,
            lambda context: context.run.damping_loss,
        ),
        "energy.friction_loss": ChannelDefinition(
            "J", "dissipated by friction so far", integrals, lambda context: context.run.friction_loss
        ),
        "energy.work": ChannelDefinition(
            "J",
            f"work of {' and of '.join(movers)} so far",
            integrals,
            lambda context: context.run.work,
        ),
        "energy.balance": ChannelDefinition(
            "J", "gain minus work plus loss; zero if computed exactly", balance, lambda context: context.balance
        ),
    }
