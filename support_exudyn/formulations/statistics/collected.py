"""Statistics of the channels that a scenario asks for, from every step of its run.

Records are for curves; means, deviations and extremes do not depend on how many there are.
"""

import math
from collections.abc import Mapping
from functools import reduce
from operator import or_

import numpy as np
import numpy.typing as npt

from support_exudyn.formulations.statistics.ends import between_ends
from support_exudyn.formulations.statistics.magnitudes import divided
from support_exudyn.formulations.statistics.steps import NODES, OF_STEP, add_steps
from support_exudyn.mechanics.channels import DataNeeds
from support_exudyn.mechanics.observed_run import Trajectory
from support_exudyn.mechanics.time_statistics import COLUMNS, LAST, TimeStatistics
from support_exudyn.mechanics.trajectory import Series
from support_exudyn.scenario.recorded_channels import asked_definitions
from support_exudyn.scenario.scenario import Scenario
from support_exudyn.scenario.timescales import rounded

MOST_INTERVALS = 1000  # of a run, for which statistics are kept
INSIDE = 1e-6  # share of a step by which its ends are taken inside: what jumps there belongs to one side
TURN = 2.0 * math.pi


class StepStatistics:
    """Collects the statistics of intervals while a run goes on. edges: of the intervals (n + 1,) [s]."""

    def __init__(self, edges: Series) -> None:
        self.edges = edges
        self._known = np.zeros(edges.size - 1)  # how much of each interval has been seen [s]
        self._rows: dict[str, Series] = {}

    def add(self, time: Series, values: Mapping[str, Series]) -> None:
        """Add steps that follow those before.

        Arguments:
            time: of the nodes of each step (steps, 4) [s].
            values: of all channels there (4 steps,), always the same ones.
        """
        if not self._rows:
            self._all = np.full((len(values), self._known.size, len(COLUMNS)), np.nan)
            self._rows = dict(zip(values, self._all, strict=True))
        add_steps(np.ascontiguousarray(time), np.array([*values.values()]), self.edges, self._known, self._all)

    def last(self, name: str) -> float:
        """The last value of a channel that has been added; nan if none has been."""
        seen = np.flatnonzero(self._known)
        return float(self._rows[name][seen[-1], LAST]) if seen.size else math.nan

    def finished(self) -> TimeStatistics:
        """What has been collected."""
        return TimeStatistics(self.edges, self._rows)


class RunStatistics:
    """Collects the statistics of the channels that a scenario asks for. scenario: that is run."""

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self.wanted = {name: one for name, one in asked_definitions(scenario).items() if name != "time"}
        self.needs = reduce(or_, (one.needs for one in self.wanted.values()), DataNeeds.NOTHING)
        self._vectors = {name: one.vector for name, one in self.wanted.items() if one.vector is not None}
        self._steps = StepStatistics(intervals(scenario.duration))

    def add(self, time: Series, run: Trajectory) -> None:
        """Add steps that follow those before.

        Arguments:
            time: of the nodes of each step (steps, 4) [s].
            run: at the start, by which energies are told, and at all of these nodes.
        """
        vectors = {name: of(run)[1:] for name, of in self._vectors.items()}
        self._steps.add(*divided(time, self._values(run), vectors))

    def add_ends(self, time: Series, begins: npt.NDArray[np.bool_], run: Trajectory) -> None:
        """Add steps of which the ends are known, and follow those before.

        Arguments:
            time: of the ends (n,) [s]. begins: with which of them a piece begins, before which something jumps.
            run: at the start, by which energies are told, and at all of these times.
        """
        values, lasting = self._values(run), ~begins[1:]
        if lasting.any():
            nodes = {name: np.ravel(between_ends(time, begins, one)[lasting]) for name, one in values.items()}
            self._steps.add((time[:-1, None] + np.diff(time)[:, None] * NODES)[lasting], nodes)

    def _values(self, run: Trajectory) -> dict[str, Series]:
        """The channels at all times but the first (n,); angles go on from the last that has been added."""
        values = {}
        for name, definition in self.wanted.items():
            values[name] = definition.values(run)[1:]
            if definition.unit == "rad" and not math.isnan(before := self._steps.last(name)):
                values[name] = values[name] + TURN * round((before - float(values[name][0])) / TURN)
        return values

    def finished(self) -> TimeStatistics | None:
        """What has been collected; None if nothing is asked for."""
        return self._steps.finished() if self.wanted else None


def intervals(duration: float) -> Series:
    """Edges of the intervals of a run for which statistics are kept (n + 1,) [s]: round times, and its end."""
    period = rounded(0.0, duration / MOST_INTERVALS)
    count = math.ceil(duration / period * (1.0 - 1e-12))
    return np.append(np.arange(count) * period, duration)


def within_steps(time: Series) -> Series:
    """Times of nodes (steps, 4) [s] with both ends of each step taken inside."""
    found = time.copy()
    inside = INSIDE * (time[:, OF_STEP - 1] - time[:, 0])
    found[:, 0] += inside
    found[:, OF_STEP - 1] -= inside
    return found
