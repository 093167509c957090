"""Poincare view: a run seen once in a period, or at every impact."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

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
from support_exudyn.postprocessing.figures.units import DEGREES, DisplayUnit, readable
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
NARROW = 0.01  # share of its size below which only the spread of a channel is shown
SAME = 1e-4  # ... and below which all points are shown as the same


class PoincareSection(NamedTuple):
    """Two channels at equal phases of the drive: times (n,) [s], values of both (n,), SI."""

    time: Series
    first: Series
    second: Series


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


def stroboscopic(
    result: Result, first: str, second: str, phase: float = 0.0, after: float = 0.0, until: float = math.inf
) -> PoincareSection:
    """Two channels once in every period of the drive, straight between records.

    Raises InputError if the drive is not periodic, KeyError if there is no such channel.
    """
    times = periodic_times(result, phase, after, until)
    if not times.size:
        raise InputError(
            "a section once in every period: the drives have no common period, or none begins in the chosen "
            "piece; allowed: steady cranks and reciprocating drives"
        )
    return PoincareSection(times, *(np.interp(times, result.time, result[name]) for name in (first, second)))


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
    times = periodic_times(result, phase, after, until)
    if times.size >= FEWEST_PERIODS:
        return _by_period(result, pin, (phase, after, until), channels)
    if channels:
        raise InputError(
            f"channels of a section: {times.size} periods of the drive lie in the chosen piece of the run; "
            f"allowed: {FEWEST_PERIODS} and more, of a drive with a period"
        )
    return _by_impact(result, journal(result, pin, after, until), window_text(result, after, until))


# --- once in a period ---


def _by_period(
    result: Result, pin: str | None, window: tuple[float, float, float], channels: Sequence[str]
) -> Figure:
    """window: phase, and the times between which the run is drawn [s]."""
    phase, after, until = window
    shown = journal(result, pin, after, until) if pin is not None or clearance_joints(result) else None
    pair = tuple(channels) or _pair(result, shown.pin if shown else None)
    if shown is None and not pair:
        raise InputError("a section: the run has neither a clearance pin nor a moving body on record")
    of = f", {as_words(shown.pin)}" if shown is not None else ""
    title = f"Poincaré section once in a period{of}, {window_text(result, after, until)}"
    drawing = style.begin(170, 95 if shown else 110, title)
    panels = drawing.subplots(1, bool(shown) + bool(pair), squeeze=False)[0]
    closed: Mask | None = None
    if shown is not None:
        x, y, depth = (f"pin.{shown.pin}.{what}" for what in ("eccentricity_x", "eccentricity_y", "depth"))
        places = stroboscopic(result, x, y, *window)
        closed = np.interp(places.time, result.time, result[depth]) > 0.0
        unit = readable("m", max(shown.clearance, float(np.hypot(places.first, places.second).max())))
        bore_axes(panels[0], shown.clearance, places.first, places.second, unit)
        _marked(panels[0], unit.scale * places.first, unit.scale * places.second, closed)
        panels[0].legend(ncols=3, **BELOW)
        panels[0].set_title("a) journal's centre in its bore")
    if pair:
        section = stroboscopic(result, pair[0], pair[1], *window)
        (x_values, x_name), (y_values, y_name) = (
            _readable_spread(name, values, result.unit(name))
            for name, values in zip(pair, (section.first, section.second), strict=True)
        )
        _marked(panels[-1], x_values, y_values, closed)
        panels[-1].set(xlabel=x_name, ylabel=y_name, xlim=_widened(x_values), ylim=_widened(y_values))
        panels[-1].locator_params(nbins=4)
        panels[-1].set_title("b) two channels" if shown is not None else "two channels")
    count, length = periodic_times(result, *window).size, period(result.scenario) or 0.0
    caption(
        drawing,
        f"{count} points, one in each period of the drive ({units.amount(length, 's', 4)}) at {phase:g} of it; "
        f"values straight between records, which lie {units.amount(spacing(result), 's')} apart. A motion that "
        "repeats in every period is one point, in every second two points; a cloud is irregular motion, or one "
        "that has not settled yet (a later start of the piece leaves that out).",
    )
    return drawing


def _pair(result: Result, pin: str | None) -> tuple[str, ...]:
    """Two channels that a section is made of, by what the machine is; none if they were not recorded."""
    linkage = result.scenario.linkage
    candidates = [(f"{s.body}.x", f"{s.body}.velocity_x") for s in linkage.slides.values()]
    places = [linkage.pins[pin]] if pin is not None and pin in linkage.pins else list(linkage.pins.values())
    bodies = [body for place in places for body in (place.second, place.first) if body != GROUND]
    candidates += [(f"{body}.angle", f"{body}.angular_velocity") for body in bodies]
    return next((pair for pair in candidates if all(name in result.channels for name in pair)), ())


def _readable_spread(name: str, values: Series, unit: str) -> tuple[Series, str]:
    """Values in the unit of their spread, from their middle if that is far larger than the spread."""
    size, spread = float(np.abs(values).max()), float(np.ptp(values))
    if not SAME * size < spread < NARROW * size:
        chosen = readable(unit, size)
        return chosen.scale * values, f"{name} [{chosen.name}]"
    middle = 0.5 * float(values.max() + values.min())
    chosen, at = readable(unit, spread), readable(unit, size)
    return chosen.scale * (values - middle), f"{name},\nfrom {at.scale * middle:.6g} {at.name} [{chosen.name}]"


def _widened(values: Series) -> tuple[float, float]:
    """Limits of an axis; around values that are all the same, so far apart that its ticks differ."""
    low, high = float(values.min()), float(values.max())
    margin = max(0.08 * (high - low), 0.01 * NARROW * max(abs(low), abs(high)))
    return low - margin, high + margin


def _marked(axes: Axes, x: Series, y: Series, closed: Mask | None) -> None:
    if closed is None:
        axes.plot(x, y, **PLAIN_MARK)
        return
    for chosen, mark, label in ((~closed, FLIGHT_MARK, "free flight"), (closed, CONTACT_MARK, "contact")):
        if chosen.any():
            axes.plot(x[chosen], y[chosen], label=label, **mark)


# --- at every impact ---


def _by_impact(result: Result, shown: JournalPath, window: str) -> Figure:
    """window: the piece of the run in words."""
    if len(shown.impacts) < FEWEST_IMPACTS:
        why = "it is in contact throughout" if shown.in_contact.all() else "the drive has too few periods there"
        raise InputError(
            f"a section of pin {shown.pin} from {window}: it has {len(shown.impacts)} impacts, and {why}; "
            f"allowed: at least {FEWEST_IMPACTS} impacts, or {FEWEST_PERIODS} periods of a periodic drive"
        )
    speeds = np.array([impact.speed for impact in shown.impacts])
    unit = readable("m/s", float(speeds.max()))
    drawing = style.begin(170, 95, f"Poincaré section by impacts, {as_words(shown.pin)}, {window}")
    places, returns = drawing.subplots(1, 2)
    _draw_impacts(places, DEGREES * _together(shown.directions), unit.scale * speeds, unit)
    _draw_returns(returns, unit.scale * speeds, unit)
    none = period(result.scenario) is None
    why = "The drive has no period" if none else f"Fewer than {FEWEST_PERIODS} periods of the drive lie here"
    caption(
        drawing,
        f"{why}, so the run is sampled whenever journal and bore make contact: {speeds.size} "
        "impacts, located in time. Directions are those of the last two records before the impact. On the "
        "dashed line of (b) the next impact is as fast as the one before; below it the journal comes to rest.",
    )
    return drawing


def _together(directions: Series) -> Series:
    """The same directions [rad] side by side where they fit into a turn, else from -pi to pi."""
    side_by_side: Series = np.unwrap(directions)
    if np.ptp(side_by_side) < 2.0 * np.pi:
        return side_by_side
    return (directions + np.pi) % (2.0 * np.pi) - np.pi


def _draw_impacts(axes: Axes, directions: Series, speeds: Series, unit: DisplayUnit) -> None:
    axes.plot(directions, speeds, color="#999999", lw=0.6, zorder=2)
    axes.plot(directions, speeds, **CONTACT_MARK)
    axes.plot(directions[0], speeds[0], "o", ms=6, mfc="none", mec=style.IDEAL, zorder=4, label="first impact")
    axes.set(xlabel="direction of the impact from +x [deg]", ylabel=f"initial impact velocity [{unit.name}]")
    axes.set_ylim(0.0, None)
    axes.margins(x=0.08)
    axes.set_title("a) direction and velocity of impacts")
    axes.legend(**BELOW)


def _draw_returns(axes: Axes, speeds: Series, unit: DisplayUnit) -> None:
    top = 1.08 * float(speeds.max())
    axes.plot([0.0, top], [0.0, top], color=style.IDEAL, lw=0.7, ls=(0, (4, 2)), label="as fast as before")
    axes.plot(speeds[:-1], speeds[1:], label="impacts", **CONTACT_MARK)
    axes.set(aspect="equal", xlim=(0.0, top), ylim=(0.0, top))
    axes.set(
        xlabel=f"initial impact velocity of an impact [{unit.name}]", ylabel=f"of the next one [{unit.name}]"
    )
    axes.set_title("b) from impact to impact")
    axes.legend(ncols=2, **BELOW)
