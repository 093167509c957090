"""`plot RUN... [CHANNEL...]`: figures of a run, or of several one upon another, as PNG and PDF."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

from cyclopts import Parameter
from cyclopts.validators import Number

from support_exudyn.commands.command_line import After, Json, Until, put, warn
from support_exudyn.commands.runs import (
    FIGURES,
    by_name,
    files_and_channels,
    in_name,
    is_figure,
    is_of_others,
    joined,
    save_figures,
    window_in_name,
)
from support_exudyn.files.series.read import read_series
from support_exudyn.postprocessing.figures.journal import chosen_pin, clearance_joints
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIRST = 8  # channels of a run without forces
Share = Annotated[float, Parameter(validator=Number(gte=0.0, lte=1.0))]


class DrawnPin(NamedTuple):
    """Kinds of figures of a pin, its name (None: the first), times [s], phase and channels of a section."""

    kinds: list[str]
    pin: str | None
    ends: tuple[float, float]
    phase: float
    section: tuple[str, ...]


def plot(
    run: str,
    /,
    *others: str,
    difference: bool = False,
    orbit: bool = False,
    poincare: bool = False,
    spectrum: bool = False,
    stability: bool = False,
    pin: str | None = None,
    after: After = -math.inf,
    until: Until = math.inf,
    phase: Share = 0.0,
    section: tuple[str, str] | None = None,
    out: Annotated[Path | None, FIGURES] = None,
    json: Json = False,
) -> None:
    """Draw, write, and print the names of the files.

    Args:
        run: File of a run.
        others: More files, drawn one upon another: runs, CSV (time_s,tip.x_mm), ADAMS, MATLAB, Parquet, Exudyn.
            Then channels over time: names, or patterns as `pin.*.force`.
        difference: Draw of several runs what differs from the first.
        orbit: Draw the path of the journal of a clearance pin in its bore.
        poincare: Draw a section once in every period of the drive, or by impacts.
        spectrum: Draw the spectrum of the force in a pin.
        stability: Draw where friction makes pins vibrate as they slide, over stroke and friction.
        pin: Pin of orbit, section, spectrum and stability (the first with clearance).
        phase: Share of the period, 0 to 1, at which a section is taken (0).
        section: Two channels of a section once in every period.
        out: Folder of the figures (RUN_figures next to the run), or file of the only figure (.png, .pdf, .svg).
    """
    from support_exudyn.postprocessing.figures import style

    files, patterns = files_and_channels([run, *others])
    names = by_name(files)
    curves = {name: path for name, path in names.items() if is_of_others(path)}
    runs = {name: Result.load(path) for name, path in names.items() if name not in curves}
    if not runs:
        raise InputError(f"{run}: is no run; allowed: with a run before it, plot RUN {run}")
    asked = {"orbit": orbit, "poincare": poincare or section, "spectrum": spectrum, "stability": stability}
    kinds = [kind for kind, is_asked in asked.items() if is_asked]
    view = DrawnPin(kinds, pin, (after, until), phase, section or ())
    if difference and (len(runs) < 2 or curves):
        raise InputError(
            "--difference: needs a second run, and no curves of others; allowed: plot FIRST.h5 SECOND.h5"
        )
    if len(names) > 1 and (kinds or pin):
        raise InputError(
            "--orbit, --poincare, --spectrum, --stability, --section, --pin: are of one run, and "
            f"{len(names)} are given; allowed with several: channels"
        )
    with style.look():
        if len(names) > 1:
            several = [*runs, *curves]
            called = "_less_".join(several[::-1]) if difference else "_and_".join(several)
            drawn = {in_name(patterns): _of_several(runs, curves, patterns, view.ends, difference)}
        else:
            (called,) = runs
            found = _of_one(runs[called], patterns, view, alone=is_figure(out))
            drawn = {what: style.named(drawing, called) for what, drawing in found}
        window = window_in_name(after, until)
        drawings = {joined(called, what, window): drawing for what, drawing in drawn.items()}
        written = save_figures(drawings, out, files[0].with_name(f"{files[0].stem}_figures"))
    put(json, {"figures": written}, *(path for paths in written.values() for path in paths))


def _of_several(
    runs: Mapping[str, Result],
    curves: Mapping[str, Path],
    patterns: Sequence[str],
    ends: tuple[float, float],
    difference: bool,
) -> Figure:
    """Channels of several files one upon another, or less those of the first."""
    from support_exudyn.postprocessing.figures import overlay

    series = {name: read_series(path) for name, path in curves.items()}
    first = next(iter(runs.values()))
    in_files = [name for name in first.channels if any(name in one.series for one in series.values())]
    chosen = patterns or in_files or _usual(first)
    if difference:
        return overlay.difference(runs, chosen, *ends)
    return overlay.overlay(runs, chosen, *ends, series)


def _of_one(
    result: Result, patterns: Sequence[str], view: DrawnPin, alone: bool
) -> Iterator[tuple[str, Figure]]:
    """Figures of a run and what they show: channels over time, and the kinds of figures of a pin.

    If nothing is asked for, an overview, and unless that is to stand alone all that can be drawn of the pin.
    """
    from support_exudyn.postprocessing.figures import channels

    if patterns or not (view.kinds or view.pin):
        yield in_name(patterns), channels.over_time(result, patterns or _usual(result), *view.ends)
    all_of_pin = not view.kinds and bool(view.pin or not (patterns or alone))
    is_optional = all_of_pin and bool(clearance_joints(result))
    for kind in ("orbit", "poincare", "spectrum") if is_optional else view.kinds:
        try:
            drawn = _of_pin(kind, result, view)
        except InputError as error:  # noqa: PERF203
            if not is_optional:
                raise
            warn(f"{kind}: left out: {error}")
        else:
            yield drawn


def _of_pin(kind: str, result: Result, view: DrawnPin) -> tuple[str, Figure]:
    """A figure of a pin, and what it shows as a part of its file's name."""
    from support_exudyn.postprocessing.figures import orbit, poincare, spectrum, stability_map

    if kind == "poincare":
        pin = next((joint for joint in clearance_joints(result) if view.pin in (None, joint)), None)
        pair = matching(result.channels, view.section)
        drawing = poincare.poincare(result, pin, *view.ends, phase=view.phase, channels=pair)
        phase = f"phase_{view.phase:g}" if view.phase else ""
        return joined(kind, pin or "", *view.section, phase), drawing
    if kind == "stability":
        pins = () if view.pin is None else (chosen_pin(result, view.pin, with_clearance=False),)
        return kind, stability_map.stability_map(result.scenario, pins)
    pin = chosen_pin(result, view.pin, with_clearance=kind == "orbit")
    draw = orbit.orbit if kind == "orbit" else spectrum.force_spectrum
    return f"{kind}_{pin}", draw(result, pin, *view.ends)


def _usual(result: Result) -> list[str]:
    """Channels that are drawn unless some are named: forces and motion."""
    scenario, joints = result.scenario, clearance_joints(result)
    names = [f"pin.{joints[0]}.{what}" for what in ("force", "depth")] if joints else []
    names += [
        f"guide.{name}.{what}"
        for name, guide in scenario.guides.items()
        if guide.contacts()
        for what in ("force", "gap_upper", "gap_lower")
    ]
    names = names or [f"pin.{pin}.force" for pin in scenario.linkage.pins]
    names += [f"{point}.{axis}" for point in scenario.linkage.points for axis in "xy"]
    names += [f"{actuator}.force" for actuator in scenario.linkage.actuators]
    known = [name for name in names if name in result.channels]
    return known or [name for name in result.channels if name != "time"][:FIRST]
