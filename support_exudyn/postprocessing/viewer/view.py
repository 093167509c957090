"""Exudyn's solution viewer on a run: its model with the look of the machine, moving as it did."""

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import exudyn
import numpy as np
from exudyn.basicUtilities import SetSolutionState

from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.postprocessing.export.solution_file import Solution, check_fits, read_solution, rows
from support_exudyn.postprocessing.figures.selection import machine_name
from support_exudyn.postprocessing.render.pin_views import pin_views
from support_exudyn.postprocessing.viewer.viewer_model import SHOWN, ViewerModel, model_for_viewer
from support_exudyn.simulation.provenance import installed
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

# --- whether the engine can open a window here, tried in a process of its own ---

LONGEST = 120.0  # [s] that trying may take, of a slow machine or a distant display
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
INSTEAD = (
    "Allowed: a desktop with OpenGL, and tkinter (on Debian: apt-get install python3-tk); "
    "`python -m support_exudyn render RUN` writes pictures without a window, and "
    "`xvfb-run -a python -m support_exudyn view RUN` opens the window on a display in memory"
)


class NoDisplayError(OSError):
    """The error of a window that cannot be opened here; its text says why and what to do."""


def check_display() -> None:
    """Raise NoDisplayError, which says why and what to do, unless the engine can open its windows."""
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
            raise NoDisplayError(f"no window opened within {LONGEST:g} s. {INSTEAD}") from None
    if tried.returncode:
        lines = (
            f"engine ended with code {tried.returncode}\n{tried.stdout}\n{tried.stderr}".strip().splitlines()
        )
        raise NoDisplayError(f"no window can be opened here: {lines[-1].strip()}. {INSTEAD}")


# --- the viewer ---

MADE_WITH = ("exudyn", "support-exudyn")  # packages on which the model depends
WINDOW = (1200, 750)  # width and height [pixels]
FRAME = 0.04  # [s]
LASTS = 10.0  # [s] that a run takes in the viewer by default
MOST_SKIPPED = 200  # rows from frame to frame, as many as the viewer's slider has
MOST_STATES = 60  # by which the camera is set
MARGIN = 1.15  # of what is seen, over what the machine needs
WORDS = 0.15  # of the window's height, on top, where the engine writes name and time
FROM_THE_SIDE = [0.0, pi, 0.0]  # rotation vector: the view is along +z, with the goaf (-x) on the right


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
    with window(result, solution=solution, name=name) as shown:
        from exudyn.interactive import SolutionViewer  # which needs tkinter

        count = int(shown.solution["nRows"])
        step = round(count * FRAME / LASTS) if every is None else every
        step = max(1, min(step, MOST_SKIPPED, count))
        SolutionViewer(
            shown.model.scene.mbs, shown.solution, rowIncrement=step, timeout=FRAME, runMode=0,
            title=f"{title(result, name)}: solution viewer",
        )  # fmt: skip


@dataclass(frozen=True)
class Window:
    """The engine's open window on a run, for scripts: shows any row, without the viewer's dialog.

    model: what is shown. solution: the rows, as the engine's viewer takes them.
    """

    model: ViewerModel
    solution: Solution

    def show(self, row: int) -> None:
        """Show a row, which is a record of the run; raises InputError if there is none."""
        count = self.solution["nRows"]
        if not 0 <= row < count:
            raise InputError(f"row = {short(row)}: allowed: from 0 to {count - 1}")
        SetSolutionState(self.model.scene.mbs, self.solution, row, SHOWN)
        renderer = self.model.scene.container.renderer
        renderer.SendRedrawSignal()
        renderer.DoIdleTasks(0)  # what moves by itself, actuators, is drawn by Python

    @property
    def time(self) -> float:
        """The time of what is shown [s]."""
        return float(self.model.scene.mbs.systemData.GetTime(SHOWN))

    def picture(self) -> np.ndarray:
        """The picture in the window: RGB (height, width, 3) of 8 bits."""
        return np.array(self.model.scene.container.renderer.RedrawAndGetImage())


def _camera(model: ViewerModel, solution: Solution, size: tuple[int, int]) -> tuple[float, list[float]]:
    """Half the height that is seen at all rows [m], and the centre of the view in the screen's axes [m]."""
    corners = [model.corners]
    for row in np.unique(np.linspace(0, solution["nRows"] - 1, MOST_STATES).astype(int)):
        SetSolutionState(model.scene.mbs, solution, int(row), SHOWN)
        for shape in model.look.shapes:
            box = [(shape.body, point) for point in shape.mesh.bounding_box.vertices.tolist()]
            ends = box if shape.strut is None else shape.strut.ends
            corners.append(np.array([model.place(body, point) for body, point in ends]))
    points = np.concatenate(corners)
    low, high = points.min(axis=0), points.max(axis=0)
    high[1] = low[1] + (high[1] - low[1]) / (1.0 - WORDS)
    (x, y, z), (width, height, _) = 0.5 * (low + high), high - low
    return 0.5 * MARGIN * max(height, width * size[1] / size[0]), [-x, y, -z]


@contextmanager
def window(
    result: Result, *, solution: str | Path | None = None, name: str = "", size: tuple[int, int] = WINDOW
) -> Iterator[Window]:
    """The engine's window on a run while the block runs.

    Arguments, and what is raised, are those of `open_viewer`; size: width and height of the window [pixels].
    """
    for package in MADE_WITH:
        if (made := result.provenance.get(package, "of an unknown version")) != installed(package):
            print(
                f"warning: made with {package} {made}, and {installed(package)} is installed: the model may "
                "not be exactly the one that was run",
                file=sys.stderr,
            )
    read = None if solution is None else read_solution(solution)
    try:
        views = pin_views(result)
    except InputError:  # not recorded
        views = []
    model = model_for_viewer(result.scenario, views, result.time)
    container = model.scene.container
    try:
        if read is not None and solution is not None:
            check_fits(read, model.scene, solution)
        check_display()
        shown = Window(model, rows(result, model.scene) if read is None else read)
        _prepare(container.visualizationSettings, title(result, name), size)
        zoom, centre = _camera(model, shown.solution, size)
        with quiet_engine():
            container.renderer.Start()
            container.renderer.SetModelView(zoom, FROM_THE_SIDE, centre)
            shown.show(0)
            yield shown
    finally:
        if container.renderer.IsActive():
            container.renderer.Stop()
        model.scene.release()


def title(result: Result, name: str = "") -> str:
    """A run in a few words."""
    space = "in space" if result.scenario.dimensions == 3 else "in the plane"
    formulation = result.scenario.formulation
    by = "" if formulation == "auto" else f"formulation {formulation}"
    return ", ".join(filter(None, [name, f"{machine_name(result.scenario)} {space}", by]))


def _prepare(settings: Any, text: str, size: tuple[int, int]) -> None:
    """Show the machine, its time and its name, and no other items of the engine."""
    for group in (settings.nodes, settings.markers, settings.connectors, settings.loads, settings.sensors):
        group.show = False
    settings.general.autoFitScene = False  # the camera stands still
    settings.general.renderWindowString = text
    settings.general.showSolutionInformation = False
    settings.general.showHelpOnStartup = 0
    settings.view0.scene.showFaceEdges = False
    settings.view0.window.renderWindowSize = list(size)
    settings.view0.window.showComputationInfo = True
    settings.openGL.multiSampling = 4
    settings.openGL.lineWidth = 2.0
    # the stronger light on the side from which the machine is seen
    settings.openGL.light0.position = [-2.0, 4.0, -10.0, 0.0]
    settings.openGL.light1.position = [2.0, 4.0, 10.0, 0.0]
