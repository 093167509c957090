"""What is measured of a scene, what that changes against another, and what it costs."""

from __future__ import annotations

import operator
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from studies.common import rise
from studies.common.numbers import Number, measured
from studies.common.runs import bar, halvings, impacts, with_coarser
from studies.scene_detail.scenes import FULLEST, REAR, DetailScene
from support_exudyn import Estimate, Failure, Result, Scenario, SimulationError, simulate
from support_exudyn.mechanics.time_statistics import TimeWindow
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
MEAN: Callable[[TimeWindow], float] = operator.attrgetter("mean")
STD: Callable[[TimeWindow], float] = operator.attrgetter("std")
Numbers = dict[str, Estimate]
FROM_REFERENCE, FROM_FULLEST = "tip_distance_from_reference", "tip_distance_from_fullest"


@dataclass(frozen=True)
class Change:
    """What a number changes from one scene to another, and both numerical errors together, in one unit."""

    value: float
    error: float

    @property
    def below_error(self) -> bool:
        """Whether nothing can be said but that it is no larger than the errors."""
        return abs(self.value) <= self.error

    def of(self, size: float) -> Change:
        """The number in per cent of a size."""
        return Change(100.0 * self.value / size, 100.0 * self.error / abs(size))

    def scaled(self, scale: float) -> Change:
        """The number in another unit."""
        return Change(scale * self.value, scale * self.error)


def change(here: Estimate, there: Estimate) -> Change:
    """From there to here."""
    return Change(here.value - there.value, here.error + there.error)


@dataclass(frozen=True)
class Cost:
    """What a scene costs at its longer steps.

    seconds: processor time. scatter: of it [s]. steps. calls: of user functions, a step.
    """

    seconds: float
    scatter: float
    steps: int
    calls: float

    @property
    def per_step(self) -> float:
        """Processor time of a step [us]."""
        return 1e6 * self.seconds / self.steps


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
    found = measured("", "", unit, run, get)
    rounding = SMALLEST[unit] if unit == "m" else max(SMALLEST[unit], ROUNDING * abs(found.value))
    return Estimate(found.value, max(found.numerical_error, rounding), unit)


def measure(scenes: Mapping[str, DetailScene], runs: Mapping[str, Timed]) -> dict[str, MeasuredScene]:
    """All numbers of all scenes."""
    finest = {name: timed.run for name, timed in runs.items()}
    found = {}
    for name, scene in scenes.items():
        numbers = _of_stroke(scene, finest[name]) | _impacts(finest[name])
        if scene.group == "unequal":
            numbers |= _of_unequal(scene, finest[name])
        elif scene.reference:
            numbers[FROM_REFERENCE] = tip_distance(scene, finest[name], finest[scene.reference])
        if scene.family == STROKE:
            numbers[FROM_FULLEST] = tip_distance(scene, finest[name], finest[FULLEST])
        found[name] = MeasuredScene(scene, numbers, _cost(runs[name]), finest[name])
    return found


def _of_stroke(scene: DetailScene, result: Result) -> Numbers:
    force = f"pin.{REAR}.force"

    def over_time(statistic: Callable[[TimeWindow], float], channel: str, scale: float = 1.0) -> Get:
        return lambda run: scale * statistic(run.window(channel, scene.begin, scene.end))

    def largest(channel: str, scale: float) -> Get:
        return rise.Crest(channel, scale, scene.begin, scene.end)

    at_all: Get = rise.Crest(force, 1.0, 0.0, scene.scenario.duration)
    if REAR in result.largest_force:  # at the ends of all steps
        at_all = lambda run: float(run.largest_force[REAR])  # noqa: E731
    measures: dict[str, tuple[str, Get]] = {
        "mean_pin_force": ("N", over_time(MEAN, force)),
        "std_pin_force": ("N", over_time(STD, force)),
        "largest_pin_force_in_stroke": ("N", largest(force, 1.0)),
        "largest_pin_force": ("N", at_all),
        "mean_tip_x": ("m", over_time(MEAN, "tip.x")),
        "mean_tip_y": ("m", over_time(MEAN, "tip.y")),
        "std_angular_acceleration": (
            "deg/s^2",
            over_time(STD, "rear_link.angular_acceleration", DEGREES),
        ),
        "largest_canopy_acceleration": ("deg/s^2", largest("canopy.angular_acceleration", DEGREES)),
    }
    return {name: estimate(result, unit, get) for name, (unit, get) in measures.items()}


def _impacts(result: Result) -> Numbers:
    """Speeds of the first impacts of the rear pin, if it is with clearance; a settled one has none."""
    return {
        f"onset_speed_{n + 1}": estimate(result, "m/s", rise.onset(REAR, n, "speed"))
        for n in range(min(IMPACTS, impacts(result, REAR)))
    }


def _of_unequal(scene: DetailScene, result: Result) -> Numbers:
    def largest(*channels: str, scale: float = 1.0) -> Get:
        return lambda run: max(scale * float(np.abs(run[channel]).max()) for channel in channels)

    def last(channel: str) -> Get:
        return lambda run: float(run[channel][-1])

    moment, column = f"pin.{REAR}.moment", "front_column"
    measures: dict[str, tuple[str, Get]] = {
        "largest_roll": ("deg", largest("canopy.roll", scale=DEGREES)),
        "largest_yaw": ("deg", largest("canopy.yaw", scale=DEGREES)),
        "largest_front_column_force": ("N", largest(f"{column}_left.force", f"{column}_right.force")),
        "left_front_column_force_at_the_end": ("N", last(f"{column}_left.force")),
        "right_front_column_force_at_the_end": ("N", last(f"{column}_right.force")),
    }
    if result.channels[f"{moment}_x"].is_determined:  # not of ideal pins, which share it at will
        measures["largest_moment"] = (
            "N m",
            lambda run: float(np.hypot(run[f"{moment}_x"], run[f"{moment}_y"]).max()),
        )
    if REAR in scene.scenario.clearance_pins:
        measures["largest_left_depth"] = "m", lambda run: float(run[f"pin.{REAR}.left_depth"].max())
        measures["largest_right_depth"] = "m", lambda run: float(run[f"pin.{REAR}.right_depth"].max())
    return {name: estimate(result, unit, get) for name, (unit, get) in measures.items()}


def tip_distance(scene: DetailScene, run: Result, other: Result) -> Estimate:
    """Largest distance of the tip's paths of two scenes during the stroke [m]."""
    if run is other:
        return Estimate(0.0, 0.0, "m")

    def wandering(one: Result) -> float:
        return one.estimate(lambda coarser: _apart(scene, one, coarser)).error

    far = _apart(scene, run, other)
    of_records = far - _apart(scene, run, other, every=2)
    error = wandering(run) + wandering(other) + of_records
    return Estimate(far, max(error, SMALLEST["m"]), "m")


def _apart(scene: DetailScene, one: Result, other: Result, every: int = 1) -> float:
    inside = rise.between(one, scene.begin, scene.end)
    away = [(one[f"tip.{axis}"] - other[f"tip.{axis}"])[inside][::every] for axis in ("x", "y")]
    return float(np.hypot(*away).max())


# --- cost ---


def _cost(run: Timed) -> Cost:
    coarse, half, _ = halvings(run.run)
    seconds = run.seconds
    # a step of the next finer run costs as much
    scatter = abs(seconds - run.half_seconds * coarse.counts.steps / half.counts.steps)
    if seconds < SHORT_RUN:
        times = [timed(coarse.scenario) for _ in range(4)]
        seconds, scatter = min(times), sorted(times)[2] - min(times)
    counts = coarse.counts
    calls = counts.user_function_calls / counts.steps
    return Cost(seconds, scatter, counts.steps, calls)


# --- for the summary and for advice ---


def listed(measured: Mapping[str, MeasuredScene]) -> list[Number]:
    """All numbers of all scenes, costs among them."""
    found = []
    for name, one in measured.items():
        found += [Number(what, name, size, unit, error) for what, (size, error, unit) in one.numbers.items()]
        cost = one.cost
        of_step = cost.scatter / cost.seconds * cost.per_step
        found += [
            Number("processor_time", name, cost.seconds, "s", cost.scatter),
            Number("processor_time_of_a_step", name, cost.per_step, "us", of_step),
            Number("user_function_calls_a_step", name, cost.calls, "1", 0.0),
            Number("steps", name, float(cost.steps), "1", 0.0),
        ]
    return found


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


@dataclass(frozen=True)
class Timed:
    """A run with errors of a case, and the processor times at its steps and at half of them [s]."""

    run: Result
    seconds: float
    half_seconds: float


def run_timed(cases: Mapping[str, Scenario], workers: int | Workers) -> dict[str, Timed]:
    """Run every case at its steps, at half and at a quarter of them, in parallel, under a progress bar.

    Raises SimulationError if a run fails.
    """
    half = {name: case.refined() for name, case in cases.items()}
    jobs = [*((name, case.refined()) for name, case in half.items()), *half.items(), *cases.items()]
    with bar(f"{len(jobs)} runs") as told, worker_pool(workers) as pool:
        done = pool.run(jobs, _run, told)
    found = {}
    for n, name in enumerate(cases):
        fine, middle, coarse = (_good(name, *done[k * len(cases) + n]) for k in range(3))
        found[name] = Timed(with_coarser([coarse[0], middle[0], fine[0]]), coarse[1], middle[1])
    return found


def _run(place: int, name: str, scenario: Scenario) -> tuple[Result | Failure, float]:
    del name
    begun = time.process_time()
    result = simulate(scenario, progress=report, throw=False)
    return result, time.process_time() - begun


def _good(name: str, result: Result | Failure, seconds: float) -> tuple[Result, float]:
    if isinstance(result, Failure):
        raise SimulationError(replace(result, reason=f"{name}: {result.reason}"))
    return result, seconds


def timed(scenario: Scenario) -> float:
    """Processor time of a run [s]."""
    return _good("", *_run(0, "", scenario))[1]
