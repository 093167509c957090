"""The way of driven parts while the others are held: postures, dead centres, where parts turn back."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
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
        conditions: of `closing.conditions_of`, which hold as the linkage is moved.
        linkage: whose forces are computed; its bodies are those of the conditions.
        drives: names of the driven parts; several actuators extend alike.
        goal: ends of the travel that are tried [rad], [m], at most 0 and at least 0.
        steps: postures to each end.
        loads: that act besides the weight, by name.
        farther: how far beyond both ends a dead centre is searched for [m].
    """
    start = np.zeros(3 * len(linkage.bodies))
    up = list(_march(conditions, drives, (0.0, goal[1]), start, steps))
    reached = up[-1][0] if up else 0.0
    down: list[tuple[float, Matrix]] = []
    if not (drives[0] in linkage.cranks and goal[1] and reached == goal[1]):
        down = list(_march(conditions, drives, (0.0, goal[0]), start, steps))
    ends = down[-1][0] if down else 0.0, reached
    stations = [*down[::-1], (0.0, start), *up]
    rates = [_rates(conditions, stations, n, drives) for n in range(len(stations))]
    locked = [end for end, asked, tried in zip(ends, goal, (down, up), strict=True) if tried and end != asked]
    points = [_dead_centre(conditions, end, stations) for end in locked]
    if goal[1] and not up and not down:
        points.append(_dead_centre(conditions, 0.0, stations))
    inner = [n for n in range(len(stations)) if not any(stations[n][0] == end for end in locked)]
    points += _on_the_way(conditions, drives, [stations[n] for n in inner], [rates[n] for n in inner])
    fastest = np.max([np.abs(one).reshape(-1, 3).max(axis=1) for one in rates], axis=0)
    resting = [GROUND, *(n for n, v in zip(linkage.bodies, fastest, strict=True) if v < STILL * fastest.max())]
    return DriveWay(
        drives=drives,
        linkage=linkage,
        moved=[_station(conditions, linkage, *one, loads) for one in stations],
        goal=goal,
        ends=ends,
        points=sorted(points, key=lambda one: one.travel),
        beyond=(
            _beyond(conditions, drives, stations[0], -farther),
            _beyond(conditions, drives, stations[-1], farther),
        ),
        resting=resting,
        reach=_reach(linkage, drives, resting),
    )


def _beyond(
    conditions: Conditions, drives: tuple[str, ...], last: tuple[float, Matrix], farther: float
) -> WayPoint | None:
    """The dead centre that lies at most so far [m] beyond a posture; None if there is none."""
    travel, moved = last
    found = list(_march(conditions, drives, (travel, travel + farther), moved, STEPS_BEYOND))
    if not farther or (found and found[-1][0] == travel + farther):
        return None
    end, there = found[-1] if found else last
    return WayPoint("dead centre", end, why=in_line(conditions, there, conditions.rows(there))[0])


def _station(
    conditions: Conditions, linkage: Linkage, travel: float, moved: Matrix, loads: Mapping[str, ActingLoad]
) -> Moved:
    position = moved / conditions.arms
    return Moved(travel, position, statics(linkage, position, loads=loads))


def _march(
    conditions: Conditions, drives: tuple[str, ...], way: tuple[float, float], start: Matrix, steps: int
) -> Iterator[tuple[float, Matrix]]:
    """Travel and coordinates, step by step as far as the linkage closes on the same way."""
    first, goal = way
    moved, reached, along = start, first, None
    for number in range(1, steps + 1 if goal != first else 0):
        wanted, before = first + (goal - first) * (number / steps), moved  # the last is the goal to the bit
        moved, share = moved_on(conditions, before, dict.fromkeys(drives, wanted), along)
        along = moved - before
        if share < 1.0:
            if share > 0.0:
                yield reached + share * (wanted - reached), moved
            return
        yield wanted, moved
        reached = wanted


def _rows(conditions: Conditions, drives: tuple[str, ...]) -> list[int]:
    kind = "cranks" if drives[0] in conditions.linkage.cranks else "actuators"
    return [conditions.kinetics.owners().index((kind, name)) for name in drives]


def _rates(
    conditions: Conditions, stations: list[tuple[float, Matrix]], number: int, drives: tuple[str, ...]
) -> Matrix:
    """Rates of all coordinates at a station, counted by arms, per rate of the drives (n,); 0 if it locks."""
    rows, ahead = _rows(conditions, drives), np.zeros(len(conditions.counts))
    ahead[rows] = conditions.counts[rows]
    before, after = stations[max(number - 1, 0)], stations[min(number + 1, len(stations) - 1)]
    along = None if after[0] == before[0] else (after[1] - before[1]) / (after[0] - before[0])
    found = tangent(conditions, stations[number][1], ahead, along)
    return np.zeros(stations[0][1].size) if found is None else found


def _dead_centre(conditions: Conditions, end: float, stations: list[tuple[float, Matrix]]) -> WayPoint:
    moved = next(moved for travel, moved in stations if travel == end)
    return WayPoint("dead centre", end, why=in_line(conditions, moved, conditions.rows(moved))[0])


def _on_the_way(
    conditions: Conditions,
    drives: tuple[str, ...],
    stations: list[tuple[float, Matrix]],
    rates: list[Matrix],
) -> Iterator[WayPoint]:
    """Where parts on the ground turn back, and where the linkage could go on otherwise."""
    (first, *others), fastest = _rows(conditions, drives), float(np.max(np.abs(rates)))
    for part, row in _outputs(conditions, drives).items():

        def speed(moved: Matrix, row: Matrix = row) -> float:
            return float(row @ _rates(conditions, [(0.0, moved)], 0, drives))

        speeds = [float(row @ one) for one in rates]
        if max(map(abs, speeds)) < STILL * fastest:
            continue
        for travel, moved in _zeros(conditions, drives, stations, speeds, speed):
            rows = conditions.rows(moved)
            rows[others] -= rows[first]  # what is driven alike stays so
            rows[first] = row  # the part that turns back held in place of the drive
            yield WayPoint("turns back", travel, part, in_line(conditions, moved, rows)[0])
    yield from _change_points(conditions, drives, stations)


def _change_points(
    conditions: Conditions, drives: tuple[str, ...], stations: list[tuple[float, Matrix]]
) -> Iterator[WayPoint]:
    """Where one condition more than elsewhere repeats the others: the linkage could go on otherwise."""
    from scipy.optimize import minimize_scalar  # slow to import

    values = np.array([np.linalg.svd(conditions.rows(moved), compute_uv=False) for _, moved in stations])
    rank = int(np.count_nonzero(np.median(values, axis=0) > SINGULAR))
    least = values[:, rank - 1]
    for n in range(1, len(stations) - 1):
        if not (least[n] <= least[n - 1] and least[n] < least[n + 1]) or least[n] > NEAR_SINGULAR:
            continue

        def at(x: float, n: int = n) -> Matrix:
            moved = stations[n - 1][1]
            along = stations[n][1] - moved
            return moved_on(conditions, moved, dict.fromkeys(drives, x), along)[0]

        found = minimize_scalar(
            lambda x: float(np.linalg.svd(conditions.rows(at(x)), compute_uv=False)[rank - 1]),
            bounds=(stations[n - 1][0], stations[n + 1][0]), method="bounded", options={"xatol": 1e-10},
        )  # fmt: skip
        if found.fun < SINGULAR:
            rows = conditions.rows(at(float(found.x)))
            yield WayPoint("change point", float(found.x), why=in_line(conditions, at(float(found.x)), rows)[0])


def _outputs(conditions: Conditions, drives: tuple[str, ...]) -> dict[str, Matrix]:
    """Rows that give the rate of what is pinned to the ground or slides on it, but for the driven part."""
    linkage, size = conditions.linkage, 3 * len(conditions.linkage.bodies)
    rows: dict[str, Matrix] = {}
    own = linkage.cranks[drives[0]].body if drives[0] in linkage.cranks else ""
    for pin in linkage.pins.values():
        if GROUND in (pin.first, pin.second):
            body = pin.second if pin.first == GROUND else pin.first
            rows[body] = conditions.kinetics.turning(size, body) / conditions.arms
    for slide in linkage.slides.values():
        if slide.against == GROUND and slide.body not in rows:
            row = np.zeros(size)
            first = conditions.kinetics.first(slide.body)
            row[first : first + 2] = math.cos(slide.direction), math.sin(slide.direction)
            rows[slide.body] = row
    return {body: conditions.size * row for body, row in rows.items() if body != own}


def _zeros(
    conditions: Conditions,
    drives: tuple[str, ...],
    stations: list[tuple[float, Matrix]],
    values: Sequence[float],
    value: Callable[[Matrix], float],
) -> Iterator[tuple[float, Matrix]]:
    """Travels and postures at which a value passes zero."""
    from scipy.optimize import brentq  # slow to import

    most = max(map(abs, values), default=0.0)
    if not most > 0.0 or max(values) - min(values) < NONE * most:
        return
    still = [abs(one) < NONE * most for one in values]
    closed = math.isclose(stations[-1][0] - stations[0][0], TURN, rel_tol=1e-12) and (
        drives[0] in conditions.linkage.cranks
    )
    for n, (travel, moved) in enumerate(stations):
        if still[n]:
            before = n - 1 if n else (len(stations) - 2 if closed else -1)
            if before >= 0 and n + 1 < len(stations) and values[before] * values[n + 1] < 0.0:
                yield travel, moved
        elif n + 1 < len(stations) and not still[n + 1] and values[n] * values[n + 1] < 0.0:
            ahead, along = stations[n + 1][0], stations[n + 1][1] - moved

            def on_the_way(
                x: float, travel: float = travel, moved: Matrix = moved, along: Matrix = along
            ) -> Matrix:
                return moved_on(conditions, moved, dict.fromkeys(drives, x), along)[0]

            def rate(x: float, way: Callable[[float], Matrix] = on_the_way) -> float:
                return value(way(x))

            if rate(travel) * rate(ahead) > 0.0:  # rounding next to where all bars lie in line
                yield (travel, moved) if abs(values[n]) < abs(values[n + 1]) else stations[n + 1]
                continue
            found = float(brentq(rate, travel, ahead, xtol=FOUND * max(abs(travel), abs(ahead))))
            yield found, on_the_way(found)


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
