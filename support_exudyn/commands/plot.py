"""`plot RUN... [CHANNEL...]`: figures of a run, or of several one upon another, as PNG and PDF."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from support_exudyn.commands.command_line import (
    add_json,
    add_out,
    add_times,
    answer,
    folder,
    number,
    say,
    warn,
)
from support_exudyn.commands.runs import (
    file_name,
    files_of_curves,
    named_curves,
    named_runs,
    runs_and_channels,
    said_channels,
    said_window,
)
from support_exudyn.files.series.named_series import SeriesFile
from support_exudyn.files.series.read import read_series
from support_exudyn.postprocessing.figures.journal import chosen_pin, clearance_joints
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Draw = Callable[[], "Figure"]
KINDS = ("orbit", "poincare", "spectrum")  # of figures of a pin


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The run's file, what is drawn, and where to."""
    add = parser.add_argument
    add(
        "names",
        nargs="+",
        metavar="RUN|CHANNEL",
        help="files of runs, as Result.save writes them, then channels over time: names, or patterns as "
        "'pin.*.force'; several runs are drawn one upon another, and so are curves of others: CSV "
        "(time_s,tip.x_mm), ADAMS, MATLAB, Parquet, Exudyn",
    )
    add("--difference", action="store_true", help="of several runs: what differs from the first")
    add("--orbit", action="store_true", help="path of the journal of a clearance pin in its bore")
    add("--poincare", action="store_true", help="section once in every period of the drive, or by impacts")
    add("--spectrum", action="store_true", help="spectrum of the force in a pin")
    add("--stability", action="store_true", help="where pins shake as they slide, over stroke and friction")
    add(
        "--pin", metavar="NAME", help="pin of orbit, section, spectrum and stability (the first with clearance)"
    )
    add_times(parser, -math.inf, math.inf)
    add(
        "--phase",
        type=partial(number, low=0.0, high=1.0),
        default=0.0,
        metavar="SHARE",
        help="of the period at which a section looks, 0 to 1",
    )
    add("--section", nargs=2, default=(), metavar="CHANNEL", help="channels of a section once in every period")
    add_out(parser, "folder of the figures (RUN_figures beside the run)")
    add_json(parser)
    add("--show", action="store_true", help="open them in windows, too")


def run(given: argparse.Namespace) -> None:
    """Draw, write, and print the names of the files."""
    from support_exudyn.postprocessing.figures import style

    tables = files_of_curves(given.names)
    paths, given.channels = runs_and_channels([name for name in given.names if folder(name) not in tables])
    if not paths:
        raise InputError(
            f"{tables[0]}: is no run; allowed: a run beside which it is drawn, plot RUN {tables[0]}"
        )
    if given.difference and (len(paths) < 2 or tables):
        raise InputError(
            "--difference: needs a second run, and no curves of others; allowed: plot FIRST.h5 SECOND.h5 "
            "[CHANNEL...]"
        )
    runs = {name: Result.load(path) for name, path in named_runs(paths).items()}
    first = paths[0]
    out = given.out or first.with_name(f"{first.stem}_figures")
    curves = {name: read_series(path) for name, path in named_curves(tables, runs).items()}
    several = len(runs) + len(curves) > 1
    wanted, optional = (
        _of_several(runs, curves, given) if several else _of_one(*next(iter(runs.items())), given)
    )
    drawings, written = [], {}
    with style.look():
        for name, draw in wanted.items():
            try:
                drawings.append(draw())
            except InputError as error:
                if name not in optional:
                    raise
                warn(f"{name}: left out: {error}")
                continue
            written[name] = style.save(drawings[-1], out, name)
            for path in () if given.json else written[name]:
                say(str(path))
        if given.json:
            answer({"figures": written})
        if given.show:
            _show(drawings)


def _of_several(
    runs: Mapping[str, Result], curves: Mapping[str, SeriesFile], given: argparse.Namespace
) -> tuple[dict[str, Draw], set[str]]:
    """Channels of several runs and of others, one upon another or less those of the first."""
    from support_exudyn.postprocessing.figures.overlay import difference, overlay

    if given.pin is not None or given.section or given.stability or any(getattr(given, one) for one in KINDS):
        raise InputError(
            "--orbit, --poincare, --spectrum, --stability, --section, --pin: are of one run, and "
            f"{len(runs) + len(curves)} are given; allowed with several: channels"
        )
    first = next(iter(runs.values()))
    in_files = [name for name in first.channels if any(name in one.series for one in curves.values())]
    channels = given.channels or in_files or _told_first(first)
    names = [*runs, *curves]
    joined = ("_less_" if given.difference else "_and_").join(names[::-1] if given.difference else names)
    what = said_channels(given.channels) if given.channels else "overview"
    name = file_name(joined, what, said_window(given.after, given.until))
    ends = given.after, given.until
    if given.difference:
        return {name: lambda: difference(runs, channels, *ends)}, set()
    return {name: lambda: overlay(runs, channels, *ends, curves)}, set()


def _of_one(called: str, result: Result, given: argparse.Namespace) -> tuple[dict[str, Draw], set[str]]:
    """Figures of a run by names of files that tell run, channels and window, and which may be left out.

    Those of a pin that are not named one by one may be, where the run lacks what they need.
    """
    from support_exudyn.postprocessing.figures.channels import over_time
    from support_exudyn.postprocessing.figures.style import named

    window, phase = said_window(given.after, given.until), f"phase_{given.phase:g}" if given.phase else ""
    kinds = [one for one in KINDS if getattr(given, one) or (one == "poincare" and given.section)]
    found: dict[str, Draw] = {}
    if given.stability:
        found = _stability(result, given, bool(kinds))
    elif given.channels or not (kinds or given.pin):
        names, what = given.channels or _told_first(result), "overview"
        if given.channels:
            what = said_channels(given.channels)
        found[what] = lambda: over_time(result, names, given.after, given.until)
    if kinds:
        pin = chosen_pin(result, given.pin, with_clearance=True) if given.orbit else None
        if pin is None and (given.pin or given.spectrum):
            pin = chosen_pin(result, given.pin, with_clearance=False)
        found |= _of_pin(result, given, pin, kinds)
    optional: dict[str, Draw] = {}
    if given.stability or kinds:
        pass
    elif given.pin is not None:  # all that there is of a pin
        optional = _of_pin(result, given, chosen_pin(result, given.pin, with_clearance=False), KINDS)
    elif not given.channels and (loose := clearance_joints(result)):
        optional = _of_pin(result, given, loose[0], KINDS)

    def name(kind: str) -> str:
        return file_name(
            called, kind, *((*given.section, phase) if kind.startswith("poincare") else ()), window
        )

    def titled(draw: Draw) -> Draw:
        return lambda: named(draw(), called)

    every = {name(kind): titled(draw) for kind, draw in (found | optional).items()}
    return every, {name(kind) for kind in optional}


def _stability(result: Result, given: argparse.Namespace, more: bool) -> dict[str, Draw]:
    """The map of where its pins shake; it is told by the scenario, so that it goes with no other figure."""
    from support_exudyn.postprocessing.figures.stability_map import stability_map

    if more or given.channels:
        raise InputError("--stability: is drawn by itself; allowed: plot RUN --stability [--pin NAME]")
    pins = () if given.pin is None else (chosen_pin(result, given.pin, with_clearance=False),)
    return {"stability": lambda: stability_map(result.scenario, pins)}


def _told_first(result: Result) -> list[str]:
    """Channels that are looked at first: forces and motion."""
    with_clearance = clearance_joints(result)
    points = [f"{point}.{axis}" for point in result.scenario.linkage.points for axis in "xy"]
    names = [f"pin.{with_clearance[0]}.force", f"pin.{with_clearance[0]}.depth"] if with_clearance else []
    names += [
        f"guide.{name}.{what}"
        for name, guide in result.scenario.guides.items()
        if guide.contacts()
        for what in ("force", "gap_upper", "gap_lower")
    ]
    if not names:
        names = [f"pin.{pin}.force" for pin in result.scenario.linkage.pins]
    names += [*points, *(f"{actuator}.force" for actuator in result.scenario.linkage.actuators)]
    known = [name for name in names if name in result.channels]
    return known or [name for name in result.channels if name != "time"][:8]


def _of_pin(
    result: Result, given: argparse.Namespace, pin: str | None, kinds: Sequence[str]
) -> dict[str, Draw]:
    """Figures of these kinds, as far as the pin can have them."""
    from support_exudyn.postprocessing.figures.orbit import orbit
    from support_exudyn.postprocessing.figures.poincare import poincare
    from support_exudyn.postprocessing.figures.spectrum import force_spectrum

    ends = given.after, given.until
    pair = matching(result.channels, given.section)
    with_clearance = pin if pin in clearance_joints(result) else None
    found: dict[str, Draw] = {}
    if with_clearance is not None:
        found["orbit"] = lambda: orbit(result, with_clearance, *ends)
    if with_clearance is not None or given.poincare or pair:
        found["poincare"] = lambda: poincare(result, with_clearance, *ends, phase=given.phase, channels=pair)
    if pin is not None:
        found["spectrum"] = lambda: force_spectrum(result, pin, *ends)
    return {f"{kind}_{pin}" if pin else kind: draw for kind, draw in found.items() if kind in kinds}


def _show(drawings: list[Figure]) -> None:
    """Open windows and wait until they are closed; where there is no display, say so."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    if not _has_display():
        print("--show: there is no display here; the files have the figures", file=sys.stderr)
        return
    for drawing in drawings:
        window = plt.figure(figsize=drawing.get_size_inches())
        manager = window.canvas.manager
        if manager is None or mpl.get_backend().lower() == "agg":
            print(
                "--show: matplotlib has no way to open windows here; the files have the figures",
                file=sys.stderr,
            )
            plt.close(window)
            return
        manager.canvas.figure = drawing  # drawn outside of pyplot, and shown in a window of its own
        drawing.set_canvas(manager.canvas)
    plt.show(block=True)


def _has_display() -> bool:
    """Whether windows can be opened; yes where the system does not tell by its environment."""
    return sys.platform != "linux" or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
