"""Ways to compute a scene, ours and those of others, and what they cost."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

from studies.benchmarking.peers.bare_scene import bare_scene
from studies.benchmarking.peers.built_in import run_built_in
from studies.benchmarking.peers.peer_run import PeerRun, contact_numbers
from studies.benchmarking.peers.stock import run_stock
from studies.benchmarking.references import ONSETS, Sample, of_result, sample, times_the_goal
from studies.benchmarking.scenes import BenchmarkScene
from support_exudyn import Held, Scenario, SolverSettings, simulate
from support_exudyn.formulations.registry import CHEAPEST_FIRST, FormulationName
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED
from user_forces import Ambrosio, Frictionless, InputError

LADDER, SHORT_LADDER = (2.0, 0.5), (1.0, 0.25)  # times the scene's default step, in long and in short scenes
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
IMPACT_STEPS = 512  # at the default step
FIXED_STEPS = (2.0, 0.4, 0.1)  # times the default, of runs in which nothing is located
RESULT_CHECKS = False  # how wrong a way can be is what is looked at
KNOBS: tuple[tuple[str, str, Mapping[str, object]], ...] = (  # turned at the default step
    *(("spectral radius", f"spectral radius {x:g}", {"spectral_radius": x}) for x in (0.0, 0.3, 0.7, 0.9)),
    *(("Newton's method", f"Newton tolerance {x:.0e}", {"newton_tolerance": x}) for x in (1e-5, 1e-6, 1e-10)),
    ("Newton's method", "full Newton", {"newton": "full"}),
)
STOCK, BUILT_IN = "stock recipe", "built-in contact"


@dataclass(frozen=True)
class Done:
    """What a way gave: what is looked at of it, accepted steps, and contact forces evaluated in Python."""

    sample: Sample
    steps: int
    calls: int


@dataclass(frozen=True)
class Way:
    """A way to compute a scene.

    family: of like ways, one line in a diagram. label: what is set. run: does it and looks at what came out.
    bare: does it only, to be timed.
    """

    family: str
    label: str
    run: Callable[[], Done]
    bare: Callable[[], object]


def ways(scene: BenchmarkScene) -> list[Way]:
    """All ways to compute a scene; every knob is turned on a drop only, which takes least."""
    found = [*_error_controlled(scene)]
    steps = SHORT_LADDER if scene.is_short else LADDER
    growing = {"growth": 8.0, "backend": "symbolic"}
    found += _steps(scene, "exudyn, symbolic", "step", steps, backend="symbolic")
    found += _steps(scene, "exudyn, python", "step", steps[:1], backend="python")
    found += _steps(scene, "exudyn, growing steps", "growth 8, step", steps[:1], **growing)
    if _peers_cover(scene):
        found += _peers(scene, FIXED_STEPS)
    if scene.scenario.drive == Held():
        found += [redundant(scene, family, label, 1.0, **settings) for family, label, settings in KNOBS]
        found += _steps(scene, "nothing located", "fixed step", FIXED_STEPS, locate=False)
        index_2 = {"constraint_index": 2, "integrator": "trapezoidal"}
        found += _steps(scene, "trapezoidal, index 2", "trapezoidal, step", steps, **index_2)
    return found


def _peers_cover(scene: BenchmarkScene) -> bool:
    """Whether what others write can compute a scene."""
    try:
        pin = scene.scenario.clearance_pins[scene.pin].contact
        contact_numbers(pin)
        link = bare_scene(scene.scenario).link
    except InputError:
        return False
    known = isinstance(pin.friction, (Ambrosio, Frictionless))
    return known and link == scene.body and scene.scenario.dimensions == 2


def _error_controlled(scene: BenchmarkScene) -> Iterator[Way]:
    """The cheapest formulation that chooses its steps by a tolerance, if one covers the scene."""
    names = [one.name for one in CHEAPEST_FIRST if one.name in ERROR_CONTROLLED and one.covers(scene.scenario)]
    for name in names[:1]:
        yield from (with_tolerance(scene, name, tolerance) for tolerance in TOLERANCES)


def _steps(
    scene: BenchmarkScene, family: str, label: str, shares: Sequence[float], **settings: object
) -> Iterator[Way]:
    """The Exudyn formulation by several lengths of its steps."""
    for share in shares:
        yield redundant(scene, family, f"{label} x {share:g}", share, **settings)


def redundant(scene: BenchmarkScene, family: str, label: str, share: float, **settings: object) -> Way:
    """The Exudyn formulation at so many times the default step."""
    chosen = {"impact_steps": round(IMPACT_STEPS / share), "result_checks": RESULT_CHECKS, **settings}
    solver = SolverSettings(**chosen)  # type: ignore[arg-type]
    step = min(scene.step * share, scene.scenario.recorded_every)
    scenario = replace(scene.scenario, formulation="exudyn", step=step, solver=solver)
    label = label or f"step {step:g} s, {solver.impact_steps} an impact, growth {solver.growth:g}"
    return _way(family, label, scene, scenario)


def with_tolerance(scene: BenchmarkScene, formulation: FormulationName, tolerance: float) -> Way:
    """A formulation with error control."""
    solver = SolverSettings(tolerance=tolerance, result_checks=RESULT_CHECKS)
    scenario = replace(scene.scenario, formulation=formulation, solver=solver)
    return _way(formulation, f"tolerance {tolerance:.0e}", scene, scenario)


def _peers(scene: BenchmarkScene, shares: Sequence[float]) -> Iterator[Way]:
    """The stock recipe, and the engine's own contact in its place."""
    for share in shares:
        step = scene.step * share
        yield peer(STOCK, f"fixed step x {share:g}", scene, run_stock, step)
        if isinstance(scene.scenario.clearance_pins[scene.pin].contact.friction, Frictionless):
            yield peer(BUILT_IN, f"fixed step x {share:g}", scene, run_built_in, step)


def peer(
    family: str, label: str, scene: BenchmarkScene, run: Callable[[Scenario, float], PeerRun], step: float
) -> Way:
    """A competitor at a step [s]."""

    def done() -> Done:
        found = run(scene.scenario, step)
        speeds = [impact.speed for impact in found.onsets[:ONSETS]]
        path = found.x, found.y
        taken = sample(
            scene, found.time, found.force, found.angular_acceleration, path, speeds, found.largest_force
        )
        return Done(taken, found.steps, found.user_function_calls)

    return Way(family, label, done, partial(run, scene.scenario, step))


def _way(family: str, label: str, scene: BenchmarkScene, scenario: Scenario) -> Way:
    """A run of ours."""

    def done() -> Done:
        result = simulate(scenario)
        return Done(of_result(scene, result), result.counts.steps, result.counts.user_function_calls)

    return Way(family, label, done, partial(simulate, scenario))


# --- cost and errors ---


@dataclass(frozen=True)
class WayRun:
    """A run.

    scene, family, label: what was run and how. seconds: wall time, the least if it was timed more than once.
    steps: accepted. calls: of contact forces in Python. errors: by the names of `references.GOALS`; none if it
    failed, and failure says why. scatter: by how much its times differ [s]; nan if it was timed once.
    """

    scene: str
    family: str
    label: str
    seconds: float
    steps: int
    calls: int
    errors: dict[str, float] = field(default_factory=dict)
    failure: str = ""
    scatter: float = math.nan

    @property
    def overall(self) -> float:
        """The worst error in units of the goal."""
        return times_the_goal(self.errors) if self.errors else float("inf")


def front(rows: Sequence[WayRun]) -> list[WayRun]:
    """The rows than which no other is both faster and more accurate, the fastest first."""
    best, least = [], float("inf")
    for row in sorted(rows, key=lambda row: (row.seconds, row.overall)):
        if row.overall < least:
            best.append(row)
            least = row.overall
    return best


def cheapest(rows: Sequence[WayRun], most: float = 1.0) -> WayRun | None:
    """The fastest row whose errors are within the goal, or so many times it; None if there is none."""
    good = [row for row in rows if row.overall <= most]
    return min(good, key=lambda row: row.seconds) if good else None
