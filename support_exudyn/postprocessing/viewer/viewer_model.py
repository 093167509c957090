"""The engine's model of a run with the look of its machine, for the engine's windows.

Only what is drawn is added: surfaces of the bodies, and bodies of the ground, which have no coordinates. The
equations stay those of the model that runs.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
from exudyn import graphics
from exudyn.itemInterface import ObjectGround, VObjectGround

from support_exudyn.formulations.exudyn.scene.engine_scene import INITIAL, EngineScene
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.look.poses import axes_along
from support_exudyn.postprocessing.look.shapes import COLOURS, Look, Shape
from support_exudyn.postprocessing.render.pin_views import PinView
from support_exudyn.postprocessing.render.stage import engine_surface
from support_exudyn.postprocessing.viewer.pin_insets import PinInsets
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector3

NO_TIMES, NO_RATE = np.zeros(1), np.zeros(3)
SHOWN = exudyn.ConfigurationType.Visualization
POSITION = exudyn.OutputVariableType.Position


@dataclass(frozen=True)
class ViewerModel:
    """A model and its look.

    scene: the model; its `release` ends it. look: all that is drawn.
    insets: of clearance pins, next to the machine.
    """

    scene: EngineScene
    look: Look
    insets: PinInsets

    def centre(self, body: str) -> Series:
        """A body's centre of mass in the start posture (3,) [m]."""
        return np.array([*self.scene.bodies[body].body.centre, 0.0][:3])

    def place(self, body: str, point: Vector3) -> Series:
        """The place of a point of the start posture in the state that is shown [m]."""
        if body == GROUND:
            return np.array(point)
        item, local = self.scene.bodies[body].object, np.array(point) - self.centre(body)
        return np.array(self.scene.mbs.GetObjectOutputBody(item, POSITION, local, SHOWN))

    def fixed(self, body: str) -> list[dict[str, Any]]:
        """The graphics data of a body's shapes, from its centre of mass."""
        start = NO_RATE if body == GROUND else self.centre(body)
        return [graphics.Move(_surface(shape), -start) for shape in self.look.of(body)]

    def moving(self) -> list[Callable[[], dict[str, Any]]]:
        """The graphics data of the shapes of struts; called, they are where the shown state has them."""
        return [self._moving(shape, _surface(shape)) for shape in self.look.shapes if shape.strut]

    def _moving(self, shape: Shape, surface: dict[str, Any]) -> Callable[[], dict[str, Any]]:
        def placed() -> dict[str, Any]:
            assert shape.strut is not None  # of which this is a part
            ends = [self.place(*end) for end in shape.strut.ends]
            moved: dict[str, Any] = graphics.Move(
                surface, ends[shape.end], axes_along(ends[1] - ends[0], NO_RATE)[0]
            )
            return moved

        return placed


def _surface(shape: Shape) -> dict[str, Any]:
    return engine_surface(shape.mesh, COLOURS[shape.role])


def model_for_viewer(scenario: Scenario, views: Sequence[PinView] = (), time: Series = NO_TIMES) -> ViewerModel:
    """The model of a scenario, as `model` makes it, with the look of its machine.

    views, time: pins whose journals and forces are shown next to it, and the times of their records [s].
    """
    scene, look = build(scenario), looks.look(scenario)
    corners = np.concatenate([shape.mesh.bounds for shape in look.shapes if shape.strut is None])
    insets = PinInsets(views, time, corners.min(axis=0), corners.max(axis=0))
    shown = ViewerModel(scene, look, insets)
    for name, item in scene.bodies.items():
        scene.mbs.SetObjectParameter(item.object, "VgraphicsData", shown.fixed(name))
    scene.mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=shown.fixed(GROUND))))
    moving = shown.moving()

    def drawn(mbs: Any, _: int) -> list[dict[str, Any]]:
        return [*(part() for part in moving), *insets.graphics(mbs.systemData.GetTime(SHOWN))]

    scene.mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsDataUserFunction=drawn)))
    kept = scene.mbs.systemData.GetSystemState(INITIAL)  # which assembling would set back
    scene.mbs.Assemble()
    scene.mbs.systemData.SetSystemState(kept, INITIAL)
    return shown
