"""Points and circles in the plane."""

import math

from user_forces.values.value import Vector2


def rotated(vector: Vector2, angle: float) -> Vector2:
    """The vector turned by an angle [rad], counter-clockwise."""
    c, s = math.cos(angle), math.sin(angle)
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]


def minus(a: Vector2, b: Vector2) -> Vector2:
    """a - b."""
    return a[0] - b[0], a[1] - b[1]


def plus(a: Vector2, b: Vector2) -> Vector2:
    """a + b."""
    return a[0] + b[0], a[1] + b[1]


def distance(a: Vector2, b: Vector2) -> float:
    """Distance of two points."""
    return math.hypot(a[0] - b[0], a[1] - b[1])


def direction(a: Vector2, b: Vector2) -> float:
    """Angle [rad] of the line from a to b, from +x, from -pi to pi."""
    return math.atan2(b[1] - a[1], b[0] - a[0])


def moved(point: Vector2, origin: Vector2, to: Vector2, angle: float) -> Vector2:
    """Place to which a point of a rigid body goes when its `origin` goes to `to` and it turns by `angle`."""
    return plus(to, rotated(minus(point, origin), angle))


def side(a: Vector2, b: Vector2, point: Vector2) -> float:
    """+1 if the point lies to the left of the line from a to b, else -1."""
    cross = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])
    return 1.0 if cross >= 0.0 else -1.0


def circle_intersection(a: Vector2, ra: float, b: Vector2, rb: float, which: float) -> Vector2 | None:
    """Intersection of circles about a and b with radii ra and rb; None if there is none.

    Of the two points, the one to the left of the line from a to b if `which` is +1, to the right if -1.
    """
    d = distance(a, b)
    if d == 0.0:
        return None
    along = (ra * ra - rb * rb + d * d) / (2.0 * d)
    square = ra * ra - along * along
    if square < 0.0:
        return None
    off = which * math.sqrt(square)
    ux, uy = (b[0] - a[0]) / d, (b[1] - a[1]) / d
    return a[0] + along * ux - off * uy, a[1] + along * uy + off * ux
