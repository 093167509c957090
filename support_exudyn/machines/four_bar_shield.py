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

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar, Generic, NamedTuple, Protocol, TypeVar

import numpy as np
from typing_extensions import Self

from support_exudyn.machines.drive_path import check_path
from support_exudyn.machines.shield_layout import BODIES, TAIL, TAIL_PLACES, laid_out
from support_exudyn.model.drives.drive import Drive
from support_exudyn.model.lateral_dimensions import Width
from support_exudyn.model.linkage import GROUND, Linkage, Part, lumped
from support_exudyn.model.machine import Machine
from support_exudyn.model.plane_geometry import circle_intersection, direction, distance, minus, moved, side
from user_forces.expressions.roots import bracketed_root
from user_forces.values.value import InputError, Vector2

PINS = ("rear_base", "front_base", "rear_shield", "front_shield", "shield_canopy")
FRAME = ("rear_base", "front_base", "rear_shield", "front_shield", "hinge", "tip")  # pivots of all of them
FARTHEST = 1000.0  # [m] from the origin
PRECISE = 1e-11  # [m] to which lengths of columns are met
MOST_CORRECTIONS = 20  # of Newton's method; four do
LOCKED = 1e-12  # [m^2] determinant of the columns' rates at which they hold nothing any more
MOST_REMEMBERED = 64
REMEMBERED = ("_closing", "_followed", "_known")  # what values of machines remember beside their fields
LONGEST_STEP = 0.2  # [rad] from one posture to the next, so that it is not taken for one behind a dead centre


class ShieldPosture(Protocol):
    """Where everything is with ideal pins. Angles [rad] are turns from the reference posture, points in m."""

    @property
    def rear_link(self) -> float:
        """Turn of the rear link."""

    @property
    def front_link(self) -> float:
        """Turn of the front link."""

    @property
    def shield(self) -> float:
        """Turn of the shield beam."""

    @property
    def canopy(self) -> float:
        """Turn of the canopy."""

    @property
    def rear_shield(self) -> Vector2:
        """C."""

    @property
    def front_shield(self) -> Vector2:
        """D."""

    @property
    def hinge(self) -> Vector2:
        """I."""

    @property
    def tip(self) -> Vector2:
        """T."""


P = TypeVar("P", bound=ShieldPosture)


class Strut(NamedTuple):
    """A column of a support: the bodies of its foot and its head, each with the name of the pivot on it."""

    foot: tuple[str, str]
    head: tuple[str, str]


class FourBarShield(Machine, ABC, Generic[P]):
    """Closed-form kinematics and layout of four-bar shield supports; a kind of them adds fields and columns.

    The names below are fields of every kind, see there. `STRUTS`: its two columns by name.
    """

    STRUTS: ClassVar[Mapping[str, Strut]]

    rear_base: Vector2
    front_base: Vector2
    rear_shield: Vector2
    front_shield: Vector2
    hinge: Vector2
    tip: Vector2
    parts: Mapping[str, tuple[Part, ...]]
    start_hinge_height: float
    width: Width | None
    tail_hinge: Vector2 | None
    tail_jack_foot: Vector2 | None
    tail_jack_head: Vector2 | None

    @classmethod
    def pivots(cls) -> tuple[str, ...]:
        """Names of all its pivots, those of the tail beam last, which may be missing."""
        feet = [place for strut in cls.STRUTS.values() for _, place in strut]
        return (*FRAME[:-1], *feet, FRAME[-1], *TAIL_PLACES)

    def check(self) -> Self:
        """Itself. Raises ValueError if it cannot be built: the rest of what its fields are checked for."""
        for name in self.pivots():
            if max(map(abs, getattr(self, name) or (0.0,))) > FARTHEST:
                raise ValueError(
                    f"{name} = {getattr(self, name)} m: allowed: from {-FARTHEST:g} to {FARTHEST:g} m "
                    "(is it given in mm?)"
                )
        if sorted(self.parts) != sorted(BODIES):
            raise ValueError(f"parts = {sorted(self.parts)}: allowed: exactly {', '.join(BODIES)}")
        for name, parts in self.parts.items():
            if not parts:
                raise ValueError(f"parts.{name} = (): allowed: at least one part")
            if lumped(parts).inertia <= 0.0:
                raise ValueError(f"parts.{name}: total inertia is 0 kg m^2; allowed: > 0")
        if self.width is not None:
            self._check_width(self.width)
        try:
            self.start()
        except InputError as error:
            raise ValueError(str(error)) from None
        return self

    def _check_width(self, width: Width) -> None:
        columns = tuple(self.STRUTS)
        known = {
            "spreads": (*BODIES, TAIL, *(f"{name}_{part}" for name in columns for part in ("cylinder", "rod"))),
            "pairs": ("front_link",),
            "columns": columns,
            "lengths": (*PINS, "shield_tail"),
            "points": ("tip",),
        }
        for kind, names in known.items():
            for name in getattr(width, kind):
                if name not in names:
                    raise ValueError(f"width.{kind}.{name}: there is none; allowed: {', '.join(names)}")

    # --- posture, closed form ---

    def four_bar(self, rear_link: float) -> tuple[Vector2, Vector2, Vector2] | None:
        """C, D and I for a turn of the rear link [rad]; None where the four-bar does not close.

        D is where the circles of the front link about A and of the shield beam about C meet, on the
        same side of CA as in the reference posture.
        """
        c = moved(self.rear_shield, self.rear_base, self.rear_base, rear_link)
        which = side(self.rear_shield, self.front_base, self.front_shield)
        d = circle_intersection(
            c,
            distance(self.rear_shield, self.front_shield),
            self.front_base,
            distance(self.front_base, self.front_shield),
            which,
        )
        if d is None:
            return None
        turned = turn(direction(self.rear_shield, self.front_shield), direction(c, d))
        return c, d, moved(self.hinge, self.rear_shield, c, turned)

    @abstractmethod
    def posture(self, rear_link: float, canopy: float) -> P | None:
        """Posture for turns of rear link and canopy [rad]; None where the four-bar does not close."""

    def start(self) -> P:
        """Posture with a level canopy and the hinge at its start height.

        Raises InputError with the reachable range if the linkage does not go there.
        """
        return self._start

    @cached_property
    def _start(self) -> P:
        turns = np.radians(np.linspace(-60.0, 60.0, 241))
        heights = np.array([closed[2][1] if (closed := self.four_bar(t)) else math.nan for t in turns])
        if np.isnan(heights).all():
            raise InputError(
                f"front_base = {self.front_base}, front_shield = {self.front_shield} m: the four-bar does not "
                "close within 60 degrees of the posture in which its pivots are given; allowed: links that "
                "reach each other"
            )
        excess = heights - self.start_hinge_height
        crossings = np.flatnonzero(np.sign(excess[:-1]) * np.sign(excess[1:]) <= 0.0)
        if crossings.size == 0:
            raise InputError(
                f"start_hinge_height = {self.start_hinge_height} m: the four-bar cannot bring the hinge there; "
                f"allowed: {np.nanmin(heights):.4f} to {np.nanmax(heights):.4f} m"
            )
        near = crossings[np.argmin(np.abs(turns[crossings]))]

        def height_error(turn: float) -> float:
            closed = self.four_bar(turn)
            return closed[2][1] - self.start_hinge_height if closed else math.nan

        try:
            turned = bracketed_root(height_error, float(turns[near]), float(turns[near + 1]), xtol=1e-15)
        except ValueError:  # it opens between both, or its heights are rounding
            turned = math.nan
        found = None if math.isnan(turned) else self.posture(turned, 0.0)
        if found is None:
            raise InputError(
                f"start_hinge_height = {self.start_hinge_height} m: the four-bar opens next to that posture; "
                "allowed: heights farther from where it locks"
            )
        return found

    def place(self, body: str, pivot: str, posture: P) -> Vector2:
        """Where a pivot of a body, or of the ground, is in a posture [m]."""
        point: Vector2 = getattr(self, pivot)
        if body == GROUND:
            return point
        if body == "canopy":
            return moved(point, self.hinge, posture.hinge, posture.canopy)
        assert body == "shield"  # columns stand on nothing else
        return moved(point, self.rear_shield, posture.rear_shield, posture.shield)

    def column_lengths(self, posture: P) -> tuple[float, float]:
        """Lengths [m] of its columns, in the order of `STRUTS`."""
        first, second = (
            distance(self.place(*strut.foot, posture), self.place(*strut.head, posture))
            for strut in self.STRUTS.values()
        )
        return first, second

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
        posture, turns = near, np.array([near.rear_link, near.canopy])
        for _ in range(MOST_CORRECTIONS):
            misfit = np.subtract(lengths, self.column_lengths(posture))
            if float(np.abs(misfit).max()) < PRECISE:
                return posture
            rates = self.column_rates(posture)
            if not np.isfinite(rates).all() or abs(np.linalg.det(rates)) < LOCKED:
                return None
            step = np.linalg.solve(rates, misfit)
            if float(np.abs(step).max()) > LONGEST_STEP:
                return None
            turns = turns + step
            found = self.posture(float(turns[0]), float(turns[1]))
            if found is None:
                return None
            posture = found
        return None

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
            check_path(self, drives, duration)
        if len(self._followed) == MOST_REMEMBERED:
            self._followed.clear()
        self._followed.append((dict(drives), duration))

    def _follow(self, drives: Mapping[str, Drive], duration: float) -> bool:
        """Whether the columns that follow others are driven as they would follow."""
        try:
            return all(
                drives[name] == self.follower(name, drives[leader], duration)
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

    # --- layout ---

    def widths(self) -> Width | None:
        """Its lateral dimensions, if they are known."""
        return self.width

    def linkage(self) -> Linkage:
        """The support as four moving bodies, five pins, two columns and the canopy tip."""
        return self.detailed((), ())

    @property
    def jacks(self) -> Mapping[str, str]:
        """The tail beam's."""
        return {TAIL: "tail_jack"}

    def detailed(self, columns: Collection[str], parts: Collection[str]) -> Linkage:
        """The same without the parts that stand for the mass of columns, and with the tail beam as a body.

        Raises InputError if nothing is left of a body, or data of the tail beam are missing.
        """
        return laid_out(self, columns, parts)


def turn(before: float, after: float) -> float:
    """Smallest turn [rad] from one direction to another."""
    return math.remainder(after - before, 2.0 * math.pi)


def _turning(arm: Vector2) -> Vector2:
    """Velocity of a point on this arm as it turns by 1 rad/s."""
    return -arm[1], arm[0]
