"""`run FILE`: a scenario's file, simulated and saved."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from support_exudyn.commands.command_line import Json, answer, output, say, show_table, shown_progress, warn
from support_exudyn.files import read_scenario_file
from support_exudyn.files.whole_file import writable
from support_exudyn.postprocessing.joint_tables import joint_warnings_of
from support_exudyn.postprocessing.summary import facts, in_short, run_tables, unmet
from support_exudyn.scenario.scenario_data import ACCURACIES, LARGEST_GOAL, SMALLEST_GOAL
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
    out: Annotated[Path | None, output(".h5", ".hdf5", folder=False)] = None,
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
            for table in run_tables(result):
                show_table(*table)
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
    taken = {scenario.resolve(): "the scenario itself"}
    for option, path in files.items():
        real = writable(path)
        if real in taken:
            raise InputError(f"{option} {path}: is {taken[real]}; allowed: another file")
        taken[real] = "the file of the run"
