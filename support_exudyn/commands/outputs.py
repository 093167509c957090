"""Commands that make files or pictures of a run: `report`, `render`, `view`, `measure`, `export`."""

import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter
from cyclopts.validators import Number

from support_exudyn.commands import command_line as cli
from support_exudyn.commands.runs import by_name, files_and_channels
from support_exudyn.files.whole_file import whole_file
from support_exudyn.scene.contract import Progress
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

USUAL = ("vtu", "csv", "hdf5")
FORMATS = (*USUAL, "solution")
Every = Annotated[int | None, cli.at_most(10**9)]  # records
Positive = Annotated[float, Parameter(validator=Number(gte=1e-9, lte=1e9))]


def report(
    run: str,
    /,
    *others: str,
    out: Annotated[Path | None, cli.output(".html")] = None,
    json: cli.Json = False,
) -> None:
    """Write the page, and print its name.

    Args:
        run: File of a run.
        others: Files of more runs, then channels that are drawn over time: names, or patterns as `pin.*.force`.
        out: Folder for report.html, or a file .html (RUN_report.html next to the first run).
    """
    from support_exudyn.postprocessing.run_report import run_report

    paths, channels = files_and_channels([run, *others])
    page = run_report({name: Result.load(path) for name, path in by_name(paths).items()}, channels)
    path = out or paths[0].with_name(f"{paths[0].stem}_report.html")
    path = path if path.suffix.lower() == ".html" else path / "report.html"
    with whole_file(path) as temporary:
        temporary.write_text(page, encoding="utf-8")
    cli.put(json, {"report": path}, path)


def _size(type_: object, tokens: Any) -> tuple[int, int]:
    """Width and height from the command line."""
    del type_
    parts = re.fullmatch(r"(\d{1,5})[xX](\d{1,5})", tokens[0].value)
    if parts is None:
        raise ValueError("allowed: width and height in pixels, such as 1280x720")
    return int(parts[1]), int(parts[2])


Size = Annotated[tuple[int, int] | None, Parameter(converter=_size, n_tokens=1)]


def render(
    run: Path,
    /,
    *,
    out: Annotated[Path | None, cli.output(".png")] = None,
    frames_per_second: Annotated[float, Parameter(name=("--frames-per-second", "--fps"))] = 25.0,
    after: cli.After | None = None,
    until: cli.Until | None = None,
    speed: float = 1.0,
    movie: Annotated[bool, Parameter(negative="--no-movie")] = True,
    size: Size = None,
    pin: str | None = None,
    still: float | None = None,
    json: cli.Json = False,
) -> None:
    """Draw frames and a movie, or a picture.

    Args:
        run: File of a run.
        out: Folder for the frames, with the movie next to it (RUN_frames). With --still: file of the picture.
        frames_per_second: Of the movie, 0.1 to 50 (25).
        speed: Seconds of the run in a second of the movie (1); 0.01 is a hundred times slower, for impacts. A
            frame shows the record next to its time.
        movie: Make a GIF of the frames.
        size: WxH of frames in pixels, even (960x540, a picture 1280x720).
        pin: Whose force is shown, and journal first of all (the first clearance pin).
        still: Time of a single picture [s]; no movie.
    """
    from PIL import Image

    from support_exudyn.postprocessing import render as rendering

    if still is not None and (after is not None or until is not None):
        raise InputError("--still: is one picture; allowed: without --after and --until")
    if still is None and cli.is_file(out):
        raise InputError(f"--out {out}: allowed without --still: a folder for the frames, without an ending")
    result = Result.load(run)
    if still is not None:
        path = out or run.with_name(f"{run.stem}_{still:g}s.png")
        if path.suffix.lower() != ".png":
            raise InputError(f"--out {path}: allowed with --still: a name that ends in .png")
        picture = rendering.still(result, still, size=size or rendering.STILL, pin=pin)
        with whole_file(path) as temporary:
            Image.fromarray(picture).save(temporary, format="PNG")
        cli.put(json, {"frames": [path], "movie": None}, path)
        return
    folder = out or run.with_name(f"{run.stem}_frames")
    with cli.shown_progress(f"rendering {run.name}") as progress:
        written = rendering.render(
            result,
            folder,
            frames_per_second=frames_per_second,
            after=after,
            until=until,
            speed=speed,
            movie=movie,
            size=size or rendering.SIZE,
            pin=pin,
            progress=progress,
        )
    lines = [f"{_counted(len(written.frames), 'frame')} in {folder}"]
    if written.movie is not None:
        lines.append(f"{written.movie} ({written.movie.stat().st_size / 1e6:.3g} MB)")
    cli.put(json, {"frames": written.frames, "movie": written.movie}, *lines)


def view(run: Path, /, *, solution: Path | None = None, every: Every = None) -> None:
    """Open the viewer, and wait until it is closed.

    Args:
        run: File of a run.
        solution: Show this solution file of Exudyn, of the same run, in place of its records.
        every: Records from frame to frame, up to 200 (the run takes about 10 s).
    """
    result = Result.load(run)
    from support_exudyn.postprocessing.viewer.view import open_viewer  # which refusing a file has no use for

    open_viewer(result, solution=solution, every=every, name=run.name)


def measure(
    run: Path,
    instruments: Path | None = None,
    /,
    *,
    out: Annotated[Path | None, cli.output(".csv", folder=False)] = None,
    json: cli.Json = False,
) -> None:
    """Write the table of what instruments read, and print what is in it.

    Args:
        run: File of a run.
        instruments: TOML file of the instruments (perfect instruments, 10 times a second: pressure and
            extension of all columns, tilt of all bodies and of the base).
        out: The table, CSV (RUN_measured.csv next to the run).
    """
    from support_exudyn.postprocessing.instruments import station as stations

    result, refused = Result.load(run), dict[str, InputError]()
    if instruments is None:
        station, refused = stations.usual_station(result.scenario)
    else:
        station = stations.read_station(instruments)
    measured = stations.measure(result, station)
    out = out or run.with_name(f"{run.stem}_measured.csv")
    stations.write_measured(measured, out)
    sizes = {name: reading.time.size for name, reading in measured.items()}
    cli.put(
        json,
        {"written": out, "samples": sizes, "left_out": _left_out(refused)},
        f"{out}: {_counted(len(measured), 'instrument')}, {max(sizes.values())} samples",
    )


def export(
    run: Path,
    /,
    *,
    to: str = "",
    out: Path | None = None,
    every: Every = None,
    frames_per_second: Positive | None = None,
    after: cli.After = 0.0,
    until: cli.Until | None = None,
    json: cli.Json = False,
) -> None:
    """Write meshes and tables of a run, and print which.

    Args:
        run: File of a run.
        to: FORMAT,FORMAT,... (all but the last that the run has recorded enough for). vtu: a folder NAME_vtu
            with a file per step, machine.pvd and pins.pvd, for ParaView; csv: NAME.csv; hdf5: NAME_channels.h5
            for MATLAB and others; solution: NAME_solution.txt, Exudyn's own solution file, all records.
        out: Folder (NAME_export next to the run).
        every: One in so many records.
        frames_per_second: The records nearest to so many times per second of the run (25 for meshes, all
            records for tables).
    """
    from support_exudyn.postprocessing.export.meshes import MESHES, to_vtu  # and meshio
    from support_exudyn.postprocessing.export.sampling import Sampling
    from support_exudyn.postprocessing.export.solution_file import save_solution
    from support_exudyn.postprocessing.export.tables import TABLES, to_csv, to_hdf5

    if cli.is_file(out):
        raise InputError(f"--out {out}: is a folder for all formats; allowed: a name without an ending")
    result, name, folder = Result.load(run), run.stem, out or run.parent / f"{run.stem}_export"
    kinds = [kind.strip() for kind in to.split(",")] if to else []
    for kind in kinds:
        if kind not in FORMATS:
            raise InputError(f"--to {short(kind)}: no such format; allowed: {', '.join(FORMATS)}")
    usual = every is None and frames_per_second is None
    chosen = Sampling(every=every, frames_per_second=frames_per_second, after=after, until=until)
    meshes, tables = (
        replace(chosen, frames_per_second=own.frames_per_second) if usual else chosen
        for own in (MESHES, TABLES)
    )
    work: dict[str, Callable[[Progress], tuple[Path, ...]]] = {
        "vtu": lambda progress: to_vtu(result, folder / f"{name}_vtu", meshes, progress),
        "csv": lambda progress: to_csv(result, folder / f"{name}.csv", tables, progress),
        "hdf5": lambda progress: to_hdf5(result, folder / f"{name}_channels.h5", tables),
        "solution": lambda progress: (save_solution(result, folder / f"{name}_solution.txt"),),
    }
    refused: dict[str, InputError] = {}
    written: dict[str, tuple[Path, ...]] = {}
    for kind in dict.fromkeys(kinds or USUAL):
        try:
            with cli.shown_progress(kind) as progress:
                files = written[kind] = work[kind](progress)
        except InputError as error:
            if kinds:
                raise
            refused[kind] = error
            continue
        if not json:
            size = sum(file.stat().st_size for file in files)
            cli.say(f"{kind}: {files[0]} ({_counted(len(files), 'file')}, {size / 1e6:.3g} MB)")
    if not written:
        raise refused[USUAL[0]]
    left_out = _left_out(refused)
    if json:
        cli.answer({"written": written, "left_out": left_out})


def _left_out(refused: dict[str, InputError]) -> dict[str, str]:
    """What is left out, and why; it is also printed as a warning."""
    for name, reason in refused.items():
        cli.warn(f"{name}: left out: {reason}")
    return {name: str(reason) for name, reason in refused.items()}


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'s' * (number != 1)}"
