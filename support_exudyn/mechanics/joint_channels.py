"""Channels of pins, bearings and guides. A new kind of pin or guide registers here what it has."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial, singledispatch
from operator import attrgetter, itemgetter
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


def _of(what: str, unite: Callable[[Series], Series]) -> Callable[[Sections], Series]:
    """A number (n,) of all sections together, from those of each (sections, n)."""
    return lambda sections: np.asarray(unite(np.array([getattr(one, what) for one in sections])))


_SUM: Callable[[Series], Series] = partial(np.sum, axis=0)
_LARGEST: Callable[[Series], Series] = partial(np.max, axis=0)
_MEAN: Callable[[Series], Any] = partial(np.mean, axis=0)
_STATE: Row = ("deflection", "m", "state of the friction law", _of("deflection", _SUM))


def _middle(sections: Series) -> Series:
    """The journal is straight: its middle is between its edges."""
    return np.asarray(0.5 * (sections[0] + sections[-1]))


def clearance_channels(name: str, *, in_space: bool = False) -> ChannelDefinitions:
    """What a clearance pin of the plane has besides its force; or in space a bearing of many sections."""
    every, largest, mean = (f", {one} of all sections" * in_space for one in ("sum", "largest", "mean"))
    x, y = ("first axis across", "second axis across") if in_space else ("forward", "up")
    friction = f"on the journal, along t (n turned by +90 degrees){every}"
    centre = "journal's centre from the bore's"
    rows: list[Row] = [
        ("normal_force", "N", f"normal contact force{every}", _of("normal_force", _SUM)),
        ("friction_force", "N", friction, _of("friction_force", _SUM)),
        ("depth", "m", f"depth{largest}; negative: gap", _of("depth", _LARGEST)),
        ("slip", "m/s", f"slip of the journal's surface, along t{mean}", _of("slip", _MEAN)),
        ("impact_velocity", "m/s", f"{IMPACT}{largest}; 0 during separation", _of("impact_velocity", _LARGEST)),
        ("eccentricity_x", "m", f"{centre}, {x}", _of("eccentricity_x", _middle)),
        ("eccentricity_y", "m", f"{centre}, {y}", _of("eccentricity_y", _middle)),
    ]
    for place, edge in ((0, "left"), (-1, "right")) if in_space else ():
        here = itemgetter(place)
        where = f"{centre} at the {edge} edge"
        rows += [
            (f"{edge}_depth", "m", f"depth at the {edge} edge; negative: gap", _of("depth", here)),
            (f"{edge}_eccentricity_x", "m", f"{where}, {x}", _of("eccentricity_x", here)),
            (f"{edge}_eccentricity_y", "m", f"{where}, {y}", _of("eccentricity_y", here)),
        ]
    return table(f"pin.{name}", CONTACT, named("sections", name), rows)


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

    def __init__(self, guide: ClearanceGuide, name: str, slide: Slide, run: Trajectory) -> None:
        motion, parts = run.motion, guide.contacts()
        angle = slide.direction + motion.turn(slide.against)
        cos, sin = np.cos(angle), np.sin(angle)

        def along_and_across(x: Series, y: Series) -> Series:
            return np.array([cos * x + sin * y, cos * y - sin * x])

        contacts = [run.sections[f"{name}.{part}"][0] for part in parts]
        forces = [along_and_across(one.force_x, one.force_y) for one in contacts]
        middle, origin = (motion.place(*side) for side in slide.sides)
        arms, gaps = [], []
        for point, height, contact in parts.values():
            place = motion.place(slide.body, plus(slide.point, rotated(point, slide.direction)))
            off = along_and_across(*(place - origin).T)[1] - height  # from the middle line
            slot, radius = contact.bearing, contact.bearing.contact_arms(0.0)[1]
            gaps.append([slot.clearance - off, slot.clearance + off])
            x, y = along_and_across(*(place - middle).T)
            arms.append((x, y + np.sign(off) * radius))
        self.upper, self.lower = np.min(gaps, axis=0)
        self.tilt = motion.turn(slide.body) - motion.turn(slide.against)
        (rub, push), (x, y) = (np.moveaxis(np.array(one), 1, 0) for one in (forces, arms))
        normal = np.array([one.normal_force for one in contacts])
        self.force, self.friction = push.sum(axis=0), rub.sum(axis=0)
        self.moment = (x * push - y * rub).sum(axis=0)
        self.place = (x * normal).sum(axis=0) / np.maximum(normal.sum(axis=0), NO_FORCE)


_PLACE = "where the walls press, along the guide from its point on the body; 0 during separation"
_BLOCK_ROWS: tuple[Row, ...] = (
    ("gap_upper", "m", "least distance from the upper wall; negative: depth", attrgetter("upper")),
    ("gap_lower", "m", "least distance from the lower wall; negative: depth", attrgetter("lower")),
    ("tilt", "rad", "angle against the guide, 0 at the start", attrgetter("tilt")),
    ("force", "N", "of the guide on the body, across, to the upper side", attrgetter("force")),
    ("friction_force", "N", "of the guide on the body, along its direction", attrgetter("friction")),
    ("moment", "N m", "of the guide on the body, about the guide's point", attrgetter("moment")),
    ("place", "m", _PLACE, attrgetter("place")),
)
_CORNER_FRICTION = "on the body, along t (to the left at the upper wall, to the right at the lower)"
_CORNER_ROWS: tuple[Row, ...] = (
    ("gap", "m", "distance from the nearer wall; negative: depth", lambda sections: -sections[0].depth),
    ("normal_force", "N", "normal contact force", _of("normal_force", _SUM)),
    ("friction_force", "N", _CORNER_FRICTION, _of("friction_force", _SUM)),
    ("slip", "m/s", "slip of the body's surface, along t", _of("slip", _SUM)),
    ("impact_velocity", "m/s", f"{IMPACT}; 0 during separation", _of("impact_velocity", _SUM)),
)


@guide_channels.register
def _of_clearance_guide(guide: ClearanceGuide, name: str, slide: Slide) -> ChannelDefinitions:
    found = table(f"guide.{name}", CONTACT, partial(_Block, guide, name, slide), _BLOCK_ROWS)
    for part, contact in guide.contacts().items():
        corner = f"{name}.{part}"
        rows = [*_CORNER_ROWS, *[_STATE] * contact.contact.friction.has_state]
        found |= table(f"guide.{corner}", CONTACT, named("sections", corner), rows)
    return found
