"""A run as a scene: the machine's surfaces, what stands around them, and where all of it is at a record."""

from collections.abc import Iterator
from functools import cached_property

import numpy as np

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.roofs import Roof
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import MovingPart, Poses, moving_parts
from support_exudyn.postprocessing.look.solid import COLOURS, Look, Role
from support_exudyn.postprocessing.render.pin_views import PinView
from support_exudyn.postprocessing.render.scenery import GAP, Label, Surroundings, surroundings
from support_exudyn.postprocessing.render.stage import Camera, MeshItem, fitted
from support_exudyn.simulation.result import Result
from user_forces.values.value import Vector3

LOOKED_AT = 33  # records, spread over the run, by which the picture's frame is chosen
UNTURNED = np.eye(3)
NOWHERE = np.zeros(3)


class RenderedScene:
    """The scene of a run. Raises InputError if the run has not recorded where its bodies are."""

    def __init__(self, result: Result) -> None:
        self.result = result
        self.look: Look = look(result.scenario)
        self.parts = moving_parts(self.look, Poses(result))
        self.records = np.unique(np.linspace(0, result.time.size - 1, LOOKED_AT).astype(int)).tolist()

    @cached_property
    def points(self) -> Series:
        """The outermost points of the machine at these records, shape (n, 3) [m]."""
        return np.concatenate([self._hull(part, record) for part in self.parts for record in self.records])

    def corners(self, record: int) -> Series:
        """The corners of boxes around all that may move, at a record, shape (n, 3) [m]."""
        found = [part.frame(record).points(part.mesh.bounding_box.vertices) for part in self.parts]
        if self.surroundings is not None:
            found.append(np.array([[0.0, self.roof(record), 0.0]]))
        return np.concatenate(found)

    def _hull(self, part: MovingPart, record: int) -> Series:
        """The outermost points of a part (n, 3) [m]."""
        return part.frame(record).points(part.mesh.convex_hull.vertices)

    @cached_property
    def surroundings(self) -> Surroundings | None:
        """The surroundings of a support; None of machines without a canopy."""
        canopies = [part for part in self.parts if part.role is Role.CANOPY]
        if not canopies:
            return None
        length = float(np.ptp(self.points[:, 0]))
        highest = max(self._hull(one, record)[:, 1].max() for one in canopies for record in self.records)
        half_width = float(np.abs(self.points[:, 2]).max())
        roof = self._face(0)
        height = highest + 0.25 * GAP * length if roof is None else roof
        return surroundings(self.points, self.look.floor, height, half_width)

    def _face(self, record: int) -> float | None:
        """Height of the lowest roof that presses on the canopy, at its upper face [m]; None without one."""
        found = []
        for load in self.result.scenario.acting_loads.values():
            if isinstance(load, Roof):
                solids = [solid for solid in self.look.solids if solid.body == load.body]
                top = max((solid.mesh.bounds[1, 1] for solid in solids), default=load.point[1])
                found.append(top + load.gap - load.descent.extension(float(self.result.time[record])))
        return min(found, default=None)

    def props(self) -> list[MeshItem]:
        """All surfaces, each in axes of its own."""
        found = [MeshItem(part.mesh, COLOURS[part.role]) for part in self.parts]
        around = self.surroundings
        return found if around is None else [*found, *around.props, around.roof]

    def places(self, record: int) -> Iterator[tuple[Series, Series]]:
        """The place (3,) [m] and the turn (3, 3) of each of these at a record."""
        for part in self.parts:
            frame = part.frame(record)
            yield frame.origin, frame.axes
        if self.surroundings is not None:
            yield from ((NOWHERE, UNTURNED) for _ in self.surroundings.props)
            yield np.array([0.0, self.roof(record), 0.0]), UNTURNED

    def roof(self, record: int) -> float:
        """Height of the roof's lower face [m]."""
        assert self.surroundings is not None
        face = self._face(record)
        return self.surroundings.roof_height if face is None else face

    def camera(self, width: int, height: int) -> Camera:
        """The camera that sees all of it over the whole run."""
        around = self.surroundings
        points = self.points if around is None else np.concatenate([self.points, around.points])
        margin = max(2, round(0.02 * height))
        return fitted(points, width, height, (margin, margin, margin, margin))

    def labels(self, record: int) -> list[Label]:
        """The words that are written into the picture."""
        if self.surroundings is None:
            return []
        word = self.surroundings.roof_label
        x, y, z = word.place
        return [*self.surroundings.labels, Label(word.text, (x, y + self.roof(record), z), word.light)]

    def context(self, pin: PinView, record: int) -> Vector3:
        """The place of that end of a pin which the camera sees [m]."""
        x, y, _ = pin.path[record]
        ends = [s.mesh.bounds[1, 2] for s in self.look.solids if s.name.startswith(f"pin_{pin.name}")]
        return float(x), float(y), float(max(ends, default=self.points[:, 2].max()))
