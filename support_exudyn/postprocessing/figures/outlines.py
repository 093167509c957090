"""What is seen of a machine from its side: outlines of its bodies and actuators, in the start posture."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from matplotlib.path import Path
from shapely.geometry import MultiPolygon
from shapely.geometry.base import BaseGeometry
from trimesh import Trimesh

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.to_space import LEFT, RIGHT
from support_exudyn.postprocessing.look.poses import strut_axes
from support_exudyn.postprocessing.look.solid import DrawnActuator, Look, Role

# from the back to the front, each with how opaque it is: what is behind links and bodies shines through
LAYERS: dict[Role, float] = {
    Role.GROUND: 1.0, Role.BASE: 1.0, Role.CANOPY: 1.0, Role.TAIL: 1.0, Role.ROD: 1.0, Role.CYLINDER: 1.0,
    Role.SHIELD: 0.85, Role.LINK: 0.85, Role.BODY: 0.85, Role.ROCK: 1.0,
}  # fmt: skip
FINE = 1e-4  # of an outline's size: what is smaller is left out


@dataclass(frozen=True)
class Shape:
    """A body, or a part of an actuator: the name that is written on it, what it is, and its outline [m]."""

    name: str
    role: Role
    outline: BaseGeometry


def shapes(drawn: Look) -> list[Shape]:
    """All bodies and actuators from the back to the front, without pins.

    Of two that stand one behind the other, left and right, there is one.
    """
    found = [Shape(_of_pair(solid.name), solid.role, outline(solid.mesh)) for solid in drawn.solids]
    found += [shape for strut in drawn.struts for shape in _of_strut(strut)]
    order = list(LAYERS)
    once = {(one.name, one.role): one for one in found if one.role in order}
    return sorted(once.values(), key=lambda one: order.index(one.role))


def _of_pair(name: str) -> str:
    """The name of a body without its side."""
    return name.removesuffix(f"_{LEFT}").removesuffix(f"_{RIGHT}")


def _of_strut(strut: DrawnActuator) -> Iterator[Shape]:
    foot, head = np.array(strut.foot_point), np.array(strut.head_point)
    axes = strut_axes(head - foot)
    yield Shape(_of_pair(strut.name), Role.ROD, outline(strut.rod, axes, head))
    yield Shape(_of_pair(strut.name), Role.CYLINDER, outline(strut.cylinder, axes, foot))


def outline(mesh: Trimesh, axes: Series | None = None, place: Series | None = None) -> BaseGeometry:
    """The outline of a surface as it is seen along z, turned by axes (3, 3) and moved to a place (3,) [m]."""
    vertices = np.asarray(mesh.vertices)
    if axes is not None and place is not None:
        vertices = vertices @ axes.T + place
    flat = vertices[:, :2]
    fine = FINE * float(np.ptp(flat, axis=0).max())
    triangles = shapely.polygons(flat[mesh.faces])
    seen = shapely.unary_union(triangles[shapely.area(triangles) > fine**2])
    # slits between triangles that touch but for rounding close when it grows, and shrinks again
    return seen.buffer(fine).buffer(-fine).simplify(fine)


def path(shape: BaseGeometry) -> Path:
    """An outline with its holes as matplotlib draws it."""
    rings = [ring for part in parts(shape) for ring in (part.exterior, *part.interiors)]
    return Path.make_compound_path(*(Path(np.array(ring.coords), closed=True) for ring in rings))


def parts(shape: BaseGeometry) -> Sequence[BaseGeometry]:
    """The polygons of an outline."""
    found = shape.geoms if isinstance(shape, MultiPolygon) else [shape]
    return [part for part in found if part.geom_type == "Polygon" and not part.is_empty]
