"""The scenes of the study: those of the benchmark, or the user's machine with clearance in a pin."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from studies.benchmarking import estimates
from studies.benchmarking.estimates import TIGHTER, Truth
from studies.benchmarking.references import GOALS, Sample, errors, of_result, own_errors, references
from studies.benchmarking.scenes import CLEARANCE_MM, SCENES, BenchmarkScene
from studies.common.paper_machine import BORE_RADIUS
from studies.common.subject import Subject
from support_exudyn import Scenario, SolverSettings, simulate
from support_exudyn.formulations.registry import CHEAPEST_FIRST
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED
from support_exudyn.simulation.automatic_settings import settings_for

TIGHT = (1e-11, 1e-10)  # tolerances of the reference, and of the run that tells its error
GOAL = 1e-3  # for which the formulation on Exudyn would choose the step that others are multiples of
SHARES = (0.125, 0.25)  # of that step, where no formulation chooses its steps itself
TIGHT_IMPACT_STEPS = 2048


def scenes(subject: Subject) -> Mapping[str, BenchmarkScene]:
    """All scenes by name: five of the benchmark; of the user's machine one without friction and one with it."""
    if subject.is_paper:
        return SCENES
    size = CLEARANCE_MM * subject.bore_radius / BORE_RADIUS
    if subject.given is not None:
        size = 1e3 * subject.given.contact.bearing.clearance
    rubbing = {"no friction": 0.0, f"friction {subject.friction:g}": subject.friction}
    return {
        name: _own(f"{subject.name}: {size:.3g} mm, {name}", subject, subject.with_clearance(size, friction))
        for name, friction in rubbing.items()
    }


def _own(label: str, subject: Subject, scenario: Scenario) -> BenchmarkScene:
    watched, plain = subject.watched, replace(scenario, accuracy=None)
    longest = settings_for(replace(plain, formulation="exudyn"), GOAL).step
    step = plain.recorded_every / math.ceil(plain.recorded_every / longest)
    return BenchmarkScene(label, plain, watched.pin, watched.start, step)


def tight_runs(scene: BenchmarkScene) -> tuple[Scenario, Scenario]:
    """A scene of the user's as the reference has it, and as its own error is found."""
    for one in CHEAPEST_FIRST:
        if one.name in ERROR_CONTROLLED and one.covers(scene.scenario):
            solvers = [SolverSettings(tolerance=tolerance) for tolerance in TIGHT]
            first, second = (replace(scene.scenario, formulation=one.name, solver=solver) for solver in solvers)
            return first, second
    solver = SolverSettings(impact_steps=TIGHT_IMPACT_STEPS)
    fine, coarse = (
        replace(scene.scenario, formulation="exudyn", step=share * scene.step, solver=solver)
        for share in SHARES
    )
    return fine, coarse


@dataclass(frozen=True)
class Known:
    """What runs of a scene are compared with.

    sample: what ways are compared with. own_errors: of it, by the names of `GOALS`. truth: the usual numbers,
    which runs to an accuracy are compared with.
    """

    sample: Sample
    own_errors: Mapping[str, float]
    truth: Truth

    def errors(self, found: Sample) -> dict[str, float]:
        """Errors of a sample by the names of `GOALS`, as far as the reference is close enough for the goal."""
        off = errors(found, self.sample)
        return {name: one for name, one in off.items() if name not in self.vague}

    @property
    def vague(self) -> list[str]:
        """The goals that cannot be judged: the reference is not `TIGHTER` times closer than they ask for."""
        return [name for name, error in self.own_errors.items() if TIGHTER * error > GOALS[name]]


def known(name: str, scene: BenchmarkScene) -> Known:
    """What a scene is compared with: of the benchmark what is stored, else two tight runs made here."""
    if SCENES.get(name) == scene:
        return Known(references()[name], own_errors()[name], estimates.tight(scene))
    first, second = map(simulate, tight_runs(scene))
    sample = of_result(scene, first)
    own = errors(of_result(scene, second), sample)
    return Known(sample, own, Truth.of(scene.after, first, second))
