"""All cases of the study: grids for the maps, the box, and random corners of every kind."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from studies.extremes import hydraulics, scenes
from studies.extremes.judge import Case
from studies.extremes.ranges import SPANS, Point, drawn
from support_exudyn import Scenario

SEED = 20261122
STEP_STIFFNESS, CLEARANCE_SPEED, FRICTION_STEP = (
    "step and stiffness",
    "clearance and speed",
    "friction and step",
)
MAPS = (STEP_STIFFNESS, CLEARANCE_SPEED, FRICTION_STEP)
BOX = "box"
HYDRAULICS = "hydraulics"
CORNERS = "corners"
RECORDS = 500  # of a stroke
PACE = 0.5
STROKE = 0.05  # [m]
SHORTEST_STEP = 5e-5  # [s]; shorter steps are tried in corners and in the maps, for they take long
GRIDS = {STEP_STIFFNESS: 13, CLEARANCE_SPEED: 12, FRICTION_STEP: 13}  # lines and columns


class Kind(NamedTuple):
    """A kind of random scenes: its part of all, and what makes a scene of a point, a number and a generator."""

    part: int
    make: Callable[[Point, int, np.random.Generator], Scenario]


RANDOM = {
    CORNERS: Kind(560, scenes.corner),
    BOX: Kind(520, scenes.drawn_boxed),
    "slider-crank": Kind(140, scenes.drawn_crank),
    "free impact": Kind(80, scenes.drawn_impact),
    "start": Kind(60, scenes.started),
    "solver": Kind(60, scenes.with_solver),
    "mass ratio": Kind(50, scenes.of_masses),
    "posture": Kind(70, scenes.of_posture),
    "dead centre": Kind(30, scenes.past_dead_centre),
    "all pins": Kind(30, scenes.everywhere),
    "no gravity": Kind(30, scenes.weightless),
    "hang-up": Kind(30, scenes.hung_up),
    "roof": Kind(40, scenes.under_roof),
    "columns": Kind(20, scenes.heavy_columns),
    "space": Kind(16, scenes.in_space),
    HYDRAULICS: Kind(1400, hydraulics.on_legs),
}
ALL = sum(kind.part for kind in RANDOM.values())
DRAWN = 447  # by default, a seventh of these


def cases(number: int = DRAWN) -> list[Case]:
    """All of them: those of the maps, and about so many drawn ones, at least one of every kind.

    A larger number draws those of a smaller one and others: each scene has random numbers of its own.
    """
    drawn_ones = (
        Case(f"{group} {i}", group, partial(drawn_scene, group, i))
        for group, kind in RANDOM.items()
        for i in range(max(1, round(number / ALL * kind.part)))
    )
    return [*mapped(), *drawn_ones]


def drawn_scene(group: str, i: int) -> Scenario:
    """The random scene of this number of a group. Raises InputError if it cannot be."""
    random = np.random.default_rng([SEED, [*RANDOM].index(group), i])
    point = replace(drawn(random, group == BOX), pace=PACE)
    if group != CORNERS:
        point = replace(point, step_s=max(point.step_s, SHORTEST_STEP))
    return RANDOM[group].make(point, i, random)


def mapped() -> Iterator[Case]:
    """The scenes of the maps."""
    size = GRIDS[STEP_STIFFNESS]
    for step in _axis("step_s", size):
        for stiffness in _axis("stiffness", size):
            point = Point(step_s=step, stiffness=stiffness, pace=PACE)
            values = {"step_s": step, "stiffness": stiffness}
            yield _case(STEP_STIFFNESS, values, partial(scenes.fallen, point))
    size = GRIDS[CLEARANCE_SPEED]
    for clearance in _axis("clearance_m", size):
        for time in np.geomspace(0.05, 100.0, size).tolist():
            point = Point(clearance_m=clearance)
            values = {"clearance_m": clearance, "speed_m_s": STROKE / time}
            make = partial(scenes.stroke_of, point, time, STROKE, "standard", RECORDS)
            yield _case(CLEARANCE_SPEED, values, make)
    size = GRIDS[FRICTION_STEP]
    for static in np.geomspace(1e-7, 5e-2, size).tolist():
        for step in _axis("step_s", size):
            rubbing = {"static_speed_m_s": static, "dynamic_speed_m_s": 2.0 * static}
            point = Point(step_s=step, mu=0.25, pace=PACE, **rubbing)
            values = {"static_speed_m_s": static, "step_s": step}
            yield _case(FRICTION_STEP, values, partial(scenes.fallen, point))


def _axis(name: str, size: int) -> list[float]:
    span = SPANS[name]
    values: list[float] = np.geomspace(span.low, span.high, size).tolist()
    return values


def _case(group: str, values: Mapping[str, float], make: Callable[[], Scenario]) -> Case:
    said = ", ".join(f"{name} {value:.3g}" for name, value in values.items())
    return Case(f"{group}: {said}", group, make, values)
