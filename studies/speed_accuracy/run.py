"""What does a number cost: speed against accuracy, for every way to compute it.

Five scenes with 1.5 mm of clearance in the rear-link pin, or 0.5 mm in a slider-crank's, or the user's
machine, each computed in many ways, and compared with a tight reference. Then runs that are asked for an
accuracy instead of settings: are the errors that they estimate those that they have?
"""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace

from studies.benchmarking import estimates, trade, trade_figure
from studies.benchmarking.estimates import Check, Truth
from studies.benchmarking.references import GOALS
from studies.benchmarking.scenes import BenchmarkScene
from studies.benchmarking.trade import ENGINE, ONCE, OURS_COMPILED, OURS_ENGINE
from studies.benchmarking.variants import BUILT_IN, STOCK, Way, WayRun, cheapest, front, ways
from studies.common.numbers import Number, rounded
from studies.common.options import Options
from studies.common.runs import bar
from studies.common.study import Study, StudyOutcome
from studies.common.words import TextTable
from studies.speed_accuracy import figures as speed_accuracy_figures
from studies.speed_accuracy import formulations
from studies.speed_accuracy.scenes import Known, known, scenes
from support_exudyn import Scenario, SimulationError
from support_exudyn.sweeps.precompile import precompile
from support_exudyn.sweeps.workers import Workers, worker_pool
from user_forces import InputError

SHORT_RUN = 0.1  # shorter runs are timed three more times, and the fastest counts [s]
TRADE = "error_and_time"  # the figure of this program and others
# measured here; what takes longer comes from what the benchmark keeps
IN_STUDY = (OURS_COMPILED, OURS_COMPILED + ONCE, OURS_ENGINE + ONCE, "Exudyn, stock recipe")
KEY = "rise"  # the scene that the answer is of, if there is one of this name
Scenes = Mapping[str, BenchmarkScene]


# --- runs: nothing of them is kept, for they are timed ---


def rows(chosen: Scenes, against: Mapping[str, Known], pool: Workers) -> list[WayRun]:
    """Cost and errors of all ways, side by side, under a progress bar; times are those of the processor."""
    jobs = [(name, scene, n, against[name]) for name, scene in chosen.items() for n in range(len(ways(scene)))]
    with bar(f"{len(jobs)} ways") as told:
        found = pool.run(jobs, _row, told)
    once = [n for n, row in enumerate(found) if math.isnan(row.scatter) and _is_reported(row, found)]
    with bar(f"{len(once)} times again") as told:
        times = pool.run([jobs[n][1:3] for n in once], _timed, told)
    for n, seconds in zip(once, times, strict=True):
        found[n] = _with_times(found[n], [found[n].seconds, seconds])
    return found


def _row(place: int, name: str, scene: BenchmarkScene, n: int, against: Known) -> WayRun:
    del place
    precompile()  # compiling is not what is timed
    way = ways(scene)[n]
    began = time.process_time()
    try:
        found, steps = way.run()
        times = [time.process_time() - began]
        if times[0] < SHORT_RUN:
            times += [_processor_time(way) for _ in range(3)]
    except (SimulationError, InputError, RuntimeError) as error:
        reason = str(error).splitlines()[0]
        return WayRun(name, way.family, way.label, float("nan"), 0, failure=reason)
    row = WayRun(name, way.family, way.label, times[0], steps, against.errors(found))
    return _with_times(row, times) if len(times) > 1 else row


def _timed(place: int, scene: BenchmarkScene, n: int) -> float:
    del place
    precompile()
    return _processor_time(ways(scene)[n])


def _processor_time(way: Way) -> float:
    began = time.process_time()
    way.bare()
    return time.process_time() - began


def _with_times(row: WayRun, times: Sequence[float]) -> WayRun:
    return replace(row, seconds=min(times), scatter=max(times) - min(times))


def _is_reported(row: WayRun, found: Sequence[WayRun]) -> bool:
    """Whether a row is the cheapest of its family, which is timed at least twice."""
    return row is cheapest([other for other in found if (other.scene, other.family) == (row.scene, row.family)])


def _known(place: int, name: str, scene: BenchmarkScene) -> Known:
    del place
    return known(name, scene)


def checks(chosen: Scenes, against: Mapping[str, Known], pool: Workers) -> list[Check]:
    """Runs to an accuracy, each compared with the tight run of its scene."""
    jobs = [
        (name, scene, scenario, against[name].truth)
        for name, scene in chosen.items()
        for scenario in estimates.asked_for(scene)
    ]
    with bar(f"{len(jobs)} runs to an accuracy") as told:
        return [found for found in pool.run(jobs, _check, told) if found is not None]


def _check(place: int, name: str, scene: BenchmarkScene, scenario: Scenario, truth: Truth) -> Check | None:
    """None if the accuracy is out of reach, as the program then says."""
    del place
    precompile()
    try:
        return estimates.check(name, scene, scenario, truth)
    except (SimulationError, InputError):
        return None


# --- numbers ---


def numbers(found: Sequence[WayRun], checked: Sequence[Check], against: Mapping[str, Known]) -> list[Number]:
    """What the summary says: cheapest ways to the goal, and how good the estimates are."""
    said = []
    for name in against:
        of_scene = [row for row in found if row.scene == name]
        for family in dict.fromkeys(row.family for row in of_scene):
            best = cheapest([row for row in of_scene if row.family == family])
            if best is not None:
                said.append(Number(f"time to the goal, {family}", name, best.seconds, "s", best.scatter))
        for goal, error in against[name].own_errors.items():
            # of an error no more than the size is known
            said.append(Number(f"reference's own error, {goal}", name, error, "1", error))
    if judged := [one for one in checked if one.is_judged]:
        covered, stated = estimates.coverage(judged), estimates.overstatement(judged)
        said.append(Number("estimate_coverage", "all scenes", covered.value, "1", covered.error))
        said.append(Number("estimate_overstatement_median", "all scenes", stated.value, "1", stated.error))
    return said


# --- tables ---


def fastest_table(looked_at: Scenes, found: Sequence[WayRun]) -> TextTable:
    """Of each scene the time of the fastest setting that meets the goal, by the way."""
    tried_at_all = {row.family for row in found}
    shown = [way for way in ("compiled", ENGINE, STOCK, BUILT_IN) if way in tried_at_all]
    rows = []
    for name in looked_at:
        best = _best(name, found)
        tried = {row.family for row in found if row.scene == name}
        cells = ("" if way not in tried else _time(best.get(way)) for way in shown)
        rows.append((name, *cells))
    return TextTable(("scene", *shown), tuple(rows), width=130)


def _time(row: WayRun | None) -> str:
    return "not met" if row is None else f"{rounded(row.seconds, row.scatter)} s"


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
    header = ("way", "setting", "", "time [s]", "steps", *GOALS)
    return TextTable(header, rows, left=3, width=190)


def _cost(row: WayRun) -> tuple[str, str]:
    if row.failure:
        return row.failure[:40], ""
    return f"{row.seconds:.3g}", str(row.steps)


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
        "left out": lambda c: str(c.left_out),
        "covered": lambda c: f"{100.0 * c.covered:.0f} %" if c.is_judged else "not judged",
        "overstated": lambda c: f"{estimates.overstatement([c]).value:.1f}" if c.is_judged else "",
    }
    rows = tuple(tuple(get(c) for get in columns.values()) for c in checked)
    return TextTable(tuple(columns), rows, left=4, width=130)


# --- the study ---


def work(chosen: Options) -> StudyOutcome:
    """Cost and errors of all ways, and of runs that are asked for an accuracy."""
    subject = chosen.subject
    looked_at = scenes(subject)
    with worker_pool(chosen.workers) as pool:
        with bar("references") as told:
            found_known = pool.run(list(looked_at.items()), _known, told)
        against = dict(zip(looked_at, found_known, strict=True))
        found = rows(looked_at, against, pool)
        checked = checks(looked_at, against, pool)
    same = formulations.compared(chosen) if subject.is_paper else []
    stems = {speed_accuracy_figures.stem(name): name for name in looked_at}
    points = trade.with_kept(list(trade.measured(IN_STUDY))) if subject.is_paper else []
    drawings = {TRADE: trade_figure.figure(points)} if points else {}
    drawings |= {
        stem: speed_accuracy_figures.figure([row for row in found if row.scene == name])
        for stem, name in stems.items()
    }
    tables = {"fastest": fastest_table(looked_at, found)}
    if same:
        tables["formulations"] = formulations.table(same)
    tables |= {"accuracies": accuracy_table(checked)} | {
        stem: table(name, found) for stem, name in stems.items()
    }
    reached = list(_reached(looked_at, found))
    judged = [one for one in checked if one.is_judged]
    words = {
        "trade": {TRADE: trade.caption(points)} if points else {},
        "scenes": {stem: looked_at[name] for stem, name in stems.items()},
        "reached": reached,
        "key": next((one for one in reached if one["name"] == KEY), reached[0] if reached else None),
        "covered": estimates.coverage(judged) if judged else None,
        "stated": estimates.overstatement(judged) if judged else None,
        "judged": sum(c.true.size for c in judged),
        "vague": {name: one.vague for name, one in against.items() if one.vague},
        "left_out": sum(c.left_out if c.is_judged else c.left_out + c.true.size for c in checked),
        "same": same,
        "agree": formulations.agree(same),
    }
    return StudyOutcome(numbers(found, checked, against) + formulations.numbers(same), words, drawings, tables)


def _reached(looked_at: Scenes, found: Sequence[WayRun]) -> Iterator[dict[str, object]]:
    """Of each scene whose goal is met: the fastest ways to it, and the stock recipe among them."""
    for name, scene in looked_at.items():
        best = _best(name, found)
        if best:
            yield {
                "name": name,
                "label": scene.label,
                "fastest": sorted(best.values(), key=lambda row: row.seconds)[:3],
                "stock": best.get(STOCK),
                "stock_tried": any(row.scene == name and row.family == STOCK for row in found),
            }


def _best(name: str, found: Sequence[WayRun]) -> dict[str, WayRun]:
    """The fastest row that meets the goal, of each family of ways to compute a scene that has one."""
    of_scene = [row for row in found if row.scene == name]
    families = dict.fromkeys(row.family for row in of_scene)
    return {f: row for f in families if (row := cheapest([row for row in of_scene if row.family == f]))}


study = Study("speed_accuracy", __doc__, work, seconds=65.0, own_machine=True)
main = study.main
