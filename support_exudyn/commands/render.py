"""`render RUN`: frames and a movie of a run."""

import argparse
import re
import sys

from support_exudyn.commands.command_line import (
    add_json,
    add_out,
    add_run,
    add_times,
    answer,
    number,
    say,
    shown_progress,
)
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, and what is made of it."""
    add = parser.add_argument
    add_run(parser)
    add_out(
        parser,
        "folder for frame_0000.png and so on; the movie is written beside it. Default: RUN_frames beside "
        "RUN. With --still: the file of the picture",
    )
    add(
        "--frames-per-second",
        "--fps",
        type=number,
        default=25.0,
        metavar="N",
        help="of the movie, 0.1 to 240 (25)",
    )
    add_times(parser)
    add(
        "--speed",
        type=number,
        default=1.0,
        metavar="S",
        help="seconds of the run in a second of the movie (1); 0.01 is a hundred times slower, for impacts. A "
        "frame shows the record next to its time, so slower than the records shows each of them several times",
    )
    add(
        "--movie",
        choices=("gif", "mp4", "none"),
        default="gif",
        help="kind of the movie (gif: at most 960 pixels wide); mp4 needs the extra [movie]",
    )
    add("--size", type=size, metavar="WxH", help="of frames in pixels, even (960x540 of a gif, else 1280x720)")
    add(
        "--pin", metavar="NAME", help="whose force is shown, and journal first of all (the first clearance pin)"
    )
    add("--still", type=number, metavar="T", help="a single picture at this time [s], and no movie")
    add_json(parser)


def run(given: argparse.Namespace) -> None:
    """Write them, with a progress bar on stderr."""
    if given.still is not None and (given.after is not None or given.until is not None):
        raise InputError("--still: is one picture; allowed: without --after and --until")
    result = Result.load(given.run)
    if given.still is not None:
        _still(given, result)
        return
    from support_exudyn.postprocessing.render import render

    out = given.out or given.run.with_name(f"{given.run.stem}_frames")
    with shown_progress(f"rendering {given.run.name}") as progress:
        written = render(
            result,
            out,
            frames_per_second=given.frames_per_second,
            after=given.after,
            until=given.until,
            speed=given.speed,
            movie=given.movie,
            size=given.size,
            pin=given.pin,
            progress=progress,
        )
    if given.json:
        answer({"frames": written.frames, "movie": written.movie})
        return
    say(f"{len(written.frames)} frame{'s' * (len(written.frames) > 1)} in {out}")
    if len(written.frames) == 1 and result.time.size > 1:
        step = given.speed / given.frames_per_second
        print(
            f"a single frame: less is shown than the {step:g} s between two; more by a smaller --speed",
            file=sys.stderr,
        )
    if written.movie is not None:
        say(f"{written.movie} ({written.movie.stat().st_size / 1e6:.3g} MB)")


def _still(given: argparse.Namespace, result: Result) -> None:
    from PIL import Image

    from support_exudyn.files.whole_file import whole_file
    from support_exudyn.postprocessing.render import SIZE, still

    path = given.out or given.run.with_name(f"{given.run.stem}_{given.still:g}s.png")
    if path.suffix.lower() != ".png":
        raise InputError(f"--out {path}: allowed with --still: a name that ends in .png")
    picture = still(result, given.still, size=given.size or SIZE, pin=given.pin)
    with whole_file(path) as temporary:
        Image.fromarray(picture).save(temporary, format="PNG")
    if given.json:
        answer({"frames": [path], "movie": None})
        return
    say(str(path))


def size(text: str) -> tuple[int, int]:
    """Width and height from the command line."""
    found = re.fullmatch(r"(\d{1,5})[xX](\d{1,5})", text)
    if found is None:
        raise argparse.ArgumentTypeError(
            f"{short(text)}: allowed: width and height in pixels, such as 1280x720"
        )
    return int(found[1]), int(found[2])
