"""Guides with clearance: machines, and their motion by scipy from equations of their own.

The equations have minimal coordinates q, from which places of bodies X(q) (x, y, angle of each) follow, and
contact forces by vectors in the plane, at each of eight or two pairs of a corner or a pin and a wall. Nothing
of the program is used but the numbers of its scenarios.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from support_exudyn import Body, Linkage, Machine, Scenario, Slide, SolverSettings
from support_exudyn.model.guides import ClearanceGuide
from support_exudyn.model.linkage import GROUND, pinned
from user_forces import Ambrosio, Exact, FrictionLaw, Frictionless, exact_damping_factor, value

GRAVITY = 9.81
CRANK, ROD = 0.153, 0.306  # lengths [m]
CRANK_MASS, ROD_MASS, SLIDER_MASS = 0.038, 0.038, 0.076  # [kg]
CRANK_INERTIA, ROD_INERTIA, SLIDER_INERTIA = 7.4e-5, 5.9e-4, 2.7e-6  # [kg m^2]
BLOCK, GAP, RESTITUTION = (0.1, 0.05), 1e-3, 0.4
RATES = 150.0, -75.0  # of crank and rod at the start [rad/s]
TIGHT = 1e-11
AT_ZERO = 1e-13  # [m]
LONGEST = 2e-5  # step [s]: a graze is not stepped over


@value
class FreeSliderCrank(Machine):
    """The slider-crank of Flores, Leine and Glocker (2010), stretched at the start; its crank is free."""

    def linkage(self) -> Linkage:
        crank, rod = RATES
        end = CRANK + ROD
        return Linkage(
            bodies={
                "crank": Body(
                    mass=CRANK_MASS,
                    inertia=CRANK_INERTIA,
                    centre=(0.5 * CRANK, 0.0),
                    velocity=(0.0, 0.5 * CRANK * crank),
                    spin=crank,
                ),
                "rod": Body(
                    mass=ROD_MASS,
                    inertia=ROD_INERTIA,
                    centre=(CRANK + 0.5 * ROD, 0.0),
                    velocity=(0.0, CRANK * crank + 0.5 * ROD * rod),
                    spin=rod,
                ),
                "slider": Body(mass=SLIDER_MASS, inertia=SLIDER_INERTIA, centre=(end, 0.0)),
            },
            pins={
                "main": pinned(GROUND, "crank", (0.0, 0.0)),
                "crank_pin": pinned("crank", "rod", (CRANK, 0.0)),
                "slider_pin": pinned("rod", "slider", (end, 0.0)),
            },
            slides={"guide": Slide(body="slider", point=(end, 0.0))},
        )


def slider_crank(
    stiffness: float,
    duration: float,
    friction: FrictionLaw = Frictionless(),  # noqa: B008 - frozen
    step: float = 1e-5,
    impact_steps: int = 128,
) -> Scenario:
    """The slider-crank with 1 mm of play on either side; stiffness: K of the exact law [N/m^1.5].

    The speed that damping is scaled with is that of the impact as long as the contact lasts.
    """
    normal = Exact(stiffness=stiffness, restitution=RESTITUTION, rest_velocity=1e-9)
    return Scenario(
        machine=FreeSliderCrank(),
        guides={"guide": ClearanceGuide(gaps=(GAP, GAP), normal=normal, friction=friction, block=BLOCK)},
        duration=duration,
        step=step,
        record_period=min(1e-3, duration),
        formulation="exudyn",
        gravity=(0.0, -GRAVITY),
        solver=SolverSettings(impact_steps=impact_steps),
    )


@value
class FreePair(Machine):
    """A block or a pin in the slot of a carrier, both free to move and turn; y up.

    Arguments:
        direction: of the slot at the start [rad]. along, offset: of the block's centre from the carrier's along
            the slot and across [m]. velocity, spin: of the block. carrier_velocity, carrier_spin: of the
            carrier.
        turns: whether it is a pin that is in the slot. off: of the guide's point from the block's centre [m].
        grounded: whether the ground is the carrier.
    """

    direction: float = 0.4
    along: float = 0.3
    offset: float = 0.05
    velocity: tuple[float, float] = (0.3, -0.4)
    spin: float = 1.5
    carrier_velocity: tuple[float, float] = (0.0, 0.0)
    carrier_spin: float = 2.0
    turns: bool = False
    off: tuple[float, float] = (0.01, 0.0)
    grounded: bool = False

    @property
    def centre(self) -> tuple[float, float]:
        """Of the block [m]."""
        c, s = math.cos(self.direction), math.sin(self.direction)
        return 0.2 + c * self.along - s * self.offset, 0.1 + s * self.along + c * self.offset

    def linkage(self) -> Linkage:
        x, y = self.centre
        bodies = {
            "carrier": Body(
                mass=2.0,
                inertia=0.3,
                centre=(0.2, 0.1),
                angle=0.7,
                velocity=self.carrier_velocity,
                spin=self.carrier_spin,
            ),
            "block": Body(
                mass=0.5, inertia=4e-4, centre=(x, y), angle=-0.2, velocity=self.velocity, spin=self.spin
            ),
        }
        carrier = "carrier"
        if self.grounded:
            del bodies[carrier]
            carrier = GROUND
        point = x + self.off[0], y + self.off[1]
        slide = Slide(body="block", point=point, direction=self.direction, against=carrier, turns=self.turns)
        return Linkage(bodies=bodies, slides={"guide": slide})


# --- by scipy ---


class Places(NamedTuple):
    """Places of all bodies at q with rates q', shape (3 b,), J (3 b, k), and J' q'."""

    at: np.ndarray
    rows: np.ndarray
    bend: np.ndarray


class Touch(NamedTuple):
    """A contact as it was met."""

    name: str
    time: float
    speed: float


def slider_crank_places(q: np.ndarray, v: np.ndarray) -> Places:
    """Crank, rod and slider by the angles of all three."""
    (a, b, s), (wa, wb, _) = q, v
    ca, sa, cb, sb = math.cos(a), math.sin(a), math.cos(b), math.sin(b)
    r, rod_length = CRANK, ROD
    at = [0.5 * r * ca, 0.5 * r * sa, a, r * ca + 0.5 * rod_length * cb, r * sa + 0.5 * rod_length * sb, b]
    at += [r * ca + rod_length * cb, r * sa + rod_length * sb, s]
    rows = np.zeros((9, 3))
    for first, parts in ((0, (0.5, 0.0)), (3, (1.0, 0.5)), (6, (1.0, 1.0))):
        rows[first : first + 2, 0] = -parts[0] * r * sa, parts[0] * r * ca
        rows[first : first + 2, 1] = -parts[1] * rod_length * sb, parts[1] * rod_length * cb
    rows[2, 0] = rows[5, 1] = rows[8, 2] = 1.0
    crank, rod = -r * wa * wa * np.array([ca, sa]), -rod_length * wb * wb * np.array([cb, sb])
    bend = np.zeros(9)
    bend[0:2], bend[3:5], bend[6:8] = 0.5 * crank, crank + 0.5 * rod, crank + rod
    return Places(np.array(at), rows, bend)


def free_places(q: np.ndarray, v: np.ndarray) -> Places:
    """Bodies that nothing holds."""
    return Places(q, np.eye(q.size), np.zeros(q.size))


@dataclass
class GuideByScipy:
    """The motion of one guide with clearance.

    places: of bodies. masses: of all coordinates of bodies. gravity: [m/s^2]. block, carrier: columns of their
    x among these; None: the ground, whose angle is 0. corners: names and points on the block, from its centre
    in its axes at angle 0. radius: of a pin. origin, direction: of the middle line on the carrier, the same
    way. half_height: of the slot [m]. stiffness, restitution, friction: of the contacts.
    """

    places: Callable[[np.ndarray, np.ndarray], Places]
    masses: Sequence[float]
    gravity: tuple[float, float]
    block: int
    carrier: int | None
    corners: dict[str, tuple[float, float]]
    origin: tuple[float, float]
    direction: float
    half_height: float
    stiffness: float
    restitution: float
    friction: Ambrosio | None = None
    radius: float = 0.0
    speeds: dict[Any, float] = field(default_factory=dict)  # of contacts going on
    touches: list[Touch] = field(default_factory=list)

    def frame(self, at: np.ndarray, rate: np.ndarray) -> tuple[np.ndarray, ...]:
        """Origin of the middle line, its velocity, direction, normal, spin."""
        place, velocity, angle, spin = np.zeros(2), np.zeros(2), 0.0, 0.0
        if self.carrier is not None:
            n = self.carrier
            place, velocity, angle, spin = at[n : n + 2], rate[n : n + 2], at[n + 2], rate[n + 2]
        c, s = math.cos(angle), math.sin(angle)
        arm = np.array([c * self.origin[0] - s * self.origin[1], s * self.origin[0] + c * self.origin[1]])
        along = np.array([math.cos(angle + self.direction), math.sin(angle + self.direction)])
        return place + arm, velocity + spin * turned(arm), along, turned(along), np.array(spin)

    def pairs(self, at: np.ndarray, rate: np.ndarray) -> dict[Any, tuple[Any, ...]]:
        """Depth, its rate, slip along the slot, point and outward normal of every corner and wall."""
        origin, velocity, along, normal, spin = self.frame(at, rate)
        n = self.block
        c, s = math.cos(at[n + 2]), math.sin(at[n + 2])
        found = {}
        for name, (x, y) in self.corners.items():
            arm = np.array([c * x - s * y, s * x + c * y])
            centre = at[n : n + 2] + arm
            for side in (1.0, -1.0):
                point = centre + side * self.radius * normal
                depth = side * float((point - origin) @ normal) - self.half_height
                own = rate[n : n + 2] + rate[n + 2] * turned(point - at[n : n + 2])
                walls = velocity + spin * turned(point - origin)
                apart = own - walls
                found[name, side] = (
                    depth,
                    side * float(apart @ normal),
                    float(apart @ along),
                    point,
                    side * normal,
                    along,
                )
        return found

    def acceleration(self, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """q''."""
        here = self.places(q, v)
        mass = np.array(self.masses)
        force = mass * np.tile([*self.gravity, 0.0], mass.size // 3)
        rate = here.rows @ v
        if self.speeds:
            chi = exact_damping_factor(self.restitution)
            pairs = self.pairs(here.at, rate)
            for key, speed in self.speeds.items():
                depth, closing, slip, point, outward, along = pairs[key]
                if depth <= 0.0:
                    continue
                push = max(0.0, self.stiffness * depth**1.5 * (1.0 + chi * closing / speed))
                on_block = -push * outward - self.rub(slip) * push * along
                for first, sign in ((self.block, 1.0), (self.carrier, -1.0)):
                    if first is not None:
                        force[first : first + 2] += sign * on_block
                        arm = point - here.at[first : first + 2]
                        force[first + 2] += sign * (arm[0] * on_block[1] - arm[1] * on_block[0])
        system = here.rows.T @ (mass[:, None] * here.rows)
        return np.linalg.solve(system, here.rows.T @ (force - mass * here.bend))

    def rub(self, slip: float) -> float:
        """Friction over normal force, against the slip."""
        law = self.friction
        if law is None:
            return 0.0
        ramp = (abs(slip) - law.static_speed) / (law.dynamic_speed - law.static_speed)
        return math.copysign(law.sliding_coefficient * min(1.0, max(0.0, ramp)), slip)

    def run(self, q: Sequence[float], v: Sequence[float], end: float, rtol: float = TIGHT) -> np.ndarray:
        """q and q' at the end [s]; `touches` are filled."""
        state, time, count = np.array([*q, *v], dtype=float), 0.0, len(q)
        keys = [(name, side) for name in self.corners for side in (1.0, -1.0)]

        def rates(t: float, y: np.ndarray) -> np.ndarray:
            return np.concatenate([y[count:], self.acceleration(y[:count], y[count:])])

        def pairs(y: np.ndarray) -> dict[Any, tuple[Any, ...]]:
            here = self.places(y[:count], y[count:])
            return self.pairs(here.at, here.rows @ y[count:])

        def event(key: Any) -> Callable[[float, np.ndarray], float]:
            def depth(t: float, y: np.ndarray) -> float:
                return float(pairs(y)[key][0])

            depth.terminal = True  # type: ignore[attr-defined]
            depth.direction = -1.0 if key in self.speeds else 1.0  # type: ignore[attr-defined]
            return depth

        while time < end:
            found = solve_ivp(
                rates,
                (time, end),
                state,
                method="DOP853",
                rtol=rtol,
                atol=1e-3 * rtol,
                max_step=LONGEST,
                events=[event(key) for key in keys],
            )
            time, state = float(found.t[-1]), found.y[:, -1]
            now = pairs(state)
            for key, times in zip(keys, found.t_events, strict=True):
                if not len(times) and not (abs(now[key][0]) < AT_ZERO and time < end):
                    continue
                closing = now[key][1]
                if key in self.speeds and closing < 0.0:
                    del self.speeds[key]
                elif key not in self.speeds and closing > 0.0:
                    self.speeds[key] = closing
                    self.touches.append(Touch(key[0], time, closing))
        return state


def turned(vector: np.ndarray) -> np.ndarray:
    """A vector turned by a quarter, counterclockwise."""
    return np.array([-vector[1], vector[0]])


def slider_crank_by_scipy(stiffness: float, friction: Ambrosio | None = None) -> GuideByScipy:
    """The equations of `slider_crank`."""
    a, b = 0.5 * BLOCK[0], 0.5 * BLOCK[1]
    return GuideByScipy(
        places=slider_crank_places,
        masses=[
            *(CRANK_MASS, CRANK_MASS, CRANK_INERTIA),
            *(ROD_MASS, ROD_MASS, ROD_INERTIA),
            *(SLIDER_MASS, SLIDER_MASS, SLIDER_INERTIA),
        ],
        gravity=(0.0, -GRAVITY),
        block=6,
        carrier=None,
        corners={"upper_left": (-a, b), "upper_right": (a, b), "lower_left": (-a, -b), "lower_right": (a, -b)},
        origin=(0.0, 0.0),
        direction=0.0,
        half_height=b + GAP,
        stiffness=stiffness,
        restitution=RESTITUTION,
        friction=friction,
    )


def pair_by_scipy(machine: FreePair, guide: ClearanceGuide, gravity: tuple[float, float]) -> GuideByScipy:
    """The equations of a block and its carrier; q: x, y, angle of the carrier, if it moves, and the block."""
    linkage = machine.linkage()
    slide, bodies = linkage.slides["guide"], list(linkage.bodies.values())
    columns = {name: 3 * n for n, name in enumerate(linkage.bodies)}
    c, s = math.cos(slide.direction), math.sin(slide.direction)
    upper, lower = guide.gaps
    middle = 0.5 * (upper - lower)
    if guide.block is None:
        parts = {"pin": (0.0, 0.0)}
        half = guide.pin_radius + 0.5 * (upper + lower)
    else:
        a, b = 0.5 * guide.block[0], 0.5 * guide.block[1]
        parts = {"upper_left": (-a, b), "upper_right": (a, b), "lower_left": (-a, -b), "lower_right": (a, -b)}
        half = b + 0.5 * (upper + lower)

    def from_centre(body: str, x: float, y: float) -> tuple[float, float]:
        bx, by = linkage.bodies[body].centre if body in linkage.bodies else (0.0, 0.0)
        return slide.point[0] + c * x - s * y - bx, slide.point[1] + s * x + c * y - by

    friction = guide.friction if isinstance(guide.friction, Ambrosio) else None
    return GuideByScipy(
        places=free_places,
        masses=[part for body in bodies for part in (body.mass, body.mass, body.inertia)],
        gravity=gravity,
        block=columns.get(slide.body),
        carrier=columns.get(slide.against),
        corners={name: from_centre(slide.body, x, y) for name, (x, y) in parts.items()},
        origin=from_centre(slide.against, 0.0, middle),
        direction=slide.direction,
        half_height=half,
        stiffness=guide.normal.stiffness,
        restitution=guide.normal.restitution,
        friction=friction,
        radius=guide.pin_radius or 0.0,
    )


def start_of(linkage: Linkage) -> tuple[list[float], list[float]]:
    """q and q' of free bodies, angles from the start on."""
    bodies = linkage.bodies.values()
    return (
        [part for body in bodies for part in (*body.centre, 0.0)],
        [part for body in bodies for part in (*body.velocity, body.spin)],
    )
