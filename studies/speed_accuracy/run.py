"""What does a number cost: speed against accuracy, for every way to compute it.

Five scenes with 1.5 mm of clearance in the rear-link pin, or 0.5 mm in a slider-crank's, each computed in many
ways, one after the other on one core, and compared with a stored tight reference. Then runs that are asked for
an accuracy instead of settings: are the errors that they estimate those that they have?
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from studies.benchmarking import estimates
from studies.benchmarking.estimates import Check
from studies.benchmarking.front import Row, cheapest, front
from studies.benchmarking.measures import GOALS, Sample, errors
from studies.benchmarking.process import timed
from studies.benchmarking.references import own_errors, references
from studies.benchmarking.scenes import SCENES
from studies.benchmarking.variants import STOCK, Way, ways
from studies.common.chapter import Chapter, Picture, Sheet
from studies.common.study import (
    Number,
    Options,
    options,
    rounded,
    run_main,
    save_figures,
    show_table,
    write_summary,
)
from studies.speed_accuracy import figures as speed_accuracy_figures
from support_exudyn import SimulationError
from support_exudyn.postprocessing.figures import style
from support_exudyn.sweeps.precompile import warm_up
from user_forces import InputError

STUDY = "speed_accuracy"
# Shorter runs are timed three more times, and the fastest counts [s].
SHORT_RUN, SHORT_RUN_IF_QUICK = 0.3, 0.03


# --- runs ---


def rows(quick: bool) -> list[Row]:
    """Cost and errors of all ways, one after the other, under a progress bar."""
    warm_up()  # compiling is not what is timed
    todo = [(name, way) for name, scene in SCENES.items() for way in ways(scene, quick)]
    known = references()
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:3.0f} %"))
    found = []
    with Progress(*columns, TimeRemainingColumn(), console=Console(stderr=True)) as bars:
        task = bars.add_task(f"{len(todo)} runs, one at a time", total=len(todo))
        for name, way in todo:
            found.append(_row(name, way, known[name], SHORT_RUN_IF_QUICK if quick else SHORT_RUN))
            bars.advance(task)
        return _times_of_the_cheapest(found, [way for _, way in todo])


def _row(name: str, way: Way, known: Sample, short: float) -> Row:
    try:
        began = time.perf_counter()
        done = way.run()
        times = [time.perf_counter() - began]
        if times[0] < short:
            times += [timed(way.bare) for _ in range(3)]
    except (SimulationError, InputError, RuntimeError) as error:
        reason = str(error).splitlines()[0]
        return Row(name, way.family, way.label, float("nan"), 0, 0, failure=reason)
    off = errors(done.sample, known)
    row = Row(name, way.family, way.label, times[0], done.steps, done.calls, off)
    return _with_times(row, times) if len(times) > 1 else row


def _with_times(row: Row, times: Sequence[float]) -> Row:
    return replace(row, seconds=min(times), scatter=max(times) - min(times))


def _times_of_the_cheapest(found: Sequence[Row], todo: Sequence[Way]) -> list[Row]:
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


def numbers(found: Sequence[Row], checked: Sequence[Check]) -> list[Number]:
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


def table(name: str, found: Sequence[Row]) -> Sheet:
    """All ways of a scene: cost and errors; the front and the stock recipe are marked."""
    of_scene = sorted((row for row in found if row.scene == name), key=lambda row: (row.family, row.label))
    best = front(of_scene)

    def mark(row: Row) -> str:
        marks = ["front"] * (row in best) + ["stock"] * (row.family == STOCK)
        marks += ["goal"] * (row.overall <= 1.0)
        return ", ".join(marks) or ("failed" if row.failure else "")

    return Sheet(
        title=f"Cost and errors, {SCENES[name].label}",
        header=("way", "setting", "", "time [s]", "steps", "calls", *_headings()),
        rows=tuple(
            (row.family, row.label, mark(row), *_cost(row), *(_brief(row.errors.get(goal)) for goal in GOALS))
            for row in of_scene
        ),
        caption=(
            "Errors are relative to the tight reference, the path's in metres; time of one core, the fastest "
            "of four if short; calls: evaluations of the contact in Python. Steps in the setting are "
            f"multiples of the scene's default, {SCENES[name].step:g} s. Goal: mean 1e-4, spread and peak "
            "1e-3, speeds of the first three touches 1e-3, 1e-3 and 1e-2. Front: no other way is both faster "
            "and closer to the goal."
        ),
        left=3,
    )


def _headings() -> tuple[str, ...]:
    return tuple(f"{goal} [m]" if goal == "path" else goal for goal in GOALS)


def _cost(row: Row) -> tuple[str, str, str]:
    if row.failure:
        return row.failure[:40], "", ""
    return f"{row.seconds:.3g}", str(row.steps), str(row.calls)


def _brief(error: float | None) -> str:
    return "" if error is None else f"{error:.0e}"


def accuracy_table(checked: Sequence[Check]) -> Sheet:
    """Runs to an accuracy: what they cost, how wrong they are, and what they say of it."""
    return Sheet(
        title="Runs that are asked for an accuracy",
        header=(
            "scene",
            "asked",
            "formulation",
            "met",
            "time [s]",
            "worst error",
            "numbers",
            "covered",
            "overstated",
        ),
        rows=tuple(
            (
                c.scene,
                c.asked,
                c.formulation,
                "yes" if c.met else "no",
                f"{c.seconds:.3g}",
                f"{c.off:.0e}",
                str(c.true.size),
                f"{100.0 * c.covered:.0f} %",
                f"{estimates.overstatement([c]).value:.1f}",
            )
            for c in checked
        ),
        caption=(
            "Time: of all runs that it took, three at least. Worst error: the largest relative true error of "
            "mean, spread and largest value of the pin forces, against a tight run. Covered: share of all "
            "numbers whose true error is not larger than estimated; overstated: estimated over true error, "
            "median."
        ),
        left=4,
    )


# --- words ---


def chapter(found: Sequence[Row], checked: Sequence[Check], quick: bool) -> Chapter:
    """The study as a chapter of the report."""
    return Chapter(
        study=STUDY,
        title="What a number costs: speed against accuracy",
        question="How fast is each way to compute a loose pin, how wrong is it, and does the program know?",
        method=(
            "Five scenes are computed in many ways, one after the other on one core, and compared with a "
            "tight reference: a drop with held columns, the rise of 1.5 mm without and with friction and on "
            "columns of oil, and half a revolution of the slider-crank. The references are runs in free "
            "coordinates at a tolerance of 1e-12 (on oil: of the tree at 1e-11); their own errors, the "
            "distance from another method or formulation, stand in the summary.",
            "The redundant formulation is the engine's rigid bodies with constraints under generalised alpha, "
            "with touches located; the tree its minimal coordinates under a Runge-Kutta method with error "
            "control; the reduced one the free coordinates without the engine, in plain Python or compiled. "
            "The stock recipe is what a script does that locates nothing: fixed steps and a Python function "
            "for the force.",
        ),
        findings=tuple(_findings(found, checked)),
        pictures=tuple(
            Picture(speed_accuracy_figures.stem(name), f"Work and precision, {SCENES[name].label}. {NOTE}")
            for name in SCENES
        ),
        sheets=(accuracy_table(checked), *(table(name, found) for name in SCENES)),
        quick=quick,
    )


NOTE = (
    "Upper row: wall time, lower row: evaluations of the contact in Python (ways that have none are not "
    "shown); ringed: the front; stars: the stock recipe."
)


def _findings(found: Sequence[Row], checked: Sequence[Check]) -> Iterator[str]:
    for name, scene in SCENES.items():
        of_scene = [row for row in found if row.scene == name]
        best = {}
        for family in dict.fromkeys(row.family for row in of_scene):
            if row := cheapest([row for row in of_scene if row.family == family]):
                best[family] = row
        if not best:
            continue
        times = sorted(best.values(), key=lambda row: row.seconds)
        said = "; ".join(f"{row.family}: {_time(row.seconds)} ({row.label})" for row in times[:5])
        stock = best.get(STOCK)
        ratio = f" The stock recipe takes {_time(stock.seconds)} ({stock.label})." if stock else ""
        if stock is None and any(row.family == STOCK for row in of_scene):
            ratio = " No step of the stock recipe that was tried meets it."
        yield f"{scene.label[0].upper()}{scene.label[1:]}. The goal is met by: {said}.{ratio}"
    covered, stated = estimates.coverage(checked), estimates.overstatement(checked)
    yield (
        "Asked for an accuracy, the program estimates its errors: they cover the true error of "
        f"{rounded(100.0 * covered.value, 100.0 * covered.error)} % of {sum(c.true.size for c in checked)} "
        f"numbers, and are {rounded(stated.value, stated.error)} times as large in the median (±: of a sample "
        "of so many)."
    )


def _time(seconds: float) -> str:
    return f"{1e3 * seconds:.0f} ms" if seconds < 1.0 else f"{seconds:.1f} s"


# --- main ---


def study(chosen: Options) -> None:
    """Run, measure, draw and write everything into the output folder."""
    started = time.perf_counter()
    found = rows(chosen.quick)
    checked = list(checks(chosen.quick))
    with style.look():
        drawings = {
            speed_accuracy_figures.stem(name): speed_accuracy_figures.figure(
                scene.label, [row for row in found if row.scene == name]
            )
            for name, scene in SCENES.items()
        }
    save_figures(chosen, drawings)
    show_table(chosen.out / "accuracies.txt", accuracy_table(checked), width=130)
    for name in SCENES:
        show_table(chosen.out / f"{speed_accuracy_figures.stem(name)}.txt", table(name, found), width=190)
    chapter(found, checked, chosen.quick).save(chosen.out)
    write_summary(chosen.out, STUDY, numbers(found, checked), time.perf_counter() - started)


def main(argv: Sequence[str] | None = None) -> int:
    """Entry of `python -m studies.speed_accuracy`."""
    description = (__doc__ or "").splitlines()[0]
    return run_main(study, options(STUDY, argv, description, taken=("quick",)))
