"""Where in its stroke a loaded pin that slides would shake, and with which friction."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import SymLogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from support_exudyn.postprocessing.figures import style
from support_exudyn.scenario.pin_stability import NOT_TOLD, PinOutlook, pin_outlooks
from support_exudyn.scenario.scenario import Scenario
from user_forces.values.value import InputError

FRICTIONS = tuple(np.linspace(0.0, 0.5, 26).tolist())  # that are drawn
COLOURS = "RdBu_r"
LINEAR, LARGEST = 1.0, 1000.0  # [1/s] up to which the colours are linear, and to which they go
PAINLEVE = "Painlevé's threshold"
NOWHERE = "0.6"  # grey, where the journal has no equilibrium; white is a growth rate of 0


def stability_map(scenario: Scenario, pins: Sequence[str] = ()) -> Figure:
    """Growth rates over stroke and friction, a panel for each pin; by default for all whose stability is known.

    Raises InputError if the stability of none of the scenario's pins is known.
    """
    outlooks = pin_outlooks(scenario, pins=pins or None)
    if not outlooks:
        raise InputError(f"stability: {NOT_TOLD}")
    columns = min(3, len(outlooks))
    rows = math.ceil(len(outlooks) / columns)
    drawing = style.begin(max(60 * columns + 20, 100), 58 * rows + 22, "Do pins shake as they slide?")
    panels = drawing.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes, one in zip(panels.flat, outlooks, strict=False):
        colours = draw_map(axes, one)
        axes.set_title(f"{one.pin}, if it had play" if one.assumed else one.pin, fontsize=8)
    for axes in panels.flat[len(outlooks) :]:
        axes.set_visible(False)
    finish(drawing, list(panels.flat[: len(outlooks)]), colours, turns=bool(scenario.linkage.cranks))
    return drawing


def draw_map(axes: Axes, outlook: PinOutlook, frictions: Sequence[float] = FRICTIONS) -> ScalarMappable:
    """Draw the growth rate of a pin, the border beyond which it shakes, and Painleve's threshold."""
    found = outlook.over_friction(frictions)
    scale = np.degrees(1.0) if outlook.turns else 1e3
    order = np.argsort(outlook.travels, kind="stable")
    stroke = scale * outlook.travels[order]
    growth, margin, mobility = (values[:, order] for values in found)
    colours = axes.pcolormesh(
        stroke,
        frictions,
        np.clip(growth, -LARGEST, LARGEST),
        norm=SymLogNorm(LINEAR, vmin=-LARGEST, vmax=LARGEST, base=10),
        cmap=COLOURS,
        shading="nearest",
        rasterized=True,
    )
    for values, dashes in ((margin, "-"), (mobility, "--")):
        if np.nanmin(values) < 0.0 < np.nanmax(values):
            axes.contour(stroke, frictions, values, levels=[0.0], colors=["black"], linestyles=[dashes])
    axes.set_facecolor(NOWHERE)
    axes.grid(visible=False)
    return colours


def finish(drawing: Figure, panels: Sequence[Axes], colours: ScalarMappable, *, turns: bool = False) -> None:
    """Label the panels of maps, with one bar of colours and one legend."""
    place = panels[0].get_subplotspec()
    columns = place.get_gridspec().ncols if place is not None else 1
    for axes in panels[-columns:]:
        axes.set_xlabel("crank angle [deg]" if turns else "stroke [mm]")
        axes.tick_params(labelbottom=True)
    for axes in panels[::columns]:
        axes.set_ylabel("sliding friction [1]")
    bar = drawing.colorbar(colours, ax=list(panels), ticks=[-100, -10, -1, 0, 1, 10, 100, 1000], aspect=30)
    bar.set_label("growth rate [1/s]")
    (edge,) = panels[0].plot([], [], color="black", label="grows beyond")
    (threshold,) = panels[0].plot([], [], color="black", ls="--", label=PAINLEVE)
    nowhere = Patch(color=NOWHERE, label="nowhere at rest")
    drawing.legend(handles=[edge, threshold, nowhere], loc="outside lower center", ncols=3, fontsize=7)
