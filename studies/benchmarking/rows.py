"""The rows of ours, one line each: what, scene, formulation, settings, against what, asked; how they are timed.

A row whose formulation this version does not have is left out, so rows for one that is to come can stand here.
"""

import time
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from functools import partial

from studies.benchmarking.others import BARE, IN_C, OTHERS, STOCK, Timing, connector
from studies.benchmarking.peers.built_in import Evaluator
from studies.benchmarking.references import errors, of_result, references, times_the_goal
from studies.benchmarking.row import (
    AUTO,
    LeftOutError,
    OurWay,
    Row,
    Setting,
    TimedTurn,
    accuracy,
    steps,
    tolerance,
)
from studies.benchmarking.row_scenes import SCENES
from studies.benchmarking.scenes import SCENES as WITH_REFERENCE
from studies.benchmarking.stopwatch import fastest
from support_exudyn import Scenario, SimulationError, simulate

TURNS = 3  # in which both sides are timed one after the other; the fastest of each counts
TOLERANCES = tuple(map(tolerance, (1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 1e-5, 1e-6)))
COARSE = tuple(steps(step, each, 8.0) for each in (64, 96, 128, 192, 256) for step in (1e-3, 5e-4))
STEEL = steps(1e-3, 128, 8.0)
PLAIN = (Setting("1e-5", solver={"tolerance": 1e-5}),)
DRAFT = (accuracy("draft"),)
CONNECTORS: tuple[tuple[str, Evaluator, str], ...] = (
    ("symbolic", "symbolic", "1.1"),
    ("Python", "python", "1.6"),
)
BOTH = ("exudyn", "compiled")


def _grows(what: str, large: str, small: str, asked: str, formulations: tuple[str, ...]) -> list[Row]:
    """The cost of a large scene against that of a small one, by several formulations."""
    return [
        Row(f"{what}: {name}", OurWay(large, name, PLAIN), OurWay(small, name, PLAIN), asked)
        for name in formulations
    ]


def _space(what: str, scene: str, plane: str) -> Row:
    return Row(f"rise in space: {what}", OurWay(scene, "exudyn"), OurWay(plane, "exudyn"), "2.5", 9.0)


ROWS: tuple[Row, ...] = (
    Row("rise to the goal, general equations", OurWay("rise", "compiled", TOLERANCES), IN_C, "15", 5.0),
    Row("rise to the goal, rigid bodies", OurWay("rise", "exudyn", COARSE), STOCK, "1/10", 20.0),
    Row("the same on cylinders", OurWay("rise, cylinders", "exudyn", (STEEL,)), STOCK, "1/10", 20.0),
    Row("rise on oil columns to the goal", OurWay("rise, oil", "compiled", TOLERANCES), "", "0.06 s", 5.0),
    _space("1.5 mm, no friction", "quick rise in space", "quick rise"),
    _space("1.5 mm, friction", "quick rise in space, friction", "quick rise, friction"),
    Row("five clearance pins with friction, 1 s", OurWay("five pins", AUTO, DRAFT), "", "3 s", 10.0),
    Row(
        "published crank-rocker, 10 turns: not met, its horizon told",
        OurWay("crank-rocker", AUTO, DRAFT),
        "",
        "1 s",
        10.0,
    ),
    Row("own law in Python", OurWay("own law", AUTO, DRAFT), OurWay("built-in law", AUTO, DRAFT), "1.5", 5.0),
    *(
        Row(f"connector, {name}: {scene}", connector(scene, kind), connector(scene, "built_in"), asked, 4.0)
        for scene in BARE
        for name, kind, asked in CONNECTORS
    ),
    *_grows("four times the time", "8 s", "2 s", "4", BOTH),
    *_grows("ten times the bars, ideal pins", "40 bars", "4 bars", "100", BOTH),
    *_grows("ten times the bars, one loose pin", "40 bars, one loose", "4 bars, one loose", "100", BOTH),
    *_grows("eight times the resting joints", "8 joints", "1 joint", "8", BOTH),
)


def there(row: Row) -> bool:
    """Whether this version has the formulations of a row."""
    return all(way.is_there for way in (row.ours, row.against) if isinstance(way, OurWay))


# --- in the process that measures ---


def timed_row(row: Row, most: float) -> Iterator[TimedTurn]:
    """Both sides of a row in turns, within a time [s] or once."""
    began = time.monotonic()
    with ExitStack() as held:
        sides = [(True, *_side(row.ours, held))]
        if row.against:
            label, timing = _side(row.against, held)
            scene = f"{row.against.scene}, " if isinstance(row.against, OurWay) else ""
            sides.append((False, f"{scene}{label}".removesuffix(", "), timing))
        first = time.monotonic()
        for turn in range(TURNS):
            for is_ours, label, seconds in sides:
                yield TimedTurn(is_ours, label, seconds())
            now = time.monotonic()
            if now - began + (now - first) / (turn + 1) > most:
                return


def _side(way: OurWay | str, held: ExitStack) -> tuple[str, Timing]:
    """How a side of a row is set, and what times it."""
    if isinstance(way, str):
        return way, held.enter_context(OTHERS[way]())
    scenario, name = SCENES[way.scene](), way.formulation
    if len(way.settings) > 1:
        setting = coarsest(way.scene, name, way.settings)
    else:
        (setting,) = way.settings
        simulate(setting.applied(_moment(scenario), name))  # imports and compiles
    return setting.words, partial(fastest, partial(simulate, setting.applied(scenario, name)))


def _moment(scenario: Scenario) -> Scenario:
    return replace(scenario, duration=scenario.recorded_every)


def coarsest(scene: str, formulation: str, settings: tuple[Setting, ...]) -> Setting:
    """The first setting that meets the goal of a scene. Raises LeftOutError if none does."""
    known, looked_at = references()[scene], WITH_REFERENCE[scene]
    for setting in settings:
        try:
            result = simulate(setting.applied(looked_at.scenario, formulation))
        except SimulationError:  # too coarse to be finished
            continue
        if times_the_goal(errors(of_result(looked_at, result), known)) <= 1.0:
            return setting
    raise LeftOutError("no setting meets the goal")
