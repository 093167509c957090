"""Tight references of the scenes: what is compared with them, how they are made, and where they are kept.

`python -m studies.benchmarking.references` makes them anew, in some minutes. Each is the finest
run of the compiled formulation; its own error is the distance from a run at ten times the tolerance.
"""

import json
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from studies.benchmarking.scenes import SCENES, BenchmarkScene
from support_exudyn import Result, Scenario, SolverSettings, simulate
from support_exudyn.files.whole_file import whole_file
from support_exudyn.simulation.provenance import versions

FILE = Path(__file__).with_name("references.json")
TIGHTEST, TIGHTEST_ON_OIL = 1e-12, 1e-11  # tolerances
ONSETS = 3  # each impact multiplies the errors of those before
# relative errors that are allowed of mean, deviation and largest value of the pin force, and of impact speeds
GOALS = {"mean": 1e-4, "spread": 1e-3, "peak": 1e-3, "onset 1": 1e-3, "onset 2": 1e-3, "onset 3": 1e-2}
Sample = Mapping[str, float]  # by the names of GOALS, in N and m/s


def sample(mean: float, spread: float, peak: float, speeds: Sequence[float]) -> Sample:
    """What is compared of a run: mean, deviation and largest pin force [N] and the speeds of impacts [m/s]."""
    padded = [*speeds[:ONSETS], *[math.nan] * ONSETS][:ONSETS]
    onsets = {f"onset {n + 1}": speed for n, speed in enumerate(padded)}
    return {"mean": mean, "spread": spread, "peak": peak, **onsets}


def of_result(scene: BenchmarkScene, result: Result) -> Sample:
    """What is compared of a run of ours; mean and deviation are over the time from `scene.after` on."""
    force = result.window(f"pin.{scene.pin}.force", scene.after)
    speeds = [onset.speed for onset in result.onsets[scene.pin][:ONSETS]]
    return sample(force.mean, force.std, result.largest_force[scene.pin], speeds)


def errors(found: Sample, reference: Sample) -> dict[str, float]:
    """Relative distances from the reference by the names of `GOALS`; infinite where a run lacks what that
    has.

    What the reference lacks, such as a third impact, is left out.
    """
    known = {name: value for name, value in reference.items() if math.isfinite(value) and value}
    off = {name: abs(found[name] / value - 1.0) for name, value in known.items()}
    return {name: value if math.isfinite(value) else math.inf for name, value in off.items()}


def times_the_goal(off: Mapping[str, float]) -> float:
    """The worst of the errors in units of what is allowed; at most 1: the goal is met."""
    return max(off[name] / GOALS[name] for name in off)


# --- made and kept ---


def tight_runs(scene: BenchmarkScene) -> tuple[Scenario, Scenario]:
    """The scene as the reference has it, and as its own error is found."""
    tightest = TIGHTEST_ON_OIL if scene.scenario.compliant_actuators else TIGHTEST
    solvers = [SolverSettings(tolerance=tolerance) for tolerance in (tightest, 10.0 * tightest)]
    first, second = (replace(scene.scenario, formulation="compiled", solver=solver) for solver in solvers)
    return first, second


def make() -> dict[str, Any]:
    """All references as plain data."""
    scenes = {}
    for name, scene in SCENES.items():
        first, second = (of_result(scene, simulate(run)) for run in tight_runs(scene))
        own = errors(second, first)
        print(f"{name}: own errors {', '.join(f'{k} {v:.0e}' for k, v in own.items())}", file=sys.stderr)
        scenes[name] = {
            "numbers": {key: value for key, value in first.items() if key in own},
            "own_errors": own,
        }
    return {"versions": versions(), "scenes": scenes}


def save(made: Mapping[str, Any]) -> None:
    """Write them, whole or not at all."""
    with whole_file(FILE) as temporary:
        temporary.write_text(json.dumps(made, allow_nan=False, indent=1) + "\n", encoding="utf-8")


def _kept() -> dict[str, Any]:
    scenes: dict[str, Any] = json.loads(FILE.read_text(encoding="utf-8"))["scenes"]
    return scenes


def references() -> dict[str, Sample]:
    """The references by scene."""
    return {name: item["numbers"] for name, item in _kept().items()}


def own_errors() -> dict[str, dict[str, float]]:
    """Errors of the references themselves, by scene and by the names of `GOALS`."""
    return {name: item["own_errors"] for name, item in _kept().items()}


if __name__ == "__main__":
    save(make())
