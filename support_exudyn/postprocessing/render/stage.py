"""A camera that stands still, and a scene of the engine without mechanics: surfaces where a run has them."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np
import numpy.typing as npt
from exudyn.utilities import NodeRigidBodyEP, ObjectRigidBody, VObjectRigidBody
from scipy.spatial.transform import Rotation
from trimesh import Trimesh

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.look.solid import Colour
from support_exudyn.postprocessing.render.sheet import Image
from support_exudyn.postprocessing.viewer.engine_graphics import engine_surface

Pixels = npt.NDArray[np.float64]

# from the right side of the machine, so that forward is to the right; then turned to its front and lifted [rad]
TURN, LIFT = 0.26, 0.17


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

    @property
    def scale(self) -> float:
        """Pixels to a metre."""
        return self.height_px / self.height

    def pixels(self, points: Series) -> Pixels:
        """The pixels (n, 2) of points (n, 3), to the right and down from the upper left corner."""
        context = self.rotation.apply(np.atleast_2d(points) - np.array(self.centre))
        return np.column_stack(
            [
                0.5 * self.width_px + self.scale * context[:, 0],
                0.5 * self.height_px - self.scale * context[:, 1],
            ]
        )

    def arrow(self, vector: Series) -> Pixels:
        """A direction in space (3,) in the picture: per metre, to the right and down [pixels]."""
        right, up, _ = self.rotation.apply(vector)
        return np.array([right, -up]) * self.scale


def direction_of_view() -> Rotation:
    """The machine's right side, seen a little from the front and from above."""
    return Rotation.from_euler("yx", [-TURN, LIFT])


def fitted(points: Series, width_px: int, height_px: int, margins: tuple[int, int, int, int]) -> Camera:
    """The camera that sees all points (n, 3).

    margins: what is kept free of the picture, left, top, right, bottom [pixels].
    """
    rotation = direction_of_view()
    context = rotation.apply(points)
    low, high = context.min(axis=0), context.max(axis=0)
    left, above, right, below = margins
    free_x, free_y = max(width_px - left - right, 1), max(height_px - above - below, 1)
    wide, tall = (max(side, 1e-9) for side in (high - low)[:2])
    scale = min(free_x / wide, free_y / tall)  # pixels to a metre
    middle = 0.5 * (low + high)
    middle[0] += 0.5 * (right - left) / scale
    middle[1] += 0.5 * (above - below) / scale
    x, y, z = rotation.inv().apply(middle)
    return Camera(rotation, (x, y, z), height_px / scale, width_px, height_px)


# --- the stage ---

AMBIENT = 0.46  # light that comes from everywhere
SAMPLES = 2  # squared: rays to a pixel
LIGHT_FROM = (-0.45, 0.8, 0.9, 0.0)  # right, up, towards the eye
FILL_FROM = (0.8, 0.25, 0.7, 0.0)


@dataclass(frozen=True)
class MeshItem:
    """Something on the stage.

    Arguments:
        mesh: its surface in axes of its own [m].
        colour: RGB from 0 to 1.
        edges: whether edges are drawn.
    """

    mesh: Trimesh
    colour: Colour
    edges: bool = True


class Stage:
    """All props, and pictures of them."""

    def __init__(self, props: Sequence[MeshItem], camera: Camera, threads: int = 1) -> None:
        self._container = exu.SystemContainer()
        self._system = self._container.AddSystem()
        self._camera = camera
        for mesh_item in props:
            self._add(mesh_item)
        self._system.Assemble()
        self._settings(camera, threads)
        renderer = self._container.renderer
        window: Any = self._container.visualizationSettings.view0.window
        window.renderWindowSize = [16, 16]
        renderer.RedrawAndGetImage(True)  # with its first picture the engine chooses a view of its own
        window.renderWindowSize = [camera.width_px, camera.height_px]
        turn = [float(angle) for angle in camera.rotation.as_rotvec()]
        # its zoom is half of what is seen, and its centre is measured in the axes of the picture
        context = camera.rotation.apply(camera.centre)
        renderer.SetModelView(0.5 * camera.height, turn, [float(context[0]), float(context[1]), 0.0])

    def _add(self, mesh_item: MeshItem) -> None:
        """A body that nothing moves."""
        drawn = engine_surface(mesh_item.mesh, mesh_item.colour, mesh_item.edges).placed()
        node = self._system.AddNode(NodeRigidBodyEP(referenceCoordinates=[0, 0, 0, 1, 0, 0, 0]))
        self._system.AddObject(
            ObjectRigidBody(
                mass=1.0,
                inertia=[1, 1, 1, 0, 0, 0],
                nodeNumber=node,
                visualization=VObjectRigidBody(graphicsData=[drawn]),
            )
        )

    def _settings(self, camera: Camera, threads: int) -> None:
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
        settings.openGL.lineWidth = 1.2
        settings.openGL.lightModelAmbient = [AMBIENT, AMBIENT, AMBIENT, 1.0]
        settings.raytracer.advanced.zBiasLines = 5e-4
        for light, where, shadow, bright in (
            (settings.openGL.light0, LIGHT_FROM, 0.3, 0.62),
            (settings.openGL.light1, FILL_FROM, 0.0, 0.36),
        ):
            light.enable, light.position, light.shadow = True, list(where), shadow
            light.useCameraFrame, light.diffuse, light.specular = True, bright, 0.2

    def image(self, places: Iterable[tuple[Series, Series]]) -> Image:
        """A picture with props at places (3,) [m], turned by matrices (3, 3), in their order."""
        coordinates = []
        for place, turn in places:
            x, y, z, w = Rotation.from_matrix(turn).as_quat()
            coordinates += [*place, w - 1.0, x, y, z]
        self._system.systemData.SetODE2Coordinates(coordinates)
        self._system.SendRedrawSignal()  # what is drawn is a copy, taken now
        picture: Image = np.asarray(self._container.renderer.RedrawAndGetImage(True), dtype=np.uint8)
        return picture
