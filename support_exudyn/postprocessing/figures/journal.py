"""A clearance pin of a run, ready to be drawn: where its journal is in the bore, and when it is in contact."""

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
Mask = npt.NDArray[np.bool_]
NEEDED = ("eccentricity_x", "eccentricity_y", "depth")


def _pins_with(result: Result, last: str) -> list[str]:
    """Names of the pins that have a recorded channel of this name."""
    named = [name for name in result.channels if name.startswith("pin.") and name.endswith(f".{last}")]
    return [name.removeprefix("pin.").removesuffix(f".{last}") for name in named]


def clearance_joints(result: Result) -> tuple[str, ...]:
    """Names of the clearance pins whose journals were recorded, the first one of the scenario first."""
    found = (_pins_with(result, what) for what in NEEDED)
    known, order = set.intersection(*map(set, found)), list(result.scenario.pins)
    named = [name for name in _pins_with(result, NEEDED[0]) if name in known]
    return tuple(sorted(named, key=lambda name: order.index(name) if name in order else len(order)))


def corners(result: Result) -> tuple[str, ...]:
    """Names of the corners and pins in guides with clearance."""
    return tuple(name for name in result.onsets if result.scenario.contact_stem(name).startswith("guide."))


def chosen_pin(result: Result, pin: str | None, *, with_clearance: bool) -> str:
    """A pin with clearance, or any pin, by name; without a name the first one, with clearance if there is one.

    Raises InputError if there is no such pin, or none at all.
    """
    known, kind = clearance_joints(result), "clearance pin with recorded journal"
    if not with_clearance:
        forces, kind = _pins_with(result, "force"), "pin with recorded force"
        known = tuple(dict.fromkeys([*(name for name in known if name in forces), *forces]))
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
    def in_contact(self) -> Mask:
        """The records at which the journal is pressed in, as a mask (n,)."""
        return self.depth > 0.0

    @property
    def touches(self) -> Series:
        """The times of the impacts [s], shape (impacts,)."""
        return np.array([impact.time for impact in self.impacts])

    @property
    def directions(self) -> Series:
        """Directions of the journal from the bore's centre at every impact [rad], shape (impacts,).

        By the straight line through the last two records of the flight before; where there are no two, by that
        between the records around the impact.
        """
        after = np.searchsorted(self.time, self.touches)
        found = []
        for t, last in zip(self.touches, after - 1, strict=True):
            first = last - 1
            if first < 0 or self.in_contact[first] or self.in_contact[last]:
                first, last = last, min(last + 1, self.time.size - 1)
            ahead = (t - self.time[first]) / (self.time[last] - self.time[first])
            x, y = (values[first] + ahead * (values[last] - values[first]) for values in (self.x, self.y))
            found.append(math.atan2(y, x))
        return np.array(found)

    def path(self) -> tuple[Series, Series, Mask]:
        """The path with the impacts and separations between records put in.

        Returns x, y (m,) [m], and which of the m - 1 pieces between them are contact. An impact lies on the
        clearance circle in its direction, a separation in the direction between the records around it.
        """
        ends = np.array([impact.separation_time for impact in self.impacts])
        separated = ends[(ends >= self.time[0]) & (ends <= self.time[-1])]
        turned = np.unwrap(np.arctan2(self.y, self.x))
        angles = np.concatenate([self.directions, np.interp(separated, self.time, turned)])
        times = np.concatenate([self.time, self.touches, separated])
        x = np.concatenate([self.x, self.clearance * np.cos(angles)])
        y = np.concatenate([self.y, self.clearance * np.sin(angles)])
        pressed = np.concatenate([self.in_contact, np.zeros(angles.size, dtype=bool)])
        order = np.argsort(times, kind="stable")
        times, pressed = times[order], pressed[order]
        contact = (pressed[:-1] & pressed[1:]) | self._touching(0.5 * (times[:-1] + times[1:]))
        return x[order], y[order], contact

    def _touching(self, times: Series) -> Mask:
        """Whether a located contact lasts at these times."""
        begins = self.touches
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
    scenario, time, whole = result.scenario, result.time[chosen], pin
    if scenario.dimensions == 3 and pin not in scenario.clearance_pins:  # one of a pair
        whole = scenario.space.bearings[pin].pin
    x, y, depth = (result[f"pin.{pin}.{what}"][chosen] for what in NEEDED)
    impacts = tuple(one for one in result.onsets.get(pin, ()) if time[0] <= one.time <= time[-1])
    clearance = scenario.clearance_pins[whole].contact.bearing.clearance
    return JournalPath(pin, clearance, time, x, y, depth, impacts, float(np.median(np.diff(time))))


def shortest_impact(impacts: tuple[Onset, ...]) -> float:
    """Shortest time from an impact to its separation [s]; infinite if nothing separated."""
    return min((impact.separation_time - impact.time for impact in impacts), default=math.inf)
