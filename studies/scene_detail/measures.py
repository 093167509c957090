"""What is measured of a scene, what that changes against another, and what it costs."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from studies.common import rise
from studies.common.numbers import Number, with_error
from studies.common.runs import bar, halvings, impacts, with_coarser
from studies.scene_detail.scenes import FULLEST, REAR, DetailScene
from support_exudyn import Estimate, Failure, Result, Scenario, SimulationError, simulate
from support_exudyn.simulation.evidence.table import EvidenceTable, Tried, fields_of
from support_exudyn.simulation.recommend import STROKE, UNEQUAL
from support_exudyn.sweeps.workers import Workers, report, worker_pool

ROUNDING = 1e-7  # share of a number that no error is below
# what Newton's tolerance and rounding leave open, below which no error of such a number is put, by its unit
SMALLEST = {"N": 1e-3, "N m": 1e-3, "m": 1e-9, "m/s": 1e-9, "deg": 1e-8, "deg/s^2": 1e-2}
IMPACTS = 3
SHORT_RUN = 0.1  # shorter runs are timed again, alone [s]
MM, DEGREES = 1e3, rise.DEGREES
Get = Callable[[Result], float]
Numbers = dict[str, Estimate]
FROM_REFERENCE, FROM_FULLEST = "tip_distance_from_reference", "tip_distance_from_fullest"


class Change(NamedTuple):
    """What a number changes from one scene to another, and both numerical errors together, in one unit."""

    value: float
    error: float

    @property
    def below_error(self) -> bool:
        """Whether nothing can be said but that it is no larger than the errors."""
        return abs(self.value) <= self.error

    def scaled(self, scale: float) -> Change:
        """The number in another unit."""
        return Change(scale * self.value, abs(scale) * self.error)


def change(here: Estimate, there: Estimate) -> Change:
    """From there to here."""
    return Change(here.value - there.value, here.error + there.error)


class Cost(NamedTuple):
    """What a scene costs at its longer steps.

    seconds: processor time. scatter: of it [s]. steps. calls: of user functions, a step.
    """

    seconds: float
    scatter: float
    steps: int
    calls: float


@dataclass(frozen=True)
class MeasuredScene:
    """A scene that has been run: numbers with errors, cost, and the finer run."""

    scene: DetailScene
    numbers: Numbers
    cost: Cost
    run: Result


# --- numbers ---


def estimate(run: Result, unit: str, get: Get) -> Estimate:
    """A number of a run with its error, that of steps and of records, which is no less than rounding."""
    value, error = with_error(get, run)
    rounding = SMALLEST[unit] if unit == "m" else max(SMALLEST[unit], ROUNDING * abs(value))
    return Estimate(value, max(error, rounding), unit)


def measure(
    scenes: Mapping[str, DetailScene], runs: Mapping[str, tuple[Result, Cost]]
) -> dict[str, MeasuredScene]:
    """All numbers of all scenes."""
    made = {}
    for name, scene in scenes.items():
        run, cost = runs[name]
        measures = _of_stroke(scene, run)
        if scene.group == "unequal":
            measures |= _of_unequal(scene, run)
        numbers = {what: estimate(run, unit, get) for what, (unit, get) in measures.items()}
        if scene.reference and scene.group != "unequal":
            numbers[FROM_REFERENCE] = tip_distance(scene, run, runs[scene.reference][0])
        if scene.family == STROKE:
            numbers[FROM_FULLEST] = tip_distance(scene, run, runs[FULLEST][0])
        made[name] = MeasuredScene(scene, numbers, cost, run)
    return made


def _of_stroke(scene: DetailScene, result: Result) -> dict[str, tuple[str, Get]]:
    """Measures of the stroke, and of the first impacts of a clearance rear pin; a settled one has none."""
    force, turning = f"pin.{REAR}.force", "rear_link.angular_acceleration"

    def over_time(statistic: str, channel: str, scale: float = 1.0) -> Get:
        return lambda run: scale * getattr(run.window(channel, scene.begin, scene.end), statistic)

    of_all: Get = rise.Crest(force, 1.0, 0.0, scene.scenario.duration)
    if REAR in result.largest_force:  # of all steps
        of_all = lambda run: float(run.largest_force[REAR])  # noqa: E731
    of_canopy = rise.Crest("canopy.angular_acceleration", DEGREES, scene.begin, scene.end)
    measures: dict[str, tuple[str, Get]] = {
        "mean_pin_force": ("N", over_time("mean", force)),
        "std_pin_force": ("N", over_time("std", force)),
        "largest_pin_force_in_stroke": ("N", rise.Crest(force, 1.0, scene.begin, scene.end)),
        "largest_pin_force": ("N", of_all),
        "mean_tip_x": ("m", over_time("mean", "tip.x")),
        "mean_tip_y": ("m", over_time("mean", "tip.y")),
        "std_angular_acceleration": ("deg/s^2", over_time("std", turning, DEGREES)),
        "largest_canopy_acceleration": ("deg/s^2", of_canopy),
    }
    for n in range(min(IMPACTS, impacts(result, REAR))):
        measures[f"onset_speed_{n + 1}"] = "m/s", rise.onset(REAR, n, "speed")
    return measures


def _of_unequal(scene: DetailScene, result: Result) -> dict[str, tuple[str, Get]]:
    """Measures of columns driven apart."""

    def largest(*channels: str, scale: float = 1.0) -> Get:
        return lambda run: max(scale * float(np.abs(run[channel]).max()) for channel in channels)

    def last(channel: str) -> Get:
        return lambda run: float(run[channel][-1])

    def deepest(channel: str) -> Get:
        return lambda run: float(run[channel].max())

    moment, sides = f"pin.{REAR}.moment", ("left", "right")
    columns = {side: f"front_column_{side}.force" for side in sides}
    measures: dict[str, tuple[str, Get]] = {
        "largest_roll": ("deg", largest("canopy.roll", scale=DEGREES)),
        "largest_yaw": ("deg", largest("canopy.yaw", scale=DEGREES)),
        "largest_front_column_force": ("N", largest(*columns.values())),
    }
    for side, column in columns.items():
        measures[f"{side}_front_column_force_at_the_end"] = "N", last(column)
    if result.channels[f"{moment}_x"].is_determined:  # not of ideal pins, which share it at will
        measures["largest_moment"] = (
            "N m",
            lambda run: float(np.hypot(run[f"{moment}_x"], run[f"{moment}_y"]).max()),
        )
    for side in sides if REAR in scene.scenario.clearance_pins else ():
        measures[f"largest_{side}_depth"] = "m", deepest(f"pin.{REAR}.{side}_depth")
    return measures


def tip_distance(scene: DetailScene, run: Result, other: Result) -> Estimate:
    """Largest distance of the tip's paths of two scenes during the stroke [m]."""
    if run is other:
        return Estimate(0.0, 0.0, "m")

    def apart(one: Result, two: Result, every: int = 1) -> float:
        inside = rise.between(one, scene.begin, scene.end)
        away = [(one[f"tip.{axis}"] - two[f"tip.{axis}"])[inside][::every] for axis in "xy"]
        return float(np.hypot(*away).max())

    far = apart(run, other)
    error = far - apart(run, other, every=2)  # of records
    for one in (run, other):
        error += one.estimate(lambda coarser, one=one: apart(one, coarser)).error  # type: ignore[misc]
    return Estimate(far, max(error, SMALLEST["m"]), "m")


# --- for the summary and for advice ---


def listed(measured: Mapping[str, MeasuredScene]) -> list[Number]:
    """All numbers of all scenes, costs among them."""
    numbers = []
    for name, one in measured.items():
        numbers += [Number(what, name, size, unit, error) for what, (size, error, unit) in one.numbers.items()]
        cost = one.cost
        per_step, scatter = (1e6 * time / cost.steps for time in (cost.seconds, cost.scatter))
        numbers += [
            Number("processor_time", name, cost.seconds, "s", cost.scatter),
            Number("processor_time_of_a_step", name, per_step, "us", scatter),
            Number("user_function_calls_a_step", name, cost.calls, "1", 0.0),
            Number("steps", name, float(cost.steps), "1", 0.0),
        ]
    return numbers


def table(measured: Mapping[str, MeasuredScene], said: Mapping[str, str]) -> EvidenceTable:
    """What advice is taken from."""
    scenes = tuple(
        Tried(
            name, one.scene.family, fields_of(one.scene.scenario), one.numbers, round(one.cost.seconds, 4),
            one.cost.steps,
        )
        for name, one in measured.items()
    )  # fmt: skip
    unequal = next(name for name, one in measured.items() if one.scene.family == UNEQUAL)
    return EvidenceTable(scenes, {STROKE: FULLEST, UNEQUAL: unequal}, said)


def times_as_long(one: MeasuredScene, other: MeasuredScene) -> float:
    """Ratio of the costs."""
    return one.cost.seconds / other.cost.seconds


# --- runs ---


def run_timed(cases: Mapping[str, Scenario], workers: int | Workers) -> dict[str, tuple[Result, Cost]]:
    """Run every case at its steps, at half and at a quarter of them, in parallel, and time the first.

    Raises SimulationError if a run fails.
    """
    half = {name: case.refined() for name, case in cases.items()}
    jobs = [*((name, case.refined()) for name, case in half.items()), *half.items(), *cases.items()]
    with bar(f"{len(jobs)} runs") as show, worker_pool(workers) as pool:
        done = pool.run(jobs, _run, show)
    for (name, _), (result, _) in zip(jobs, done, strict=True):
        if isinstance(result, Failure):
            raise SimulationError(replace(result, reason=f"{name}: {result.reason}"))
    found = {}
    thirds = (done[n * len(cases) : (n + 1) * len(cases)] for n in range(3))
    for name, fine, middle, (coarse, seconds) in zip(cases, *thirds, strict=True):
        run = with_coarser([coarse, middle[0], fine[0]])
        steps, of_half = coarse.counts.steps, halvings(run)[1].counts.steps
        scatter = abs(seconds - middle[1] * steps / of_half)  # a step of the next finer run costs as much
        if seconds < SHORT_RUN:
            times = [_run(0, "", coarse.scenario)[1] for _ in range(4)]
            seconds, scatter = min(times), sorted(times)[2] - min(times)
        found[name] = run, Cost(seconds, scatter, steps, coarse.counts.user_function_calls / steps)
    return found


def _run(place: int, name: str, scenario: Scenario) -> tuple[Any, float]:
    """The result or failure of a run, and its processor time [s]."""
    del place, name
    begun = time.process_time()
    result = simulate(scenario, progress=report, throw=False)
    return result, time.process_time() - begun
