"""The Exudyn formulation: Exudyn's rigid bodies with constraints, generalised alpha, located impacts.

It covers every scenario but friction in pins whose forces rigid bodies do not determine, and is the reference
for the others.
"""

import numpy as np

from support_exudyn.formulations.exudyn.observation import trajectory
from support_exudyn.formulations.exudyn.scene.scene_builder import build
from support_exudyn.formulations.exudyn.scene.static_equilibrium import find_static_equilibrium
from support_exudyn.formulations.exudyn.solver.recorder import History, Recorder
from support_exudyn.formulations.exudyn.solver.solver import SolverRun
from support_exudyn.machines.check.freedoms import FIELDS, repeated
from support_exudyn.mechanics.channels import with_causes
from support_exudyn.mechanics.observed_run import Outcome, Trajectory
from support_exudyn.scenario.recorded_channels import needs
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scene.contract import Progress
from user_forces.values.value import InputError


def check(scenario: Scenario) -> None:
    """Raise InputError if pins have friction whose forces rigid bodies do not determine."""
    still = np.zeros(3 * len(scenario.linkage.bodies))
    for one in repeated(scenario.held, still) if scenario.friction_laws else ():
        parts = [f"{FIELDS.get(kind, kind)}.{name}" for kind, name in one.parts]
        if rough := [name for name in parts if name in scenario.friction_laws]:
            raise InputError(
                f"{rough[0]}.friction: not covered by formulation = 'exudyn', for {one.said()}, and "
                "the engine takes any forces that fit; allowed: formulation = 'compiled', which takes the "
                "least, or a bushing in one of them"
            )


def run(scenario: Scenario, progress: Progress) -> Outcome:
    """Run a scenario. Raises SimulationError if it cannot be finished."""
    scene, needed = build(scenario), with_causes(needs(scenario))

    def observed(history: History) -> Trajectory:
        return trajectory(scene, history, needed)

    try:
        if scenario.start == "settled":
            find_static_equilibrium(scene)
        recorder = Recorder(scene, needed, observed)
        solving = SolverRun(scene, recorder, progress)
        counts = solving.go()
        contacts = scene.recorded_contacts()
        return Outcome(
            trajectory=observed(recorder.history()),
            onsets={name: tuple(one.onsets) for name, one in contacts.items()},
            largest_force={name: one.largest_force for name, one in contacts.items()},
            largest_force_time={name: one.largest_force_time for name, one in contacts.items()},
            impulses=tuple(solving.impulses),
            counts=counts,
            oil_events=scene.legs.events,
            statistics=recorder.finished(),
        )
    finally:
        scene.release()
