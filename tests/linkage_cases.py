"""What tests of linkages share: a crank-rocker laid out by hand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field

from support_exudyn import Body, Crank, Linkage, Machine, value
from support_exudyn.model.linkage import bar, pinned
from support_exudyn.model.loads.load import ActingLoad
from user_forces.values.value import Vector2

LENGTHS = (0.1, 0.4, 0.3, 0.35)  # crank, coupler, rocker, ground [m]
MASSES = (1.0, 3.0, 2.5)  # [kg]


def closed(crank: float) -> tuple[float, float]:
    """Angles of coupler and rocker [rad], coupler above, of a crank at an angle [rad]."""
    a, b, c, d = LENGTHS
    x, y = d - a * math.cos(crank), -a * math.sin(crank)
    reach = math.hypot(x, y)
    along = (b * b - c * c + reach * reach) / (2.0 * reach)
    high = math.sqrt(b * b - along * along)
    dx, dy = (along * x - high * y) / reach, (along * y + high * x) / reach
    return math.atan2(dy, dx), math.atan2(dy - y, dx - x)


def rates(crank: float) -> tuple[float, float]:
    """How fast coupler and rocker turn as the crank turns by 1 rad/s."""
    a, b, c, _ = LENGTHS
    coupler, rocker = closed(crank)
    slant = math.sin(coupler - rocker)
    return a * math.sin(rocker - crank) / (b * slant), a * math.sin(coupler - crank) / (c * slant)


@value
class CrankRocker(Machine):
    """Uniform bars on the pivots (0, 0) and (0.35, 0); a crank at an angle and a speed, driven or not."""

    angle: float = 0.0
    speed: float = 0.0
    driven: bool = False
    springs: Mapping[str, ActingLoad] = field(default_factory=dict)

    @property
    def points(self) -> tuple[Vector2, Vector2, Vector2, Vector2]:
        """Pins from the crank's pivot to the rocker's [m]."""
        a, b, _, d = LENGTHS
        first = (a * math.cos(self.angle), a * math.sin(self.angle))
        coupler = closed(self.angle)[0]
        second = (first[0] + b * math.cos(coupler), first[1] + b * math.sin(coupler))
        return (0.0, 0.0), first, second, (d, 0.0)

    def middle(self, body: str) -> Vector2:
        """The middle of a bar [m]."""
        o, a, b, c = self.points
        (x, y), (u, v) = {"crank": (o, a), "coupler": (a, b), "rocker": (c, b)}[body]
        return 0.5 * (x + u), 0.5 * (y + v)

    @property
    def loads(self) -> Mapping[str, ActingLoad]:
        """Its springs."""
        return self.springs

    def linkage(self) -> Linkage:
        """The bars as they start."""
        o, a, b, c = self.points
        spins = dict(zip(("coupler", "rocker"), (self.speed * rate for rate in rates(self.angle)), strict=True))
        still = (0.0, 0.0)
        moving = (-self.speed * a[1], self.speed * a[0])
        bars = {
            "crank": (o, a, still, self.speed),
            "coupler": (a, b, moving, spins["coupler"]),
            "rocker": (c, b, still, spins["rocker"]),
        }
        bodies = {}
        for mass, (name, (near, far, (vx, vy), spin)) in zip(MASSES, bars.items(), strict=True):
            part = bar(mass, near, far)
            x, y = part.centre[0] - near[0], part.centre[1] - near[1]
            bodies[name] = Body(
                mass=mass,
                inertia=part.inertia,
                centre=part.centre,
                angle=math.atan2(far[1] - near[1], far[0] - near[0]),
                velocity=(vx - spin * y, vy + spin * x),
                spin=spin,
            )
        pins = {
            "O": pinned("ground", "crank", o),
            "A": pinned("crank", "coupler", a),
            "B": pinned("coupler", "rocker", b),
            "C": pinned("ground", "rocker", c),
        }
        cranks = {"crank": Crank(body="crank")} if self.driven else {}
        return Linkage(bodies=bodies, pins=pins, cranks=cranks)
