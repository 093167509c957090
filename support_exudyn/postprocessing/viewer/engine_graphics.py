"""Surfaces as the engine draws them."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from trimesh import Trimesh
from trimesh.graph import smooth_shade

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.solid import EDGE, Colour

SHARP = 0.5  # [rad] between two faces, from which on an edge is seen; a round one of 32 sections turns by 0.2
UNTURNED = np.eye(3)
NOWHERE = np.zeros(3)
Indices = npt.NDArray[np.int64]


class EngineSurface(NamedTuple):
    """A surface of one colour, smooth between its sharp edges, which are drawn as lines.

    points, normals: shape (n, 3); the ends of edges, which no triangle uses, come last. triangles, edges:
    indexes of points, one behind the other. colours: shape (n, 4), red, green, blue and opacity from 0 to 1.
    """

    points: Series
    normals: Series
    triangles: Indices
    edges: Indices
    colours: Series

    def placed(self, turn: Series = UNTURNED, place: Series = NOWHERE) -> dict[str, Any]:
        """For the engine: turned by a matrix (3, 3), then moved (3,) [m]."""
        return {
            "type": "TriangleList",
            "points": (self.points @ turn.T + place).ravel(),
            "normals": (self.normals @ turn.T).ravel(),
            "triangles": self.triangles,
            "edges": self.edges,
            "edgeColor": [*EDGE, 1.0],
            "colors": self.colours.ravel(),
        }


def engine_surface(mesh: Trimesh, colour: Colour, edges: bool = True) -> EngineSurface:
    """A surface for the engine, in the axes in which its points are given; without edges if so asked."""
    smooth = smooth_shade(mesh, angle=SHARP)
    sharp = mesh.face_adjacency_edges[mesh.face_adjacency_angles > SHARP] if edges else np.empty((0, 2), int)
    ends = mesh.vertices[sharp.ravel()]
    points = np.concatenate([smooth.vertices, ends])
    return EngineSurface(
        points,
        np.concatenate([smooth.vertex_normals, np.tile([0.0, 0.0, 1.0], (len(ends), 1))]),
        smooth.faces.ravel(),
        np.arange(len(smooth.vertices), len(points), dtype=np.int64),
        np.tile([*colour, 1.0], (len(points), 1)),
    )
