"""Posture and velocities of the support from its two free coordinates, in closed form.

Free coordinates are the turns of canopy and rear link. The heads of both columns and the hinge I are on the
canopy, so I lies where two circles meet, whose radii are the lengths of the columns. D lies where circles
about I and A meet, C sits on the shield beam, and the rear link hangs on C.
"""

import math
from typing import NamedTuple

from support_exudyn.formulations.compilation import inlined
from support_exudyn.formulations.compiled.closed_forms.layout import (
    FRONT_BASE_X,
    FRONT_BASE_Y,
    FRONT_FOOT_X,
    FRONT_FOOT_Y,
    FRONT_HEAD_X,
    FRONT_HEAD_Y,
    FRONT_LENGTH,
    HINGE_SIDE,
    LINK_LENGTH,
    PIN_X,
    PIN_Y,
    REAR_BASE_X,
    REAR_BASE_Y,
    REAR_FOOT_X,
    REAR_FOOT_Y,
    REAR_HEAD_X,
    REAR_HEAD_Y,
    REAR_LENGTH,
    SHIELD_LENGTH,
    SHIELD_PIN_ACROSS,
    SHIELD_PIN_ALONG,
    SHIELD_SIDE,
    SINE,
    SWIFTNESS,
    Vector,
)


class SupportMotion(NamedTuple):
    """Where everything is, and how it moves with the canopy's turn at fixed columns and rear link. SI.

    Pairs x, y: hinge I; front, rear: columns from foot to head; e, g: their heads from I; s: D from I; f: D
    from A; c: C from I; b: the rear link's end from C; offset: that end from the base's pin B.
    along: rate of I; shield, link: rates of shield beam and front link; pin: rate of C.
    """

    cos_canopy: float
    sin_canopy: float
    cos_link: float
    sin_link: float
    hinge_x: float
    hinge_y: float
    front_x: float
    front_y: float
    rear_x: float
    rear_y: float
    ex: float
    ey: float
    gx: float
    gy: float
    sx: float
    sy: float
    fx: float
    fy: float
    cx: float
    cy: float
    bx: float
    by: float
    offset_x: float
    offset_y: float
    columns: float  # front x rear [m^2], zero where the columns do not hold the hinge
    bars: float  # s x f [m^2], zero at a dead centre of the four-bar
    along_x: float
    along_y: float
    shield: float
    link: float
    pin_x: float
    pin_y: float


class Rates(NamedTuple):
    """Velocities of the hinge and of the rear link's end [m/s], spins of shield beam and front link [rad/s]."""

    hinge_x: float
    hinge_y: float
    shield: float
    link: float
    end_x: float
    end_y: float


@inlined
def meeting_point(
    ax: float, ay: float, ra: float, bx: float, by: float, rb: float, side: float
) -> tuple[float, float]:
    """Where circles about a and b meet [m], left of the line from a to b if side is +1; nan if nowhere."""
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    along = 0.5 * (1.0 + (ra * ra - rb * rb) / square)
    across = side * math.sqrt(ra * ra / square - along * along)
    return ax + along * dx - across * dy, ay + along * dy + across * dx


@inlined
def posture(p: Vector, canopy: float, link: float, extension: float) -> SupportMotion:
    """Posture for turns of canopy and rear link [rad] and an extension of the columns [m]; nan if none."""
    cc, sc = math.cos(canopy), math.sin(canopy)
    cl, sl = math.cos(link), math.sin(link)
    ex, ey = cc * p[FRONT_HEAD_X] - sc * p[FRONT_HEAD_Y], sc * p[FRONT_HEAD_X] + cc * p[FRONT_HEAD_Y]
    gx, gy = cc * p[REAR_HEAD_X] - sc * p[REAR_HEAD_Y], sc * p[REAR_HEAD_X] + cc * p[REAR_HEAD_Y]
    fcx, fcy = p[FRONT_FOOT_X] - ex, p[FRONT_FOOT_Y] - ey
    rcx, rcy = p[REAR_FOOT_X] - gx, p[REAR_FOOT_Y] - gy
    hx, hy = meeting_point(
        fcx, fcy, p[FRONT_LENGTH] + extension, rcx, rcy, p[REAR_LENGTH] + extension, p[HINGE_SIDE]
    )
    ux, uy, wx, wy = hx - fcx, hy - fcy, hx - rcx, hy - rcy
    ax, ay = p[FRONT_BASE_X], p[FRONT_BASE_Y]
    dx, dy = meeting_point(hx, hy, p[SHIELD_LENGTH], ax, ay, p[LINK_LENGTH], p[SHIELD_SIDE])
    sx, sy, fx, fy = dx - hx, dy - hy, dx - ax, dy - ay
    cx = p[SHIELD_PIN_ALONG] * sx - p[SHIELD_PIN_ACROSS] * sy
    cy = p[SHIELD_PIN_ALONG] * sy + p[SHIELD_PIN_ACROSS] * sx
    bx, by = cl * p[PIN_X] - sl * p[PIN_Y], sl * p[PIN_X] + cl * p[PIN_Y]
    columns = ux * wy - uy * wx
    bars = sx * fy - sy * fx
    # u . (along + e turned) = 0, w . (along + g turned) = 0
    a, b = uy * -ex + ux * ey, wy * -gx + wx * gy
    ix, iy = (a * wy - b * uy) / columns, (b * ux - a * wx) / columns
    shield, front = -(ix * fx + iy * fy) / bars, -(ix * sx + iy * sy) / bars
    return SupportMotion(
        cc,
        sc,
        cl,
        sl,
        hx,
        hy,
        ux,
        uy,
        wx,
        wy,
        ex,
        ey,
        gx,
        gy,
        sx,
        sy,
        fx,
        fy,
        cx,
        cy,
        bx,
        by,
        hx + cx + bx - p[REAR_BASE_X],
        hy + cy + by - p[REAR_BASE_Y],
        columns,
        bars,
        ix,
        iy,
        shield,
        front,
        ix - shield * cy,
        iy + shield * cx,
    )


@inlined
def dead_centre(at: SupportMotion, rate: Rates, canopy_rate: float, out: Vector) -> None:
    """Write into `out` how near the linkage is to a dead centre, where this formulation ends.

    SINE: the smaller sine of the angles between both columns and between shield beam and front link.
    SWIFTNESS: the larger rate of these angles over their sine [1/s], so that a dead centre is further away than
    1 / SWIFTNESS.
    """
    uu = at.front_x * at.front_x + at.front_y * at.front_y
    ww = at.rear_x * at.rear_x + at.rear_y * at.rear_y
    vx, vy = rate.hinge_x - canopy_rate * at.ey, rate.hinge_y + canopy_rate * at.ex
    front = (at.front_x * vy - at.front_y * vx) / uu
    vx, vy = rate.hinge_x - canopy_rate * at.gy, rate.hinge_y + canopy_rate * at.gx
    rear = (at.rear_x * vy - at.rear_y * vx) / ww
    columns = abs(at.columns) / math.sqrt(uu * ww)
    ss, ff = at.sx * at.sx + at.sy * at.sy, at.fx * at.fx + at.fy * at.fy
    bars = abs(at.bars) / math.sqrt(ss * ff)
    out[SINE] = min(columns, bars)
    out[SWIFTNESS] = max(abs(rear - front) / columns, abs(rate.link - rate.shield) / bars)


@inlined
def hinge_driven(
    p: Vector, at: SupportMotion, extension: float, front: float, rear: float
) -> tuple[float, float]:
    """x, y with front column . (x, y) = front length times `front`, and the same for the rear one.

    The velocity of the hinge that belongs to speeds of the columns at a canopy that does not turn.
    """
    a = (p[FRONT_LENGTH] + extension) * front
    b = (p[REAR_LENGTH] + extension) * rear
    return (a * at.rear_y - b * at.front_y) / at.columns, (b * at.front_x - a * at.rear_x) / at.columns


@inlined
def rates(
    p: Vector, at: SupportMotion, canopy_rate: float, link_rate: float, extension: float, speed: float
) -> Rates:
    """Velocities for rates of canopy and rear link [rad/s] and a speed of the columns [m/s]."""
    tx, ty = hinge_driven(p, at, extension, speed, speed)
    vx, vy = at.along_x * canopy_rate + tx, at.along_y * canopy_rate + ty
    shield = -(vx * at.fx + vy * at.fy) / at.bars
    front = -(vx * at.sx + vy * at.sy) / at.bars
    ex = vx - shield * at.cy - link_rate * at.by
    ey = vy + shield * at.cx + link_rate * at.bx
    return Rates(vx, vy, shield, front, ex, ey)
