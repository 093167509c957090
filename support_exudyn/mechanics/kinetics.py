"""Masses and constraints of a scene as matrices, for what happens at an instant.

Mass matrix M and constraint Jacobian C (ideal pins, rigid actuators, cranks, slides, gears) give the change of
velocities dv and the impulses L under generalised impulses b and a change c of the constraints' rates:

    M dv + C^T L = b,    C dv = c
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.mechanics.body_coordinates import BodyItem
from support_exudyn.model.linkage import GROUND, Linkage, PinPlace, Slide
from user_forces.values.value import Vector2

Matrix = npt.NDArray[np.float64]


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
            first, second = (self.turning(position.size, body) for body in (gear.first, gear.second))
            rows.append(second - gear.ratio * first)
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

        Of several at once, b (n, k) with c a number: (n, k) and (m, k).
        """
        rows = self.rows(position)
        size, count = position.size, len(rows)
        system = np.zeros((size + count, size + count))
        system[:size, :size] = np.diag(self.mass())
        system[:size, size:] = rows.T
        system[size:, :size] = rows
        right = np.concatenate([impulse, np.broadcast_to(jump, (count, *impulse.shape[1:]))])
        try:
            solution = np.linalg.solve(system, right)
        except np.linalg.LinAlgError:  # constraints that repeat each other
            solution = np.linalg.lstsq(system, right, rcond=None)[0]
        return solution[:size], solution[size:]

    def inverse_mass(self, position: Matrix, rate: Matrix) -> Matrix:
        """Answer of rates to impulses in them, J dv per impulse (k, k) [1/kg], J the rows of the rates (k, n).

            M dv + C^T L = J^T,   C dv = 0

        Of a clearance pin's eccentricity the inverse of n J dv n is the mass that an impact along n moves.
        """
        answers: Matrix = (rate @ self.respond(position, rate.T, 0.0)[0]).T
        return answers
