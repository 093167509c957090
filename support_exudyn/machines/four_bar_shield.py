r"""A shield beam on two links with a canopy on its hinge: what all four-bar shield supports have in common.

        I___________________T      canopy, on the shield's hinge I, with its tip T
       /
    D /                            two cylinders, or pairs of them, fix the posture: which and where is the
    C*----.                        machine's own affair
     \     \                       shield beam C-D-I with tail beam
      \     \                      rear link B-C, front link A-D
       B      A
    ===================== base (ground)

x forward (towards the coal face), y up, both sides lumped into one plane. The four-bar has one degree of
freedom and the canopy on its hinge another.
"""

import math
from abc import ABC
from dataclasses import replace

import numpy as np

from support_exudyn.machines.shield_layout import PINS as PINS
from support_exudyn.machines.shield_layout import Posture, ShieldLayout
from support_exudyn.model.linkage import GROUND, Crank, Linkage
from support_exudyn.model.plane_geometry import minus
from user_forces.values.value import Vector2

PRECISE = 1e-11  # [m] to which lengths of columns are met
MOST_CORRECTIONS = 20  # of Newton's method; five do
LOCKED = 1e-12  # [m^2], [m] determinant of the columns' rates at which they hold nothing any more
LONGEST_STEP = 0.2  # [rad] from one posture to the next, so that it is not taken for one behind a dead centre
USUAL_STROKE = 0.3  # of the shortest column
FARTHEST_SEARCH = 2.0 * LONGEST_STEP  # [rad]


class FourBarShield(ShieldLayout, ABC):
    """Motion of four-bar shield supports, in closed form; a kind of them adds fields and columns."""

    def link_rates(self, posture: Posture) -> tuple[float, Vector2]:
        """How fast the shield beam turns, and the hinge's velocity [m/s], if the rear link turns by 1 rad/s.

        Infinite at a dead centre, where the front link lies along the shield beam's line from C to D.
        """
        c, d, i = posture.rear_shield, posture.front_shield, posture.hinge
        speed = _turning(minus(c, self.rear_base))
        link, across = minus(d, self.front_base), _turning(minus(d, c))
        lever = across[0] * link[0] + across[1] * link[1]
        push = speed[0] * link[0] + speed[1] * link[1]
        spin = -push / lever if lever != 0.0 else math.copysign(math.inf, -push)
        arm = _turning(minus(i, c))
        return spin, (speed[0] + spin * arm[0], speed[1] + spin * arm[1])

    def column_rates(self, posture: Posture) -> np.ndarray:
        """Derivatives of the columns' lengths by the turns of rear link and canopy, (2, 2) [m/rad]."""
        spin, hinge = self.link_rates(posture)

        def speeds(body: str, pivot: str) -> tuple[Vector2, Vector2]:
            """Velocities of a pivot as the rear link turns, and as the canopy does."""
            where = self.place(body, pivot, posture)
            if body == GROUND:
                return (0.0, 0.0), (0.0, 0.0)
            arm = _turning(minus(where, posture.hinge))
            if body == "canopy":
                return hinge, arm
            return (hinge[0] + spin * arm[0], hinge[1] + spin * arm[1]), (0.0, 0.0)

        rates = np.empty((2, 2))
        for row, strut in enumerate(self.STRUTS.values()):
            way = np.subtract(self.place(*strut.head, posture), self.place(*strut.foot, posture))
            along = way / np.hypot(*way)
            for column, (foot, head) in enumerate(zip(speeds(*strut.foot), speeds(*strut.head), strict=True)):
                rates[row, column] = along @ np.subtract(head, foot)
        return rates

    def extended(self, extension: float, near: Posture | None = None) -> Posture | None:
        """Posture with the driven columns longer than at the start by `extension` [m]; None if there is none.

        Newton's method in the turns of rear link and canopy. A column that follows another is left out, and the
        canopy keeps level.

        near: a posture from which the search starts, the start by default; steps of some centimetres are safe.
        """
        near, unknowns = near or self.start(), len(self.alike)
        wanted = np.add(self.column_lengths(self.start()), extension)
        posture, last = near, False
        for _ in range(MOST_CORRECTIONS):
            rates = self.column_rates(posture)[:unknowns, :unknowns]
            if not np.isfinite(rates).all() or abs(np.linalg.det(rates)) < LOCKED:
                return None
            short = np.subtract(wanted, self.column_lengths(posture))[:unknowns]
            step = np.zeros(2)
            step[:unknowns] = np.linalg.solve(rates, short)
            step *= min(1.0, LONGEST_STEP / max(float(np.abs(step).max()), LONGEST_STEP))
            following = self.posture(posture.rear_link + float(step[0]), posture.canopy + float(step[1]))
            if following is None or abs(following.rear_link - near.rear_link) > FARTHEST_SEARCH:
                return None
            posture = following
            if last:
                return posture
            last = float(np.abs(short).max()) < PRECISE  # a further correction leaves rounding
        return None

    @property
    def alike(self) -> tuple[str, ...]:
        """Columns that extend alike in use; the others follow them."""
        return tuple(name for name in self.STRUTS if name not in self.leaders)

    @property
    def shortest_column(self) -> float:
        """Length of the shortest column at the start [m]."""
        return min(self.column_lengths(self.start()))

    @property
    def usual_stroke(self) -> float:
        """The stroke that is taken where none is known [m]."""
        return USUAL_STROKE * self.shortest_column

    def led_linkage(self) -> Linkage:
        """The mechanism as columns move it that extend alike: a level canopy in place of those that follow."""
        linkage = self.linkage()
        if not self.leaders:
            return linkage
        actuators = {name: one for name, one in linkage.actuators.items() if name not in self.leaders}
        return replace(linkage, actuators=actuators, cranks={"canopy": Crank(body="canopy")})


def _turning(arm: Vector2) -> Vector2:
    """Velocity of a point on this arm as it turns by 1 rad/s."""
    return -arm[1], arm[0]
