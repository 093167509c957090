"""Commands that make something of a run: `report`, `view`, `measure`, `export`."""

import argparse
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from support_exudyn.commands.command_line import (
    add_json,
    add_out,
    add_run,
    add_times,
    answer,
    count,
    folder,
    meant,
    number,
    say,
    shown_progress,
    warn,
)
from support_exudyn.commands.runs import named_runs, runs_and_channels
from support_exudyn.files.whole_file import whole_file
from support_exudyn.scene.contract import Progress
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

# --- report ---


FILE = "report.html"


def add_report(parser: argparse.ArgumentParser) -> None:
    """The runs' files, what is drawn, and where to."""
    parser.add_argument(
        "names",
        nargs="+",
        metavar="RUN|CHANNEL",
        help="files of runs, as Result.save writes them, then channels that are drawn over time: names, or "
        "patterns as 'pin.*.force' (clearance pins, their bodies, traced points)",
    )
    add_out(parser, f"folder for {FILE}, or a file .html (RUN_{FILE} next to the first run)")
    add_json(parser)


def run_report(given: argparse.Namespace) -> None:
    """Write the page, and print its name."""
    paths, channels = runs_and_channels(given.names)
    results = {name: Result.load(path) for name, path in named_runs(paths).items()}
    from support_exudyn.postprocessing.run_report import run_report

    page = run_report(results, channels)
    first = paths[0]
    out = given.out or first.with_name(f"{first.stem}_{FILE}")
    path = out if out.suffix == ".html" else out / FILE
    with whole_file(path) as temporary:
        temporary.write_text(page, encoding="utf-8")
    if given.json:
        answer({"report": path})
    else:
        say(str(path))


# --- view ---


def add_view(parser: argparse.ArgumentParser) -> None:
    """The run's file, and what of it is shown."""
    add = parser.add_argument
    add_run(parser)
    add(
        "--solution",
        type=folder,
        metavar="FILE",
        help="show this solution file of Exudyn, of the same run, in place of its records",
    )
    add(
        "--every",
        type=count,
        metavar="N",
        help="records from frame to frame, up to 200; by default the run takes about 10 s",
    )


def run_view(given: argparse.Namespace) -> None:
    """Open it, and wait until it is closed."""
    result = Result.load(given.run)
    from support_exudyn.postprocessing.viewer.view import (
        open_viewer,  # libraries of shapes, which refusing a file has no use for
    )

    open_viewer(result, solution=given.solution, every=given.every, name=given.run.name)


# --- measure ---


def add_measure(parser: argparse.ArgumentParser) -> None:
    """The run's file, that of the instruments, and where to."""
    add_run(parser)
    parser.add_argument(
        "instruments",
        nargs="?",
        type=folder,
        metavar="INSTRUMENTS",
        help="TOML file of the instruments; without it perfect ones, 10 times a second: pressure and extension "
        "of all columns, tilt of all bodies and of the base",
    )
    add_out(parser, "the table, CSV; by default RUN_measured.csv next to the run", "FILE")
    add_json(parser)


def run_measure(given: argparse.Namespace) -> None:
    """Write the table, and print what is in it."""
    from support_exudyn.postprocessing.instruments.station import (
        measure,
        read_station,
        usual_station,
        write_measured,
    )

    result = Result.load(given.run)
    if given.instruments is None:
        station, refused = usual_station(result.scenario)
    else:
        station, refused = read_station(given.instruments), {}
    measured = measure(result, station)
    out = given.out or given.run.with_name(f"{given.run.stem}_measured.csv")
    write_measured(measured, out)
    for name, reason in refused.items():
        warn(f"{name}: left out: {reason}")
    if given.json:
        sizes = {name: one.time.size for name, one in measured.items()}
        answer(
            {"written": out, "samples": sizes, "left_out": {name: str(one) for name, one in refused.items()}}
        )
        return
    say(f"{out}: {len(measured)} instruments, {max(one.time.size for one in measured.values())} samples")


# --- export ---


USUAL = ("xdmf", "vtu", "csv", "hdf5")
FORMATS = (*USUAL, "solution")
SLOWEST, FASTEST = 1e-9, 1e9  # frames a second


def add_export(parser: argparse.ArgumentParser) -> None:
    """The run's file, what to write of it, and where to."""
    add_run(parser)
    parser.add_argument(
        "--to",
        action="extend",
        type=formats,
        metavar="FORMAT[,FORMAT]",
        help="xdmf: NAME.xdmf and NAME_pins.xdmf, with one HDF5 file for both; vtu: a folder NAME_vtu with a "
        "file per step, machine.pvd and pins.pvd; csv: NAME.csv; hdf5: NAME_channels.h5 for MATLAB and others; "
        "solution: NAME_solution.txt, Exudyn's own solution file, all records; by default all but the last "
        "that the run has recorded enough for",
    )
    add_out(parser, "where to; by default NAME_export beside the run")
    density = parser.add_mutually_exclusive_group()
    density.add_argument("--every", type=count, metavar="N", help="one in N records")
    density.add_argument(
        "--frames-per-second",
        type=partial(number, low=SLOWEST, high=FASTEST),
        metavar="F",
        help="the records nearest to F times per second of the run; by default 25 for meshes, and all records "
        "for tables",
    )
    add_json(parser)
    add_times(parser, 0.0)


def formats(text: str) -> list[str]:
    """Formats from the command line, with commas between them."""
    found = [one.strip() for one in text.split(",")]
    for one in found:
        if one not in FORMATS:
            raise argparse.ArgumentTypeError(f"{short(one)}: no such format; {meant(one, FORMATS)}")
    return found


def run_export(given: argparse.Namespace) -> None:
    """Write what was asked for, and print what was written."""
    from support_exudyn.postprocessing.export.mesh_files import MESHES, to_vtu, to_xdmf  # and meshio
    from support_exudyn.postprocessing.export.sampling import Sampling
    from support_exudyn.postprocessing.export.solution_file import save_solution
    from support_exudyn.postprocessing.export.tables import TABLES, to_csv, to_hdf5

    if given.until is not None and given.until < given.after:
        raise InputError(
            f"--after {given.after:g} --until {given.until:g}: allowed: --until not before --after"
        )
    result = Result.load(given.run)
    name, out = given.run.stem, given.out or given.run.parent / f"{given.run.stem}_export"

    def sampling(usual: Sampling) -> Sampling:
        said = given.every is not None or given.frames_per_second is not None
        return Sampling(
            every=given.every,
            frames_per_second=given.frames_per_second if said else usual.frames_per_second,
            after=given.after,
            until=given.until,
        )

    work: dict[str, Callable[[Progress], tuple[Path, ...]]] = {
        "xdmf": lambda progress: to_xdmf(result, out / f"{name}.xdmf", sampling(MESHES), progress),
        "vtu": lambda progress: to_vtu(result, out / f"{name}_vtu", sampling(MESHES), progress),
        "csv": lambda progress: to_csv(result, out / f"{name}.csv", sampling(TABLES), progress),
        "hdf5": lambda progress: to_hdf5(result, out / f"{name}_channels.h5", sampling(TABLES)),
        "solution": lambda progress: (save_solution(result, out / f"{name}_solution.txt"),),
    }
    refused: dict[str, InputError] = {}
    written: dict[str, tuple[Path, ...]] = {}
    for kind in dict.fromkeys(given.to or USUAL):
        started = time.perf_counter()
        try:
            with shown_progress(kind) as progress:
                files = work[kind](progress)
        except InputError as error:
            if given.to:
                raise
            refused[kind] = error
            continue
        written[kind] = files
        if not given.json:
            size = sum(file.stat().st_size for file in files)
            took = time.perf_counter() - started
            say(f"{kind}: {files[0]} ({_counted(len(files))}, {size / 1e6:.3g} MB, {took:.2g} s)")
        if kind in ("xdmf", "vtu") and given.until != given.after and result.time.size > 1:
            _tell_of_a_single_step(len(sampling(MESHES).records(result.time)), kind)
    if len(refused) == len(USUAL):
        raise refused[USUAL[0]]
    for kind, reason in refused.items():
        warn(f"{kind}: left out: {reason}")
    if given.json:
        answer({"written": written, "left_out": {kind: str(reason) for kind, reason in refused.items()}})


def _tell_of_a_single_step(steps: int, kind: str) -> None:
    """Say so if a mesh has a single step, which the user may not have meant."""
    if steps == 1:
        print(f"{kind}: a single step; more by a larger --frames-per-second or by --every", file=sys.stderr)


def _counted(files: int) -> str:
    return "1 file" if files == 1 else f"{files} files"
