"""A camera that stands still, and a scene of the engine without mechanics: surfaces where a run has them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import exudyn as exu
import numpy as np
import numpy.typing as npt
from exudyn import graphics
from exudyn.utilities import NodeRigidBodyEP, ObjectRigidBody, VObjectRigidBody
from scipy.spatial.transform import Rotation
from trimesh import Trimesh
from trimesh.graph import smooth_shade

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.shapes import EDGE, Colour

Pixels = npt.NDArray[np.float64]
Picture = npt.NDArray[np.uint8]  # height, width, 3

# from the right side of the machine, so that forward is to the right; then turned to its front and lifted [rad]
TURN, LIFT = 0.26, 0.17
SHARP = 0.5  # [rad] between two faces, from which on an edge is seen; a round one of 32 sections turns by 0.2


def direction_of_view() -> Rotation:
    """The machine's right side, seen a little from the front and from above."""
    return Rotation.from_euler("yx", [-TURN, LIFT])


@dataclass(frozen=True)
class Camera:
    """A parallel projection from points in space to pixels.

    Arguments:
        rotation: from ground's axes to right, up and towards the eye.
        centre: the point in the middle of the picture [m].
        height: what of the scene is as high as the picture [m].
        width_px, height_px: size of the picture [pixels].
    """

    rotation: Rotation
    centre: tuple[float, float, float]
    height: float
    width_px: int
    height_px: int

    @staticmethod
    def fitted(points: Series, width_px: int, height_px: int, margin: int) -> "Camera":
        """The camera that sees all points (n, 3), with a margin free of them on all sides [pixels]."""
        rotation = direction_of_view()
        seen = rotation.apply(points)
        low, high = seen.min(axis=0), seen.max(axis=0)
        free = np.maximum([width_px - 2 * margin, height_px - 2 * margin], 1)
        scale = float(np.min(free / np.maximum((high - low)[:2], 1e-9)))  # pixels to a metre
        x, y, z = rotation.inv().apply(0.5 * (low + high))
        return Camera(rotation, (x, y, z), height_px / scale, width_px, height_px)

    @property
    def scale(self) -> float:
        """Pixels to a metre."""
        return self.height_px / self.height

    def pixels(self, points: Series) -> Pixels:
        """The pixels (n, 2) of points (n, 3), to the right and down from the upper left corner."""
        seen = self.rotation.apply(np.atleast_2d(points) - np.array(self.centre))
        middle = 0.5 * np.array([self.width_px, self.height_px])
        return np.asarray(middle + self.scale * seen[:, :2] * [1.0, -1.0])

    def arrow(self, vector: Series) -> Pixels:
        """A direction in space (3,) in the picture: per metre, to the right and down [pixels]."""
        return np.asarray(self.rotation.apply(vector)[:2] * [1.0, -1.0] * self.scale)


# --- the stage ---

AMBIENT = 0.46  # light that comes from everywhere
SAMPLES = 2  # squared: rays to a pixel
LIGHT_FROM = (-0.45, 0.8, 0.9, 0.0)  # right, up, towards the eye
FILL_FROM = (0.8, 0.25, 0.7, 0.0)


class MeshItem(NamedTuple):
    """A surface on the stage, in axes of its own [m], and its colour, RGB from 0 to 1."""

    mesh: Trimesh
    colour: Colour


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
    """All items, and pictures of them."""

    def __init__(self, items: Sequence[MeshItem], camera: Camera, threads: int = 1) -> None:
        self._container = exu.SystemContainer()
        self._system = self._container.AddSystem()
        for item in items:
            node = self._system.AddNode(NodeRigidBodyEP(referenceCoordinates=[0, 0, 0, 1, 0, 0, 0]))
            drawn = VObjectRigidBody(graphicsData=[engine_surface(*item)])
            body = ObjectRigidBody(mass=1.0, inertia=[1, 1, 1, 0, 0, 0], nodeNumber=node, visualization=drawn)
            self._system.AddObject(body)
        self._system.Assemble()
        self._settings(threads)
        renderer = self._container.renderer
        window: Any = self._container.visualizationSettings.view0.window
        window.renderWindowSize = [16, 16]
        renderer.RedrawAndGetImage(True)  # with its first picture the engine chooses a view of its own
        window.renderWindowSize = [camera.width_px, camera.height_px]
        turn = [float(angle) for angle in camera.rotation.as_rotvec()]
        # its zoom is half of what is seen, and its centre is measured in the axes of the picture
        x, y, _ = camera.rotation.apply(camera.centre).tolist()
        renderer.SetModelView(0.5 * camera.height, turn, [x, y, 0.0])

    def _settings(self, threads: int) -> None:
        settings: Any = self._container.visualizationSettings
        settings.view0.window.showComputationInfo = False
        settings.view0.scene.drawCoordinateSystem = 0
        settings.view0.scene.drawWorldBasis = False
        settings.nodes.show = False
        settings.general.backgroundColor = [1.0, 1.0, 1.0, 1.0]
        settings.general.useGradientBackground = False
        settings.raytracer.multiSampling = SAMPLES
        settings.raytracer.numberOfThreads = threads
        settings.raytracer.advanced.showText = False
        settings.raytracer.advanced.zBiasLines = 5e-4
        settings.openGL.lineWidth = 1.2
        settings.openGL.lightModelAmbient = [AMBIENT, AMBIENT, AMBIENT, 1.0]
        for light, where, shadow, bright in (
            (settings.openGL.light0, LIGHT_FROM, 0.3, 0.62),
            (settings.openGL.light1, FILL_FROM, 0.0, 0.36),
        ):
            light.enable, light.position, light.shadow = True, list(where), shadow
            light.useCameraFrame, light.diffuse, light.specular = True, bright, 0.2

    def image(self, places: Iterable[tuple[Series, Series]]) -> Picture:
        """A picture with items at places (3,) [m], turned by matrices (3, 3), in their order."""
        coordinates = []
        for place, turn in places:
            x, y, z, w = Rotation.from_matrix(turn).as_quat()
            coordinates += [*place, w - 1.0, x, y, z]
        self._system.systemData.SetODE2Coordinates(coordinates)
        self._system.SendRedrawSignal()  # what is drawn is a copy, taken now
        picture: Picture = np.asarray(self._container.renderer.RedrawAndGetImage(True), dtype=np.uint8)
        return picture
