"""The clearance pin: how it moves, the force of its contact, and what that does to the free coordinates.

The force is that of the family F = K depth^n (1 + chi rate / w) with Ambrosio's friction, or of any law that is
compiled from its source. As in `user_forces.contact` it acts at one point of space on both bodies.
"""

import math
from typing import NamedTuple

from support_exudyn.formulations.compilation import call_law, compiled, inlined
from support_exudyn.formulations.compiled.closed_forms.layout import (
    ASKED_DEPTH,
    ASKED_MASS,
    ASKED_RATE,
    ASKED_SLIP,
    BORE_RADIUS,
    BY_DEPTH,
    CLEARANCE,
    CLOSED,
    DAMPING,
    DAMPING_FACTOR,
    DEPTH,
    DYNAMIC_SPEED,
    EXPONENT,
    FORCE_X,
    FORCE_Y,
    FRICTION,
    IMPACT_VELOCITY,
    INVERSE_MASS_XX,
    INVERSE_MASS_XY,
    INVERSE_MASS_YY,
    JOURNAL_ARM,
    LAW,
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
    Vector,
)
from support_exudyn.mechanics.contact_state import HEAVIEST
from support_exudyn.mechanics.contact_state import SMALLEST as SMALLEST_SQUARE
from user_forces.contact import SHALLOWEST, SMALLEST
from user_forces.lawful import ROUNDING


class PinState(NamedTuple):
    """The clearance pin: where the journal is, how it moves, and how that depends on the free coordinates. SI.

    x, y, vx, vy: journal's centre minus bore's, and its rate, ground's axes. bore_spin, journal_spin: of their
    bodies. cos_bore, sin_bore: turn of the bore's axes. x1, y1, x2, y2: rate of x, y by the rates of the first
    and second coordinate. bore1, bore2, journal1, journal2: of the spins likewise.
    """

    x: float
    y: float
    vx: float
    vy: float
    bore_spin: float
    journal_spin: float
    cos_bore: float
    sin_bore: float
    x1: float
    y1: float
    x2: float
    y2: float
    bore1: float
    bore2: float
    journal1: float
    journal2: float


class Balance(NamedTuple):
    """The two equations M q'' = Q without the contact: entries of M and Q."""

    m11: float
    m12: float
    m22: float
    q1: float
    q2: float


@inlined
def solved(law: Balance, q1: float, q2: float) -> tuple[float, float]:
    """q'' from M q'' = (q1, q2)."""
    scale = 1.0 / (law.m11 * law.m22 - law.m12 * law.m12)
    return (law.m22 * q1 - law.m12 * q2) * scale, (law.m11 * q2 - law.m12 * q1) * scale


@inlined
def accelerations(pin: PinState, law: Balance, contact: Vector) -> tuple[float, float]:
    """q'' under the contact's force, which acts at one point of space on both bodies."""
    fx, fy, friction = contact[FORCE_X], contact[FORCE_Y], contact[FRICTION]
    journal = friction * contact[JOURNAL_ARM]
    bore = journal + friction * math.sqrt(contact[OFFSET_X] ** 2 + contact[OFFSET_Y] ** 2)
    q1 = law.q1 + fx * pin.x1 + fy * pin.y1 + journal * pin.journal1 - bore * pin.bore1
    q2 = law.q2 + fx * pin.x2 + fy * pin.y2 + journal * pin.journal2 - bore * pin.bore2
    return solved(law, q1, q2)


@inlined
def closing_rates(pin: PinState, x: float, y: float) -> tuple[float, float]:
    """Rates of the free coordinates that take a velocity or acceleration x, y from the journal."""
    det = pin.x1 * pin.y2 - pin.y1 * pin.x2
    return -(x * pin.y2 - y * pin.x2) / det, -(y * pin.x1 - x * pin.y1) / det


@inlined
def closing_force(pin: PinState, law: Balance, first: float, second: float) -> tuple[float, float]:
    """Force [N] on the journal at its centre under which these are the accelerations."""
    q1 = law.m11 * first + law.m12 * second - law.q1
    q2 = law.m12 * first + law.m22 * second - law.q2
    det = pin.x1 * pin.y2 - pin.y1 * pin.x2
    return (q1 * pin.y2 - q2 * pin.y1) / det, (q2 * pin.x1 - q1 * pin.x2) / det


@inlined
def inverse_mass(pin: PinState, law: Balance) -> tuple[float, float, float]:
    """xx, xy, yy [1/kg] of the velocity that an impulse gives the journal, in the bore's axes."""
    c, s = pin.cos_bore, pin.sin_bore
    x1, x2 = c * pin.x1 + s * pin.y1, c * pin.x2 + s * pin.y2
    y1, y2 = c * pin.y1 - s * pin.x1, c * pin.y2 - s * pin.x2
    ax, bx = solved(law, x1, x2)
    ay, by = solved(law, y1, y2)
    return x1 * ax + x2 * bx, x1 * ay + x2 * by, y1 * ay + y2 * by


@inlined
def effective_mass(memory: Vector, pin: PinState) -> float:
    """Mass [kg] that moves along the eccentricity, by the remembered inverse effective mass (bore's axes)."""
    x = pin.cos_bore * pin.x + pin.sin_bore * pin.y
    y = pin.cos_bore * pin.y - pin.sin_bore * pin.x
    square = x * x + y * y + SMALLEST_SQUARE
    along = (
        memory[INVERSE_MASS_XX] * x * x
        + 2.0 * memory[INVERSE_MASS_XY] * x * y
        + memory[INVERSE_MASS_YY] * y * y
    )
    return float(square / max(along, square / HEAVIEST))


@inlined
def damping_speed(p: Vector, memory: Vector, pin: PinState, energy: float) -> float:
    """w [m/s] of the law with an energy [J] stored."""
    w = max(memory[IMPACT_VELOCITY], p[SPEED_FLOOR])
    if p[BY_DEPTH] != 0.0:
        w = max(w, math.sqrt(2.0 * energy / effective_mass(memory, pin)))
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

    Before the surfaces have separated the law goes on as at SHALLOWEST, so that one with a dashpot does not
    jump.
    """
    depth = max(depth, SHALLOWEST)
    asked = call_law(p[LAW], depth, rate, slip, memory[IMPACT_VELOCITY], mass, 0.0, p[PARAMETERS:], out)
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
    if memory[CLOSED] != 0.0 and p[LAW] != 0.0:
        law_force(p, memory, depth, speed, slip, effective_mass(memory, pin), out)
        normal, friction, damping, push = out[NORMAL], out[FRICTION], out[DAMPING], out[PUSH]
    elif memory[CLOSED] != 0.0:
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
