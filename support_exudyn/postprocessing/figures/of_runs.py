"""The figures that are drawn of runs: which channels, which kinds, by which names, into which files."""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.whole_file import whole_file
from support_exudyn.postprocessing.figures import channels, orbit, overlay, spectrum, stability_map, style
from support_exudyn.postprocessing.figures.journal import chosen_pin, clearance_joints
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

FIRST = 8  # channels of a run without forces
NO_NAME = re.compile(r"[^\w.-]+")  # what is left out of a file's name
LONGEST = 80  # letters of the channels in a file's name


def of_run(
    result: Result,
    patterns: Sequence[str],
    kinds: Sequence[str],
    pin: str | None,
    ends: tuple[float, float],
    left_out: dict[str, str],
    *,
    alone: bool = False,
) -> Iterator[tuple[str, Figure]]:
    """Each figure of a run with what it shows, as a part of its file's name.

    Arguments:
        result: the run.
        patterns: channels over time, or patterns of them; without them and without kinds or a pin an overview.
        kinds: of figures of a pin: "orbit", "spectrum", "stability"; without, all that can be drawn
            of the pin, unless there are patterns, or `alone` asks for a single figure.
        pin: its name; None: the first with clearance.
        ends: times [s].
        left_out: gets the kinds that were not asked for and cannot be drawn, and why.

    Raises InputError for a kind that was asked for and cannot be drawn.
    """
    if patterns or not (kinds or pin):
        yield in_name(patterns), channels.over_time(result, patterns or usual(result), *ends)
    if kinds:
        yield from (_of_pin(kind, result, pin, ends) for kind in kinds)
    elif clearance_joints(result) and (pin or not (patterns or alone)):
        for kind in ("orbit", "spectrum"):
            try:
                yield _of_pin(kind, result, pin, ends)
            except InputError as error:  # noqa: PERF203
                left_out[kind] = str(error)


def _of_pin(kind: str, result: Result, pin: str | None, ends: tuple[float, float]) -> tuple[str, Figure]:
    if kind == "stability":
        pins = () if pin is None else (chosen_pin(result, pin, with_clearance=False),)
        return kind, stability_map.stability_map(result.scenario, pins)
    pin = chosen_pin(result, pin, with_clearance=kind == "orbit")
    draw = orbit.orbit if kind == "orbit" else spectrum.force_spectrum
    return f"{kind}_{pin}", draw(result, pin, *ends)


def of_several(
    runs: Mapping[str, Result],
    series: Mapping[str, SeriesFile],
    patterns: Sequence[str],
    ends: tuple[float, float],
    difference: bool,
) -> Figure:
    """Channels of runs, and series of others, one upon another; difference: less those of the first run.

    Without patterns the channels that a series has, or the usual ones. ends: times [s].
    """
    first = next(iter(runs.values()))
    in_files = [name for name in first.channels if any(name in one.series for one in series.values())]
    chosen = patterns or in_files or usual(first)
    if difference:
        return overlay.difference(runs, chosen, *ends)
    return overlay.overlay(runs, chosen, *ends, series)


def usual(result: Result) -> list[str]:
    """Channels that are drawn unless some are named: forces and motion."""
    scenario, joints = result.scenario, clearance_joints(result)
    names = [f"pin.{joint}.force" for joint in joints] + [f"pin.{joint}.depth" for joint in joints[:1]]
    guides = [name for name, guide in scenario.guides.items() if guide.contacts()]
    names += [f"guide.{name}.{what}" for name in guides for what in ("force", "gap_upper", "gap_lower")]
    names = names or [f"pin.{pin}.force" for pin in scenario.linkage.pins]
    names += [f"{point}.{axis}" for point in scenario.linkage.points for axis in "xy"]
    names += [f"{actuator}.force" for actuator in scenario.linkage.actuators]
    known = [name for name in names if name in result.channels]
    return known or [name for name in result.channels if name != "time"][:FIRST]


# --- files ---


def save_figures(
    drawings: Mapping[str, Figure], out: Path | None, folder: Path, is_file: bool
) -> dict[str, list[Path]]:
    """Write figures by name as PNG and PDF into a folder, or the only figure into its file.

    Arguments:
        drawings: the figures by name.
        out: what was asked for, a folder or a file; None: folder.
        folder: where they lie by default.
        is_file: whether `out` is a file.

    Returns the files by the names of the figures. Raises InputError for several figures and a file.
    """
    if out is None or not is_file:
        return {name: style.save(drawing, out or folder, name) for name, drawing in drawings.items()}
    if len(drawings) > 1:
        raise InputError(f"--out {out}: is a figure, and {len(drawings)} are drawn; allowed: a folder")
    for drawing in drawings.values():
        with whole_file(out) as temporary:
            drawing.savefig(temporary, format=out.suffix[1:].lower())
    return {name: [out] for name in drawings}


def joined(*parts: str) -> str:
    """The name of a figure's file: what it shows, without characters that file systems refuse."""
    return "_".join(filter(None, (NO_NAME.sub("_", part).strip("_.") for part in parts)))


def in_name(patterns: Sequence[str]) -> str:
    """Channels as a part of a file's name, patterns without their stars; "overview" if there are none."""
    if not patterns:
        return "overview"
    words = [pattern.replace("*", "").replace("?", "").replace("..", ".").strip(".") for pattern in patterns]
    text = "_".join(filter(None, words)) or "channels"
    return text if len(text) <= LONGEST else f"{text[:LONGEST].rstrip('_.')}_and_others"


def window_in_name(after: float, until: float) -> str:
    """A window [s] as a part of a file's name; empty for the whole run."""
    if after > 0.0:
        return f"{after:g}_to_{until:g}_s" if until < math.inf else f"after_{after:g}_s"
    return f"until_{until:g}_s" if until < math.inf else ""
