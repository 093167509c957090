"""What does a number cost: speed against accuracy, for every way to compute it.

Five scenes with 1.5 mm of clearance in the rear-link pin, or 0.5 mm in a slider-crank's, each computed in many
ways, one after the other on one core, and compared with a stored tight reference. Then runs that are asked for
an accuracy instead of settings: are the errors that they estimate those that they have?
"""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from studies.benchmarking import estimates
from studies.benchmarking.estimates import Check
from studies.benchmarking.process import timed
from studies.benchmarking.references import GOALS, Sample, errors, own_errors, references
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.variants import STOCK, Way, WayRun, cheapest, front, ways
from studies.common.numbers import Number
from studies.common.options import Options
from studies.common.runs import bar
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.speed_accuracy import figures as speed_accuracy_figures
from support_exudyn import SimulationError
from support_exudyn.sweeps.precompile import precompile
from user_forces import InputError

# Shorter runs are timed three more times, and the fastest counts [s].
SHORT_RUN, SHORT_RUN_IF_QUICK = 0.3, 0.03


# --- runs ---


def rows(quick: bool) -> list[WayRun]:
    """Cost and errors of all ways, one after the other, under a progress bar."""
    precompile()  # compiling is not what is timed
    todo = [(name, way) for name, scene in SCENES.items() for way in ways(scene, quick)]
    known = references()
    found: list[WayRun] = []
    with bar(f"{len(todo)} runs, one at a time") as told:
        for name, way in todo:
            found.append(_row(name, way, known[name], SHORT_RUN_IF_QUICK if quick else SHORT_RUN))
            told([1.0] * len(found) + [0.0] * (len(todo) - len(found)))
        return _times_of_the_cheapest(found, [way for _, way in todo])


def _row(name: str, way: Way, known: Sample, short: float) -> WayRun:
    try:
        began = time.perf_counter()
        done = way.run()
        times = [time.perf_counter() - began]
        if times[0] < short:
            times += [timed(way.bare) for _ in range(3)]
    except (SimulationError, InputError, RuntimeError) as error:
        reason = str(error).splitlines()[0]
        return WayRun(name, way.family, way.label, float("nan"), 0, 0, failure=reason)
    off = errors(done.sample, known)
    row = WayRun(name, way.family, way.label, times[0], done.steps, done.calls, off)
    return _with_times(row, times) if len(times) > 1 else row


def _with_times(row: WayRun, times: Sequence[float]) -> WayRun:
    return replace(row, seconds=min(times), scatter=max(times) - min(times))


def _times_of_the_cheapest(found: Sequence[WayRun], todo: Sequence[Way]) -> list[WayRun]:
    """The rows; those that are reported as the cheapest of their family are timed at least twice."""
    again = []
    for row, way in zip(found, todo, strict=True):
        alike = [other for other in found if (other.scene, other.family) == (row.scene, row.family)]
        once = math.isnan(row.scatter) and row is cheapest(alike)
        again.append(_with_times(row, [row.seconds, timed(way.bare)]) if once else row)
    return again


def checks(quick: bool) -> Iterator[Check]:
    """Runs to an accuracy, each compared with the tight run of its scene."""
    tight = {}
    for name, scenario in estimates.asked_for(quick):
        if name not in tight:
            tight[name] = estimates.tight(SCENES[name])
        yield estimates.check(name, scenario, tight[name])


# --- numbers ---


def numbers(found: Sequence[WayRun], checked: Sequence[Check]) -> list[Number]:
    """What the summary says: cheapest ways to the goal, and how good the estimates are."""
    said = []
    for name in SCENES:
        of_scene = [row for row in found if row.scene == name]
        for family in dict.fromkeys(row.family for row in of_scene):
            best = cheapest([row for row in of_scene if row.family == family])
            if best is not None:
                said.append(Number(f"time to the goal, {family}", name, best.seconds, "s", best.scatter))
        for goal, error in own_errors()[name].items():
            unit = "m" if goal == "path" else "1"
            # of an error no more than the size is known
            said.append(Number(f"reference's own error, {goal}", name, error, unit, error))
    covered, stated = estimates.coverage(checked), estimates.overstatement(checked)
    said.append(Number("estimate_coverage", "all scenes", covered.value, "1", covered.error))
    said.append(Number("estimate_overstatement_median", "all scenes", stated.value, "1", stated.error))
    return said


# --- tables ---


def table(name: str, found: Sequence[WayRun]) -> TextTable:
    """All ways of a scene: cost and errors; the front and the stock recipe are marked."""
    of_scene = sorted((row for row in found if row.scene == name), key=lambda row: (row.family, row.label))
    best = front(of_scene)

    def mark(row: WayRun) -> str:
        marks = ["front"] * (row in best) + ["stock"] * (row.family == STOCK)
        marks += ["goal"] * (row.overall <= 1.0)
        return ", ".join(marks) or ("failed" if row.failure else "")

    rows = tuple(
        (row.family, row.label, mark(row), *_cost(row), *(_brief(row.errors.get(goal)) for goal in GOALS))
        for row in of_scene
    )
    header = ("way", "setting", "", "time [s]", "steps", "calls", *_headings())
    return TextTable(header, rows, left=3, width=190)


def _headings() -> tuple[str, ...]:
    return tuple(f"{goal} [m]" if goal == "path" else goal for goal in GOALS)


def _cost(row: WayRun) -> tuple[str, str, str]:
    if row.failure:
        return row.failure[:40], "", ""
    return f"{row.seconds:.3g}", str(row.steps), str(row.calls)


def _brief(error: float | None) -> str:
    return "" if error is None else f"{error:.0e}"


def accuracy_table(checked: Sequence[Check]) -> TextTable:
    """Runs to an accuracy: what they cost, how wrong they are, and what they say of it."""
    columns: dict[str, Callable[[Check], str]] = {
        "scene": lambda c: c.scene,
        "asked": lambda c: c.asked,
        "formulation": lambda c: c.formulation,
        "met": lambda c: "yes" if c.met else "no",
        "time [s]": lambda c: f"{c.seconds:.3g}",
        "worst error": lambda c: f"{c.off:.0e}",
        "numbers": lambda c: str(c.true.size),
        "covered": lambda c: f"{100.0 * c.covered:.0f} %",
        "overstated": lambda c: f"{estimates.overstatement([c]).value:.1f}",
    }
    rows = tuple(tuple(get(c) for get in columns.values()) for c in checked)
    return TextTable(tuple(columns), rows, left=4, width=130)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """Cost and errors of all ways, and of runs that are asked for an accuracy."""
    found = rows(chosen.quick)
    checked = list(checks(chosen.quick))
    stems = {speed_accuracy_figures.stem(name): name for name in SCENES}
    drawings = {
        stem: speed_accuracy_figures.figure(SCENES[name].label, [row for row in found if row.scene == name])
        for stem, name in stems.items()
    }
    tables = {"accuracies": accuracy_table(checked)} | {
        stem: table(name, found) for stem, name in stems.items()
    }
    words = {
        "scenes": {stem: SCENES[name] for stem, name in stems.items()},
        "reached": list(_reached(found)),
        "covered": estimates.coverage(checked),
        "stated": estimates.overstatement(checked),
        "judged": sum(c.true.size for c in checked),
    }
    return StudyOutcome(numbers(found, checked), words, drawings, tables)


def _reached(found: Sequence[WayRun]) -> Iterator[dict[str, object]]:
    """Of each scene whose goal is met: the fastest ways to it, and the stock recipe among them."""
    for name, scene in SCENES.items():
        of_scene = [row for row in found if row.scene == name]
        families = dict.fromkeys(row.family for row in of_scene)
        best = {f: row for f in families if (row := cheapest([row for row in of_scene if row.family == f]))}
        if best:
            yield {
                "label": scene.label,
                "fastest": sorted(best.values(), key=lambda row: row.seconds)[:5],
                "stock": best.get(STOCK),
                "stock_tried": STOCK in families,
            }


study = Study("speed_accuracy", __doc__, work)
main = study.main
