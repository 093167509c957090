r"""A four-bar shield support, both sides lumped into one plane.

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

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from pydantic import model_validator

from support_exudyn.machine import (
    GROUND,
    Body,
    Column,
    Linkage,
    Machine,
    Part,
    TracePoint,
    lumped,
    pinned,
    turned_moments,
)
from support_exudyn.plane import circle_intersection, direction, distance, moved, side
from support_exudyn.width import Width
from user_forces.quantity import Metres
from user_forces.roots import bracketed_root
from user_forces.values import InputError, Positive, Vector2, value

if TYPE_CHECKING:
    from support_exudyn.drawing.solid import Look
    from support_exudyn.scenario import Scenario

PINS = ("rear_base", "front_base", "rear_shield", "front_shield", "shield_canopy")
BODIES = ("rear_link", "front_link", "shield", "canopy")
TAIL = "tail_beam"  # part of the shield, and the body that it can be
TAIL_PLACES = ("tail_hinge", "tail_jack_foot", "tail_jack_head")
PIVOTS = (
    *("rear_base", "front_base", "rear_shield", "front_shield", "hinge", "front_foot", "front_head"),
    *("rear_foot", "rear_head", "tip", *TAIL_PLACES),
)
FARTHEST = 1000.0  # [m] from the origin
RODS = "_rods"  # after a column's name: parts that stand for its mass as long as it has none


class Posture(NamedTuple):
    """Where everything is with ideal pins. Angles [rad] are turns from the reference posture."""

    rear_link: float
    front_link: float
    shield: float
    canopy: float
    rear_shield: Metres[Vector2]  # C [m]
    front_shield: Metres[Vector2]  # D
    hinge: Metres[Vector2]  # I
    front_head: Metres[Vector2]  # E
    rear_head: Metres[Vector2]  # G
    tip: Metres[Vector2]


@value
class HydraulicSupport(Machine):
    """Pivots, parts and start height of a four-column shield support.

    Arguments:
        rear_base, front_base: B and A, pivots of rear and front link on the base [m].
        rear_shield, front_shield: C and D, pivots of the links on the shield beam.
        hinge: I, shield beam on canopy.
        front_foot, front_head: F and E, ends of the front column.
        rear_foot, rear_head: H and G, ends of the rear column.
        tip: foremost point of the canopy.
        tail_hinge: tail beam on shield beam.
        tail_jack_foot, tail_jack_head: ends of the tail beam's jack, on the shield beam and on the tail beam;
            these and the hinge are only needed where the tail beam is a body of its own.
            All of these in one reference posture.
        parts: for each of rear_link, front_link, shield and canopy the parts it is made of, in the
            reference posture. Those named COLUMN_rods stand for a massless column's mass; that named tail_beam,
            of the shield, can be a body of its own.
        start_hinge_height: y of the hinge at the start [m], with the canopy level.
        width: lateral dimensions, for the spatial model; None: there are none.
    """

    rear_base: Metres[Vector2]
    front_base: Metres[Vector2]
    rear_shield: Metres[Vector2]
    front_shield: Metres[Vector2]
    hinge: Metres[Vector2]
    front_foot: Metres[Vector2]
    front_head: Metres[Vector2]
    rear_foot: Metres[Vector2]
    rear_head: Metres[Vector2]
    tip: Metres[Vector2]
    parts: Mapping[str, tuple[Part, ...]]
    start_hinge_height: Metres[Positive]
    width: Width | None = None
    tail_hinge: Metres[Vector2] | None = None
    tail_jack_foot: Metres[Vector2] | None = None
    tail_jack_head: Metres[Vector2] | None = None

    @model_validator(mode="after")
    def _can_be_built(self) -> HydraulicSupport:
        for name in PIVOTS:
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
        columns = ("front_column", "rear_column")
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
        turn = _turn(direction(self.rear_shield, self.front_shield), direction(c, d))
        return c, d, moved(self.hinge, self.rear_shield, c, turn)

    def posture(self, rear_link: float, canopy: float) -> Posture | None:
        """Posture for turns of rear link and canopy [rad]; None where the four-bar does not close."""
        closed = self.four_bar(rear_link)
        if closed is None:
            return None
        c, d, i = closed

        def on_canopy(point: Vector2) -> Vector2:
            return moved(point, self.hinge, i, canopy)

        return Posture(
            rear_link,
            _turn(direction(self.front_base, self.front_shield), direction(self.front_base, d)),
            _turn(direction(self.rear_shield, self.front_shield), direction(c, d)),
            canopy,
            c,
            d,
            i,
            on_canopy(self.front_head),
            on_canopy(self.rear_head),
            on_canopy(self.tip),
        )

    def start(self) -> Posture:
        """Posture with a level canopy and the hinge at its start height.

        Raises InputError with the reachable range if the linkage does not go there.
        """
        return self._start

    @cached_property
    def _start(self) -> Posture:
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
            turn = bracketed_root(height_error, float(turns[near]), float(turns[near + 1]), xtol=1e-15)
        except ValueError:  # it opens between both, or its heights are rounding
            turn = math.nan
        found = None if math.isnan(turn) else self.posture(turn, 0.0)
        if found is None:
            raise InputError(
                f"start_hinge_height = {self.start_hinge_height} m: the four-bar opens next to that posture; "
                "allowed: heights farther from where it locks"
            )
        return found

    def column_lengths(self, posture: Posture) -> tuple[float, float]:
        """Lengths [m] of front and rear column."""
        return distance(self.front_foot, posture.front_head), distance(self.rear_foot, posture.rear_head)

    def extended(self, extension: float, near: Posture | None = None) -> Posture | None:
        """Posture with both columns longer than at the start by `extension` [m]; None if there is none.

        `near`: a posture to search from, the start by default; steps of some centimetres are safe.
        """
        from scipy.optimize import root  # slow to import

        start = self.start()
        front, rear = (length + extension for length in self.column_lengths(start))
        near = near or start

        def misfit(turns: np.ndarray) -> list[float]:
            posture = self.posture(float(turns[0]), float(turns[1]))
            if posture is None:
                return [math.inf, math.inf]
            got = self.column_lengths(posture)
            return [got[0] - front, got[1] - rear]

        with np.errstate(invalid="ignore"):
            found = root(misfit, [near.rear_link, near.canopy], tol=1e-14)
        if not np.all(np.abs(misfit(found.x)) < 1e-11):
            return None
        return self.posture(float(found.x[0]), float(found.x[1]))

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
                if following is not None and abs(following.rear_link - posture.rear_link) < 0.2:
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

    # --- look ---

    def look(self, scenario: Scenario) -> Look:
        """A shield support: base, links, shield and tail beam, canopy, columns and pins."""
        from support_exudyn.drawing.shield_support import (
            look,
        )  # libraries of shapes, which a run has no use for

        return look(scenario)

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
        p = self.start()
        left_out = {*(column + RODS for column in columns), *parts}
        turned = {"rear_link": p.rear_link, "front_link": p.front_link, "shield": p.shield, "canopy": p.canopy}
        anchors = {  # a point of each body: where it is in the reference posture and at the start
            "rear_link": (self.rear_base, self.rear_base),
            "front_link": (self.front_base, self.front_base),
            "shield": (self.rear_shield, p.rear_shield),
            "canopy": (self.hinge, p.hinge),
        }
        lines = {  # by which a body's angle is measured
            "rear_link": direction(self.rear_base, p.rear_shield),
            "front_link": direction(self.front_base, p.front_shield),
            "shield": direction(p.rear_shield, p.hinge),
            "canopy": p.canopy,
        }
        bodies = {}
        for name in BODIES:
            lump = self._lump(name, left_out)
            centre = moved(lump.centre, *anchors[name], turned[name])
            bodies[name] = Body(
                mass=lump.mass,
                inertia=lump.inertia,
                centre=centre,
                angle=lines[name],
                moments=turned_moments(lump.second_moments, turned[name]),
            )
        linkage = Linkage(
            bodies=bodies,
            pins={
                "rear_base": pinned(GROUND, "rear_link", self.rear_base),
                "front_base": pinned(GROUND, "front_link", self.front_base),
                "rear_shield": pinned("rear_link", "shield", p.rear_shield),
                "front_shield": pinned("front_link", "shield", p.front_shield),
                "shield_canopy": pinned("shield", "canopy", p.hinge),
            },
            columns={
                "front_column": Column(
                    foot=GROUND, head="canopy", foot_point=self.front_foot, head_point=p.front_head
                ),
                "rear_column": Column(
                    foot=GROUND, head="canopy", foot_point=self.rear_foot, head_point=p.rear_head
                ),
            },
            points={"tip": TracePoint(body="canopy", point=p.tip)},
        )
        return self._with_tail(linkage) if TAIL in parts else linkage

    def _lump(self, body: str, left_out: Collection[str]) -> Part:
        """A body as one part, reference posture."""
        kept = [part for part in self.parts[body] if part.name not in left_out]
        if not kept or lumped(kept).inertia <= 0.0:
            named = ", ".join(part.name for part in self.parts[body] if part.name in left_out)
            raise InputError(f"parts.{body}: nothing with inertia is left without {named}; allowed: > 0 kg m^2")
        return lumped(kept)

    def _with_tail(self, linkage: Linkage) -> Linkage:
        """The tail beam on its hinge on the shield beam, and its jack between both."""
        hinge, foot, head = self.tail_hinge, self.tail_jack_foot, self.tail_jack_head
        tail = [part for part in self.parts["shield"] if part.name == TAIL]
        if hinge is None or foot is None or head is None or not tail:
            missing = [name for name in TAIL_PLACES if getattr(self, name) is None]
            missing += [] if tail else [f"a part of parts.shield named {TAIL}"]
            raise InputError(f"parts.{TAIL}: the machine lacks {', '.join(missing)}; allowed: Lumped")
        p, lump = self.start(), lumped(tail)

        def at_start(point: Vector2) -> Vector2:
            return moved(point, self.rear_shield, p.rear_shield, p.shield)

        body = Body(
            mass=lump.mass,
            inertia=lump.inertia,
            centre=at_start(lump.centre),
            angle=direction(at_start(hinge), at_start(lump.centre)),
            moments=turned_moments(lump.second_moments, p.shield),
        )
        jack = Column(
            foot="shield", head=TAIL, foot_point=at_start(foot), head_point=at_start(head), driven=False
        )
        return replace(
            linkage,
            bodies={**linkage.bodies, TAIL: body},
            pins={**linkage.pins, "shield_tail": pinned("shield", TAIL, at_start(hinge))},
            columns={**linkage.columns, self.jacks[TAIL]: jack},
        )


def _turn(before: float, after: float) -> float:
    """Smallest turn [rad] from one direction to another."""
    return math.remainder(after - before, 2.0 * math.pi)
