"""Frames and movies of a run, as files and as pictures."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from PIL.ImageColor import getrgb
from PIL.PngImagePlugin import PngInfo

from support_exudyn.files.whole_file import whole_file
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.export.whole_set import whole_set
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.render.frame import Painter, Times
from support_exudyn.postprocessing.render.stage import Picture
from support_exudyn.scene.contract import Progress, silent
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

SIZE, STILL = (960, 540), (1280, 720)  # of frames, of single pictures
SMALLEST, LARGEST = (320, 180), (3840, 2160)
RATE, FASTEST = 25.0, 50.0  # frames a second; players show faster GIFs later
MOST_FRAMES = 2000  # the GIF is made in memory
NAME, FRAME = "frame_{:04d}.png", re.compile(r"frame_\d{4,}\.png")
MAKER = "support_exudyn"  # stands in every frame, so that no picture of another program is removed
COLOURS, SAMPLED = 256, 5  # of a GIF, and frames by which they are chosen
ALWAYS = ("#ffffff", CONTACT, FLIGHT)  # colours that have a meaning
NEARLY_WHITE = 248  # of 255: what is as light is white
WIDEST = 960  # pixels of a GIF; larger frames are shrunk


@dataclass(frozen=True)
class Rendered:
    """The files that were written: frames in their order, and the movie; None: there is none."""

    frames: tuple[Path, ...]
    movie: Path | None


def render(
    result: Result,
    folder: str | Path,
    *,
    frames_per_second: float = RATE,
    after: float | None = None,
    until: float | None = None,
    speed: float = 1.0,
    movie: bool = True,
    size: tuple[int, int] = SIZE,
    pin: str | None = None,
    progress: Progress = silent,
) -> Rendered:
    """Write frames of a run to a folder, and next to it a movie of them, GIF.

    Each frame shows the record that is next to its time. Frames of earlier movies in the folder are replaced;
    all of it takes its place when all is done, and after an error or an interruption all is as it was.

    Arguments:
        result: the run; all bodies and the shown pin have to be recorded.
        folder: for frame_0000.png and so on. The movie is called as it is, without "_frames".
        frames_per_second: of the movie, 0.1 to 50.
        after, until: of the movie in the run's time [s]; None: of the run.
        speed: seconds of the run in a second of the movie: 0.01 for impacts, a hundred times slower.
        movie: whether the GIF is made.
        size: width and height of frames [pixels], even, 320 x 180 to 3840 x 2160.
        pin: whose force is shown, and its journal first of all clearance pins; None: the first clearance pin,
            or the first of all.
        progress: is called with the share that is done.

    Raises InputError if one of these is out of its range or a channel was not recorded, OSError if something
    cannot be written.
    """
    folder = Path(folder)
    times = _times(result.time, after, until, frames_per_second, speed)
    painter = _painter(result, size, pin, times)
    names = [NAME.format(n) for n in range(times.frames.size)]
    earlier = [old.name for old in folder.glob("*") if FRAME.fullmatch(old.name) and _is_ours(old)]
    target = folder.with_name(f"{folder.name.removesuffix('_frames') or folder.name}.gif") if movie else None
    maker = PngInfo()
    maker.add_text("Software", MAKER)
    with whole_set(folder, names, earlier) as made:
        paths = [made / name for name in names]
        for n, path in enumerate(paths):
            Image.fromarray(painter.frame(n)).save(path, format="PNG", compress_level=3, pnginfo=maker)
            progress((n + 1) / (len(paths) + bool(movie)))
        if target is not None:
            with whole_file(target) as temporary:
                _write_gif(temporary, paths, frames_per_second)
    progress(1.0)
    return Rendered(tuple(folder / name for name in names), target)


def still(result: Result, time: float, *, size: tuple[int, int] = STILL, pin: str | None = None) -> Picture:
    """A single frame as an array (height, width, 3) of RGB from 0 to 255.

    Arguments:
        result: the run.
        time: of the frame [s]; it shows the record next to it.
        size, pin: as of `render`.

    Raises InputError if the run does not reach the time, or as `render` does.
    """
    first, last = float(result.time[0]), float(result.time[-1])
    _check("time", time, first, last, " s")
    step = min([1e-3, *np.diff(result.time)])
    return _painter(result, size, pin, Times(np.array([time]), step, 1.0, (first, last))).frame(0)


def _painter(result: Result, size: tuple[int, int], pin: str | None, times: Times) -> Painter:
    for name, number, low, high in zip(("width", "height"), size, SMALLEST, LARGEST, strict=True):
        if not low <= number <= high or number % 2:
            raise InputError(f"size: {name} = {number} pixels: allowed: even, from {low} to {high}")
    return Painter(result, size, pin, times)


def _times(time: Series, after: float | None, until: float | None, rate: float, speed: float) -> Times:
    """The times of frames between two times of a run. Raises InputError if something is out of its range."""
    first, last = float(time[0]), float(time[-1])
    after, until = (first if after is None else after), (last if until is None else until)
    _check("frames_per_second", rate, 0.1, FASTEST, "")
    _check("speed", speed, 1e-6, 1e3, "")
    _check("after", after, first, last, " s")
    _check("until", until, first, last, " s")
    if until <= after and time.size > 1:
        raise InputError(f"until = {until} s: allowed: later than the first frame, at {after} s")
    step = speed / rate
    number = math.floor((until - after) / step + 1e-9) + 1
    if number > MOST_FRAMES:
        raise InputError(
            f"{number} frames from {after} to {until} s at {rate:g} a second and speed {speed:g}; allowed: "
            f"up to {MOST_FRAMES}. Take a shorter time, a higher speed or fewer frames a second"
        )
    return Times(after + step * np.arange(number, dtype=np.float64), step, rate, (after, until))


def _check(name: str, number: float, low: float, high: float, unit: str) -> None:
    if not low <= number <= high:
        raise InputError(f"{name} = {number:g}{unit}: allowed: {low:g} to {high:g}{unit}")


def _write_gif(path: Path, frames: Sequence[Path], rate: float) -> None:
    """Write a GIF with one palette, without dots in between, so that what stands still costs nothing."""

    def shrunk(frame: Path) -> Image.Image:
        with Image.open(frame) as opened:
            picture = opened.convert("RGB")
        picture.thumbnail((WIDEST, WIDEST), Image.Resampling.LANCZOS)
        return picture

    samples = [frames[n] for n in np.unique(np.linspace(0, len(frames) - 1, SAMPLED).astype(int))]
    sample = Image.fromarray(np.concatenate([np.asarray(shrunk(one)) for one in samples]))
    most = sample.quantize(COLOURS - len(ALWAYS), method=Image.Quantize.MEDIANCUT).getpalette() or []
    palette = Image.new("P", (1, 1))
    parts = [part for colour in ALWAYS for part in getrgb(colour)] + most
    palette.putpalette([255 if part > NEARLY_WHITE else part for part in parts])  # which Pillow rounds
    pictures = (shrunk(one).quantize(palette=palette, dither=Image.Dither.NONE) for one in frames)
    # hundredths of a second that add up to the movie's length
    ends = np.round(100.0 * np.arange(len(frames) + 1) / rate).astype(int)
    durations = (10 * np.diff(ends)).tolist()
    with path.open("wb") as file:
        next(pictures).save(
            file,
            format="GIF",
            save_all=True,
            append_images=pictures,
            duration=durations,
            loop=0,
            optimize=False,
        )


def _is_ours(path: Path) -> bool:
    """Whether a frame says that this program has made it."""
    try:
        with Image.open(path, formats=["PNG"]) as opened:
            return opened.info.get("Software") == MAKER
    except (OSError, ValueError, SyntaxError):
        return False
