"""The engine's model of a run with the look of its machine, for the engine's windows.

Only what is drawn is added: surfaces of the bodies, and bodies of the ground, which have no coordinates. The
equations stay those of the model that runs.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import exudyn
import numpy as np
from exudyn.itemInterface import ObjectGround, VObjectGround

from support_exudyn.formulations.exudyn.scene.engine_scene import INITIAL, EngineScene
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.look.poses import strut_axes
from support_exudyn.postprocessing.look.solid import (
    COLOURS,
    DrawnActuator,
    Look,
    Role,
    Solid,
    solids_of,
)
from support_exudyn.postprocessing.render.pin_views import PinView
from support_exudyn.postprocessing.viewer.engine_graphics import EngineSurface, engine_surface
from support_exudyn.postprocessing.viewer.pin_insets import PinInsets
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector3

STILL_TIME = np.zeros(1)
SHOWN = exudyn.ConfigurationType.Visualization
POSITION = exudyn.OutputVariableType.Position


@dataclass(frozen=True)
class ViewerModel:
    """A model and its look.

    scene: the model; its `release` ends it. look: all that is drawn.
    insets: of clearance pins, beside the machine.
    """

    scene: EngineScene
    look: Look
    insets: PinInsets

    def place(self, body: str, point: Vector3) -> Series:
        """The place of a point of the start posture in the state that is shown [m]."""
        if body == GROUND:
            return np.array(point)
        item = self.scene.bodies[body]
        local = np.array(point) - _centre(self.scene, body)
        return np.array(self.scene.mbs.GetObjectOutputBody(item.object, POSITION, local, SHOWN))


def model_for_viewer(
    scenario: Scenario, views: Sequence[PinView] = (), time: Series = STILL_TIME
) -> ViewerModel:
    """The model of a scenario, as `model` makes it, with the look of its machine.

    views, time: pins whose journals and forces are shown next to it, and the times of their records [s].
    """
    scene, look = build(scenario), looks.look(scenario)
    corners = np.concatenate([solid.mesh.bounds for solid in look.solids])
    insets = PinInsets(views, time, corners.min(axis=0), corners.max(axis=0))
    shown = ViewerModel(scene, look, insets)
    for name, item in scene.bodies.items():
        drawn = [_of_solid(solid, _centre(scene, name)) for solid in solids_of(look, name)]
        scene.mbs.SetObjectParameter(item.object, "VgraphicsData", drawn)
    still = [_of_solid(solid) for solid in solids_of(look, GROUND)]
    scene.mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=still)))
    moving = [part for strut in look.struts for part in _parts(shown, strut)]
    scene.mbs.AddObject(
        ObjectGround(
            visualization=VObjectGround(
                graphicsDataUserFunction=lambda mbs, item: [
                    *(part() for part in moving),
                    *insets.graphics(mbs.systemData.GetTime(SHOWN)),
                ]
            )
        )
    )
    kept = scene.mbs.systemData.GetSystemState(INITIAL)  # which assembling would set back
    scene.mbs.Assemble()
    scene.mbs.systemData.SetSystemState(kept, INITIAL)
    return shown


# --- what bodies show ---


STILL = np.zeros(3)


def _centre(scene: EngineScene, name: str) -> Series:
    """A body's centre of mass in the start posture (3,) [m]; its axes are those of the ground then."""
    found, centre = np.zeros(3), scene.bodies[name].body.centre
    found[: len(centre)] = centre
    return found


def _of_solid(solid: Solid, centre: Series = STILL) -> dict[str, Any]:
    mesh = solid.mesh.copy()
    mesh.vertices = mesh.vertices - centre
    return engine_surface(mesh, COLOURS[solid.role]).placed()


# --- actuators ---


def _parts(shown: ViewerModel, strut: DrawnActuator) -> Iterator[Callable[[], dict[str, Any]]]:
    """Cylinder and rod of an actuator; called, they are where the state that is shown has them."""
    cylinder = engine_surface(strut.cylinder, COLOURS[Role.CYLINDER])
    rod = engine_surface(strut.rod, COLOURS[Role.ROD])

    def part(surface: EngineSurface, end: int) -> dict[str, Any]:
        ends = shown.place(strut.foot, strut.foot_point), shown.place(strut.head, strut.head_point)
        return surface.placed(strut_axes(ends[1] - ends[0]), ends[end])

    yield partial(part, cylinder, 0)
    yield partial(part, rod, 1)
