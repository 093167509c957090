"""Exudyn's solution viewer on a run: its model with the look of the machine, moving as it did."""

import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import exudyn
import numpy as np
from exudyn import graphics
from exudyn.basicUtilities import SetSolutionState
from exudyn.itemInterface import ObjectGround, VObjectGround

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.formulations.exudyn.scene.engine_scene import INITIAL, EngineScene
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.export.solution_file import check_fits, read_solution, rows
from support_exudyn.postprocessing.figures.selection import machine_name
from support_exudyn.postprocessing.look import looks
from support_exudyn.postprocessing.look.poses import Poses, axes_along
from support_exudyn.postprocessing.look.shapes import COLOURS, Look, Shape
from support_exudyn.postprocessing.render.stage import engine_surface
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.provenance import installed
from support_exudyn.simulation.result import Result
from user_forces.values.value import Vector3

Graphics = dict[str, Any]  # of the engine
SHOWN = exudyn.ConfigurationType.Visualization
POSITION = exudyn.OutputVariableType.Position
INSTEAD = (
    "allowed: a desktop with OpenGL, and tkinter (on Debian: apt-get install python3-tk); "
    "`python -m support_exudyn render RUN` writes pictures without a window, and "
    "`xvfb-run -a python -m support_exudyn view RUN` opens the window on a display in memory"
)
LONGEST = 120.0  # [s] that trying may take, on a slow machine or a distant display
TRY = """
import tkinter
tkinter.Tk().destroy()
import exudyn
container = exudyn.SystemContainer()
container.visualizationSettings.view0.window.showWindow = False
container.visualizationSettings.view0.window.renderWindowSize = [64, 64]
container.renderer.Start()
active = container.renderer.IsActive()
container.renderer.Stop()
if not active:
    raise SystemExit("the engine's window did not open")
"""
MADE_WITH = ("exudyn", "support-exudyn")  # packages on which the model depends
WINDOW = (1200, 750)  # width and height [pixels]
FRAME, LASTS = 0.04, 10.0  # [s] of a frame, and that a run takes in the viewer by default
MOST_SKIPPED = 200  # rows from frame to frame, as many as the viewer's slider has
MOST_STATES = 60  # by which the camera is set
MARGIN, WORDS = 1.15, 0.15  # of what is seen over what the machine needs; of the height, for the engine's text
FROM_THE_SIDE = [0.0, pi, 0.0]  # rotation vector: the view is along +z, with the goaf (-x) on the right


class NoDisplayError(OSError):
    """The error of a window that cannot be opened here; its text says why and what to do."""


# --- the model with its look ---


@dataclass(frozen=True)
class ViewerModel:
    """The engine's model of a scenario with the look of its machine; the equations stay those that run.

    scene: the model; its `release` ends it. look: all that is drawn of the machine.
    """

    scene: EngineScene
    look: Look

    @staticmethod
    def of(scenario: Scenario) -> "ViewerModel":
        """The model of a scenario. Only what is drawn is added: surfaces, and bodies of the ground."""
        model = ViewerModel(build(scenario), looks.look(scenario))
        mbs = model.scene.mbs
        for name, item in model.scene.bodies.items():
            mbs.SetObjectParameter(item.object, "VgraphicsData", model.fixed(name))
        mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsData=model.fixed(GROUND))))
        moving = model.moving()

        def drawn(*_: Any) -> list[Graphics]:
            return [part() for part in moving]

        mbs.AddObject(ObjectGround(visualization=VObjectGround(graphicsDataUserFunction=drawn)))
        kept = mbs.systemData.GetSystemState(INITIAL)  # which assembling would set back
        mbs.Assemble()
        mbs.systemData.SetSystemState(kept, INITIAL)
        return model

    def place(self, body: str, point: Vector3) -> Series:
        """The place of a point of the start posture in the state that is shown [m]."""
        if body == GROUND:
            return np.array(point)
        item, local = self.scene.bodies[body].object, np.array(point) - self._centre(body)
        return np.array(self.scene.mbs.GetObjectOutputBody(item, POSITION, local, SHOWN))

    def _centre(self, body: str) -> Series:
        """A body's centre of mass in the start posture (3,) [m]; zero of the ground."""
        if body == GROUND:
            return np.zeros(3)
        return np.array([*self.scene.bodies[body].body.centre, 0.0][:3])

    def fixed(self, body: str) -> list[Graphics]:
        """The graphics data of a body's shapes, from its centre of mass."""
        own = [engine_surface(shape.mesh, COLOURS[shape.role]) for shape in self.look.of(body)]
        return [graphics.Move(surface, -self._centre(body)) for surface in own]

    def moving(self) -> list[Callable[[], Graphics]]:
        """The graphics data of the shapes of struts; called, they are where the shown state has them."""

        def part(shape: Shape) -> Callable[[], Graphics]:
            surface, strut = engine_surface(shape.mesh, COLOURS[shape.role]), shape.strut

            def placed() -> Graphics:
                assert strut is not None  # of which this is a part
                ends = [self.place(*end) for end in strut.ends]
                moved: Graphics = graphics.Move(surface, ends[shape.end], axes_along(ends[1] - ends[0]))
                return moved

            return placed

        return [part(shape) for shape in self.look.shapes if shape.strut]


# --- the viewer ---


def open_viewer(
    result: Result, *, solution: str | Path | None = None, every: int | None = None, name: str = ""
) -> None:
    """Open Exudyn's solution viewer on a run; returns when its user closes it.

    Arguments:
        result: the run.
        solution: path of a solution file of it that is shown in place of its records, see
            `save_solution`.
        every: rows from frame to frame, up to 200, 25 frames a second; by default the run takes about 10 s.
        name: of the run, shown in the window.

    Raises NoDisplayError, an OSError, if no window can be opened here; InputError if the run has not recorded
    where its bodies are, or the solution file is not one of its model.
    """
    for package in MADE_WITH:
        if (made := result.provenance.get(package, "of an unknown version")) != installed(package):
            print(
                f"warning: made with {package} {made}, and {installed(package)} is installed: the model may "
                "not be exactly the one that was run",
                file=sys.stderr,
            )
    read = None if solution is None else read_solution(solution)
    model, title = ViewerModel.of(result.scenario), _title(result, name)
    container, mbs = model.scene.container, model.scene.mbs
    try:
        if read is not None and solution is not None:
            check_fits(read, model.scene, solution)
        _check_display()
        from exudyn.interactive import SolutionViewer  # which needs tkinter

        shown = rows(result, model.scene) if read is None else read
        _prepare(container.visualizationSettings, title)
        with quiet_engine():
            container.renderer.Start()
            zoom, centre = _camera(result, model.look)
            container.renderer.SetModelView(zoom, FROM_THE_SIDE, centre)
            SetSolutionState(mbs, shown, 0, SHOWN)
            step = round(shown["nRows"] * FRAME / LASTS) if every is None else every
            step = max(1, min(step, MOST_SKIPPED, shown["nRows"]))
            look: dict[str, Any] = {"timeout": FRAME, "runMode": 0, "title": f"{title}: solution viewer"}
            SolutionViewer(mbs, shown, rowIncrement=step, **look)
    finally:
        if container.renderer.IsActive():
            container.renderer.Stop()
        model.scene.release()


def _check_display() -> None:
    """Raise NoDisplayError unless windows can be opened here. A process of its own tries, for it may crash."""
    for name in ("suppressRenderer", "suppressSolutionViewer", "suppressDialogs"):
        if getattr(exudyn.special.userInterface, name):
            raise NoDisplayError(
                f"no window: exudyn.special.userInterface.{name} is set, perhaps by the variable "
                "EXUDYN_SUPPRESS_UI_WINDOW_OPEN; allowed: windows where neither is"
            )
    with tempfile.TemporaryDirectory() as folder:  # where a crash may leave files
        try:
            tried = subprocess.run(
                [sys.executable, "-c", TRY], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                text=True, errors="replace", timeout=LONGEST,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise NoDisplayError(f"no window: none opened within {LONGEST:g} s; {INSTEAD}") from None
    if tried.returncode:
        lines = [
            f"the engine ended with code {tried.returncode}",
            *f"{tried.stdout}\n{tried.stderr}".split("\n"),
        ]
        last = [line.strip() for line in lines if line.strip()][-1]
        raise NoDisplayError(f"no window: {last}; {INSTEAD}")


def _camera(result: Result, look: Look) -> tuple[float, list[float]]:
    """Half the height that is seen at all records [m], and the centre of the view in the screen's axes [m]."""
    records, poses = np.unique(np.linspace(0, result.time.size - 1, MOST_STATES).astype(int)), Poses(result)
    corners = [
        poses.frame(shape, int(record)).points(shape.mesh.bounding_box.vertices)
        for record in records
        for shape in look.shapes
    ]
    points = np.concatenate(corners)
    low, high = points.min(axis=0), points.max(axis=0)
    high[1] = low[1] + (high[1] - low[1]) / (1.0 - WORDS)
    (x, y, z), (width, height, _) = 0.5 * (low + high), high - low
    return 0.5 * MARGIN * max(height, width * WINDOW[1] / WINDOW[0]), [-x, y, -z]


def _title(result: Result, name: str) -> str:
    """A run in a few words."""
    space = "in space" if result.scenario.dimensions == 3 else "in the plane"
    formulation = result.scenario.formulation
    by = "" if formulation == "auto" else f"formulation {formulation}"
    return ", ".join(filter(None, [name, f"{machine_name(result.scenario)} {space}", by]))


def _prepare(settings: Any, text: str) -> None:
    """Show the machine, its time and its name, and no other items of the engine."""
    for group in (settings.nodes, settings.markers, settings.connectors, settings.loads, settings.sensors):
        group.show = False
    settings.general.autoFitScene = False  # the camera stands still
    settings.general.renderWindowString = text
    settings.general.showSolutionInformation = False
    settings.general.showHelpOnStartup = 0
    settings.view0.scene.showFaceEdges = False
    settings.view0.window.renderWindowSize = list(WINDOW)
    settings.view0.window.showComputationInfo = True
    settings.openGL.multiSampling = 4
    settings.openGL.lineWidth = 2.0
    # the stronger light on the side from which the machine is seen
    settings.openGL.light0.position = [-2.0, 4.0, -10.0, 0.0]
    settings.openGL.light1.position = [2.0, 4.0, 10.0, 0.0]
