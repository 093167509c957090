r"""A four-bar shield support on four columns, both sides lumped into one plane.

        I___________________T      canopy, on the shield's hinge I, with its tip T
       /        G      E           columns: rear H-G, front F-E
    D /         |     /
    C*----.     |    /             shield beam C-D-I with tail beam
     \     \    |   /
      \     \   |  /               rear link B-C, front link A-D
       B      A  H  F
    ===================== base (ground)

x forward (towards the coal face), y up. With all pins ideal the two column lengths fix the posture:
the four-bar has one degree of freedom and the canopy on its hinge another.
"""

from collections.abc import Mapping
from typing import ClassVar

from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.shield_layout import BODIES, TAIL, Posture, ShieldColumn
from support_exudyn.model.linkage import GROUND
from user_forces.values.units import Metres
from user_forces.values.value import Vector2, value

__all__ = ["BODIES", "PIVOTS", "TAIL", "HydraulicSupport", "Posture"]


@value
class HydraulicSupport(FourBarShield):
    """Pivots, parts and start height of a four-column shield support.

    Arguments: those of `FourBarShield`, and in the same reference posture
        front_foot, front_head: F and E, ends of the front column [m].
        rear_foot, rear_head: H and G, ends of the rear column [m].
    """

    STRUTS: ClassVar[Mapping[str, ShieldColumn]] = {
        "front_column": ShieldColumn(foot=(GROUND, "front_foot"), head=("canopy", "front_head")),
        "rear_column": ShieldColumn(foot=(GROUND, "rear_foot"), head=("canopy", "rear_head")),
    }

    front_foot: Metres[Vector2]
    front_head: Metres[Vector2]
    rear_foot: Metres[Vector2]
    rear_head: Metres[Vector2]


PIVOTS = HydraulicSupport.pivots()
