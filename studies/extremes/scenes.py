"""All scenes of the study: grids for the maps, physically sensible ones, and random corners of every kind.

A random scene of a group takes a point of the ranges, its number in the group, by which alternatives take
turns, and a generator of random numbers that draws the rest.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache, partial
from typing import TypedDict

import numpy as np

from studies.common import paper_machine
from studies.extremes.ranges import SPANS, Point
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Drive,
    Held,
    HydraulicSupport,
    IdealPin,
    Reciprocating,
    Roof,
    Scenario,
    SolverSettings,
    Steady,
    cylinders_and_rods,
    ravn_slider_crank,
    reference_support,
    simulate,
)
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.model.linkage import Part
from support_exudyn.scenario.scenario_data import Accuracy
from support_exudyn.simulation.automatic_settings import settings_for

PIN = paper_machine.CLEARANCE_PIN
SLIDER_PIN = "slider_pin"
IMPACT_STEPS = 64
MOST_STEPS, MOST_EXPLICIT = 60_000, 2_000_000  # of every run: none of them is worth more
# A run is as long as some thousand of its steps, but no longer than the fall and some bounces, and not so short
# that nothing happens in it.
SHORTEST, LONGEST, STEPS = 0.005, 0.08, 1000  # [s], [s], steps
BOXED = 0.3  # [s] of runs in the box
FALL = 0.03  # [s] that the journal takes to fall through its clearance and bounce
HALF, LOAD = 0.5, 5e4  # of the depth under this load [N], at which journals start in short runs
OF_IMPACT = 101.0  # records of two free bodies: none of them at the impact
MOST_OF_FLIGHT = 10_000.0  # steps of theirs
SLIDER_BEARING = 0.01  # bore radius at the slider [m]
ACCURACIES: tuple[Accuracy, ...] = ("draft", "standard", "reference")
STARTS = {
    "concentric": 0.0,
    "closed": 1.0,
    "overlapping": 1.0,
    "settled": 0.0,
}  # and how far off, in clearances
BODIES = ("rear_link", "front_link", "shield", "canopy")
LONG_ROD = 0.12  # [m] of the slider-crank that passes dead centres
GROWTHS = (1.0, 8.0, 64.0)  # of steps


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


class Times(TypedDict):
    """Step, time between records and duration [s]."""

    step: float
    record_period: float
    duration: float


def settings(point: Point) -> SolverSettings:
    """The settings of a run whose steps are chosen."""
    return SolverSettings(
        spectral_radius=point.spectral_radius, impact_steps=IMPACT_STEPS, most_steps=MOST_STEPS
    )


def times(point: Point, longest: float = LONGEST) -> Times:
    """Step, time between records and duration of a run."""
    period = max(1e-3, point.step_s)
    wanted = max(SHORTEST, point.pace * min(longest, STEPS * point.step_s))
    return {"step": point.step_s, "record_period": period, "duration": period * max(1, round(wanted / period))}


def logarithmic(random: np.random.Generator, low: float, high: float) -> float:
    """A number between two powers of ten, given by their exponents; its logarithm is even."""
    return float(10.0 ** random.uniform(low, high))


# --- the support that falls through its clearance ---


@cache
def rest_direction() -> tuple[float, float]:
    """From the bore's centre to where the journal of the rear pin lies at rest, bore in the base."""
    held = Scenario(
        machine=reference_support(),
        pins={PIN: Point().pin},
        duration=1e-3,
        start="settled",
        channels=(f"pin.{PIN}.eccentricity_?",),
    )
    result = simulate(held)
    x, y = (float(result[f"pin.{PIN}.eccentricity_{axis}"][0]) for axis in "xy")
    return x / math.hypot(x, y), y / math.hypot(x, y)


def near(point: Point) -> Point:
    """A journal that starts half as deep as it will come to rest, if the run is too short for a fall."""
    if times(point)["duration"] >= FALL or point.eccentricity != (0.0, 0.0):
        return point
    x, y = rest_direction()
    sign = 1.0 if point.bore == "first" else -1.0
    away = 1.0 + HALF * point.normal.resting_depth(LOAD) / point.clearance_m
    return replace(point, eccentricity=(sign * away * x, sign * away * y))


def fallen(point: Point) -> Scenario:
    """The support, held, with clearance in the rear pin whose journal falls and bounces."""
    return Scenario(
        machine=reference_support(), pins={PIN: near(point).pin}, solver=settings(point), **times(point)
    )


def corner(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall; by turns without static friction, and with friction whose two speeds are alike."""
    if i % 10 == 0:
        point = replace(point, static_speed_m_s=0.0)
    elif i % 10 == 1:
        point = replace(point, mu=max(point.mu, 0.1), static_speed_m_s=point.dynamic_speed_m_s)
    return fallen(point)


def with_solver(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall with other settings of the solver, by turns on columns of oil."""
    point = replace(point, spectral_radius=(0.0, 0.5, 1.0, point.spectral_radius)[i % 4])
    solver = replace(settings(point), newton="full" if i % 2 else "modified", growth=GROWTHS[i % 3])
    return replace(fallen(point), solver=solver, actuators=paper_machine.oil_columns() if i % 2 else {})


def weightless(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """Columns that go up and down without gravity: the journal flies from side to side."""
    drive = Reciprocating(stroke=0.01, period=0.1)
    return replace(fallen(point), gravity=(0.0, 0.0), drive=drive)


def started(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The journal in the middle, touching, pressed in by 0.1 mm, or settled."""
    start, share = [*STARTS.items()][i % len(STARTS)]
    if start == "overlapping":
        share += 1e-4 / point.clearance_m
    x, y = rest_direction()
    scene = fallen(replace(point, bore="first", eccentricity=(share * x, share * y)))
    return replace(scene, start="settled" if start == "settled" else "concentric")


def everywhere(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """Clearance in every pin at once, by turns with friction."""
    pin, machine = (point if i % 2 else replace(point, mu=0.0)).pin, reference_support()
    pins = dict.fromkeys(machine.linkage().pins, pin)
    return Scenario(machine=machine, pins=pins, solver=settings(point), **times(point, 0.08))


def of_masses(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A body up to ten thousand times as heavy, or as light."""
    body, factor = BODIES[i % len(BODIES)], logarithmic(random, -4.0, 4.0)
    machine = reference_support()
    parts = dict(machine.parts) | {body: tuple(_heavier(part, factor) for part in machine.parts[body])}
    return replace(fallen(point), machine=replace(machine, parts=parts))


def _heavier(part: Part, factor: float) -> Part:
    moments = None
    if part.moments is not None:
        xx, yy, xy = part.moments
        moments = (factor * xx, factor * yy, factor * xy)
    return replace(part, mass=factor * part.mass, inertia=factor * part.inertia, moments=moments)


def of_posture(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The support from any height of its hinge, through any stroke within a tenth of a second."""
    height, stroke = float(random.uniform(1.0, 3.6)), float(random.uniform(-1.0, 1.5))  # [m]
    machine: HydraulicSupport = replace(reference_support(), start_hinge_height=height)
    pins = {PIN: point.pin if i % 2 else IdealPin()}
    drive = CubicStep(stroke=stroke, start=0.01, end=0.11)
    return Scenario(machine=machine, pins=pins, drive=drive, solver=settings(point), **times(point))


def under_roof(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A roof that lands on the canopy and presses, with a clearance pin below; by turns on columns of oil."""
    force, stiffness = logarithmic(random, 4.0, 7.0), logarithmic(random, 7.0, 10.0)  # [N], [N/m]
    machine = reference_support()
    tip = machine.linkage().points["tip"].point
    place = (0.5 * (tip[0] + machine.start().hinge[0]), tip[1])
    return replace(
        fallen(replace(point, step_s=min(point.step_s, 1e-3))),
        loads={"roof": pressing_roof(place, 0.002, stiffness, force, (0.01, 0.09))},
        actuators=paper_machine.oil_columns() if i % 2 else {},
        duration=max(0.1, 0.12 * point.pace),
    )


def pressing_roof(
    place: tuple[float, float], gap: float, stiffness: float, force: float, span: tuple[float, float]
) -> Roof:
    """A roof that closes a gap [m] over a place of the canopy [m] and then presses with a force [N].

    stiffness: [N/m]. span: start and end of its descent [s].
    """
    descent = CubicStep(stroke=gap + force / stiffness, start=span[0], end=span[1])
    return Roof(body="canopy", point=place, gap=gap, stiffness=stiffness, damping=0.0, descent=descent)


def in_space(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall, with both sides of the machine."""
    return replace(fallen(point), dimensions=3, duration=times(point, 0.05)["duration"], solver=settings(point))


def heavy_columns(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall with columns of two bodies each."""
    return replace(fallen(point), actuators=cylinders_and_rods())


# --- the support to an accuracy ---


def to_accuracy(point: Point, drive: Drive, duration: float, period: float, accuracy: Accuracy) -> Scenario:
    """The support with a drive, to an accuracy; duration and time between records [s]."""
    scene = Scenario(
        machine=reference_support(),
        pins={PIN: point.pin},
        drive=drive,
        duration=duration,
        record_period=period,
        accuracy=accuracy,
        formulation="auto",
    )
    return limited(scene)


def stroke_of(point: Point, time: float, stroke: float, accuracy: Accuracy, records: int) -> Scenario:
    """The support raised or lowered within a time [s]."""
    drive = CubicStep(stroke=stroke, start=0.1 * time, end=1.1 * time)
    return to_accuracy(point, drive, 1.2 * time, 1.2 * time / records, accuracy)


def boxed(point: Point, accuracy: Accuracy, drive: Drive) -> Scenario:
    """A physically sensible scene, with a drive or held."""
    return to_accuracy(point, drive, BOXED * point.pace, 1e-3 * point.pace, accuracy)


def drawn_boxed(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A physically sensible scene: accuracies take turns, and rests with strokes as steep as the paper's."""
    seconds = BOXED * point.pace
    gentle = CubicStep(stroke=0.1 * seconds, start=0.5 * seconds, end=0.9 * seconds)
    return boxed(point, ACCURACIES[i % 3], Held() if i % 2 else gentle)


def limited(scene: Scenario) -> Scenario:
    """A scene to an accuracy, with as many steps as its formulation may take in a minute or so."""
    assert scene.goal is not None
    steps = MOST_STEPS if settings_for(scene, scene.goal).formulation == "exudyn" else MOST_EXPLICIT
    return replace(scene, solver=replace(scene.solver, most_steps=steps))


# --- other machines ---


def colliding(point: Point, ratio: float, speed: float) -> Scenario:
    """Two free bodies of a mass ratio, of which one flies in the other's bore."""
    duration = 4.0 * point.clearance_m / speed
    return Scenario(
        machine=ImpactStand(bore_mass=1000.0, journal_mass=1000.0 / ratio, speed=speed),
        pins={"pin": point.pin},
        gravity=(0.0, 0.0),
        duration=duration,
        step=max(min(point.step_s, duration / OF_IMPACT), duration / MOST_OF_FLIGHT),
        record_period=duration / OF_IMPACT,
        solver=settings(point),
    )


def drawn_impact(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """Two free bodies without friction, of any mass ratio and speed."""
    ratio, speed = logarithmic(random, -4.0, 4.0), logarithmic(random, -4.0, 1.0)
    return colliding(replace(point, mu=0.0), ratio, speed)


def hung_up(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The slider-crank at rest at any angle, its rod hung up by friction in the clearance slider pin."""
    angle = float(random.uniform(0.0, 2.0 * math.pi))
    machine = replace(ravn_slider_crank(), start_angle=angle)
    pin = _small(replace(point, mu=max(point.mu, 0.5)))
    pin = replace(pin, eccentricity=(pin.contact.bearing.clearance * math.cos(angle), 0.0))
    return Scenario(
        machine=machine, pins={SLIDER_PIN: pin}, drive=Held(), solver=settings(point), **times(point)
    )


def cranked(point: Point, rpm: float, accuracy: Accuracy | None) -> Scenario:
    """A slider-crank through a revolution, both of its dead centres among it."""
    speed = 2.0 * math.pi * rpm / 60.0
    duration = 2.0 * math.pi / speed
    scene = Scenario(
        machine=ravn_slider_crank(),
        pins={SLIDER_PIN: _small(point)},
        drive=Steady(rate=speed),
        duration=duration,
        record_period=duration / 200,
        step=min(point.step_s, duration / 200),
        solver=settings(point),
        formulation="auto",
    )
    return scene if accuracy is None else limited(replace(scene, accuracy=accuracy))


def drawn_crank(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A slider-crank of 10 to 10 000 rpm, by turns to the accuracies and at chosen steps."""
    return cranked(point, logarithmic(random, 1.0, 4.0), (*ACCURACIES, None)[i % 4])


def _small(point: Point) -> ClearancePin:
    """The pin in the slider's bearing, whose clearance is at most half of the bore."""
    clearance = min(point.clearance_m, 0.5 * SLIDER_BEARING)
    light = 0.1 * point.stiffness  # as its bodies are
    return replace(point, clearance_m=clearance, bore_radius=SLIDER_BEARING, stiffness=light).pin


def past_dead_centre(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A crank nearly as long as its rod: the slider is then nearly at the crank's pivot.

    As long as each other they would have no dead centre left to pass.
    """
    share = 1.0 - logarithmic(random, -6.0, -0.5)
    machine = replace(ravn_slider_crank(), rod_length=LONG_ROD, crank_length=LONG_ROD * share)
    return replace(cranked(point, 300.0, None), machine=machine)


# --- grids of the maps ---

STEP_STIFFNESS, CLEARANCE_SPEED, FRICTION_STEP = MAPS = (
    "step and stiffness", "clearance and speed", "friction and step",
)  # fmt: skip
GRIDS = {STEP_STIFFNESS: 13, CLEARANCE_SPEED: 12, FRICTION_STEP: 13}  # lines and columns
PACE = 0.5
RECORDS, STROKE = 500, 0.05  # of a stroke, and its length [m]


def mapped() -> Iterator[Case]:
    """The scenes of the maps."""
    size = GRIDS[STEP_STIFFNESS]
    for step in _axis("step_s", size):
        for stiffness in _axis("stiffness", size):
            point = Point(step_s=step, stiffness=stiffness, pace=PACE)
            values = {"step_s": step, "stiffness": stiffness}
            yield _case(STEP_STIFFNESS, values, partial(fallen, point))
    size = GRIDS[CLEARANCE_SPEED]
    for clearance in _axis("clearance_m", size):
        for time in np.geomspace(0.05, 100.0, size).tolist():
            values = {"clearance_m": clearance, "speed_m_s": STROKE / time}
            make = partial(stroke_of, Point(clearance_m=clearance), time, STROKE, "standard", RECORDS)
            yield _case(CLEARANCE_SPEED, values, make)
    size = GRIDS[FRICTION_STEP]
    for static in np.geomspace(1e-7, 5e-2, size).tolist():
        for step in _axis("step_s", size):
            rubbing = {"static_speed_m_s": static, "dynamic_speed_m_s": 2.0 * static}
            values = {"static_speed_m_s": static, "step_s": step}
            yield _case(
                FRICTION_STEP, values, partial(fallen, Point(step_s=step, mu=0.25, pace=PACE, **rubbing))
            )


def _axis(name: str, size: int) -> list[float]:
    values: list[float] = np.geomspace(SPANS[name].low, SPANS[name].high, size).tolist()
    return values


def _case(group: str, values: Mapping[str, float], make: Callable[[], Scenario]) -> Case:
    named = ", ".join(f"{name} {value:.3g}" for name, value in values.items())
    return Case(f"{group}: {named}", group, make, values)
