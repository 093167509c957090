"""Hydraulic cylinders: a cylinder on a ball, and a rod that stays in it over the whole stroke."""

from __future__ import annotations

import math

from trimesh import Trimesh

from support_exudyn.postprocessing.look.shapes import lathed

INSIDE = (
    0.08  # of the shortest length: the rod that always stays in the cylinder, and the end that it never reaches
)
SHORTEST_CYLINDER = 0.68  # of the shortest length
BALL = 0.95  # radius of the ends, of the cylinder's
ROD = 0.66  # radius of the rod, of the cylinder's
ARC = 7  # points of the outline of a ball


def lengths(shortest: float, longest: float) -> tuple[float, float]:
    """Lengths of cylinder and rod [m] of a column whose ends are so far apart at least and at most [m].

    The rod is in the cylinder by a share of the shortest length when the column is longest, and does not come
    out at the other end when it is shortest. A column of one stage cannot do both if it becomes more than 1.74
    times as long; then the rod is longer than that.
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
