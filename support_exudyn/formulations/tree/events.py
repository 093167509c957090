"""What happens to a contact within a step that has been tried, and where.

Between both ends of a step the journal moves against the bore as the cubic that fits place and velocity there.
"""

import math
from enum import Enum
from typing import NamedTuple

from scipy.optimize import brentq

from support_exudyn.formulations.contact_events import DOUBT_OF_DEPTH, DepthPath
from support_exudyn.formulations.tree.forces import JournalPlace
from user_forces.values.value import Vector2

PARTS = 4  # of a step in free flight, each looked at
SAMPLES = 8  # of a step in contact
SHORT = 1e-9  # [s]: in so short a step what cannot be told apart is taken as it ends
EVEN = 0.125  # share of the change of speed in flight that may not be even
ROUNDING = 1e-12  # of a rate, as a share of its size
MET = 1e-7  # depth as a share of the clearance at which an impact or a separation is met


class EventKind(Enum):
    """TOUCH, PARTING: of surfaces. RETURN: pressed on again without separation. UNCLEAR: too long a step."""

    IMPACT = "impact"
    SEPARATION = "separation"
    RETURN = "return"
    UNCLEAR = "unclear"


class Event(NamedTuple):
    """What happens, and at which fraction of the step; 1: at its end."""

    kind: EventKind
    fraction: float


def event(
    in_contact: bool, renews: bool, start: JournalPlace, end: JournalPlace, step: float, clearance: float
) -> Event | None:
    """The first thing that happens in a step [s].

    Arguments:
        in_contact: at its start.
        renews: whether something changes where a contact is pressed on again.
        start, end: of the step.
        clearance: [m].
    """
    met = MET * clearance
    if in_contact:
        return _in_contact(renews, start, end, step, met)
    return _apart(start, end, step, clearance, met)


# --- in contact ---


def _in_contact(renews: bool, start: JournalPlace, end: JournalPlace, step: float, met: float) -> Event | None:
    path = DepthPath(max(start.depth, 0.0), start.rate, end.depth, end.rate, step)
    turns = start.rate < 0.0 <= end.rate
    if step > SHORT and not turns and not start.rate > 0.0 > end.rate:
        lowest = min(path.depth0, end.depth) - step * max(abs(start.rate), abs(end.rate))
        if (renews or lowest <= 0.0 < end.depth) and path.may_turn():
            return Event(EventKind.UNCLEAR, 0.0)
    if abs(end.depth) <= met and end.rate < 0.0:
        return Event(EventKind.SEPARATION, 1.0)
    if end.depth < -met:
        return _separation(path, met)
    turn = path.turns_up() if turns else None
    if turn is not None:
        lowest = path.depth(turn)
        if step > SHORT and met < abs(lowest) < path.doubt():
            return Event(EventKind.UNCLEAR, 0.0)
        if lowest < -met:
            return Event(EventKind.SEPARATION, path.crossing(0.0, turn))
        if renews:
            return Event(EventKind.RETURN, turn)
    return None


def _separation(path: DepthPath, met: float) -> Event:
    """The first way out of a contact that is open at the end of the step."""
    inside = 0.0 if path.depth0 > met else None
    for n in range(1, SAMPLES + 1):
        x = n / SAMPLES
        if path.depth(x) > 0.0:
            inside = x
        elif inside is not None:
            return Event(EventKind.SEPARATION, path.crossing(inside, x))
    # it been in contact just before the step and is seen nowhere inside
    return Event(EventKind.SEPARATION, 1.0) if path.step <= SHORT else Event(EventKind.UNCLEAR, 0.0)


# --- apart ---


class _Flight(NamedTuple):
    """The journal's way against the bore as a cubic of the fraction of the step, in both axes."""

    start: JournalPlace
    end: JournalPlace
    step: float
    clearance: float

    def depth(self, x: float) -> float:
        """Depth [m] at a fraction."""
        return math.hypot(*self._at(x)) - self.clearance

    def rate(self, x: float) -> float:
        """A quantity with the sign of its rate."""
        (px, py), (vx, vy) = self._at(x), self._slope(x)
        return px * vx + py * vy

    @property
    def doubt(self) -> float:
        """How far the true depth may be off [m]."""
        h, s, e = self.step, self.start, self.end
        last = math.hypot(h * (s.vx + e.vx) - 2.0 * (e.x - s.x), h * (s.vy + e.vy) - 2.0 * (e.y - s.y))
        return DOUBT_OF_DEPTH * (EVEN * h * math.hypot(e.vx - s.vx, e.vy - s.vy) + last)

    def _at(self, x: float) -> Vector2:
        y, h, s, e = 1.0 - x, self.step, self.start, self.end
        a, b, c, d = y * y * (1.0 + 2.0 * x), x * x * (3.0 - 2.0 * x), h * x * y * y, -h * x * x * y
        return a * s.x + b * e.x + c * s.vx + d * e.vx, a * s.y + b * e.y + c * s.vy + d * e.vy

    def _slope(self, x: float) -> Vector2:
        y, h, s, e = 1.0 - x, self.step, self.start, self.end
        a, c, d = 6.0 * x * y, h * y * (1.0 - 3.0 * x), h * x * (3.0 * x - 2.0)
        return (
            a * (e.x - s.x) + c * s.vx + d * e.vx,
            a * (e.y - s.y) + c * s.vy + d * e.vy,
        )


def _apart(start: JournalPlace, end: JournalPlace, step: float, clearance: float, met: float) -> Event | None:
    way = step * max(math.hypot(start.vx, start.vy), math.hypot(end.vx, end.vy))
    if way > clearance:  # else it could cross the whole bore unseen
        return Event(EventKind.UNCLEAR, 0.0)
    if max(start.depth, end.depth) < -way:
        return None
    flight = _Flight(start, end, step, clearance)
    low, apart = 0.0, start.depth < -met
    rising = start.rate > 0.0
    for n in range(1, PARTS + 1):
        high = n / PARTS
        outwards = flight.rate(high)
        falling = outwards < ROUNDING * clearance * way
        top = float(brentq(flight.rate, low, high)) if rising and outwards < 0.0 else high
        highest = flight.depth(top)
        if rising and falling and top < 1.0 and step > SHORT and met < abs(highest) < flight.doubt:
            return Event(EventKind.UNCLEAR, 0.0)
        if highest > met:
            if apart and flight.depth(low) >= 0.0:  # it was met between both parts
                return Event(EventKind.IMPACT, low)
            if apart:
                return Event(EventKind.IMPACT, float(brentq(flight.depth, low, top, xtol=1e-15)))
            # the surfaces have just separated and must be seen apart first
            return Event(EventKind.IMPACT, 1.0) if step <= SHORT else Event(EventKind.UNCLEAR, 0.0)
        apart = apart or flight.depth(high) < -met
        low, rising = high, outwards >= 0.0
    return Event(EventKind.IMPACT, 1.0) if apart and end.depth >= -met and end.rate > 0.0 else None
