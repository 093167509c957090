"""Simple solids, by shapely's outlines and trimesh's surfaces; hydraulic cylinders among them."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from shapely.geometry import LineString, MultiPoint, Point, Polygon
from trimesh import Trimesh
from trimesh.creation import cylinder, extrude_polygon, revolve
from trimesh.util import concatenate

from user_forces.values.value import Vector2, Vector3

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
    """An outline, as thick as is said, about the plane z [m]."""
    mesh: Trimesh = extrude_polygon(outline, thickness, engine="earcut")
    mesh.apply_translation([0.0, 0.0, z - 0.5 * thickness])
    return mesh


def tube(a: Vector3, b: Vector3, radius: float) -> Trimesh:
    """A cylinder between two points."""
    mesh: Trimesh = cylinder(radius, sections=SECTIONS, segment=np.array([a, b]))
    return mesh


def lathed(profile: Sequence[tuple[float, float]]) -> Trimesh:
    """A solid of revolution about the x axis, by its outline: places along the axis and radii [m].

    The places increase; the first and the last radius are 0, by which it is closed.
    """
    places, radii = np.array(profile).T
    mesh: Trimesh = revolve(np.column_stack([radii, places]), sections=SECTIONS)
    mesh.apply_transform(np.eye(4)[[2, 0, 1, 3]])  # z becomes x
    return mesh


def together(meshes: Iterable[Trimesh]) -> Trimesh:
    """Several surfaces as one."""
    mesh = concatenate(list(meshes))
    assert isinstance(mesh, Trimesh)  # what it is made of
    return mesh


INSIDE = (
    0.08  # of the shortest length: rod that always stays in the cylinder, and the end that it never reaches
)
SHORTEST_CYLINDER = 0.68  # of the shortest length
BALL = 0.95  # radius of the ends, of the cylinder's
ROD = 0.66  # radius of the rod, of the cylinder's
ARC = 7  # points of the outline of a ball


def lengths(shortest: float, longest: float) -> tuple[float, float]:
    """Lengths of cylinder and rod [m] of an actuator whose ends are so far apart at least and at most [m].

    The rod is in the cylinder by a share of the shortest length when the actuator is longest, and does not come
    out at the other end when it is shortest. An actuator of one stage cannot do both if it becomes more than
    1.74 times as long; then the rod is longer than that.
    """
    inside = INSIDE * shortest
    rod = shortest - inside
    cylinder = max(SHORTEST_CYLINDER * shortest, longest - rod + inside)
    cylinder = min(cylinder, 0.9 * shortest)
    return cylinder, max(rod, longest - cylinder + inside)


def cylinder_and_rod(shortest: float, longest: float, radius: float) -> tuple[Trimesh, Trimesh]:
    """Surfaces of both, as a `Strut` has them; radius: of the cylinder [m]."""
    cylinder, rod = lengths(shortest, longest)
    collar, edge = min(0.7 * radius, 0.2 * cylinder), 0.12 * radius
    thick = 1.12 * radius
    outline = [
        *_ball(BALL * radius, math.pi, 0.5 * math.pi),
        (edge, radius),
        (cylinder - collar - edge, radius),
        (cylinder - collar, thick),
        (cylinder - edge, thick),
        (cylinder, thick - edge),
        (cylinder, 0.0),
    ]
    thin = ROD * radius
    reached = math.pi - math.asin(thin / (BALL * radius))
    shaft = [(-rod, 0.0), (-rod, thin), *_ball(BALL * radius, reached, 0.0)]
    return lathed(outline), lathed(shaft)


def _ball(radius: float, first: float, last: float) -> list[tuple[float, float]]:
    """The outline of a ball about the origin between two angles from the axis [rad]."""
    angles = [first + (last - first) * n / ARC for n in range(ARC + 1)]
    return [(radius * math.cos(a), abs(round(math.sin(a), 12)) * radius) for a in angles]
