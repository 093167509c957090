"""Frames and movies of a run, as files and as pictures."""

import os
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.export.whole_set import whole_set
from support_exudyn.postprocessing.render import movie as movies
from support_exudyn.postprocessing.render.frame import Layout, Painter
from support_exudyn.postprocessing.render.movie import Moments, moment, moments
from support_exudyn.postprocessing.render.pin_views import pin_views
from support_exudyn.postprocessing.render.scene import RenderedScene
from support_exudyn.postprocessing.render.stage import Picture, Stage
from support_exudyn.scene.contract import Progress, silent
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

SIZE = (1280, 720)
OF_GIF = (960, 540)  # GIFs are no wider
SEEN = 0.25  # pixels by which something has to move before it is drawn anew
SMALLEST, LARGEST = (320, 180), (3840, 2160)
RATE = 25.0
FRAMES_SHARE = 0.85  # of the time that is spent before the movie
NAME, FRAME = "frame_{:04d}.png", re.compile(r"frame_\d{4,}\.png")
QUICKLY = 3  # compression of PNG
MAKER = "support_exudyn"  # stands in every frame, so that no picture of another program is removed


@dataclass(frozen=True)
class Rendered:
    """The files that were written.

    Arguments:
        frames: files of the frames, in their order.
        movie: file of the movie; None: there is none.
    """

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
    movie: str = "gif",
    movie_path: str | Path | None = None,
    size: tuple[int, int] | None = None,
    pin: str | None = None,
    progress: Progress = silent,
) -> Rendered:
    """Write frames of a run to a folder, and a movie of them.

    Each frame shows the record that is next to its time. Frames of earlier movies in the folder are replaced;
    all of it takes its place when all is done, and after an error or an interruption all is as it was.

    Arguments:
        result: the run; all bodies and the shown pin have to be recorded.
        folder: for frame_0000.png and so on.
        frames_per_second: of the movie, 0.1 to 240.
        after, until: of the movie in the run's time [s]; None: of the run.
        speed: seconds of the run in a second of the movie: 0.01 for impacts, a hundred times slower.
        movie: "gif", "mp4" (needs the extra [movie]) or "none".
        movie_path: None: the folder's name with the movie's ending, without "_frames".
        size: width and height of frames [pixels], even, 320 x 180 to 3840 x 2160; None: 960 x 540 of a GIF,
            else 1280 x 720.
        pin: whose force is shown, and its journal first of all clearance pins; None: the first clearance pin,
            or the first of all.
        progress: is called with the share that is done.

    Raises InputError if one of these is out of its range or a channel was not recorded, OSError if something
    cannot be written.
    """
    folder = Path(folder)
    shown = moments(result.time, after, until, frames_per_second, speed)
    movies.check(movie, frames_per_second, shown.times.size)
    target = None
    if movie != "none":
        usual = folder.with_name(f"{folder.name.removesuffix('_frames') or folder.name}.{movie}")
        target = usual if movie_path is None else Path(movie_path)
    show = _Show(result, size or (OF_GIF if movie == "gif" else SIZE), pin, shown)
    names = [NAME.format(n) for n in range(shown.times.size)]
    earlier = [old.name for old in folder.glob("*") if FRAME.fullmatch(old.name) and _is_ours(old)]
    share = FRAMES_SHARE if target else 1.0
    with whole_set(folder, names, earlier) as made:
        paths = [made / name for name in names]
        for n, path in enumerate(paths):
            maker = PngInfo()
            maker.add_text("Software", MAKER)
            Image.fromarray(show.frame(n)).save(path, format="PNG", compress_level=QUICKLY, pnginfo=maker)
            progress(share * (n + 1) / len(paths))
        if target is not None:
            with whole_file(target) as temporary:
                rest = 1.0 - share
                movies.write(movie, temporary, paths, frames_per_second, lambda s: progress(share + rest * s))
    return Rendered(tuple(folder / name for name in names), target)


def still(result: Result, time: float, *, size: tuple[int, int] = SIZE, pin: str | None = None) -> Picture:
    """A single frame as an array (height, width, 3) of RGB from 0 to 255.

    Arguments:
        result: the run.
        time: of the frame [s]; it shows the record next to it.
        size, pin: as of `render`.

    Raises InputError if the run does not reach the time, or as `render` does.
    """
    return _Show(result, size, pin, moment(result.time, time)).frame(0)


class _Show:
    """A run on its stage, with the painter of its frames."""

    def __init__(self, result: Result, size: tuple[int, int], pin: str | None, shown: Moments) -> None:
        for name, number, low, high in zip(("width", "height"), size, SMALLEST, LARGEST, strict=True):
            if not low <= number <= high or number % 2:
                raise InputError(f"size: {name} = {number} pixels: allowed: even, from {low} to {high}")
        self._scene, self._records = RenderedScene(result), shown.records
        views = pin_views(result, pin)
        layout = Layout(*size, bool(views))
        left, top, right, bottom = layout.picture
        self._camera = camera = self._scene.camera(right - left, bottom - top)
        threads = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        self._stage = Stage(self._scene.items(), camera, threads)
        self._painter = Painter(self._scene, layout, camera, views, shown)
        self._traced: tuple[np.ndarray, Picture] | None = None

    def frame(self, number: int) -> Picture:
        """A whole frame; the machine is that of an earlier one if nothing has visibly moved since."""
        record = int(self._records[number])
        where = self._camera.pixels(self._scene.corners(record))
        if self._traced is None or np.abs(where - self._traced[0]).max() > SEEN:
            self._traced = where, self._stage.image(self._scene.places(record))
        return self._painter.frame(self._traced[1], number)


def _is_ours(path: Path) -> bool:
    """Whether a frame says that this program has made it."""
    try:
        with Image.open(path, formats=["PNG"]) as opened:
            return opened.info.get("Software") == MAKER
    except (OSError, ValueError, SyntaxError):
        return False
