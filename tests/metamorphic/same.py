"""Whether two runs are the same within the errors that they have.

A relation holds for motions, so that two runs of the same settings may differ by the errors of both. What these
are the coarse run of the same scene tells: its steps are twice as long, or its tolerance is 64 times as large.
Its distance from the run contains its own error, which is at least four times that of the run. Besides, they
may differ by rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from hypothesis import Phase, assume, settings

from support_exudyn import Onset, Result, Scenario, SimulationError, simulate
from support_exudyn.scenario.solver_settings import ERROR_CONTROLLED
from tests.metamorphic.moving import FROM_THE_START
from tests.often import OFTEN, often

FEW = 20  # scenes of each relation in CI, a third by hand; in a longer profile as many as that says
TELLING = (
    0.05  # distance of the coarse run, as a share of a channel's largest value, above which nothing is told
)
MARGIN = 3.0  # both runs have an error, and that of a coarse run is now and then small by chance
# What rounding, and what ends an iteration or locates an impact, makes of the largest value in the same unit.
# Compiled: laws have kinks, of which now and then a step passes one unseen whatever the tolerance, and
# impacts multiply that; measured 2e-5, else 1e-8. Redundant: Newton's method leaves 1e-8 of the residual, which
# reactions of rigid bodies and accelerations show the more the shorter the steps; measured 4e-4 at worst, of a
# slider that does not turn.
ROUNDING = {"compiled": 1e-4, "exudyn": 1e-3}
# Largest value in a unit, where a scene shows less because it rests
SMALLEST = {"m": 1e-4, "rad": 1e-4, "m/s": 0.1, "rad/s": 0.1, "rad/s^2": 10.0, "J": 1e-6, "m^3/s": 1e-6}
MOTION = ("m", "rad")  # units of which the change is the size, for places are known much better than by a share
EVERYWHERE = slice(None)
ARM = 0.01  # [m], of the forces whose moments cancel; so large is a bore

# A scene that fails is told as it was drawn: to look for a simpler one is to simulate for hours
PHASES = (Phase.explicit, Phase.reuse, Phase.generate)

EvaluationContext = Mapping[str, np.ndarray]


def scenes(few: int = FEW) -> Callable[[Any], Any]:
    """Hypothesis's settings of a relation: a few scenes, or as many as a longer profile asks for."""
    asked = settings.default.max_examples
    return settings(max_examples=often(few) if asked <= OFTEN else asked, deadline=None, phases=PHASES)


def told(scenario: Scenario) -> Result:
    """A run; scenes that are refused tell nothing."""
    try:
        return simulate(scenario)
    except SimulationError:
        assume(False)
        raise


def plain(result: Result) -> EvaluationContext:
    """All that was recorded; of angles and potential energy the change."""
    return {
        name: result[name] - (result[name][0] if name.endswith(FROM_THE_START) else 0.0)
        for name in result.channels
    }


class ToldOnset(NamedTuple):
    """An impact: its time and the time of its separation [s], its speed [m/s], and how far each may be off."""

    time: float
    separation: float
    speed: float
    time_off: float
    separation_off: float
    speed_off: float


@dataclass(frozen=True)
class Run:
    """A run, and by how much each of its channels may be off.

    result: of the run. allowed: by channel. onsets: by pin.
    """

    result: Result
    allowed: Mapping[str, float]
    onsets: Mapping[str, list[ToldOnset]]

    def determined(self) -> np.ndarray:
        """Which records are not so near an impact or a separation that the error of its time decides, (n,)."""
        time = self.result.time
        found = np.ones(time.size, dtype=bool)
        for onset in (onset for onsets in self.onsets.values() for onset in onsets):
            found &= np.abs(time - onset.time) > onset.time_off
            if math.isfinite(onset.separation + onset.separation_off):
                found &= np.abs(time - onset.separation) > onset.separation_off
        return found

    def check(
        self,
        other: EvaluationContext,
        factors: Mapping[str, float] | None = None,
        rounding: float = 0.0,
        records: np.ndarray | slice = EVERYWHERE,
    ) -> None:
        """Another run of the same motion shows the same, in all channels that it has.

        Arguments:
            other: channels of it.
            factors: by which they have to be multiplied, all 1 by default.
            rounding: of the largest value in a unit, by which they may be off besides.
            records: that are compared.
        """
        mine, size = plain(self.result), sizes(self.result)
        assert set(other) & set(mine)
        for name, values in other.items():
            if name in mine:
                apart = values * (factors[name] if factors else 1.0) - mine[name]
                off = np.abs(apart[records]).max(initial=0.0)
                allowed = self.allowed[name] + rounding * size[self.result.unit(name)]
                assert off <= allowed, f"{name}: off by {off:.3g}, allowed {allowed:.3g}"

    def check_touches(self, other: Result, time: float = 1.0) -> None:
        """Another run impacts as often, and at the same times, of which one of its is so many [s]."""
        for pin, onsets in self.result.onsets.items():
            theirs = [onset.time * time for onset in other.onsets[pin]]
            assert len(theirs) == len(onsets), f"{pin}: {len(onsets)} impacts, in the other run {len(theirs)}"


def run(scenario: Scenario) -> Run:
    """A run with what it may be off by. Scenes whose numbers are not certain are left out."""
    fine, coarse = told(scenario), told(coarser(scenario))
    for pin, onsets in fine.onsets.items():
        assume(len(onsets) == len(coarse.onsets[pin]))  # else a graze decides
    mine, theirs = plain(fine), plain(coarse)
    size = sizes(fine)
    errors = {name: float(np.abs(mine[name] - theirs[name]).max()) for name in mine}
    rounding = ROUNDING[scenario.formulation]
    for name, error in errors.items():
        if name != "energy.balance":  # nothing but errors
            assume(error <= TELLING * size[fine.unit(name)])
    allowed = {name: MARGIN * error + rounding * size[fine.unit(name)] for name, error in errors.items()}
    told_of = {pin: told_onsets(onsets, coarse.onsets[pin]) for pin, onsets in fine.onsets.items()}
    return Run(fine, allowed, told_of)


def told_onsets(fine: Sequence[Onset], coarse: Sequence[Onset]) -> list[ToldOnset]:
    """The impacts of a run with how far they may be off, by those of a coarse run."""
    found = []
    for one, other in zip(fine, coarse, strict=True):
        mine = one.time, one.separation_time, one.speed
        theirs = other.time, other.separation_time, other.speed
        # both infinite: separated in neither
        off = (
            0.0 if here == there else MARGIN * abs(here - there)
            for here, there in zip(mine, theirs, strict=True)
        )
        found.append(ToldOnset(*mine, *off))
    return found


def coarser(scenario: Scenario) -> Scenario:
    """The same with a larger error."""
    if scenario.formulation in ERROR_CONTROLLED:
        return replace(scenario, solver=replace(scenario.solver, tolerance=64.0 * scenario.solver.tolerance))
    return scenario.refined(0.5)


def sizes(result: Result) -> dict[str, float]:
    """Largest value in each unit; of places and angles the largest change."""
    found: dict[str, float] = {}
    for name, values in plain(result).items():
        unit = result.unit(name)
        largest = np.ptp(values) if unit in MOTION else np.abs(values).max()
        found[unit] = max(found.get(unit, SMALLEST.get(unit, 0.0)), float(largest))
    found["N m"] = max(found.get("N m", 0.0), ARM * found.get("N", 0.0))
    return found
