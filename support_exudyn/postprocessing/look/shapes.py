"""What is drawn of a machine: surfaces that move with bodies, their colours, and the solids they are made of.

Films, Exudyn's viewer and exported meshes take the `Shape` list of a `Look`. Outlines are shapely's, surfaces
trimesh's.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from shapely.geometry import LineString, MultiPoint, Point, Polygon
from trimesh import Trimesh
from trimesh.creation import cylinder, extrude_polygon, icosphere
from trimesh.util import concatenate

from user_forces.values.value import Vector2, Vector3

Colour = tuple[float, float, float]


class Role(Enum):
    """The part of the machine that a shape is; pictures colour by it."""

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
    BODY = "body"  # of a machine without a look of its own


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


@dataclass(frozen=True)
class Strut:
    """The line between two points of bodies, along which an actuator or a spring without a mass is drawn.

    Arguments:
        name: of the actuator or spring.
        foot, head: names of the bodies, one of them may be "ground".
        foot_point, head_point: its ends, start posture [m].
    """

    name: str
    foot: str
    head: str
    foot_point: Vector3
    head_point: Vector3

    @property
    def ends(self) -> tuple[tuple[str, Vector3], tuple[str, Vector3]]:
        """Body and point of both ends, the foot first."""
        return (self.foot, self.foot_point), (self.head, self.head_point)

    def shapes(self, from_foot: Trimesh, from_head: Trimesh) -> list[Shape]:
        """The surfaces that start at foot and head, in axes whose x runs from foot to head [m]."""
        parts = ((Role.CYLINDER, from_foot), (Role.ROD, from_head))
        return [
            Shape(f"{self.name} {role.value}", f"{self.name} {role.value}", role, mesh, self, end)
            for end, (role, mesh) in enumerate(parts)
        ]


@dataclass(frozen=True)
class Shape:
    """A surface that moves as a whole.

    Arguments:
        name: of its own.
        body: name of the body, by which the channels know it, or "ground"; of a strut its own name.
        role: what it is.
        mesh: its surface [m] in the start posture, ground's axes; of a strut in the strut's axes, from `end`.
        strut: the strut that it belongs to; None if it is fixed to a body.
        end: of the strut, from which it is drawn: 0 its foot, 1 its head.
    """

    name: str
    body: str
    role: Role
    mesh: Trimesh
    strut: Strut | None = None
    end: int = 0


@dataclass(frozen=True)
class Look:
    """All that is drawn of a machine: its shapes, and the height of the ground [m]."""

    shapes: tuple[Shape, ...]
    floor: float

    def of(self, body: str) -> tuple[Shape, ...]:
        """The shapes that are fixed to a body."""
        return tuple(shape for shape in self.shapes if shape.body == body)


# --- solids ---

ROUND = 8  # segments of a quarter circle
SECTIONS = 32  # of a full one


def hull(points: Sequence[Vector2], margin: float) -> Polygon:
    """The rounded outline that keeps a distance `margin` [m] around points."""
    return MultiPoint(list(points)).convex_hull.buffer(margin, quad_segs=ROUND)


def bar(a: Vector2, b: Vector2, half_width: float) -> Polygon:
    """The outline of a bar with round ends about two points."""
    return LineString([a, b]).buffer(half_width, quad_segs=ROUND)


def bored(outline: Polygon, centre: Vector2, radius: float) -> Polygon:
    """An outline with a bore in it."""
    return outline.difference(Point(centre).buffer(radius, quad_segs=2 * ROUND))


def plate(outline: Polygon, z: float, thickness: float) -> Trimesh:
    """An outline, extruded to a thickness about the plane z [m]."""
    mesh: Trimesh = extrude_polygon(outline, thickness, engine="earcut")
    mesh.apply_translation([0.0, 0.0, z - 0.5 * thickness])
    return mesh


def tube(a: Vector3, b: Vector3, radius: float) -> Trimesh:
    """A cylinder between two points."""
    mesh: Trimesh = cylinder(radius, sections=SECTIONS, segment=np.array([a, b]))
    return mesh


def axle(first: float, last: float, radius: float) -> Trimesh:
    """A cylinder along the x axis between two places on it [m]."""
    return tube((first, 0.0, 0.0), (last, 0.0, 0.0), radius)


def together(meshes: Iterable[Trimesh]) -> Trimesh:
    """Several surfaces as one."""
    mesh = concatenate(list(meshes))
    assert isinstance(mesh, Trimesh)  # what it is made of
    return mesh


# --- hydraulic cylinders ---

INSIDE = 0.08  # of the shortest length: rod that stays in the cylinder, and the end that it never reaches
BALL, ROD = 0.95, 0.66  # radius of the ends, and of the rod, of the cylinder's


def cylinder_and_rod(shortest: float, longest: float, radius: float) -> tuple[Trimesh, Trimesh]:
    """Surfaces of both, with balls at their ends, as `Strut.shapes` takes them.

    An actuator of one stage cannot become more than 1.74 times as long; then the rod is too long for it.

    Arguments:
        shortest, longest: distance of the ends over the stroke [m].
        radius: of the cylinder [m].
    """
    inside = INSIDE * shortest
    cylinder = min(max(0.68 * shortest, longest - shortest + 2.0 * inside), 0.9 * shortest)
    rod = max(shortest - inside, longest - cylinder + inside)
    ball, collar = icosphere(2, BALL * radius), min(0.7 * radius, 0.2 * cylinder)
    barrel = axle(0.0, cylinder - collar, radius), axle(cylinder - collar, cylinder, 1.12 * radius)
    return together([ball, *barrel]), together([ball, axle(-rod, 0.0, ROD * radius)])
