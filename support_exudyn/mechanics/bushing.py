"""A bushing at the records of a run: its force and moment from the motion of its bodies, and its channels."""

from collections.abc import Callable

import numpy as np

from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.channels import CONTACT, ChannelDefinition, ChannelDefinitions, EvaluationContext
from support_exudyn.mechanics.pin_channels import force_channels, pin_channels
from support_exudyn.mechanics.trajectory import CompliantSeries, Series
from support_exudyn.model.bushing_pin import BushingPin
from support_exudyn.model.linkage import PinPlace


def bushing_series(pin: BushingPin, place: PinPlace, motion: BodyMotion) -> CompliantSeries:
    """The bushing at a place of the linkage, over the motion of all bodies; see `BushingPin`."""
    first = motion.point(place.first, place.first_point)
    second = motion.point(place.second, place.second_point)
    deflection = second.position - first.position
    rate = second.velocity - first.velocity
    angle = motion.turn(place.second) - motion.turn(place.first)
    turning = pin.rotational_stiffness * angle + pin.rotational_damping * (second.spin - first.spin)
    stored = 0.5 * (deflection**2 @ np.array(pin.stiffness) + pin.rotational_stiffness * angle**2)
    force = np.array(pin.stiffness) * deflection + np.array(pin.damping) * rate
    return CompliantSeries(-force, -turning, deflection, angle, stored)


@pin_channels.register
def _of_bushing(pin: BushingPin, name: str) -> ChannelDefinitions:
    del pin

    def said(
        what: str, unit: str, meaning: str, values: Callable[[CompliantSeries], Series]
    ) -> ChannelDefinitions:
        definition = ChannelDefinition(
            unit, meaning, CONTACT, lambda context: values(context.run.compliant_pins[name])
        )
        return {f"pin.{name}.{what}": definition}

    def force(context: EvaluationContext) -> tuple[Series, Series]:
        fx, fy = context.run.compliant_pins[name].force.T
        return fx, fy

    found = force_channels(name, CONTACT, force)
    found |= said("moment", "N m", "of the first body on the second", lambda b: b.moment)
    found |= said("deflection", "m", "distance of both bodies' points", lambda b: np.hypot(*b.deflection.T))
    found |= said("deflection_x", "m", "second body's point from the first's, forward", _along(0))
    found |= said("deflection_y", "m", "second body's point from the first's, up", _along(1))
    return found | said("angle", "rad", "turn of the second body against the first", lambda b: b.angle)


def _along(axis: int) -> Callable[[CompliantSeries], Series]:
    return lambda bushing: bushing.deflection[:, axis]
