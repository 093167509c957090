"""Surfaces as the engine draws them."""

from __future__ import annotations

from typing import Any

from exudyn import graphics
from trimesh import Trimesh

from support_exudyn.drawing.palette import Colour


def engine_graphics(mesh: Trimesh, colour: Colour) -> dict[str, Any]:
    """A surface of one colour, in the axes in which its points are given."""
    drawn: dict[str, Any] = graphics.FromPointsAndTrigs(mesh.vertices, mesh.faces, [*colour, 1.0])
    return drawn
