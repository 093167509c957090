"""Linkages that are drawn: chains of bars, slider-cranks in a guide with clearance, loose parallelograms.

Their sizes reach from centimetres to metres, and their records are far too coarse: a few in a run, at periods
that fit neither the motion nor the run's length. What a run prints must not depend on that.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from studies.extremes.drawn import Draw
from support_exudyn import (
    Body,
    ClearanceGuide,
    ClearancePin,
    Crank,
    CubicStep,
    Drive,
    Held,
    Linkage,
    PlanarLinkage,
    Scenario,
    Slide,
    Steady,
    TracePoint,
)
from support_exudyn.mechanics.postures import set_moving
from support_exudyn.model.linkage import GROUND, pinned
from user_forces import JournalContact

Place = tuple[float, float]
Random = np.random.Generator
Pins = Callable[[Draw, float, float], ClearancePin]  # of a size and a stiffness against the support's
Contacts = Callable[[Draw, float, float], JournalContact]
SMALLEST, LARGEST = 0.05, 5.0  # linkages [m]
OF_SUPPORT = 0.3  # size of a bore against the support's, per metre of the linkage
SOFTER = 0.1  # stiffness of a contact against the support's
RECORDS = 3.0, 12.0  # of a run
TURN = 0.1, 0.5  # of the crank in a run [rad]
GRAVITY = (0.0, -9.81)  # [m/s^2]


# --- linkages ---


def towards(degrees: float, length: float, start: Place = (0.0, 0.0)) -> Place:
    """Return the point at a distance [m] from another, in a direction from +x."""
    angle = math.radians(degrees)
    return start[0] + length * math.cos(angle), start[1] + length * math.sin(angle)


def bar_of(a: Place, b: Place, mass: float = 1.0) -> Body:
    """Return a uniform bar whose angle is that from a to b; places in m, mass in kg."""
    return Body(
        mass=mass,
        inertia=mass * math.dist(a, b) ** 2 / 12.0,
        centre=((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0),
        angle=math.atan2(b[1] - a[1], b[0] - a[0]),
    )


def apex(a: Place, b: Place, long: float, other: float, side: float = 1.0) -> Place | None:
    """Return where two bars from a and b meet, left of the line from a to b (side > 0) or right; or None."""
    apart = math.dist(a, b)
    along = (long**2 - other**2 + apart**2) / (2.0 * apart)
    square = long**2 - along**2
    if square < 0.0:
        return None
    x, y = (b[0] - a[0]) / apart, (b[1] - a[1]) / apart
    across = math.copysign(math.sqrt(square), side)
    return a[0] + along * x - across * y, a[1] + along * y + across * x


def chain(rng: Random, pairs: int, size: float = 1.0) -> Linkage:
    """Draw a closed linkage with one freedom: a crank, and pairs of bars that join two points each.

    One pair is a four-bar, two are a six-bar of Watt's or Stephenson's kind, three an eight-bar. Bars have a
    third point off their axis, from which the next pair may start; no loop is near a dead centre.
    """
    o, a = (0.0, 0.0), towards(rng.uniform(0.0, 360.0), 0.3 * size)
    bodies, pins = {"crank": bar_of(o, a)}, {"O": pinned(GROUND, "crank", o)}
    free: list[tuple[str, Place]] = [("crank", a)]
    grounds = [towards(rng.uniform(0.0, 360.0), rng.uniform(0.8, 1.5) * size) for _ in range(pairs)]
    for number in range(pairs):
        while True:
            # the crank moves the first pair; later ones hang on any two bodies
            first = free[0] if number == 0 else free[rng.integers(1, len(free))]
            others = [(GROUND, grounds[number]), *(one for one in free[1:] if one[0] != first[0])]
            second = others[rng.integers(0, len(others))] if number else others[0]
            apart = math.dist(first[1], second[1])
            if apart < 0.15 * size:
                continue
            long, other = rng.uniform(0.6, 1.4, 2) * apart
            top = apex(first[1], second[1], long, other, rng.choice([-1.0, 1.0]))
            angle = 0.0 if top is None else _corner(top, first[1], second[1])
            if top is not None and math.radians(35.0) < angle < math.radians(145.0):
                break
        one, two = f"link_{2 * number}", f"link_{2 * number + 1}"
        bodies |= {one: bar_of(first[1], top), two: bar_of(second[1], top)}
        pins |= {
            f"P{3 * number}": pinned(first[0], one, first[1]),
            f"P{3 * number + 1}": pinned(second[0], two, second[1]),
            f"P{3 * number + 2}": pinned(one, two, top),
        }
        free = [end for end in free if end not in (first, second)] if number else free
        for name, (start, end) in ((one, (first[1], top)), (two, (second[1], top))):
            aside = rng.uniform(-0.6, 0.6) * math.dist(start, end)
            free.append((name, towards(math.degrees(bodies[name].angle) + 90.0, aside, bodies[name].centre)))
    return Linkage(bodies=bodies, pins=pins)


def _corner(top: Place, a: Place, b: Place) -> float:
    one, two = np.subtract(a, top), np.subtract(b, top)
    return float(np.arccos(one @ two / np.linalg.norm(one) / np.linalg.norm(two)))


# --- scenes ---


def chain_scene(of: Draw, pin: Pins) -> Scenario:
    """Draw a four-, six- or eight-bar with clearance in up to three pins; its crank is driven or free."""
    size = of.log(SMALLEST, LARGEST)
    linkage = chain(of.random, int(of.random.integers(1, 4)), size)
    masses = {name: of.log(0.5, 4.0) * (2.0 * size) ** 2 for name in linkage.bodies}
    bodies = {
        n: replace(one, mass=masses[n], inertia=masses[n] * one.inertia) for n, one in linkage.bodies.items()
    }
    names = of.random.permutation(list(linkage.pins)).tolist()[: int(of.random.integers(1, 4))]
    pins = {name: pin(of, OF_SUPPORT * size, SOFTER) for name in names}
    return _scene(of, replace(linkage, bodies=bodies), "link_1", pins=pins)


def guide_scene(of: Draw, pin: Pins, contact: Contacts) -> Scenario:
    """Draw a slider-crank whose slider has clearance in its guide; two thirds start symmetric to it."""
    size = of.log(SMALLEST, LARGEST)
    crank, rod = size * of.even(0.15, 0.4), size
    symmetric = of.chance(0.67)  # both corners of a face then meet the wall at one instant
    knee = towards(0.0 if symmetric else of.even(-60.0, 60.0), crank)
    end = (knee[0] + math.sqrt(rod**2 - knee[1] ** 2), 0.0)
    mass, block = of.log(0.5, 4.0) * (2.0 * size) ** 2, (0.2 * size, 0.1 * size)
    linkage = Linkage(
        bodies={
            "crank": bar_of((0.0, 0.0), knee, 0.5 * mass),
            "rod": bar_of(knee, end, 0.5 * mass),
            "slider": Body(mass=mass, inertia=mass * (block[0] ** 2 + block[1] ** 2) / 12.0, centre=end),
        },
        pins={
            "O": pinned(GROUND, "crank", (0.0, 0.0)),
            "knee": pinned("crank", "rod", knee),
            "wrist": pinned("rod", "slider", end),
        },
        slides={"guide": Slide(body="slider", point=end)},
    )
    law = contact(of, OF_SUPPORT * size, SOFTER)
    guide = ClearanceGuide(
        gaps=(law.bearing.clearance, law.bearing.clearance),
        block=block,
        normal=law.normal,
        friction=law.friction,
    )
    loose = {"wrist": pin(of, OF_SUPPORT * size, SOFTER)} if of.chance(0.3) else {}
    return _scene(of, linkage, "slider", pins=loose, guides={"guide": guide})


def parallelogram_scene(of: Draw, pin: Pins) -> Scenario:
    """Draw a table on two equal links with four equal loose pins, whose contacts meet at one instant."""
    size = of.log(SMALLEST, LARGEST)
    up, wide = towards(of.even(40.0, 140.0), 0.5 * size), (size, 0.0)
    corner = (wide[0] + up[0], up[1])
    mass = of.log(0.5, 4.0) * (2.0 * size) ** 2
    linkage = Linkage(
        bodies={
            "left": bar_of((0.0, 0.0), up, 0.3 * mass),
            "right": bar_of(wide, corner, 0.3 * mass),
            "table": bar_of(up, corner, mass),
        },
        pins={
            "A": pinned(GROUND, "left", (0.0, 0.0)),
            "B": pinned("left", "table", up),
            "C": pinned("right", "table", corner),
            "D": pinned(GROUND, "right", wide),
        },
    )
    same = replace(pin(of, OF_SUPPORT * size, SOFTER), eccentricity=(0.0, 0.0))
    fall = of.even(0.02, 0.2) * math.sqrt(size / 9.81)
    return Scenario(
        machine=PlanarLinkage(drawing=_traced(linkage, "table")), pins=dict.fromkeys(linkage.pins, same),
        drive=Held(), gravity=GRAVITY, **_lasting(of, fall),
    )  # fmt: skip


def _scene(of: Draw, linkage: Linkage, body: str, **fields: Any) -> Scenario:
    """The scene of a linkage whose first body, the crank, is driven, or moves freely from its start on."""
    rate = of.log(2.0, 20.0) * float(of.random.choice([-1.0, 1.0]))
    duration = of.even(*TURN) / abs(rate)
    stroke = CubicStep(stroke=rate * duration, start=0.0, end=duration)
    drives: tuple[Drive, ...] = (Held(), Steady(rate=rate), stroke)
    drive, crank = of.pick(drives), next(iter(linkage.bodies))
    drawing = _traced(linkage, body)
    if isinstance(drive, Held):  # nothing drives it
        drawing = set_moving(drawing, {crank: rate})
    else:
        drawing = replace(drawing, cranks={"crank": Crank(body=crank)})
    fields["gravity"] = GRAVITY if of.chance(0.5) else (0.0, 0.0)
    return Scenario(machine=PlanarLinkage(drawing=drawing), drive=drive, **fields, **_lasting(of, duration))


def _lasting(of: Draw, duration: float) -> dict[str, Any]:
    """Of a run that lasts so long [s]: records far too coarse, and in a fifth the engine's formulation."""
    period = duration / of.even(*RECORDS)
    formulation = "exudyn" if of.chance(0.2) else "auto"
    return {"duration": duration, "record_period": period, "formulation": formulation}


def _traced(linkage: Linkage, body: str) -> Linkage:
    """The linkage with the path of a body's centre recorded."""
    return replace(linkage, points={"end": TracePoint(body=body, point=linkage.bodies[body].centre)})
