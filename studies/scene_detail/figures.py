"""What elements change and cost, columns driven apart, and the plane beside space."""

import math
from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator

from studies.common import rise
from studies.common.panels import finish, grid, letters
from studies.common.words import text_table
from studies.scene_detail.measures import (
    FROM_REFERENCE,
    MM,
    SMALLEST,
    Change,
    MeasuredScene,
    change,
    times_as_long,
)
from studies.scene_detail.scenes import (
    FULLEST,
    PLAINEST,
    REAR,
    UNEQUAL_FULLEST,
    UNEQUAL_IDEAL,
)
from support_exudyn import Result, recommend
from support_exudyn.postprocessing.figures import style
from support_exudyn.postprocessing.page.pieces import Sheet
from support_exudyn.postprocessing.shown_numbers import rounded
from support_exudyn.simulation.evidence.table import EvidenceTable as Tried
from support_exudyn.simulation.recommend import QUESTIONS

BELOW = "below the error"
RELATIVE = {  # changes in per cent
    "mean_pin_force": "mean force [%]",
    "std_pin_force": "spread [%]",
    "largest_pin_force_in_stroke": "largest, stroke [%]",
    "largest_pin_force": "largest, whole run [%]",
    "std_angular_acceleration": "acceleration, spread [%]",
}
CANOPY = "canopy, largest [deg/s²]"
TIP, FARTHEST = "tip forward, mean [mm]", "tip, farthest [mm]"
# columns of the figure of changes: of `tables.changes`, with the smallest that is told apart from none
PANELS = {
    RELATIVE["mean_pin_force"]: ("mean force [%]", 1e-2),
    RELATIVE["std_pin_force"]: ("its spread [%]", 1e-1),
    RELATIVE["largest_pin_force"]: ("largest force [%]", 1e-2),
    FARTHEST: ("tip, farthest [mm]", 1e-3),
}
MORE, LESS, OPEN = style.CONTACT, style.WITH_CLEARANCE, "#777777"
PURPLE = "#CC79A7"
SIDES = {"left": style.WITH_CLEARANCE, "right": style.SMOOTH}
ROW_MM = 4.3  # height of an element's row


def figures(measured: Mapping[str, MeasuredScene]) -> dict[str, Figure]:
    """All figures, by file name."""
    return {
        "change_and_cost": change_figure(measured),
        "unequal_columns": unequal_figure({name: one.run for name, one in measured.items()}),
    }


# --- change and cost ---


def change_figure(measured: Mapping[str, MeasuredScene]) -> Figure:
    """A row for each element, named at its left; a panel for each number that it changes, and for its cost.

    An element that has another reference than the others of its group has a star.
    """
    groups = [of_group(measured, group) for group in ("added", "taken")]
    heights = [len(elements) for elements in groups]
    drawing = Figure(figsize=style.size(180, 30 + ROW_MM * sum(heights)))
    panels = drawing.subplots(2, len(PANELS) + 1, sharey="row", sharex="col", height_ratios=heights)
    for line, elements in zip(panels, groups, strict=True):
        for axes, (column, (_, smallest)) in zip(line, PANELS.items(), strict=False):
            for place, pair in enumerate(elements):
                _dot(axes, place, changes(*pair)[column], smallest)
        line[-1].plot(
            [times_as_long(*pair) for pair in elements], range(len(elements)), "s", color=style.IDEAL, ms=3.5
        )
        line[-1].axvline(1.0, color=style.IDEAL, lw=0.6)
        scenes = [one.scene for one, _ in elements]
        stars = ["" if scene.reference in (PLAINEST, FULLEST) else " *" for scene in scenes]
        labels = [f"{scene.element}{star}" for scene, star in zip(scenes, stars, strict=True)]
        line[0].set_yticks(range(len(elements)), labels)
        line[0].set_ylim(len(elements) - 0.4, -0.6)
    for axes, label in zip(panels[-1], (*(label for label, _ in PANELS.values()), "cost ratio"), strict=True):
        axes.set_xlabel(label, fontsize=8)
    for axes in panels.flat:
        axes.set_xscale("log")
        axes.tick_params(labelsize=7)
        axes.xaxis.set_major_locator(LogLocator(numticks=3))
        axes.minorticks_off()
    letters(list(panels.flat))
    kinds = ((MORE, MORE, "^", "more"), (LESS, LESS, "v", "less"), (OPEN, "white", "<", "no more than this"))
    signs = [Line2D([], [], color=edge, mfc=face, marker=mark, ls="", ms=4.5, label=label)
             for edge, face, mark, label in kinds]  # fmt: skip
    drawing.legend(handles=signs, loc="outside lower center", ncols=3, fontsize=8)
    return drawing


def of_group(measured: Mapping[str, MeasuredScene], group: str) -> list[tuple[MeasuredScene, MeasuredScene]]:
    """The scenes of a group that have a reference, each with its reference."""
    return [
        (one, measured[one.scene.reference])
        for one in measured.values()
        if one.scene.group == group and one.scene.reference
    ]


def _dot(axes: Axes, place: int, change: Change, smallest: float) -> None:
    """A change with its error; of a change below its error or this size a hollow sign."""
    size = abs(change.value)
    if change.below_error or size < smallest:
        axes.plot(max(change.error, smallest), place, "<", mfc="white", mec=OPEN, ms=4)
        return
    below = min(change.error, 0.9 * size)
    colour, marker = (MORE, "^") if change.value > 0.0 else (LESS, "v")
    axes.errorbar(size, place, xerr=[[below], [change.error]], fmt=marker, color=colour, ms=4, lw=0.8)


# --- columns driven apart ---


def unequal_figure(runs: Mapping[str, Result]) -> Figure:
    """Turns of the canopy, indentation, column forces and moment on the rear pin, with columns driven apart."""
    drawing, panels = grid(110, 2, 2, width_mm=180)
    turns, depths, forces, moments = panels.flat
    with_clearance, ideal = runs[UNEQUAL_FULLEST], runs[UNEQUAL_IDEAL]
    time = with_clearance.time
    of_forces = {f"front_column_{side}.force": (f"{side} column", colour) for side, colour in SIDES.items()}
    of_turns = {"canopy.roll": ("roll", style.THIRD), "canopy.yaw": ("yaw", PURPLE)}
    for axes, channels, scale in ((turns, of_turns, rise.DEGREES), (forces, of_forces, 1e-3)):
        for channel, (label, colour) in channels.items():
            axes.plot(time, scale * with_clearance[channel], color=colour, label=label)
            name = f"{label}, ideal pins"
            axes.plot(ideal.time, scale * ideal[channel], color=colour, ls=(0, (4, 2)), label=name)
    for side, colour in SIDES.items():
        depth = MM * with_clearance[f"pin.{REAR}.{side}_depth"]
        depths.plot(time, depth, color=colour, label=f"{side} edge")
    # with ideal pins rigid bodies do not determine it
    moment = np.hypot(with_clearance[f"pin.{REAR}.moment_x"], with_clearance[f"pin.{REAR}.moment_y"])
    moments.plot(time, 1e-3 * moment, color=style.IDEAL, label="moment across the pin")
    labels = (
        "turn of the canopy [deg]", "indentation [mm]", "column force [kN]", "moment on the\nrear pin [kN m]",
    )  # fmt: skip
    for axes, label in zip(panels.flat, labels, strict=True):
        axes.set(xlabel="time [s]", ylabel=label, xlim=(0.0, with_clearance.scenario.duration))
        axes.margins(y=0.12)
        axes.legend(fontsize=7)
    return finish(drawing, panels)


# --- plane and space ---


UNEQUAL_ROWS = {  # heading and scale
    "largest_roll": ("roll of the canopy, largest [deg]", 1.0),
    "largest_yaw": ("yaw of the canopy, largest [deg]", 1.0),
    "largest_front_column_force": ("front column force, largest of both [kN]", 1e-3),
    "left_front_column_force_at_the_end": ("left front column, at the end [kN]", 1e-3),
    "right_front_column_force_at_the_end": ("right front column, at the end [kN]", 1e-3),
    "largest_moment": ("moment on the rear pin, largest [kN m]", 1e-3),
    "mean_pin_force": ("rear pin force, mean in the stroke [kN]", 1e-3),
    "largest_pin_force": ("rear pin force, largest [kN]", 1e-3),
    "largest_left_depth": ("depth at the left edge, largest [mm]", 1e3),
    "largest_right_depth": ("depth at the right edge, largest [mm]", 1e3),
}


def changes(one: MeasuredScene, reference: MeasuredScene) -> dict[str, Change]:
    """What a scene changes against its reference, by heading: per cent, and millimetres of the tip."""
    here, there = one.numbers, reference.numbers
    made = {
        heading: change(here[name], there[name]).scaled(100.0 / there[name].value)
        for name, heading in RELATIVE.items()
    }
    made[CANOPY] = change(here["largest_canopy_acceleration"], there["largest_canopy_acceleration"])
    made[TIP] = change(here["mean_tip_x"], there["mean_tip_x"]).scaled(MM)
    made[FARTHEST] = Change(*here[FROM_REFERENCE][:2]).scaled(MM)
    return made


def shown(found: Change) -> str:
    """A change with its error, or that it is below it; no more digits than the error leaves, four at most."""
    if found.below_error:
        return f"{BELOW}, {found.error:.1g}"
    text = rounded(found.value, found.error)
    if found.error < 1e-3 * abs(found.value):
        text = f"{found.value:.{max(0, 3 - math.floor(math.log10(abs(found.value))))}f}"
    return f"+{text}" if found.value > 0.0 else text


def ratio(times: float) -> str:
    """A ratio of costs to two digits."""
    return f"{times:.0f}" if times >= 100.0 else f"{times:.2g}"


def change_table(measured: Mapping[str, MeasuredScene], group: str) -> Sheet:
    """What each element of a group changes, and how many times the reference's time the scene takes."""
    rows = []
    for one, reference in of_group(measured, group):
        cells = (shown(item) for item in changes(one, reference).values())
        rows.append((one.scene.element, one.scene.reference, *cells, ratio(times_as_long(one, reference))))
    header = ("element", "against", *RELATIVE.values(), CANOPY, TIP, FARTHEST, "times the time")
    return text_table(header, rows, left=2)


def unequal_table(measured: Mapping[str, MeasuredScene]) -> Sheet:
    """What the plane cannot show; a number is 0 but for rounding."""
    scenes = {name: one.numbers for name, one in measured.items() if one.scene.group == "unequal"}
    rows = []
    for key, (heading, scale) in UNEQUAL_ROWS.items():
        cells = []
        for number in (numbers.get(key) for numbers in scenes.values()):
            if number is None:
                cells.append("")
            elif abs(number.value) <= SMALLEST[number.unit]:
                cells.append("0")
            else:
                cells.append(rounded(scale * number.value, scale * number.error))
        rows.append((heading, *cells))
    return text_table(("quantity", *scenes), rows)


def advice_table(tried: Tried) -> Sheet:
    """Which scene for which question."""
    rows = []
    for question in QUESTIONS:
        advice = recommend(question, tried)
        used = max((item.difference + item.error) / item.allowed for item in advice.evidence)
        fullest = tried.fullest_of(QUESTIONS[question].family).name
        share = "0 %" if advice.scene == fullest else f"{100.0 * used:.2g} %"
        rows.append((question, advice.scene, f"{advice.seconds:.2g}", f"{advice.fullest_seconds:.2g}", share))
    header = ("question", "cheapest scene", "time [s]", "fullest [s]", "off, of what is allowed")
    return text_table(header, rows, left=2)


# --- for sentences ---


def _of_elements(measured: Mapping[str, MeasuredScene], group: str, heading: str) -> list[tuple[str, Change]]:
    """The elements of a group with the change of a number against the plainest or the fullest scene."""
    return [
        (one.scene.element[2:], changes(one, reference)[heading])
        for one, reference in of_group(measured, group)
        if one.scene.reference in (PLAINEST, FULLEST)
    ]


def strongest(measured: Mapping[str, MeasuredScene], group: str, heading: str, most: int = 3) -> list[str]:
    """The elements of a group that surely change a number most, each with its change, the strongest first."""
    sure = [one for one in _of_elements(measured, group, heading) if not one[1].below_error]
    sure.sort(key=lambda one: abs(one[1].value) - one[1].error, reverse=True)
    return [f"{element} ({shown(changed)})" for element, changed in sure[:most]]


def without_effect(measured: Mapping[str, MeasuredScene], group: str, heading: str, least: float) -> list[str]:
    """The elements of a group that surely change a number by less than this."""
    elements = _of_elements(measured, group, heading)
    return [element for element, changed in elements if abs(changed.value) + changed.error < least]
