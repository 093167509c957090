"""A run as a scene: the machine's surfaces, what stands around a shield support, and where all of it is.

Around a support stand floor, roof, coal face, and the broken rock of the goaf. Roof, coal face and goaf are cut
through in the plane of symmetry, so that they hide nothing of the machine.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from shapely.geometry import Polygon, box

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.roofs import Roof
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.postprocessing.look.shapes import COLOURS, Colour, Role, Shape, plate
from support_exudyn.postprocessing.render.pin_views import PinView
from support_exudyn.postprocessing.render.stage import Camera, MeshItem
from support_exudyn.simulation.result import Result
from user_forces.values.value import Vector3

STATES = 33  # records, spread over the run, by which the picture's frame is chosen
UNTURNED, NOWHERE = np.eye(3), np.zeros(3)


class Label(NamedTuple):
    """A word in the picture, with its middle at a point in space [m]; light: it is on a dark face."""

    text: str
    place: Vector3
    light: bool = False


class RenderedScene:
    """The scene of a run. Raises InputError if the run has not recorded where its bodies are.

    points: the outermost ones of the machine at some records, shape (n, 3) [m].
    """

    def __init__(self, result: Result) -> None:
        self.result, self.look, self._poses = result, look(result.scenario), Poses(result)
        records = np.unique(np.linspace(0, result.time.size - 1, STATES).astype(int)).tolist()

        def hull(shape: Shape) -> Series:
            corners = shape.mesh.convex_hull.vertices
            return np.concatenate([self._poses.frame(shape, record).points(corners) for record in records])

        hulls = [(shape, hull(shape)) for shape in self.look.shapes]
        self.points: Series = np.concatenate([points for _, points in hulls])
        highest = [points[:, 1].max() for shape, points in hulls if shape.role is Role.CANOPY]
        self.surroundings: Surroundings | None = None
        if highest:  # a support
            roof = self._pressing_roof(0)
            above = 0.25 * GAP * float(np.ptp(self.points[:, 0]))
            height = float(max(highest)) + above if roof is None else roof
            self.surroundings = Surroundings(self.points, self.look.floor, height)

    def corners(self, record: int) -> Series:
        """The corners of boxes around all that may move, at a record, shape (n, 3) [m]."""
        corners = [
            self._poses.frame(shape, record).points(shape.mesh.bounding_box.vertices)
            for shape in self.look.shapes
        ]
        roof = [] if self.surroundings is None else [np.array([[0.0, self.roof(record), 0.0]])]
        return np.concatenate(corners + roof)

    def _pressing_roof(self, record: int) -> float | None:
        """Height of the lowest roof that presses on the canopy, at its upper face [m]; None without one."""
        heights = []
        for load in self.result.scenario.acting_loads.values():
            if isinstance(load, Roof):
                tops = [shape.mesh.bounds[1, 1] for shape in self.look.of(load.body)]
                descent = load.descent.extension(float(self.result.time[record]))
                heights.append(max(tops, default=load.point[1]) + load.gap - descent)
        return min(heights, default=None)

    def roof(self, record: int) -> float:
        """Height of the roof's lower face [m]."""
        assert self.surroundings is not None
        face = self._pressing_roof(record)
        return self.surroundings.roof_height if face is None else face

    def items(self) -> list[MeshItem]:
        """All surfaces, each in axes of its own: the machine's, what stands still, the roof."""
        machine = [MeshItem(shape.mesh, COLOURS[shape.role]) for shape in self.look.shapes]
        around = self.surroundings
        return machine if around is None else [*machine, *around.still, around.roof]

    def places(self, record: int) -> Iterator[tuple[Series, Series]]:
        """The place (3,) [m] and the turn (3, 3) of each of these at a record."""
        for shape in self.look.shapes:
            frame = self._poses.frame(shape, record)
            yield frame.origin, frame.axes
        if self.surroundings is not None:
            yield from ((NOWHERE, UNTURNED) for _ in self.surroundings.still)
            yield np.array([0.0, self.roof(record), 0.0]), UNTURNED

    def camera(self, width: int, height: int) -> Camera:
        """The camera that sees all of it over the whole run."""
        around = self.surroundings
        points = self.points if around is None else np.concatenate([self.points, around.points])
        return Camera.fitted(points, width, height, max(2, round(0.02 * height)))

    def labels(self, record: int) -> list[Label]:
        """The words that are written into the picture."""
        if self.surroundings is None:
            return []
        *still, roof = self.surroundings.labels
        x, y, z = roof.place
        return [*still, Label(roof.text, (x, y + self.roof(record), z))]

    def front_of(self, pin: PinView, record: int) -> Vector3:
        """The place of the end of a pin which the camera sees [m]."""
        x, y, _ = pin.path[record]
        ends = [one.mesh.bounds[1, 2] for one in self.look.shapes if one.name.startswith(f"pin_{pin.name}")]
        return float(x), float(y), float(max(ends, default=self.points[:, 2].max()))


# --- around a support ---

FLOOR: Colour = (0.74, 0.72, 0.68)
ROOF: Colour = (0.66, 0.64, 0.61)
COAL: Colour = (0.23, 0.23, 0.25)
ROCK: Colour = (0.53, 0.51, 0.49)
STEEP = 0.5  # how far the heap leans back, of its depth
GAP = 0.02  # between things that do not make contact, of the machine's length
BEHIND = 0.30  # how far the goaf reaches, of the machine's length
BROKEN = ((0.05, 0.0), (0.0, 0.35), (0.03, 0.6), (-0.03, 1.0))  # edge of the roof: of length, of thickness


class Surroundings:
    """The things that do not move, the roof, and their names.

    still: in ground's axes. roof: its lower face at the height 0. labels: names of things; that of the roof is
    the last, measured from its lower face. points: corners that should be in the picture (n, 3) [m].

    Arguments:
        machine: points of its surface at all times (n, 3) [m].
        floor: height of the ground [m].
        roof_height: of the roof's lower face, at the start of a picture [m].
    """

    def __init__(self, machine: Series, floor: float, roof_height: float) -> None:
        self.roof_height = roof_height
        rear, front = float(machine[:, 0].min()), float(machine[:, 0].max())
        length, deep, height = front - rear, float(np.abs(machine[:, 2]).max()), roof_height - floor
        thick, face, back = 0.085 * length, front + 2.0 * GAP * length, rear - GAP * length
        left, right, edge = face + 0.085 * length, back - BEHIND * length, back - 0.02 * length
        heap = floor + 0.82 * height
        behind = Polygon([(right, floor), (back, floor), (back - STEEP * (back - right), heap), (right, heap)])
        above = Polygon([(face, 0.0), *((edge + x * length, y * thick) for x, y in BROKEN), (face, thick)])
        self.still = (
            MeshItem(plate(box(right, floor - 0.035 * length, left, floor), 0.125 * deep, 2.25 * deep), FLOOR),
            MeshItem(plate(box(face, floor, left, roof_height + thick), -0.5 * deep, deep), COAL),
            MeshItem(plate(behind, -0.5 * deep, deep), ROCK),
        )
        self.roof = MeshItem(plate(above, -0.5 * deep, deep), ROOF)
        self.labels = (
            Label("coal\nface", (0.5 * (face + left), floor + 0.5 * height, 0.0), light=True),
            Label("floor", (face - 0.16 * length, floor - 0.0175 * length, 1.25 * deep)),
            Label("goaf", (right + 0.22 * (back - right), floor + 0.95 * height, 0.0)),
            Label("roof", (0.5 * (face + edge), 0.5 * thick, 0.0)),
        )
        ends = np.array([[x, roof_height + thick, -deep] for x in (face, edge)])
        self.points = np.concatenate([*(item.mesh.bounding_box.vertices for item in self.still), ends])
