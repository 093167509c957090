"""The work-precision figure of the contest: errors over processor time, a line a program."""

import math
from collections.abc import Callable, Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from studies.benchmarking.contest import ENTRANTS, OURS, Standing
from studies.common.panels import letters
from support_exudyn.postprocessing.figures import style

# by entrant: colour and marker; ours are blue and thick
LOOKS: Mapping[str, tuple[str, str]] = {
    f"{OURS}compiled": ("#0072B2", "o"),
    f"{OURS}exudyn": ("#56B4E9", "s"),
    "scipy's LSODA": ("#009E73", "v"),
    "MuJoCo, law in a callback": ("#D55E00", "P"),
    "MuJoCo, limit of a tendon": ("#E69F00", "X"),
    "Drake, force in a system": ("#882255", "^"),
    "Exudyn, hollow spheres, DOPRI5": ("#000000", "*"),
    "Exudyn, hollow spheres": ("#666666", "<"),
    "Exudyn, Python function": ("#AAAAAA", ">"),
}
PANELS: Mapping[str, Callable[[Standing], float]] = {
    "error of the slider's place [m]": lambda one: one.slider,
    "error of the first five impact times [s]": lambda one: one.times,
}
DIGITS = 5e-10  # half the last digit of the known impact times [s]


def figure(found: Sequence[Standing]) -> Figure:
    """Errors of all programs over their processor time."""
    drawing = Figure(figsize=style.size(180, 120))
    panels = list(drawing.subplots(1, 2, sharex=True))
    for axes, (label, error) in zip(panels, PANELS.items(), strict=True):
        for name in ENTRANTS:
            _line(axes, name, [one for one in found if one.program == name], error)
        axes.set(xscale="log", yscale="log", xlabel="processor time [s]", ylabel=label)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(LogLocator(numticks=12))
            axis.set_minor_formatter(NullFormatter())
    panels[1].axhline(DIGITS, color=style.IDEAL, lw=0.8, ls=":", label="digits of the known times")
    letters(panels)
    handles, labels = panels[1].get_legend_handles_labels()
    drawing.legend(handles, labels, loc="outside lower center", ncols=3, fontsize=8)
    return drawing


def _line(axes: Axes, name: str, found: Sequence[Standing], error: Callable[[Standing], float]) -> None:
    points = [(one.seconds, error(one)) for one in found if math.isfinite(error(one)) and error(one) > 0.0]
    if not found:
        return
    x, y = zip(*points, strict=True) if points else ((), ())
    colour, marker = LOOKS[name]
    is_ours = name.startswith(OURS)
    axes.plot(x, y, color=colour, marker=marker, ms=5.0, lw=2.0 if is_ours else 1.0, label=name)
