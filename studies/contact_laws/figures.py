"""Pictures of what contact laws deliver and change."""

from collections.abc import Mapping, Sequence
from string import ascii_lowercase

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from studies.common.numbers import Found, Number, by_case
from studies.common.panels import error_bars, finish, fit_height, grid
from studies.common.rise import Watched, between
from studies.contact_laws.cases import ASKED, PIN, REST
from studies.contact_laws.catalogue import POWER_LAWS, title
from support_exudyn import Result
from support_exudyn.postprocessing.figures import style

Series = npt.NDArray[np.float64]


SHOWN = {  # laws that are named in the answer's figure: colour and dashes
    "exact": (style.WITH_CLEARANCE, "-"),
    "lankarani_nikravesh": (style.SMOOTH, "--"),
    "hunt_crossley": (style.THIRD, "-."),
    "flores": ("black", ":"),
}


def answer_figure(found: Found) -> Figure:
    """What laws deliver over what they are asked for: closed forms, and dots of free impacts."""
    drawing = Figure(figsize=style.size(110, 90))
    axes = drawing.subplots()
    fine = np.linspace(0.01, 1.0, 200)
    for name, law in POWER_LAWS.items():
        curve = [law(stiffness=1.0, restitution=float(e)).delivered_restitution for e in fine]
        if name not in SHOWN:
            axes.plot(fine, curve, color="#cccccc", lw=0.8, zorder=1.0)
            continue
        colour, dashes = SHOWN[name]
        axes.plot(fine, curve, color=colour, ls=dashes, lw=1.3, label=title(name))
        numbers = (found.get(("delivered_restitution", f"{name} e={e:g}")) for e in ASKED)
        delivered = [number.value if number else np.nan for number in numbers]
        axes.plot(ASKED, delivered, "o", ms=2.6, color=colour)
    axes.set(xlim=(0, 1), ylim=(0, 1), xlabel="restitution asked for [1]", ylabel="delivered [1]")
    axes.legend(fontsize=7)
    return drawing


def _plain_log(axes: Axes) -> None:
    """Ticks of a logarithmic force axis as plain numbers."""
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())


def loop_figure(results: Mapping[str, Result]) -> Figure:
    """Force over depth in a free impact, a panel for each law."""
    drawing, panels = grid(170, 4, 4)
    for axes, result in zip(panels.flat, results.values(), strict=True):
        depth, force = result[f"pin.{PIN}.depth"], result[f"pin.{PIN}.normal_force"]
        closed = depth > 0.0
        ends = np.concatenate([[0.0], depth[closed], [0.0]])
        axes.plot(1e3 * ends, 1e-3 * np.concatenate([[0.0], force[closed], [0.0]]), color=style.WITH_CLEARANCE)
        elastic = np.linspace(0.0, ends.max(), 60)
        law = result.scenario.clearance_pins[PIN].contact.normal
        held = [law.elastic_force(float(d)) if d > 0.0 else 0.0 for d in elastic]
        axes.plot(1e3 * elastic, 1e-3 * np.array(held), color="#999999", lw=0.8, ls=(0, (4, 2)))
        axes.set(xlim=(0, None), ylim=(0, None))
        axes.locator_params(nbins=3)
    for letter, axes, name in zip(ascii_lowercase, panels.flat, results, strict=False):
        axes.set_title(rf"$\bf{{{letter}}}$  {title(name)}", fontsize=7.5, loc="left")
    drawing.supxlabel("depth [mm]", fontsize=9)
    drawing.supylabel("normal force [kN]", fontsize=9)
    return drawing


def rise_figure(watched: Watched, numbers: Sequence[Number]) -> Figure:
    """Mean, spread, peak and energy lost of the motion, a row for each law."""
    cases = list(dict.fromkeys(n.case for n in numbers))
    found = by_case(numbers)
    moving = f"{watched.start:g} to {watched.end:g} s"
    shown = [
        ("mean_pin_force", 1e-3, f"mean force,\n{moving} [kN]"),
        ("std_pin_force", 1e-3, f"its std,\n{moving} [kN]"),
        ("largest_pin_force_any_step", 1e-3, "largest force,\nwhole run [kN]"),
        ("energy_dissipated", 1.0, "energy lost,\nwhole run [J]"),
    ]
    drawing, (panels,) = grid(35 + 5 * len(cases), 1, len(shown), 178, sharey=True)
    rows = np.arange(len(cases))
    for axes, (name, scale, label) in zip(panels, shown, strict=True):
        row = [found[name, case] for case in cases]
        look = {"fmt": "o", "ms": 3, "capsize": 2, "lw": 0.8}
        error_bars(axes, rows, row, scale, across=True, color=style.WITH_CLEARANCE, **look)
        values = np.array([scale * n.value for n in row])
        axes.set(xlabel=label)
        if values.max() > 4.0 * np.median(values) and values.min() > 0.0:
            axes.set_xscale("log")
            _plain_log(axes)
    panels[0].set_yticks(rows, [row_title(case) for case in cases], fontsize=7)
    panels[0].invert_yaxis()
    return finish(drawing, panels)


def permanent_figure(watched: Watched, results: Mapping[str, Result]) -> Figure:
    """The pin force from a settled start with clearance in all pins, by rest velocity."""
    drawing, panels = grid(125, 2, 1)
    colours = (style.SMOOTH, style.WITH_CLEARANCE, style.THIRD, style.IDEAL)
    end = max(run.time[-1] for run in results.values())
    part = watched.start, watched.start + 0.2 * (end - watched.start)
    for axes, span in zip(panels.flat, ((0.0, end), part), strict=True):
        for case, colour in zip(REST, colours, strict=True):
            run = results[case]
            axes.plot(run.time, 1e-3 * run[watched.force], color=colour, lw=0.9, label=case)
        axes.set(xlim=span, xlabel="time [s]", ylabel="pin force [kN]")
        fit_height(axes, (1e-3 * results[c][watched.force][between(results[c], *span)] for c in REST))
    return finish(drawing, panels, 1)


def row_title(case: str) -> str:
    """A case of a rise as it stands in tables and figures."""
    if case.startswith("friction "):
        return f"friction: {title(case.removeprefix('friction '))}"
    name, _, rest = case.partition(", ")
    return title(name) + (f", {rest}" if rest else "")
