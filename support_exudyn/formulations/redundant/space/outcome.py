"""A run in space: the same solver as in the plane on another model."""

from __future__ import annotations

from support_exudyn.formulations.progress import Progress
from support_exudyn.formulations.redundant.solver.recorder import Recorder
from support_exudyn.formulations.redundant.solver.solver import Run
from support_exudyn.formulations.redundant.space.observation import Observation
from support_exudyn.formulations.redundant.space.scene import SpatialScene
from support_exudyn.mechanics.trajectory import Outcome
from support_exudyn.scenario.recorded_channels import needs

EDGES = {"left": 0, "right": -1}


def outcome(scene: SpatialScene, progress: Progress) -> Outcome:
    """Run a model in space. Raises SimulationError if it cannot be finished."""
    recorder = Recorder(scene, needs(scene.scenario))
    solving = Run(scene, recorder, progress)
    counts = solving.go()
    groups = scene.sections.items()
    edges = {
        f"{name}.{side}": group[n] for name, group in groups for side, n in EDGES.items() if len(group) > 1
    }
    return Outcome(
        trajectory=Observation(scene, recorder.history()),
        onsets={name: tuple(group[0].whole.onsets) for name, group in groups}
        | {name: tuple(pin.onsets) for name, pin in edges.items()},
        largest_force={name: group[0].whole.largest_force for name, group in groups}
        | {name: pin.largest_force for name, pin in edges.items()},
        impulses=tuple(solving.impulses),
        counts=counts,
    )
