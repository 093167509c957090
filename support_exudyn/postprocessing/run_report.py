"""A page on runs: what was run, the machine, numbers with errors, channels over time, a picture."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib.figure import Figure
from PIL import Image

from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing import joint_tables
from support_exudyn.postprocessing import summary as summary
from support_exudyn.postprocessing.figures import overlay, style
from support_exudyn.postprocessing.figures.linkage_drawing import machine_drawing
from support_exudyn.postprocessing.figures.selection import matching
from support_exudyn.postprocessing.page.live import LiveFigure, of_drawing
from support_exudyn.postprocessing.page.live_html import html
from support_exudyn.postprocessing.page.pieces import (
    Sheet,
    ShownFigure,
    ShownTable,
    image,
    templates,
)
from support_exudyn.postprocessing.shown_numbers import label, ranking, shown
from support_exudyn.simulation.estimate import Estimate
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError

TEMPLATE = "run_report.html.j2"
MOST_CHANNELS = 24  # panels
WHOLE = (0.0, math.inf)
DIGITS = 6  # of numbers whose error is smaller, or not known
STILL = (1280, 720)


@dataclass(frozen=True)
class RunReport:
    """What the page says.

    runs: their names. numbers: the first ones are those of the clearance pins. still: a picture, or None and
    `no_still`, why not. hardest: of each run with several clearance pins, how hard each is hit.
    """

    runs: tuple[str, ...]
    machines: tuple[ShownFigure, ...]
    over_time: ShownFigure
    hardest: tuple[str, ...]
    key: ShownTable
    numbers: ShownTable
    impacts: ShownTable
    pressed: ShownTable
    what: ShownTable
    still: ShownFigure | None
    no_still: str

    @property
    def title(self) -> str:
        """The title of the page."""
        return f"Run {self.runs[0]}" if len(self.runs) == 1 else f"Runs {', '.join(self.runs)}"


def run_report(runs: Mapping[str, Result], channels: Sequence[str] = ()) -> str:
    """The page of some runs as HTML that needs nothing from elsewhere.

    Arguments:
        runs: by the names that the page calls them; at least one.
        channels: names, or patterns of them as in a shell, that are drawn over time. Without: forces of the
            clearance pins (of all pins if there is none), spin of the bodies at them, and traced points.

    Raises InputError if a pattern matches no channel, or there is nothing to draw.
    """
    names = _asked(runs, channels) if channels else _default(runs)
    if not names or len(names) > MOST_CHANNELS:
        raise InputError(f"{len(names)} channels to draw over time; allowed: 1 to {MOST_CHANNELS}")
    drawing, live = _over_time(runs, names)
    pages = html({"channels": live})
    caption = (
        "Channels over time. Thinned to the least and the greatest record of short pieces: no peak is lost."
    )
    over_time = ShownFigure(_picture(drawing), caption, Markup(pages.places["channels"]), "channels")
    found_of = [summary.numbers(result, *WHOLE) for result in runs.values()]
    estimates = dict(zip(runs, shown([*runs.values()], found_of, *WHOLE), strict=True))
    key = _key_names(runs, estimates)
    every = list(dict.fromkeys(number for found in estimates.values() for number in found))
    still, no_still = _still(runs)
    report = RunReport(
        tuple(runs),
        _machines(runs),
        over_time,
        tuple(f"{name} {order}" for name, found in estimates.items() if (order := ranking(found))),
        ShownTable(_numbers("Numbers of the clearance pins and traced points", estimates, key), "key"),
        ShownTable(_numbers("All numbers", estimates, every), "numbers"),
        ShownTable(_impacts(runs), "impacts"),
        ShownTable(_pressed(runs), "pressed"),
        ShownTable(_what(runs), "what"),
        still,
        no_still,
    )
    return templates().get_template(TEMPLATE).render(report=report, scripts=Markup(pages.scripts))


# --- channels ---


def _asked(runs: Mapping[str, Result], patterns: Sequence[str]) -> list[str]:
    """The channels of any run that match, in the order of the patterns."""
    return matching(list(dict.fromkeys(name for result in runs.values() for name in result.channels)), patterns)


def _watched_pins(result: Result) -> list[str]:
    """The clearance pins of a run, or all pins."""
    return list(result.scenario.clearance_pins) or list(result.scenario.linkage.pins)


def _default(runs: Mapping[str, Result]) -> list[str]:
    """Forces of pins, spin of the bodies at them, and traced points, as far as they were recorded."""
    loose = list(dict.fromkeys(pin for result in runs.values() for pin in result.scenario.clearance_pins))
    found: dict[str, None] = {}
    for result in runs.values():
        linkage = result.scenario.linkage
        pins = [pin for pin in loose or linkage.pins if pin in linkage.pins]
        bodies = [
            place.first if place.second == GROUND else place.second
            for place in map(linkage.pins.get, pins)
            if place
        ]
        wanted = [(f"pin.{pin}", ".force") for pin in pins]
        wanted += [(body, ".angular_velocity") for body in bodies if loose]
        wanted += [(f"{point}.", axis) for point in linkage.points for axis in "xy"]
        for start, end in wanted:  # in space there are several of a name, left and right
            found |= dict.fromkeys(n for n in result.channels if n.startswith(start) and n.endswith(end))
    return list(found)


def _over_time(runs: Mapping[str, Result], names: Sequence[str]) -> tuple[Figure, LiveFigure]:
    """A panel a channel, a curve a run: drawn, and for the browser."""
    for name in names:
        if len(units := {run.unit(name) for run in runs.values() if name in run.channels}) > 1:
            raise InputError(
                f"{name}: is in {' and in '.join(sorted(units))}; allowed: runs that have one unit"
            )
    with style.look():
        drawing = overlay.draw(runs, overlay.of_runs(runs, names), ", ".join(runs))
        labels = {
            n: f"{name} [{axes.get_ylabel().partition('[')[2].rstrip(']')}]"
            for n, (name, axes) in enumerate(zip(names, drawing.axes, strict=True))
        }
        return drawing, of_drawing(drawing, labels)


def _picture(drawing: Figure) -> str:
    """A drawing as a data URI."""
    with tempfile.TemporaryDirectory() as folder, style.look():
        path = Path(folder) / "drawing.png"
        drawing.savefig(path)
        return image(path)


# --- machine and still ---


def _machines(runs: Mapping[str, Result]) -> tuple[ShownFigure, ...]:
    """A drawing for each machine, with the clearance pins of the first of its runs that has some."""
    groups: list[list[str]] = []
    for name, result in runs.items():
        same = (group for group in groups if runs[group[0]].scenario.machine == result.scenario.machine)
        group = next(same, [])
        if not group:
            groups.append(group)
        group.append(name)
    found = []
    for number, group in enumerate(groups, 1):
        shown = next((name for name in group if runs[name].scenario.clearance_pins), group[0])
        scenario = runs[shown].scenario
        pins = (
            f"clearance in {', '.join(scenario.clearance_pins)}"
            if scenario.clearance_pins
            else "all pins ideal"
        )
        caption = f"{type(scenario.machine).__name__} in the start posture of {shown}: {pins}."
        found.append(ShownFigure(_picture(machine_drawing(scenario)), caption, anchor=f"machine{number}"))
    return tuple(found)


def _still(runs: Mapping[str, Result]) -> tuple[ShownFigure | None, str]:
    """The first run with clearance, or the first, when the force in its pin is largest; or why it is not."""
    from support_exudyn.postprocessing.render import still  # it brings the engine

    name = next((name for name, one in runs.items() if one.scenario.clearance_pins), next(iter(runs)))
    result = runs[name]
    time, when = _telling_time(result)
    try:
        picture = still(result, time, size=STILL)
    except (InputError, RuntimeError) as error:
        return None, f"There is no rendered picture: {error}"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "still.png"
        Image.fromarray(picture).save(path)
        return ShownFigure(image(path), f"Run {name} {when}.", anchor="still"), ""


def _telling_time(result: Result) -> tuple[float, str]:
    """When the hardest hit pin has its largest force [s], and that in words; without forces the run's end."""
    forces = {pin: f"pin.{pin}.force" for pin in _watched_pins(result)}
    peaks = {pin: float(result[name].max()) for pin, name in forces.items() if name in result.channels}
    loose = {pin: force for pin, force in result.largest_force.items() if pin in result.scenario.clearance_pins}
    if not (peaks or loose):
        return float(result.time[-1]), f"at its end, {result.time[-1]:.6g} s"
    peaks = loose or peaks  # at any step, or at the records
    pin = max(peaks, key=lambda name: peaks[name])
    time = result.largest_force_time.get(pin)
    if time is None:
        if forces[pin] not in result.channels:
            return float(result.time[-1]), f"at its end, {result.time[-1]:.6g} s"
        time = float(result.time[int(np.argmax(result[forces[pin]]))])
    time = min(time, float(result.time[-1]))
    return time, f"when the force in {pin} is largest, at {time:.6g} s"


# --- tables ---


def _key_names(runs: Mapping[str, Result], estimates: Mapping[str, Mapping[str, Estimate]]) -> list[str]:
    """The numbers that are looked at first: forces of clearance pins (or of all), and traced points."""
    pins = list(dict.fromkeys(pin for result in runs.values() for pin in result.scenario.clearance_pins))
    pins = pins or list(dict.fromkeys(pin for result in runs.values() for pin in result.scenario.linkage.pins))
    points = [point for result in runs.values() for point in result.scenario.linkage.points]
    starts = tuple([f"pin.{pin}" for pin in pins] + [f"{point}." for point in points])
    every = list(dict.fromkeys(name for found in estimates.values() for name in found))
    return [name for name in every if name.startswith(starts) and ".onset_" not in name]


def _numbers(title: str, estimates: Mapping[str, Mapping[str, Estimate]], names: Iterable[str]) -> Sheet:
    """Numbers side by side, a column a run."""
    rows = []
    for name in names:
        found = [estimates[run].get(name) for run in estimates]
        rows.append((label(name), *summary.side_by_side(found)))
    known = any(math.isfinite(one.error) for found in estimates.values() for one in found.values())
    note = (
        "± estimated numerical error; where none is told, it is below the last digit."
        if known
        else "Numerical errors are not known: no accuracy was asked."
    )
    return Sheet(title, ("number", "unit", *estimates), tuple(rows), note, left=2, name="numbers")


def _impacts(runs: Mapping[str, Result]) -> Sheet:
    rows = [(run, *row) for run, result in runs.items() for row in summary.impacts(result)]
    header = ("run", "pin", "impact", "time", "lasts", "approach", "separation", "force at records")
    return Sheet("First impacts, and speeds of approach and separation", header, tuple(rows), left=3)


def _pressed(runs: Mapping[str, Result]) -> Sheet:
    """How hard the clearance pins are pressed at their largest force."""
    pins = [(run, one) for run, result in runs.items() for one in joint_tables.hardest_pressed(result)]
    title, header, rows = joint_tables.pressure_table(
        joint_tables.LARGEST.capitalize(), [one for _, one in pins]
    )
    note = " ".join(f"{run}, {one.warning}." for run, one in pins if one.warning)
    cells = tuple((run, *row) for (run, _), row in zip(pins, rows, strict=True))
    return Sheet(title, ("run", *(name.lstrip(">") for name in header)), cells, note, left=2)


def _what(runs: Mapping[str, Result]) -> Sheet:
    """What was run and how, side by side."""
    told = {
        run: {row[0]: row[1] for row in (*summary.what_was_run(result), *summary.how(result))}
        for run, result in runs.items()
    }
    names = dict.fromkeys(name for rows in told.values() for name in rows)
    rows = tuple((name, *(rows.get(name, "") for rows in told.values())) for name in names)
    return Sheet("What was run, and how", ("", *runs), rows, wide=True)
