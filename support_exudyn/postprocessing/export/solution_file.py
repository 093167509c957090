"""Exudyn's own solution file of a run: what the engine writes while it integrates, and its viewer plays.

The file is of the engine's model with rigid bodies and constraints, whatever formulation has computed the run:
where the bodies are follows from its channels, and the engine writes it, in its own format. There are as many
rows as records: time, then coordinates (see `coordinates`) and their rates; accelerations and multipliers, of
which a run does not keep all, are not among them.
"""

from __future__ import annotations

import ast
import errno
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import exudyn
import numpy as np
from exudyn.basicUtilities import LoadSolutionFile

from support_exudyn.files.whole_file import check_is_file, whole_file
from support_exudyn.formulations.engine_settings import quiet_engine
from support_exudyn.formulations.progress import Progress
from support_exudyn.formulations.redundant.run import Model, model
from support_exudyn.postprocessing.export.coordinates import check_recorded, coordinates
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.memory import available
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, cleaned

Solution = dict[str, Any]  # as LoadSolutionFile gives it and SolutionViewer takes it
DIGITS = 17  # as many as tell numbers of 64 bits apart
BINARY_ENDING = ".sol"  # as the engine names such files
BINARY_START = b"EXUBIN"
TIMES = 8  # as much memory as its length reading a file may take
HEADER = 5  # lines of the text format, the last of which says what the columns are
COLUMNS = re.compile(r"#number of written coordinates \[[\w, ]+\] = (\[\d+(?:,\d+){6}\])")


def rows(result: Result, of: Model) -> Solution:
    """A run as the engine's viewer takes it.

    Arguments:
        result: the run.
        of: the model of its scenario.

    Returns:
        What `exudyn.utilities.LoadSolutionFile` gives for its solution file: `data` with a row for each record,
        `columnsExported`, `nColumns` and `nRows`.

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
    return {
        "data": data,
        "columnsExported": [size, size, 0, 0, 0, 0, 0],
        "nColumns": 2 * size,
        "nRows": len(data),
    }


def save_solution(result: Result, path: str | Path) -> Path:
    """Have the engine write the solution file of a run.

    path: with the ending `.sol` in the engine's binary format, with any other in its text format.

    Raises InputError if the run has not recorded where its bodies are; OSError that names the file if it cannot
    be written, and an older one is then as it was.
    """
    with whole_file(path) as temporary:
        _write(result, temporary)
    return Path(path)


def keeping_solution(
    run: Callable[[Scenario, Progress], Result], path: str | Path
) -> Callable[[Scenario, Progress], Result]:
    """The same way to run a scenario, which also has the engine write the solution file.

    Before the run InputError is raised if it will not record where its bodies are, and OSError that names the
    file if it cannot be written. If the run fails, an older file is as it was.
    """

    def kept(scenario: Scenario, progress: Progress) -> Result:
        check_recorded(scenario)
        with whole_file(path) as temporary:
            result = run(scenario, progress)
            _write(result, temporary)
        return result

    return kept


def _write(result: Result, path: Path) -> None:
    scene = model(result.scenario)
    try:
        solution = rows(result, scene)
        with quiet_engine():
            _write_rows(scene.mbs, _settings(result, path), solution)
    finally:
        scene.release()
    # the engine does not say if the disk was full
    if not _is_whole(path, solution):
        raise OSError(errno.EIO, "the engine could not write all of it; is the disk full?", str(path))


def _write_rows(mbs: Any, settings: Any, solution: Solution) -> None:
    """Give the model every row as its state, and have the engine's solver write it."""
    solver: Any = exudyn.MainSolverImplicitSecondOrder()  # its stubs lack self
    solver.InitializeSolver(mbs, settings)  # begins the file
    state, size = mbs.systemData, solution["columnsExported"][0]
    for row in solution["data"]:
        state.SetTime(row[0])
        state.SetODE2Coordinates(row[1 : 1 + size])
        state.SetODE2Coordinates_t(row[1 + size :])
        solver.WriteCoordinatesToFile(mbs, settings)
    solver.FinalizeSolver(mbs, settings)  # ends and closes it


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
    machine = type(result.scenario.machine).__name__
    file.information = f"{machine}, {result.scenario.formulation}; channels and scenario are in the run's file"
    return settings


def _is_whole(path: Path, solution: Solution) -> bool:
    try:
        return np.array_equal(read_solution(path)["data"], solution["data"])
    except InputError:
        return False


def read_solution(path: str | Path) -> Solution:
    """Read a solution file of the engine, of either format.

    Raises InputError if it is not a whole one; OSError if it cannot be opened at all.
    """
    check_is_file(path, available() // TIMES)
    _check_header(path)
    try:
        found: Solution = LoadSolutionFile(str(path), verbose=False)
        if not np.isfinite(found["data"]).all():
            raise ValueError("not all of its numbers are finite")
    except (ValueError, LookupError, TypeError, ArithmeticError, MemoryError, EOFError) as error:
        said = cleaned(str(error))
        raise InputError(f"{path}: not a solution file of Exudyn, or damaged ({said})") from None
    return found


def _check_header(path: str | Path) -> None:
    """Raise InputError if the engine's reader should not be given the file: it evaluates its fifth line."""
    with Path(path).open("rb") as file:
        start = [file.readline(1000) for _ in range(HEADER)]
    if start[0].startswith(BINARY_START):
        return
    found = COLUMNS.fullmatch(start[-1].decode("utf-8", "replace").strip())
    if found is None or not any(ast.literal_eval(found.group(1))):
        raise InputError(
            f"{path}: not a solution file of Exudyn; allowed: what Result.save_solution or the "
            "engine has written"
        )


def check_fits(solution: Solution, of: Model, path: str | Path) -> None:
    """Raise InputError unless a solution file is of a model with as many coordinates."""
    wanted, found = int(of.mbs.systemData.ODE2Size()), int(solution["columnsExported"][0])
    if found != wanted:
        raise InputError(f"{path}: of a model with {found} coordinates; allowed: of the run's, with {wanted}")
