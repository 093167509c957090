"""A four-bar shield support in its start posture: what its pivots must be, the closed four-bar, the linkage."""

import math
from abc import ABC
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import ClassVar, NamedTuple

import numpy as np
from pydantic import model_validator
from typing_extensions import Self

from support_exudyn.model.linkage import (
    GROUND,
    Body,
    LinearActuator,
    Linkage,
    Part,
    TracePoint,
    lumped,
    pinned,
    turned_moments,
)
from support_exudyn.model.machine import Machine
from support_exudyn.model.plane_geometry import circle_intersection, direction, distance, moved, side
from support_exudyn.model.to_space import Width
from user_forces.roots import bracketed_root
from user_forces.values.units import Metres
from user_forces.values.value import InputError, Positive, Vector2, value

BODIES = ("rear_link", "front_link", "shield", "canopy")
TAIL = "tail_beam"  # part of the shield, and the body that it can be
TAIL_PLACES = ("tail_hinge", "tail_jack_foot", "tail_jack_head")
RODS = "_rods"  # after a column's name: parts that stand for its mass as long as it has none
PINS = ("rear_base", "front_base", "rear_shield", "front_shield", "shield_canopy")
FRAME = ("rear_base", "front_base", "rear_shield", "front_shield", "hinge", "tip")  # pivots of all of them
FARTHEST = 1000.0  # [m] from the origin


@dataclass(frozen=True)
class Posture:
    """Where everything is with ideal pins: turns from the reference posture [rad], and pivots [m].

    Turns are those of rear link, front link, shield beam and canopy; pivots are C, D, I and T; ends are the
    moving ends of the columns, by their pivots.
    """

    rear_link: float
    front_link: float
    shield: float
    canopy: float
    rear_shield: Vector2
    front_shield: Vector2
    hinge: Vector2
    tip: Vector2
    ends: Mapping[str, Vector2] = field(default_factory=dict)


class ShieldColumn(NamedTuple):
    """A column of a support: the bodies of its foot and its head, each with the name of the pivot on it."""

    foot: tuple[str, str]
    head: tuple[str, str]


@value
class ShieldLayout(Machine, ABC):
    """Pivots, parts and start posture of four-bar shield supports; `STRUTS`: its two columns by name.

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

    def joints(self) -> dict[str, list[str]]:
        """Names of the pivots on each body."""
        joints = {
            "rear_link": ["rear_base", "rear_shield"],
            "front_link": ["front_base", "front_shield"],
            "shield": ["rear_shield", "front_shield", "hinge"],
            "canopy": ["hinge", "tip"],
        }
        for body, pivot in (end for strut in self.STRUTS.values() for end in strut if end[0] != GROUND):
            joints[body].append(pivot)
        return joints

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
        ends = {
            pivot: self.place(body, pivot, known)
            for strut in self.STRUTS.values()
            for body, pivot in strut
            if body != GROUND
        }
        return replace(known, ends=ends)

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
            distance(self.place(*strut.foot, posture), self.place(*strut.head, posture))
            for strut in self.STRUTS.values()
        )
        return first, second

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

        body = Body(
            mass=lump.mass,
            inertia=lump.inertia,
            centre=at_start(lump.centre),
            angle=direction(at_start(hinge), at_start(lump.centre)),
            moments=turned_moments(lump.second_moments, p.shield),
        )
        jack = LinearActuator(
            foot="shield", head=TAIL, foot_point=at_start(foot), head_point=at_start(head), driven=False
        )
        return replace(
            linkage,
            bodies={**linkage.bodies, TAIL: body},
            pins={**linkage.pins, "shield_tail": pinned("shield", TAIL, at_start(hinge))},
            actuators={**linkage.actuators, self.jacks[TAIL]: jack},
        )


def turn(before: float, after: float) -> float:
    """Smallest turn [rad] from one direction to another."""
    return math.remainder(after - before, 2.0 * math.pi)
