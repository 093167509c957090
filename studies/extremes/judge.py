"""Whether a run ended well: good, or refused with a reason; anything else is a silent failure.

A run is good if it has finished and what can be asked of it is so:

- all of its numbers are finite, energy adds up, no journal is deeper in its bore than a stated share of the
  radius (`simulation.result_checks` checks that in every run; here it is checked once more);
- no oil of a hydraulic leg is lost or made;
- no free impact gives back more than the law does;
- a run of half its steps agrees with it within the error that it reports;
- so does, where there is one, an independent formulation of the same scene.
"""

import math
import signal
import traceback
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from studies.common.runs import bar
from studies.extremes import long_runs
from studies.extremes.long_runs import LongRun
from studies.extremes.scenes import Case
from support_exudyn import (
    HydraulicCylinder,
    OilColumn,
    Result,
    Scenario,
    SimulationError,
    SolverSettings,
    simulate,
)
from support_exudyn.formulations.registry import formulation
from support_exudyn.scenario.scenario_data import LARGEST_STEP
from support_exudyn.scenario.timescales import timescales
from support_exudyn.scene.limits import DEEPEST
from support_exudyn.simulation.automatic_settings import settings_for
from support_exudyn.simulation.contact_ringing import ringing_step
from support_exudyn.simulation.estimate import disagreement, rounding_share
from support_exudyn.simulation.result_checks import OPEN, energy_open
from support_exudyn.sweeps.workers import Workers, report, worker_pool
from user_forces import Frictionless, InputError
from user_forces.normal.hysteresis import Hysteresis, delivered_restitution

GOOD, REFUSED, SILENT = "good", "refused", "silent"
BEFORE = "before the run: "
# An impact is free if gravity changes the speed by less than this share of it while it lasts, and nothing rubs.
# Where there is no gravity and nothing is driven, every one is.
# Its restitution then is that of the law within some thousandths (1.3e-3 at most in 500 random scenes).
FREE, MORE = 0.02, 0.005
PULL = 9.81  # [m/s^2]
LEAK = 1e-10  # share of a leg's oil that may be open
ALONE = 1e-9  # [s] by which contacts of two pins are apart at least
TOLERANCE = 1e-8  # of an independent formulation
# steps of a run that only checks: one of the Exudyn formulation takes some 0.1 ms, of others a tenth of that
MOST_STEPS, MOST_OTHERS = 15_000, 100_000
TELLING = 0.05  # a run that is less certain does not check anything
CHECKING = 3.0  # times the estimated error of a run that only checks: an estimate covers 97 % of errors
# of a check by the Exudyn formulation: steps of an impact, fewest and most steps of the grid
IMPACT_STEPS, FEWEST, LONGEST = 64, 200, 2_500
FOLLOWED = 2.0  # times of a vibration of a loaded contact (one over its angular frequency) that a step may be
# spectral radii of a check: the larger, the less its steps damp, and the more rounding stays. The first that
# keeps what rings with no more steps than that
RADII = (0.5, 0.9)


@dataclass(frozen=True)
class Judgement:
    """How a case ended.

    outcome: good, refused or silent. reason: why not good. error: reported, relative, of the worst number.
    half: distance of the run with half the steps in the same measure. other: distance of the independent
    formulation, nan if there is none. energy: open share of what was turned over. depth: largest share of the
    bore's radius. oil: open share of a leg's oil, nan if none is counted. restitution: the largest of free
    impacts over that of the law, nan if there is none. met: whether an accuracy that was asked for was reached.
    solver: the formulation of the run. values: step [s] if it is chosen, clearance [m], mass ratio of the
    heaviest to the lightest body, as the maps name them.
    """

    outcome: str
    reason: str = ""
    error: float = math.nan
    half: float = math.nan
    other: float = math.nan
    energy: float = math.nan
    depth: float = math.nan
    oil: float = math.nan
    restitution: float = math.nan
    met: bool = False
    solver: str = ""
    values: Mapping[str, float] = field(default_factory=dict)


Run = Callable[[Scenario], Result]


def judge(make: Callable[[], Scenario], run: Run | None = None) -> Judgement:
    """Make a scene, run it and judge the result; warnings are errors. run: None: with an error, as users do."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return _judged(make, run or (lambda scenario: simulate(scenario, errors=True)))
    except Exception as error:  # whatever it is: nobody has explained it
        where = traceback.extract_tb(error.__traceback__)[-1]
        place = f"{where.filename.rpartition('/')[2]}:{where.lineno}"
        return Judgement(SILENT, f"{type(error).__name__}: {error} ({place})"[:400])


def _judged(make: Callable[[], Scenario], run: Run) -> Judgement:
    """A failure has to say why, when, and what to change; a result is checked."""
    try:
        scenario = make()
        result = run(scenario)
    except InputError as error:
        return Judgement(REFUSED, f"{BEFORE}{error}"[:400])
    except SimulationError as error:
        failure = error.failure
        if failure.reason and failure.advice and math.isfinite(failure.time):
            reason = f"at {failure.time:.6g} s: {failure.reason}"[:400]
            return Judgement(REFUSED, reason, **_circumstances(scenario))
        return Judgement(SILENT, f"refused without cause, time or advice: {failure}")
    open_by, allowed = energy_open(result.scenario, result.channels)
    depths = [
        float(result[f"pin.{name}.depth"].max()) / pin.contact.bearing.bore_radius
        for name, pin in result.scenario.clearance_pins.items()
        if f"pin.{name}.depth" in result.channels
    ]
    return _compared(
        result,
        Judgement(
            GOOD,
            error=result.worst_error,
            energy=OPEN * float(open_by.max()) / allowed if allowed > 0.0 else 0.0,
            depth=max(depths, default=0.0),
            oil=oil_open(result),
            restitution=largest_restitution(result),
            met=result.met,
            **_circumstances(result.scenario),
        ),
    )


def _circumstances(scenario: Scenario) -> dict[str, Any]:
    """The solver of a run and the values of a scene that maps show, as fields of its judgement."""
    masses = [body.mass for body in scenario.linkage.bodies.values()]
    values = {"mass_ratio": max(masses) / min(masses)}
    chosen = scenario.formulation
    if scenario.goal is None:
        values["step_s"] = scenario.step
    else:
        chosen = settings_for(scenario, scenario.goal).formulation
    for pin in scenario.clearance_pins.values():
        values["clearance_m"] = pin.contact.bearing.clearance
    return {"solver": "compiled" if chosen == "compiled" else "exudyn", "values": values}


def _compared(result: Result, verdict: Judgement) -> Judgement:
    """The verdict after every check of the run by itself, against half its steps and another formulation."""
    finite = all(np.isfinite(channel.values).all() for channel in result.channels.values())
    restitution = f"a free impact gives back {verdict.restitution:.4g} times what its law does"
    checks = [
        (finite, "a number is not finite"),
        (verdict.energy <= OPEN, f"energy is open by {verdict.energy:.2g} of what was turned over"),
        (not verdict.depth > DEEPEST, f"depth is {verdict.depth:.2g} of the bore's radius"),
        (not verdict.oil > LEAK, f"{verdict.oil:.2g} of a leg's oil is lost or made"),
        (not verdict.restitution > 1.0 + MORE, restitution),
    ]
    if (pair := _halved(result)) is not None:
        whole, half = pair
        verdict = replace(verdict, half=disagreement(whole, half))
        reported = whole.worst_error + rounding_share(half)
        text = f"half the steps are {verdict.half:.2g} away, reported error {reported:.2g}"
        checks.append((verdict.half <= reported, text))
    if (other := independent(result.scenario)) is not None:
        verdict = replace(verdict, other=disagreement(result, other))
        text = (
            f"formulation {other.scenario.formulation} is {verdict.other:.2g} away, reported errors "
            f"{verdict.error:.2g} and {other.worst_error:.2g}"
        )
        checks.append((verdict.other <= verdict.error + CHECKING * other.worst_error, text))
    faults = [text for passed, text in checks if not passed]
    return replace(verdict, outcome=SILENT, reason="; ".join(faults)) if faults else verdict


def largest_restitution(result: Result) -> float:
    """The largest restitution of a free impact over that of its law; nan if there was none.

    An impact is free if nothing rubs, no other contact or impulse falls into it, and little pulls the journal:
    gravity, and what drives do to it, which follows from the known flight of a running machine; of other
    drives it is a guess. A free impact slower than the rest velocity is damped less.
    """
    scenario, pins = result.scenario, result.scenario.clearance_pins
    moved = any(drive.span(scenario.duration) != (0.0, 0.0) for drive in scenario.drives_in_use)
    flight = timescales(scenario).flight
    flights = (2.0 * pin.contact.bearing.clearance / flight**2 for pin in pins.values())
    pull = max(math.hypot(*scenario.gravity), PULL if moved else 0.0, *flights)
    ratios = []
    for name, pin in pins.items():
        law = pin.contact.normal
        if not isinstance(law, Hysteresis) or not isinstance(pin.contact.friction, Frictionless):
            continue
        events = [(impulse.time, impulse.time) for impulse in result.impulses]
        for other in pins.keys() - {name}:
            events += [(impact.time, impact.separation_time) for impact in result.onsets.get(other, ())]
        for impact in result.onsets.get(name, ()):
            free = pull * (impact.separation_time - impact.time) < FREE * impact.speed
            alone = not any(
                begin - ALONE < impact.separation_time and impact.time < end + ALONE for begin, end in events
            )
            if free and alone:
                damping = law.damping_factor * min(1.0, impact.speed / law.rest_velocity)
                ratios.append(impact.separation_velocity / (delivered_restitution(damping) * impact.speed))
    return float(np.nanmax(ratios)) if ratios else math.nan


# --- other runs of a scene ---


def oil_open(result: Result) -> float:
    """By how much the oil of a leg does not add up at worst, as a share of it; nan where none is counted.

    The oil of a leg is that of the start, and that from inlets or its drive, less that through valves.
    """
    shares: list[float] = []
    for name, model in result.scenario.legs.items():
        if f"{name}.oil" not in result.channels:
            continue
        oil = result[f"{name}.oil"]
        if isinstance(model, HydraulicCylinder):
            inlet = result[f"{name}.let_in"]
        else:
            assert isinstance(model, OilColumn)  # the only other leg
            drive = result.scenario.drive_of(name)
            inlet = model.bore_area * np.array([drive.extension(t) for t in result.time.tolist()])
        valves = [f"{name}.{way}" for way in ("yielded", "relieved") if f"{name}.{way}" in result.channels]
        lost: Any = sum(result[way] - result[way][0] for way in valves)
        shares.append(float(np.abs(oil - oil[0] - (inlet - inlet[0]) + lost).max() / oil[0]))
    return max(shares, default=math.nan)


def _halved(result: Result) -> tuple[Result, Result] | None:
    """A run with its error, and that of half its steps; None if there are no finer settings.

    A run at chosen steps has been halved already. So has one to an accuracy: of one that is too long to be
    halved once more the coarser one counts.
    """
    most = MOST_OTHERS if result.scenario.chooses_steps else MOST_STEPS
    if result.coarser is not None and (result.goal is None or 2 * result.counts.steps > most):
        return result.coarser, result
    try:
        finer = result.scenario.refined()
        if finer == result.scenario:
            return None
        return result, simulate(replace(finer, solver=replace(finer.solver, most_steps=most)))
    # too many steps an impact, or the check fails: then the runs that gave the error have agreed
    except (InputError, SimulationError):
        return None


def independent(scenario: Scenario) -> Result | None:
    """The scene by a formulation that shares nothing but the laws; None if none covers it in few steps.

    A step of the Exudyn formulation that does not follow the vibration of the loaded contact damps it out, as
    would its halves: they agree on what is wrong.
    """
    if scenario.dimensions == 3:
        return None
    if scenario.chooses_steps:
        longest = min(
            scenario.recorded_every,
            scenario.duration / FEWEST,
            LARGEST_STEP,
            FOLLOWED * timescales(scenario).resting,
        )
        for radius in RADII:
            solver = SolverSettings(impact_steps=IMPACT_STEPS, most_steps=MOST_STEPS, spectral_radius=radius)
            other = replace(scenario, formulation="exudyn", solver=solver)
            other = replace(other, step=min(longest, ringing_step(other)))
            if other.duration / other.step <= LONGEST:
                break
        else:
            return None
    else:
        solver = SolverSettings(tolerance=TOLERANCE, most_steps=MOST_OTHERS)
        other = replace(scenario, formulation="compiled", solver=solver)
    if not formulation(other.formulation).covers(other):
        return None
    try:
        result = simulate(other, errors=True)
    except SimulationError:
        return None
    return result if result.worst_error < TELLING else None


# --- in workers ---

PATIENCE = 300.0  # [s]; a run that takes longer hangs


class HangError(BaseException):
    """A run has taken too long. No Exception: nothing that judges or mends failures is to take it for one."""


def judged(place: int, case: Case) -> Judgement:
    """Judge a case, in a worker; where the system knows no alarm it may take any time."""
    del place
    report(0.0)
    if not hasattr(signal, "setitimer"):
        return judge(case.scenario)
    rung: list[HangError] = []  # compiled code can turn the error into one of its own

    def too_long(number: int, frame: Any) -> None:
        del number, frame
        rung.append(HangError(f"no end after {PATIENCE:g} s"))
        raise rung[0]

    before = signal.signal(signal.SIGALRM, too_long)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE)
    try:
        verdict = judge(case.scenario)
    except HangError:
        pass
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    return Judgement(SILENT, f"hang: {rung[0]}") if rung else verdict


def lasted(place: int, name: str, duration: float) -> LongRun | str:
    """Make a long run, in a worker; return why there is none if it fails."""
    del place
    try:
        return long_runs.run(long_runs.scene(name, duration), report)
    except SimulationError as error:
        return str(error)


def judge_all(cases: Sequence[Case], workers: int | Workers) -> list[Judgement]:
    """Verdicts on cases, in their order, under a progress bar; workers: number of processes, or a pool."""
    jobs = [(case,) for case in cases]
    with worker_pool(workers) as pool, bar(f"{len(cases)} scenes") as show:
        return pool.run(jobs, judged, show, lambda error: Judgement(SILENT, f"crash: {error.reason}"))


def run_long(durations: Mapping[str, float], workers: int | Workers) -> dict[str, LongRun | str]:
    """Long runs by their names, under a progress bar; of a run that failed why.

    durations: of the runs [s]. workers: number of processes, or a pool.
    """
    with worker_pool(workers) as pool, bar(f"{len(durations)} long runs") as show:
        runs = pool.run([*durations.items()], lasted, show, lambda error: f"crash: {error.reason}")
    return dict(zip(durations, runs, strict=True))
