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
from collections.abc import Collection, Mapping
from dataclasses import replace
from functools import cached_property
from typing import ClassVar

import numpy as np
from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.machines.shield_layout import (
    BODIES,
    FRAME,
    RODS,
    TAIL,
    TAIL_PLACES,
    Posture,
    ShieldColumn,
    placed,
    turn,
)
from support_exudyn.machines.shield_layout import PINS as PINS
from support_exudyn.model.linkage import (
    GROUND,
    Crank,
    LinearActuator,
    Linkage,
    Part,
    TracePoint,
    lumped,
    pinned,
)
from support_exudyn.model.machine import Machine
from support_exudyn.model.plane_geometry import circle_intersection, direction, distance, moved, side
from support_exudyn.model.to_space import Width
from user_forces.roots import bracketed_root
from user_forces.values.units import Metres
from user_forces.values.value import InputError, Positive, Vector2, value

FARTHEST = 1000.0  # [m] from the origin
PRECISE = 1e-11  # [m] to which lengths of columns are met
MOST_CORRECTIONS = 20  # of Newton's method; five do
NEAR = 1e-6  # [rad] over which rates of lengths are taken
LOCKED = 1e-12  # [m^2], [m] determinant of the columns' rates at which they hold nothing any more
LONGEST_STEP = 0.2  # [rad] from one posture to the next, so that it is not taken for one behind a dead centre
USUAL_STROKE = 0.3  # of the shortest column
FARTHEST_SEARCH = 2.0 * LONGEST_STEP  # [rad]


@value
class FourBarShield(Machine, ABC):
    """Pivots, parts and motion of four-bar shield supports; a kind of them adds two columns, `STRUTS`, by name.

    All points are those of one reference posture. Arguments:
        rear_base, front_base: B and A, pivots of rear and front link on the base [m].
        rear_shield, front_shield: C and D, pivots of the links on the shield beam.
        hinge: I, shield beam on canopy.
        tip: foremost point of the canopy.
        parts: for each of rear_link, front_link, shield and canopy the parts it is made of, in the
            reference posture. Those named COLUMN_rods stand for a massless column's mass; that named tail_beam,
            of the shield, can be a body of its own.
        start_hinge_height: y of the hinge at the start [m], with the canopy level.
        width: lateral dimensions, for the spatial model; None: there are none.
        tail_hinge: tail beam on shield beam.
        tail_jack_foot, tail_jack_head: ends of the tail beam's jack, on the shield beam and on the tail beam;
            these and its hinge are only needed where the tail beam is a body of its own.
    """

    STRUTS: ClassVar[Mapping[str, ShieldColumn]]

    rear_base: Metres[Vector2]
    front_base: Metres[Vector2]
    rear_shield: Metres[Vector2]
    front_shield: Metres[Vector2]
    hinge: Metres[Vector2]
    tip: Metres[Vector2]
    parts: Mapping[str, tuple[Part, ...]]
    start_hinge_height: Metres[Positive]
    width: Width | None = None
    tail_hinge: Metres[Vector2] | None = None
    tail_jack_foot: Metres[Vector2] | None = None
    tail_jack_head: Metres[Vector2] | None = None

    @classmethod
    def pivots(cls) -> tuple[str, ...]:
        """Names of all pivots of the support, those of the tail beam last, which may be missing."""
        feet = [place for strut in cls.STRUTS.values() for _, place in strut]
        return (*FRAME[:-1], *feet, FRAME[-1], *TAIL_PLACES)

    @model_validator(mode="after")
    def _can_be_built(self) -> Self:
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
            "actuators": columns,
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

    def posture(self, rear_link: float, canopy: float) -> Posture | None:
        """Posture for turns of rear link and canopy [rad]; None where the four-bar does not close."""
        closed = self.four_bar(rear_link)
        if closed is None:
            return None
        c, d, i = closed
        known = Posture(
            rear_link=rear_link,
            front_link=turn(direction(self.front_base, self.front_shield), direction(self.front_base, d)),
            shield=turn(direction(self.rear_shield, self.front_shield), direction(c, d)),
            canopy=canopy,
            rear_shield=c,
            front_shield=d,
            hinge=i,
            tip=moved(self.tip, self.hinge, i, canopy),
        )
        sides = [side for strut in self.STRUTS.values() for side in strut if side[0] != GROUND]
        return replace(known, ends={pivot: self.place(body, pivot, known) for body, pivot in sides})

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

    def place(self, body: str, pivot: str, posture: Posture) -> Vector2:
        """Place of a pivot of a body, or of the ground, in a posture [m]."""
        point: Vector2 = getattr(self, pivot)
        if body == GROUND:
            return point
        if body == "canopy":
            return moved(point, self.hinge, posture.hinge, posture.canopy)
        assert body == "shield"  # columns stand on nothing else
        return moved(point, self.rear_shield, posture.rear_shield, posture.shield)

    def column_lengths(self, posture: Posture) -> tuple[float, float]:
        """Lengths [m] of the support's columns, in the order of `STRUTS`."""
        first, second = (
            distance(*(self.place(*side, posture) for side in strut)) for strut in self.STRUTS.values()
        )
        return first, second

    def extended(self, extension: float, near: Posture | None = None) -> Posture | None:
        """Posture with the driven columns longer than at the start by `extension` [m]; None if there is none.

        Newton's method in the turns of rear link and canopy, with rates of lengths by central differences. A
        column that follows another is left out, and the canopy keeps level.

        near: a posture from which the search starts, the start by default; steps of some centimetres are safe.
        """
        near, unknowns = near or self.start(), len(self.alike)
        wanted = np.add(self.column_lengths(self.start()), extension)
        posture, last = near, False
        for _ in range(MOST_CORRECTIONS):
            rates = np.zeros((unknowns, unknowns))
            for column, ways in enumerate(NEAR * np.eye(2)[:unknowns]):
                low, high = (
                    self.posture(*np.add((posture.rear_link, posture.canopy), sign * ways).tolist())
                    for sign in (-1.0, 1.0)
                )
                if low is None or high is None:
                    return None
                change = np.subtract(self.column_lengths(high), self.column_lengths(low))
                rates[:, column] = change[:unknowns] / (2.0 * NEAR)
            if abs(np.linalg.det(rates)) < LOCKED:
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

    # --- layout ---

    def widths(self) -> Width | None:
        """The support's lateral dimensions; None if they are not known."""
        return self.width

    def linkage(self) -> Linkage:
        """The support as four moving bodies, five pins, two columns and the canopy tip."""
        return self._linkage

    @cached_property
    def _linkage(self) -> Linkage:
        return self.detailed((), ())

    @property
    def jacks(self) -> Mapping[str, str]:
        """The tail beam, which can be a body of its own, with its jack."""
        return {TAIL: "tail_jack"}

    def detailed(self, actuators: Collection[str], parts: Collection[str]) -> Linkage:
        """A support as four moving bodies, five pins, two columns and the canopy tip.

        Arguments:
            actuators: names of those whose mass no part stands for.
            parts: names of those that are bodies of their own: the tail beam or none.

        Raises InputError if nothing is left of a body, or data of the tail beam are missing.
        """
        p = self.start()
        left_out = {*(column + RODS for column in actuators), *parts}
        base, front, shield = self.rear_base, self.front_base, direction(p.rear_shield, p.hinge)
        at_start = {  # of each body: turn, a point in the reference posture and now, and the angle now
            "rear_link": (p.rear_link, base, base, direction(base, p.rear_shield)),
            "front_link": (p.front_link, front, front, direction(front, p.front_shield)),
            "shield": (p.shield, self.rear_shield, p.rear_shield, shield),
            "canopy": (p.canopy, self.hinge, p.hinge, p.canopy),
        }
        linkage = Linkage(
            bodies={name: placed(self._lump(name, left_out), *place) for name, place in at_start.items()},
            pins={
                "rear_base": pinned(GROUND, "rear_link", self.rear_base),
                "front_base": pinned(GROUND, "front_link", self.front_base),
                "rear_shield": pinned("rear_link", "shield", p.rear_shield),
                "front_shield": pinned("front_link", "shield", p.front_shield),
                "shield_canopy": pinned("shield", "canopy", p.hinge),
            },
            actuators={
                name: LinearActuator(
                    foot=strut.foot[0],
                    head=strut.head[0],
                    foot_point=self.place(*strut.foot, p),
                    head_point=self.place(*strut.head, p),
                )
                for name, strut in self.STRUTS.items()
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
        beam = [part for part in self.parts["shield"] if part.name == TAIL]
        if hinge is None or foot is None or head is None or not beam:
            missing = [name for name in TAIL_PLACES if getattr(self, name) is None]
            missing += [] if beam else [f"a part of parts.shield named {TAIL}"]
            raise InputError(f"parts.{TAIL}: the machine lacks {', '.join(missing)}; allowed: Lumped")
        p, lump = self.start(), lumped(beam)

        def at_start(point: Vector2) -> Vector2:
            return moved(point, self.rear_shield, p.rear_shield, p.shield)

        angle = direction(at_start(hinge), at_start(lump.centre))
        body = placed(lump, p.shield, self.rear_shield, p.rear_shield, angle)
        jack = LinearActuator(
            foot="shield", head=TAIL, foot_point=at_start(foot), head_point=at_start(head), driven=False
        )
        return replace(
            linkage,
            bodies={**linkage.bodies, TAIL: body},
            pins={**linkage.pins, "shield_tail": pinned("shield", TAIL, at_start(hinge))},
            actuators={**linkage.actuators, self.jacks[TAIL]: jack},
        )
