"""`run FILE`: a scenario's file, simulated and saved."""

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from cyclopts import Parameter

from support_exudyn.commands.command_line import Json, answer, say, shown_progress, warn
from support_exudyn.commands.tables import show_tables
from support_exudyn.files import read_scenario_file
from support_exudyn.files.whole_file import check_may_be_replaced, named, real_path
from support_exudyn.machines.check.joint_warnings import guide_warnings, joint_warnings
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.postprocessing.summary import facts, in_short, run_tables, unmet
from support_exudyn.scenario.scenario_data import ACCURACIES, LARGEST_GOAL, SMALLEST_GOAL
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from user_forces.values.value import InputError

GOALS = f"{', '.join(ACCURACIES)}, or a relative error from {SMALLEST_GOAL:g} to {LARGEST_GOAL:g}"


def _check_goal(type_: object, goal: str | float | None) -> None:
    """Raise ValueError if an accuracy is a number that cannot be reached."""
    del type_
    if isinstance(goal, float) and not SMALLEST_GOAL <= goal <= LARGEST_GOAL:
        raise ValueError(f"allowed: {GOALS}")


Goal = Annotated[
    Literal["draft", "standard", "reference"] | float | None,
    Parameter(validator=_check_goal, help=f"In place of the file's: {GOALS}."),
]


def run(
    file: Path,
    /,
    *,
    out: Path | None = None,
    accuracy: Goal = None,
    solution: Path | None = None,
    all: bool = False,  # noqa: A002, the option's name
    json: Json = False,
) -> None:
    """Simulate a scenario, save the run, and print what came out in short.

    Args:
        file: A scenario, as TOML.
        out: File of the run (next to the scenario, with the ending .h5).
        solution: Also write Exudyn's own solution file of the run; with the ending .sol in its binary format.
        all: Print all that came out, as `show RUN` does.
    """
    scenario_file = read_scenario_file(file)
    out = out or file.with_suffix(".h5")
    _check_outputs(file, {"--out": out} | ({} if solution is None else {"--solution": solution}))
    if solution is not None:
        from support_exudyn.postprocessing.export import solution_file  # and the engine

        solution_file.check_recorded(scenario_file.scenario)
    with shown_progress(file.stem) as progress:
        result = simulate(
            scenario_file.scenario, accuracy=accuracy, errors=scenario_file.errors, progress=progress
        )
    result.save(out)
    if solution is not None:
        solution_file.save_solution(result, solution)
    warnings = [*scenario_file.warnings, *joint_warnings_of(result)]
    if json:
        impacts = {pin: len(onsets) for pin, onsets in result.onsets.items()}
        written = {"run": out} | ({} if solution is None else {"solution": solution})
        answer({**written, **facts(result), "impacts": impacts, "warnings": warnings})
    else:
        if all:
            show_tables(run_tables(result))
            lines = [f"assumed: {words}" for words in scenario_file.assumed]
        else:
            lines = [f"{name}: {words}" for name, words in in_short(result)]
        for line in (*lines, f"saved: {out}; all numbers: --all, or support-exudyn show {out}"):
            say(line)
        for warning in warnings:
            warn(f"warning: {warning}")
    if result.goal is not None and not result.met:
        warn(unmet(result))


def _check_outputs(scenario: Path, files: dict[str, Path]) -> None:
    """Raise InputError or OSError if a file cannot be written: now, and not when all is computed."""
    taken = {real_path(scenario): "the scenario itself"}
    for option, path in files.items():
        real = real_path(path)
        if real in taken:
            raise InputError(f"{option} {path}: is {taken[real]}; allowed: another file")
        taken[real] = "the file of the run"
        try:
            check_may_be_replaced(real)
        except OSError as error:
            raise named(error, path) from None


def joint_warnings_of(result: Result) -> list[str]:
    """Warnings on the joints of a planar run, with its numbers as far as they were recorded."""
    linkage, channels = result.scenario.linkage, result.channels
    moments = {
        name: float(np.abs(result[f"{name}.moment"]).max())
        for name in linkage.gears
        if f"{name}.moment" in channels
    }
    found = list(joint_warnings(linkage, moments))
    starts = {
        f"{name}.{key}": value
        for name, body in linkage.bodies.items()
        for key, value in (("x", body.centre[0]), ("y", body.centre[1]), ("angle", body.angle))
    }
    if linkage.slides and starts.keys() <= channels.keys():
        position = np.column_stack([result[name] - start for name, start in starts.items()])
        found += guide_warnings(BodyMotion(linkage, position, np.zeros_like(position)))
    return found
