"""All cases of the study: those of the maps, and drawn ones of every kind."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from studies.extremes import legs, scenes
from studies.extremes.ranges import Point, drawn
from studies.extremes.scenes import PACE, Case, mapped
from support_exudyn import Scenario

SEED = 20261122
BOX, HYDRAULICS, CORNERS = "box", "hydraulics", "corners"
SHORTEST_STEP = 5e-5  # [s]; shorter steps are tried in corners and in the maps, for they take long
# kinds of random scenes: their part of all, and the maker of a scene from a point, a number and a generator
RANDOM: dict[str, tuple[int, Callable[[Point, int, np.random.Generator], Scenario]]] = {
    CORNERS: (560, scenes.corner),
    BOX: (520, scenes.drawn_boxed),
    "slider-crank": (140, scenes.drawn_crank),
    "free impact": (80, scenes.drawn_impact),
    "start": (60, scenes.started),
    "solver": (60, scenes.with_solver),
    "mass ratio": (50, scenes.of_masses),
    "posture": (70, scenes.of_posture),
    "dead centre": (30, scenes.past_dead_centre),
    "all pins": (30, scenes.everywhere),
    "no gravity": (30, scenes.weightless),
    "hang-up": (30, scenes.hung_up),
    "roof": (40, scenes.under_roof),
    "columns": (20, scenes.heavy_columns),
    "space": (16, scenes.in_space),
    HYDRAULICS: (1400, legs.on_legs),
}
ALL = sum(part for part, _ in RANDOM.values())
DRAWN = 447  # by default, a seventh of these


def cases(number: int = DRAWN) -> list[Case]:
    """All of them: those of the maps, and about so many drawn ones, at least one of every kind.

    A larger number draws those of a smaller one and others: each scene has random numbers of its own.
    """
    drawn_ones = (
        Case(f"{group} {i}", group, partial(drawn_scene, group, i))
        for group, (part, _) in RANDOM.items()
        for i in range(max(1, round(number / ALL * part)))
    )
    return [*mapped(), *drawn_ones]


def drawn_scene(group: str, i: int) -> Scenario:
    """The random scene of this number of a group. Raises InputError if it cannot be."""
    random = np.random.default_rng([SEED, [*RANDOM].index(group), i])
    point = replace(drawn(random, group == BOX), pace=PACE)
    if group != CORNERS:
        point = replace(point, step_s=max(point.step_s, SHORTEST_STEP))
    _, make = RANDOM[group]
    return make(point, i, random)
