"""Force of the loose pin, compiled: the family F = K depth^n (1 + chi rate / w) with Ambrosio's friction.

The same conventions as `user_forces.contact`: the force acts at one point of space on both bodies.
"""

from __future__ import annotations

import math

from support_exudyn.onset import HEAVIEST
from support_exudyn.onset import SMALLEST as SMALLEST_SQUARE
from support_exudyn.reduced.compiled import compiled
from support_exudyn.reduced.layout import (
    BORE_RADIUS,
    BY_DEPTH,
    CLEARANCE,
    DAMPING,
    DAMPING_FACTOR,
    DEPTH,
    DYNAMIC_SPEED,
    EXPONENT,
    FORCE_X,
    FORCE_Y,
    FRICTION,
    JOURNAL_ON_LINK,
    MOBILITY_XX,
    MOBILITY_XY,
    MOBILITY_YY,
    MOMENT,
    NORMAL,
    OFFSET_X,
    OFFSET_Y,
    PUSH,
    RATE,
    SLIDING_COEFFICIENT,
    SLIP,
    SPEED_FLOOR,
    STATIC_SPEED,
    STIFFNESS,
    TOUCH_SPEED,
    TOUCHING,
)
from support_exudyn.reduced.posture import Posture, Rates, Vector
from user_forces.contact import SMALLEST


@compiled
def moving_mass(p: Vector, memory: Vector, at: Posture, x: float, y: float) -> float:
    """Mass [kg] that moves along the eccentricity x, y, by the remembered mobility (bore's axes)."""
    if p[JOURNAL_ON_LINK] == 0.0:
        x, y = at.cos_link * x + at.sin_link * y, at.cos_link * y - at.sin_link * x
    square = x * x + y * y + SMALLEST_SQUARE
    along = memory[MOBILITY_XX] * x * x + 2.0 * memory[MOBILITY_XY] * x * y + memory[MOBILITY_YY] * y * y
    return float(square / max(along, square / HEAVIEST))


@compiled
def damping_speed(p: Vector, memory: Vector, at: Posture, x: float, y: float, energy: float) -> float:
    """w [m/s] of the law with an energy [J] stored."""
    w = max(memory[TOUCH_SPEED], p[SPEED_FLOOR])
    if p[BY_DEPTH] != 0.0:
        w = max(w, math.sqrt(2.0 * energy / moving_mass(p, memory, at, x, y)))
    return float(w)


@compiled
def friction_force(p: Vector, slip: float, normal: float) -> float:
    """Ambrosio's tangential force [N]; a sliding coefficient of 0 is no friction."""
    ramp = (abs(slip) - p[STATIC_SPEED]) / (p[DYNAMIC_SPEED] - p[STATIC_SPEED])
    size = p[SLIDING_COEFFICIENT] * min(1.0, max(0.0, ramp)) * normal
    return float(-size if slip > 0.0 else size)


@compiled
def contact_force(p: Vector, memory: Vector, at: Posture, rate: Rates, link_rate: float, out: Vector) -> None:
    """Write state and forces of the contact into `out`, see `layout`; no force while the surfaces are apart."""
    journal_on_link = p[JOURNAL_ON_LINK] != 0.0
    sign = 1.0 if journal_on_link else -1.0
    x, y, vx, vy = sign * at.offset_x, sign * at.offset_y, sign * rate.end_x, sign * rate.end_y
    eccentricity = math.sqrt(x * x + y * y)
    away = max(eccentricity, SMALLEST)
    nx, ny = x / away, y / away
    depth = eccentricity - p[CLEARANCE]
    speed = nx * vx + ny * vy
    if eccentricity == 0.0:
        speed = math.sqrt(vx * vx + vy * vy)
    bore_arm = p[BORE_RADIUS] + 0.5 * depth
    journal_arm = bore_arm - depth - p[CLEARANCE]
    slip = nx * vy - ny * vx + (link_rate * journal_arm if journal_on_link else -link_rate * bore_arm)
    normal = friction = damping = 0.0
    push = 1.0
    if memory[TOUCHING] != 0.0:
        inside = max(depth, 0.0)
        elastic = p[STIFFNESS] * (inside * math.sqrt(inside) if p[EXPONENT] == 1.5 else inside ** p[EXPONENT])
        energy = elastic * inside / (p[EXPONENT] + 1.0)
        w = damping_speed(p, memory, at, x, y, energy)
        push = 1.0 + p[DAMPING_FACTOR] / w * speed
        normal = max(0.0, elastic * push)
        friction = friction_force(p, slip, normal)
        damping = (normal - elastic) * speed
    out[DEPTH], out[RATE], out[SLIP] = depth, speed, slip
    out[NORMAL], out[FRICTION], out[DAMPING], out[PUSH] = normal, friction, damping, push
    out[OFFSET_X], out[OFFSET_Y] = x, y
    out[FORCE_X] = sign * (-normal * nx - friction * ny)
    out[FORCE_Y] = sign * (-normal * ny + friction * nx)
    out[MOMENT] = journal_arm * friction if journal_on_link else -bore_arm * friction
