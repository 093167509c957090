"""What is compared of a run with the tight reference of its scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from studies.benchmarking.scenes import Scene
from support_exudyn import Result

Series = npt.NDArray[np.float64]
ONSETS = 3  # each touch multiplies the errors of those before
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
    scene: Scene,
    time: Series,
    force: Series,
    acceleration: Series,
    path: Sequence[Series],
    speeds: Sequence[float],
    peak: float,
) -> Sample:
    """What is looked at, from series at the scene's records.

    Arguments:
        time: [s]. force: in the loose pin [N]. acceleration: of the scene's body [rad/s^2]. path: of its point.
        speeds: of approach of the touches [m/s]. peak: largest force at any time [N].
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


def of_result(scene: Scene, result: Result) -> Sample:
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
    """Distances from the reference by the names of `GOALS`; infinite where there is nothing to compare."""
    off = {}
    for name in GOALS:
        if name == "path":
            off[name] = float(np.hypot(*(found.path - reference.path)).max())
        else:
            off[name] = abs(found.numbers[name] / reference.numbers[name] - 1.0)
    return {name: value if np.isfinite(value) else float("inf") for name, value in off.items()}


def times_the_goal(off: Mapping[str, float]) -> float:
    """The worst of the errors that the benchmark is of, in units of what it allows; at most 1: it is met."""
    return max(off[name] / GOALS[name] for name in OF_THE_BENCHMARK)
