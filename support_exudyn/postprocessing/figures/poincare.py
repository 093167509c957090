"""Poincare view: a run seen once in a period, or at every impact."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from support_exudyn.model.drives.drive import Held, Reciprocating, Steady
from support_exudyn.model.linkage import GROUND
from support_exudyn.postprocessing.figures import style, units
from support_exudyn.postprocessing.figures.journal import JournalPath, Mask, Series, clearance_joints, journal
from support_exudyn.postprocessing.figures.orbit import bore_axes
from support_exudyn.postprocessing.figures.selection import CLEARANCE, as_words, inside, spacing, window_text
from support_exudyn.postprocessing.figures.style import caption
from support_exudyn.postprocessing.figures.units import DEGREES, readable
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.simulation.result import Result
from user_forces.values.value import InputError, short

FEWEST_PERIODS = 3  # points that a section by periods is made of at least
FEWEST_IMPACTS = 2  # for a return map
DOT: dict[str, Any] = {"marker": "o", "ms": 3.0, "mew": 0.0, "ls": "none", "zorder": 3}
CONTACT_MARK = {**DOT, "color": style.CONTACT}
FLIGHT_MARK = {**DOT, "color": style.FLIGHT, "marker": "^", "ms": 4.0}
PLAIN_MARK = {**DOT, "color": style.IDEAL}
BELOW: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.19), "fontsize": 7}  # a legend
SAME = 1e-4  # share of the size of a channel; points closer than that are shown as the same


def period(scenario: Scenario) -> float | None:
    """Period of the drives [s]; None if they have none in common.

    A crank that turns steadily has a revolution, a reciprocating drive its own. Drives that hold still do not
    count.
    """
    found: set[float | None] = set()
    for name in scenario.driven:
        drive = scenario.drive_of(name)
        if isinstance(drive, Reciprocating):
            found.add(drive.period)
        elif isinstance(drive, Steady) and name in scenario.linkage.cranks and drive.rate:
            found.add(2.0 * math.pi / abs(drive.rate))
        elif not isinstance(drive, Held):
            found.add(None)
    return found.pop() if len(found) == 1 else None


def periodic_times(result: Result, phase: float = 0.0, after: float = 0.0, until: float = math.inf) -> Series:
    """Times within a run at which its drive is at a phase [s]; empty if the drives have no common period.

    Arguments:
        phase: share of the period, from 0 to 1.
        after, until: of the piece of the run [s].

    Raises InputError if the phase is not of the range.
    """
    if not 0.0 <= phase <= 1.0:
        raise InputError(f"phase = {short(phase)}: allowed: a share of the period, from 0 to 1")
    length = period(result.scenario)
    if length is None:
        return np.empty(0)
    first, last = max(after, float(result.time[0])), min(until, float(result.time[-1]))
    low, high = (first - CLEARANCE) / length - phase, (last + CLEARANCE) / length - phase
    return np.clip((np.arange(math.ceil(low), math.floor(high) + 1) + phase) * length, first, last)


def poincare(
    result: Result,
    pin: str | None = None,
    after: float = 0.0,
    until: float = math.inf,
    *,
    phase: float = 0.0,
    channels: Sequence[str] = (),
) -> Figure:
    """The section that fits a run: once in every period if its drive is periodic, else by impacts.

    Once in a period: the journal's centre in its bore, and two channels: by default place and velocity of the
    slider, or angle and angular velocity of the body that the journal moves. By impacts: direction and approach
    speed of every impact, and the initial impact velocity of the next impact over that of the one before.

    Arguments:
        pin: name of a clearance pin; the first one by default.
        after, until: what of the run is drawn [s].
        phase: of the period at which it is sampled, from 0 to 1.
        channels: names of the two of the second panel; only where the drive is periodic.

    Raises InputError if there is no such pin, no such record or impact, or no period where channels are asked
    for; KeyError if there is no such channel.
    """
    inside(result, after, until)
    if channels and len(channels) != 2:
        raise InputError(f"channels = {short(list(channels))}: allowed for a section: two names")
    times, window = periodic_times(result, phase, after, until), window_text(result, after, until)
    if times.size < FEWEST_PERIODS:
        if channels:
            raise InputError(
                f"channels of a section: {times.size} periods of the drive lie in the chosen piece of the run; "
                f"allowed: {FEWEST_PERIODS} and more, of a drive with a period"
            )
        return _by_impact(journal(result, pin, after, until), window, period(result.scenario) is None)
    shown = journal(result, pin, after, until) if pin is not None or clearance_joints(result) else None
    drawing = _by_period(result, times, shown, tuple(channels) or _pair(result, shown), window)
    caption(
        drawing,
        f"{times.size} points, one in each period of the drive "
        f"({units.amount(period(result.scenario) or 0.0, 's', 4)}) at {phase:g} of it; "
        f"values straight between records, which lie {units.amount(spacing(result), 's')} apart. A motion that "
        "repeats in every period is one point, in every second two points; a cloud is irregular motion, or one "
        "that has not settled yet (a later start of the piece leaves that out).",
    )
    return drawing


def _by_period(
    result: Result, times: Series, shown: JournalPath | None, pair: tuple[str, ...], window: str
) -> Figure:
    """The journal in its bore and two channels, at times [s]; window: the piece of the run in words."""
    if shown is None and not pair:
        raise InputError("a section: the run has neither a clearance pin nor a moving body on record")
    of = f", {as_words(shown.pin)}" if shown is not None else ""
    drawing = style.begin(170, 95 if shown else 110, f"Poincaré section once in a period{of}, {window}")
    panels = drawing.subplots(1, bool(shown) + bool(pair), squeeze=False)[0]
    closed: Mask | None = None
    if shown is not None:
        x, y, depth = (np.interp(times, shown.time, values) for values in (shown.x, shown.y, shown.depth))
        closed = depth > 0.0
        unit = readable("m", max(shown.clearance, float(np.hypot(x, y).max())))
        bore_axes(panels[0], shown.clearance, x, y, unit)
        _marked(panels[0], unit.scale * x, unit.scale * y, closed)
        panels[0].legend(ncols=3, **BELOW)
        panels[0].set_title("a) journal's centre in its bore")
    if pair:
        values, labels, limits = [], [], []
        for name in pair:
            found = np.interp(times, result.time, result[name])
            unit = readable(result.unit(name), float(np.abs(found).max()))
            values.append(unit.scale * found)
            labels.append(f"{name} [{unit.name}]")
            low, high = float(values[-1].min()), float(values[-1].max())
            margin = max(0.08 * (high - low), SAME * max(abs(low), abs(high)))
            limits.append((low - margin, high + margin))
        _marked(panels[-1], values[0], values[1], closed)
        panels[-1].set(xlabel=labels[0], ylabel=labels[1], xlim=limits[0], ylim=limits[1])
        panels[-1].ticklabel_format(useOffset=True)  # of a channel that hardly changes
        panels[-1].locator_params(nbins=4)
        panels[-1].set_title("b) two channels" if shown is not None else "two channels")
    return drawing


def _pair(result: Result, shown: JournalPath | None) -> tuple[str, ...]:
    """Two channels that a section is made of, by what the machine is; none if they were not recorded."""
    linkage = result.scenario.linkage
    candidates = [(f"{s.body}.x", f"{s.body}.velocity_x") for s in linkage.slides.values()]
    known = shown is not None and shown.pin in linkage.pins
    places = [linkage.pins[shown.pin]] if shown is not None and known else list(linkage.pins.values())
    bodies = [body for place in places for body in (place.second, place.first) if body != GROUND]
    candidates += [(f"{body}.angle", f"{body}.angular_velocity") for body in bodies]
    return next((pair for pair in candidates if all(name in result.channels for name in pair)), ())


def _marked(axes: Axes, x: Series, y: Series, closed: Mask | None) -> None:
    if closed is None:
        axes.plot(x, y, **PLAIN_MARK)
        return
    for chosen, mark, label in ((~closed, FLIGHT_MARK, "free flight"), (closed, CONTACT_MARK, "contact")):
        if chosen.any():
            axes.plot(x[chosen], y[chosen], label=label, **mark)


def _by_impact(shown: JournalPath, window: str, no_period: bool) -> Figure:
    """Direction and velocity of impacts, and from impact to impact; window: the piece of the run in words."""
    if len(shown.impacts) < FEWEST_IMPACTS:
        why = "it is in contact throughout" if shown.in_contact.all() else "the drive has too few periods there"
        raise InputError(
            f"a section of pin {shown.pin} from {window}: it has {len(shown.impacts)} impacts, and {why}; "
            f"allowed: at least {FEWEST_IMPACTS} impacts, or {FEWEST_PERIODS} periods of a periodic drive"
        )
    speeds = np.array([impact.speed for impact in shown.impacts])
    unit = readable("m/s", float(speeds.max()))
    speeds = unit.scale * speeds
    directions = np.unwrap(shown.directions)  # side by side where they fit into a turn
    if np.ptp(directions) >= 2.0 * np.pi:
        directions = (directions + np.pi) % (2.0 * np.pi) - np.pi
    directions = DEGREES * directions
    drawing = style.begin(170, 95, f"Poincaré section by impacts, {as_words(shown.pin)}, {window}")
    places, returns = drawing.subplots(1, 2)
    places.plot(directions, speeds, color="#999999", lw=0.6, zorder=2)
    places.plot(directions, speeds, **CONTACT_MARK)
    first: dict[str, Any] = {"ms": 6, "mfc": "none", "mec": style.IDEAL, "zorder": 4, "label": "first impact"}
    places.plot(directions[0], speeds[0], "o", **first)
    places.set(xlabel="direction of the impact from +x [deg]", ylabel=f"initial impact velocity [{unit.name}]")
    places.set_ylim(0.0, None)
    places.margins(x=0.08)
    places.set_title("a) direction and velocity of impacts")
    places.legend(**BELOW)
    top = 1.08 * float(speeds.max())
    returns.plot([0.0, top], [0.0, top], color=style.IDEAL, lw=0.7, ls=(0, (4, 2)), label="as fast as before")
    returns.plot(speeds[:-1], speeds[1:], label="impacts", **CONTACT_MARK)
    returns.set(aspect="equal", xlim=(0.0, top), ylim=(0.0, top), ylabel=f"of the next one [{unit.name}]")
    returns.set_xlabel(f"initial impact velocity of an impact [{unit.name}]")
    returns.set_title("b) from impact to impact")
    returns.legend(ncols=2, **BELOW)
    why = (
        "The drive has no period" if no_period else f"Fewer than {FEWEST_PERIODS} periods of the drive lie here"
    )
    caption(
        drawing,
        f"{why}, so the run is sampled whenever journal and bore make contact: {speeds.size} "
        "impacts, located in time. Directions are those of the last two records before the impact. On the "
        "dashed line of (b) the next impact is as fast as the one before; below it the journal comes to rest.",
    )
    return drawing
