"""Conditions that repeat each other, movements that are left, and what lies in line in a dead centre."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from support_exudyn.mechanics.closing import Conditions, repeated_count
from support_exudyn.mechanics.kinetics import Matrix
from support_exudyn.model.linkage import GROUND, Linkage

ZERO = 1e-9  # of conditions and movements, whose numbers are about 1
SEEN = 1e-6  # of the fastest: what moves less stands still
FIELDS = {"slides": "guides"}  # what files call a field of the linkage
DRIVEN = ("actuators", "cranks")
STRAIGHT = 1e-3  # sine of an angle below which two lines are one: dead centres are located to about 1e-5 rad
LOADED = 1e-3  # of the largest force: what bears less bears none
Places = dict[tuple[str, str, str], Matrix]  # of joints of a body: field of the linkage, name, end
SHARED = (
    "how they share a force is not determined by ideal, rigid parts: reported are the least forces that fit; a "
    "bushing or clearance in one of them determines it"
)


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
        names = [f"{FIELDS.get(kind, kind)}.{name}" for kind, name in self.parts]
        joints = listed([name for name, part in zip(names, self.parts, strict=True) if part not in self.driven])
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


@dataclass(frozen=True)
class Movement:
    """A way in which a linkage can move: bodies that move, each with how.

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


def listed(names: Sequence[str]) -> str:
    """Names in a row: a, b and c."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def repeated(conditions: Conditions, moved: Matrix) -> list[RepeatedConditions]:
    """Conditions that follow from others in a posture, each with those that it follows from.

    moved: coordinates counted by arms (n,). Joints come before driven parts, so that these are told only where
    joints alone leave the freedom.
    """
    rows, owners = conditions.rows(moved), conditions.kinetics.owners()
    order = sorted(range(len(owners)), key=lambda row: owners[row][0] in DRIVEN)
    base: list[int] = []
    found = []
    for row in order:
        held = rows[base].reshape(-1, rows.shape[1])
        shares = np.linalg.lstsq(held.T, rows[row], rcond=None)[0] if base else np.zeros(0)
        if np.linalg.norm(rows[row] - held.T @ shares) > ZERO * np.linalg.norm(rows[row]):
            base.append(row)
            continue
        together = [row, *(one for one, share in zip(base, shares, strict=True) if abs(share) > SEEN)]
        parts = list(dict.fromkeys(owners[one] for one in sorted(together)))
        found.append(
            RepeatedConditions(
                parts=parts,
                conditions=sum(owner in parts for owner in owners),
                driven=[part for part in parts if part[0] in DRIVEN and part[1] in conditions.linkage.driven],
            )
        )
    return found


def shared(conditions: Conditions) -> list[str]:
    """Joints whose forces rigid bodies do not determine as a linkage moves, each group in a sentence."""
    if not repeated_count(conditions)[0]:
        return []
    start = np.zeros(3 * len(conditions.linkage.bodies))
    return [f"{one.said()}; {SHARED}" for one in repeated(conditions, start)]


def floating(linkage: Linkage) -> list[list[str]]:
    """Groups of bodies that pins, guides and actuators join to each other, but not to the ground."""
    edges = [(one.first, one.second) for one in linkage.pins.values()]
    edges += [(one.foot, one.head) for one in linkage.actuators.values()]
    edges += [(one.body, one.against) for one in linkage.slides.values()]
    groups: list[set[str]] = [{name} for name in (GROUND, *linkage.bodies)]
    for first, second in edges:
        joined = [group for group in groups if first in group or second in group]
        groups = [group for group in groups if group not in joined] + [set().union(*joined)]
    return [[name for name in linkage.bodies if name in group] for group in groups if GROUND not in group]


def movements(conditions: Conditions, moved: Matrix, rows: Matrix | None = None) -> list[Movement]:
    """Independent ways in which a linkage can move in a posture, each of as few bodies as elimination leaves.

    Arguments:
        conditions: that hold; with those of driven parts these are held.
        moved: coordinates counted by arms (n,).
        rows: in place of those of the conditions (m, n).
    """
    rows = conditions.rows(moved) if rows is None else rows
    return [movement(conditions, moved, rates) for rates in _null_space(rows)]


def movement(conditions: Conditions, moved: Matrix, rates: Matrix) -> Movement:
    """A movement in words, from the rates of all coordinates counted by arms (n,)."""
    rates = rates / np.abs(rates).max()
    speeds = np.abs(rates.reshape(-1, 3)).max(axis=1)
    names = list(conditions.linkage.bodies)
    moving = [name for name, speed in zip(names, speeds, strict=True) if speed > SEEN]
    place, plain = moved / conditions.arms, rates / conditions.arms
    return Movement({name: _how(conditions, place, plain, name) for name in moving}, plain)


def _how(conditions: Conditions, place: Matrix, rates: Matrix, body: str) -> str:
    """How a body moves: about a pin, about a point, or along a direction."""
    i, size = conditions.kinetics.first(body), conditions.size
    speed, spin = rates[i : i + 2], float(rates[i + 2])
    if abs(spin) * size < SEEN * float(np.hypot(*speed)):
        return f"shifts along {math.degrees(math.atan2(speed[1], speed[0])):.4g} degrees"
    centre = np.array(conditions.linkage.bodies[body].centre) + place[i : i + 2]
    pole = centre + np.array([-speed[1], speed[0]]) / spin
    for name, pin in conditions.linkage.pins.items():
        if body in (pin.first, pin.second):
            point = pin.first_point if pin.first == body else pin.second_point
            at = conditions.kinetics.point(place, body, point)[0]
            if float(np.hypot(*(at - pole))) < SEEN * size:
                return f"turns about pin {name}"
    x, y = (round(1e3 * float(one), 6) + 0.0 for one in pole)
    return f"turns about ({x:.4g}, {y:.4g}) mm"


def _null_space(rows: Matrix) -> list[Matrix]:
    """Vectors that rows turn into nothing, by Gauss-Jordan elimination: turns are what is left free."""
    size = rows.shape[1]
    columns = [n for n in range(size) if n % 3 != 2] + [n for n in range(size) if n % 3 == 2]
    left, pivots, row = rows[:, columns].copy(), list[int](), 0
    for column in range(size):
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
        row += 1
    found = []
    for free in (column for column in range(size) if column not in pivots):
        vector = np.zeros(size)
        vector[columns[free]] = 1.0
        for n, pivot in enumerate(pivots):
            vector[columns[pivot]] = -left[n, free]
        found.append(vector)
    return found


# --- dead centres ---


def in_line(conditions: Conditions, moved: Matrix, rows: Matrix) -> tuple[str, Movement]:
    """What lies in line in a dead centre, and how the linkage can move there although it is held.

    The least singular value of the conditions gives the movement, and forces that hold each other; bodies that
    bear them at two points, and actuators, lie along them.

    Arguments:
        moved: coordinates counted by arms (n,). rows: the conditions, driven parts held (m, n).

    Returns words, empty if nothing lies in line, such as "coupler in line with rocker".
    """
    left, _, right = np.linalg.svd(rows)
    size = rows.shape[1]
    loose = movement(conditions, moved, right[-1])
    forces = left[:, size - 1] if len(rows) >= size else np.zeros(len(rows))
    place = moved / conditions.arms
    loaded = {
        owner
        for owner, force in zip(conditions.kinetics.owners(), forces, strict=True)
        if abs(force) > LOADED * np.abs(forces).max(initial=0.0)
    }
    points = {
        body: {joint: at for joint, at in found.items() if joint[:2] in loaded}
        for body, found in _points(conditions, place).items()
    }
    lines: dict[str, Places] = {
        body: found
        for body, found in points.items()
        if len(found) == 2 and body in loose.bodies and np.ptp(list(found.values()), axis=0).max() > 0.0
    }
    for kind, name in loaded:
        if kind == "actuators":
            one = conditions.linkage.actuators[name]
            ends = ((one.foot, one.foot_point, "foot"), (one.head, one.head_point, "head"))
            lines[name] = {
                (kind, name, end): conditions.kinetics.point(place, body, point)[0] for body, point, end in ends
            }
    said = [
        f"{first} in line with {second}"
        for n, first in enumerate(lines)
        for second in list(lines)[n + 1 :]
        if set(lines[first]) & set(lines[second]) and _parallel(lines[first], lines[second])
    ]
    guides = {
        name: slide
        for name, slide in conditions.linkage.slides.items()
        if ("slides", name) in loaded and slide.body in loose.bodies
    }
    said += [
        f"{body} across guide {name}"
        for body, line in lines.items()
        for name, slide in guides.items()
        if set(line) & set(points[slide.body]) and _across(conditions, place, line, name)
    ]
    return " and ".join(said), loose


def _points(conditions: Conditions, place: Matrix) -> dict[str, Places]:
    """By body, where its pins, ends of actuators and guides are, each by field, name and end."""
    linkage, kinetics = conditions.linkage, conditions.kinetics
    found: dict[str, Places] = {name: {} for name in (GROUND, *linkage.bodies)}
    for name, pin in linkage.pins.items():
        for body, point in ((pin.first, pin.first_point), (pin.second, pin.second_point)):
            found[body]["pins", name, ""] = kinetics.point(place, body, point)[0]
    for name, one in linkage.actuators.items():
        found[one.foot]["actuators", name, "foot"] = kinetics.point(place, one.foot, one.foot_point)[0]
        found[one.head]["actuators", name, "head"] = kinetics.point(place, one.head, one.head_point)[0]
    for name, slide in linkage.slides.items():
        found[slide.body]["slides", name, ""] = kinetics.point(place, slide.body, slide.point)[0]
    return found


def _direction(line: Places) -> Matrix:
    first, second = line.values()
    way: Matrix = second - first
    return way / float(np.hypot(*way))


def _parallel(one: Places, other: Places) -> bool:
    (x, y), (u, v) = _direction(one), _direction(other)
    return bool(abs(x * v - y * u) < STRAIGHT)


def _across(conditions: Conditions, place: Matrix, line: Places, name: str) -> bool:
    slide = conditions.linkage.slides[name]
    carried = 0.0 if slide.against == GROUND else place[conditions.kinetics.first(slide.against) + 2]
    x, y = _direction(line)
    return bool(
        abs(x * math.cos(slide.direction + carried) + y * math.sin(slide.direction + carried)) < STRAIGHT
    )
