"""The way of driven parts while the others are held: postures, dead centres, where parts turn back."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
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
    """A point of a way that is worth telling.

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


@dataclass(frozen=True)
class DriveWay:
    """How far driven parts move a linkage while the other driven parts are held.

    Arguments:
        drives: names of the driven parts; several actuators extend alike.
        linkage: in its start posture.
        moved: postures in the order of their travel.
        goal: ends of the travel that were tried, downwards and upwards [rad], [m].
        ends: ends of the travel that were reached.
        points: dead centres and others, in the order of their travel.
        beyond: dead centres beyond both ends, the lower and the upper; None where none is near.
        resting: bodies that the driven parts do not move, among them the ground.
        reach: from the driven parts to each body that they move: how many joints lie between.
    """

    drives: tuple[str, ...]
    linkage: Linkage
    moved: Sequence[Moved] = field(repr=False)
    goal: tuple[float, float]
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
        still = np.zeros((len(self.moved), 3 * len(self.linkage.bodies)))
        return BodyMotion(self.linkage, np.array([one.position for one in self.moved]), still)

    def data(self) -> dict[str, Any]:
        """The way as plain data, SI and radians."""
        points = [
            {"what": one.what, "travel": one.travel, "value": self.start + one.travel, "part": one.part,
             "in_line": one.why}
            for one in self.points
        ]  # fmt: skip
        return {
            "start": self.start,
            "travel": list(self.ends),
            "locks": self.locks,
            "turns_right_round": self.right_round,
            "points": points,
            "dead_centres_beyond": [
                None if one is None else {"travel": one.travel, "in_line": one.why} for one in self.beyond
            ],
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
    route = _Route(conditions, drives, [(0.0, conditions.still)])
    up = list(route.march((0.0, goal[1]), conditions.still, steps))
    reached = up[-1][0] if up else 0.0
    down: list[Station] = []
    if not (drives[0] in linkage.cranks and goal[1] and reached == goal[1]):
        down = list(route.march((0.0, goal[0]), conditions.still, steps))
    route = _Route(conditions, drives, [*down[::-1], (0.0, conditions.still), *up])
    ends = down[-1][0] if down else 0.0, reached
    locked = [end for end, asked, tried in zip(ends, goal, (down, up), strict=True) if tried and end != asked]
    if goal[1] and not up and not down:
        locked = [0.0]
    points = [route.dead_centre(one) for one in route.stations for end in locked if one[0] == end]
    rates = [route.rates(n) for n in range(len(route.stations))]
    inner = [n for n, (travel, _) in enumerate(route.stations) if travel not in locked or (not up and not down)]
    within = _Route(conditions, drives, [route.stations[n] for n in inner])
    points += within.turning_back([rates[n] for n in inner])
    points += within.change_points()
    fastest = np.max([np.abs(one).reshape(-1, 3).max(axis=1) for one in rates], axis=0)
    resting = [GROUND, *(n for n, v in zip(linkage.bodies, fastest, strict=True) if v < STILL * fastest.max())]
    positions = [(travel, moved / conditions.arms) for travel, moved in route.stations]
    return DriveWay(
        drives=drives,
        linkage=linkage,
        moved=[Moved(travel, at, statics(linkage, at, loads=loads)) for travel, at in positions],
        goal=goal,
        ends=ends,
        points=sorted(points, key=lambda one: one.travel),
        beyond=(route.beyond(route.stations[0], -farther), route.beyond(route.stations[-1], farther)),
        resting=resting,
        reach=_reach(linkage, drives, resting),
    )


@dataclass(frozen=True)
class _Route:
    """Postures of a linkage in the order of the travel of its driven parts, each with its travel."""

    conditions: Conditions
    drives: tuple[str, ...]
    stations: Sequence[Station]

    def march(self, way: tuple[float, float], start: Matrix, steps: int) -> Iterator[Station]:
        """Postures step by step, from one travel to another, as far as the linkage closes on the same way."""
        first, goal = way
        moved, reached, along = start, first, None
        for number in range(1, steps + 1 if goal != first else 0):
            wanted, before = first + (goal - first) * (number / steps), moved  # the last is the goal to the bit
            moved, share = moved_on(self.conditions, before, dict.fromkeys(self.drives, wanted), along)
            along = moved - before
            if share < 1.0:
                if share > 0.0:
                    yield reached + share * (wanted - reached), moved
                return
            yield wanted, moved
            reached = wanted

    def dead_centre(self, station: Station) -> WayPoint:
        """A posture as a dead centre, with what lies in line there."""
        travel, moved = station
        why = in_line(self.conditions, moved, self.conditions.rows(moved))[0]
        return WayPoint("dead centre", travel, why=why)

    def beyond(self, last: Station, farther: float) -> WayPoint | None:
        """The dead centre that lies at most so far [m] beyond a posture; None if there is none."""
        travel, moved = last
        found = list(self.march((travel, travel + farther), moved, STEPS_BEYOND))
        if not farther or (found and found[-1][0] == travel + farther):
            return None
        return self.dead_centre(found[-1] if found else last)

    def between(self, number: int, travel: float) -> Matrix:
        """The posture at a travel, reached from a station in the direction of the next."""
        start = self.stations[number][1]
        along = self.stations[number + 1][1] - start
        return moved_on(self.conditions, start, dict.fromkeys(self.drives, travel), along)[0]

    @property
    def _rows(self) -> list[int]:
        """Of the driven parts among all conditions."""
        kind = "cranks" if self.drives[0] in self.conditions.linkage.cranks else "actuators"
        return [self.conditions.kinetics.owners().index((kind, name)) for name in self.drives]

    def rates(self, number: int) -> Matrix:
        """Rates of all coordinates at a station, counted by arms, by that of the drives (n,); 0 if it locks."""
        before = self.stations[max(number - 1, 0)]
        after = self.stations[min(number + 1, len(self.stations) - 1)]
        along = None if after[0] == before[0] else (after[1] - before[1]) / (after[0] - before[0])
        return self._rates_at(self.stations[number][1], along)

    def _rates_at(self, moved: Matrix, along: Matrix | None = None) -> Matrix:
        ahead = np.zeros(len(self.conditions.counts))
        ahead[self._rows] = self.conditions.counts[self._rows]
        found = tangent(self.conditions, moved, ahead, along)
        return np.zeros(moved.size) if found is None else found

    def turning_back(self, rates: Sequence[Matrix]) -> Iterator[WayPoint]:
        """Where parts on the ground stand still for a moment; rates: at all stations."""
        (first, *others), fastest = self._rows, float(np.max(np.abs(rates)))
        for part, row in self._outputs().items():
            speeds = [float(row @ one) for one in rates]
            if max(map(abs, speeds)) < STILL * fastest:
                continue
            for travel, moved in self._zeros(speeds, row):
                rows = self.conditions.rows(moved)
                rows[others] -= rows[first]  # what is driven alike stays so
                rows[first] = row  # the part that turns back held in place of the drive
                yield WayPoint("turns back", travel, part, in_line(self.conditions, moved, rows)[0])

    def _outputs(self) -> dict[str, Matrix]:
        """Rows that give the rate of what is pinned to the ground or slides on it, but for the driven part."""
        conditions, linkage = self.conditions, self.conditions.linkage
        rows: dict[str, Matrix] = {}
        own = linkage.cranks[self.drives[0]].body if self.drives[0] in linkage.cranks else ""
        for pin in linkage.pins.values():
            if GROUND in (pin.first, pin.second):
                body = pin.second if pin.first == GROUND else pin.first
                rows[body] = conditions.kinetics.turning(conditions.still.size, body) / conditions.arms
        for slide in linkage.slides.values():
            if slide.against == GROUND and slide.body not in rows:
                row = conditions.still.copy()
                first = conditions.kinetics.first(slide.body)
                row[first : first + 2] = math.cos(slide.direction), math.sin(slide.direction)
                rows[slide.body] = row
        return {body: conditions.size * row for body, row in rows.items() if body != own}

    def _zeros(self, values: Sequence[float], row: Matrix) -> Iterator[Station]:
        """Where the rate that a row gives passes zero; values: at all stations."""
        from scipy.optimize import brentq  # slow to import

        stations = self.stations
        most = max(map(abs, values), default=0.0)
        if not most > 0.0 or max(values) - min(values) < NONE * most:
            return
        still = [abs(one) < NONE * most for one in values]
        closed = math.isclose(stations[-1][0] - stations[0][0], TURN, rel_tol=1e-12) and (
            self.drives[0] in self.conditions.linkage.cranks
        )
        for n, (travel, moved) in enumerate(stations):
            if still[n]:
                before = n - 1 if n else (len(stations) - 2 if closed else -1)
                if before >= 0 and n + 1 < len(stations) and values[before] * values[n + 1] < 0.0:
                    yield travel, moved
            elif n + 1 < len(stations) and not still[n + 1] and values[n] * values[n + 1] < 0.0:
                ahead = stations[n + 1][0]

                def rate(x: float, n: int = n) -> float:
                    return float(row @ self._rates_at(self.between(n, x)))

                if rate(travel) * rate(ahead) > 0.0:  # rounding next to where all bars lie in line
                    yield (travel, moved) if abs(values[n]) < abs(values[n + 1]) else stations[n + 1]
                    continue
                found = float(brentq(rate, travel, ahead, xtol=FOUND * max(abs(travel), abs(ahead))))
                yield found, self.between(n, found)

    def change_points(self) -> Iterator[WayPoint]:
        """Where one condition more than elsewhere repeats the others: the linkage could go on otherwise."""
        from scipy.optimize import minimize_scalar  # slow to import

        def left(moved: Matrix) -> Matrix:
            return np.asarray(np.linalg.svd(self.conditions.rows(moved), compute_uv=False))

        values = np.array([left(moved) for _, moved in self.stations])
        rank = int(np.count_nonzero(np.median(values, axis=0) > SINGULAR))
        least = values[:, rank - 1]
        for n in range(1, len(self.stations) - 1):
            if not (least[n] <= least[n - 1] and least[n] < least[n + 1]) or least[n] > NEAR_SINGULAR:
                continue
            found = minimize_scalar(
                lambda x, n=n: float(left(self.between(n - 1, x))[rank - 1]), method="bounded",
                bounds=(self.stations[n - 1][0], self.stations[n + 1][0]), options={"xatol": 1e-10},
            )  # fmt: skip
            if found.fun < SINGULAR:
                moved = self.between(n - 1, float(found.x))
                why = in_line(self.conditions, moved, self.conditions.rows(moved))[0]
                yield WayPoint("change point", float(found.x), why=why)


def _reach(linkage: Linkage, drives: tuple[str, ...], resting: Sequence[str]) -> dict[str, int]:
    """How many joints lie between the driven parts and each body that they move."""
    edge = [linkage.cranks[name].body for name in drives if name in linkage.cranks]
    struts = [linkage.actuators[name] for name in drives if name in linkage.actuators]
    edge += [body for one in struts for body in (one.foot, one.head)]
    edge, reach = [body for body in edge if body not in resting], dict[str, int]()
    ends = [(one.first, one.second) for one in linkage.pins.values()]
    ends += [(one.first, one.second) for one in linkage.gears.values()]
    ends += [(one.body, one.against) for one in linkage.slides.values()]
    far = 0
    while edge:
        reach |= dict.fromkeys(edge, far)
        following = [other for a, b in ends for one, other in ((a, b), (b, a)) if one in edge]
        edge, far = (
            [one for one in dict.fromkeys(following) if one not in reach and one not in resting],
            far + 1,
        )
    return reach
