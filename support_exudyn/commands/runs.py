"""Commands that make a run and look at it: `run`, `show`, `plot`; and words that are files or channels."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from support_exudyn.commands import command_line as cli
from support_exudyn.files.whole_file import writable
from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.shown_numbers import numbers
from support_exudyn.scenario.scenario_data import ACCURACIES, LARGEST_GOAL, SMALLEST_GOAL
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

RUN, CSV, TOML = ".h5", ".csv", ".toml"
# a word with such an ending is a file even if it is not there, and no channel
ENDINGS = (
    *(RUN, CSV, ".txt", ".tab", ".tsv", ".dat", ".res", ".req", ".mat", ".parquet", ".xml", ".lvm"),
    *(".xlsx", ".xlsm", ".feather", ".json", ".tdms", ".xls"),
)
HEAD = 600  # bytes by which runs are distinguished from series of others
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
    out: Annotated[Path | None, cli.output(".h5", ".hdf5", folder=False)] = None,
    accuracy: Goal = None,
    solution: Path | None = None,
    all: bool = False,  # noqa: A002, the option's name
    json: cli.Json = False,
) -> None:
    """Simulate a scenario, save the run, and print what came out in short.

    Args:
        file: A scenario, as TOML.
        out: File of the run (next to the scenario, with the ending .h5).
        solution: Also write Exudyn's own solution file of the run; with the ending .sol in its binary format.
        all: Print all that came out, as `show RUN` does.
    """
    from support_exudyn.files import read_scenario_file
    from support_exudyn.postprocessing.joint_tables import joint_warnings_of
    from support_exudyn.simulation.simulate import simulate

    scenario_file = read_scenario_file(file)
    out = out or file.with_suffix(".h5")
    written = {"run": out} | ({} if solution is None else {"solution": solution})
    taken = {file.resolve(): "the scenario itself"}
    for what, path in written.items():  # refused now, and not when all is computed
        option, real = "--out" if what == "run" else "--solution", writable(path)
        if real in taken:
            raise InputError(f"{option} {path}: is {taken[real]}; allowed: another file")
        taken[real] = "the file of the run"
    if solution is not None:
        from support_exudyn.postprocessing.export import solution_file  # and the engine

        solution_file.check_recorded(scenario_file.scenario)
    with cli.shown_progress(file.stem) as progress:
        result = simulate(
            scenario_file.scenario, accuracy=accuracy, errors=scenario_file.errors, progress=progress
        )
    result.save(out)
    if solution is not None:
        solution_file.save_solution(result, solution)
    warnings = [*scenario_file.warnings, *joint_warnings_of(result)]
    if json:
        impacts = {pin: len(onsets) for pin, onsets in result.onsets.items()}
        cli.answer({**written, **summary.facts(result), "impacts": impacts, "warnings": warnings})
    else:
        lines = [f"{name}: {words}" for name, words in summary.in_short(result)]
        if all:
            for table in summary.run_tables(result):
                cli.show_table(*table)
            lines = [f"assumed: {words}" for words in scenario_file.assumed]
        cli.say("\n".join([*lines, f"saved: {out}; all numbers: --all, or support-exudyn show {out}"]))
        for warning in warnings:
            cli.warn(f"warning: {warning}")
    if result.goal is not None and not result.met:
        cli.warn(summary.unmet(result))


def show(
    run: Path,
    /,
    *channels: str,
    impacts: bool = False,
    all: bool = False,  # noqa: A002, the option's name
    after: cli.After = summary.WHOLE[0],
    until: cli.Until = summary.WHOLE[1],
    json: cli.Json = False,
) -> None:
    """Print the tables of a run or of a sweep.

    Args:
        run: File of a run, as Result.save writes it; or the folder of a sweep.
        channels: Only these channels and numbers: names or patterns, such as `pin.*.force`, `*largest_force`.
        impacts: Print all impacts of a run's clearance pins, with their forces.
        all: Print all channels, and all numbers of a sweep.
    """
    if run.is_dir() or run.suffix == ".parquet":
        from support_exudyn.commands.sweeps import show_sweep  # and pyarrow

        if impacts:
            raise InputError(f"{run}: --impacts: is a sweep; allowed: the file of a run")
        show_sweep(run, channels, all, json)
        return
    result, ends = Result.load(run), (after, until)
    if impacts and not result.onsets:
        raise InputError(f"{run}: --impacts: has no clearance joint; allowed: a run that has some")
    known = numbers(result, *ends) if channels else {}
    names = matching([*result.channels, *known], channels, "channel or number")
    asked = [name for name in names if name in result.channels]
    if json:
        shown = asked if channels else [name for name in result.channels if name != "time"]
        cli.answer({"run": run} | summary.data(result, shown, ends))
        return
    if impacts:
        cli.show_table(*summary.impacts_table("impacts", result, None, ends))
    if channels:
        if only := [name for name in names if name in known]:
            cli.show_table(*summary.numbers_table(result, ends, only))
        cli.show_table(*summary.channels_table(result, asked, ends))
    elif not impacts:
        for table in summary.run_tables(result, ends, all):
            cli.show_table(*table)


def plot(
    run: str,
    /,
    *others: str,
    difference: bool = False,
    orbit: bool = False,
    spectrum: bool = False,
    stability: bool = False,
    pin: str | None = None,
    after: cli.After = -math.inf,
    until: cli.Until = math.inf,
    rate: cli.Rate | None = None,
    out: Annotated[Path | None, cli.FIGURES] = None,
    json: cli.Json = False,
) -> None:
    """Draw, write, and print the names of the files.

    Args:
        run: File of a run.
        others: More files, drawn one upon another: runs, CSV (time_s,tip.x_mm), ADAMS, MATLAB, Parquet, Exudyn.
            Then channels over time: names, or patterns as `pin.*.force`.
        difference: Draw of several runs what differs from the first.
        orbit: Draw the path of the journal of a clearance pin in its bore.
        spectrum: Draw the spectrum of the force in a pin.
        stability: Draw where friction makes pins vibrate as they slide, over stroke and friction.
        pin: Pin of orbit, spectrum and stability (the first with clearance).
        rate: Rows per second [Hz] of files without times.
        out: Folder of the figures (RUN_figures next to the run), or file of the only figure (.png, .pdf, .svg).
    """
    from support_exudyn.files.series.read import read_series
    from support_exudyn.postprocessing.figures import of_runs, style

    files, patterns = files_and_channels([run, *others])
    names, ends = by_name(files), (after, until)
    curves = {name: path for name, path in names.items() if is_of_others(path)}
    runs = {name: Result.load(path) for name, path in names.items() if name not in curves}
    if not runs:
        raise InputError(f"{run}: is no run; allowed: with a run before it, plot RUN {run}")
    asked = {"orbit": orbit, "spectrum": spectrum, "stability": stability}
    kinds = [kind for kind in asked if asked[kind]]
    if difference and (len(runs) < 2 or curves):
        raise InputError(
            "--difference: needs a second run, and no curves of others; allowed: plot FIRST.h5 SECOND.h5"
        )
    if len(names) > 1 and (kinds or pin):
        raise InputError(
            "--orbit, --spectrum, --stability, --pin: are of one run, and "
            f"{len(names)} are given; allowed with several: channels"
        )
    left_out: dict[str, str] = {}
    with style.look():
        if len(names) > 1:
            series = {name: read_series(path, rate=rate) for name, path in curves.items()}
            for name, table in series.items():
                for note in table.notes:
                    cli.warn(f"{name}: {note}")
            called = "_less_".join([*names][::-1]) if difference else "_and_".join([*runs, *curves])
            drawn = {of_runs.in_name(patterns): of_runs.of_several(runs, series, patterns, ends, difference)}
        else:
            (called,) = runs
            figures = of_runs.of_run(runs[called], patterns, kinds, pin, ends, left_out, alone=cli.is_file(out))
            drawn = {what: style.named(drawing, called) for what, drawing in figures}
        window = of_runs.window_in_name(*ends)
        drawings = {of_runs.joined(called, what, window): drawing for what, drawing in drawn.items()}
        folder = files[0].with_name(f"{files[0].stem}_figures")
        written = of_runs.save_figures(drawings, out, folder, cli.is_file(out))
    for kind, reason in left_out.items():
        cli.warn(f"{kind}: left out: {reason}")
    cli.put(json, {"figures": written}, *(path for paths in written.values() for path in paths))


# --- words that are files or channels ---


def files_and_channels(words: Sequence[str]) -> tuple[list[Path], list[str]]:
    """The files and the channels among words: the first is a file, others are if they are there or end so."""
    are_files = [
        n == 0 or Path(word).is_file() or (word.lower().endswith(ENDINGS) and not set(word) & set("*?"))
        for n, word in enumerate(words)
    ]
    files = [Path(word) for word, is_file in zip(words, are_files, strict=True) if is_file]
    return files, [word for word, is_file in zip(words, are_files, strict=True) if not is_file]


def is_of_others(path: Path) -> bool:
    """Whether a file is a series of others, and neither a run, whole or damaged, nor a text of ours."""
    if not path.is_file() or path.suffix.lower() == TOML:
        return path.suffix.lower() == CSV
    from support_exudyn.files.series.matlab import is_matlab
    from support_exudyn.files.series.own_runs import is_exported, is_run

    with path.open("rb") as file:
        head = file.read(HEAD)
    return not is_run(head) and (path.suffix.lower() != RUN or is_exported(head) or is_matlab(head))


def by_name(paths: Sequence[Path]) -> dict[str, Path]:
    """Files by their names: without the ending or the folder where that distinguishes them.

    Raises InputError if a file is given twice.
    """
    named: dict[str, Path] = {}
    for path in paths:
        if path in named.values():
            raise InputError(f"{path}: is given twice; allowed: every file once")
        others = [other for other in paths if other != path]
        name = path.name if any(other.stem == path.stem for other in others) else path.stem
        named[str(path) if any(other.name == name for other in others) else name] = path
    return named
