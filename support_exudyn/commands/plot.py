"""`plot RUN... [CHANNEL...]`: figures of a run, or of several one upon another, as PNG and PDF."""

import math
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from cyclopts.validators import Number

from support_exudyn.commands.command_line import FIGURES, After, Json, Rate, Until, is_file, put, warn
from support_exudyn.commands.runs import by_name, files_and_channels, is_of_others
from support_exudyn.files.series.read import read_series
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

Share = Annotated[float, Parameter(validator=Number(gte=0.0, lte=1.0))]


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
    rate: Rate | None = None,
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
        rate: Rows per second [Hz] of files without times.
        out: Folder of the figures (RUN_figures next to the run), or file of the only figure (.png, .pdf, .svg).
    """
    from support_exudyn.postprocessing.figures import of_runs, style

    files, patterns = files_and_channels([run, *others])
    names, ends = by_name(files), (after, until)
    curves = {name: path for name, path in names.items() if is_of_others(path)}
    runs = {name: Result.load(path) for name, path in names.items() if name not in curves}
    if not runs:
        raise InputError(f"{run}: is no run; allowed: with a run before it, plot RUN {run}")
    asked = {"orbit": orbit, "poincare": poincare or section, "spectrum": spectrum, "stability": stability}
    kinds = [kind for kind, is_asked in asked.items() if is_asked]
    if difference and (len(runs) < 2 or curves):
        raise InputError(
            "--difference: needs a second run, and no curves of others; allowed: plot FIRST.h5 SECOND.h5"
        )
    if len(names) > 1 and (kinds or pin):
        raise InputError(
            "--orbit, --poincare, --spectrum, --stability, --section, --pin: are of one run, and "
            f"{len(names)} are given; allowed with several: channels"
        )
    left_out: dict[str, str] = {}
    with style.look():
        if len(names) > 1:
            series = {name: read_series(path, rate=rate) for name, path in curves.items()}
            for name, one in series.items():
                for note in one.notes:
                    warn(f"{name}: {note}")
            called = "_less_".join([*names][::-1]) if difference else "_and_".join([*runs, *curves])
            drawn = {of_runs.in_name(patterns): of_runs.of_several(runs, series, patterns, ends, difference)}
        else:
            (called,) = runs
            found = of_runs.of_run(
                runs[called], patterns, kinds, pin, ends, left_out,
                phase=phase, section=section or (), alone=is_file(out),
            )  # fmt: skip
            drawn = {what: style.named(drawing, called) for what, drawing in found}
        window = of_runs.window_in_name(*ends)
        drawings = {of_runs.joined(called, what, window): drawing for what, drawing in drawn.items()}
        folder = files[0].with_name(f"{files[0].stem}_figures")
        written = of_runs.save_figures(drawings, out, folder, is_file(out))
    for kind, reason in left_out.items():
        warn(f"{kind}: left out: {reason}")
    put(json, {"figures": written}, *(path for paths in written.values() for path in paths))
