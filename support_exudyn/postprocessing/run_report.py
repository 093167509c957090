"""A page on runs: what was run, the machine, numbers with errors, channels over time, a picture."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from PIL import Image

from support_exudyn.model.machine import Machine
from support_exudyn.postprocessing import summary
from support_exudyn.postprocessing.figures import overlay, style
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.postprocessing.figures.of_runs import usual
from support_exudyn.postprocessing.figures.selection import machine_name, matching
from support_exudyn.postprocessing.joint_tables import hardest_pressed, pressure_table
from support_exudyn.postprocessing.page.live import LiveFigure, html, of_drawing
from support_exudyn.postprocessing.page.pieces import Sheet, ShownFigure, ShownTable, image, templates
from support_exudyn.postprocessing.result_table import ResultTable
from support_exudyn.postprocessing.shown_numbers import label
from support_exudyn.postprocessing.side_by_side import RunsSideBySide
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

TEMPLATE = "run_report.html.j2"
MOST_CHANNELS = 24  # panels
STILL = (1280, 720)
OVER_TIME = "Channels over time. Thinned to the least and the greatest record of short pieces: no peak is lost."


def run_report(runs: Mapping[str, Result], channels: Sequence[str] = ()) -> str:
    """The page of some runs as HTML that needs nothing from elsewhere.

    Arguments:
        runs: by the names that the page calls them; at least one.
        channels: names, or patterns of them as in a shell, that are drawn over time; the usual ones by default.

    Raises InputError if a pattern matches no channel, or there is nothing to draw.
    """
    every = list(dict.fromkeys(name for result in runs.values() for name in result.channels))
    usual_ones = dict.fromkeys(name for result in runs.values() for name in usual(result))
    names = matching(every, channels) if channels else list(usual_ones)[:MOST_CHANNELS]
    if not names or len(names) > MOST_CHANNELS:
        raise InputError(f"{len(names)} channels to draw over time; allowed: 1 to {MOST_CHANNELS}")
    drawing, live = _over_time(runs, names)
    pages, both = html({"channels": live}), RunsSideBySide(runs)
    still, no_still = _still(runs)
    pressed = {
        run: pressure_table("Pins under their largest force", hardest_pressed(runs[run])) for run in runs
    }
    context = {
        "title": f"Run {next(iter(runs))}" if len(runs) == 1 else f"Runs {', '.join(runs)}",
        "machines": _machines(runs),
        "over_time": ShownFigure(_picture(drawing), OVER_TIME, Markup(pages.places["channels"]), "channels"),
        "key": ShownTable(
            _numbers("Numbers of the clearance pins and traced points", both, _of_pins(runs)), "key"
        ),
        "numbers": ShownTable(_numbers("All numbers", both), "numbers"),
        "impacts": ShownTable(
            _of_runs({run: summary.impacts_table("First impacts", result) for run, result in runs.items()}),
            "impacts",
        ),
        "pressed": ShownTable(_of_runs(pressed), "pressed"),
        "what": ShownTable(_what(runs), "what"),
        "still": still,
        "no_still": no_still,
        "scripts": Markup(pages.scripts),
    }
    return templates().get_template(TEMPLATE).render(context)


# --- channels ---


def _over_time(runs: Mapping[str, Result], names: Sequence[str]) -> tuple[Figure, LiveFigure]:
    """A panel a channel, a curve a run: drawn, and for the browser."""
    overlay.check_units(runs, names)
    with style.look():
        drawing = overlay.draw(runs, overlay.of_runs(runs, names), ", ".join(runs))
        units = [axes.get_ylabel().partition("[")[2] for axes in drawing.axes]
        labels = {n: f"{name} [{unit}" for n, (name, unit) in enumerate(zip(names, units, strict=True))}
        return drawing, of_drawing(drawing, labels)


def _picture(drawing: Figure | Image.Image) -> str:
    """A drawing as a data URI."""
    with tempfile.TemporaryDirectory() as folder, style.look():
        path = Path(folder) / "drawing.png"
        (drawing.savefig if isinstance(drawing, Figure) else drawing.save)(path)
        return image(path)


# --- machine and still ---


def _machines(runs: Mapping[str, Result]) -> list[ShownFigure]:
    """A drawing for each machine, with the clearance pins of the first of its runs that has some."""
    found: list[ShownFigure] = []
    drawn: list[Machine] = []
    for name, result in sorted(runs.items(), key=lambda item: not item[1].scenario.clearance_pins):
        scenario = result.scenario
        if scenario.machine not in drawn:
            drawn.append(scenario.machine)
            loose = ", ".join(scenario.clearance_pins)
            pins = f"clearance in {loose}" if loose else "all pins ideal"
            caption = f"{machine_name(scenario).capitalize()} in the start posture of {name}: {pins}."
            picture = _picture(machine_drawing(scenario))
            found.append(ShownFigure(picture, caption, anchor=f"machine{len(drawn)}"))
    return found


def _still(runs: Mapping[str, Result]) -> tuple[ShownFigure | None, str]:
    """The first run with clearance, or the first, when the force in its pin is largest; or why it is not."""
    from support_exudyn.postprocessing.render import still  # it brings the engine

    name = next((name for name, run in runs.items() if run.scenario.clearance_pins), next(iter(runs)))
    time, when = _telling_time(runs[name])
    try:
        picture = still(runs[name], time, size=STILL)
    except (InputError, RuntimeError) as error:
        return None, f"There is no rendered picture: {error}"
    caption = f"Run {name} {when}, at {time:.6g} s."
    return ShownFigure(_picture(Image.fromarray(picture)), caption, anchor="still"), ""


def _telling_time(result: Result) -> tuple[float, str]:
    """When the pin with the largest force has it [s], and that in words; without forces the run's end.

    At any step of the clearance pins, else at the records of all pins.
    """
    pins = result.scenario.clearance_pins
    if loose := {pin: time for pin, time in result.largest_force_time.items() if pin in pins}:
        pin = max(loose, key=lambda name: result.largest_force[name])
        return min(loose[pin], float(result.time[-1])), f"when the force in {pin} is largest"
    every = [pin for pin in pins or result.scenario.linkage.pins if f"pin.{pin}.force" in result.channels]
    forces = {pin: result[f"pin.{pin}.force"] for pin in every}
    if not forces:
        return float(result.time[-1]), "at its end"
    pin = max(forces, key=lambda name: float(forces[name].max()))
    return float(result.time[int(np.argmax(forces[pin]))]), f"when the force in {pin} is largest"


# --- tables ---


def _of_pins(runs: Mapping[str, Result]) -> tuple[str, ...]:
    """What the numbers of clearance pins (or of all pins) and traced points begin with."""
    scenarios = [result.scenario for result in runs.values()]
    pins = {pin for one in scenarios for pin in one.clearance_pins}
    pins = pins or {pin for one in scenarios for pin in one.linkage.pins}
    return (
        *(f"pin.{pin}" for pin in pins),
        *(f"{point}." for one in scenarios for point in one.linkage.points),
    )


def _numbers(title: str, both: RunsSideBySide, starts: tuple[str, ...] = ()) -> Sheet:
    """Numbers side by side, a column a run; starts: only those that begin so, and not those of onsets."""
    rows = [
        (label(name), *cells)
        for name, *cells in both.rows()
        if not starts or (name.startswith(starts) and ".onset_" not in name)
    ]
    known = any(math.isfinite(one.error) for found in both.printed for one in found.values())
    note = (
        "± estimated numerical error; without one it is below the last digit."
        if known
        else "Numerical errors are not known: no accuracy was asked."
    )
    return Sheet(title, ("number", "unit", *both.runs), tuple(rows), note, left=2, name="numbers")


def _of_runs(tables: Mapping[str, ResultTable]) -> Sheet:
    """A table of several runs, with the name of the run in the first column."""
    title, header, _, _ = next(iter(tables.values()))
    rows = tuple((run, *row) for run, table in tables.items() for row in table.rows)
    note = " ".join(f"{run}, {line}." for run, table in tables.items() for line in table.note.splitlines())
    left = 1 + next(n for n, head in enumerate(header) if head.startswith(">"))
    return Sheet(title, ("run", *(head.lstrip(">") for head in header)), rows, note, left=left)


def _what(runs: Mapping[str, Result]) -> Sheet:
    """What was run and how, side by side."""
    words = {
        run: {row[0]: row[1] for row in (*summary.what_is_run(one.scenario), *summary.how(one))}
        for run, one in runs.items()
    }
    names = dict.fromkeys(name for rows in words.values() for name in rows)
    rows = tuple((name, *(rows.get(name, "") for rows in words.values())) for name in names)
    return Sheet("What was run, and how", ("", *runs), rows, wide=True)
