"""Force of the clearance pin: the family F = K depth^n (1 + chi rate / w) with Ambrosio's friction, or any law.

The same conventions as `user_forces.contact`: the force acts at one point of space on both bodies.
"""

from __future__ import annotations

import math

from support_exudyn.formulations.compiled import call_law, compiled, inlined
from support_exudyn.formulations.reduced.drive import Vector
from support_exudyn.formulations.reduced.free_motion import PinState
from support_exudyn.formulations.reduced.layout import (
    ASKED_DEPTH,
    ASKED_MASS,
    ASKED_RATE,
    ASKED_SLIP,
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
    JOURNAL_ARM,
    LAW,
    MOBILITY_XX,
    MOBILITY_XY,
    MOBILITY_YY,
    NORMAL,
    OFFSET_X,
    OFFSET_Y,
    PARAMETERS,
    PUSH,
    RATE,
    SLIDING_COEFFICIENT,
    SLIP,
    SPEED_FLOOR,
    STATIC_SPEED,
    STIFFNESS,
    STORED,
    TOUCH_SPEED,
    TOUCHING,
)
from support_exudyn.mechanics.contact_state import HEAVIEST
from support_exudyn.mechanics.contact_state import SMALLEST as SMALLEST_SQUARE
from user_forces.contact import SHALLOWEST, SMALLEST
from user_forces.lawful import ROUNDING


@inlined
def moving_mass(memory: Vector, pin: PinState) -> float:
    """Mass [kg] that moves along the eccentricity, by the remembered mobility (bore's axes)."""
    x = pin.cos_bore * pin.x + pin.sin_bore * pin.y
    y = pin.cos_bore * pin.y - pin.sin_bore * pin.x
    square = x * x + y * y + SMALLEST_SQUARE
    along = memory[MOBILITY_XX] * x * x + 2.0 * memory[MOBILITY_XY] * x * y + memory[MOBILITY_YY] * y * y
    return float(square / max(along, square / HEAVIEST))


@inlined
def damping_speed(p: Vector, memory: Vector, pin: PinState, energy: float) -> float:
    """w [m/s] of the law with an energy [J] stored."""
    w = max(memory[TOUCH_SPEED], p[SPEED_FLOOR])
    if p[BY_DEPTH] != 0.0:
        w = max(w, math.sqrt(2.0 * energy / moving_mass(memory, pin)))
    return float(w)


@inlined
def friction_force(p: Vector, slip: float, normal: float) -> float:
    """Ambrosio's tangential force [N]; a sliding coefficient of 0 is no friction."""
    ramp = (abs(slip) - p[STATIC_SPEED]) / (p[DYNAMIC_SPEED] - p[STATIC_SPEED])
    size = p[SLIDING_COEFFICIENT] * min(1.0, max(0.0, ramp)) * normal
    return float(-size if slip > 0.0 else size)


@compiled
def law_force(
    p: Vector, memory: Vector, depth: float, rate: float, slip: float, mass: float, out: Vector
) -> None:
    """Write NORMAL, FRICTION, DAMPING and PUSH of any law into `out`, see `layout`; nan where it breaks.

    Before the surfaces have parted the law goes on as at SHALLOWEST, so that one with a dashpot does not jump.
    """
    depth = max(depth, SHALLOWEST)
    asked = call_law(p[LAW], depth, rate, slip, memory[TOUCH_SPEED], mass, p[PARAMETERS:], out)
    friction, elastic = out[0], out[1]
    normal = asked if asked > 0.0 or asked != asked else 0.0
    lost = (normal - elastic) * rate
    lawful = elastic >= 0.0 and friction * slip <= 0.0 and abs(normal) < math.inf and abs(friction) < math.inf
    if not lawful or (elastic > 0.0 and lost < -ROUNDING * (normal + elastic) * abs(rate)):
        normal = math.nan
        if math.isfinite(depth + rate + slip):  # else this is what comes of an unlawful force
            memory[ASKED_DEPTH], memory[ASKED_RATE] = depth, rate
            memory[ASKED_SLIP], memory[ASKED_MASS] = slip, mass
    size = elastic + abs(asked - elastic)
    out[NORMAL], out[FRICTION], out[DAMPING] = normal, friction, lost
    out[PUSH] = asked / size if size > 0.0 else 1.0  # with asked = elastic (1 + z) it is (1 + z) / (1 + |z|)


@inlined
def contact_force(p: Vector, memory: Vector, pin: PinState, out: Vector) -> None:
    """Write state and force of the contact into `out`, see `layout`; no force while the surfaces are apart."""
    eccentricity = math.sqrt(pin.x * pin.x + pin.y * pin.y)
    away = max(eccentricity, SMALLEST)
    nx, ny = pin.x / away, pin.y / away
    depth = eccentricity - p[CLEARANCE]
    speed = nx * pin.vx + ny * pin.vy
    if eccentricity == 0.0:
        speed = math.sqrt(pin.vx * pin.vx + pin.vy * pin.vy)
    bore_arm = p[BORE_RADIUS] + 0.5 * depth
    journal_arm = bore_arm - depth - p[CLEARANCE]
    slip = nx * pin.vy - ny * pin.vx + pin.journal_spin * journal_arm - pin.bore_spin * bore_arm
    normal = friction = damping = energy = 0.0
    push = 1.0
    if memory[TOUCHING] != 0.0 and p[LAW] != 0.0:
        law_force(p, memory, depth, speed, slip, moving_mass(memory, pin), out)
        normal, friction, damping, push = out[NORMAL], out[FRICTION], out[DAMPING], out[PUSH]
    elif memory[TOUCHING] != 0.0:
        inside = max(depth, 0.0)
        elastic = p[STIFFNESS] * (inside * math.sqrt(inside) if p[EXPONENT] == 1.5 else inside ** p[EXPONENT])
        energy = elastic * inside / (p[EXPONENT] + 1.0)
        push = 1.0 + p[DAMPING_FACTOR] / damping_speed(p, memory, pin, energy) * speed
        normal = max(0.0, elastic * push)
        friction = friction_force(p, slip, normal)
        damping = (normal - elastic) * speed
    out[DEPTH], out[RATE], out[SLIP] = depth, speed, slip
    out[NORMAL], out[FRICTION], out[DAMPING], out[PUSH] = normal, friction, damping, push
    out[OFFSET_X], out[OFFSET_Y], out[JOURNAL_ARM], out[STORED] = pin.x, pin.y, journal_arm, energy
    out[FORCE_X] = -normal * nx - friction * ny
    out[FORCE_Y] = -normal * ny + friction * nx
