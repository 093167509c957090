"""Masses and constraints of a scene as matrices, for what happens at an instant.

Mass matrix M and constraint Jacobian C (ideal pins, rigid actuators, cranks, slides, gears) give the change of
velocities dv and the impulses L under generalised impulses b and a change c of the constraints' rates:

    M dv + C^T L = b,    C dv = c
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.body_coordinates import BodyItem
from support_exudyn.model.linkage import GROUND, Linkage, PinPlace, Slide
from user_forces.values.value import Vector2

Matrix = npt.NDArray[np.float64]
STAND_IN = 0.01  # of mass times the square of the longest arm
REPEATED = 1e-9  # of the largest singular value: below, rows repeat each other


def kinetics_of(
    linkage: Linkage, ideal: Sequence[str] | None = None, rigid: Sequence[str] | None = None
) -> Kinetics:
    """Matrices of a linkage by itself, coordinates in the order of its bodies.

    ideal, rigid: names of the pins that are closed, and of the actuators that are rigid; all by default.
    """
    bodies = {name: BodyItem(body, None, None, 3 * n) for n, (name, body) in enumerate(linkage.bodies.items())}
    pins = tuple(linkage.pins) if ideal is None else ideal
    return Kinetics(linkage, bodies, pins, tuple(linkage.actuators) if rigid is None else rigid)


@dataclass(frozen=True)
class Kinetics:
    """Matrices of a linkage, whose bodies stand in the engine or not.

    linkage: the mechanism. bodies: where each body's coordinates stand. ideal, actuators: names of the pins
    that are closed and of the actuators that are rigid, in the order of their rows.
    """

    linkage: Linkage
    bodies: dict[str, BodyItem]
    ideal: Sequence[str]
    actuators: Sequence[str]

    @cached_property
    def size(self) -> float:
        """The larger of length and height of the linkage at its start [m]; 1 m if all is in one place."""
        places = [body.centre for body in self.linkage.bodies.values()]
        extent = float(np.ptp(places + [place for _, place in joints_of(self.linkage)], axis=0).max())
        return extent if extent > 1e-9 else 1.0

    @cached_property
    def counts(self) -> Matrix:
        """Factor of each row (m,) [m]: angles count by the size of the linkage, and moments by one over it."""
        rows = self.rows(np.zeros(3 * len(self.bodies)))
        only_turns = ~np.any(np.delete(rows, np.s_[2::3], axis=1), axis=1)
        return np.where(only_turns, self.size, 1.0)

    @cached_property
    def stand_in(self) -> Matrix:
        """What stands in for the inertia of point masses where one is divided by it (n,) [kg m^2], else 0."""
        found = np.zeros(3 * len(self.bodies))
        for name, item in self.bodies.items():
            if item.body.inertia == 0.0:
                arms = [
                    math.dist(place, item.body.centre)
                    for body, place in joints_of(self.linkage)
                    if body == name
                ]
                found[item.first + 2] = STAND_IN * item.body.mass * (max(arms, default=0.0) or self.size) ** 2
        return found

    def mass(self) -> Matrix:
        """Diagonal of the mass matrix, shape (n,)."""
        mass = np.zeros(3 * len(self.bodies))
        for item in self.bodies.values():
            body = item.body
            mass[item.first : item.first + 3] = body.mass, body.mass, body.inertia
        return mass

    def weight(self, gravity: Vector2) -> Matrix:
        """Forces of gravity [m/s^2] on all coordinates [N], shape (n,)."""
        along = np.zeros(3 * len(self.bodies))
        for item in self.bodies.values():
            along[item.first : item.first + 2] = gravity
        return self.mass() * along

    def rows(self, position: Matrix) -> Matrix:
        """Jacobian C, (m, n): two rows an ideal pin, one an actuator, crank or gear, one or two a slide."""
        rows: list[Matrix] = []
        for name in self.ideal:
            rows += list(self.relative(position, self.linkage.pins[name])[1])
        for actuator in (self.linkage.actuators[name] for name in self.actuators):
            foot, foot_rate = self.point(position, actuator.foot, actuator.foot_point)
            head, head_rate = self.point(position, actuator.head, actuator.head_point)
            along = (head - foot) / np.linalg.norm(head - foot)
            rows.append(along @ (head_rate - foot_rate))
        rows += [self.turning(position.size, crank.body) for crank in self.linkage.cranks.values()]
        for slide in self.linkage.slides.values():
            rows += self._guided(position, slide)
        for gear in self.linkage.gears.values():
            wheels = gear.first, gear.second, gear.carrier or GROUND
            first, second, carrier = (self.turning(position.size, body) for body in wheels)
            rows.append(second - gear.ratio * first - (1.0 - gear.ratio) * carrier)
        return np.array(rows).reshape(-1, position.size)

    def _guided(self, position: Matrix, slide: Slide) -> list[Matrix]:
        """Rows of a slide: rate of the point's distance from the line, which may turn, and of the angle."""
        point, rate = self.point(position, slide.body, slide.point)
        origin, origin_rate = self.point(position, slide.against, slide.point)
        carrier = self.turning(position.size, slide.against)
        turn = 0.0 if slide.against == GROUND else position[self.bodies[slide.against].first + 2]
        angle = slide.direction + turn
        along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        # as the line turns, what is along it comes to lie across it
        distance = across @ (rate - origin_rate) - (along @ (point - origin)) * carrier
        turning = self.turning(position.size, slide.body) - carrier
        return [distance, turning][: slide.conditions]

    def owners(self) -> list[tuple[str, str]]:
        """Of each of the rows, the field of the linkage and the name of the part that it is of."""
        owners = [("pins", name) for name in self.ideal for _ in range(2)]
        owners += [("actuators", name) for name in self.actuators]
        owners += [("cranks", name) for name in self.linkage.cranks]
        for name, slide in self.linkage.slides.items():
            owners += [("slides", name) for _ in range(slide.conditions)]
        return [*owners, *(("gears", name) for name in self.linkage.gears)]

    def joint_impulses(self, impulses: Matrix) -> dict[str, float]:
        """Magnitudes of the impulses [N s] of pins and guides among those of all rows, see `Impulse.joints`."""
        found: dict[str, float] = {}
        for (part, name), impulse in zip(self.owners(), impulses.tolist(), strict=True):
            if part == "pins":
                found[f"pin.{name}"] = math.hypot(found.get(f"pin.{name}", 0.0), impulse)
            elif part == "slides":
                found.setdefault(name, abs(impulse))  # its second row is that of a moment
        return found

    def turning(self, size: int, body: str) -> Matrix:
        """The row that gives a body's angular velocity; that of the ground is none."""
        row = np.zeros(size)
        if body != GROUND:
            row[self.bodies[body].first + 2] = 1.0
        return row

    def driven(self) -> slice:
        """Which of the rows can be driven: rigid actuators, then cranks."""
        first = 2 * len(self.ideal)
        return slice(first, first + len(self.actuators) + len(self.linkage.cranks))

    def rates(self, speed: Callable[[str], float]) -> Matrix:
        """Rates of all rows, (m,): of rigid actuators and cranks as told by name [m/s], [rad/s], else 0."""
        guided = sum(slide.conditions for slide in self.linkage.slides.values())
        rates = np.zeros(self.driven().stop + guided + len(self.linkage.gears))
        rates[self.driven()] = [speed(name) for name in (*self.actuators, *self.linkage.cranks)]
        return rates

    def point(self, position: Matrix, body: str, point: Vector2) -> tuple[Matrix, Matrix]:
        """Place of a point of a body (2,) and the matrix that turns all velocities into its own (2, n)."""
        rate = np.zeros((2, position.size))
        if body == GROUND:
            return np.array(point), rate
        item = self.bodies[body]
        i = item.first
        angle = item.body.angle + position[i + 2]
        x, y = item.local(point)
        arm = np.array([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)])
        rate[0, i : i + 3] = 1.0, 0.0, -arm[1]
        rate[1, i : i + 3] = 0.0, 1.0, arm[0]
        return np.array(item.body.centre) + position[i : i + 2] + arm, rate

    def relative(self, position: Matrix, place: PinPlace) -> tuple[Matrix, Matrix]:
        """Centre of a pin on its second body minus that on its first (2,), and its rate's matrix (2, n)."""
        first, first_rate = self.point(position, place.first, place.first_point)
        second, second_rate = self.point(position, place.second, place.second_point)
        return second - first, second_rate - first_rate

    def pin_rate(self, position: Matrix, place: PinPlace) -> Matrix:
        """The matrix that turns all velocities into the rates of a pin's deflection and of its turn (3, n)."""
        turning = [self.turning(position.size, body) for body in (place.first, place.second)]
        return np.vstack([self.relative(position, place)[1], turning[1] - turning[0]])

    def respond(self, position: Matrix, impulse: Matrix, jump: Matrix | float) -> tuple[Matrix, Matrix]:
        """Change of velocities dv (n,) and impulses L (m,) under impulses b (n,) and a jump c (m,).

        Where rows repeat others, L is the least of all that fit, in the sense of `counts`. Of several impulses
        at once, b (n, k) with c a number: (n, k) and (m, k).
        """
        rows = self.rows(position)
        again = self._repeats(rows)
        size, count, border = position.size, len(rows), again.shape[1]
        system = np.zeros((size + count + border, size + count + border))
        system[:size, :size] = np.diag(self.mass())
        system[:size, size : size + count] = rows.T
        system[size : size + count, :size] = rows
        system[size : size + count, size + count :] = again
        system[size + count :, size : size + count] = again.T
        right = np.zeros((len(system), *impulse.shape[1:]))
        right[:size], right[size : size + count] = impulse, jump
        solution = np.linalg.solve(system, right)
        return solution[:size], solution[size : size + count]

    def _repeats(self, rows: Matrix) -> Matrix:
        """Shares (m, k) of rows with which impulses cancel each other, as columns; none if none repeats."""
        scaled = self.counts[:, None] * rows
        scaled[:, 2::3] /= self.size
        left, values, _ = np.linalg.svd(scaled, full_matrices=len(rows) > rows.shape[1])
        rank = np.count_nonzero(values > REPEATED * values.max(initial=0.0))
        shares: Matrix = left[:, rank:] / self.counts[:, None]
        return shares

    def inverse_mass(self, position: Matrix, rate: Matrix) -> Matrix:
        """Answer of rates to impulses in them, J dv per impulse (k, k) [1/kg], J the rows of the rates (k, n).

            M dv + C^T L = J^T,   C dv = 0

        Of a clearance pin's eccentricity the inverse of n J dv n is the mass that an impact along n moves.
        """
        answers: Matrix = (rate @ self.respond(position, rate.T, 0.0)[0]).T
        return answers


def joints_of(linkage: Linkage) -> list[tuple[str, Vector2]]:
    """Bodies with the points at which something is joined to them, the ground among them."""
    found = [(body, point) for one in linkage.pins.values() for body, point in _ends(one)]
    for actuator in linkage.actuators.values():
        found += [(actuator.foot, actuator.foot_point), (actuator.head, actuator.head_point)]
    for slide in linkage.slides.values():
        found += [(slide.body, slide.point), (slide.against, slide.point)]
    return found


def _ends(pin: PinPlace) -> list[tuple[str, Vector2]]:
    return [(pin.first, pin.first_point), (pin.second, pin.second_point)]
