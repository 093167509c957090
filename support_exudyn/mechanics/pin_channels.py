"""Channels of pins in the plane. A new kind of pin registers here what it has."""

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
from support_exudyn.model.pins import ClearancePin, IdealPin, Pin


@singledispatch
def pin_channels(pin: Pin, name: str) -> ChannelDefinitions:
    """The channels of a pin of this name, by name. Raises TypeError for a kind that has registered none."""
    raise TypeError(f"pins.{name} = {type(pin).__name__}: has no channels; see `mechanics.pin_channels`")


def force_channels(
    name: str, needs: DataNeeds, force: Callable[[EvaluationContext], tuple[Series, Series]]
) -> ChannelDefinitions:
    """The channels of a pin's force; force: of the first body on the second, x and y (n,) [N]."""

    def magnitude(context: EvaluationContext) -> Series:
        size: Series = np.hypot(*force(context))
        return size

    x, y = "force of the first body on the second, forward", "force of the first body on the second, up"
    return {
        f"pin.{name}.force": ChannelDefinition("N", "magnitude of the pin force", needs, magnitude),
        f"pin.{name}.force_x": ChannelDefinition("N", x, needs, lambda context: force(context)[0]),
        f"pin.{name}.force_y": ChannelDefinition("N", y, needs, lambda context: force(context)[1]),
    }


@pin_channels.register
def _of_ideal_pin(pin: IdealPin, name: str) -> ChannelDefinitions:
    def force(context: EvaluationContext) -> tuple[Series, Series]:
        fx, fy = context.run.ideal_pins[name].T
        return fx, fy

    found = force_channels(name, DataNeeds.JOINTS, force)
    if pin.friction is not None:
        found[f"pin.{name}.friction_moment"] = ChannelDefinition(
            "N m",
            "of friction on the second body",
            MOTION | DataNeeds.JOINTS,
            lambda context: context.run.friction_moments[name],
        )
    return found


@pin_channels.register
def _of_clearance_pin(pin: ClearancePin, name: str) -> ChannelDefinitions:
    sign = 1.0 if pin.bore == "first" else -1.0  # contacts know the force on the journal

    def force(context: EvaluationContext) -> tuple[Series, Series]:
        contact = context.run.contacts[name]
        return sign * contact.force_x, sign * contact.force_y

    def said(
        what: str, unit: str, meaning: str, values: Callable[[ContactSeries], Series]
    ) -> ChannelDefinitions:
        definition = ChannelDefinition(
            unit, meaning, CONTACT, lambda context: values(context.run.contacts[name])
        )
        return {f"pin.{name}.{what}": definition}

    found = force_channels(name, CONTACT, force)
    found |= said("normal_force", "N", "normal contact force", lambda c: c.normal_force)
    found |= said(
        "friction_force", "N", "on the journal, along t (n turned by +90 degrees)", lambda c: c.friction_force
    )
    found |= said("depth", "m", "depth; negative: gap", lambda c: c.depth)
    found |= said("slip", "m/s", "slip of the journal's surface, along t", lambda c: c.slip)
    found |= said(
        "impact_velocity", "m/s", "impact velocity that the laws are told; 0 apart", lambda c: c.impact_velocity
    )
    found |= said(
        "eccentricity_x", "m", "journal's centre from the bore's, forward", lambda c: c.eccentricity_x
    )
    found |= said("eccentricity_y", "m", "journal's centre from the bore's, up", lambda c: c.eccentricity_y)
    if pin.contact.friction.has_state:
        found |= said("deflection", "m", "state of the friction law", _deflection)
    return found


def _deflection(contact: ContactSeries) -> Series:
    assert contact.deflection is not None  # the law has a state
    return contact.deflection
