"""The way of driven parts while the others are held: postures, dead centres, where parts turn back."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from types import MappingProxyType
from typing import Any

import numpy as np

from support_exudyn.machines.check.freedoms import in_line, listed
from support_exudyn.machines.check.statics import Array, Statics, statics
from support_exudyn.mechanics.body_motion import BodyMotion
from support_exudyn.mechanics.closing import Conditions, moved_on, tangent
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import GROUND, Linkage
from support_exudyn.model.loads.load import ActingLoad

STILL = 1e-6  # of the fastest: a body that the drive does not move
SINGULAR = 1e-5  # singular values of conditions below this are none
NEAR_SINGULAR = 0.05  # ... and next to a change point below this
NONE = 1e-9  # of the largest rate on the way: what moves slower stands still
FOUND = 1e-12  # of the way: how closely a point on it is located
STEPS_BEYOND = 60  # of a search beyond an end
TURN = 2.0 * math.pi
Station = tuple[float, Matrix]  # travel [rad] or [m], and coordinates counted by arms


@dataclass(frozen=True)
class Moved:
    """A posture: travel of the driven parts [rad] or [m], coordinates of the bodies (3 bodies,), forces."""

    travel: float
    position: Array
    forces: Statics


@dataclass(frozen=True)
class WayPoint:
    """A notable point of a way.

    Arguments:
        what: "dead centre", where the way ends; "turns back", where a part stands still for a moment; "change
            point", where all bars lie in line and the linkage could go on otherwise.
        travel: of the driven part from the start on [rad], [m].
        part: that turns back; else empty.
        why: what lies in line there, in words; empty if nothing does.
    """

    what: str
    travel: float
    part: str = ""
    why: str = ""

    @property
    def reason(self) -> str:
        """What lies in line, as the end of a sentence."""
        return f": {self.why}" if self.why else ""


@dataclass(frozen=True)
class DriveWay:
    """How far driven parts move a linkage while the other driven parts are held.

    Arguments:
        drives: names of the driven parts; several actuators extend alike.
        linkage: in its start posture.
        moved: postures in the order of their travel.
        ends: ends of the travel that were reached, downwards and upwards [rad], [m].
        points: dead centres and others, in the order of their travel.
        beyond: dead centres beyond both ends, the lower and the upper; None where none is near.
        resting: bodies that the driven parts do not move, among them the ground.
        reach: from the driven parts to each body that they move: how many joints lie between.
    """

    drives: tuple[str, ...]
    linkage: Linkage
    moved: Sequence[Moved] = field(repr=False)
    ends: tuple[float, float]
    points: Sequence[WayPoint]
    beyond: tuple[WayPoint | None, WayPoint | None]
    resting: Sequence[str]
    reach: Mapping[str, int]

    @property
    def drive(self) -> str:
        """Names of the driven parts in a row."""
        return listed(self.drives)

    @property
    def label(self) -> str:
        """Name of the driven part; of several, whose extension is shown, "stroke"."""
        return self.drive if len(self.drives) == 1 else "stroke"

    @property
    def turns(self) -> bool:
        """Whether the driven part is a crank."""
        return self.drives[0] in self.linkage.cranks

    @property
    def locks(self) -> bool:
        """Whether the linkage locks on the way, at one end or at both."""
        return any(one.what == "dead centre" for one in self.points)

    @property
    def right_round(self) -> bool:
        """Whether the driven part is a crank that turns right round."""
        return self.turns and not self.locks

    @property
    def start(self) -> float:
        """Angle [rad] or length [m] at the start; of several actuators their extension, 0."""
        if self.turns:
            return self.linkage.bodies[self.linkage.cranks[self.drives[0]].body].angle
        return self.linkage.actuators[self.drives[0]].start_length if len(self.drives) == 1 else 0.0

    @property
    def unit(self) -> str:
        """Unit in which angles or lengths are shown."""
        return "degrees" if self.turns else "mm"

    def shown(self, travel: float) -> float:
        """Angle [degrees] or length [mm] of the driven part for a travel, of several their extension."""
        value = self.start + travel
        return math.degrees(value) if self.turns else 1e3 * value

    def at(self, travel: float) -> str:
        """Where the driven part stands, in words, to 0.01 degrees or mm; once round counts from 0 again."""
        shown = round(self.shown(travel), 2)
        word = "at" if len(self.drives) == 1 else "extended by"
        return f"{self.drive} {word} {(shown % 360.0 if self.right_round else shown) + 0.0:.8g} {self.unit}"

    @cached_property
    def motion(self) -> BodyMotion:
        """The bodies in all postures."""
        position = np.array([one.position for one in self.moved])
        return BodyMotion(self.linkage, position, np.zeros_like(position))

    def data(self) -> dict[str, Any]:
        """The way as plain data, SI and radians."""
        return {
            "start": self.start,
            "travel": list(self.ends),
            "locks": self.locks,
            "turns_right_round": self.right_round,
            "points": [
                {
                    "what": one.what,
                    "travel": one.travel,
                    "value": self.start + one.travel,
                    "part": one.part,
                    "in_line": one.why,
                }
                for one in self.points
            ],
            "dead_centres_beyond": [one and {"travel": one.travel, "in_line": one.why} for one in self.beyond],
        }


def way_of(
    conditions: Conditions,
    linkage: Linkage,
    drives: tuple[str, ...],
    goal: tuple[float, float],
    steps: int,
    loads: Mapping[str, ActingLoad] = MappingProxyType({}),
    farther: float = 0.0,
) -> DriveWay:
    """The way of driven parts of a linkage whose start posture its conditions determine.

    A crank that turns right round in one direction is not turned in the other.

    Arguments:
        conditions: which hold as the linkage is moved.
        linkage: whose forces are computed; its bodies are those of the conditions.
        drives: names of the driven parts; several actuators extend alike.
        goal: ends of the travel that are tried [rad], [m], at most 0 and at least 0.
        steps: postures to each end.
        loads: that act besides the weight, by name.
        farther: how far beyond both ends a dead centre is searched for [m].
    """
    start = (0.0, conditions.still)
    search = Search(conditions, drives)
    up, down = search.march(start, goal[1], steps), list[Station]()
    if not (search.crank and goal[1] and up and up[-1][0] == goal[1]):
        down = search.march(start, goal[0], steps)
    stations = [*down[::-1], start, *up]
    ends = stations[0][0], stations[-1][0]
    locked = [end for end, asked, tried in zip(ends, goal, (down, up), strict=True) if tried and end != asked]
    if goal[1] and len(stations) == 1:
        locked = [0.0]
    points = [search.dead_centre(one) for one in stations if one[0] in locked]
    rates = []
    for n, (_, posture) in enumerate(stations):
        before, after = stations[max(n - 1, 0)], stations[min(n + 1, len(stations) - 1)]
        along = None if before is after else (after[1] - before[1]) / (after[0] - before[0])
        rates.append(search.rates(posture, along))
    inner = [n for n, one in enumerate(stations) if one[0] not in locked or len(stations) == 1]
    points += search.turning_back([stations[n] for n in inner], [rates[n] for n in inner])
    points += search.change_points([stations[n] for n in inner])
    fastest = np.max([np.abs(one).reshape(-1, 3).max(axis=1) for one in rates], axis=0)
    resting = [GROUND, *(n for n, v in zip(linkage.bodies, fastest, strict=True) if v < STILL * fastest.max())]
    positions = [(travel, posture / conditions.arms) for travel, posture in stations]
    return DriveWay(
        drives=drives,
        linkage=linkage,
        moved=[Moved(travel, at, statics(linkage, at, loads=loads)) for travel, at in positions],
        ends=ends,
        points=sorted(points, key=lambda one: one.travel),
        beyond=(search.beyond(stations[0], -farther), search.beyond(stations[-1], farther)),
        resting=resting,
        reach=_reach(linkage, drives, resting),
    )


def _reach(linkage: Linkage, drives: tuple[str, ...], resting: Sequence[str]) -> dict[str, int]:
    """How many joints lie between the driven parts and each body that they move."""
    edge = [linkage.cranks[name].body for name in drives if name in linkage.cranks]
    struts = [linkage.actuators[name] for name in drives if name in linkage.actuators]
    edge += [body for one in struts for body in (one.foot, one.head)]
    ends = [(a, b) for (part, _), ((a, _), (b, _)) in linkage.joints.items() if part != "actuators"]
    ends += [(one.first, one.second) for one in linkage.gears.values()]
    reach, far = dict[str, int](), 0
    while edge := [one for one in edge if one not in reach and one not in resting]:
        reach |= dict.fromkeys(edge, far)
        edge, far = [b if one == a else a for a, b in ends for one in (a, b) if one in edge], far + 1
    return reach


class Search:
    """Search for postures of a linkage, by the travel of its driven parts.

    Arguments:
        conditions: which hold as the linkage is moved.
        drives: names of the driven parts.
    """

    def __init__(self, conditions: Conditions, drives: tuple[str, ...]) -> None:
        self.conditions, self.drives = conditions, drives
        self.crank = drives[0] in conditions.linkage.cranks
        kind, owners = "cranks" if self.crank else "actuators", conditions.kinetics.owners()
        self.driven = [owners.index((kind, name)) for name in drives]  # rows of the driven parts

    def march(self, start: Station, goal: float, steps: int) -> list[Station]:
        """Postures step by step up to a travel, as far as the linkage closes on the same way."""
        (first, moved), along, found = start, None, list[Station]()
        reached = first
        for number in range(1, steps + 1 if goal != first else 0):
            wanted, before = first + (goal - first) * (number / steps), moved  # the last is the goal to the bit
            moved, share = moved_on(self.conditions, before, dict.fromkeys(self.drives, wanted), along)
            if share > 0.0:
                found.append((wanted if share == 1.0 else reached + share * (wanted - reached), moved))
            if share < 1.0:
                break
            along, reached = moved - before, wanted
        return found

    def dead_centre(self, station: Station) -> WayPoint:
        """A posture as a dead centre, with what lies in line there."""
        return WayPoint("dead centre", station[0], why=self._why(station[1]))

    def _why(self, moved: Matrix) -> str:
        return in_line(self.conditions, moved, self.conditions.rows(moved))

    def beyond(self, last: Station, farther: float) -> WayPoint | None:
        """The dead centre that lies at most so far [m] beyond a posture; None if there is none."""
        found = self.march(last, last[0] + farther, STEPS_BEYOND)
        if not farther or (found and found[-1][0] == last[0] + farther):
            return None
        return self.dead_centre(found[-1] if found else last)

    def between(self, first: Station, second: Station, travel: float) -> Matrix:
        """The posture at a travel, reached from a station in the direction of another."""
        travels = dict.fromkeys(self.drives, travel)
        return moved_on(self.conditions, first[1], travels, second[1] - first[1])[0]

    def rates(self, moved: Matrix, along: Matrix | None = None) -> Matrix:
        """Rates of all coordinates in a posture, counted by arms, by that of the drives (n,); 0 if it locks."""
        ahead = np.zeros(len(self.conditions.counts))
        ahead[self.driven] = self.conditions.counts[self.driven]
        found = tangent(self.conditions, moved, ahead, along)
        return np.zeros(moved.size) if found is None else found

    def turning_back(self, stations: Sequence[Station], rates: Sequence[Matrix]) -> Iterator[WayPoint]:
        """Where what is pinned to the ground or slides on it stands still for a moment; rates: at stations."""
        conditions, linkage = self.conditions, self.conditions.linkage
        parts: dict[str, Matrix] = {}  # rows that give their rates
        for pin in linkage.pins.values():
            if GROUND in (pin.first, pin.second):
                body = pin.second if pin.first == GROUND else pin.first
                parts[body] = conditions.kinetics.turning(conditions.still.size, body) / conditions.arms
        for slide in linkage.slides.values():
            if slide.against == GROUND and slide.body not in parts:
                parts[slide.body], first = conditions.still.copy(), conditions.kinetics.first(slide.body)
                parts[slide.body][first : first + 2] = math.cos(slide.direction), math.sin(slide.direction)
        if self.crank:
            parts.pop(linkage.cranks[self.drives[0]].body, None)
        first, *others = self.driven
        fastest = float(np.max(np.abs(rates)))
        for part, unscaled in parts.items():
            row = conditions.size * unscaled
            speeds = [float(row @ one) for one in rates]
            if max(map(abs, speeds)) < STILL * fastest:
                continue
            for travel, moved in self._zeros(stations, speeds, row):
                rows = conditions.rows(moved)
                rows[others] -= rows[first]  # what is driven alike stays so
                rows[first] = row  # the part that turns back held in place of the drive
                yield WayPoint("turns back", travel, part, in_line(conditions, moved, rows))

    def _zeros(self, stations: Sequence[Station], values: Sequence[float], row: Matrix) -> Iterator[Station]:
        """Where the rate that a row gives passes zero; values: at all stations."""
        from scipy.optimize import brentq  # slow to import

        most = max(map(abs, values), default=0.0)
        if not most > 0.0 or max(values) - min(values) < NONE * most:
            return
        once_round = self.crank and math.isclose(stations[-1][0] - stations[0][0], TURN, rel_tol=1e-12)
        if once_round and abs(values[0]) < NONE * most:  # what is before the start is what is before the end
            stations, values = [stations[-2], *stations], [values[-2], *values]
        moving = [n for n, one in enumerate(values) if abs(one) >= NONE * most]
        for n, following in pairwise(moving):
            if values[n] * values[following] > 0.0 or following - n > 2:
                continue
            if following - n == 2:
                yield stations[n + 1]
                continue
            one, other = stations[n], stations[following]

            def rate(travel: float, one: Station = one, other: Station = other) -> float:
                return float(row @ self.rates(self.between(one, other, travel)))

            if rate(one[0]) * rate(other[0]) > 0.0:  # rounding next to where all bars lie in line
                yield one if abs(values[n]) < abs(values[following]) else other
                continue
            travel = float(brentq(rate, one[0], other[0], xtol=FOUND * max(abs(one[0]), abs(other[0]))))
            yield travel, self.between(one, other, travel)

    def change_points(self, stations: Sequence[Station]) -> Iterator[WayPoint]:
        """Where one condition more than elsewhere repeats the others: the linkage could go on otherwise."""
        from scipy.optimize import minimize_scalar  # slow to import

        def left(moved: Matrix) -> Matrix:
            return np.asarray(np.linalg.svd(self.conditions.rows(moved), compute_uv=False))

        values = np.array([left(moved) for _, moved in stations])
        last = int(np.count_nonzero(np.median(values, axis=0) > SINGULAR)) - 1
        least = values[:, last]
        for n in range(1, len(stations) - 1):
            if not (least[n] <= least[n - 1] and least[n] < least[n + 1]) or least[n] > NEAR_SINGULAR:
                continue
            before, after = stations[n - 1], stations[n + 1]
            found = minimize_scalar(
                lambda x, n=n: float(left(self.between(stations[n - 1], stations[n], x))[last]),
                method="bounded",
                bounds=(before[0], after[0]),
                options={"xatol": 1e-10},
            )
            if found.fun < SINGULAR:
                moved = self.between(before, stations[n], float(found.x))
                yield WayPoint("change point", float(found.x), why=self._why(moved))
