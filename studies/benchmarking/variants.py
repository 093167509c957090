"""Ways to compute a scene, ours and those of others, and what they cost."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from studies.benchmarking.peers.built_in import run_built_in
from studies.benchmarking.peers.peer_run import PeerRun
from studies.benchmarking.peers.plain_support import plain_support
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.references import ONSETS, Sample, of_result, sample, times_the_goal
from studies.benchmarking.scenes import BenchmarkScene
from studies.benchmarking.trade import ENGINE
from support_exudyn import Scenario, SolverSettings, simulate
from support_exudyn.formulations.registry import CHEAPEST_FIRST, FormulationName
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED
from user_forces import Frictionless, InputError

LADDER, SHORT_LADDER = (2.0, 0.5), (1.0, 0.25)  # times the scene's default step, in long and in short scenes
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
IMPACT_STEPS = 512  # at the default step
FIXED_STEPS = (0.6, 0.4, 0.1)  # times the default, of runs in which nothing is located
STOCK, BUILT_IN = "stock recipe", "built-in contact"


@dataclass(frozen=True)
class Way:
    """A way to compute a scene.

    family: of like ways, one line in a diagram. label: what is set. run: does it and returns what is compared
    and the number of steps. bare: does it only, to be timed.
    """

    family: str
    label: str
    run: Callable[[], tuple[Sample, int]]
    bare: Callable[[], object]


def ways(scene: BenchmarkScene) -> list[Way]:
    """All ways to compute a scene."""
    shares = SHORT_LADDER if scene.is_short else LADDER
    found = [*_error_controlled(scene)]
    found += [on_engine(scene, ENGINE, f"step x {share:g}", share) for share in shares]
    found.append(
        on_engine(scene, f"{ENGINE}, growing steps", f"growth 8, step x {shares[0]:g}", shares[0], growth=8.0)
    )
    try:
        friction = plain_support(scene.scenario).contact.friction
    except InputError:  # others do not cover the scene
        return found
    for share in FIXED_STEPS:
        found.append(peer(STOCK, f"fixed step x {share:g}", scene, run_stock, share * scene.step))
        if isinstance(friction, Frictionless):
            found.append(peer(BUILT_IN, f"fixed step x {share:g}", scene, run_built_in, share * scene.step))
    return found


def _error_controlled(scene: BenchmarkScene) -> Iterator[Way]:
    """The cheapest formulation that chooses its steps by a tolerance, if one covers the scene."""
    names = [one.name for one in CHEAPEST_FIRST if one.name in ERROR_CONTROLLED and one.covers(scene.scenario)]
    for name in names[:1]:
        yield from (with_tolerance(scene, name, tolerance) for tolerance in TOLERANCES)


def on_engine(scene: BenchmarkScene, family: str, label: str, share: float, growth: float = 1.0) -> Way:
    """The formulation on the engine at so many times the default step."""
    solver = SolverSettings(impact_steps=round(IMPACT_STEPS / share), growth=growth, result_checks=False)
    step = min(scene.step * share, scene.scenario.recorded_every)
    return _way(family, label, scene, replace(scene.scenario, formulation=ENGINE, step=step, solver=solver))


def with_tolerance(scene: BenchmarkScene, formulation: FormulationName, tolerance: float) -> Way:
    """A formulation with error control."""
    solver = SolverSettings(tolerance=tolerance, result_checks=False)
    scenario = replace(scene.scenario, formulation=formulation, solver=solver)
    return _way(formulation, f"tolerance {tolerance:.0e}", scene, scenario)


def peer(
    family: str, label: str, scene: BenchmarkScene, run: Callable[[Scenario, float], PeerRun], step: float
) -> Way:
    """A competitor at a step [s]."""

    def done() -> tuple[Sample, int]:
        found = run(scene.scenario, step)
        speeds = [impact.speed for impact in found.onsets[:ONSETS]]
        return sample(*found.statistics(scene.after), float(found.force.max()), speeds), found.steps

    return Way(family, label, done, partial(run, scene.scenario, step))


def _way(family: str, label: str, scene: BenchmarkScene, scenario: Scenario) -> Way:
    """A run of ours."""

    def done() -> tuple[Sample, int]:
        result = simulate(scenario)
        return of_result(scene, result), result.counts.steps

    return Way(family, label, done, partial(simulate, scenario))


# --- cost and errors ---


@dataclass(frozen=True)
class WayRun:
    """A run.

    scene, family, label: what was run and how. seconds: of the processor, the least if it was timed more than
    once. steps: accepted. errors: by the names of `references.GOALS`; none if it failed, and failure says
    why. scatter: by how much its times differ [s]; nan if it was timed once.
    """

    scene: str
    family: str
    label: str
    seconds: float
    steps: int
    errors: dict[str, float] = field(default_factory=dict)
    failure: str = ""
    scatter: float = math.nan

    @property
    def overall(self) -> float:
        """The worst error in units of the goal."""
        return times_the_goal(self.errors) if self.errors else math.inf


def front(rows: Sequence[WayRun]) -> list[WayRun]:
    """The rows than which no other is both faster and more accurate, the fastest first."""
    best, least = [], math.inf
    for row in sorted(rows, key=lambda row: (row.seconds, row.overall)):
        if row.overall < least:
            best.append(row)
            least = row.overall
    return best


def cheapest(rows: Sequence[WayRun], most: float = 1.0) -> WayRun | None:
    """The fastest row whose errors are within the goal, or so many times it; None if there is none."""
    good = [row for row in rows if row.overall <= most]
    return min(good, key=lambda row: row.seconds) if good else None
