"""A run in space: the same solver as in the plane on another model."""

from __future__ import annotations

from support_exudyn.channels import needs
from support_exudyn.progress import Progress
from support_exudyn.recorder import Recorder
from support_exudyn.solver import Run
from support_exudyn.spatial.observation import Observation
from support_exudyn.spatial.scene import SpatialScene
from support_exudyn.trajectory import Outcome

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
