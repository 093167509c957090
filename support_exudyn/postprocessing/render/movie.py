"""Movies made of frames: GIF by Pillow, MP4 by the ffmpeg that imageio-ffmpeg brings along."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from PIL.ImageColor import getrgb

from support_exudyn.formulations.progress import Progress
from support_exudyn.postprocessing.figures.style import CONTACT, FLIGHT
from support_exudyn.postprocessing.render.sheet import INK
from user_forces.values.value import InputError

KINDS = ("gif", "mp4", "none")
WIDEST_GIF = 960  # [pixels]; larger frames are shrunk
MOST_GIF_FRAMES = 2000  # it is made in memory
FASTEST_GIF = 50.0  # frames a second: players show shorter ones later
COLOURS = 256
SAMPLED = 5  # frames by which the colours of a GIF are chosen
ALWAYS = (CONTACT, FLIGHT, INK, "#ffffff")
QUALITY = 8.0  # of MP4, from 0 to 10
MISSING = "MP4 needs imageio-ffmpeg; allowed: pip install 'support-exudyn[movie]', or a GIF"


def check(kind: str, rate: float, frames: int) -> None:
    """Raise InputError if a movie of this kind cannot be made, before frames are."""
    if kind not in KINDS:
        raise InputError(f"movie = {kind!r}: allowed: {', '.join(KINDS)}")
    if kind == "gif" and rate > FASTEST_GIF:
        raise InputError(
            f"frames_per_second = {rate:g}: players show at most {FASTEST_GIF:g} of a GIF; allowed: as many, "
            "or an MP4"
        )
    if kind == "gif" and frames > MOST_GIF_FRAMES:
        raise InputError(f"{frames} frames are too many for a GIF; allowed: up to {MOST_GIF_FRAMES}, or an MP4")
    if kind == "mp4":
        _ffmpeg()


def write(kind: str, path: Path, frames: Sequence[Path], rate: float, progress: Progress) -> None:
    """Write a movie of a kind to a path; rate: frames a second."""
    {"gif": _gif, "mp4": _mp4}[kind](path, frames, rate, progress)


def durations(number: int, rate: float) -> list[int]:
    """Of the frames of a GIF [ms]: whole hundredths of a second, which add up to the movie's length."""
    ends = [round(100.0 * (n + 1) / rate) for n in range(number)]
    return [10 * (end - start) for start, end in zip([0, *ends], ends, strict=False)]


def _gif(path: Path, frames: Sequence[Path], rate: float, progress: Progress) -> None:
    """One palette for all, and no dots in between, so that what stands still costs nothing."""
    palette = _palette([frames[n] for n in np.unique(np.linspace(0, len(frames) - 1, SAMPLED).astype(int))])

    def reduced() -> Iterator[Image.Image]:
        for number, frame in enumerate(frames):
            yield _in_colours(_shrunk(frame), palette)
            progress((number + 1) / len(frames))

    images = reduced()
    first = next(images)
    with path.open("wb") as file:
        first.save(
            file,
            format="GIF",
            save_all=True,
            append_images=images,
            duration=durations(len(frames), rate),
            loop=0,
            optimize=False,
        )


def _palette(samples: Sequence[Path]) -> Image.Image:
    """The colours that some frames have most, and those that have a meaning."""
    pictures = [_shrunk(sample) for sample in samples]
    wall = Image.new("RGB", (pictures[0].width, pictures[0].height * len(pictures)))
    for n, picture in enumerate(pictures):
        wall.paste(picture, (0, n * picture.height))
    # one place stays free: what does not change from frame to frame is transparent
    most = wall.quantize(COLOURS - len(ALWAYS) - 1, method=Image.Quantize.MEDIANCUT)
    room = 3 * (COLOURS - len(ALWAYS) - 1)
    chosen = ((most.getpalette() or []) + room * [0])[:room]
    for colour in ALWAYS:
        chosen += list(getrgb(colour))
    palette = Image.new("P", (1, 1))
    palette.putpalette(chosen)
    return palette


def _in_colours(frame: Image.Image, palette: Image.Image) -> Image.Image:
    """A frame in the colours of a palette; those that have a meaning just as they are, which Pillow rounds."""
    reduced = frame.quantize(palette=palette, dither=Image.Dither.NONE)
    pixels, chosen = np.asarray(frame), np.asarray(reduced).copy()
    packed = pixels[:, :, 0].astype(np.int32) << 16 | pixels[:, :, 1].astype(np.int32) << 8 | pixels[:, :, 2]
    for place, colour in enumerate(ALWAYS, start=COLOURS - len(ALWAYS) - 1):
        red, green, blue = getrgb(colour)[:3]
        chosen[packed == (red << 16 | green << 8 | blue)] = place
    exact = Image.fromarray(chosen)
    exact.putpalette(reduced.getpalette() or [])
    return exact


def _shrunk(path: Path) -> Image.Image:
    """A frame, no wider than a GIF's."""
    with Image.open(path) as opened:
        frame = opened.convert("RGB")
    if frame.width <= WIDEST_GIF:
        return frame
    height = round(frame.height * WIDEST_GIF / frame.width)
    return frame.resize((WIDEST_GIF, height), Image.Resampling.LANCZOS)


def _ffmpeg() -> Any:
    try:
        import imageio_ffmpeg
    except ImportError:
        raise InputError(MISSING) from None
    return imageio_ffmpeg


def _mp4(path: Path, frames: Sequence[Path], rate: float, progress: Progress) -> None:
    """H.264 in colours that all players know."""
    with Image.open(frames[0]) as first:
        size = first.size
    writer = _ffmpeg().write_frames(
        str(path),
        size,
        fps=rate,
        codec="libx264",
        quality=QUALITY,
        macro_block_size=2,
        ffmpeg_log_level="error",
    )
    writer.send(None)
    try:
        for number, frame in enumerate(frames):
            with Image.open(frame) as opened:
                writer.send(np.ascontiguousarray(opened.convert("RGB")))
            progress((number + 1) / len(frames))
    finally:
        writer.close()
