"""Channels of pins, bearings and guides. A new kind of pin or guide registers here what it has."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial, singledispatch
from operator import attrgetter
from typing import Any

import numpy as np

from support_exudyn.mechanics.channels import (
    CONTACT,
    MOTION,
    ChannelDefinition,
    ChannelDefinitions,
    DataNeeds,
    Row,
    named,
    table,
)
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.guides import ClearanceGuide, Guide, IdealGuide
from support_exudyn.model.linkage import Slide
from support_exudyn.model.pins import ClearancePin, IdealPin, Pin
from support_exudyn.model.plane_geometry import plus, rotated

AXES = ("x", "y", "z")
TOWARDS = ("forward", "up", "to the right")
IMPACT = "impact velocity used by the contact law"
NO_FORCE = np.finfo(np.float64).tiny  # [N], so that nothing is divided by zero
Sections = Sequence[ContactSeries]


def sizes(vectors: Series) -> Series:
    """Sizes (n,) of vectors (n, d)."""
    return np.hypot(*vectors.T) if vectors.shape[1] == 2 else np.asarray(np.linalg.norm(vectors, axis=1))


def column(k: int) -> Callable[[Series], Series]:
    """What gives a component (n,) of vectors (n, d)."""
    return lambda vectors: vectors[:, k]


def components(stem: str, unit: str, meaning: str, axes: int) -> list[Row]:
    """Rows of the components of vectors (n, axes), named by what comes before the axis."""
    return [(f"{stem}{AXES[k]}", unit, f"{meaning}, {TOWARDS[k]}", column(k)) for k in range(axes)]


# --- pins ---


@singledispatch
def pin_channels(pin: Pin, name: str) -> ChannelDefinitions:
    """The channels of a pin of the plane, by name. Raises TypeError for a kind that has registered none."""
    raise TypeError(f"pins.{name} = {type(pin).__name__}: has no channels; see `mechanics.joint_channels`")


def force_channels(
    name: str, needs: DataNeeds, force: Callable[[Any], Series], axes: int = 2
) -> ChannelDefinitions:
    """The channels of a pin's force; force: of the first body on the second (n, axes) [N], from a run."""
    size = ChannelDefinition("N", "magnitude of the pin force", needs, lambda run: sizes(force(run)), force)
    rows: list[Row] = components("force_", "N", "force of the first body on the second", axes)
    return {f"pin.{name}.force": size} | table(f"pin.{name}", needs, force, rows)


@pin_channels.register
def _of_ideal_pin(pin: IdealPin, name: str) -> ChannelDefinitions:
    found = force_channels(name, DataNeeds.JOINTS, lambda run: run.pins[name])
    if pin.friction is not None:
        rows: list[Row] = [("friction_moment", "N m", "of friction on the second body", lambda run: run[name])]
        found |= table(f"pin.{name}", MOTION | DataNeeds.JOINTS, attrgetter("friction_moments"), rows)
    return found


@pin_channels.register
def _of_clearance_pin(pin: ClearancePin, name: str) -> ChannelDefinitions:
    sign = 1.0 if pin.bore == "first" else -1.0  # contacts know the force on the journal

    def force(run: Trajectory) -> Series:
        (contact,) = run.sections[name]
        return sign * np.array([contact.force_x, contact.force_y]).T

    found = force_channels(name, CONTACT, force) | clearance_channels(name)
    if pin.contact.friction.has_state:
        found |= table(f"pin.{name}", CONTACT, named("sections", name), [_STATE])
    return found


def _of(what: str, unite: Callable[..., Any]) -> Callable[[Sections], Series]:
    """A number of all sections together."""
    return lambda sections: np.asarray(unite([getattr(one, what) for one in sections], axis=0))


def _middle(what: str) -> Callable[[Sections], Series]:
    """The journal is straight: its middle is between its edges."""
    return lambda sections: 0.5 * (getattr(sections[0], what) + getattr(sections[-1], what))


_STATE: Row = ("deflection", "m", "state of the friction law", _of("deflection", np.sum))


def clearance_channels(name: str, *, in_space: bool = False) -> ChannelDefinitions:
    """What a clearance pin of the plane has besides its force; or in space a bearing of many sections."""
    every, largest, mean = (f", {one} of all sections" * in_space for one in ("sum", "largest", "mean"))
    x, y = ("first axis across", "second axis across") if in_space else ("forward", "up")
    friction = f"on the journal, along t (n turned by +90 degrees){every}"
    centre = "journal's centre from the bore's"
    rows: list[Row] = [
        ("normal_force", "N", f"normal contact force{every}", _of("normal_force", np.sum)),
        ("friction_force", "N", friction, _of("friction_force", np.sum)),
        ("depth", "m", f"depth{largest}; negative: gap", _of("depth", np.max)),
        ("slip", "m/s", f"slip of the journal's surface, along t{mean}", _of("slip", np.mean)),
        ("impact_velocity", "m/s", f"{IMPACT}{largest}; 0 during separation", _of("impact_velocity", np.max)),
        ("eccentricity_x", "m", f"{centre}, {x}", _middle("eccentricity_x")),
        ("eccentricity_y", "m", f"{centre}, {y}", _middle("eccentricity_y")),
    ]
    for place, edge in ((0, "left"), (-1, "right")) if in_space else ():
        rows += [
            (f"{edge}_depth", "m", f"depth at the {edge} edge; negative: gap", _at("depth", place)),
            (f"{edge}_eccentricity_x", "m", f"{centre} at the {edge} edge, {x}", _at("eccentricity_x", place)),
            (f"{edge}_eccentricity_y", "m", f"{centre} at the {edge} edge, {y}", _at("eccentricity_y", place)),
        ]
    return table(f"pin.{name}", CONTACT, named("sections", name), rows)


def _at(what: str, place: int) -> Callable[[Sections], Series]:
    """A number of the section at a place."""
    return lambda sections: np.asarray(getattr(sections[place], what))


def bearing_channels(name: str, *, with_clearance: bool, is_guide: bool) -> ChannelDefinitions:
    """The channels of a bearing in space, or of a guide."""
    joints = DataNeeds.JOINTS
    if is_guide:
        return _ideal_guide_channels(name)
    about = "of the first body on the second about {} through the middle of the bearing"
    found = force_channels(name, joints, lambda run: run.pins[name], axes=3)
    rows: list[Row] = [
        ("moment_x", "N m", about.format("x"), column(0)),
        ("moment_y", "N m", about.format("y"), column(1)),
    ]
    found |= table(f"pin.{name}", joints, lambda run: run.pin_moments[name], rows)
    return found | clearance_channels(name, in_space=True) if with_clearance else found


# --- guides ---


@singledispatch
def guide_channels(guide: Guide, name: str, slide: Slide) -> ChannelDefinitions:
    """The channels of a guide of this name, by name. Raises TypeError for a kind that has registered none."""
    del slide
    raise TypeError(f"guides.{name} = {type(guide).__name__}: has no channels; see `mechanics.joint_channels`")


def _ideal_guide_channels(name: str) -> ChannelDefinitions:
    def magnitude(unit: str, what: str, k: int) -> ChannelDefinition:
        def signed(run: Trajectory) -> Series:
            return run.slides[name][:, k : k + 1]

        meaning = f"magnitude of the guide's {what}"
        return ChannelDefinition(unit, meaning, DataNeeds.JOINTS, lambda run: sizes(signed(run)), signed)

    return {
        f"{name}.force": magnitude("N", "force, across it", 0),
        f"{name}.moment": magnitude("N m", "moment", 1),
    }


@guide_channels.register
def _of_ideal_guide(guide: IdealGuide, name: str, slide: Slide) -> ChannelDefinitions:
    del slide
    found = _ideal_guide_channels(name)
    if guide.friction is not None:
        meaning = "of the guide on the body, along its direction"
        rows: list[Row] = [("friction_force", "N", meaning, lambda forces: forces[name])]
        found |= table(name, MOTION | DataNeeds.JOINTS, attrgetter("friction_forces"), rows)
    return found


class _Block:
    """What a guide with clearance does at the records: its corners, in the axes of the guide."""

    def __init__(self, guide: ClearanceGuide, name: str, slide: Slide, run: Any) -> None:
        motion = run.motion
        angle = slide.direction + motion.turn(slide.against)
        along, across = np.cos(angle), np.sin(angle)
        middle = motion.place(slide.body, slide.point)
        origin = motion.place(slide.against, slide.point)
        parts = guide.contacts()
        self.tilt = motion.turn(slide.body) - motion.turn(slide.against)
        contacts = [run.sections[f"{name}.{part}"][0] for part in parts]
        self.force = np.array([along * one.force_y - across * one.force_x for one in contacts])
        self.friction = np.array([along * one.force_x + across * one.force_y for one in contacts])
        self.normal = np.array([one.normal_force for one in contacts])
        upper, lower, arms = [], [], []
        for part in parts.values():
            place = motion.place(slide.body, plus(slide.point, rotated(part.point, slide.direction)))
            x, y = (place - origin).T
            height = along * y - across * x - part.middle  # from the middle line
            slot, radius = part.contact.bearing, part.contact.bearing.contact_arms(0.0)[1]
            upper.append(slot.clearance - height)
            lower.append(slot.clearance + height)
            x, y = (place - middle).T
            arms.append((along * x + across * y, along * y - across * x + np.sign(height) * radius))
        self.upper, self.lower = np.min(upper, axis=0), np.min(lower, axis=0)
        self.x, self.y = np.moveaxis(np.array(arms), 1, 0)

    @property
    def moment(self) -> Series:
        """Of the forces on the block about the guide's point (n,) [N m]."""
        return np.asarray((self.x * self.force - self.y * self.friction).sum(axis=0))

    @property
    def place(self) -> Series:
        """Where along the block the walls press on it, from the guide's point; 0 apart (n,) [m]."""
        pressed = self.normal.sum(axis=0)
        return np.asarray((self.x * self.normal).sum(axis=0) / np.maximum(pressed, NO_FORCE))


_PLACE = "where the walls press, along the guide from its point on the body; 0 during separation"
_BLOCK_ROWS: tuple[Row, ...] = (
    ("gap_upper", "m", "least distance from the upper wall; negative: depth", lambda b: b.upper),
    ("gap_lower", "m", "least distance from the lower wall; negative: depth", lambda b: b.lower),
    ("tilt", "rad", "angle against the guide, 0 at the start", lambda b: b.tilt),
    ("force", "N", "of the guide on the body, across, to the upper side", lambda b: b.force.sum(axis=0)),
    ("friction_force", "N", "of the guide on the body, along its direction", lambda b: b.friction.sum(axis=0)),
    ("moment", "N m", "of the guide on the body, about the guide's point", lambda b: b.moment),
    ("place", "m", _PLACE, lambda b: b.place),
)
_CORNER_FRICTION = "on the body, along t (to the left at the upper wall, to the right at the lower)"
_CORNER_ROWS: tuple[Row, ...] = (
    ("gap", "m", "distance from the nearer wall; negative: depth", lambda sections: -sections[0].depth),
    ("normal_force", "N", "normal contact force", _of("normal_force", np.sum)),
    ("friction_force", "N", _CORNER_FRICTION, _of("friction_force", np.sum)),
    ("slip", "m/s", "slip of the body's surface, along t", _of("slip", np.sum)),
    ("impact_velocity", "m/s", f"{IMPACT}; 0 during separation", _of("impact_velocity", np.sum)),
)


@guide_channels.register
def _of_clearance_guide(guide: ClearanceGuide, name: str, slide: Slide) -> ChannelDefinitions:
    found = table(f"guide.{name}", CONTACT, partial(_Block, guide, name, slide), _BLOCK_ROWS)
    for part, contact in guide.contacts().items():
        corner = f"{name}.{part}"
        rows = [*_CORNER_ROWS, *[_STATE] * contact.contact.friction.has_state]
        found |= table(f"guide.{corner}", CONTACT, named("sections", corner), rows)
    return found
