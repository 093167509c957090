"""A run as the engine's ray tracer sees it: a camera that stands still, and the machine's surfaces."""

import os
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np
import numpy.typing as npt
from exudyn import graphics
from exudyn.utilities import NodeRigidBodyEP, ObjectRigidBody, VObjectRigidBody
from scipy.spatial.transform import Rotation
from trimesh import Trimesh
from trimesh.graph import smooth_shade

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.loads.roofs import Roof
from support_exudyn.postprocessing.look.looks import look
from support_exudyn.postprocessing.look.poses import Poses
from support_exudyn.postprocessing.look.shapes import COLOURS, EDGE, Colour, Role
from support_exudyn.postprocessing.render.pin_views import PinView
from support_exudyn.simulation.result import Result
from user_forces.values.value import Vector3

Picture = npt.NDArray[np.uint8]  # height, width, 3

# from the right side of the machine, so that forward is to the right; then turned to its front and lifted [rad]
VIEW = Rotation.from_euler("yx", [-0.26, 0.17])
STATES = 33  # records, spread over the run, by which the camera is set
SHARP = 0.5  # [rad] between two faces, from which on an edge is seen; a round one of 32 sections turns by 0.2
SEEN = 0.25  # pixels by which something has to move before it is drawn anew
SLAB = 0.04  # thickness of floor and roof, of the machine's length
ROCK = COLOURS[Role.GROUND]
LIGHTS = (  # from the right, above, the eye; shadow; brightness
    ([-0.45, 0.8, 0.9, 0.0], 0.3, 0.62),
    ([0.8, 0.25, 0.7, 0.0], 0.0, 0.36),
)


@dataclass(frozen=True)
class Camera:
    """A parallel projection in the direction `VIEW` from points in space to pixels.

    centre: the point in the middle of the picture [m]. scale: pixels to a metre. size: width and height of the
    picture [pixels].
    """

    centre: Series
    scale: float
    size: tuple[int, int]

    @staticmethod
    def fitted(points: Series, size: tuple[int, int]) -> "Camera":
        """The camera that sees all points (n, 3), with a margin of a fiftieth on all sides."""
        seen = VIEW.apply(points)
        low, high = seen.min(axis=0), seen.max(axis=0)
        scale = float(np.min(0.96 * np.array(size) / np.maximum((high - low)[:2], 1e-9)))
        return Camera(VIEW.inv().apply(0.5 * (low + high)), scale, size)

    def pixels(self, points: Series) -> Series:
        """The pixels (n, 2) of points (n, 3), to the right and down from the upper left corner."""
        seen = VIEW.apply(np.atleast_2d(points) - self.centre)
        return np.asarray(0.5 * np.array(self.size) + self.scale * seen[:, :2] * [1.0, -1.0])


def engine_surface(mesh: Trimesh, colour: Colour) -> dict[str, Any]:
    """A surface as graphics data of the engine: smooth between its sharp edges, which are drawn as lines.

    The engine's own smoothing rounds points, and takes seconds. The ends of edges, which no triangle uses, come
    last among the points.
    """
    smooth = smooth_shade(mesh, angle=SHARP)
    sharp = mesh.face_adjacency_edges[mesh.face_adjacency_angles > SHARP]
    points = np.concatenate([smooth.vertices, mesh.vertices[sharp.ravel()]])
    normals = np.zeros_like(points)
    normals[:, 2] = 1.0
    normals[: len(smooth.vertices)] = smooth.vertex_normals
    surface = graphics.FromPointsAndTrigs(points, smooth.faces, [*colour, 1.0], normals)
    lines = np.arange(len(smooth.vertices), len(points), dtype=np.int64)
    return {**surface, "edges": lines, "edgeColor": [*EDGE, 1.0]}


class Stage:
    """The machine of a run, a floor below a support, and roofs that press on it.

    Arguments:
        result: the run.
        size: width and height of pictures [pixels].

    Raises InputError if the run has not recorded where its bodies are.
    """

    def __init__(self, result: Result, size: tuple[int, int]) -> None:
        self.look, self._poses = look(result.scenario), Poses(result)
        records = np.unique(np.linspace(0, result.time.size - 1, STATES).astype(int)).tolist()
        points = np.concatenate([self._corners(record) for record in records])
        low, high = points.min(axis=0), points.max(axis=0)
        length, depth = high[0] - low[0], 1.2 * np.abs(points[:, 2]).max()
        thick, middle = SLAB * length, 0.5 * (low[0] + high[0])
        slabs = []  # each with its lower face at the height 0, its colour, and this height at the records
        if any(shape.role is Role.CANOPY for shape in self.look.shapes):  # a support
            slab = graphics.Brick([middle, 0.5 * thick, 0.0], [1.1 * length, thick, 2.0 * depth], [*ROCK, 1.0])
            slabs.append((slab, np.full(result.time.size, self.look.floor - thick)))
        for load in result.scenario.acting_loads.values():
            if isinstance(load, Roof):  # cut through in the plane of symmetry, so that it hides nothing
                place, size_m = [middle, 0.5 * thick, -0.5 * depth], [1.1 * length, thick, depth]
                tops = [shape.mesh.bounds[1, 1] for shape in self.look.of(load.body)]
                top = max(tops, default=load.point[1]) + load.gap
                heights = [top - load.descent.extension(time) for time in result.time.tolist()]
                slabs.append((graphics.Brick(place, size_m, [*ROCK, 1.0]), np.array(heights)))
        self.slabs = [heights for _, heights in slabs]
        ends = [low[0] - 0.05 * length, high[0] + 0.05 * length], [-depth, depth]
        around = [
            (x, y, z) for one in self.slabs for y in (one.min(), one.max()) for x in ends[0] for z in ends[1]
        ]
        self.camera = Camera.fitted(np.concatenate([points, np.reshape(around, (-1, 3))]), size)
        surfaces = [engine_surface(shape.mesh, COLOURS[shape.role]) for shape in self.look.shapes]
        self._build([*surfaces, *(slab for slab, _ in slabs)])
        self._seen: tuple[Series, Picture] | None = None

    def _corners(self, record: int) -> Series:
        """The corners of boxes around all shapes at a record (n, 3) [m]."""
        frames = [(self._poses.frame(shape, record), shape) for shape in self.look.shapes]
        return np.concatenate([frame.points(one.mesh.bounding_box.vertices) for frame, one in frames])

    def _build(self, surfaces: list[dict[str, Any]]) -> None:
        """Make the engine's scene, without mechanics: a body for each surface."""
        self._container = exu.SystemContainer()
        self._system = self._container.AddSystem()
        for surface in surfaces:
            node = self._system.AddNode(NodeRigidBodyEP(referenceCoordinates=[0, 0, 0, 1, 0, 0, 0]))
            drawn = VObjectRigidBody(graphicsData=[surface])
            body = ObjectRigidBody(mass=1.0, inertia=[1, 1, 1, 0, 0, 0], nodeNumber=node, visualization=drawn)
            self._system.AddObject(body)
        self._system.Assemble()
        settings: Any = self._container.visualizationSettings
        settings.view0.window.showComputationInfo = False
        settings.view0.scene.drawCoordinateSystem = 0
        settings.view0.scene.drawWorldBasis = False
        settings.nodes.show = False
        settings.general.backgroundColor = [1.0, 1.0, 1.0, 1.0]
        settings.general.useGradientBackground = False
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        settings.raytracer.multiSampling, settings.raytracer.numberOfThreads = 2, cores
        settings.raytracer.advanced.showText = False
        settings.raytracer.advanced.zBiasLines = 5e-4
        settings.openGL.lineWidth = 1.2
        settings.openGL.lightModelAmbient = [0.46, 0.46, 0.46, 1.0]
        lights = settings.openGL.light0, settings.openGL.light1
        for light, (where, shadow, bright) in zip(lights, LIGHTS, strict=True):
            light.enable, light.position, light.shadow = True, where, shadow
            light.useCameraFrame, light.diffuse, light.specular = True, bright, 0.2
        window, camera = settings.view0.window, self.camera
        window.renderWindowSize = [16, 16]
        self._container.renderer.RedrawAndGetImage(True)  # with its first picture the engine chooses a view
        window.renderWindowSize = list(camera.size)
        # its zoom is half of what is seen, and its centre is measured in the axes of the picture
        x, y, _ = VIEW.apply(camera.centre).tolist()
        turn = VIEW.as_rotvec().tolist()
        self._container.renderer.SetModelView(0.5 * camera.size[1] / camera.scale, turn, [x, y, 0.0])

    def image(self, record: int) -> Picture:
        """The machine at a record; the earlier picture if nothing has moved by a quarter of a pixel since."""
        heights = np.array([[0.0, one[record], 0.0] for one in self.slabs]).reshape(-1, 3)
        where = self.camera.pixels(np.concatenate([self._corners(record), heights]))
        if self._seen is not None and np.abs(where - self._seen[0]).max() <= SEEN:
            return self._seen[1]
        coordinates: list[float] = []
        for shape in self.look.shapes:
            frame = self._poses.frame(shape, record)
            x, y, z, w = Rotation.from_matrix(frame.axes).as_quat()
            coordinates += [*frame.origin, w - 1.0, x, y, z]
        for height in heights:
            coordinates += [*height, 0.0, 0.0, 0.0, 0.0]
        self._system.systemData.SetODE2Coordinates(coordinates)
        self._system.SendRedrawSignal()  # what is drawn is a copy, taken now
        picture: Picture = np.asarray(self._container.renderer.RedrawAndGetImage(True), dtype=np.uint8)
        self._seen = where, picture
        return picture

    def front_of(self, pin: PinView, record: int) -> Vector3:
        """The place of the end of a pin which the camera sees [m]."""
        x, y, _ = pin.path[record]
        own = [one.mesh.bounds[1, 2] for one in self.look.shapes if one.name.startswith(f"pin_{pin.name}")]
        every = [one.mesh.bounds[1, 2] for one in self.look.shapes]
        return float(x), float(y), float(max(own or every))
