"""What is drawn: solids that move with a body, and struts that reach from one body to another."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from trimesh import Trimesh

from user_forces.values.value import Vector3


class Role(Enum):
    """What a solid is in the machine; pictures colour by it."""

    GROUND = "ground"
    BASE = "base"
    LINK = "link"
    SHIELD = "shield"
    TAIL = "tail beam"
    CANOPY = "canopy"
    CYLINDER = "cylinder"
    ROD = "rod"
    PIN = "pin"
    ROCK = "rock"
    BODY = "body"  # of a machine that says no more of it


@dataclass(frozen=True)
class Solid:
    """A solid that moves with a body.

    Arguments:
        name: of its own.
        body: name of the body, by which the channels know it, or "ground".
        role: what it is.
        mesh: its surface in the start posture, ground's axes [m].
    """

    name: str
    body: str
    role: Role
    mesh: Trimesh


@dataclass(frozen=True)
class Strut:
    """A column without a mass of its own: a rod that slides in a cylinder, between points of two bodies.

    Arguments:
        name: of the column.
        foot, head: names of the bodies, one of them may be "ground".
        foot_point, head_point: its ends, start posture [m].
        cylinder: surface [m] in axes whose x runs from foot to head, from the foot.
        rod: the same from the head.
    """

    name: str
    foot: str
    head: str
    foot_point: Vector3
    head_point: Vector3
    cylinder: Trimesh
    rod: Trimesh


@dataclass(frozen=True)
class Look:
    """All that is drawn of a machine.

    Arguments:
        solids: that move with bodies or stand on the ground.
        struts: columns between them.
        floor: height of the ground [m].
    """

    solids: tuple[Solid, ...]
    struts: tuple[Strut, ...]
    floor: float


def solids_of(look: Look, body: str) -> tuple[Solid, ...]:
    """Those that move with a body."""
    return tuple(solid for solid in look.solids if solid.body == body)
