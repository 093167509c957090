"""Runs of a case at steps that are halved again and again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from studies.study import Number, run_cases
from support_exudyn import Result, Scenario
from support_exudyn.workers import Workers


@dataclass(frozen=True)
class Ladder:
    """Results of one case, the coarsest first; each has half the steps' length of the one before."""

    results: tuple[Result, ...]

    @property
    def finest(self) -> Result:
        """The last of them."""
        return self.results[-1]

    def number(self, name: str, case: str, unit: str, measure: Callable[[Result], float]) -> Number:
        """A measured number: the finest run's value, and its distance from that of the run before."""
        value = measure(self.finest)
        return Number(name, case, value, unit, abs(value - measure(self.results[-2])))


def run_ladders(cases: Mapping[str, Scenario], halvings: int, workers: int | Workers) -> dict[str, Ladder]:
    """Run every case at its step, and at steps halved so often, in parallel, under a progress bar.

    Raises SimulationError if a run fails.
    """
    runs = {
        (name, halved): case.refined(2**halved)
        for halved in reversed(range(halvings + 1))  # the longest first
        for name, case in cases.items()
    }
    results = run_cases({f"{name}, step / {2**halved}": run for (name, halved), run in runs.items()}, workers)
    return {
        name: Ladder(tuple(results[f"{name}, step / {2**halved}"] for halved in range(halvings + 1)))
        for name in cases
    }
