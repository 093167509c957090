"""Tight references of the scenes: how they are made, and where they are kept.

`python -m studies.benchmarking.references` makes them anew, in some minutes. Each is the finest run of one
formulation; its own error is the distance from another: scipy's DOP853 in plain Python against the compiled
method of Dormand and Prince, both in free coordinates, or for columns of oil the tree against rigid bodies with
constraints.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from studies.benchmarking.measures import GOALS, Sample, errors, of_result
from studies.benchmarking.scenes import SCENES, Scene
from support_exudyn import Scenario, SolverSettings, simulate
from support_exudyn.files.whole_file import whole_file
from support_exudyn.simulation.provenance import versions

FILE = Path(__file__).with_name("references.json")
TIGHTEST = 1e-12
DIGITS = 13  # kept of a number


def tight_runs(scene: Scene) -> tuple[Scenario, Scenario]:
    """The scene as the reference has it, and as its own error is found."""
    if scene.scenario.oil_columns:
        tree = replace(scene.scenario, formulation="tree", solver=SolverSettings(tolerance=1e-11))
        finest = SolverSettings(impact_steps=4096, backend="symbolic")
        return tree, replace(scene.scenario, formulation="redundant", step=6.25e-5, solver=finest)
    solvers = [SolverSettings(tolerance=tolerance) for tolerance in (TIGHTEST, 10.0 * TIGHTEST)]
    first, second = (replace(scene.scenario, formulation="reduced", solver=solver) for solver in solvers)
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


def save(made: Mapping[str, Any], path: Path = FILE) -> None:
    """Write them, whole or not at all."""

    def brief(item: Any) -> Any:
        if isinstance(item, float):
            return float(f"{item:.{DIGITS}g}")
        if isinstance(item, Mapping):
            return {key: brief(value) for key, value in item.items()}
        return [brief(value) for value in item] if isinstance(item, list) else item

    with whole_file(path) as temporary:
        temporary.write_text(json.dumps(brief(made), allow_nan=False) + "\n", encoding="utf-8")


def references(path: Path = FILE) -> dict[str, Sample]:
    """The references by scene."""
    scenes = json.loads(path.read_text(encoding="utf-8"))["scenes"]
    return {name: Sample(item["numbers"], np.array(item["path"])) for name, item in scenes.items()}


def own_errors(path: Path = FILE) -> dict[str, dict[str, float]]:
    """Errors of the references themselves, by scene and by the names of `GOALS`."""
    scenes = json.loads(path.read_text(encoding="utf-8"))["scenes"]
    return {name: {goal: item["own_errors"][goal] for goal in GOALS} for name, item in scenes.items()}


if __name__ == "__main__":
    save(make())
