"""The engine's model of a run with the look of its machine, for the engine's windows.

Only what is drawn is added: surfaces of the bodies, and bodies of the ground, which have no coordinates. The
equations stay those of the model that runs. Below the machine stand its clearance pins, the clearance enlarged.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import exudyn
import numpy as np
from exudyn import graphics
from exudyn.itemInterface import ObjectGround, VObjectGround
from matplotlib.colors import to_rgb

from support_exudyn.formulations.exudyn.scene.engine_scene import INITIAL, EngineScene
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.figures.units import said_beside
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.look.poses import axes_along
from support_exudyn.postprocessing.look.shapes import COLOURS, Look, Shape
from support_exudyn.postprocessing.render.pin_views import PinView, format_round, usual
from support_exudyn.postprocessing.render.stage import engine_surface
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import Vector3

Graphics = dict[str, Any]  # of the engine
NO_TIMES = np.zeros(1)
SHOWN = exudyn.ConfigurationType.Visualization
POSITION = exudyn.OutputVariableType.Position
# --- insets ---
RADIUS = 0.07  # of a bore, of the machine's length
APART = 3.2  # distance of bores, in radii
REACH = 1.8  # of an inset around its middle, in radii
LONGEST = 1.5  # of an arrow, in radii: that of the usual force is as long as the radius
HEAD = 0.25  # of an arrow, of its length
CORNERS = 48  # of a circle
INK, JOURNAL = [0.1, 0.1, 0.1, 1.0], [0.45, 0.45, 0.48, 1.0]


@dataclass(frozen=True)
class ViewerModel:
    """A model and its look.

    scene: the model; its `release` ends it. look: all that is drawn of the machine.
    corners: of all insets of clearance pins, shape (n, 3) [m].
    """

    scene: EngineScene
    look: Look
    corners: Series

    def place(self, body: str, point: Vector3) -> Series:
        """The place of a point of the start posture in the state that is shown [m]."""
        if body == GROUND:
            return np.array(point)
        item, local = self.scene.bodies[body].object, np.array(point) - _centre(self.scene, body)
        return np.array(self.scene.mbs.GetObjectOutputBody(item, POSITION, local, SHOWN))

    def fixed(self, body: str) -> list[Graphics]:
        """The graphics data of a body's shapes, from its centre of mass."""
        return [graphics.Move(_surface(shape), -_centre(self.scene, body)) for shape in self.look.of(body)]

    def moving(self) -> list[Callable[[], Graphics]]:
        """The graphics data of the shapes of struts; called, they are where the shown state has them."""
        return [self._moving(shape, _surface(shape)) for shape in self.look.shapes if shape.strut]

    def _moving(self, shape: Shape, surface: Graphics) -> Callable[[], Graphics]:
        def placed() -> Graphics:
            assert shape.strut is not None  # of which this is a part
            ends = [self.place(*end) for end in shape.strut.ends]
            moved: Graphics = graphics.Move(surface, ends[shape.end], axes_along(ends[1] - ends[0]))
            return moved

        return placed


def _centre(scene: EngineScene, body: str) -> Series:
    """A body's centre of mass in the start posture (3,) [m]; zero of the ground."""
    return np.zeros(3) if body == GROUND else np.array([*scene.bodies[body].body.centre, 0.0][:3])


def _surface(shape: Shape) -> Graphics:
    return engine_surface(shape.mesh, COLOURS[shape.role])


def model_for_viewer(scenario: Scenario, views: Sequence[PinView] = (), time: Series = NO_TIMES) -> ViewerModel:
    """The model of a scenario, as `model` makes it, with the look of its machine.

    views, time: pins whose journals and forces are shown below it, and the times of their records [s].
    """
    scene, look = build(scenario), looks.look(scenario)
    bounds = np.concatenate([shape.mesh.bounds for shape in look.shapes if shape.strut is None])
    loose = [view for view in views if view.is_loose]
    (left, low, depth), (right, _, _) = bounds.min(axis=0), bounds.max(axis=0)  # the view is along z
    radius = RADIUS * (right - left)
    x = 0.5 * (left + right) + APART * radius * (np.arange(len(loose)) - 0.5 * (len(loose) - 1))
    centres = np.column_stack([x, np.full_like(x, low - 2.0 * radius), np.full_like(x, depth)])
    reach = REACH * radius * np.array([1.0, 1.0, 0.0])
    shown = ViewerModel(scene, look, np.concatenate([centres - reach, centres + reach]))
    for name, item in scene.bodies.items():
        scene.mbs.SetObjectParameter(item.object, "VgraphicsData", shown.fixed(name))
    scene.mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=shown.fixed(GROUND))))
    moving, force = shown.moving(), max((usual(view.size) for view in loose), default=1.0)

    def drawn(mbs: Any, _: int) -> list[Graphics]:
        record = int(np.abs(time - mbs.systemData.GetTime(SHOWN)).argmin())
        pairs = zip(loose, centres, strict=True)
        insets = [part for view, centre in pairs for part in _inset(view, centre, radius, force, record)]
        return [*(part() for part in moving), *insets]

    scene.mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsDataUserFunction=drawn)))
    kept = scene.mbs.systemData.GetSystemState(INITIAL)  # which assembling would set back
    scene.mbs.Assemble()
    scene.mbs.systemData.SetSystemState(kept, INITIAL)
    return shown


def _inset(view: PinView, centre: Series, radius: float, usual_force: float, record: int) -> Iterator[Graphics]:
    """A journal in its bore at a record, and the force on it: the usual one is as long as the radius.

    centre, radius: of the drawn bore [m].
    """
    aside, inner = view.enlarged(record, radius)
    at, colour = centre + np.append(aside, 0.0), (*to_rgb(CONTACT if view.closed[record] else FLIGHT), 1.0)
    thin = np.array([0.0, 0.0, 0.01 * inner])  # the disc lies behind the lines
    yield graphics.Cylinder([*(at + thin)], [*thin], inner, JOURNAL, nTiles=CORNERS)
    yield graphics.Circle([*centre], radius, INK)
    yield graphics.Circle([*at], inner, colour)
    size = float(view.size[record])
    if size > 0.0:
        x, y = min(size / usual_force, LONGEST) * radius * view.force[record] / size
        way, across = np.array([x, y, 0.0]), np.array([-y, x, 0.0])
        tip = at + way
        for start in (at, *(tip - HEAD * (way + side * across) for side in (-0.5, 0.5))):
            yield graphics.Lines([[*start], [*tip]], colour)
    force = said_beside(size, "N", float(view.size.max(initial=0.0)))
    lines = view.name.replace("_", " "), f"{force}, gap x {format_round(view.enlargement)}"
    for n, words in enumerate(lines):
        place = centre + radius * np.array([1.0, -1.4 - 0.4 * n, 0.0])  # x points to the left here
        yield graphics.Text([*place], words, INK)
