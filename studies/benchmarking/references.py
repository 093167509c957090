"""Tight references of the scenes: what is compared with them, how they are made, and where they are kept.

`python -m studies.benchmarking.references` makes them anew, in some minutes. Each is the finest run of one
formulation; its own error is the distance from another run: one at ten times the tolerance, both by the
compiled formulation, or for columns of oil the compiled against the Exudyn one.
"""

import json
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from studies.benchmarking.scenes import SCENES, BenchmarkScene
from support_exudyn import Result, Scenario, SolverSettings, simulate
from support_exudyn.files.whole_file import whole_file
from support_exudyn.simulation.provenance import versions

FILE = Path(__file__).with_name("references.json")
TIGHTEST = 1e-12
DIGITS = 13  # kept of a number
Series = npt.NDArray[np.float64]
ONSETS = 3  # each impact multiplies the errors of those before
# what each error is of, and how small it is to be: the goal of the benchmark. Relative, the path's in metres.
GOALS = {
    "mean": 1e-4,
    "spread": 1e-3,
    "peak": 1e-3,
    "onset 1": 1e-3,
    "onset 2": 1e-3,
    "onset 3": 1e-2,
    "path": 1e-6,
    "acceleration": 1e-2,
}
PATH_POINTS = 250  # of a path that are compared
OF_THE_BENCHMARK = ("mean", "spread", "peak", "onset 1", "onset 2", "onset 3")


@dataclass(frozen=True)
class Sample:
    """What is looked at of a run, whoever made it.

    numbers: by the names of `GOALS`, but the path; in N, m/s, rad/s^2. path: of the traced point (2, n) [m].
    """

    numbers: Mapping[str, float]
    path: Series


def sample(
    scene: BenchmarkScene,
    time: Series,
    force: Series,
    acceleration: Series,
    path: Sequence[Series],
    speeds: Sequence[float],
    peak: float,
) -> Sample:
    """What is looked at, from series at the scene's records.

    Arguments:
        time: [s]. force: in the clearance pin [N]. acceleration: of the scene's body [rad/s^2]. path: of its
            point.
        speeds: of approach of the impacts [m/s]. peak: largest force at any time [N].
    """
    inside = time >= scene.after - 1e-9
    numbers = {
        "mean": float(force[inside].mean()),
        "spread": float(force[inside].std()),
        "peak": peak,
        "acceleration": float(acceleration[inside].std()),
    }
    for n in range(ONSETS):
        numbers[f"onset {n + 1}"] = float(speeds[n]) if n < len(speeds) else float("nan")
    return Sample(numbers, thinned(np.array(path)))


def thinned(path: Series) -> Series:
    """Some points of a path (..., n), evenly spread from the first on."""
    return path[..., :: max(1, path.shape[-1] // PATH_POINTS)]


def of_result(scene: BenchmarkScene, result: Result) -> Sample:
    """What is looked at of a run of ours."""
    return sample(
        scene,
        result.time,
        result[f"pin.{scene.pin}.force"],
        result[f"{scene.body}.angular_acceleration"],
        (result[f"{scene.point}.x"], result[f"{scene.point}.y"]),
        [onset.speed for onset in result.onsets[scene.pin][:ONSETS]],
        result.largest_force[scene.pin],
    )


def errors(found: Sample, reference: Sample) -> dict[str, float]:
    """Distances from the reference by the names of `GOALS`; infinite where a run lacks what that has.

    What the reference lacks, such as a third impact, is left out.
    """
    off = {}
    for name in GOALS:
        if name == "path":
            off[name] = float(np.hypot(*(found.path - reference.path)).max())
        elif known := reference.numbers[name]:
            off[name] = abs(found.numbers[name] / known - 1.0)
    off = {name: value for name, value in off.items() if not math.isnan(reference.numbers.get(name, 0.0))}
    return {name: value if np.isfinite(value) else float("inf") for name, value in off.items()}


def times_the_goal(off: Mapping[str, float]) -> float:
    """The worst of the errors that the benchmark is of, in units of what it allows; at most 1: it is met."""
    return max(off[name] / GOALS[name] for name in OF_THE_BENCHMARK if name in off)


# --- made and kept ---


def tight_runs(scene: BenchmarkScene) -> tuple[Scenario, Scenario]:
    """The scene as the reference has it, and as its own error is found."""
    if scene.scenario.compliant_actuators:
        tight = replace(scene.scenario, formulation="compiled", solver=SolverSettings(tolerance=1e-11))
        finest = SolverSettings(impact_steps=4096, backend="symbolic")
        return tight, replace(scene.scenario, formulation="exudyn", step=6.25e-5, solver=finest)
    solvers = [SolverSettings(tolerance=tolerance) for tolerance in (TIGHTEST, 10.0 * TIGHTEST)]
    first, second = (replace(scene.scenario, formulation="compiled", solver=solver) for solver in solvers)
    return first, second


def make() -> dict[str, Any]:
    """All references as plain data."""
    scenes = {}
    for name, scene in SCENES.items():
        first, second = (of_result(scene, simulate(run)) for run in tight_runs(scene))
        own = errors(second, first)
        print(f"{name}: own errors {', '.join(f'{k} {v:.0e}' for k, v in own.items())}", file=sys.stderr)
        scenes[name] = {"numbers": dict(first.numbers), "path": first.path.tolist(), "own_errors": own}
    return {"versions": versions(), "scenes": scenes}


def save(made: Mapping[str, Any]) -> None:
    """Write them, whole or not at all."""

    def brief(item: Any) -> Any:
        if isinstance(item, float):
            return float(f"{item:.{DIGITS}g}")
        if isinstance(item, Mapping):
            return {key: brief(value) for key, value in item.items()}
        return [brief(value) for value in item] if isinstance(item, list) else item

    with whole_file(FILE) as temporary:
        temporary.write_text(json.dumps(brief(made), allow_nan=False) + "\n", encoding="utf-8")


def _kept() -> dict[str, Any]:
    scenes: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))["scenes"]
    return scenes


def references() -> dict[str, Sample]:
    """The references by scene."""
    return {name: Sample(item["numbers"], np.array(item["path"])) for name, item in _kept().items()}


def own_errors() -> dict[str, dict[str, float]]:
    """Errors of the references themselves, by scene and by the names of `GOALS`."""
    return {name: {goal: item["own_errors"][goal] for goal in GOALS} for name, item in _kept().items()}


if __name__ == "__main__":
    save(make())
