"""Simple solids, by shapely's outlines and trimesh's surfaces."""

from __future__ import annotations

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
    mesh.apply_transform(
        [[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
    )
    return mesh


def together(meshes: Iterable[Trimesh]) -> Trimesh:
    """Several surfaces as one."""
    mesh = concatenate(list(meshes))
    assert isinstance(mesh, Trimesh)  # what it is made of
    return mesh
