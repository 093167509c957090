"""A clearance pin of a run, ready to be drawn: where its journal is in the bore, when in contact."""

import math
from dataclasses import dataclass
from difflib import get_close_matches

import numpy as np
import numpy.typing as npt

from support_exudyn.postprocessing.figures.selection import inside
from support_exudyn.simulation.result import Result
from user_forces.contact_state import Onset
from user_forces.values.value import InputError, short

Series = npt.NDArray[np.float64]
NEEDED = ("eccentricity_x", "eccentricity_y", "depth")


def clearance_joints(result: Result) -> tuple[str, ...]:
    """Names of the clearance pins whose journals were recorded, the first one of the scenario first."""
    prefix, last = "pin.", f".{NEEDED[0]}"
    named = [name[len(prefix) : -len(last)] for name in result.channels if name.endswith(last)]
    known = [name for name in named if all(f"pin.{name}.{what}" in result.channels for what in NEEDED)]
    order = list(result.scenario.pins)
    return tuple(sorted(known, key=lambda name: order.index(name) if name in order else len(order)))


def corners(result: Result) -> tuple[str, ...]:
    """Names of the corners and pins in guides with clearance."""
    return tuple(name for name in result.onsets if result.scenario.contact_stem(name).startswith("guide."))


def pins(result: Result) -> tuple[str, ...]:
    """Names of all pins whose force was recorded, those with clearance first."""
    prefix, last = "pin.", ".force"
    named = [name[len(prefix) : -len(last)] for name in result.channels if name.startswith(prefix)
             and name.endswith(last)]  # fmt: skip
    with_clearance = [name for name in clearance_joints(result) if name in named]
    return tuple(dict.fromkeys([*with_clearance, *named]))


def chosen_pin(result: Result, pin: str | None, *, with_clearance: bool) -> str:
    """A pin by name, or the first one if none is named.

    Raises InputError if there is no such pin, or none at all.
    """
    known = clearance_joints(result) if with_clearance else pins(result)
    kind = "clearance pin with recorded journal" if with_clearance else "pin with recorded force"
    if not known:
        raise InputError(f"the run has no {kind}; allowed: runs that have one")
    if pin is None:
        return known[0]
    if pin not in known:
        near = get_close_matches(pin, known, 3, 0.4) or known[:6]
        raise InputError(f"pin {short(pin)}: no {kind}; allowed: {', '.join(near)}")
    return pin


@dataclass(frozen=True)
class JournalPath:
    """The centre of a journal in its bore, between two times.

    time (n,) [s]. x, y: from the bore's centre (n,) [m]. depth: negative: gap (n,) [m].
    clearance: radial [m]. impacts: beginnings of contact between the two times.
    spacing: of the records [s].
    """

    pin: str
    clearance: float
    time: Series
    x: Series
    y: Series
    depth: Series
    impacts: tuple[Onset, ...]
    spacing: float

    @property
    def in_contact(self) -> npt.NDArray[np.bool_]:
        """The records at which the journal is pressed in, as a mask (n,)."""
        return self.depth > 0.0

    @property
    def directions(self) -> Series:
        """Directions of the journal from the bore's centre at every impact [rad], shape (impacts,).

        By the straight line through the last two records of the flight before; where there are no two, by that
        between the records around the impact.
        """
        return np.array([self._direction(impact.time) for impact in self.impacts])

    def _direction(self, t: float) -> float:
        after = int(np.searchsorted(self.time, t))
        last = after - 1
        first = last - 1
        if first < 0 or self.in_contact[first] or self.in_contact[last]:
            x, y = (float(np.interp(t, self.time, values)) for values in (self.x, self.y))
            return math.atan2(y, x)
        ahead = (t - self.time[last]) / (self.time[last] - self.time[first])
        x, y = (values[last] + ahead * (values[last] - values[first]) for values in (self.x, self.y))
        return math.atan2(y, x)

    def path(self) -> tuple[Series, Series, npt.NDArray[np.bool_]]:
        """The path with the impacts and separations between records put in.

        Returns x, y (m,) [m], and which of the m - 1 pieces between them are contact. An impact lies on the
        clearance circle in its direction, a separation in the direction that the records around it tell.
        """
        separations = [
            impact.separation_time for impact in self.impacts if impact.separation_time <= self.time[-1]
        ]
        separated = np.array([t for t in separations if t >= self.time[0]])
        turned = np.unwrap(np.arctan2(self.y, self.x))
        angles = np.concatenate([self.directions, np.interp(separated, self.time, turned)])
        times = np.concatenate([self.time, [impact.time for impact in self.impacts], separated])
        x = np.concatenate([self.x, self.clearance * np.cos(angles)])
        y = np.concatenate([self.y, self.clearance * np.sin(angles)])
        pressed = np.concatenate([self.in_contact, np.zeros(angles.size, dtype=bool)])
        order = np.argsort(times, kind="stable")
        times, pressed = times[order], pressed[order]
        contact = (pressed[:-1] & pressed[1:]) | self._touching(0.5 * (times[:-1] + times[1:]))
        return x[order], y[order], contact

    def _touching(self, times: Series) -> npt.NDArray[np.bool_]:
        """Whether a located contact goes on at these times."""
        begins = np.array([impact.time for impact in self.impacts])
        if not begins.size:
            return np.zeros(times.size, dtype=bool)
        ends = np.minimum([impact.separation_time for impact in self.impacts], [*begins[1:], np.inf])
        n = np.searchsorted(begins, times, side="right") - 1
        return (n >= 0) & (times < ends[np.maximum(n, 0)])


def journal(result: Result, pin: str | None = None, after: float = 0.0, until: float = math.inf) -> JournalPath:
    """The journal of a clearance pin between two times [s]; of the first clearance pin if none is named.

    Raises InputError if there is no such pin, or fewer than two records lie between the times.
    """
    pin = chosen_pin(result, pin, with_clearance=True)
    chosen = inside(result, after, until)
    time = result.time[chosen]
    return JournalPath(
        pin=pin,
        clearance=clearance(result, pin),
        time=time,
        x=result[f"pin.{pin}.eccentricity_x"][chosen],
        y=result[f"pin.{pin}.eccentricity_y"][chosen],
        depth=result[f"pin.{pin}.depth"][chosen],
        impacts=tuple(one for one in result.onsets.get(pin, ()) if time[0] <= one.time <= time[-1]),
        spacing=float(np.median(np.diff(time))),
    )


def clearance(result: Result, pin: str) -> float:
    """Radial clearance of a clearance pin [m]; in space also of each of a pair."""
    scenario = result.scenario
    whole = pin
    if scenario.dimensions == 3 and pin not in scenario.clearance_pins:
        whole = scenario.space.bearings[pin].pin
    return scenario.clearance_pins[whole].contact.bearing.clearance


def shortest_impact(impacts: tuple[Onset, ...]) -> float:
    """Shortest time from an impact to its separation [s]; infinite if nothing separated."""
    return min((impact.separation_time - impact.time for impact in impacts), default=math.inf)
