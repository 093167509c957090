"""What stands around a shield support: floor, roof, coal face, and the broken rock of the goaf behind it.

Roof, coal face and goaf are cut through in the plane of symmetry, so that they hide nothing of the machine.
"""

from dataclasses import dataclass

import numpy as np
from shapely.geometry import Polygon, box
from trimesh import Trimesh

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.shapes import plate
from support_exudyn.postprocessing.look.solid import Colour
from support_exudyn.postprocessing.render.stage import MeshItem
from user_forces.values.value import Vector3

FLOOR: Colour = (0.74, 0.72, 0.68)
ROOF: Colour = (0.66, 0.64, 0.61)
COAL: Colour = (0.23, 0.23, 0.25)
ROCK: Colour = (0.53, 0.51, 0.49)
STEEP = 0.5  # how far the heap leans back, of its depth
GAP = 0.02  # between things that do not make contact, of the machine's length
BEHIND = 0.30  # how far the goaf reaches, of the machine's length


@dataclass(frozen=True)
class Label:
    """A word in the picture, with its middle at a point in space."""

    text: str
    place: Vector3
    light: bool = False  # on a dark face


@dataclass(frozen=True)
class Surroundings:
    """The things that do not move, the roof, and what is written on them.

    Arguments:
        props: in ground's axes.
        roof: its lower face at the height 0; it is put at `roof_height` [m].
        labels: names of things; that of the roof is measured from its lower face.
        roof_label: likewise.
        points: corners that should be in the picture (n, 3) [m].
    """

    props: tuple[MeshItem, ...]
    roof: MeshItem
    roof_height: float
    labels: tuple[Label, ...]
    roof_label: Label
    points: Series


def surroundings(machine: Series, floor: float, roof_height: float, half_width: float) -> Surroundings:
    """The surroundings of a machine that is at some time or other at all these points (n, 3).

    Arguments:
        machine: points of its surface [m].
        floor: height of the ground [m].
        roof_height: of the roof's lower face, at the start of a picture [m].
        half_width: of the machine [m].
    """
    rear, front = machine[:, 0].min(), machine[:, 0].max()
    length = float(front - rear)
    face = float(front) + 2.0 * GAP * length
    back = float(rear) - GAP * length
    left, right = face + 0.085 * length, back - BEHIND * length
    thick, deep = 0.085 * length, half_width
    ground = _slab(right, left, floor - 0.035 * length, floor, -deep, 1.25 * half_width)
    coal = _slab(face, left, floor, roof_height + thick, -deep, 0.0)
    edge = back - 0.02 * length  # where the roof has broken off
    broken = [(0.05, 0.0), (0.0, 0.35), (0.03, 0.6), (-0.03, 1.0)]  # of the length, of the thickness
    crack = [(edge + x * length, y * thick) for x, y in broken]
    roof = plate(Polygon([(face, 0.0), *crack, (face, thick)]), -0.5 * deep, deep)
    height = roof_height - floor
    heap = 0.82 * height
    behind = Polygon(
        [(right, floor), (back, floor), (back - STEEP * (back - right), floor + heap), (right, floor + heap)]
    )
    props = [
        MeshItem(ground, FLOOR),
        MeshItem(coal, COAL),
        MeshItem(plate(behind, -0.5 * deep, deep), ROCK),
    ]
    labels = (
        Label("coal\nface", (0.5 * (face + left), floor + 0.5 * height, 0.0), light=True),
        Label("floor", (face - 0.16 * length, floor - 0.0175 * length, 1.25 * half_width)),
        Label("goaf", (right + 0.22 * (back - right), floor + 0.95 * height, 0.0)),
    )
    corners = [mesh_item.mesh.bounding_box.vertices for mesh_item in props]
    above = np.array([[face, roof_height + thick, -deep], [edge, roof_height + thick, -deep]])
    return Surroundings(
        tuple(props),
        MeshItem(roof, ROOF),
        roof_height,
        labels,
        Label("roof", (0.5 * (face + edge), 0.5 * thick, 0.0)),
        np.concatenate([*corners, above]),
    )


def _slab(left: float, right: float, low: float, high: float, near: float, far: float) -> Trimesh:
    """A box."""
    return plate(box(left, low, right, high), 0.5 * (near + far), far - near)
