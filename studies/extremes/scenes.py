"""All cases of the study: grids for the maps, sensible scenes, and random corners of every kind.

A random scene of a kind takes a point of the ranges, its number in the kind, by which alternatives take turns,
and random choices for the rest.
"""

import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import Any

import numpy as np

from studies.common import paper_machine
from studies.extremes.drawn import SPANS, Draw, Point, drawn_point
from studies.extremes.legs import on_legs, pressing_roof
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    IdealPin,
    Reciprocating,
    Scenario,
    SolverSettings,
    Steady,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.scenario.scenario_data import Accuracy
from support_exudyn.simulation.automatic_settings import settings_for

SEED = 20261122
PIN, SLIDER_PIN = paper_machine.CLEARANCE_PIN, "slider_pin"
IMPACT_STEPS = 64
MOST_STEPS, MOST_EXPLICIT = 60_000, 2_000_000  # of every run: none of them is worth more
# A run is as long as some hundred of its steps, but no longer than the fall and some bounces, and not so short
# that nothing happens in it.
SHORTEST, LONGEST, STEPS = 0.002, 0.04, 500  # [s], [s], steps
FALL = 0.03  # [s] that the journal takes to fall through its clearance and bounce
HALF, LOAD = 0.5, 5e4  # of the depth under this load [N], at which journals start in short runs
ACCURACIES: tuple[Accuracy, ...] = ("draft", "standard", "reference")
BODIES = ("rear_link", "front_link", "shield", "canopy")
SLIDER_BEARING = 0.01  # bore radius at the slider [m]
OF_IMPACT = 101.0  # records of two free bodies: none of them at the impact
MOST_OF_FLIGHT = 10_000.0  # steps of theirs
LONG_ROD = 0.12  # [m] of the slider-crank that passes dead centres
SHORTEST_STEP = 5e-5  # [s]; shorter steps are tried in corners and in the maps, for they take long


def at_steps(point: Point, longest: float = LONGEST, **fields: Any) -> Scenario:
    """The support with clearance in the rear pin, at the point's steps and up to so long [s]."""
    period = max(1e-3, point.step_s)
    wanted = max(SHORTEST, min(longest, STEPS * point.step_s))
    base: dict[str, Any] = {
        "machine": reference_support(), "pins": {PIN: point.pin}, "step": point.step_s,
        "record_period": period, "duration": period * max(1, round(wanted / period)),
        "solver": SolverSettings(
            spectral_radius=point.spectral_radius, impact_steps=IMPACT_STEPS, most_steps=MOST_STEPS
        ),
    }  # fmt: skip
    return Scenario(**(base | fields))


# --- the fall through the clearance ---


@cache
def rest_direction() -> tuple[float, float]:
    """From the bore's centre to where the journal of the rear pin lies at rest, bore in the base."""
    channels = tuple(f"pin.{PIN}.eccentricity_{axis}" for axis in "xy")
    result = simulate(
        Scenario(
            machine=reference_support(),
            pins={PIN: Point().pin},
            duration=1e-3,
            start="settled",
            channels=channels,
        )
    )
    x, y = (float(result[channel][0]) for channel in channels)
    return x / math.hypot(x, y), y / math.hypot(x, y)


def fallen(point: Point) -> Scenario:
    """The support, held, with clearance in the rear pin whose journal falls and bounces.

    If the run is too short for a fall, the journal starts half as deep as it will come to rest.
    """
    scene = at_steps(point)
    if scene.duration >= FALL or point.eccentricity != (0.0, 0.0):
        return scene
    x, y = rest_direction()
    away = 1.0 + HALF * point.normal.resting_depth(LOAD) / point.clearance_m
    away *= 1.0 if point.bore == "first" else -1.0
    return replace(scene, pins={PIN: replace(point, eccentricity=(away * x, away * y)).pin})


def corner(point: Point, i: int, of: Draw) -> Scenario:
    """The fall; by turns without static friction, and with friction whose two speeds are alike."""
    if i % 10 == 0:
        point = replace(point, static_speed_m_s=0.0)
    elif i % 10 == 1:
        point = replace(point, mu=max(point.mu, 0.1), static_speed_m_s=point.dynamic_speed_m_s)
    return fallen(point)


def with_solver(point: Point, i: int, of: Draw) -> Scenario:
    """The fall with other settings of the solver, by turns on columns of oil."""
    scene = fallen(replace(point, spectral_radius=(0.0, 0.5, 1.0, point.spectral_radius)[i % 4]))
    growth = (1.0, 8.0, 64.0)[i % 3]
    solver = replace(scene.solver, newton="full" if i % 2 else "modified", growth=growth)
    return replace(scene, solver=solver, actuators=paper_machine.oil_columns() if i % 2 else {})


def started(point: Point, i: int, of: Draw) -> Scenario:
    """The journal in the middle, in contact, indented by 0.1 mm, or settled."""
    share = (0.0, 1.0, 1.0 + 1e-4 / point.clearance_m, 0.0)[i % 4]
    x, y = rest_direction()
    scene = fallen(replace(point, bore="first", eccentricity=(share * x, share * y)))
    return replace(scene, start="settled" if i % 4 == 3 else "concentric")


def everywhere(point: Point, i: int, of: Draw) -> Scenario:
    """Clearance in every pin at once, by turns with friction."""
    pin = (point if i % 2 else replace(point, mu=0.0)).pin
    return at_steps(point, pins=dict.fromkeys(reference_support().linkage().pins, pin))


def of_masses(point: Point, i: int, of: Draw) -> Scenario:
    """A body up to ten thousand times as heavy, or as light."""
    body, factor, machine = BODIES[i % len(BODIES)], of.log(1e-4, 1e4), reference_support()
    parts = []
    for part in machine.parts[body]:
        moments = None
        if part.moments is not None:
            xx, yy, xy = part.moments
            moments = factor * xx, factor * yy, factor * xy
        parts.append(replace(part, mass=factor * part.mass, inertia=factor * part.inertia, moments=moments))
    machine = replace(machine, parts={**machine.parts, body: tuple(parts)})
    return replace(fallen(point), machine=machine)


def of_posture(point: Point, i: int, of: Draw) -> Scenario:
    """The support from any height of its hinge, through any stroke within a tenth of a second."""
    height, stroke = of.even(1.0, 3.6), of.even(-1.0, 1.5)  # [m]
    return at_steps(
        point,
        machine=replace(reference_support(), start_hinge_height=height),
        pins={PIN: point.pin if i % 2 else IdealPin()},
        drive=CubicStep(stroke=stroke, start=0.01, end=0.11),
    )


def under_roof(point: Point, i: int, of: Draw) -> Scenario:
    """A roof that lands on the canopy and loads it, with a clearance pin below; by turns on columns of oil."""
    force, stiffness = of.log(1e4, 1e7), of.log(1e7, 1e10)  # [N], [N/m]
    machine = reference_support()
    ends = machine.linkage().points["tip"].point[0], machine.start().hinge[0]
    return replace(
        fallen(replace(point, step_s=min(point.step_s, 1e-3))),
        loads={"roof": pressing_roof(machine, ends, 0.002, stiffness, force, (0.01, 0.09))},
        actuators=paper_machine.oil_columns() if i % 2 else {},
        duration=0.1,
    )


# --- to an accuracy ---


def to_accuracy(point: Point, drive: Drive, duration: float, period: float, accuracy: Accuracy) -> Scenario:
    """The support with a drive, to an accuracy; duration and time between records [s]."""
    scene = Scenario(
        machine=reference_support(),
        pins={PIN: point.pin},
        drive=drive,
        duration=duration,
        record_period=period,
    )
    return limited(scene, accuracy)


def limited(scene: Scenario, accuracy: Accuracy) -> Scenario:
    """The scene to an accuracy, with as many steps as its formulation may take in a minute or so."""
    scene = replace(scene, accuracy=accuracy, formulation="auto")
    assert scene.goal is not None
    steps = MOST_STEPS if settings_for(scene, scene.goal).formulation == "exudyn" else MOST_EXPLICIT
    return replace(scene, solver=replace(scene.solver, most_steps=steps))


def boxed(point: Point, i: int, of: Draw) -> Scenario:
    """A physically sensible scene: accuracies take turns, and rests with strokes as steep as the paper's."""
    gentle = CubicStep(stroke=0.015, start=0.075, end=0.135)
    return to_accuracy(point, Held() if i % 2 else gentle, 0.15, 5e-4, ACCURACIES[i % 3])


# --- other machines ---


def colliding(point: Point, i: int, of: Draw) -> Scenario:
    """Two free bodies without friction, of any mass ratio and speed, of which one flies in the other's bore."""
    ratio, speed = of.log(1e-4, 1e4), of.log(1e-4, 10.0)
    duration = 4.0 * point.clearance_m / speed
    return at_steps(
        point,
        machine=ImpactStand(bore_mass=1000.0, journal_mass=1000.0 / ratio, speed=speed),
        pins={"pin": replace(point, mu=0.0).pin},
        gravity=(0.0, 0.0),
        duration=duration,
        step=max(min(point.step_s, duration / OF_IMPACT), duration / MOST_OF_FLIGHT),
        record_period=duration / OF_IMPACT,
    )


def in_slider(point: Point) -> ClearancePin:
    """The pin in the slider's bearing, whose clearance is at most half of the bore."""
    clearance = min(point.clearance_m, 0.5 * SLIDER_BEARING)
    light = 0.1 * point.stiffness  # as its bodies are
    return replace(point, clearance_m=clearance, bore_radius=SLIDER_BEARING, stiffness=light).pin


def hung_up(point: Point, i: int, of: Draw) -> Scenario:
    """The slider-crank at rest at any angle, its rod hung up by friction in the clearance slider pin."""
    angle = of.even(0.0, 2.0 * math.pi)
    pin = in_slider(replace(point, mu=max(point.mu, 0.5)))
    pin = replace(pin, eccentricity=(pin.contact.bearing.clearance * math.cos(angle), 0.0))
    return at_steps(point, machine=replace(ravn_slider_crank(), start_angle=angle), pins={SLIDER_PIN: pin})


def cranked(point: Point, rpm: float) -> Scenario:
    """A slider-crank through a revolution, with both of its dead centres."""
    speed = 2.0 * math.pi * rpm / 60.0
    duration = 2.0 * math.pi / speed
    return at_steps(
        point,
        machine=ravn_slider_crank(),
        pins={SLIDER_PIN: in_slider(point)},
        drive=Steady(rate=speed),
        duration=duration,
        record_period=duration / 200,
        step=min(point.step_s, duration / 200),
        formulation="auto",
    )


def turned(point: Point, i: int, of: Draw) -> Scenario:
    """A slider-crank of 10 to 10 000 rpm, by turns to the accuracies and at chosen steps."""
    scene = cranked(point, of.log(10.0, 1e4))
    return scene if i % 4 == 3 else limited(scene, ACCURACIES[i % 4])


def past_dead_centre(point: Point, i: int, of: Draw) -> Scenario:
    """A crank nearly as long as its rod: the slider is then nearly at the crank's pivot.

    As long as each other they would have no dead centre left to pass.
    """
    share = 1.0 - of.log(1e-6, 10.0**-0.5)
    machine = replace(ravn_slider_crank(), rod_length=LONG_ROD, crank_length=LONG_ROD * share)
    return replace(cranked(point, 300.0), machine=machine)


# --- drawn scenes ---

BOX, HYDRAULICS, CORNERS = "box", "hydraulics", "corners"
# kinds of random scenes: their part of all, and the maker of a scene from a point, a number and random choices
RANDOM: dict[str, tuple[int, Callable[[Point, int, Draw], Scenario]]] = {
    CORNERS: (560, corner),
    BOX: (520, boxed),
    "slider-crank": (140, turned),
    "free impact": (80, colliding),
    "start": (60, started),
    "solver": (60, with_solver),
    "mass ratio": (50, of_masses),
    "posture": (70, of_posture),
    "dead centre": (30, past_dead_centre),
    "all pins": (30, everywhere),
    "no gravity": (  # columns that go up and down: the journal flies from side to side
        30,
        lambda point, i, of: replace(
            fallen(point), gravity=(0.0, 0.0), drive=Reciprocating(stroke=0.01, period=0.1)
        ),
    ),
    "hang-up": (30, hung_up),
    "roof": (40, under_roof),
    "columns": (20, lambda point, i, of: replace(fallen(point), actuators=cylinders_and_rods())),
    "space": (
        16,
        lambda point, i, of: replace(fallen(point), dimensions=3, duration=at_steps(point, 0.025).duration),
    ),
    HYDRAULICS: (
        1400,
        lambda point, i, of: replace(on_legs(point.pin, i, of), solver=at_steps(point).solver),
    ),
}
ALL = sum(part for part, _ in RANDOM.values())
DRAWN = 447  # by default, a seventh of these


@dataclass(frozen=True)
class Case:
    """A scene of the study.

    name, group: its name, and the group that it belongs to. scenario: makes it, or raises InputError. values:
    those that a map varies.
    """

    name: str
    group: str
    scenario: Callable[[], Scenario]
    values: Mapping[str, float] = field(default_factory=dict)


def drawn_scene(group: str, i: int) -> Scenario:
    """The random scene of this number of a group. Raises InputError if it cannot be."""
    of = Draw(np.random.default_rng([SEED, [*RANDOM].index(group), i]), sensible=group == BOX)
    point = drawn_point(of)
    if group != CORNERS:
        point = replace(point, step_s=max(point.step_s, SHORTEST_STEP))
    return RANDOM[group][1](point, i, of)


def cases(number: int = DRAWN) -> list[Case]:
    """All of them: those of the maps, and about so many drawn ones, at least one of every kind.

    A larger number draws those of a smaller one and others: each scene has random numbers of its own.
    """
    drawn = (
        Case(f"{group} {i}", group, partial(drawn_scene, group, i))
        for group, (part, _) in RANDOM.items()
        for i in range(max(1, round(number / ALL * part)))
    )
    return [*mapped(), *drawn]


# --- grids of the maps ---

STEP_STIFFNESS, CLEARANCE_SPEED, FRICTION_STEP = MAPS = (
    "step and stiffness", "clearance and speed", "friction and step",
)  # fmt: skip
RECORDS, STROKE = 500, 0.05  # of a stroke, and its length [m]


def mapped() -> Iterator[Case]:
    """The scenes of the maps."""

    def case(group: str, make: Callable[[], Scenario], **values: float) -> Case:
        named = ", ".join(f"{name} {value:.3g}" for name, value in values.items())
        return Case(f"{group}: {named}", group, make, values)

    def grid(lines: int, *spans: tuple[float, float]) -> Iterator[tuple[float, float]]:
        """Pairs of values, evenly spaced by their logarithms between the ends of two spans."""
        first, second = (np.geomspace(*span, lines).tolist() for span in spans)
        yield from itertools.product(first, second)

    clearances, stiffnesses, steps = (SPANS[name][:2] for name in ("clearance_m", "stiffness", "step_s"))
    for step, stiffness in grid(13, steps, stiffnesses):
        make = partial(fallen, Point(step_s=step, stiffness=stiffness))
        yield case(STEP_STIFFNESS, make, step_s=step, stiffness=stiffness)
    for clearance, time in grid(12, clearances, (0.05, 100.0)):
        drive = CubicStep(stroke=STROKE, start=0.1 * time, end=1.1 * time)
        point = Point(clearance_m=clearance)
        make = partial(to_accuracy, point, drive, 1.2 * time, 1.2 * time / RECORDS, "standard")
        yield case(CLEARANCE_SPEED, make, clearance_m=clearance, speed_m_s=STROKE / time)
    for static, step in grid(13, (1e-7, 5e-2), steps):
        point = Point(step_s=step, mu=0.25, static_speed_m_s=static, dynamic_speed_m_s=2.0 * static)
        yield case(FRICTION_STEP, partial(fallen, point), static_speed_m_s=static, step_s=step)
