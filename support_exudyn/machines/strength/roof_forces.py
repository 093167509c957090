"""Postures over the used height, the roof force that actuators hold there, and what pins carry under it.

Ideal pins, massless actuators. A roof force presses at x on the canopy with the vertical part Q and, where the
roof rubs, the horizontal part mu Q. Equilibrium C^T L + w + f = 0 (C: Jacobian of all that is held, w: weight)
is linear in Q and in the moment Q x, so all forces are

    L = L_w + Q L_Q + Q x L_x

By virtual work a pair of actuator forces gives Q and Q x: two equations, two unknowns.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np

from support_exudyn.machines.check.drive_way import Search
from support_exudyn.machines.check.statics import GRAVITY, Array
from support_exudyn.machines.four_bar_shield import FourBarShield
from support_exudyn.machines.machine_data import MachineData
from support_exudyn.mechanics.closing import Conditions
from support_exudyn.mechanics.kinetics import kinetics_of
from support_exudyn.mechanics.postures import laid_out
from support_exudyn.model.linkage import GROUND, Linkage
from user_forces.values.value import InputError

SINGULAR = 1e-9  # of the largest singular value of C: below, forces have no bound
SLACK = 1e-9  # of the largest force: by so much a corner may miss a limit by rounding


class Limits(NamedTuple):
    """What an actuator can do: its least and its largest push [N]; a pull is a negative push."""

    low: float
    high: float


class RoofForce(NamedTuple):
    """A resultant of the roof: its vertical part, downwards [N], and where it presses, x of the ground [m].

    A force of next to nothing has no place; it is told as that of the rear end.
    """

    force: float
    x: float


class RoofContact(NamedTuple):
    """Where the roof lies on the canopy: x of its rear and front end, and y of it [m]."""

    rear: float
    front: float
    height: float


class UsedPosture(NamedTuple):
    """A posture: by how much the legs are longer than at the start [m], and the linkage laid out there."""

    stroke: float
    linkage: Linkage


def legs_of(linkage: Linkage) -> tuple[str, ...]:
    """Names of the actuators that stand on the ground: legs and columns; the others are rams."""
    return tuple(name for name, one in linkage.actuators.items() if one.foot == GROUND)


def used_postures(data: MachineData, count: int) -> list[UsedPosture]:
    """Postures evenly over the used stroke, from the lowest on.

    A shield support goes as its drives lead it, with legs or columns that extend alike (the ram of a two-leg
    shield keeps the canopy level). In any other machine all actuators on the ground extend alike and the others
    keep their lengths; without a stroke it has its start posture alone.

    Raises InputError if the linkage does not go so far.
    """
    machine, linkage = data.machine, data.machine.linkage()
    legs, stroke, led = legs_of(linkage), data.stroke, linkage
    if isinstance(machine, FourBarShield):
        stroke, led = machine.usual_stroke if stroke is None else stroke, machine.led_linkage()
    if stroke is None or not legs:
        return [UsedPosture(0.0, linkage)]
    conditions, closed = Conditions(led), kinetics_of(linkage)
    start = (0.0, conditions.still)
    stations = [start, *Search(conditions, legs).march(start, stroke, count - 1)]
    if stations[-1][0] != stroke:
        raise InputError(
            f"stroke = {stroke:.6g} m: the linkage locks before; allowed: up to {stations[-1][0]:.4g} m"
        )
    return [UsedPosture(travel, laid_out(closed, moved / conditions.arms)) for travel, moved in stations]


class RoofStatics:
    """Forces in one posture under a roof force and the weight.

    Arguments:
        linkage: laid out in that posture.
        canopy: name of the body that carries the roof.
        friction: mu, horizontal part of the roof force by its vertical one, positive forward.

    Raises InputError where rigid parts do not determine the forces.
    """

    def __init__(self, linkage: Linkage, canopy: str, friction: float = 0.0) -> None:
        self.linkage, self.canopy, self.friction = linkage, canopy, friction
        self.contact = _contact_of(linkage, canopy)
        kinetics = kinetics_of(linkage)
        still = np.zeros(3 * len(linkage.bodies))
        rows = kinetics.rows(still)
        sizes = np.linalg.svd(rows, compute_uv=False)
        if rows.shape[0] != rows.shape[1] or sizes[-1] < SINGULAR * sizes[0]:
            raise InputError(
                f"machine: {rows.shape[0]} conditions hold bodies that can move in {rows.shape[1]} ways, "
                "or it stands in a dead centre, so statics does not give its forces; allowed: machines whose "
                "driven actuators just hold them"
            )
        i = kinetics.first(canopy)
        centre = linkage.bodies[canopy].centre
        press, shift = np.zeros(still.size), np.zeros(still.size)
        arm = self.contact.height - centre[1]
        press[i : i + 3] = friction, -1.0, centre[0] - friction * arm
        shift[i + 2] = -1.0
        self._parts = np.linalg.solve(rows.T, -np.column_stack([kinetics.weight(GRAVITY), press, shift]))
        self._first = 2 * len(linkage.pins)

    @property
    def actuators(self) -> dict[str, Array]:
        """Of each actuator its push under weight [N], and by what it grows with Q [-] and with Q x [1/m]."""
        return {name: self._parts[self._first + n] for n, name in enumerate(self.linkage.actuators)}

    def all_forces(self, roof: RoofForce) -> Array:
        """L under a roof force (rows,) [N]: two a pin, of the first body on the second, then pushes."""
        found: Array = self._parts @ np.array([1.0, roof.force, roof.force * roof.x])
        return found

    def pins(self, roof: RoofForce) -> dict[str, Array]:
        """Forces of pins by name, of the first body on the second, (2,) [N]."""
        found = self.all_forces(roof)
        return {name: found[2 * n : 2 * n + 2] for n, name in enumerate(self.linkage.pins)}

    def balancing(self, pushes: Mapping[str, float]) -> RoofForce | None:
        """The roof force that two actuators hold with these pushes [N]; None if none does."""
        matrix = np.array([part[1:] for part in self.actuators.values()])
        right = np.array([pushes[name] - part[0] for name, part in self.actuators.items()])
        if np.linalg.cond(matrix) > 1.0 / SINGULAR:
            return None
        force, moment = np.linalg.solve(matrix, right).tolist()
        return self._told(force, moment, float(np.abs(right).max()))

    def largest_at(self, x: float, limits: Mapping[str, Limits]) -> float:
        """The largest roof force at x [m] that all actuators hold within their limits [N]; 0 if none."""
        most = math.inf
        for name, (weight, press, shift) in self.actuators.items():
            rate = press + shift * x
            limit = limits[name].high if rate > 0.0 else limits[name].low
            if abs(rate) > SLACK * (abs(press) + abs(shift * x)):
                most = min(most, (limit - weight) / rate)
        return max(float(most), 0.0)

    def corners(self, limits: Mapping[str, Limits]) -> list[RoofForce]:
        """Corners of the set of all roof forces on the canopy that actuators hold within their limits.

        Every force in a pin is a convex function of (Q, Q x), so that it is largest at a corner.
        """
        # each row: a Q + b Q x <= c
        rows: list[tuple[float, float, float]] = [
            (-1.0, 0.0, 0.0),
            (self.contact.rear, -1.0, 0.0),
            (-self.contact.front, 1.0, 0.0),
        ]
        for name, (weight, press, shift) in self.actuators.items():
            rows += [(press, shift, limits[name].high - weight), (-press, -shift, weight - limits[name].low)]
        most = max(abs(limit) for _, _, limit in rows)
        slack = SLACK * most * (1.0 + max(abs(self.contact.rear), abs(self.contact.front)))
        found, table = [], np.array(rows)
        for pair in combinations(table, 2):
            left, right = np.array(pair)[:, :2], np.array(pair)[:, 2]
            if np.linalg.cond(left) > 1.0 / SINGULAR:
                continue
            force, moment = np.linalg.solve(left, right)
            if np.all(table[:, 0] * force + table[:, 1] * moment <= table[:, 2] + slack):
                found.append(self._told(float(force), float(moment), most))
        return found

    def _told(self, force: float, moment: float, size: float) -> RoofForce:
        if abs(force) <= SLACK * size:
            return RoofForce(0.0, self.contact.rear)
        return RoofForce(force, moment / force)


def _contact_of(linkage: Linkage, canopy: str) -> RoofContact:
    """Where the roof lies: from the rearmost to the foremost joint or traced point of the canopy, and how high.

    Raises InputError if there is no such body, or if it has not two places that lie apart.
    """
    if canopy not in linkage.bodies:
        raise InputError(
            f"strength.canopy = {canopy!r}: no such body; allowed: {', '.join(linkage.bodies) or 'none'}"
        )
    places = [one.point for one in linkage.points.values() if one.body == canopy]
    for (part, _), sides in linkage.joints.items():
        places += [point for body, point in sides if body == canopy and part != "slides"]
    xs = [x for x, _ in places]
    if not xs or max(xs) <= min(xs):
        raise InputError(
            f"bodies.{canopy}: its joints and traced points lie at one x, so nothing tells where the roof lies"
            "; allowed: two that lie apart, such as a traced point at its tip"
        )
    return RoofContact(min(xs), max(xs), max(y for _, y in places))
