"""The support in drawn scenes: it falls through its clearance, is driven from any posture, or carries a roof.

A drawn scene of a group takes a point of the ranges, its number in the group, by which alternatives take turns,
and random choices for the rest.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from studies.common import paper_machine
from studies.extremes.drawn import Draw, Point
from support_exudyn import (
    CubicStep,
    Drive,
    Held,
    IdealPin,
    Machine,
    Roof,
    Scenario,
    SolverSettings,
    reference_support,
    simulate,
)
from support_exudyn.scenario.scenario_data import Accuracy
from support_exudyn.simulation.automatic_settings import settings_for

PIN = paper_machine.CLEARANCE_PIN
IMPACT_STEPS = 64
MOST_STEPS, MOST_EXPLICIT = 60_000, 2_000_000  # of every run: none of them is worth more
# A run is as long as some thousand of its steps, but no longer than the fall and some bounces, and not so short
# that nothing happens in it.
SHORTEST, LONGEST, STEPS = 0.002, 0.08, 1000  # [s], [s], steps
BOXED = 0.3  # [s] of runs in the box
FALL = 0.03  # [s] that the journal takes to fall through its clearance and bounce
HALF, LOAD = 0.5, 5e4  # of the depth under this load [N], at which journals start in short runs
ACCURACIES: tuple[Accuracy, ...] = ("draft", "standard", "reference")
BODIES = ("rear_link", "front_link", "shield", "canopy")


def settings(point: Point) -> SolverSettings:
    """The settings of a run whose steps are chosen."""
    return SolverSettings(
        spectral_radius=point.spectral_radius, impact_steps=IMPACT_STEPS, most_steps=MOST_STEPS
    )


def times(point: Point, longest: float = LONGEST) -> dict[str, Any]:
    """Step, time between records and duration of a run [s], as fields of its scenario."""
    period = max(1e-3, point.step_s)
    wanted = max(SHORTEST, point.pace * min(longest, STEPS * point.step_s))
    return {"step": point.step_s, "record_period": period, "duration": period * max(1, round(wanted / period))}


# --- the fall through the clearance ---


@cache
def rest_direction() -> tuple[float, float]:
    """From the bore's centre to where the journal of the rear pin lies at rest, bore in the base."""
    channels = [f"pin.{PIN}.eccentricity_{axis}" for axis in "xy"]
    held = Scenario(
        machine=reference_support(),
        pins={PIN: Point().pin},
        duration=1e-3,
        start="settled",
        channels=(f"pin.{PIN}.eccentricity_?",),
    )
    result = simulate(held)
    x, y = (float(result[channel][0]) for channel in channels)
    return x / math.hypot(x, y), y / math.hypot(x, y)


def fallen(point: Point) -> Scenario:
    """The support, held, with clearance in the rear pin whose journal falls and bounces.

    If the run is too short for a fall, the journal starts half as deep as it will come to rest.
    """
    if times(point)["duration"] < FALL and point.eccentricity == (0.0, 0.0):
        x, y = rest_direction()
        away = 1.0 + HALF * point.normal.resting_depth(LOAD) / point.clearance_m
        away *= 1.0 if point.bore == "first" else -1.0
        point = replace(point, eccentricity=(away * x, away * y))
    return Scenario(machine=reference_support(), pins={PIN: point.pin}, solver=settings(point), **times(point))


def corner(point: Point, i: int, of: Draw) -> Scenario:
    """The fall; by turns without static friction, and with friction whose two speeds are alike."""
    if i % 10 == 0:
        point = replace(point, static_speed_m_s=0.0)
    elif i % 10 == 1:
        point = replace(point, mu=max(point.mu, 0.1), static_speed_m_s=point.dynamic_speed_m_s)
    return fallen(point)


def with_solver(point: Point, i: int, of: Draw) -> Scenario:
    """The fall with other settings of the solver, by turns on columns of oil."""
    point = replace(point, spectral_radius=(0.0, 0.5, 1.0, point.spectral_radius)[i % 4])
    growth = (1.0, 8.0, 64.0)[i % 3]
    solver = replace(settings(point), newton="full" if i % 2 else "modified", growth=growth)
    return replace(fallen(point), solver=solver, actuators=paper_machine.oil_columns() if i % 2 else {})


def started(point: Point, i: int, of: Draw) -> Scenario:
    """The journal in the middle, in contact, indented by 0.1 mm, or settled."""
    share = (0.0, 1.0, 1.0 + 1e-4 / point.clearance_m, 0.0)[i % 4]
    x, y = rest_direction()
    scene = fallen(replace(point, bore="first", eccentricity=(share * x, share * y)))
    return replace(scene, start="settled" if i % 4 == 3 else "concentric")


def everywhere(point: Point, i: int, of: Draw) -> Scenario:
    """Clearance in every pin at once, by turns with friction."""
    pin, machine = (point if i % 2 else replace(point, mu=0.0)).pin, reference_support()
    pins = dict.fromkeys(machine.linkage().pins, pin)
    return Scenario(machine=machine, pins=pins, solver=settings(point), **times(point, 0.08))


def of_masses(point: Point, i: int, of: Draw) -> Scenario:
    """A body up to ten thousand times as heavy, or as light."""
    body, factor, machine = BODIES[i % len(BODIES)], of.log(1e-4, 1e4), reference_support()
    parts = []
    for part in machine.parts[body]:
        xx, yy, xy = (factor * moment for moment in part.moments or (0.0, 0.0, 0.0))
        moments = (xx, yy, xy) if part.moments is not None else None
        parts.append(replace(part, mass=factor * part.mass, inertia=factor * part.inertia, moments=moments))
    machine = replace(machine, parts={**machine.parts, body: tuple(parts)})
    return replace(fallen(point), machine=machine)


def of_posture(point: Point, i: int, of: Draw) -> Scenario:
    """The support from any height of its hinge, through any stroke within a tenth of a second."""
    height, stroke = of.even(1.0, 3.6), of.even(-1.0, 1.5)  # [m]
    return Scenario(
        machine=replace(reference_support(), start_hinge_height=height),
        pins={PIN: point.pin if i % 2 else IdealPin()},
        drive=CubicStep(stroke=stroke, start=0.01, end=0.11),
        solver=settings(point),
        **times(point),
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
        duration=max(0.1, 0.12 * point.pace),
    )


def pressing_roof(
    machine: Machine,
    ends: Sequence[float],
    gap: float,
    stiffness: float,
    force: float,
    span: tuple[float, float],
) -> Roof:
    """A roof that closes a gap [m] over the canopy and then loads it with a force [N].

    It lies in the middle of several places [m] along the canopy. stiffness: [N/m]. span: start and end of its
    descent [s].
    """
    place = sum(ends) / len(ends), machine.linkage().points["tip"].point[1]
    descent = CubicStep(stroke=gap + force / stiffness, start=span[0], end=span[1])
    return Roof(body="canopy", point=place, gap=gap, stiffness=stiffness, damping=0.0, descent=descent)


def leg_heads(machine: Machine) -> list[float]:
    """Where the legs carry the canopy, along it [m]."""
    actuators = machine.linkage().actuators.values()
    return [actuator.head_point[0] for actuator in actuators if actuator.head == "canopy"]


# --- to an accuracy ---


def to_accuracy(point: Point, drive: Drive, duration: float, period: float, accuracy: Accuracy) -> Scenario:
    """The support with a drive, to an accuracy; duration and time between records [s]."""
    return limited(
        Scenario(
            machine=reference_support(),
            pins={PIN: point.pin},
            drive=drive,
            duration=duration,
            record_period=period,
            accuracy=accuracy,
            formulation="auto",
        )
    )


def boxed(point: Point, i: int, of: Draw) -> Scenario:
    """A physically sensible scene: accuracies take turns, and rests with strokes as steep as the paper's."""
    seconds = BOXED * point.pace
    gentle = CubicStep(stroke=0.1 * seconds, start=0.5 * seconds, end=0.9 * seconds)
    return to_accuracy(point, Held() if i % 2 else gentle, seconds, 1e-3 * point.pace, ACCURACIES[i % 3])


def limited(scene: Scenario) -> Scenario:
    """A scene to an accuracy, with as many steps as its formulation may take in a minute or so."""
    assert scene.goal is not None
    steps = MOST_STEPS if settings_for(scene, scene.goal).formulation == "exudyn" else MOST_EXPLICIT
    return replace(scene, solver=replace(scene.solver, most_steps=steps))
