"""Whether the errors that runs to an accuracy estimate are those that they have."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from studies.benchmarking.references import tight_runs
from studies.benchmarking.scenes import BenchmarkScene
from support_exudyn import Estimate, Held, Result, Scenario, simulate
from support_exudyn.scenario.scenario_data import Accuracy
from support_exudyn.simulation.reported_numbers import measures

PRESETS: tuple[Accuracy, ...] = ("draft", "standard", "reference")
NUMBERS: tuple[Accuracy, ...] = (1e-4,)  # that are asked for besides
TIGHTER = 10.0  # times: by so much a tight run must be closer than the error that it judges


@dataclass(frozen=True)
class Truth:
    """The numbers of a tight run, and their own errors: the distances from a run that is ten times looser."""

    numbers: Mapping[str, float]
    own_errors: Mapping[str, float]

    @classmethod
    def of(cls, after: float, tight: Result, looser: Result) -> Truth:
        """The usual numbers from a time on [s], as far as both runs have them."""
        here, there = (tight_numbers(after, run) for run in (tight, looser))
        own = {name: abs(here[name] - there[name]) for name in here if name in there}
        return cls({name: here[name] for name in own}, own)


@dataclass(frozen=True)
class Check:
    """A run to an accuracy against the tight run of its scene.

    asked: the accuracy. formulation: that ran. seconds: processor time of all runs that it took. met: whether
    the program says that it is as accurate as asked. true, estimated: errors of the numbers that can be
    judged. left_out: how many cannot, for the tight run is not `TIGHTER` times closer. off: the worst
    relative true error of mean, spread and largest value of the pin forces.
    """

    scene: str
    asked: str
    formulation: str
    seconds: float
    met: bool
    true: np.ndarray
    estimated: np.ndarray
    off: float
    left_out: int = 0

    @property
    def is_judged(self) -> bool:
        """Whether the tight run is close enough for most of the numbers."""
        return self.true.size > self.left_out

    @property
    def covered(self) -> float:
        """Share of the numbers whose error is not larger than estimated."""
        return float(np.mean(self.true <= self.estimated))


def overstatement(checks: Sequence[Check]) -> Estimate:
    """Median of estimated over true errors, of numbers that have an error; its error is that of the sample."""
    true, estimated = (
        np.concatenate([getattr(check, name) for check in checks]) for name in ("true", "estimated")
    )
    some = true > 0.0
    ratios = estimated[some] / true[some]
    # of the middle of n values the rank is uncertain by sqrt(n) / 2
    around = 0.5 / math.sqrt(ratios.size)
    low, median, high = np.quantile(ratios, [max(0.0, 0.5 - around), 0.5, min(1.0, 0.5 + around)])
    return Estimate(float(median), 0.5 * float(high - low), "1")


def coverage(checks: Sequence[Check]) -> Estimate:
    """Share of all numbers whose error is not larger than estimated; its error is that of the sample."""
    covered = np.concatenate([check.true <= check.estimated for check in checks])
    share = float(covered.mean())
    return Estimate(share, math.sqrt(share * (1.0 - share) / covered.size), "1")


def asked_for(scene: BenchmarkScene) -> Iterator[Scenario]:
    """A scene's scenarios with an accuracy."""
    for accuracy in PRESETS + NUMBERS:
        yield replace(scene.scenario, accuracy=accuracy)
    if scene.is_short and scene.scenario.drive != Held():  # a drop bounces for half a minute of processor time
        for accuracy in PRESETS[:2]:
            yield replace(scene.scenario, accuracy=accuracy, formulation="exudyn")


def check(name: str, scene: BenchmarkScene, scenario: Scenario, known: Truth) -> Check:
    """Run a scene to an accuracy and compare its numbers with those of a tight run.

    A number is judged if the tight run's own error is `TIGHTER` times less than its estimated error, or than
    its distance from the tight run, which then is its true error.
    """
    began = time.process_time()
    result = simulate(scenario)
    seconds = time.process_time() - began
    found = result.numbers(scene.after)
    off = {name: abs(found[name].value - known.numbers[name]) for name in found if name in known.numbers}
    names = [name for name in off if TIGHTER * known.own_errors[name] <= max(found[name].error, off[name])]
    wrong = [
        off[name] / abs(known.numbers[name])
        for name in names
        if name.endswith(("force.mean", "force.std", "force.largest")) and known.numbers[name]
    ]
    return Check(
        name,
        str(scenario.accuracy),
        result.scenario.formulation,
        seconds,
        result.met,
        np.array([off[name] for name in names]),
        np.array([found[name].error for name in names]),
        max(wrong, default=0.0),
        len(off) - len(names),
    )


def tight(scene: BenchmarkScene) -> Truth:
    """The numbers of a scene by runs that are far closer than any accuracy that is asked for here."""
    return Truth.of(scene.after, *map(simulate, tight_runs(scene)))


def tight_numbers(after: float, run: Result) -> Mapping[str, float]:
    """The usual numbers, from a time on [s], of a run that has no estimate."""
    found = measures(run, after, float("inf"))
    return {name: kind.measure(run) for name, kind in found.items()}
