"""A four-bar shield support as a linkage: bodies in their start posture, pins, columns, tail beam."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from support_exudyn.model.linkage import (
    GROUND,
    Body,
    Column,
    Linkage,
    Part,
    TracePoint,
    lumped,
    pinned,
    turned_moments,
)
from support_exudyn.model.plane_geometry import direction, moved
from user_forces.values.value import InputError, Vector2

if TYPE_CHECKING:
    from support_exudyn.machines.four_bar_shield import FourBarShield

BODIES = ("rear_link", "front_link", "shield", "canopy")
TAIL = "tail_beam"  # part of the shield, and the body that it can be
TAIL_PLACES = ("tail_hinge", "tail_jack_foot", "tail_jack_head")
RODS = "_rods"  # after a column's name: parts that stand for its mass as long as it has none


def laid_out(shield: FourBarShield[Any], columns: Collection[str], parts: Collection[str]) -> Linkage:
    """A support as four moving bodies, five pins, two columns and the canopy tip.

    Arguments:
        columns: names of those whose mass no part stands for.
        parts: names of those that are bodies of their own: the tail beam or none.

    Raises InputError if nothing is left of a body, or data of the tail beam are missing.
    """
    p = shield.start()
    left_out = {*(column + RODS for column in columns), *parts}
    turned = {"rear_link": p.rear_link, "front_link": p.front_link, "shield": p.shield, "canopy": p.canopy}
    anchors = {  # a point of each body: where it is in the reference posture and at the start
        "rear_link": (shield.rear_base, shield.rear_base),
        "front_link": (shield.front_base, shield.front_base),
        "shield": (shield.rear_shield, p.rear_shield),
        "canopy": (shield.hinge, p.hinge),
    }
    lines = {  # by which a body's angle is measured
        "rear_link": direction(shield.rear_base, p.rear_shield),
        "front_link": direction(shield.front_base, p.front_shield),
        "shield": direction(p.rear_shield, p.hinge),
        "canopy": p.canopy,
    }
    bodies = {}
    for name in BODIES:
        lump = _lump(shield, name, left_out)
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
            "rear_base": pinned(GROUND, "rear_link", shield.rear_base),
            "front_base": pinned(GROUND, "front_link", shield.front_base),
            "rear_shield": pinned("rear_link", "shield", p.rear_shield),
            "front_shield": pinned("front_link", "shield", p.front_shield),
            "shield_canopy": pinned("shield", "canopy", p.hinge),
        },
        columns={
            name: Column(
                foot=strut.foot[0],
                head=strut.head[0],
                foot_point=shield.place(*strut.foot, p),
                head_point=shield.place(*strut.head, p),
            )
            for name, strut in shield.STRUTS.items()
        },
        points={"tip": TracePoint(body="canopy", point=p.tip)},
    )
    return _with_tail(shield, linkage) if TAIL in parts else linkage


def _lump(shield: FourBarShield[Any], body: str, left_out: Collection[str]) -> Part:
    """A body as one part, reference posture."""
    kept = [part for part in shield.parts[body] if part.name not in left_out]
    if not kept or lumped(kept).inertia <= 0.0:
        named = ", ".join(part.name for part in shield.parts[body] if part.name in left_out)
        raise InputError(f"parts.{body}: nothing with inertia is left without {named}; allowed: > 0 kg m^2")
    return lumped(kept)


def _with_tail(shield: FourBarShield[Any], linkage: Linkage) -> Linkage:
    """The tail beam on its hinge on the shield beam, and its jack between both."""
    hinge, foot, head = shield.tail_hinge, shield.tail_jack_foot, shield.tail_jack_head
    beam = [part for part in shield.parts["shield"] if part.name == TAIL]
    if hinge is None or foot is None or head is None or not beam:
        missing = [name for name in TAIL_PLACES if getattr(shield, name) is None]
        missing += [] if beam else [f"a part of parts.shield named {TAIL}"]
        raise InputError(f"parts.{TAIL}: the machine lacks {', '.join(missing)}; allowed: Lumped")
    p, lump = shield.start(), lumped(beam)

    def at_start(point: Vector2) -> Vector2:
        return moved(point, shield.rear_shield, p.rear_shield, p.shield)

    body = Body(
        mass=lump.mass,
        inertia=lump.inertia,
        centre=at_start(lump.centre),
        angle=direction(at_start(hinge), at_start(lump.centre)),
        moments=turned_moments(lump.second_moments, p.shield),
    )
    jack = Column(foot="shield", head=TAIL, foot_point=at_start(foot), head_point=at_start(head), driven=False)
    return replace(
        linkage,
        bodies={**linkage.bodies, TAIL: body},
        pins={**linkage.pins, "shield_tail": pinned("shield", TAIL, at_start(hinge))},
        columns={**linkage.columns, shield.jacks[TAIL]: jack},
    )
