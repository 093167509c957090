"""The engine's model of a scenario, in the plane or in space."""

from __future__ import annotations

from support_exudyn.formulations.redundant.scene.scene import Scene
from support_exudyn.formulations.redundant.scene.scene_builder import build
from support_exudyn.formulations.redundant.space.scene import SpatialScene
from support_exudyn.formulations.redundant.space.scene_builder import build as build_in_space
from support_exudyn.scenario.scenario import Scenario

Model = Scene | SpatialScene


def model(scenario: Scenario) -> Model:
    """The model of a scenario at its start as the redundant formulation runs it, whatever its formulation is.

    Who asks for it releases it, see `InEngine.release`.
    """
    return build_in_space(scenario) if scenario.dimensions == 3 else build(scenario)
