"""What a jump of the columns' speed does: an impulse, and consistent velocities after it.

With rigid columns the bodies' velocities jump too. Mass matrix M, constraint Jacobian C (of ideal pins and
columns) and the jump b of the constraints' rates give

    M dv + C^T L = 0,    C dv = b

for the change of velocities dv and the impulses L. Clearance pins transmit no impulse: their force is
finite.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from support_exudyn.machine import GROUND
from support_exudyn.scene import Scene
from user_forces.values import Vector2

Matrix = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Impulse:
    """A jump of velocities.

    time: [s]. columns: impulse of each column [N s], positive in compression. energy: given to the bodies
    by it [J].
    """

    time: float
    columns: dict[str, float]
    energy: float


def jump_velocities(scene: Scene, time: float, speed_jump: float) -> Impulse:
    """Give the bodies the velocities that belong to columns whose speed has jumped by so much [m/s]."""
    data = scene.mbs.systemData
    position, before = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
    mass = _mass(scene)
    rows, jumps = _constraints(scene, position, speed_jump)
    size, count = len(before), len(jumps)
    system = np.zeros((size + count, size + count))
    system[:size, :size] = np.diag(mass)
    system[:size, size:] = rows.T
    system[size:, :size] = rows
    solution = np.linalg.solve(system, np.concatenate([np.zeros(size), jumps]))
    after = before + solution[:size]
    data.SetODE2Coordinates_t(after)
    impulses = solution[size + 2 * len(scene.ideal_pins) :]
    return Impulse(
        time,
        dict(zip(scene.columns, (-impulses).tolist(), strict=True)),
        float(0.5 * (mass * after) @ after - 0.5 * (mass * before) @ before),
    )


def _mass(scene: Scene) -> Matrix:
    mass = np.zeros(3 * len(scene.bodies))
    for item in scene.bodies.values():
        body = item.body
        mass[item.first : item.first + 3] = body.mass, body.mass, body.inertia
    return mass


def _constraints(scene: Scene, position: Matrix, speed_jump: float) -> tuple[Matrix, Matrix]:
    """Jacobian rows of ideal pins (two each), then columns (one each), and the jumps of their rates."""
    rows: list[Matrix] = []
    jumps: list[float] = []
    for name in scene.ideal_pins:
        place = scene.linkage.pins[name]
        _, first = _point(scene, position, place.first, place.first_point)
        _, second = _point(scene, position, place.second, place.second_point)
        rows += list(second - first)
        jumps += [0.0, 0.0]
    for item in scene.columns.values():
        foot, foot_rate = _point(scene, position, item.column.foot, item.column.foot_point)
        head, head_rate = _point(scene, position, item.column.head, item.column.head_point)
        along = (head - foot) / np.linalg.norm(head - foot)
        rows.append(along @ (head_rate - foot_rate))
        jumps.append(speed_jump)
    return np.array(rows).reshape(-1, position.size), np.array(jumps)


def _point(scene: Scene, position: Matrix, body: str, point: Vector2) -> tuple[Matrix, Matrix]:
    """Where a point of a body is (2,) and the matrix that turns all velocities into its own (2, n)."""
    rate = np.zeros((2, position.size))
    if body == GROUND:
        return np.array(point), rate
    item = scene.bodies[body]
    i = item.first
    angle = item.body.angle + position[i + 2]
    x, y = item.local(point)
    arm = np.array([x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)])
    rate[0, i : i + 3] = 1.0, 0.0, -arm[1]
    rate[1, i : i + 3] = 0.0, 1.0, arm[0]
    return np.array(item.body.centre) + position[i : i + 2] + arm, rate
