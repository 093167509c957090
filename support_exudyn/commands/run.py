"""`run FILE`: a scenario's file, simulated and saved."""

import argparse
import sys
from pathlib import Path

import numpy as np
from rich.console import Console

from support_exudyn.commands.command_line import add_json, add_out, answer, folder, shown_progress, warn
from support_exudyn.commands.tables import facts, first_impacts, printed, show_fitting, show_numbers, show_table
from support_exudyn.files import ScenarioFile, read_scenario_file
from support_exudyn.files.whole_file import check_may_be_replaced, named, real_path
from support_exudyn.machines.check.joint_warnings import guide_warnings, joint_warnings
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import selection
from support_exudyn.postprocessing.joint_tables import leg_table
from support_exudyn.scenario.scenario_data import ACCURACIES, LARGEST_GOAL, SMALLEST_GOAL
from support_exudyn.simulation.result import Result
from support_exudyn.simulation.simulate import simulate
from user_forces.values.value import InputError, short

WHOLE = (0.0, float("inf"))  # run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The scenario's file, and where the run goes."""
    add = parser.add_argument
    add("file", type=folder, metavar="FILE", help="a scenario, as TOML")
    add_out(parser, "file of the run (beside the scenario, with the ending .h5)", "RUN")
    add(
        "--accuracy",
        type=accuracy,
        metavar="A",
        help=f"in place of the file's: {', '.join(ACCURACIES)}, or a relative error from {SMALLEST_GOAL:g} to "
        f"{LARGEST_GOAL:g}",
    )
    add(
        "--solution",
        type=folder,
        metavar="FILE",
        help="also write Exudyn's own solution file of the run, with the ending .sol in its binary format",
    )
    add_json(parser)


def accuracy(text: str) -> str | float:
    """An accuracy from the command line."""
    if text in ACCURACIES:
        return text
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not SMALLEST_GOAL <= number <= LARGEST_GOAL:
        raise argparse.ArgumentTypeError(
            f"{short(text)}: allowed: {', '.join(ACCURACIES)}, or from {SMALLEST_GOAL:g} to {LARGEST_GOAL:g}"
        )
    return number


def run(given: argparse.Namespace) -> None:
    """Simulate it, save the run, and tell what came out."""
    file = read_scenario_file(given.file)
    out: Path = given.out or given.file.with_suffix(".h5")
    solution: Path | None = given.solution
    files = {"--out": out} | ({} if solution is None else {"--solution": solution})
    for option, path in files.items():  # now, and not when all is computed
        if real_path(path) == real_path(given.file):
            raise InputError(f"{option} {path}: is the scenario itself; allowed: another file")
        try:
            check_may_be_replaced(real_path(path))
        except OSError as error:
            raise named(error, path) from None
    if solution is not None:
        if real_path(solution) == real_path(out):
            raise InputError(f"--solution {solution}: is the file of the run; allowed: another file")
        from support_exudyn.postprocessing.export import solution_file  # and the engine

        solution_file.check_recorded(file.scenario)
    with shown_progress(given.file.stem) as progress:
        result = simulate(file.scenario, accuracy=given.accuracy, errors=file.errors, progress=progress)
    result.save(out)
    if solution is not None:
        solution_file.save_solution(result, solution)
    warnings = [*file.warnings, *joint_warnings_of(result)]
    if given.json:
        impacts = {pin: len(onsets) for pin, onsets in result.onsets.items()}
        said = {"run": out, **facts(result, *WHOLE), "impacts": impacts}
        answer(said | {"warnings": warnings} | ({} if solution is None else {"solution": solution}))
    else:
        printed(lambda console: _tell(console, result, file, list(files.values())))
        for warning in warnings:
            warn(f"warning: {warning}")
    if result.goal is not None and not result.met:
        print(summary.unmet(result), file=sys.stderr)


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


def _tell(console: Console, result: Result, file: ScenarioFile, written: list[Path]) -> None:
    """A short account."""
    show_numbers(console, file.name or "what came out", "errors = true", result, *WHOLE)
    linkage = result.scenario.linkage
    points = [name for name in summary.telling(result) if name.rpartition(".")[0] in linkage.points]
    if points:
        paths = [row[:-1] for row in summary.of_channels(result, points, *WHOLE)]
        show_table(
            console,
            f"paths, {selection.said(result, *WHOLE)}",
            ("channel", "unit", ">min", ">mean", ">max"),
            paths,
        )
    pressures = [name for name in result.channels if name.endswith("pressure")]
    if result.oil_events and pressures:
        pressed = [row[:-1] for row in summary.of_channels(result, pressures, *WHOLE)]
        show_table(console, "pressures", ("channel", "unit", ">min", ">mean", ">max"), pressed)
    show_fitting(console, leg_table(result))
    first_impacts(console, result)
    assumed = [("assumed", sentence) for sentence in file.assumed]
    show_table(console, "how", (), [*summary.how(result)[:-1], *assumed])
    for path in written:
        print(path)
