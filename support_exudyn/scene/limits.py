"""Limits that all formulations share."""

import math
import sys
from collections.abc import Mapping

from support_exudyn.scenario.scenario import Scenario
from user_forces.journal import ContactGeometry

# Depth of a journal as a share of the bore's radius, or of half a slot's height. Laws and geometry are those of
# small depths; the reference support meets 1 % of it.
DEEPEST = 0.2

SOFT = (
    "The contact is too soft for the load that it meets: take a larger stiffness, or a smaller load. If both "
    "are as they should be, shorter steps."
)


def too_deep(pin: str, depth: float, bearing: ContactGeometry) -> str:
    """What to say of a journal that is too deep in its bore."""
    return (
        f"the journal of {pin} is {1e3 * depth:.3g} mm deep in {bearing.words}; "
        f"allowed: up to {DEEPEST:.0%} of it"
    )


ENDS = "Close its inlet earlier, open it less, or take a longer cylinder."


def past_ends(scenario: Scenario, lengths: Mapping[str, float]) -> str:
    """The message on a piston beyond an end of its cylinder; empty if none is.

    lengths: of actuators [m], by name; cylinders without a length are not checked.
    """
    starts = {name: one.start_length for name, one in scenario.linkage.actuators.items()}
    known = ((name, one) for name, one in scenario.valved.items() if name in lengths)
    messages = (one.past_end(lengths[name] - starts[name], name) for name, one in known)
    return next(filter(None, messages), "")


ROUNDINGS = 20.0  # of the largest coordinate, that forces of the support show below steps of 2e-5 s


def rounding_of_positions(scenario: Scenario) -> float:
    """What rounding leaves in the positions that constraints hold [m], as forces show it: R size epsilon."""
    size = max(math.hypot(*body.centre) for body in scenario.linkage.bodies.values())
    return ROUNDINGS * size * sys.float_info.epsilon
