"""Exudyn's own solution file of a run: what the engine writes while it integrates, and its viewer plays.

The file is of the engine's model with rigid bodies and constraints, whatever formulation has computed the run:
where the bodies are follows from its channels, and the engine writes it, in its own format. There are as many
rows as records: time, then coordinates (see `coordinates`) and their rates; accelerations and multipliers, of
which a run does not keep all, are not among them.
"""

import ast
import re
from pathlib import Path
from typing import Any

import exudyn
import numpy as np
from exudyn.basicUtilities import LoadSolutionFile
from scipy.spatial.transform import Rotation

from support_exudyn.files.free_memory import available
from support_exudyn.files.whole_file import check_is_file, whole_file
from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.formulations.exudyn.scene.engine_scene import EngineScene
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.mechanics.body_motion import UNTURNED, parameter_rates
from support_exudyn.mechanics.channels import chosen
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.selection import machine_name
from support_exudyn.postprocessing.look.poses import WHY, Pose
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, cleaned

Solution = dict[str, Any]  # as LoadSolutionFile gives it and SolutionViewer takes it
DIGITS = 17  # as many as distinguish numbers of 64 bits
BINARY_ENDING = ".sol"  # as the engine names such files
BINARY_START = b"EXUBIN"
TIMES = 8  # as much memory as its length reading a file may take
HEADER = 5  # lines of the text format, the last of which says what the columns are
COLUMNS = re.compile(r"#number of written coordinates \[[\w, ]+\] = (\[\d+(?:,\d+){6}\])")
IN_PLANE = ("x", "y", "angle", "velocity_x", "velocity_y", "angular_velocity")
IN_SPACE = (
    *("x", "y", "z", "angle", "roll", "yaw", "velocity_x", "velocity_y", "velocity_z"),
    *("angular_velocity", "angular_velocity_x", "angular_velocity_y"),
)


def rows(result: Result, of: EngineScene) -> Solution:
    """The records of a run as the engine's viewer takes them, and as its `LoadSolutionFile` reads its files.

    of: the model of the run's scenario.

    Raises InputError if the run has not recorded where its bodies are.
    """
    known = coordinates(result)
    size = int(of.mbs.systemData.ODE2Size())
    data = np.zeros((result.time.size, 1 + 2 * size))
    data[:, 0] = result.time
    for name, item in of.bodies.items():
        place, rate = known[name]
        first, end = 1 + item.first, 1 + item.first + place.shape[1]
        data[:, first:end] = place
        data[:, size + first : size + end] = rate
    columns = [size, size, 0, 0, 0, 0, 0]
    return {"data": data, "columnsExported": columns, "nColumns": 2 * size, "nRows": len(data)}


def save_solution(result: Result, path: str | Path) -> Path:
    """Have Exudyn write its own solution file of a run, for `exudyn.utilities.LoadSolutionFile`.

    It is of the engine's model with rigid bodies and constraints, whatever formulation has computed the run:
    a row for each record with time, coordinates and their rates.

    Arguments:
        result: the run.
        path: with the ending `.sol` in the engine's binary format, with any other in its text format.

    Returns the path.

    Raises InputError if the run has not recorded where its bodies are; OSError that names the file if it cannot
    be written, and an older one is then as it was.
    """
    scene = build(result.scenario)
    try:
        solution = rows(result, scene)
        with whole_file(path) as temporary, quiet_engine():
            settings = _settings(result, temporary)
            solver: Any = exudyn.MainSolverImplicitSecondOrder()  # its stubs lack self
            solver.InitializeSolver(scene.mbs, settings)  # begins the file
            state, size = scene.mbs.systemData, solution["columnsExported"][0]
            for row in solution["data"]:
                state.SetTime(row[0])
                state.SetODE2Coordinates(row[1 : 1 + size])
                state.SetODE2Coordinates_t(row[1 + size :])
                solver.WriteCoordinatesToFile(scene.mbs, settings)
            solver.FinalizeSolver(scene.mbs, settings)  # ends and closes it
    finally:
        scene.release()
    return Path(path)


def _settings(result: Result, path: Path) -> Any:
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = float(result.time[-1])
    settings.timeIntegration.numberOfSteps = max(1, result.time.size - 1)
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.generalizedAlpha.computeInitialAccelerations = False  # nothing is solved
    settings.solution.precision = DIGITS
    file = settings.solution.file
    file.write = True
    file.name = str(path)
    file.binary = path.suffix == BINARY_ENDING
    file.writePeriod = 0.0  # every row
    file.writeInitialValues = False  # they are the first row
    # what the model has of these is not of the rows
    file.export.accelerations = file.export.algebraicCoordinates = file.export.dataCoordinates = False
    machine = machine_name(result.scenario)
    file.information = f"{machine}, {result.scenario.formulation}; channels and scenario are in the run's file"
    return settings


def read_solution(path: str | Path) -> Solution:
    """Read a solution file of the engine, of either format.

    Raises InputError if it is not a whole one; OSError if it cannot be opened at all.
    """
    check_is_file(path, available() // TIMES)
    with Path(path).open("rb") as file:  # the engine's reader evaluates the fifth line of a text
        start = [file.readline(1000) for _ in range(HEADER)]
    columns = COLUMNS.fullmatch(start[-1].decode("utf-8", "replace").strip())
    if not start[0].startswith(BINARY_START) and not (columns and any(ast.literal_eval(columns.group(1)))):
        raise InputError(
            f"{path}: not a solution file of Exudyn; allowed: what `save_solution` or the engine has written"
        )
    try:
        found: Solution = LoadSolutionFile(str(path), verbose=False)
        if not np.isfinite(found["data"]).all():
            raise ValueError("not all of its numbers are finite")
    except (ValueError, LookupError, TypeError, ArithmeticError, MemoryError, EOFError) as error:
        said = cleaned(str(error))
        raise InputError(f"{path}: not a solution file of Exudyn, or damaged ({said})") from None
    return found


def check_fits(solution: Solution, of: EngineScene, path: str | Path) -> None:
    """Raise InputError unless a solution file is of a model with as many coordinates."""
    wanted, found = int(of.mbs.systemData.ODE2Size()), int(solution["columnsExported"][0])
    if found != wanted:
        raise InputError(f"{path}: of a model with {found} coordinates; allowed: of the run's, with {wanted}")


# --- coordinates ---


def check_recorded(scenario: Scenario) -> None:
    """Raise InputError if a run of the scenario will lack a channel from which the coordinates follow."""
    recorded = set(chosen(scenario.channel_definitions, scenario.channels))
    in_space = scenario.dimensions == 3
    bodies, names = (scenario.space.bodies, IN_SPACE) if in_space else (scenario.linkage.bodies, IN_PLANE)
    missing = [f"{body}.{name}" for body in bodies for name in names if f"{body}.{name}" not in recorded]
    if missing:
        raise InputError(
            f"channels = {scenario.channels}: lacks {len(missing)} by which a solution file says where the "
            f"bodies are, such as {missing[0]!r}; allowed with a solution file: patterns that match all of "
            "them, or ('*',)"
        )


def coordinates(result: Result) -> dict[str, tuple[Series, Series]]:
    """Coordinates of every body in the engine and their rates, shapes (n, 3) in the plane, (n, 7) in space.

    They are what has changed since the start posture: place of the centre of mass [m], then the angle [rad],
    or the four Euler parameters. Raises InputError if a channel that this needs was not recorded.
    """
    scenario, moved = result.scenario, dict[str, tuple[Series, Series]]()
    if scenario.dimensions == 2:
        for name, body in scenario.linkage.bodies.items():
            columns = np.column_stack([result.recorded(f"{name}.{what}", WHY) for what in IN_PLANE])
            moved[name] = columns[:, :3] - [*body.centre, body.angle], columns[:, 3:]
        return moved
    for name in scenario.space.bodies:
        pose = Pose(result, name)
        parameters = euler_parameters(pose.turn)
        place = np.hstack([pose.place - pose.start, parameters - UNTURNED])
        moved[name] = place, np.hstack([pose.velocity, parameter_rates(parameters, pose.spin)])
    return moved


def euler_parameters(turn: Series) -> Series:
    """Euler parameters (n, 4) of rotations (n, 3, 3) that follow each other; their signs do not jump."""
    found = Rotation.from_matrix(turn).as_quat()[:, [3, 0, 1, 2]]
    steps = np.where(np.sum(found[1:] * found[:-1], axis=1) >= 0.0, 1.0, -1.0)
    steady: Series = np.cumprod([1.0 if found[0, 0] >= 0.0 else -1.0, *steps])[:, None] * found
    return steady
