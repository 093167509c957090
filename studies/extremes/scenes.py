"""All cases of the study: grids for the maps, sensible scenes, and random corners of every kind."""

import itertools
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from studies.extremes import legs, supports
from studies.extremes.drawn import SPANS, Draw, Point, drawn_point
from studies.extremes.supports import ACCURACIES, fallen, limited, settings, times, to_accuracy
from support_exudyn import (
    ClearancePin,
    CubicStep,
    Held,
    Reciprocating,
    Scenario,
    Steady,
    cylinders_and_rods,
    ravn_slider_crank,
)
from support_exudyn.machines.free_impact import ImpactStand
from support_exudyn.scenario.scenario_data import Accuracy

SEED = 20261122
PACE = 0.5
SLIDER_PIN = "slider_pin"
SLIDER_BEARING = 0.01  # bore radius at the slider [m]
OF_IMPACT = 101.0  # records of two free bodies: none of them at the impact
MOST_OF_FLIGHT = 10_000.0  # steps of theirs
LONG_ROD = 0.12  # [m] of the slider-crank that passes dead centres
SHORTEST_STEP = 5e-5  # [s]; shorter steps are tried in corners and in the maps, for they take long


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


# --- other machines ---


def colliding(point: Point, i: int, of: Draw) -> Scenario:
    """Two free bodies without friction, of any mass ratio and speed, of which one flies in the other's bore."""
    ratio, speed = of.log(1e-4, 1e4), of.log(1e-4, 10.0)
    duration = 4.0 * point.clearance_m / speed
    return Scenario(
        machine=ImpactStand(bore_mass=1000.0, journal_mass=1000.0 / ratio, speed=speed),
        pins={"pin": replace(point, mu=0.0).pin},
        gravity=(0.0, 0.0),
        duration=duration,
        step=max(min(point.step_s, duration / OF_IMPACT), duration / MOST_OF_FLIGHT),
        record_period=duration / OF_IMPACT,
        solver=settings(point),
    )


def hung_up(point: Point, i: int, of: Draw) -> Scenario:
    """The slider-crank at rest at any angle, its rod hung up by friction in the clearance slider pin."""
    angle = of.even(0.0, 2.0 * math.pi)
    machine = replace(ravn_slider_crank(), start_angle=angle)
    pin = _small(replace(point, mu=max(point.mu, 0.5)))
    pin = replace(pin, eccentricity=(pin.contact.bearing.clearance * math.cos(angle), 0.0))
    return Scenario(
        machine=machine, pins={SLIDER_PIN: pin}, drive=Held(), solver=settings(point), **times(point)
    )


def cranked(point: Point, rpm: float, accuracy: Accuracy | None) -> Scenario:
    """A slider-crank through a revolution, with both of its dead centres."""
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


def drawn_crank(point: Point, i: int, of: Draw) -> Scenario:
    """A slider-crank of 10 to 10 000 rpm, by turns to the accuracies and at chosen steps."""
    return cranked(point, of.log(10.0, 1e4), (*ACCURACIES, None)[i % 4])


def _small(point: Point) -> ClearancePin:
    """The pin in the slider's bearing, whose clearance is at most half of the bore."""
    clearance = min(point.clearance_m, 0.5 * SLIDER_BEARING)
    light = 0.1 * point.stiffness  # as its bodies are
    return replace(point, clearance_m=clearance, bore_radius=SLIDER_BEARING, stiffness=light).pin


def past_dead_centre(point: Point, i: int, of: Draw) -> Scenario:
    """A crank nearly as long as its rod: the slider is then nearly at the crank's pivot.

    As long as each other they would have no dead centre left to pass.
    """
    share = 1.0 - of.log(1e-6, 10.0**-0.5)
    machine = replace(ravn_slider_crank(), rod_length=LONG_ROD, crank_length=LONG_ROD * share)
    return replace(cranked(point, 300.0, None), machine=machine)


# --- drawn scenes ---

BOX, HYDRAULICS, CORNERS = "box", "hydraulics", "corners"
# kinds of random scenes: their part of all, and the maker of a scene from a point, a number and random choices
RANDOM: dict[str, tuple[int, Callable[[Point, int, Draw], Scenario]]] = {
    CORNERS: (560, supports.corner),
    BOX: (520, supports.boxed),
    "slider-crank": (140, drawn_crank),
    "free impact": (80, colliding),
    "start": (60, supports.started),
    "solver": (60, supports.with_solver),
    "mass ratio": (50, supports.of_masses),
    "posture": (70, supports.of_posture),
    "dead centre": (30, past_dead_centre),
    "all pins": (30, supports.everywhere),
    "no gravity": (  # columns that go up and down: the journal flies from side to side
        30,
        lambda point, i, of: replace(
            fallen(point), gravity=(0.0, 0.0), drive=Reciprocating(stroke=0.01, period=0.1)
        ),
    ),
    "hang-up": (30, hung_up),
    "roof": (40, supports.under_roof),
    "columns": (20, lambda point, i, of: replace(fallen(point), actuators=cylinders_and_rods())),
    "space": (
        16,
        lambda point, i, of: replace(fallen(point), dimensions=3, duration=times(point, 0.05)["duration"]),
    ),
    HYDRAULICS: (1400, legs.on_legs),
}
ALL = sum(part for part, _ in RANDOM.values())
DRAWN = 447  # by default, a seventh of these


def drawn_scene(group: str, i: int) -> Scenario:
    """The random scene of this number of a group. Raises InputError if it cannot be."""
    of = Draw(np.random.default_rng([SEED, [*RANDOM].index(group), i]), sensible=group == BOX)
    point = replace(drawn_point(of), pace=PACE)
    if group != CORNERS:
        point = replace(point, step_s=max(point.step_s, SHORTEST_STEP))
    _, make = RANDOM[group]
    return make(point, i, of)


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
GRIDS = {STEP_STIFFNESS: 13, CLEARANCE_SPEED: 12, FRICTION_STEP: 13}  # lines and columns
RECORDS, STROKE = 500, 0.05  # of a stroke, and its length [m]


def mapped() -> Iterator[Case]:
    """The scenes of the maps."""
    usual = Point(pace=PACE)
    for step, stiffness in _grid(STEP_STIFFNESS, _span("step_s"), _span("stiffness")):
        make = partial(fallen, replace(usual, step_s=step, stiffness=stiffness))
        yield _case(STEP_STIFFNESS, {"step_s": step, "stiffness": stiffness}, make)
    for clearance, time in _grid(CLEARANCE_SPEED, _span("clearance_m"), (0.05, 100.0)):
        drive = CubicStep(stroke=STROKE, start=0.1 * time, end=1.1 * time)
        point = Point(clearance_m=clearance)
        make = partial(to_accuracy, point, drive, 1.2 * time, 1.2 * time / RECORDS, "standard")
        yield _case(CLEARANCE_SPEED, {"clearance_m": clearance, "speed_m_s": STROKE / time}, make)
    for static, step in _grid(FRICTION_STEP, (1e-7, 5e-2), _span("step_s")):
        point = replace(usual, step_s=step, mu=0.25, static_speed_m_s=static, dynamic_speed_m_s=2.0 * static)
        yield _case(FRICTION_STEP, {"static_speed_m_s": static, "step_s": step}, partial(fallen, point))


def _span(name: str) -> tuple[float, float]:
    return SPANS[name].low, SPANS[name].high


def _grid(group: str, *spans: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Pairs of values, evenly spaced by their logarithms between the ends of two spans."""
    first, second = (np.geomspace(*span, GRIDS[group]).tolist() for span in spans)
    yield from itertools.product(first, second)


def _case(group: str, values: Mapping[str, float], make: Callable[[], Scenario]) -> Case:
    named = ", ".join(f"{name} {value:.3g}" for name, value in values.items())
    return Case(f"{group}: {named}", group, make, values)
