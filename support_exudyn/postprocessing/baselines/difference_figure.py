"""A small figure of two curves and of their difference, with what is allowed of it."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from support_exudyn.postprocessing.baselines.changes import RunChange
from support_exudyn.postprocessing.baselines.closeness import Closeness
from support_exudyn.postprocessing.baselines.kept_run import KeptRun
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.figures.units import readable, readable_change

WIDTH_MM, HEIGHT_MM = 140.0, 95.0
SIDE = 10.0  # times what is allowed, or the largest difference, that is drawn of either side


def difference_figure(one: Closeness) -> Figure:
    """Both curves one upon the other, below them their difference within the band that is allowed."""
    seconds = readable("s", float(np.ptp(one.time)))
    known = np.concatenate([one.values, one.reference])
    size = float(np.nanmax(np.abs(known), initial=0.0)) if np.isfinite(known).any() else 0.0
    off = one.values - one.reference
    largest = float(np.nanmax(np.abs(off), initial=0.0)) if np.isfinite(off).any() else 0.0
    shown, apart = readable(one.unit, size), readable_change(one.unit, size, largest)
    word, dotted = "farthest", "the difference is farthest beyond it"
    if one.verdict == "not decided":
        word, dotted = "not decided", "the numerical error is largest"
    with style.look():
        drawing = style.begin(WIDTH_MM, HEIGHT_MM, f"{one.name}: {word} at {one.time[one.where]:.6g} s")
        above, below = drawing.subplots(2, 1, sharex=True)
        time = seconds.scale * one.time
        for values, name, (colour, dashes) in zip(
            (one.reference, one.values), ("reference", "result"), style.CURVES, strict=False
        ):
            above.plot(time, shown.scale * values, color=colour, ls=dashes, label=name)
        above.legend(fontsize=7)
        above.set_ylabel(f"[{shown.name}]")
        below.plot(time, apart.scale * off, color=style.IDEAL, lw=0.9)
        allowed = np.where(np.isfinite(one.allowed), one.allowed, np.nan)
        reach = np.minimum(apart.scale * allowed, SIDE * apart.scale * largest if largest else np.inf)
        below.fill_between(time, -reach, reach, color=style.THIRD, alpha=0.25, lw=0.0)
        below.axvline(time[one.where], color=style.CONTACT, lw=0.8, ls=":")
        below.set_ylabel(f"difference [{apart.name}]")
        below.set_xlabel(f"time [{seconds.name}]")
        style.caption(drawing, f"Shaded: allowed, {one.rule}. Dotted: where {dotted}.")
    return drawing


def save_figure(one: Closeness, folder: Path, name: str) -> Path | None:
    """Write the figure of a curve as PNG; nothing of a number, or of a single record."""
    if one.time.size < 2:
        return None
    with style.look():
        return style.save(difference_figure(one), folder, name, pdf=False)[0]


def changed_curve(old: KeptRun, new: KeptRun, changes: list[RunChange]) -> Closeness | None:
    """The curve that shows the worst of some changes: that of the channel itself, or of which a number is.

    None if there is none.
    """
    for change in changes:
        for name in (change.name, change.name.rpartition(".")[0]):
            if name not in old.curves or name not in new.curves or old.time.shape != new.time.shape:
                continue
            was, now = old.curves[name], new.curves[name]
            allowed = was.errors + now.errors
            excess = np.nan_to_num(np.abs(now.values - was.values) - allowed, nan=np.inf)
            where = int(excess.argmax())
            return Closeness(
                name, now.unit, new.time, now.values, was.values, allowed, "not within", where, "both errors"
            )
    return None
