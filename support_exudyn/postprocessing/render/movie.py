"""The times of frames and which records they show; movies of frames: GIF by Pillow, MP4 by imageio-ffmpeg."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from PIL import Image
from PIL.ImageColor import getrgb

from support_exudyn.mechanics.trajectory import Series
from support_exudyn.postprocessing.figures.selection import nearest
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.render.canvas import INK
from support_exudyn.scene.contract import Progress
from user_forces.values.value import InputError

MOST_FRAMES = 20_000
SLOWEST, FASTEST = 1e-6, 1e3
MOST_A_SECOND = 240.0
LONGEST_STEP = 1e-3  # [s] to which the time of a single picture is printed at least


@dataclass(frozen=True)
class Moments:
    """The times of frames.

    Frames need not be at records: each shows the record next to its time, for between records it is not known
    whether a journal has been in contact. In slow motion one record may so be seen in several frames.

    Arguments:
        times: of the frames [s].
        time: of all records [s].
        step: between frames [s] of the run.
        rate: frames in a second of the movie.
        shown: what of the run is drawn over time, from and to [s].
    """

    times: Series
    time: Series
    step: float
    rate: float
    shown: tuple[float, float]

    @property
    def records(self) -> npt.NDArray[np.intp]:
        """The records that the frames show."""
        return nearest(self.time, self.times)

    @property
    def pace(self) -> str:
        """The words for the movie's speed; none at the run's."""
        speed = self.step * self.rate
        if self.times.size == 1 or abs(speed - 1.0) < 1e-9:
            return ""
        return f"{1.0 / speed:.4g} \u00d7 slower" if speed < 1.0 else f"{speed:.4g} \u00d7 faster"

    @property
    def decimals(self) -> int:
        """With how many the time is printed, so that it differs from frame to frame; 3 to 7."""
        return min(7, max(3, math.ceil(-math.log10(max(self.step, 1e-9)) - 1e-9)))

    def back(self, number: int, seconds: float) -> int:
        """The record that lies so many seconds of the movie before a frame, or that of the first frame."""
        past = max(self.times[number] - seconds * self.rate * self.step, self.times[0])
        return min(int(np.searchsorted(self.time, past)), int(self.records[number]))


def moments(time: Series, after: float | None, until: float | None, rate: float, speed: float) -> Moments:
    """The times of the frames between two times of a run.

    Arguments:
        time: of the records [s].
        after, until: of the movie in the run's time [s]; None: of the run.
        rate: frames a second.
        speed: seconds of the run in a second of the movie; below 1 slow motion.

    Raises InputError if one of these is out of its range, or there would be too many frames.
    """
    first, last = float(time[0]), float(time[-1])
    after = first if after is None else after
    until = last if until is None else until
    check_between("frames_per_second", rate, 0.1, MOST_A_SECOND, "")
    check_between("speed", speed, SLOWEST, FASTEST, "")
    check_between("after", after, first, last, " s")
    check_between("until", until, first, last, " s")
    if until <= after and not time.size == 1:
        raise InputError(f"until = {until} s: allowed: later than the first frame, at {after} s")
    step = speed / rate
    number = math.floor((until - after) / step + 1e-9) + 1
    if number > MOST_FRAMES:
        raise InputError(
            f"{number} frames from {after} to {until} s at {rate:g} a second and speed {speed:g}; allowed: "
            f"up to {MOST_FRAMES}. Take a shorter time, a higher speed or fewer frames a second"
        )
    return Moments(after + step * np.arange(number, dtype=np.float64), time, step, rate, (after, until))


def moment(time: Series, at: float) -> Moments:
    """The time of a single picture [s]. Raises InputError if the run does not reach it."""
    check_between("time", at, float(time[0]), float(time[-1]), " s")
    step = min(LONGEST_STEP, float(np.median(np.diff(time)))) if time.size > 1 else LONGEST_STEP
    return Moments(np.array([at]), time, step, 1.0, (float(time[0]), float(time[-1])))


def check_between(name: str, number: float, low: float, high: float, unit: str) -> None:
    """Raise InputError unless a number is in its range."""
    if not low <= number <= high:
        raise InputError(f"{name} = {number:g}{unit}: allowed: {low:g} to {high:g}{unit}")


# --- movies ---

KINDS = ("gif", "mp4", "none")
WIDEST_GIF = 960  # [pixels]; larger frames are shrunk
MOST_GIF_FRAMES = 2000  # it is made in memory
FASTEST_GIF = 50.0  # frames a second: players show shorter ones later
COLOURS = 256
NEARLY_WHITE = 248  # of 255: what is as light is white, which Pillow rounds
SAMPLED = 5  # frames by which the colours of a GIF are chosen
ALWAYS = (CONTACT, FLIGHT, INK, "#ffffff")
QUALITY = 8.0  # of MP4, from 0 to 10


def check(kind: str, rate: float, frames: int) -> None:
    """Raise InputError if a movie of this kind cannot be made, before frames are."""
    if kind not in KINDS:
        raise InputError(f"movie = {kind!r}: allowed: {', '.join(KINDS)}")
    if kind == "gif" and (rate > FASTEST_GIF or frames > MOST_GIF_FRAMES):
        raise InputError(
            f"{frames} frames at frames_per_second = {rate:g}; allowed: of a GIF up to {MOST_GIF_FRAMES} and "
            f"{FASTEST_GIF:g}, or an MP4"
        )
    if kind == "mp4":
        _ffmpeg()


def write(kind: str, path: Path, frames: Sequence[Path], rate: float, progress: Progress) -> None:
    """Write a movie of a kind to a path; rate: frames a second."""
    (_gif if kind == "gif" else _mp4)(path, frames, rate, progress)


def _gif(path: Path, frames: Sequence[Path], rate: float, progress: Progress) -> None:
    """One palette for all, and no dots in between, so that what stands still costs nothing.

    The palette has the colours that a few frames have most, and those that have a meaning.
    """
    samples = [frames[n] for n in np.unique(np.linspace(0, len(frames) - 1, SAMPLED).astype(int))]
    sample = Image.fromarray(np.concatenate([np.asarray(_shrunk(one)) for one in samples]))
    most = sample.quantize(COLOURS - len(ALWAYS), method=Image.Quantize.MEDIANCUT).getpalette() or []
    chosen = [part for colour in ALWAYS for part in getrgb(colour)] + most[: 3 * (COLOURS - len(ALWAYS))]
    palette = Image.new("P", (1, 1))
    palette.putpalette([255 if part > NEARLY_WHITE else part for part in chosen])

    def reduced(number: int) -> Image.Image:
        progress((number + 1) / len(frames))
        return _shrunk(frames[number]).quantize(palette=palette, dither=Image.Dither.NONE)

    # hundredths of a second that add up to the movie's length
    ends = np.round(100.0 * np.arange(len(frames) + 1) / rate).astype(int)
    with path.open("wb") as file:
        reduced(0).save(
            file, format="GIF", save_all=True, append_images=map(reduced, range(1, len(frames))),
            duration=(10 * np.diff(ends)).tolist(), loop=0, optimize=False,
        )  # fmt: skip


def _shrunk(path: Path) -> Image.Image:
    """A frame, no wider than a GIF's."""
    with Image.open(path) as opened:
        frame = opened.convert("RGB")
    if frame.width > WIDEST_GIF:
        height = round(frame.height * WIDEST_GIF / frame.width)
        frame = frame.resize((WIDEST_GIF, height), Image.Resampling.LANCZOS)
    return frame


def _ffmpeg() -> Any:
    try:
        import imageio_ffmpeg
    except ImportError:
        words = "MP4 needs imageio-ffmpeg; allowed: pip install 'support-exudyn[movie]', or a GIF"
        raise InputError(words) from None
    return imageio_ffmpeg


def _mp4(path: Path, frames: Sequence[Path], rate: float, progress: Progress) -> None:
    """H.264 in colours that all players know."""
    with Image.open(frames[0]) as first:
        size = first.size
    writer = _ffmpeg().write_frames(
        str(path), size, fps=rate, codec="libx264", quality=QUALITY, macro_block_size=2,
        ffmpeg_log_level="error",
    )  # fmt: skip
    writer.send(None)
    try:
        for number, frame in enumerate(frames):
            with Image.open(frame) as opened:
                writer.send(np.ascontiguousarray(opened.convert("RGB")))
            progress((number + 1) / len(frames))
    finally:
        writer.close()
