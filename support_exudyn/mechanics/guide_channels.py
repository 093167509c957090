"""Channels of guides in the plane. A new kind of guide registers here what it has."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch

import numpy as np

from support_exudyn.mechanics.channels import (
    CONTACT,
    MOTION,
    ChannelDefinition,
    ChannelDefinitions,
    DataNeeds,
    EvaluationContext,
)
from support_exudyn.mechanics.trajectory import ContactSeries, Series
from support_exudyn.model.guides import ClearanceGuide, Guide, IdealGuide
from support_exudyn.model.linkage import Slide
from support_exudyn.model.plane_geometry import plus, rotated

NO_FORCE = np.finfo(np.float64).tiny  # [N], so that nothing is divided by zero


@singledispatch
def guide_channels(guide: Guide, name: str, slide: Slide) -> ChannelDefinitions:
    """The channels of a guide of this name, by name. Raises TypeError for a kind that has registered none."""
    del slide
    raise TypeError(f"guides.{name} = {type(guide).__name__}: has no channels; see `mechanics.guide_channels`")


@guide_channels.register
def _of_ideal_guide(guide: IdealGuide, name: str, slide: Slide) -> ChannelDefinitions:
    del slide
    joints = DataNeeds.JOINTS
    found = {
        f"{name}.force": ChannelDefinition(
            "N",
            "magnitude of the guide's force, across it",
            joints,
            lambda context: context.run.slides[name][:, 0],
        ),
        f"{name}.moment": ChannelDefinition(
            "N m", "magnitude of the guide's moment", joints, lambda context: context.run.slides[name][:, 1]
        ),
    }
    if guide.friction is not None:
        found[f"{name}.friction_force"] = ChannelDefinition(
            "N",
            "of the guide on the body, along its direction",
            MOTION | joints,
            lambda context: context.run.friction_forces[name],
        )
    return found


class _Block:
    """What a guide with clearance does at the records: its corners, in the axes of the guide."""

    def __init__(self, guide: ClearanceGuide, name: str, slide: Slide, context: EvaluationContext) -> None:
        motion, run = context.motion, context.run
        angle = slide.direction + motion.turn(slide.against)
        along, across = np.cos(angle), np.sin(angle)
        middle = motion.place(slide.body, slide.point)
        origin = motion.place(slide.against, slide.point)
        parts = guide.contacts()
        self.tilt = motion.turn(slide.body) - motion.turn(slide.against)
        contacts = [run.contacts[f"{name}.{part}"] for part in parts]
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


@guide_channels.register
def _of_clearance_guide(guide: ClearanceGuide, name: str, slide: Slide) -> ChannelDefinitions:
    def said(
        what: str, unit: str, meaning: str, values: Callable[[_Block], Series], needs: DataNeeds = CONTACT
    ) -> ChannelDefinitions:
        definition = ChannelDefinition(
            unit, meaning, needs, lambda context: values(_Block(guide, name, slide, context))
        )
        return {f"guide.{name}.{what}": definition}

    found = said("gap_upper", "m", "least distance from the upper wall; negative: depth", lambda b: b.upper)
    found |= said("gap_lower", "m", "least distance from the lower wall; negative: depth", lambda b: b.lower)
    found |= said("tilt", "rad", "angle against the guide, 0 at the start", lambda b: b.tilt)
    found |= said(
        "force", "N", "of the guide on the body, across, to the upper side", lambda b: b.force.sum(axis=0)
    )
    found |= said(
        "friction_force", "N", "of the guide on the body, along its direction", lambda b: b.friction.sum(axis=0)
    )
    found |= said("moment", "N m", "of the guide on the body, about the guide's point", lambda b: b.moment)
    found |= said(
        "place",
        "m",
        "where the walls press, along the guide from its point on the body; 0 apart",
        lambda b: b.place,
    )
    for part, contact in guide.contacts().items():
        found |= _of_corner(name, part, contact.contact.friction.has_state)
    return found


def _of_corner(name: str, part: str, has_state: bool) -> ChannelDefinitions:
    def said(
        what: str, unit: str, meaning: str, values: Callable[[ContactSeries], Series]
    ) -> ChannelDefinitions:
        definition = ChannelDefinition(
            unit, meaning, CONTACT, lambda context: values(context.run.contacts[f"{name}.{part}"])
        )
        return {f"guide.{name}.{part}.{what}": definition}

    found = said("gap", "m", "distance from the nearer wall; negative: depth", lambda c: -c.depth)
    found |= said("normal_force", "N", "normal contact force", lambda c: c.normal_force)
    found |= said(
        "friction_force",
        "N",
        "on the body, along t (to the left at the upper wall, to the right at the lower)",
        lambda c: c.friction_force,
    )
    found |= said("slip", "m/s", "slip of the body's surface, along t", lambda c: c.slip)
    found |= said(
        "impact_velocity", "m/s", "impact velocity that the laws are told; 0 apart", lambda c: c.impact_velocity
    )
    if has_state:
        found |= said("deflection", "m", "state of the friction law", _deflection)
    return found


def _deflection(contact: ContactSeries) -> Series:
    assert contact.deflection is not None  # the law has a state
    return contact.deflection
