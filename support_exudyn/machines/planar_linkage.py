r"""A machine that is nothing but its drawing: bodies on pins, in guides, on actuators, cranks and gears.

B
.-------.       every body has points of its own; a pin joins two bodies at a point, a guide leads a point
A  /  coupler `-.   or a block along a line, an actuator holds two points apart, a crank turns a body
o'              o C
| crank         | rocker
_o_ O           _o_ D
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from support_exudyn.model.linkage import Linkage
from support_exudyn.model.loads.load import ActingLoad
from support_exudyn.model.machine import Machine
from support_exudyn.model.to_space import Width
from user_forces.values.units import Metres
from user_forces.values.value import Positive, value


@value
class PlanarLinkage(Machine):
    """Any planar linkage, as files of `kind = "linkage"` describe it.

    Arguments:
        drawing: the mechanism in its start posture.
        acting: what acts on it besides its weight: springs, dampers, torques, forces, by name.
        pin_lengths: of the contact in pins, along their axes [m], by pin; where it is known.
    """

    drawing: Linkage
    acting: Mapping[str, ActingLoad] = field(default_factory=dict)
    pin_lengths: Mapping[str, Metres[Positive]] = field(default_factory=dict)

    def linkage(self) -> Linkage:
        """The mechanism in its start posture."""
        return self.drawing

    @property
    def loads(self) -> Mapping[str, ActingLoad]:
        """What acts on it besides its weight, by name."""
        return self.acting

    def widths(self) -> Width | None:
        """The lengths of its pins, which are all that is known across its plane; None if none is."""
        return Width(lengths=self.pin_lengths) if self.pin_lengths else None
