"""All channels of a linkage by name, in the plane and in space.

Names are the same where they mean the same. A pin or actuator that there are two of in space has the channels
of each, and under the planar name the force of both, and the mean of lengths and angles.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from operator import attrgetter
from typing import Any

import numpy as np

from support_exudyn.mechanics.acting_loads import load_channels
from support_exudyn.mechanics.channels import (
    CONTACT,
    LOADED,
    MOTION,
    OIL,
    ChannelDefinition,
    ChannelDefinitions,
    DataNeeds,
    Row,
    named,
    table,
)
from support_exudyn.mechanics.constraints import Distance, Shift, Turn
from support_exudyn.mechanics.hydraulic_legs import leg_channels
from support_exudyn.mechanics.joint_channels import (
    AXES,
    IMPACT,
    bearing_channels,
    column,
    components,
    force_channels,
    guide_channels,
    pin_channels,
    sizes,
)
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.reactions import UNDETERMINED, Loads
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.guides import Guide, IdealGuide
from support_exudyn.model.hydraulics.leg import HydraulicLeg
from support_exudyn.model.linkage import Linkage
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.pins import CompliantPin, IdealPin, Pin
from support_exudyn.model.spatial_linkage import SpatialLinkage
from user_forces.values.value import InputError

APART = "pushes its ends apart if positive"
POSITION, VELOCITY, JOINTS = DataNeeds.POSITION, DataNeeds.VELOCITY, DataNeeds.JOINTS


@dataclass(frozen=True)
class Parts:
    """What a linkage has besides ideal joints and rigid actuators, by name.

    Arguments:
        pins, guides: all of the plane that are not ideal.
        oil: actuators of the plane that no constraint holds.
        legs: actuators of the linkage on oil. pump: whether they share one.
        loads: what acts on the machine besides its weight.
        blocks: that fall on the machine.
    """

    pins: Mapping[str, Pin] = field(default_factory=dict)
    guides: Mapping[str, Guide] = field(default_factory=dict)
    oil: Collection[str] = ()
    legs: Mapping[str, HydraulicLeg] = field(default_factory=dict)
    pump: bool = False
    loads: Mapping[str, ActingLoad] = field(default_factory=dict)
    blocks: Collection[str] = ()


def channel_definitions(linkage: Linkage | SpatialLinkage, parts: Parts) -> ChannelDefinitions:
    """All channels of a linkage by name.

    Raises InputError if two parts have a channel of the same name.
    """
    actuators: Iterable[ChannelDefinitions]
    if isinstance(linkage, SpatialLinkage):
        axes, loose = 3, [name for name, pin in parts.pins.items() if not pin.holds]
        loads = Loads(linkage, loose, parts.oil)
        actuators = _actuators_in_space(linkage, parts, loads)
        joints = _joints_in_space(linkage, loose, loads)
    else:
        axes, joints = 2, _joints(linkage, parts)
        actuators = (_actuator(name, name in parts.oil, 2) for name in linkage.actuators)
    groups = [
        {"time": ChannelDefinition("s", "time", DataNeeds.NOTHING, attrgetter("time"))},
        *(_body(name, linkage, axes) for name in linkage.bodies),
        *(_point(name, axes) for name in linkage.points),
        *actuators,
        leg_channels(parts.legs, parts.pump),
        *joints,
        *(load_channels(name, load) for name, load in parts.loads.items()),
        *(table(name, CONTACT, named("sections", name), _BLOCK_ROWS) for name in parts.blocks),
        _energy(parts, axes),
    ]
    # a traced centre of mass may have the name of its body, as its place is the same
    points, bodies = linkage.points.items(), linkage.bodies
    centres = [name for name, one in points if one.body == name and one.point == bodies[name].centre]
    same = {f"{name}.{axis}" for name in centres for axis in AXES}
    found: ChannelDefinitions = {}
    for group in groups:
        if twice := (found.keys() & group.keys()) - same:
            raise InputError(f"{min(twice)}: two parts have a channel of this name; allowed: names that differ")
        found |= group
    return found


def _body(name: str, linkage: Linkage | SpatialLinkage, axes: int) -> ChannelDefinitions:
    body = linkage.bodies[name]
    # in space, velocities follow from the rates of Euler parameters and these
    velocity, about = (MOTION, " about z") if axes == 3 else (VELOCITY, "")
    spin = 3 * (axes - 1) * (list(linkage.bodies).index(name) + 1) - 1  # that about z among all velocities

    def centre(run: Trajectory) -> Series:
        return np.asarray(body.centre + run.motion.centre(name)[0])

    rates = components("velocity_", "m/s", "velocity of the centre of mass", axes)
    turns: list[Row] = [
        ("angle", "rad", f"orientation{about} from +x", lambda motion: body.angle + motion.turn(name))
    ]
    about_z = column(2) if axes == 3 else np.asarray
    spins: list[Row] = [("angular_velocity", "rad/s", f"angular velocity{about}", about_z)]
    if axes == 3:
        turns += [
            ("roll", "rad", "turn about x, the right side down", lambda motion: motion.turn(name, 0)),
            ("yaw", "rad", "turn about y, to the left", lambda motion: motion.turn(name, 1)),
        ]
        spins += [
            ("angular_velocity_x", "rad/s", "angular velocity about x", column(0)),
            ("angular_velocity_y", "rad/s", "angular velocity about y", column(1)),
        ]
    turning: list[Row] = [("angular_acceleration", "rad/s^2", f"angular acceleration{about}", column(spin))]
    return {
        **table(name, POSITION, centre, components("", "m", "centre of mass", axes)),
        **table(name, velocity, lambda run: run.motion.centre(name)[1], rates),
        **table(name, POSITION, attrgetter("motion"), turns),
        **table(name, velocity, lambda run: run.motion.spin(name), spins),
        **table(name, DataNeeds.ACCELERATION, attrgetter("acceleration"), turning),
    }


def _point(name: str, axes: int) -> ChannelDefinitions:
    return table(name, POSITION, lambda run: run.path(name), components("", "m", "position", axes))


# --- actuators ---


def _actuator(name: str, oil: bool, axes: int) -> ChannelDefinitions:
    angle = f"direction from foot to head{' in the plane,' if axes == 3 else ','} from +x"
    rows: list[Row] = [
        ("angle", "rad", angle, lambda span: np.arctan2(span[:, 1], span[:, 0])),
        ("length", "m", "distance of its ends", sizes),
    ]
    force: list[Row] = [("force", "N", APART, lambda run: run.actuators[name])]
    found = table(name, POSITION, lambda run: run.span(name), rows)
    return found | table(name, OIL if oil else JOINTS, lambda run: run, force)


def _actuators_in_space(linkage: SpatialLinkage, parts: Parts, loads: Loads) -> Iterable[ChannelDefinitions]:
    single: ChannelDefinitions = {}
    for name, actuator in linkage.actuators.items():
        channels = _actuator(name, actuator.actuator in parts.oil, 3)
        single |= _marked(channels, ".force", loads.determine(Distance, [name]))
    yield single
    for whole in dict.fromkeys(actuator.actuator for actuator in linkage.actuators.values()):
        each = linkage.parts_of_actuator(whole)
        pair: ChannelDefinitions = {}
        for what, unite, meaning in _OF_BOTH if each != (whole,) else ():
            both = [single[f"{part}.{what}"] for part in each]
            row = (what, both[0].unit, meaning, partial(_united, unite, both))
            pair |= table(whole, both[0].needs, lambda run: run, [row])
        yield _marked(pair, ".force", loads.determine(Distance, each))


_OF_BOTH: tuple[tuple[str, Any, str], ...] = (
    ("angle", np.mean, "direction from foot to head, mean of both"),
    ("length", np.mean, "distance of its ends, mean of both"),
    ("force", np.sum, f"{APART}, both together"),
)


def _united(unite: Any, parts: Iterable[ChannelDefinition], run: Trajectory) -> Series:
    """A channel of a pair, from those of each."""
    return np.asarray(unite([one.values(run) for one in parts], axis=0))


# --- joints ---


def _joints(linkage: Linkage, parts: Parts) -> Iterable[ChannelDefinitions]:
    of_crank: list[Row] = [("moment", "N m", "of the drive on the crank", np.asarray)]
    of_gear: list[Row] = [("moment", "N m", "of the gear on its second body", np.asarray)]
    yield from (table(name, JOINTS, named("cranks", name), of_crank) for name in linkage.cranks)
    for name, slide in linkage.slides.items():
        yield guide_channels(parts.guides.get(name, IdealGuide()), name, slide)
    yield from (table(name, JOINTS, named("gears", name), of_gear) for name in linkage.gears)
    for name, place in linkage.pins.items():
        pin = parts.pins.get(name, IdealPin())
        if isinstance(pin, CompliantPin):  # its channels are those of its loads
            for load_name, load in pin.named_loads(name, place).items():
                yield load_channels(load_name, load, f"pin.{name}")
        else:
            yield pin_channels(pin, name)


def _joints_in_space(
    linkage: SpatialLinkage, loose: Collection[str], loads: Loads
) -> Iterable[ChannelDefinitions]:
    for name, bearing in linkage.bearings.items():
        channels = bearing_channels(name, with_clearance=bearing.pin in loose, is_guide=bearing.is_guide)
        channels = _marked(channels, ".force", loads.determine(Shift, [name]))
        yield _marked(channels, ".moment", loads.determine(Turn, [name]))
    for pin in dict.fromkeys(b.pin for b in linkage.bearings.values() if not b.is_guide):
        each = tuple(linkage.parts_of_pin(pin))
        if each != (pin,):

            def force(run: Trajectory, each: Iterable[str] = each) -> Series:
                return np.asarray(np.sum([run.pins[part] for part in each], axis=0))

            together = force_channels(pin, JOINTS, force, axes=3)
            yield _marked(together, ".force", loads.determine(Shift, each))


def _marked(channels: ChannelDefinitions, what: str, determined: bool) -> ChannelDefinitions:
    """Channels, those whose names go on with `what` marked if rigid bodies do not determine them."""
    if determined:
        return channels
    return {
        name: replace(one, meaning=one.meaning + UNDETERMINED) if what in name else one
        for name, one in channels.items()
    }


# --- loads and energy ---


_BLOCK_ROWS: tuple[Row, ...] = (
    ("force", "N", "of the block, along the normal of its face", lambda faces: faces[0].normal_force),
    ("gap", "m", "between block and point, along that normal; negative: depth", lambda faces: -faces[0].depth),
    ("impact_velocity", "m/s", f"{IMPACT}; 0 during separation", lambda faces: faces[0].impact_velocity),
)


def _energy(parts: Parts, axes: int) -> ChannelDefinitions:
    loaded, pumped = bool(parts.loads), bool(parts.legs)
    movers = ["the drives" if loaded else "the drive"] + ["pumps"] * pumped + ["what moves loads"] * loaded
    lost = "damping" + " and valves" * pumped
    places = "contacts, oil and loads" if loaded else "contacts and oil"
    stored, integrals = DataNeeds.NOTHING, DataNeeds.INTEGRALS
    if not all(pin.holds for pin in parts.pins.values()) or parts.guides or parts.blocks:
        stored |= CONTACT
    if parts.oil:
        stored |= OIL
    if loaded or any(isinstance(pin, CompliantPin) for pin in parts.pins.values()):
        stored |= LOADED
    balance = "gain minus work plus loss; zero if computed exactly"
    rows = (
        ("kinetic", MOTION if axes == 3 else VELOCITY, "kinetic energy of all bodies", "kinetic"),
        ("potential", POSITION, "of weight, zero in the machine's start posture", "potential"),
        ("elastic", stored, f"stored in {places}", "stored"),
        ("damping_loss", integrals, f"dissipated by {lost} in {places} so far", "damping_loss"),
        ("friction_loss", integrals, "dissipated by friction so far", "friction_loss"),
        ("work", integrals, f"work of {' and of '.join(movers)} so far", "work"),
        ("balance", MOTION | stored | integrals, balance, "balance"),
    )
    return {
        f"energy.{name}": ChannelDefinition("J", meaning, needs, attrgetter(field))
        for name, needs, meaning, field in rows
    }
