"""Conditions that repeat each other, movements that are left, and what lies in line in a dead centre."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from support_exudyn.mechanics.closing import DRIVEN, Conditions, repeated_count
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import GROUND, Linkage

ZERO = 1e-9  # of conditions and movements, whose numbers are about 1
SEEN = 1e-6  # of the fastest: what moves less stands still
FIELDS = {"slides": "guides"}  # what files call a field of the linkage
STRAIGHT = 1e-3  # sine of an angle below which two lines are one: dead centres are located to about 1e-5 rad
LOADED = 1e-3  # of the largest force: what bears less bears none
SHARED = (
    "how they share a force is not determined by ideal, rigid parts: reported are the least forces that fit; a "
    "bushing or clearance in one of them determines it"
)


def listed(names: Sequence[str]) -> str:
    """Names in a row: a, b and c."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


# --- conditions that repeat each other ---


@dataclass(frozen=True)
class RepeatedConditions:
    """Joints and driven parts one of whose conditions follows from the others.

    Arguments:
        parts: each by its field of the linkage and its name.
        conditions: how many they have together.
        driven: those of them that are driven.
    """

    parts: Sequence[tuple[str, str]]
    conditions: int
    driven: Sequence[tuple[str, str]]

    def said(self) -> str:
        """Which joints repeat each other, or which drives fight, in a sentence."""
        joints = listed(
            [f"{FIELDS.get(kind, kind)}.{n}" for kind, n in self.parts if (kind, n) not in self.driven]
        )
        driven = [f"{kind}.{name}" for kind, name in self.driven]
        if len(driven) > 1:
            return (
                f"{listed(driven)}: one drive too many, for they drive the same freedom"
                + (f", through {joints}" if joints else "")
                + "; free one of them, or let it follow with a motion that fits"
            )
        if driven:
            return f"{driven[0]}: what it drives is held already, by {joints}"
        return f"{joints}: one of their {self.conditions} conditions repeats the others"


def repeated(conditions: Conditions, moved: Matrix) -> list[RepeatedConditions]:
    """Conditions that follow from others in a posture, each with those that it follows from.

    moved: coordinates counted by arms (n,). Joints come before driven parts, so that these are reported only
    where joints alone leave the freedom.
    """
    rows, owners = conditions.rows(moved), conditions.kinetics.owners()
    base: list[int] = []
    found = []
    for row in sorted(range(len(owners)), key=lambda row: owners[row][0] in DRIVEN):
        held = rows[base].reshape(-1, rows.shape[1])
        shares = np.linalg.lstsq(held.T, rows[row], rcond=None)[0] if base else np.zeros(0)
        if np.linalg.norm(rows[row] - held.T @ shares) > ZERO * np.linalg.norm(rows[row]):
            base.append(row)
            continue
        together = [row, *(one for one, share in zip(base, shares, strict=True) if abs(share) > SEEN)]
        parts = list(dict.fromkeys(owners[one] for one in sorted(together)))
        driven = [part for part in parts if part[0] in DRIVEN and part[1] in conditions.linkage.driven]
        found.append(RepeatedConditions(parts, sum(owner in parts for owner in owners), driven))
    return found


def shared(conditions: Conditions) -> list[str]:
    """Joints whose forces rigid bodies do not determine as a linkage moves, each group in a sentence."""
    if not repeated_count(conditions)[0]:
        return []
    return [f"{one.said()}; {SHARED}" for one in repeated(conditions, conditions.still)]


# --- movements ---


@dataclass(frozen=True)
class Movement:
    """A way in which a linkage can move.

    Arguments:
        bodies: how each moves that does, by name.
        rates: of all coordinates (3 bodies,) [m], [rad], the fastest point of a body by 1.
    """

    bodies: dict[str, str]
    rates: Matrix

    def said(self) -> str:
        """The bodies that move and how, in words."""
        return ", ".join(f"{name} {how}" for name, how in self.bodies.items())

    def data(self) -> dict[str, Any]:
        """The movement as plain data."""
        return {"bodies": self.bodies, "rates": self.rates.tolist()}


def floating(linkage: Linkage) -> list[list[str]]:
    """Groups of bodies that pins, guides and actuators join to each other, but not to the ground."""
    groups: list[set[str]] = [{name} for name in (GROUND, *linkage.bodies)]
    for (first, _), (second, _) in linkage.joints.values():
        joined = [group for group in groups if group & {first, second}]
        groups = [group for group in groups if group not in joined] + [set().union(*joined)]
    return [[name for name in linkage.bodies if name in group] for group in groups if GROUND not in group]


def movements(conditions: Conditions, moved: Matrix) -> list[Movement]:
    """Independent ways in which a linkage can move, each of as few bodies as elimination leaves.

    By Gauss-Jordan elimination of the conditions; turns of bodies are what is left free.

    Arguments:
        conditions: that hold; with those of driven parts these are held.
        moved: coordinates counted by arms (n,).
    """
    rows = conditions.rows(moved)
    size = rows.shape[1]
    columns = sorted(range(size), key=lambda n: n % 3 == 2)
    left, pivots = rows[:, columns], list[int]()
    for column in range(size):
        row = len(pivots)
        if row == len(left):
            break
        best = row + int(np.argmax(np.abs(left[row:, column])))
        if abs(left[best, column]) < ZERO:
            continue
        left[[row, best]] = left[[best, row]]
        left[row] /= left[row, column]
        others = np.arange(len(left)) != row
        left[others] -= np.outer(left[others, column], left[row])
        pivots.append(column)
    found = []
    for free in (column for column in range(size) if column not in pivots):
        rates = np.zeros(size)
        rates[columns[free]] = 1.0
        rates[[columns[pivot] for pivot in pivots]] = -left[: len(pivots), free]
        rates /= np.abs(rates).max()
        bodies = {name: _how(conditions, moved, rates, name) for name in _moving(conditions, rates)}
        found.append(Movement(bodies, rates / conditions.arms))
    return found


def _moving(conditions: Conditions, rates: Matrix) -> list[str]:
    """Bodies that move at rates counted by arms (n,), the largest of which is about 1."""
    speeds = np.abs(rates.reshape(-1, 3)).max(axis=1)
    return [name for name, speed in zip(conditions.linkage.bodies, speeds, strict=True) if speed > SEEN]


def _how(conditions: Conditions, moved: Matrix, rates: Matrix, body: str) -> str:
    """How a body moves: about a pin, about a point, or along a direction."""
    i, kinetics = conditions.kinetics.first(body), conditions.kinetics
    place, (vx, vy, spin) = moved / conditions.arms, (rates / conditions.arms)[i : i + 3].tolist()
    if abs(spin) * conditions.size < SEEN * math.hypot(vx, vy):
        return f"shifts along {math.degrees(math.atan2(vy, vx)):.4g} degrees"
    pole = kinetics.point(place, body, conditions.linkage.bodies[body].centre)[0] + np.array([-vy, vx]) / spin
    for name, pin in conditions.linkage.pins.items():
        point = dict(pin.sides).get(body)
        if point and math.dist(kinetics.point(place, body, point)[0], pole) < SEEN * conditions.size:
            return f"turns about pin {name}"
    x, y = (round(1e3 * float(one), 6) + 0.0 for one in pole)
    return f"turns about ({x:.4g}, {y:.4g}) mm"


# --- dead centres ---


def in_line(conditions: Conditions, moved: Matrix, rows: Matrix) -> str:
    """What lies in line in a dead centre, in words such as "coupler in line with rocker"; empty: nothing.

    The least singular value of the conditions gives the movement, and forces that hold each other; bodies that
    bear them at two points, and actuators, lie along them.

    Arguments:
        moved: coordinates counted by arms (n,). rows: the conditions, driven parts held (m, n).
    """
    linkage, motion = conditions.linkage, conditions.kinetics.motion(moved / conditions.arms)
    left, _, right = np.linalg.svd(rows)
    size = rows.shape[1]
    loose = _moving(conditions, right[-1] / np.abs(right[-1]).max())
    forces = left[:, size - 1] if len(rows) >= size else np.zeros(len(rows))
    bearing = np.abs(forces) > LOADED * np.abs(forces).max(initial=0.0)
    owners = conditions.kinetics.owners()
    loaded = dict.fromkeys(owner for owner, bears in zip(owners, bearing, strict=True) if bears)
    # by body, and by actuator, places (2,) at which it bears a force, by joint and end
    points: dict[str, dict[tuple[str, str], Matrix]] = {name: {} for name in (GROUND, *linkage.bodies)}
    struts: dict[str, dict[tuple[str, str], Matrix]] = {}
    for part, name in loaded:
        for n, (body, point) in enumerate(linkage.joints.get((part, name), ())):
            end = name, part if part == "pins" else f"{part}{n}"
            if part != "slides" or n == 0:
                points[body][end] = motion.place(body, point)[0]
            if part == "actuators":
                struts.setdefault(name, {})[end] = points[body][end]
    ends = {body: points[body] for body in linkage.bodies if body in loose and len(points[body]) == 2} | struts
    ways = {name: np.subtract(*reversed(line.values())) for name, line in ends.items()}
    lines = {name: way / np.hypot(*way) for name, way in ways.items() if np.any(way)}
    words = [
        f"{first} in line with {second}"
        for first, second in combinations(lines, 2)
        if ends[first].keys() & ends[second].keys()
        and abs(lines[first][0] * lines[second][1] - lines[first][1] * lines[second][0]) < STRAIGHT
    ]
    for body, line in lines.items():
        for part, name in loaded:
            slide = linkage.slides[name] if part == "slides" else None
            if slide is None or slide.body not in loose or not ends[body].keys() & points[slide.body].keys():
                continue
            if abs(float(line @ motion.sliding(slide)[0][0])) < STRAIGHT:
                words.append(f"{body} across guide {name}")
    return " and ".join(words)
