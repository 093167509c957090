"""Whether the errors that runs tell of their numbers cover those that they have, number by number.

A number is judged by a reference whose own error is at most a tenth of the error claimed, or of the distance
between both: one of another formulation where that is sharp enough, else one of the same at much finer
settings. If no reference is sharp enough, the number is left out, and counted. References have many records,
for what a run prints is of the time, however few records it has.

Two runs of a reference can agree by chance. So there are three, and the last distance is not believed below
what the order of the method makes of the one before. Where it is far below, above the one before, or the other
way, the number does not converge, and counts against a run only where the distances themselves are small.
"""

import hashlib
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from studies.benchmarking.estimates import tight_numbers
from studies.benchmarking.fresh_scenes import Fresh
from studies.extremes.runs import HangError, patience
from support_exudyn import Failure, Result, Scenario, SimulationError, simulate
from support_exudyn.formulations.registry import FormulationName, formulation
from support_exudyn.scenario.scenario_data import ACCURACIES, Accuracy
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED, MOST_IMPACT_STEPS
from support_exudyn.simulation.automatic_settings import settings_for

# tolerances of a reference, and of its own error
TIGHT: Mapping[FormulationName, tuple[float, float, float]] = {
    "compiled": (1e-12, 1e-10, 1e-8),
}
FINER = (3.0, 1.5, 1.0)  # times shorter steps than those of a run; the last is that run
WITNESS = (8.0, 4.0, 2.0)  # the same against the first run of "standard", where another formulation judges
ORDER = 2  # of the method whose steps are made shorter
CHANCE = 0.25  # of what the order makes of the distance before, below which two runs agree by chance
PATIENCE = 300.0  # [s] that a scene's runs may take, and as much its references
SHARP = 0.1  # of the error claimed, or of the distance, that a reference's own error may be
RECORDS = 2000  # of a reference
OF_DISTANCE = 0.5  # of the distance of a less fine run that a reference's own error is taken to be
ROUNDING = 1e-12  # of a number, that references are not believed beyond
NEWTON = 5e-8  # the same of what follows from Newton's method, whose tolerance is 1e-8; not of places


def _family(name: str) -> str:
    """What a number is of: numbers that go wrong alike."""
    if "force" in name:
        return "force"
    kind, field = name.split(".")[-2:]
    return field if kind.startswith("onset") else kind


class Reference(NamedTuple):
    """Numbers of a scene by one formulation, at very fine settings and at two that are less and less fine.

    falls: what the order makes of the distance of the coarser two, for that of the finer two.
    """

    formulation: str
    numbers: Mapping[str, float]
    coarser: Mapping[str, float]
    coarsest: Mapping[str, float]
    falls: float

    def error(self, name: str) -> float:
        """The error of a number: half of how far the less fine run is away; a third of that for second order.

        Two runs can agree in a number by chance: it is at least as far as the middle one of its family, such as
        all forces, as a share of each, and as the distance before makes it; that itself, if it is far below.
        """
        family = [one for one in self.numbers if _family(one) == _family(name) and self.numbers[one]]
        shares = [self._away(one) / abs(self.numbers[one]) for one in family]
        usual = float(np.median(shares)) if shares else 0.0
        last, before = self._away(name), self._away_before(name)
        far = max(last, before if self._by_chance(name) else self.falls * before)
        return max(OF_DISTANCE * far, OF_DISTANCE * usual * abs(self.numbers[name]) + self._floor(name))

    def converges(self, name: str) -> bool:
        """Whether the distances of a number fall as they should, or are nothing but rounding."""
        last = self._away(name)
        if last <= self._floor(name):
            return True
        fine, coarse, coarsest = (found[name] for found in (self.numbers, self.coarser, self.coarsest))
        one_way = self.formulation in ERROR_CONTROLLED or (fine - coarse) * (coarse - coarsest) > 0.0
        return one_way and last <= self._away_before(name) and not self._by_chance(name)

    def _by_chance(self, name: str) -> bool:
        """Whether the finer two agree far better than the coarser two let expect, which steps tell alone."""
        if self.formulation in ERROR_CONTROLLED:
            return False  # by tolerances errors fall irregularly
        return self._away(name) + self._floor(name) < CHANCE * self.falls * self._away_before(name)

    def _floor(self, name: str) -> float:
        """What no step makes smaller: of the largest value that it is computed from."""
        iterates = self.formulation == "exudyn" and not name.endswith((".x.mean", ".y.mean"))
        series = name.rpartition(".")[0] + "."
        values = [abs(self.numbers[one]) for one in self.numbers if "force" in name and one.startswith(series)]
        return (NEWTON if iterates else ROUNDING) * max([abs(self.numbers[name]), *values])

    def _away(self, name: str) -> float:
        return abs(self.numbers[name] - self.coarser.get(name, math.nan))

    def _away_before(self, name: str) -> float:
        return abs(self.coarser.get(name, math.nan) - self.coarsest.get(name, math.nan))


@dataclass(frozen=True)
class Judged:
    """A number of a run: its value, the error claimed, how far the reference is away, and its own error.

    by: formulation of the reference; empty if none is sharp enough. ratio: true error over the claimed one.
    """

    name: str
    value: float
    claimed: float
    away: float
    own: float
    by: str

    @property
    def apart(self) -> bool:
        """Whether no reference can tell."""
        return not self.by

    @property
    def ratio(self) -> float:
        """True error over the claimed one, 0 if there is none."""
        if self.away == 0.0:
            return 0.0
        return self.away / self.claimed if self.claimed > 0.0 else math.inf


@dataclass(frozen=True)
class CoveredRun:
    """A run of a scene to an accuracy. refused: why, else empty. met: whether it says that it was reached."""

    kind: str
    number: int
    accuracy: str
    formulation: str = ""
    refused: str = ""
    met: bool = False
    judged: tuple[Judged, ...] = ()


@cache
def digest() -> str:
    """Return a digest of this file, so that scenes that were judged otherwise are judged again."""
    return hashlib.sha256(Path(__file__).read_bytes()).hexdigest()


def rows(scene: Fresh) -> Iterator[CoveredRun]:
    """A scene run to all of its accuracies, and judged.

    Runs that take too long are refused. References that do are none: a run that a user waits for in vain is one
    thing, a far finer one that would judge it another.
    """
    runs: dict[Accuracy, Result | Failure] = {}
    try:
        with patience(PATIENCE):
            for accuracy in accuracies(scene):
                runs[accuracy] = simulate(at(scene, accuracy), throw=False)
    except HangError as error:
        late = Failure(str(error), "", 0.0)
        runs |= {accuracy: late for accuracy in accuracies(scene) if accuracy not in runs}
    good = [run for run in runs.values() if isinstance(run, Result)]
    known: list[Reference] = []
    with suppress(HangError), patience(PATIENCE):
        for reference in references(scene, good) if good else ():
            known.append(reference)  # noqa: PERF402  # as far as it comes
    for accuracy, run in runs.items():
        row = CoveredRun(scene.kind, scene.number, str(accuracy))
        if isinstance(run, Failure):
            yield replace(row, refused=run.reason)
            continue
        yield replace(row, formulation=run.scenario.formulation, met=run.met, judged=tuple(judged(run, known)))


def at(scene: Fresh, accuracy: Accuracy) -> Scenario:
    """Return the scene that asks for an accuracy."""
    return replace(scene.scenario, accuracy=accuracy)


def accuracies(scene: Fresh) -> tuple[Accuracy, ...]:
    """The accuracies of a scene: "reference" only where steps are chosen; nothing finer could judge it else."""
    chosen = settings_for(scene.scenario, ACCURACIES["standard"])
    steps_are_chosen = chosen.formulation in ERROR_CONTROLLED
    return tuple(a for a in scene.accuracies if a != "reference" or steps_are_chosen)


def references(scene: Fresh, runs: Sequence[Result]) -> Iterator[Reference]:
    """Run a scene by formulations with error control, and by the engine's as another; yield each that ended."""
    period = scene.scenario.duration / RECORDS
    plain = replace(scene.scenario, accuracy=None, record_period=period)
    sharp = False
    for name, tolerances in TIGHT.items():
        if not formulation(name).covers(plain):
            continue
        solvers = [replace(plain.solver, tolerance=tolerance) for tolerance in tolerances]
        known = _numbers([replace(plain, formulation=name, solver=solver) for solver in solvers])
        if known:
            sharp = True
            yield Reference(name, known[0], known[1], known[2], _falls(tolerances))
    if sharp and all(run.scenario.formulation == "exudyn" for run in runs):
        return
    if sharp:
        witness = settings_for(replace(plain, formulation="exudyn"), ACCURACIES["standard"])
        factors, known = WITNESS, _numbers([witness.refined(factor) for factor in WITNESS])
    elif (finest := _finest(runs)) is not None:
        finest = replace(finest, record_period=period)
        factors, known = FINER, _numbers([finest.refined(factor) for factor in FINER])
    else:
        return
    if known:
        yield Reference("exudyn", known[0], known[1], known[2], _falls([factor**-ORDER for factor in factors]))


def _finest(runs: Sequence[Result]) -> Scenario | None:
    """Return the scenario of the finest run whose steps can be made shorter still; None if there is none."""
    for run in reversed(runs):
        if FINER[0] * run.scenario.solver.impact_steps <= MOST_IMPACT_STEPS:
            return run.scenario
    return None


def _falls(errors: Sequence[float]) -> float:
    """Return the distance of the finer two of three runs with these errors over that of the coarser two."""
    fine, coarse, coarsest = errors
    return (coarse - fine) / (coarsest - coarse)


def _numbers(scenarios: Sequence[Scenario]) -> list[Mapping[str, float]]:
    """Run one scenario after another and return the numbers of each; none at all if one of them fails."""
    try:
        return [tight_numbers(0.0, simulate(scenario)) for scenario in scenarios]
    except SimulationError:
        return []


def judged(run: Result, known: Sequence[Reference]) -> Iterator[Judged]:
    """Judge all numbers of a run by the references; the time of an extreme by the one that judges its value.

    A reference that does not know the value that well may have another one of two peaks as the largest.
    """
    numbers = run.numbers()
    for name, number in numbers.items():
        fit = known
        if (extreme := name.removesuffix("_time")) in numbers and extreme != name:
            of = numbers[extreme]
            by = judge(extreme, of.value, of.error, run.scenario.formulation, known).by
            fit = [one for one in known if one.formulation == by]
        yield judge(name, number.value, number.error, run.scenario.formulation, fit)


def judge(name: str, value: float, claimed: float, formulation: str, known: Sequence[Reference]) -> Judged:
    """Judge a number by references, those of another formulation first; see the top of this file."""
    found = sorted(
        (
            (Judged(name, value, claimed, _distance(value, one, name), one.error(name), one.formulation), one)
            for one in known
            if name in one.numbers
        ),
        key=lambda pair: pair[0].by == formulation,
    )
    for one, reference in found:
        if one.own <= SHARP * claimed or (one.own <= SHARP * one.away and reference.converges(name)):
            return one
    return replace(found[0][0], by="") if found else Judged(name, value, claimed, math.nan, math.nan, "")


def _distance(value: float, reference: Reference, name: str) -> float:
    return abs(value - reference.numbers[name])
