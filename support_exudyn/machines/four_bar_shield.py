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
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Generic

import numpy as np

from support_exudyn.machines.drive_path import check_path
from support_exudyn.machines.shield_layout import PINS as PINS
from support_exudyn.machines.shield_layout import P, ShieldLayout
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.linkage import GROUND
from support_exudyn.model.plane_geometry import minus
from user_forces.values.value import InputError, Vector2

PRECISE = 1e-11  # [m] to which lengths of columns are met
MOST_CORRECTIONS = 20  # of Newton's method; four do
LOCKED = 1e-12  # [m^2] determinant of the columns' rates at which they hold nothing any more
MOST_REMEMBERED = 64
REMEMBERED = ("_closing", "_followed", "_known", "_linkage")  # what machines remember beside their fields
LONGEST_STEP = 0.2  # [rad] from one posture to the next, so that it is not taken for one behind a dead centre


class FourBarShield(ShieldLayout[P], ABC, Generic[P]):
    """Motion of four-bar shield supports, in closed form; a kind of them adds fields and columns."""

    def link_rates(self, posture: P) -> tuple[float, Vector2]:
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

    def column_rates(self, posture: P) -> np.ndarray:
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

    def reached(self, lengths: Sequence[float], near: P) -> P | None:
        """Posture with these lengths of its columns [m], searched for from one close to it; None if none."""
        posture: P | None = near
        for _ in range(MOST_CORRECTIONS):
            if posture is None or float(np.abs(self._short(lengths, posture)).max()) < PRECISE:
                return posture
            posture = self.corrected(lengths, posture)
        return None

    def corrected(self, lengths: Sequence[float], near: P) -> P | None:
        """Posture a step of Newton's method nearer to these lengths of its columns [m]; None if none."""
        rates = self.column_rates(near)
        if not np.isfinite(rates).all() or abs(np.linalg.det(rates)) < LOCKED:
            return None
        step = np.linalg.solve(rates, self._short(lengths, near))
        if float(np.abs(step).max()) > LONGEST_STEP:
            return None
        return self.posture(near.rear_link + float(step[0]), near.canopy + float(step[1]))

    def _short(self, lengths: Sequence[float], posture: P) -> np.ndarray:
        """By how much the columns are shorter than these lengths [m]."""
        return np.subtract(lengths, self.column_lengths(posture))

    @abstractmethod
    def extended(self, extension: float, near: P | None = None) -> P | None:
        """Posture with the driven columns longer than at the start by `extension` [m]; None if there is none.

        `near`: a posture to search from, the start by default; steps of some centimetres are safe.
        """

    def check_extension(self, lowest: float, highest: float) -> None:
        """Raise InputError unless the columns close the linkage from `lowest` to `highest` [m]."""
        if (lowest, highest) in self._closing:
            return
        for goal in (lowest, highest):
            reached, posture, step = 0.0, self.start(), math.copysign(0.02, goal)
            while reached != goal:
                target = reached + step
                if abs(target) > abs(goal):
                    target = goal
                following = self.extended(target, posture)
                if following is not None and abs(following.rear_link - posture.rear_link) < LONGEST_STEP:
                    reached, posture = target, following
                elif abs(step) > 1e-4:
                    step /= 2.0
                else:
                    raise InputError(
                        f"column extension = {goal} m: the columns cannot close the linkage there; "
                        f"allowed: up to {reached:.3f} m from the start posture"
                    )
        self._closing.add((lowest, highest))

    @cached_property
    def _closing(self) -> set[tuple[float, float]]:
        """Ranges of extension that have been found to close; scenarios ask again and again."""
        return set()

    def check_motion(self, drives: Mapping[str, Drive], duration: float) -> None:
        """Raise InputError if the columns cannot follow their drives, by name; says which one, and when.

        Where a column follows no drive, such as a cylinder with an inlet, the posture is not known beforehand.
        """
        if not self.STRUTS.keys() <= drives.keys():
            return
        if any(known == (drives, duration) for known in self._followed):
            return
        lead = drives[self.alike[0]]
        if all(drives[name] == lead for name in self.alike) and self._follow(drives, duration):
            self.check_extension(*lead.span(duration))
        else:
            start = self.start()
            lengths = dict(zip(self.STRUTS, self.column_lengths(start), strict=True))
            check_path(start, lengths, self.reached, drives, duration)
        if len(self._followed) == MOST_REMEMBERED:
            self._followed.clear()
        self._followed.append((dict(drives), duration))

    def _follow(self, drives: Mapping[str, Drive], duration: float) -> bool:
        """Whether the columns that follow others are driven as they would follow."""
        try:
            return all(
                drives[name] == self.coupled_drive(name, drives[leader], duration)
                for name, leader in self.leaders.items()
            )
        except InputError:  # nothing can follow so far
            return False

    @property
    def alike(self) -> tuple[str, ...]:
        """Columns that `extended` extends alike."""
        return tuple(name for name in self.STRUTS if name not in self.leaders)

    @cached_property
    def _followed(self) -> list[tuple[dict[str, Drive], float]]:
        """Drives that have been found to be followed, and for how long; scenarios ask again and again."""
        return []

    def __getstate__(self) -> dict[str, Any]:
        """What is sent to another process: all but what is only remembered, which may be much.

        A copy, for it may be sent while another thread goes on to remember.
        """
        state = dict(self.__dict__)
        for name in REMEMBERED:
            state.pop(name, None)
        return state


def _turning(arm: Vector2) -> Vector2:
    """Velocity of a point on this arm as it turns by 1 rad/s."""
    return -arm[1], arm[0]
