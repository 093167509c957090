"""What is drawn: solids that move with a body, struts from one body to another, and their colours."""

from dataclasses import dataclass
from enum import Enum

from trimesh import Trimesh

from user_forces.values.value import Vector3


class Role(Enum):
    """The part of the machine that a solid is; pictures colour by it."""

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
class DrawnActuator:
    """An actuator without a mass of its own: a rod that slides in a cylinder, between points of two bodies.

    Arguments:
        name: of the actuator.
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
        struts: actuators between them.
        floor: height of the ground [m].
    """

    solids: tuple[Solid, ...]
    struts: tuple[DrawnActuator, ...]
    floor: float


def solids_of(look: Look, body: str) -> tuple[Solid, ...]:
    """Those that move with a body."""
    return tuple(solid for solid in look.solids if solid.body == body)


Colour = tuple[float, float, float]

COLOURS: dict[Role, Colour] = {
    Role.GROUND: (0.55, 0.52, 0.48),
    Role.BASE: (0.40, 0.44, 0.49),
    Role.LINK: (0.29, 0.47, 0.58),
    Role.SHIELD: (0.83, 0.74, 0.50),
    Role.TAIL: (0.68, 0.58, 0.38),
    Role.CANOPY: (0.92, 0.86, 0.66),
    Role.CYLINDER: (0.36, 0.38, 0.41),
    Role.ROD: (0.84, 0.86, 0.88),
    Role.PIN: (0.13, 0.13, 0.14),
    Role.ROCK: (0.48, 0.45, 0.42),
    Role.BODY: (0.45, 0.58, 0.70),
}
EDGE: Colour = (0.16, 0.16, 0.17)
