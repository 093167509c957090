"""Surfaces as the engine draws them."""

from __future__ import annotations

from typing import Any

import numpy as np
from exudyn import graphics
from trimesh import Trimesh
from trimesh.graph import smooth_shade

from support_exudyn.drawing.palette import Colour

SHARP = 0.5  # [rad] between two faces, from which on an edge is seen; a round one of 32 sections turns by 0.2


def engine_graphics(mesh: Trimesh, colour: Colour, edges: Colour | None = None) -> dict[str, Any]:
    """A surface of one colour, in the axes in which its points are given.

    edges: their colour; None: none are drawn, and faces are flat, as in files of surfaces. With edges, faces
    between them look smooth.
    """
    if edges is None:
        plain: dict[str, Any] = graphics.FromPointsAndTrigs(mesh.vertices, mesh.faces, [*colour, 1.0])
        return plain
    smooth = smooth_shade(mesh, angle=SHARP)
    drawn: dict[str, Any] = graphics.FromPointsAndTrigs(
        smooth.vertices, smooth.faces, [*colour, 1.0], smooth.vertex_normals
    )
    sharp = mesh.face_adjacency_edges[mesh.face_adjacency_angles > SHARP]
    ends = np.ascontiguousarray(mesh.vertices[sharp.ravel()])
    first = len(smooth.vertices)  # edges have points of their own, which no triangle uses
    drawn["points"] = np.concatenate([smooth.vertices, ends])
    drawn["normals"] = np.concatenate([smooth.vertex_normals, np.zeros_like(ends)])
    drawn["colors"] = np.tile([*colour, 1.0], (first + len(ends), 1))
    drawn["edges"] = np.arange(first, first + len(ends)).reshape(-1, 2)
    drawn["edgeColor"] = [*edges, 1.0]
    return drawn
