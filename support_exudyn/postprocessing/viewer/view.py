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
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.export.solution_file import Solution, check_fits, read_solution, rows
from support_exudyn.postprocessing.render.pin_views import PinView, pin_views
from support_exudyn.postprocessing.viewer.viewer_model import SHOWN, ViewerModel, model_for_viewer
from support_exudyn.simulation.provenance import installed
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

# --- whether the engine can open a window here, asked without risk ---

LONGEST = 120.0  # [s] that trying may take, of a slow machine or a distant display
TRY = """
try:
    import resource
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
except ImportError:
    pass
try:
    import tkinter
except ImportError as error:
    raise SystemExit(f"no tkinter: {error}; on Debian: apt-get install python3-tk")
try:
    root = tkinter.Tk()
    root.withdraw()
    root.destroy()
except tkinter.TclError as error:
    raise SystemExit(f"no display: {error}")
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
REASONS = ("what():", "error", "failed", "no ")  # in lines that name a cause
INSTEAD = (
    "Allowed: a desktop with OpenGL; `python -m support_exudyn render RUN` writes pictures without a window, "
    "and `xvfb-run -a python -m support_exudyn view RUN` opens the window on a display in memory"
)


class NoDisplayError(OSError):
    """The error of a window that cannot be opened here; its text says why and what to do."""


def check_display() -> None:
    """Raise NoDisplayError, which says why and what to do, unless the engine can open its windows."""
    switches = exudyn.special.userInterface
    for name in ("suppressRenderer", "suppressSolutionViewer", "suppressDialogs"):
        if getattr(switches, name):
            raise NoDisplayError(
                f"no window: exudyn.special.userInterface.{name} is set, perhaps by the variable "
                "EXUDYN_SUPPRESS_UI_WINDOW_OPEN; allowed: windows where neither is"
            )
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-c", TRY]
        try:
            tried = subprocess.run(
                command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                errors="replace", timeout=LONGEST,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            raise NoDisplayError(f"no window opened within {LONGEST:g} s. {INSTEAD}") from None
    if tried.returncode:
        lines = [line.strip() for line in f"{tried.stderr}\n{tried.stdout}".splitlines() if line.strip()]
        reasons = [line for line in lines if any(word in line.lower() for word in REASONS)] or lines[-1:]
        reason = "; ".join(reasons[:3]) or f"the engine ended with code {tried.returncode}"
        raise NoDisplayError(f"no window can be opened here: {reason}. {INSTEAD}")


# --- the viewer ---

MADE_WITH = ("exudyn", "support-exudyn")  # packages on which the model depends
WINDOW = (1200, 750)  # width and height [pixels]
FRAME = 0.04  # [s]
LASTS = 10.0  # [s] that a run takes in the viewer unless asked otherwise
MOST_SKIPPED = 200  # rows from frame to frame, as many as the viewer's slider has
MOST_LOOKED_AT = 60  # states by which the camera is set
MARGIN = 1.15  # of what is seen, over what the machine needs
WORDS = 0.15  # of the window's height, on top, where the engine writes name and time
FROM_THE_SIDE = (0.0, pi, 0.0)  # rotation vector: one looks along +z, with the goaf (-x) on the right


def differing_versions(result: Result) -> list[str]:
    """Sentences on the packages that are not those a run was made with."""
    return [
        f"made with {name} {result.provenance.get(name, 'of an unknown version')}, and {installed(name)} is "
        "installed: the model may not be exactly the one that was run"
        for name in MADE_WITH
        if result.provenance.get(name) != installed(name)
    ]


def open_viewer(
    result: Result, *, solution: str | Path | None = None, every: int | None = None, name: str = ""
) -> None:
    """Open Exudyn's solution viewer on a run; returns when its user closes it.

    Arguments:
        result: the run.
        solution: path of a solution file of it that is shown in place of its records, see
            `save_solution`.
        every: rows from frame to frame, 1 to 200, 25 frames a second; by default the run takes about 10 s.
        name: of the run, shown in the window.

    Raises NoDisplayError, an OSError, if no window can be opened here; InputError if the run has not recorded
    where its bodies are, or the solution file is not one of its model.
    """
    with window(result, solution=solution, name=name) as shown:
        from exudyn.interactive import SolutionViewer  # which needs tkinter

        count = int(shown.solution["nRows"])
        SolutionViewer(
            shown.model.scene.mbs,
            shown.solution,
            rowIncrement=every_row(count) if every is None else checked_every(every, count),
            timeout=FRAME,
            runMode=0,
            title=f"{title(result, name)}: solution viewer",
        )


def every_row(count: int) -> int:
    """Rows from frame to frame with which so many take about 10 s."""
    return max(1, min(MOST_SKIPPED, round(count * FRAME / LASTS)))


def checked_every(every: int, count: int) -> int:
    """Raise InputError unless it can be so many rows from frame to frame; there are `count`."""
    most = min(MOST_SKIPPED, count)
    if isinstance(every, bool) or not isinstance(every, int) or not 1 <= every <= most:
        raise InputError(f"every = {short(every)}: allowed: a whole number from 1 to {most}")
    return every


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
        _show(self.model, self.solution, row)
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


@contextmanager
def window(
    result: Result, *, solution: str | Path | None = None, name: str = "", size: tuple[int, int] = WINDOW
) -> Iterator[Window]:
    """The engine's window on a run while the block runs.

    Arguments, and what is raised, are those of `open_viewer`; size: width and height of the window [pixels].
    """
    for sentence in differing_versions(result):
        print(f"warning: {sentence}", file=sys.stderr)
    read = None if solution is None else read_solution(solution)
    model = model_for_viewer(result.scenario, _views(result), result.time)
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
            container.renderer.SetModelView(zoom, list(FROM_THE_SIDE), centre)
            shown.show(0)
            yield shown
    finally:
        if container.renderer.IsActive():
            container.renderer.Stop()
        model.scene.release()


def _views(result: Result) -> list[PinView]:
    """The clearance pins that are shown beside the machine; none of runs that have not recorded them."""
    try:
        return pin_views(result)
    except InputError:
        return []


def title(result: Result, name: str = "") -> str:
    """A run in a few words."""
    machine = type(result.scenario.machine).__name__
    space = "in space" if result.scenario.dimensions == 3 else "in the plane"
    formulation = result.scenario.formulation
    by = "" if formulation == "auto" else f"formulation {formulation}"
    return ", ".join(filter(None, [name, f"{machine} {space}", by]))


def _prepare(settings: Any, text: str, size: tuple[int, int]) -> None:
    """The machine, its time and its name, and nothing of what the engine knows besides."""
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
    # the stronger light on the side from which one looks
    settings.openGL.light0.position = [-2.0, 4.0, -10.0, 0.0]
    settings.openGL.light1.position = [2.0, 4.0, 10.0, 0.0]


def _camera(model: ViewerModel, solution: Solution, size: tuple[int, int]) -> tuple[float, list[float]]:
    """Half the height that is seen [m], and where one looks in the axes of the screen [m]: at all rows."""
    low, high = reach(model, solution)
    high[1] = low[1] + (high[1] - low[1]) / (1.0 - WORDS)
    x, y, z = 0.5 * (low + high)
    width, height = high[0] - low[0], high[1] - low[1]
    return 0.5 * MARGIN * max(height, width * size[1] / size[0]), [-x, y, -z]


def reach(model: ViewerModel, solution: Solution) -> tuple[Series, Series]:
    """The least and largest coordinates (3,) that anything drawn has in any of the rows [m]."""
    corners: list[Series] = []
    for row in np.unique(np.linspace(0, solution["nRows"] - 1, MOST_LOOKED_AT).astype(int)):
        _show(model, solution, int(row))
        for solid in model.look.solids:
            box = solid.mesh.bounding_box.vertices.tolist()
            corners += [model.place(solid.body, (x, y, z)) for x, y, z in box]
        for strut in model.look.struts:
            corners += [model.place(strut.foot, strut.foot_point), model.place(strut.head, strut.head_point)]
    points = np.concatenate([np.array(corners), model.insets.corners])
    return points.min(axis=0), points.max(axis=0)


def _show(model: ViewerModel, solution: Solution, row: int) -> None:
    """Let the engine's state that is drawn be a row."""
    SetSolutionState(model.scene.mbs, solution, row, exudyn.ConfigurationType.Visualization)
