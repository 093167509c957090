"""Scenes at the extremes, made from a point of the ranges and what is special to a group.

A random scene of a group takes the point, its number in the group, by which alternatives take turns, and a
generator of random numbers that draws the rest.
"""

import math
from dataclasses import replace
from functools import cache
from typing import TypedDict

import numpy as np

from studies.common import paper_machine
from studies.extremes.ranges import Point
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
RECORDS = 101.0  # of two free bodies: none of them at the impact
MOST_OF_FLIGHT = 10_000.0  # steps of theirs
SLIDER_BEARING = 0.01  # bore radius at the slider [m]
ACCURACIES: tuple[Accuracy, ...] = ("draft", "standard", "reference")
STARTS = ("concentric", "closed", "overlapping", "settled")
BODIES = ("rear_link", "front_link", "shield", "canopy")
LONG_ROD = 0.12  # [m] of the slider-crank that passes dead centres
GROWTHS = (1.0, 8.0, 64.0)  # of steps


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


def near(point: Point) -> Point:
    """A journal that starts half as deep as it will come to rest, if the run is too short for a fall."""
    if times(point)["duration"] >= FALL or point.eccentricity != (0.0, 0.0):
        return point
    x, y = rest_direction()
    sign = 1.0 if point.bore == "first" else -1.0
    away = 1.0 + HALF * point.normal.resting_depth(LOAD) / point.clearance_m
    return replace(point, eccentricity=(sign * away * x, sign * away * y))


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


def stroke_of(point: Point, time: float, stroke: float, accuracy: Accuracy, records: int) -> Scenario:
    """The support raised or lowered within a time [s], to an accuracy."""
    drive = CubicStep(stroke=stroke, start=0.1 * time, end=1.1 * time)
    scene = Scenario(
        machine=reference_support(),
        pins={PIN: point.pin},
        drive=drive,
        duration=1.2 * time,
        record_period=1.2 * time / records,
        accuracy=accuracy,
        formulation="auto",
    )
    return limited(scene)


def boxed(point: Point, accuracy: Accuracy, drive: Drive) -> Scenario:
    """A physically sensible scene to an accuracy, with a drive or held."""
    scene = Scenario(
        machine=reference_support(),
        pins={PIN: point.pin},
        drive=drive,
        duration=BOXED * point.pace,
        record_period=1e-3 * point.pace,
        accuracy=accuracy,
        formulation="auto",
    )
    return limited(scene)


def drawn_boxed(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """A physically sensible scene: the accuracies take turns, and strokes with supports that are held."""
    return boxed(point, ACCURACIES[i % 3], Held() if i % 2 else gentle(point))


def limited(scene: Scenario) -> Scenario:
    """A scene to an accuracy, with as many steps as its formulation may take in a minute or so."""
    assert scene.goal is not None
    steps = MOST_STEPS if settings_for(scene, scene.goal).formulation == "exudyn" else MOST_EXPLICIT
    return replace(scene, solver=replace(scene.solver, most_steps=steps))


def gentle(point: Point) -> Drive:
    """A stroke as steep as the paper's, in the second half of the time."""
    seconds = BOXED * point.pace
    return CubicStep(stroke=0.1 * seconds, start=0.5 * seconds, end=0.9 * seconds)


def with_solver(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall with other settings of the solver, by turns on columns of oil."""
    point = replace(point, spectral_radius=(0.0, 0.5, 1.0, point.spectral_radius)[i % 4])
    solver = replace(settings(point), newton="full" if i % 2 else "modified", growth=GROWTHS[i % 3])
    actuators = paper_machine.oil_columns() if i % 2 else {}
    return replace(fallen(point), solver=solver, actuators=actuators)


def weightless(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """Columns that go up and down without gravity: the journal flies from side to side."""
    drive = Reciprocating(stroke=0.01, period=0.1)
    return replace(fallen(point), gravity=(0.0, 0.0), drive=drive)


def started(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The journal in the middle, touching, pressed in, or settled."""
    start = STARTS[i % len(STARTS)]
    x, y = rest_direction()
    share = {"concentric": 0.0, "closed": 1.0, "overlapping": 1.0, "settled": 0.0}[start]
    here = replace(point, bore="first", eccentricity=(share * x, share * y))
    if start == "overlapping":
        deeper = 1.0 + 1e-4 / point.clearance_m  # by 0.1 mm
        here = replace(here, eccentricity=(deeper * x, deeper * y))
    scene = fallen(here)
    return replace(scene, start="settled" if start == "settled" else "concentric")


def everywhere(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """Clearance in every pin at once, by turns with friction."""
    pin = (point if i % 2 else replace(point, mu=0.0)).pin
    machine = reference_support()
    return Scenario(
        machine=machine,
        pins=dict.fromkeys(machine.linkage().pins, pin),
        solver=settings(point),
        **times(point, 0.08),
    )


def logarithmic(random: np.random.Generator, low: float, high: float) -> float:
    """A number between two powers of ten, given by their exponents; its logarithm is even."""
    return float(10.0 ** random.uniform(low, high))


def of_masses(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """One body up to ten thousand times as heavy, or as light."""
    body, factor = BODIES[i % len(BODIES)], logarithmic(random, -4.0, 4.0)
    machine = reference_support()
    parts = {
        name: tuple(_heavier(part, factor) for part in kept) if name == body else kept
        for name, kept in machine.parts.items()
    }
    return replace(fallen(point), machine=replace(machine, parts=parts))


def _heavier(part: Part, factor: float) -> Part:
    moments = None
    if part.moments is not None:
        xx, yy, xy = part.moments
        moments = (factor * xx, factor * yy, factor * xy)
    return replace(part, mass=factor * part.mass, inertia=factor * part.inertia, moments=moments)


def colliding(point: Point, ratio: float, speed: float) -> Scenario:
    """Two free bodies of a mass ratio, one of which flies in the other's bore."""
    stand = ImpactStand(bore_mass=1000.0, journal_mass=1000.0 / ratio, speed=speed)
    crossing = point.clearance_m / speed
    duration = 4.0 * crossing
    return Scenario(
        machine=stand,
        pins={"pin": point.pin},
        gravity=(0.0, 0.0),
        duration=duration,
        step=max(min(point.step_s, duration / RECORDS), duration / MOST_OF_FLIGHT),
        record_period=duration / RECORDS,
        solver=settings(point),
    )


def drawn_impact(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """Two free bodies without friction, of any mass ratio and speed."""
    ratio, speed = logarithmic(random, -4.0, 4.0), logarithmic(random, -4.0, 1.0)
    return colliding(replace(point, mu=0.0), ratio, speed)


def of_posture(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The support from any height of its hinge, through any stroke within a tenth of a second."""
    height, stroke = float(random.uniform(1.0, 3.6)), float(random.uniform(-1.0, 1.5))  # [m]
    machine: HydraulicSupport = replace(reference_support(), start_hinge_height=height)
    return Scenario(
        machine=machine,
        pins={PIN: point.pin if i % 2 else IdealPin()},
        drive=CubicStep(stroke=stroke, start=0.01, end=0.11),
        solver=settings(point),
        **times(point),
    )


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
    start, end = span
    return Roof(
        body="canopy",
        point=place,
        gap=gap,
        stiffness=stiffness,
        damping=0.0,
        descent=CubicStep(stroke=gap + force / stiffness, start=start, end=end),
    )


def hung_up(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The slider-crank at rest at any angle, its rod hung up by friction in the clearance slider pin."""
    angle = float(random.uniform(0.0, 2.0 * math.pi))
    machine = replace(ravn_slider_crank(), start_angle=angle)
    pin = _small(replace(point, mu=max(point.mu, 0.5)))
    x = pin.contact.bearing.clearance
    return Scenario(
        machine=machine,
        pins={SLIDER_PIN: replace(pin, eccentricity=(x * math.cos(angle), 0.0))},
        drive=Held(),
        solver=settings(point),
        **times(point),
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


def in_space(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall, with both sides of the machine."""
    return replace(fallen(point), dimensions=3, duration=times(point, 0.05)["duration"], solver=settings(point))


def heavy_columns(point: Point, i: int, random: np.random.Generator) -> Scenario:
    """The fall with columns of two bodies each."""
    return replace(fallen(point), actuators=cylinders_and_rods())
