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

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from support_exudyn.machines.four_bar_shield import PRECISE, FourBarShield
from support_exudyn.machines.shield_layout import BODIES, TAIL, ShieldColumn, ShieldPosture
from support_exudyn.model.linkage import GROUND
from user_forces.values.units import Metres
from user_forces.values.value import Vector2, value

__all__ = ["BODIES", "PIVOTS", "TAIL", "HydraulicSupport", "Posture"]


@dataclass(frozen=True)
class Posture(ShieldPosture):
    """Where everything is with ideal pins, the moving ends of the columns too."""

    front_head: Vector2  # E [m]
    rear_head: Vector2  # G


@value
class HydraulicSupport(FourBarShield[Posture]):
    """Pivots, parts and start height of a four-column shield support.

    Arguments: those of `ShieldLayout`, and in the same reference posture
        front_foot, front_head: F and E, ends of the front column [m].
        rear_foot, rear_head: H and G, ends of the rear column [m].
    """

    POSTURE: ClassVar[type[Posture]] = Posture
    STRUTS: ClassVar[Mapping[str, ShieldColumn]] = {
        "front_column": ShieldColumn(foot=(GROUND, "front_foot"), head=("canopy", "front_head")),
        "rear_column": ShieldColumn(foot=(GROUND, "rear_foot"), head=("canopy", "rear_head")),
    }

    front_foot: Metres[Vector2]
    front_head: Metres[Vector2]
    rear_foot: Metres[Vector2]
    rear_head: Metres[Vector2]

    def extended(self, extension: float, near: Posture | None = None) -> Posture | None:
        """Posture with both columns longer than at the start by `extension` [m]; None if there is none.

        `near`: a posture to search from, the start by default; steps of some centimetres are safe.
        """
        start = self.start()
        front, rear = (length + extension for length in self.column_lengths(start))
        near = near or start
        found = self.reached((front, rear), near)
        exact = found and self.corrected((front, rear), found)  # to rounding
        return exact or self._searched(front, rear, near)

    def _searched(self, front: float, rear: float, near: Posture) -> Posture | None:
        """Posture with these lengths of its columns [m], where Newton's method does not lead to it."""
        from scipy.optimize import root  # slow to import

        def turned(by: np.ndarray) -> Posture | None:
            return self.posture(near.rear_link + float(by[0]), near.canopy + float(by[1]))

        def misfit(by: np.ndarray) -> list[float]:
            posture = turned(by)
            if posture is None:
                return [math.inf, math.inf]
            got = self.column_lengths(posture)
            return [got[0] - front, got[1] - rear]

        with np.errstate(invalid="ignore"):
            # MINPACK measures its first steps by where it starts: turns of a rounding would hold it there, from
            # exactly zero it goes as far as it likes
            found = root(misfit, [0.0, 0.0], tol=1e-14)
        if not np.all(np.abs(misfit(found.x)) < PRECISE):
            return None
        return turned(found.x)


PIVOTS = HydraulicSupport.pivots()
